// SPDX-License-Identifier: MIT
// A file that appears under its name only when it is complete.
#include "kernel/formats/output_file.h"

#include <cerrno>
#include <charconv>
#include <system_error>

#include <fcntl.h>
#include <fmt/compile.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "kernel/error.h"

namespace tetmend {

OutputFile::OutputFile(const std::filesystem::path& target)
    : name_(target.string()),
      target_(target),
      buffer_(std::make_unique_for_overwrite<char[]>(kCapacity)) {
  std::error_code ignored;
  // Renaming onto a link would replace the link, not the file that the user keeps behind it.
  if (const auto real = std::filesystem::canonical(target, ignored); !ignored) target_ = real;
  mode_t mode = 0;
  struct stat older {};
  if (::stat(target_.c_str(), &older) == 0) {
    if (S_ISDIR(older.st_mode)) fail(EISDIR);
    if (!S_ISREG(older.st_mode)) {
      throw Error(fmt::format("{}: cannot be written: not a regular file", name_));
    }
    // A rename would get past the write protection of the file, which asks the folder only.
    if (::access(target_.c_str(), W_OK) != 0) fail(errno);
    mode = older.st_mode & 0777;
  }
  // The name does not contain the target's, which may have the greatest length allowed.
  for (int attempt = 0; fd_ < 0; ++attempt) {
    temporary_ = target_.parent_path() / fmt::format(".tetmend-{}-{}.tmp", ::getpid(), attempt);
    fd_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd_ < 0 && errno != EEXIST) fail(errno);
  }
  if (mode != 0)
    static_cast<void>(::fchmod(fd_, mode));  // best effort: a file system may know no modes
}

OutputFile::~OutputFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!committed_) ::unlink(temporary_.c_str());
}

void OutputFile::put(std::string_view text) {
  if (text.size() > kCapacity - used_) flush();
  if (text.size() > kCapacity) return write_out(text.data(), text.size());
  if (text.empty()) return;
  std::memcpy(buffer_.get() + used_, text.data(), text.size());
  used_ += text.size();
}

void OutputFile::put_integer(std::int64_t value) {
  constexpr std::size_t kLongest = 24;
  char* begin = room_for(kLongest);
  used_ += static_cast<std::size_t>(std::to_chars(begin, begin + kLongest, value).ptr - begin);
}

void OutputFile::put_real(double value) {
  constexpr std::size_t kLongest = 32;
  char* begin = room_for(kLongest);
  used_ += static_cast<std::size_t>(fmt::format_to(begin, FMT_COMPILE("{}"), value) - begin);
}

void OutputFile::finish() {
  if (fd_ < 0) return;
  flush();
  const int closed = ::close(fd_);
  fd_ = -1;
  if (closed != 0) fail(errno);
}

void OutputFile::commit() {
  finish();
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  committed_ = true;
}

void OutputFile::flush() {
  write_out(buffer_.get(), used_);
  used_ = 0;
}

void OutputFile::write_out(const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(fd_, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

void OutputFile::fail(int error) const {
  throw Error(
      fmt::format("{}: cannot be written: {}", name_, std::generic_category().message(error)));
}

}  // namespace tetmend
