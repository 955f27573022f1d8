// SPDX-License-Identifier: MIT
#include "kernel/formats/pending_file.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "kernel/error.h"

namespace tetmend::formats {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

/// The name does not contain the target's, which may have the greatest length allowed.
std::filesystem::path beside(const std::filesystem::path& target, std::string_view suffix,
                             int attempt) {
  return target.parent_path() /
         fmt::format(".tetmend-{}-{}.{}", platform::process_number(), attempt, suffix);
}

}  // namespace

PendingFile::PendingFile(const std::filesystem::path& target, Name name)
    : name_(target.string()), target_(target) {
  find_target();
  make_temporary(name);
  try {
    if (has_older_) keep_owner();
  } catch (...) {  // no destructor runs for half an object
    file_.close();
    platform::remove_file(temporary_.c_str());
    throw;
  }
}

PendingFile::PendingFile(const std::filesystem::path& target, const std::filesystem::path& complete)
    : name_(target.string()), target_(target), temporary_(complete) {
  find_target();
  auto opened = platform::open_to_read(complete);
  if (!opened) fail(opened.error);
  file_ = std::move(opened.value);
  if (has_older_) keep_owner();
  file_.close();  // of many files few are open at a time
}

PendingFile::~PendingFile() {
  file_.close();
  if (!committed_) platform::remove_file(temporary_.c_str());
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
  const auto older = platform::look_at(target_);
  if (!older) return;
  has_older_ = true;
  older_ = older.value;
  if (older_.kind == platform::FileKind::folder) fail(EISDIR);
  if (older_.kind != platform::FileKind::regular) {
    throw Error(fmt::format("{}: cannot be written: not a regular file", name_));
  }
  // A rename would get past the write protection of the file, which asks the folder only.
  if (const int refusal = platform::may_write(target_); refusal != 0) fail(refusal);
  if (older_.names > 1) {
    notes_.push_back(fmt::format("has {} names: only this one gets the new content", older_.names));
  }
}

void PendingFile::make_temporary(Name name) {
  using platform::Access;
  const Access access =
      has_older_ ? Access::owner_only : Access::as_usual;  // what was private stays so
  const EndDelay delay;
  for (int attempt = 0; !file_.is_open(); ++attempt) {
    if (name == Name::part) {
      temporary_ = target_;
      temporary_ += attempt == 0 ? ".part" : fmt::format(".part{}", attempt);
    } else {
      temporary_ = beside(target_, "tmp", attempt);
    }
    auto made = platform::create(temporary_, access);
    file_ = std::move(made.value);
    if (made || made.error == EEXIST) continue;
    if (made.error != ENAMETOOLONG || name == Name::hidden) fail(made.error);
    name = Name::hidden;
  }
  registered_.remember(temporary_, name == Name::part);
}

void PendingFile::keep_owner() {
  const auto mine = platform::look_at(file_.number());
  if (!mine) fail(mine.error);
  const platform::OwnerLoss loss = platform::keep_owner(file_.number(), mine.value, older_);
  if (loss.group) notes_.push_back("its group cannot be kept");
  if (loss.owner) notes_.push_back("its owner cannot be kept");
  if (loss.permissions) notes_.push_back("its permissions cannot be kept");
}

void PendingFile::write(std::string_view bytes) {
  if (const int error = platform::write_fully(file_.number(), bytes); error != 0) fail(error);
}

void PendingFile::finish() {
  if (!file_.is_open()) return;
  const int sync_error = platform::synchronise(file_.number());
  const int close_error = file_.close();
  if (sync_error != 0 || close_error != 0) fail(sync_error != 0 ? sync_error : close_error);
}

void PendingFile::take_name() {
  if (const int error = platform::rename(temporary_, target_); error != 0) fail(error);
  committed_ = true;
  registered_.forget();
}

void PendingFile::commit() {
  finish();
  {
    const EndDelay delay;
    take_name();
  }
  const int error = platform::synchronise_folder(folder_of(target_));
  if (error == 0) return;
  throw Error(fmt::format("{}: was written, but its folder cannot be put on the disk: {}", name_,
                          std::generic_category().message(error)));
}

