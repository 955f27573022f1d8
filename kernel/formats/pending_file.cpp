// SPDX-License-Identifier: MIT
#include "kernel/formats/pending_file.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "kernel/error.h"

namespace tetmend::formats {
namespace {

constexpr mode_t kPermissions = 0777;  // not setuid and its like: the content is another

/// Some file systems know no fsync: then there is nothing to wait for.
bool is_on_disk(int fd) {
  while (::fsync(fd) != 0) {
    if (errno == EINTR) continue;
    return errno == EINVAL || errno == ENOTSUP || errno == ENOSYS || errno == EROFS;
  }
  return true;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

/// The new names survive a loss of power. As far as possible: the files have their names already.
void sync_folder(const std::filesystem::path& file) {
  const int fd = ::open(folder_of(file).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  static_cast<void>(is_on_disk(fd));
  ::close(fd);
}

}  // namespace

int write_fully(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

PendingFile::PendingFile(const std::filesystem::path& target, Name name)
    : name_(target.string()), target_(target) {
  find_target();
  make_temporary(name);
  try {
    if (has_older_) keep_owner();
  } catch (...) {  // no destructor runs for half an object
    ::close(fd_);
    ::unlink(temporary_.c_str());
    throw;
  }
}

PendingFile::~PendingFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!committed_) ::unlink(temporary_.c_str());
}

void PendingFile::find_target() {
  // Renaming onto a link would replace the link, not the file that the user keeps behind it.
  std::error_code error;
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(target_, error))) {
    const auto real = std::filesystem::canonical(target_, error);
    if (error == std::errc::no_such_file_or_directory) {
      throw Error(fmt::format("{}: cannot be written: a link to nothing", name_));
    }
    if (error) fail(error.value());
    target_ = real;
  }
  if (::stat(target_.c_str(), &older_) != 0) return;
  has_older_ = true;
  if (S_ISDIR(older_.st_mode)) fail(EISDIR);
  if (!S_ISREG(older_.st_mode)) {
    throw Error(fmt::format("{}: cannot be written: not a regular file", name_));
  }
  // A rename would get past the write protection of the file, which asks the folder only.
  if (::access(target_.c_str(), W_OK) != 0) fail(errno);
  if (older_.st_nlink > 1) {
    notes_.push_back(fmt::format("has {} names: only this one gets the new content",
                                 static_cast<std::size_t>(older_.st_nlink)));
  }
}

std::filesystem::path PendingFile::beside(std::string_view suffix, int attempt) const {
  // The name does not contain the target's, which may have the greatest length allowed.
  return target_.parent_path() / fmt::format(".tetmend-{}-{}.{}", ::getpid(), attempt, suffix);
}

void PendingFile::make_temporary(Name name) {
  const mode_t mode = has_older_ ? 0600 : 0666;  // no one else reads what was private
  const EndDelay delay;
  for (int attempt = 0; fd_ < 0; ++attempt) {
    if (name == Name::part) {
      temporary_ = target_;
      temporary_ += attempt == 0 ? ".part" : fmt::format(".part{}", attempt);
    } else {
      temporary_ = beside("tmp", attempt);
    }
    fd_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    if (fd_ >= 0 || errno == EEXIST) continue;
    if (errno != ENAMETOOLONG || name == Name::hidden) fail(errno);
    name = Name::hidden;
  }
  registered_.remember(temporary_, name == Name::part);
}

void PendingFile::keep_owner() {
  struct stat mine {};
  if (::fstat(fd_, &mine) != 0) fail(errno);
  mode_t mode = older_.st_mode & kPermissions;
  constexpr auto kSame = static_cast<uid_t>(-1);
  if (mine.st_gid != older_.st_gid && ::fchown(fd_, kSame, older_.st_gid) != 0) {
    // What its group may do is not for another group.
    mode = (mode & ~mode_t{070}) | ((mode & 007) << 3);
    notes_.push_back("its group cannot be kept");
  }
  if (mine.st_uid != older_.st_uid && ::fchown(fd_, older_.st_uid, static_cast<gid_t>(-1)) != 0) {
    notes_.push_back("its owner cannot be kept");
  }
  if (::fchmod(fd_, mode) != 0 && (mine.st_mode & kPermissions) != mode) {
    notes_.push_back("its permissions cannot be kept");
  }
}

