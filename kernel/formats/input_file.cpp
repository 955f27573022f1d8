// SPDX-License-Identifier: MIT
// A whole file in memory, and the two ways to say where in it something is wrong.
#include "kernel/formats/input_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "kernel/error.h"
#include "kernel/formats/compression.h"
#include "kernel/formats/standard_stream.h"

namespace tetmend::formats {
namespace {

class Descriptor {
 public:
  explicit Descriptor(const char* path) : fd_(::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] void fail_to_read(const std::string& name, int error) {
  throw Error(fmt::format("{}: cannot be read: {}", name, std::generic_category().message(error)));
}

std::string read_standard_input(const std::string& name) {
  std::string content;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t got = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_to_read(name, errno);
    if (got == 0) return content;
    content.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path) : name_(path.string()) {
  if (is_standard_stream(path)) {
    copy_standard_input();
  } else {
    read_file(path);
  }
  if (is_gzip({bytes_.get(), size_})) unpack();
}

void InputFile::copy_standard_input() {
  name_ = "standard input";
  static const std::string kContent = read_standard_input(name_);  // it cannot be read again
  size_ = kContent.size();
  bytes_ = std::make_unique_for_overwrite<char[]>(size_ + 1);
  std::copy_n(kContent.c_str(), size_ + 1, bytes_.get());
}

void InputFile::read_file(const std::filesystem::path& path) {
  const Descriptor file(path.c_str());
  struct stat info {};
  if (file.get() < 0 || ::fstat(file.get(), &info) != 0) fail_to_read(name_, errno);
  if (S_ISDIR(info.st_mode)) fail_to_read(name_, EISDIR);
  if (!S_ISREG(info.st_mode)) {
    throw Error(fmt::format("{}: cannot be read: not a regular file", name_));
  }
  const auto wanted = static_cast<std::size_t>(info.st_size);
  bytes_ = std::make_unique_for_overwrite<char[]>(wanted + 1);
  while (size_ < wanted) {
    const ssize_t got = ::read(file.get(), bytes_.get() + size_, wanted - size_);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_to_read(name_, errno);
    if (got == 0) break;  // shortened meanwhile
    size_ += static_cast<std::size_t>(got);
  }
  bytes_[size_] = '\0';
}

void InputFile::unpack() {
  try {
    Inflated content = inflate_gzip({bytes_.get(), size_});
    bytes_ = std::move(content.bytes);
    size_ = content.size;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name_, error.what()));
  }
}

std::string InputFile::line_place(const char* where) const {
  return fmt::format("{}:{}", name_, 1 + std::count(begin(), std::min(where, end()), '\n'));
}

std::string InputFile::byte_place(const char* where) const {
  return fmt::format("{}: byte {}", name_, where - begin());
}

void InputFile::fail_at_line(const char* where, std::string_view reason) const {
  throw Error(fmt::format("{}: {}", line_place(where), reason));
}

void InputFile::fail_at_byte(const char* where, std::string_view reason) const {
  throw Error(fmt::format("{}: {}", byte_place(where), reason));
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7f) {
      text += fmt::format("\\x{:02x}", byte);
    } else {
      text += c;
    }
  }
  text += word.size() > kLongest ? "...'" : "'";
  return text;
}

}  // namespace tetmend::formats
