// SPDX-License-Identifier: MIT
// A file that takes its name, and the place of an older file, when it is complete.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/temporary_names.h"
#include "platform/platform.h"

namespace tetmend::formats {

/// A new file beside the target, made with O_EXCL: nothing that is there already is touched, nor
/// followed. `commit()` puts it in the place of the target. Without `commit()` it vanishes, also when
/// a signal ends the program by end_by_signal().
///
/// - A link to a file is kept, and the file behind it replaced. A link to nothing is an error, for
///   whoever made it may have chosen the place.
/// - Owner, group and permissions of an older file are kept as far as the system allows.
/// - What is written is on the disk before the file has its name.
class PendingFile {
 public:
  /// Of the temporary file. `part`: FILE.part, which a user can find after a crash (FILE.part1, ...
  /// if that is taken).
  enum class Name { hidden, part };

  /// @throws Error when the target is no regular file or write-protected or when its folder cannot
  /// be written.
  explicit PendingFile(const std::filesystem::path& target, Name name = Name::hidden);
  /// One that is complete and on the disk, under another name of the same file system. Nothing can be
  /// written then.
  /// @throws Error also when there is no such file
  PendingFile(const std::filesystem::path& target, const std::filesystem::path& complete);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  /// What replacing the older file will change besides its content, one sentence each.
  const std::vector<std::string>& notes() const { return notes_; }

  /// @throws Error with the reason of the operating system, such as a full disk.
  void write(std::string_view bytes);
  /// Puts all on the disk and closes: what can fail for want of space fails here.
  /// @throws Error
  void finish();
  /// Finishes, then gives the file its name.
  /// @throws Error; then an older file is as it was, but where its text says that the new one was
  /// written: then a loss of power may take that back.
  void commit();
  /// The same for files that belong together: all get their names, or the older ones are as they
  /// were. In between, some are new: only a loss of power or SIGKILL shows that.
  static void commit_all(std::span<PendingFile* const> files);
  /// The same where readers open `index` first: nothing has its name while the others get theirs. So
  /// even a loss of power or SIGKILL leaves no mixture of old and new to readers: the older mesh, the
  /// new one, or no index; then older files are beside, under names that begin with ".tetmend-".
  /// @param gone files of the older mesh that the new one does not have; they go
  static void commit_behind(PendingFile& index, std::span<PendingFile* const> files,
                            std::span<const std::filesystem::path> gone = {});

 private:
  class Replacement;

  void find_target();
  void make_temporary(Name name);
  void keep_owner();
  void take_name();
  void synchronise_folder() const;
  [[noreturn]] void fail(int error) const;

  std::string name_;  // as the user gave it, for messages
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  TemporaryName registered_;
  std::vector<std::string> notes_;
  platform::FileFacts older_;
  bool has_older_ = false;
  bool committed_ = false;
  platform::Descriptor file_;
};

}  // namespace tetmend::formats