void PendingFile::write(std::string_view bytes) {
  if (const int error = write_fully(fd_, bytes); error != 0) fail(error);
}

void PendingFile::finish() {
  if (fd_ < 0) return;
  int error = is_on_disk(fd_) ? 0 : errno;
  if (::close(fd_) != 0 && error == 0) error = errno;
  fd_ = -1;
  if (error != 0) fail(error);
}

void PendingFile::take_name() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  committed_ = true;
  registered_.forget();
}

void PendingFile::commit() {
  finish();
  {
    const EndDelay delay;
    take_name();
  }
  sync_folder(target_);
}

/// One file of several: its older one is kept aside until all have their names.
class PendingFile::Replacement {
 public:
  explicit Replacement(PendingFile& file) : file_(file) {}

  void make() {
    keep_older();
    file_.take_name();
    is_made_ = true;
  }
  void accept() {
    if (has_aside_) ::unlink(aside_.c_str());
  }
  /// Where the older file is, if it could not get its name back; else empty.
  std::filesystem::path undo() {
    if (!has_aside_) {
      if (is_made_) ::unlink(file_.target_.c_str());
      return {};
    }
    if (!is_made_ && !was_moved_) return accept(), std::filesystem::path();
    if (::rename(aside_.c_str(), file_.target_.c_str()) == 0) return {};
    return std::move(aside_);
  }

 private:
  void keep_older() {
    struct stat now {};
    if (::lstat(file_.target_.c_str(), &now) != 0) return;
    if (!S_ISREG(now.st_mode)) file_.fail(S_ISDIR(now.st_mode) ? EISDIR : EEXIST);
    for (int attempt = 0; !has_aside_; ++attempt) {
      aside_ = file_.beside("old", attempt);
      has_aside_ = ::link(file_.target_.c_str(), aside_.c_str()) == 0;
      if (has_aside_ || errno == EEXIST) continue;
      return move_older();
    }
  }
  /// For file systems without hard links: for a moment nothing has the name.
  void move_older() {
    for (int attempt = 0; !has_aside_; ++attempt) {
      aside_ = file_.beside("old", attempt);
      const int fd = ::open(aside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0600);
      if (fd < 0 && errno == EEXIST) continue;
      if (fd < 0) file_.fail(errno);
      ::close(fd);
      has_aside_ = true;
    }
    if (::rename(file_.target_.c_str(), aside_.c_str()) != 0) file_.fail(errno);
    was_moved_ = true;
  }

  PendingFile& file_;
  std::filesystem::path aside_;
  bool has_aside_ = false;
  bool was_moved_ = false;
  bool is_made_ = false;
};

void PendingFile::commit_all(std::span<PendingFile* const> files) {
  for (PendingFile* file : files) file->finish();
  const EndDelay delay;
  std::vector<Replacement> made;
  made.reserve(files.size());
  std::vector<std::filesystem::path> moved;  // older files that could not get their names back
  moved.reserve(files.size());
  try {
    for (PendingFile* file : files) made.emplace_back(*file).make();
  } catch (const std::exception& error) {
    for (; !made.empty(); made.pop_back()) {  // all of them before anything else may fail
      std::filesystem::path aside = made.back().undo();
      if (!aside.empty()) moved.push_back(std::move(aside));
    }
    if (moved.empty()) throw;
    std::string message = error.what();
    for (const std::filesystem::path& aside : moved) {
      message += fmt::format("; an older file is now {}", aside.string());
    }
    throw Error(message);
  }
  for (Replacement& each : made) each.accept();
  for (const PendingFile* file : files) sync_folder(file->target_);
}

void PendingFile::fail(int error) const {
  throw Error(
      fmt::format("{}: cannot be written: {}", name_, std::generic_category().message(error)));
}

}  // namespace tetmend::formats
