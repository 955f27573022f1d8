// SPDX-License-Identifier: MIT
// A dialog that asks for a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viewer/commands/commands.h"
#include "viewer/commands/file_list.h"

namespace tetmend::viewer::ui {

/// Appears when the document asks for a file, and does with it what was asked for. What is typed is a
/// name, a path, or a part of a name that the list is to have; arrows go through the list, Enter
/// takes the entry that is marked. Folders are walked through by clicks as well.
class FileBrowser {
 public:
  /// Between begin and end of a frame.
  void draw(Session& session, float scale);

 private:
  void begin(const Document& document);
  void go_to(const std::filesystem::path& folder);
  bool is_listed(const FileEntry& entry) const;
  void mark_next(int step);
  std::filesystem::path named() const;
  void list(float scale);
  void ask_name();
  void offer_lessons();
  void finish(Session& session);

  FileQuestion question_ = FileQuestion::none;
  std::filesystem::path folder_;
  std::vector<FileEntry> entries_;
  std::string typed_;      // a name in the folder or a part of one, or a path
  std::string marked_;     // name of an entry, by the arrows; empty: none
  bool is_moved_ = false;  // the mark, and is to be brought into sight
  std::string trouble_;
  bool is_accepted_ = false;
  bool wants_focus_ = false;  // the field for the name
  bool is_done_ = false;      // what was asked for is done
};

}  // namespace tetmend::viewer::ui
