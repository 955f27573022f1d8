// SPDX-License-Identifier: MIT
#include "pieces/shelf.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/output_file.h"
#include "platform/platform.h"

namespace tetmend::pieces {

namespace {

[[noreturn]] void fail(std::string_view what, const std::filesystem::path& file, int error) {
  throw Error(fmt::format("{} {}: {}", what, file.string(),
                          std::generic_category().message(error != 0 ? error : EIO)));
}

}  // namespace

void MemoryShelf::append(const std::string& name, std::string bytes) {
  bytes_[name].push_back(std::move(bytes));
}

void MemoryShelf::put(const std::string& name, std::string bytes) {
  std::vector<std::string>& parts = bytes_[name];
  parts.clear();
  parts.push_back(std::move(bytes));
}

void MemoryShelf::visit(const std::string& name,
                        const std::function<void(std::string_view)>& use) const {
  const auto found = bytes_.find(name);
  if (found == bytes_.end()) return;
  for (const std::string& part : found->second) use(part);
}

std::string MemoryShelf::read(const std::string& name) const {
  return read(name, 0, std::numeric_limits<std::uint64_t>::max());
}

std::string MemoryShelf::read(const std::string& name, std::uint64_t begin,
                              std::uint64_t size) const {
  std::string bytes;
  const auto found = bytes_.find(name);
  if (found == bytes_.end()) return bytes;
  std::uint64_t total = 0;
  for (const std::string& part : found->second) total += part.size();
  bytes.reserve(std::min(size, total - std::min(total, begin)));
  for (const std::string& part : found->second) {
    if (begin < part.size()) {
      bytes.append(part, begin, size - bytes.size());
      begin = part.size();
    }
    begin -= part.size();
  }
  return bytes;
}

void MemoryShelf::remove(const std::string& name) {
  bytes_.erase(name);
}

void MemoryShelf::rename(const std::string& from, const std::string& to) {
  auto node = bytes_.extract(from);
  if (node.empty()) return;
  bytes_.erase(to);
  node.key() = to;
  bytes_.insert(std::move(node));
}

void FolderShelf::append(const std::string& name, std::string bytes) {
  const std::filesystem::path file = folder_ / name;
  errno = 0;
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) fail("cannot write", file, errno);
}

void FolderShelf::put(const std::string& name, std::string bytes) {
  if (lasts_ == Lasts::until_the_end) {
    remove(name);
    return append(name, std::move(bytes));
  }
  OutputFile out(folder_ / name);
  out.put(bytes);
  out.commit();
}

void FolderShelf::visit(const std::string& name,
                        const std::function<void(std::string_view)>& use) const {
  const std::string bytes = read(name);
  if (!bytes.empty()) use(bytes);
}

bool FolderShelf::has(const std::string& name) const {
  std::error_code ignored;
  return std::filesystem::exists(folder_ / name, ignored);
}

std::string FolderShelf::read(const std::string& name) const {
  return read(name, 0, std::numeric_limits<std::uint64_t>::max());
}

std::string FolderShelf::read(const std::string& name, std::uint64_t begin,
                              std::uint64_t size) const {
  const std::filesystem::path file = folder_ / name;
  std::error_code error;
  const std::uint64_t total = std::filesystem::file_size(file, error);
  if (error == std::errc::no_such_file_or_directory) return {};
  if (error) fail("cannot read", file, error.value());
  std::string bytes(std::min(size, total - std::min(total, begin)), '\0');
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(std::min(begin, total)));
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) fail("cannot read", file, errno);
  return bytes;
}

void FolderShelf::remove(const std::string& name) {
  std::error_code ignored;
  std::filesystem::remove(folder_ / name, ignored);
}

void FolderShelf::rename(const std::string& from, const std::string& to) {
  if (!has(from)) return;
  std::error_code error;
  std::filesystem::rename(folder_ / from, folder_ / to, error);
  if (error) fail("cannot rename", folder_ / from, error.value());
}

ScratchFolder::ScratchFolder(const std::filesystem::path& parent) {
  for (unsigned i = 0;; ++i) {
    path_ = parent / fmt::format(".tetmend-pieces-{}-{}", platform::process_number(), i);
    std::error_code error;
    if (std::filesystem::create_directory(path_, error)) return;
    if (error) fail("cannot make the folder", path_, error.value());
  }
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace tetmend::pieces
