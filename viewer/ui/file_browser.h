// SPDX-License-Identifier: MIT
// A dialog that asks for a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viewer/commands/commands.h"
#include "viewer/commands/file_list.h"

namespace tetmend::viewer::ui {

/// Appears when the document asks for a file, and does with it what was asked for. Folders are
/// walked through by clicks; a name can be typed, too.
class FileBrowser {
 public:
  /// Between begin and end of a frame.
  void draw(Session& session, float scale);

 private:
  void begin(const Document& document);
  void go_to(const std::filesystem::path& folder);
  void list(float scale);
  void offer_lessons();
  void finish(Session& session);
  std::filesystem::path chosen() const { return folder_ / typed_; }

  FileQuestion question_ = FileQuestion::none;
  std::filesystem::path folder_;
  std::vector<FileEntry> entries_;
  std::string typed_;  // a name in the folder, or a path
  std::string trouble_;
  bool is_accepted_ = false;
  bool wants_focus_ = false;  // the field for the name
};

}  // namespace tetmend::viewer::ui
