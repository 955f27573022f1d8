// SPDX-License-Identifier: MIT
#include "pieces/shelf.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "platform/platform.h"

namespace tetmend::pieces {

namespace {

[[noreturn]] void fail(std::string_view what, const std::filesystem::path& file, int error) {
  throw Error(fmt::format("{} {}: {}", what, file.string(),
                          std::generic_category().message(error != 0 ? error : EIO)));
}

}  // namespace

const MemoryShelf::Parts* MemoryShelf::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = bytes_.find(name);
  return found != bytes_.end() ? &found->second : nullptr;
}

MemoryShelf::Parts& MemoryShelf::make(const std::string& name) {
  const std::lock_guard lock(mutex_);
  return bytes_[name];
}

void MemoryShelf::append(const std::string& name, std::string bytes) {
  make(name).push_back(std::move(bytes));
}

void MemoryShelf::put(const std::string& name, std::string bytes) {
  Parts& parts = make(name);
  parts.clear();
  parts.push_back(std::move(bytes));
}

void MemoryShelf::visit(const std::string& name,
                        const std::function<void(std::string_view)>& use) const {
  const Parts* const parts = find(name);
  if (parts == nullptr) return;
  for (const std::string& part : *parts) use(part);
}

std::string MemoryShelf::read(const std::string& name) const {
  return read(name, 0, std::numeric_limits<std::uint64_t>::max());
}

std::string MemoryShelf::read(const std::string& name, std::uint64_t begin,
                              std::uint64_t size) const {
  std::string bytes;
  const Parts* const parts = find(name);
  if (parts == nullptr) return bytes;
  std::uint64_t total = 0;
  for (const std::string& part : *parts) total += part.size();
  bytes.reserve(std::min(size, total - std::min(total, begin)));
  for (const std::string& part : *parts) {
    if (begin < part.size()) {
      bytes.append(part, begin, size - bytes.size());
      begin = part.size();
    }
    begin -= part.size();
  }
  return bytes;
}

void MemoryShelf::remove(const std::string& name) {
  std::map<std::string, Parts>::node_type gone;  // freed without the lock
  const std::lock_guard lock(mutex_);
  gone = bytes_.extract(name);
}

void MemoryShelf::rename(const std::string& from, const std::string& to) {
  const std::lock_guard lock(mutex_);
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
  remove(name);
  append(name, std::move(bytes));
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

namespace {

constexpr std::string_view kScratch = ".tetmend-pieces-";
constexpr const char* kScratchLock = "lock";

/// Whether the owner of a folder, a process of this host, is there no more: nobody has the lock. Where
/// a file system knows no locks, or other hosts none of this one's, nobody can tell.
bool is_left_behind(const std::filesystem::path& folder, platform::Descriptor& lock) {
  const std::filesystem::path file = folder / kScratchLock;
  if (!platform::look_at_name(file)) return false;  // it is just being made
  auto locked = platform::open_locked(file, platform::Sharing::none);
  if (!locked) return false;
  std::array<char, 512> host{};
  const auto got = platform::read_at(locked.value.number(), 0, host);
  lock = std::move(locked.value);
  return got && got.value > 0 && std::string_view(host.data(), got.value) == platform::host_name();
}

/// What killed processes of this host have left in a folder.
void remove_left_behind(const std::filesystem::path& parent) {
  std::error_code ignored;
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(parent, ignored)) {
    if (entry.path().filename().string().starts_with(kScratch)) found.push_back(entry.path());
  }
  for (const std::filesystem::path& folder : found) {
    platform::Descriptor lock;
    if (is_left_behind(folder, lock)) std::filesystem::remove_all(folder, ignored);
  }
}

}  // namespace

ScratchFolder::ScratchFolder(const std::filesystem::path& parent) {
  remove_left_behind(parent);
  for (unsigned i = 0;; ++i) {
    path_ = parent / fmt::format("{}{}-{}", kScratch, platform::process_number(), i);
    std::error_code error;
    if (std::filesystem::create_directory(path_, error)) break;
    if (error) fail("cannot make the folder", path_, error.value());
  }
  lock();
}

/// Others see the file when it is locked. Without a lock the folder stays if the process is killed.
void ScratchFolder::lock() {
  const std::filesystem::path made = path_ / "making";
  auto locked = platform::open_locked(made, platform::Sharing::none);
  if (!locked) return platform::remove_file(made.c_str());
  static_cast<void>(platform::write_fully(locked.value.number(), platform::host_name()));
  if (platform::rename(made, path_ / kScratchLock) == 0) lock_ = std::move(locked.value);
}

ScratchFolder::~ScratchFolder() {
  lock_.close();  // a system may keep a file that is open
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace tetmend::pieces