/// The new names survive a loss of power.
void PendingFile::synchronise_folder() const {
  if (const int error = platform::synchronise_folder(folder_of(target_)); error != 0) fail(error);
}

/// One name of several: its older file is kept aside until all are as they shall be.
class PendingFile::Replacement {
 public:
  explicit Replacement(PendingFile& file) : file_(&file), target_(file.target_) {}
  /// Nothing shall have that name.
  explicit Replacement(const std::filesystem::path& gone) : target_(gone) {}

  /// Nothing has the name then.
  void clear_name() {
    if (is_taken()) move_older();
  }
  /// The new file has it.
  void make() {
    if (!has_aside_ && is_taken()) keep_older();
    file_->take_name();
    is_made_ = true;
  }
  void accept() {
    if (has_aside_) platform::remove_file(aside_.c_str());
  }
  /// Where the older file is, if it could not get its name back; else empty.
  std::filesystem::path undo() {
    if (!has_aside_) {
      if (is_made_) platform::remove_file(target_.c_str());
      return {};
    }
    if (!is_made_ && !was_moved_) return accept(), std::filesystem::path();
    if (platform::rename(aside_, target_) == 0) return {};
    return std::move(aside_);
  }

  /// Does the work that makes these; after an error nothing of it is left.
  template <class Work>
  static void all_or_none(std::vector<Replacement>& made, const Work& work) {
    std::vector<std::filesystem::path> moved;  // older files that could not get their names back
    moved.reserve(made.capacity());
    try {
      work();
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
  }

 private:
  bool is_taken() const {
    using platform::FileKind;
    const auto now = platform::look_at_name(target_);
    if (!now) return false;
    const FileKind kind = now.value.kind;
    if (kind != FileKind::regular) fail(kind == FileKind::folder ? EISDIR : EEXIST);
    return true;
  }
  void keep_older() {
    for (int attempt = 0; !has_aside_; ++attempt) {
      aside_ = beside(target_, "old", attempt);
      const int error = platform::add_name(target_, aside_);
      has_aside_ = error == 0;
      if (has_aside_ || error == EEXIST) continue;
      return move_older();
    }
  }
  /// Also for file systems without hard links: for a moment nothing has the name.
  void move_older() {
    for (int attempt = 0; !has_aside_; ++attempt) {
      aside_ = beside(target_, "old", attempt);
      const auto made = platform::create(aside_, platform::Access::owner_only);
      if (made.error == EEXIST) continue;
      if (!made) fail(made.error);
      has_aside_ = true;
    }
    if (const int error = platform::rename(target_, aside_); error != 0) fail(error);
    was_moved_ = true;
  }
  [[noreturn]] void fail(int error) const {
    if (file_ != nullptr) file_->fail(error);
    throw Error(fmt::format("{}: cannot be removed: {}", target_.string(),
                            std::generic_category().message(error)));
  }

  PendingFile* file_ = nullptr;
  std::filesystem::path target_;
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
  Replacement::all_or_none(made, [&] {
    for (PendingFile* file : files) made.emplace_back(*file).make();
    for (const PendingFile* file : files) file->synchronise_folder();
  });
}

void PendingFile::commit_behind(PendingFile& index, std::span<PendingFile* const> files,
                                std::span<const std::filesystem::path> gone) {
  for (PendingFile* file : files) file->finish();
  index.finish();
  const EndDelay delay;
  std::vector<Replacement> made;
  made.reserve(1 + files.size() + gone.size());
  Replacement::all_or_none(made, [&] {
    made.emplace_back(index).clear_name();
    index.synchronise_folder();
    for (PendingFile* file : files) made.emplace_back(*file).make();
    for (const std::filesystem::path& file : gone) made.emplace_back(file).clear_name();
    for (const PendingFile* file : files) file->synchronise_folder();
    made.front().make();
    index.synchronise_folder();
  });
}

void PendingFile::fail(int error) const {
  throw Error(
      fmt::format("{}: cannot be written: {}", name_, std::generic_category().message(error)));
}

}  // namespace tetmend::formats
