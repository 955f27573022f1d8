// SPDX-License-Identifier: MIT
#include "kernel/formats/file_bytes.h"

#include <algorithm>

#include <fmt/format.h>

#include "kernel/error.h"

namespace tetmend::formats {

FileBytes::FileBytes(const std::filesystem::path& file)
    : in_(file, std::ios::binary | std::ios::ate), file_(file) {
  size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, in_.tellg()));
}

const char* FileBytes::read(std::uint64_t begin, std::size_t size) {
  const bool is_there = begin <= size_ && size <= size_ - begin;
  if (is_there) {
    buffer_.resize(size);
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(begin));
    in_.read(buffer_.data(), static_cast<std::streamsize>(size));
  }
  if (!is_there || !in_) throw Error(fmt::format("{}: the file ends too early", file_.string()));
  return buffer_.c_str();
}

}  // namespace tetmend::formats
