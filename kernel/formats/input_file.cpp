// SPDX-License-Identifier: MIT
// A whole file in memory, and the two ways to say where in it something is wrong.
#include "kernel/formats/input_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/packed_file.h"
#include "kernel/formats/standard_stream.h"
#include "kernel/printable.h"
#include "platform/memory.h"
#include "platform/platform.h"

namespace tetmend::formats {
namespace {

[[noreturn]] void fail_to_read(const std::string& name, int error) {
  throw Error(fmt::format("{}: cannot be read: {}", name, std::generic_category().message(error)));
}

/// Of a stream nobody knows how long it is. It is copied, grows by doubling and becomes a mesh:
/// so an endless one is told before it has taken the memory of all other programs.
std::string read_standard_input(const std::string& name) {
  const std::uint64_t most = platform::memory_for_process() / 8;
  std::string content;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const auto got = platform::read_some(platform::kStandardInput, buffer);
    if (!got) fail_to_read(name, got.error);
    if (got.value == 0) return content;
    content.append(buffer.data(), got.value);
    if (content.size() <= most) continue;
    throw Error(fmt::format(
        "{}: {} bytes came, an eighth of the memory that there is, and no end: expected "
        "the bytes of a mesh; one so large is read from a file",
        name, content.size()));
  }
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path) : name_(path.string()) {
  if (is_standard_stream(path)) {
    copy_standard_input();
  } else {
    read_file(path);
  }
  size_of_file_ = size_;
  if (is_packed({bytes_.get(), size_})) unpack();
}

InputFile::InputFile(std::string name, std::string_view bytes)
    : name_(std::move(name)),
      bytes_(new char[bytes.size() + 1]),
      size_(bytes.size()),
      size_of_file_(bytes.size()) {
  std::copy(bytes.begin(), bytes.end(), bytes_.get());
  bytes_[size_] = '\0';
}

void InputFile::copy_standard_input() {
  name_ = "standard input";
  static const std::string kContent = read_standard_input(name_);  // it cannot be read again
  size_ = kContent.size();
  bytes_.reset(new char[size_ + 1]);
  std::copy_n(kContent.c_str(), size_ + 1, bytes_.get());
}

void InputFile::read_file(const std::filesystem::path& path) {
  const auto file = platform::open_to_read(path);
  if (!file) fail_to_read(name_, file.error);
  const auto facts = platform::look_at(file.value.number());
  if (!facts) fail_to_read(name_, facts.error);
  if (facts.value.kind == platform::FileKind::folder) fail_to_read(name_, EISDIR);
  if (facts.value.kind != platform::FileKind::regular) {
    throw Error(fmt::format("{}: cannot be read: not a regular file", name_));
  }
  const auto wanted = static_cast<std::size_t>(facts.value.size);
  bytes_.reset(new char[wanted + 1]);
  while (size_ < wanted) {
    const std::span rest(bytes_.get() + size_, wanted - size_);
    const auto got = platform::read_some(file.value.number(), rest);
    if (!got) fail_to_read(name_, got.error);
    if (got.value == 0) break;  // shortened meanwhile
    size_ += got.value;
  }
  bytes_[size_] = '\0';
}

void InputFile::unpack() {
  try {
    Inflated content = formats::unpack({bytes_.get(), size_});
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
  return fmt::format("'{}'", printable(word, kLongest));
}

}  // namespace tetmend::formats
