// SPDX-License-Identifier: MIT
#include "pieces/sealed_shelf.h"

#include <algorithm>
#include <cerrno>
#include <limits>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/compression.h"
#include "kernel/formats/output_file.h"
#include "pieces/bytes.h"

namespace tetmend::pieces {

namespace {

/// Of the file itself, not of what it says.
class ShelfError : public Error {
 public:
  using Error::Error;
};

}  // namespace

SealedShelf::SealedShelf(std::filesystem::path root, std::string step, std::uint32_t run)
    : root_(std::move(root)),
      folder_(step.empty() ? root_ : root_ / step),
      step_(std::move(step)),
      run_(run) {
  const auto facts = platform::look_at_name(folder_);
  const bool is_link_out =
      !step_.empty() && facts && facts.value.kind != platform::FileKind::folder;
  if (is_link_out) fail("", "is no folder");
}

void SealedShelf::Sum::add(std::string_view more) {
  bytes += more.size();
  checksum = formats::checksum(more, checksum);
}

std::string SealedShelf::seal(const std::string& name, const Sum& sum) const {
  std::string place = fmt::format("{}/{}", step_, name.substr(0, name.find('.')));
  pieces::put(run_, place);
  std::string seal;
  pieces::put(sum.bytes, seal);
  pieces::put(formats::checksum(seal + place, sum.checksum), seal);
  return seal;
}

void SealedShelf::append(const std::string& name, std::string bytes) {
  const auto [entry, is_new] = growing_.try_emplace(name);
  if (is_new) {
    sound_.erase(name);
    platform::remove_file((folder_ / name).c_str());
  }
  const auto file = platform::open_to_append(folder_ / name);
  if (!file) fail(name, "cannot be written", file.error);
  const int error = platform::write_fully(file.value.number(), bytes);
  if (error != 0) fail(name, "cannot be written", error);
  entry->second.add(bytes);
}

void SealedShelf::end(const std::string& name) {
  append(name, {});  // that it is there
  const std::string last = seal(name, growing_.extract(name).mapped());
  const auto file = platform::open_to_append(folder_ / name);
  if (!file) fail(name, "cannot be written", file.error);
  int error = platform::write_fully(file.value.number(), last);
  if (error == 0) error = platform::synchronise(file.value.number());
  if (error != 0) fail(name, "cannot be written", error);
}

void SealedShelf::put(const std::string& name, std::string bytes) {
  growing_.erase(name);
  sound_.erase(name);
  Sum sum;
  sum.add(bytes);
  const auto older = platform::look_at_name(folder_ / name);
  if (older && older.value.kind == platform::FileKind::other) remove(name);  // a link leads out
  OutputFile out(folder_ / name);
  out.put(bytes);
  out.put(seal(name, sum));
  out.commit();
}

void SealedShelf::visit(const std::string& name,
                        const std::function<void(std::string_view)>& use) const {
  const std::string bytes = read(name);
  parse(name, [&] { use(bytes); });
}

void SealedShelf::parse(const std::string& name, const std::function<void()>& read_parts) const {
  read(name, 0, 0);  // whether it is sound
  try {
    read_parts();
  } catch (const ShelfError&) {
    throw;
  } catch (const Error& error) {
    fail(name, fmt::format("is damaged ({})", error.what()));
  }
}

bool SealedShelf::has(const std::string& name) const {
  return static_cast<bool>(platform::look_at_name(folder_ / name));
}

std::string SealedShelf::read(const std::string& name) const {
  return read(name, 0, std::numeric_limits<std::uint64_t>::max());
}

std::string SealedShelf::read(const std::string& name, std::uint64_t begin,
                              std::uint64_t size) const {
  std::uint64_t whole = 0;
  const platform::Descriptor file = open(name, whole);
  if (sound_.count(name) == 0) {
    check(name, file, whole);
    sound_.insert(name);
  }
  const std::uint64_t bytes = whole - kSealSize;
  return read_from(name, file, begin, std::min(size, bytes - std::min(bytes, begin)));
}

std::string SealedShelf::first_bytes(const std::string& name, std::uint64_t size) const {
  std::uint64_t whole = 0;
  const platform::Descriptor file = open(name, whole);
  return read_from(name, file, 0, std::min(size, whole));
}

/// @param size  takes that of the file
platform::Descriptor SealedShelf::open(const std::string& name, std::uint64_t& size) const {
  auto file = platform::open_to_read(folder_ / name, platform::Links::refused);
  if (file.error == ENOENT) fail(name, "is missing");
  if (file.error == ELOOP || file.error == EISDIR || file.error == ENXIO) {
    fail(name, "is no regular file");
  }
  if (!file) fail(name, "cannot be read", file.error);
  const auto facts = platform::look_at(file.value.number());
  if (!facts) fail(name, "cannot be read", facts.error);
  if (facts.value.kind != platform::FileKind::regular) fail(name, "is no regular file");
  size = facts.value.size;
  return std::move(file.value);
}

/// Whether it says what was written. In short blocks: who knows how large a damaged file is.
void SealedShelf::check(const std::string& name, const platform::Descriptor& file,
                        std::uint64_t size) const {
  constexpr std::uint64_t kBlock = std::uint64_t{1} << 18;
  if (size < kSealSize) fail(name, "is damaged");
  Sum sum;
  for (const std::uint64_t end = size - kSealSize; sum.bytes < end;) {
    sum.add(read_from(name, file, sum.bytes, std::min(kBlock, end - sum.bytes)));
  }
  if (read_from(name, file, sum.bytes, kSealSize) != seal(name, sum)) fail(name, "is damaged");
}

std::string SealedShelf::read_from(const std::string& name, const platform::Descriptor& file,
                                   std::uint64_t begin, std::uint64_t size) const {
  std::string bytes(size, '\0');
  for (std::uint64_t done = 0; done < size;) {
    const std::span<char> rest(bytes.data() + done, size - done);
    const auto got = platform::read_at(file.number(), begin + done, rest);
    if (!got) fail(name, "cannot be read", got.error);
    if (got.value == 0) fail(name, "is damaged");  // shortened meanwhile
    done += got.value;
  }
  return bytes;
}

void SealedShelf::remove(const std::string& name) {
  growing_.erase(name);
  sound_.erase(name);
  platform::remove_file((folder_ / name).c_str());
}

void SealedShelf::rename(const std::string& from, const std::string& to) {
  if (!has(from)) return;
  const int error = platform::rename(folder_ / from, folder_ / to);
  if (error != 0) fail(from, "cannot be renamed", error);
  sound_.erase(to);
  if (sound_.erase(from) > 0) sound_.insert(to);
}

void SealedShelf::fail(const std::string& name, std::string_view what) const {
  throw ShelfError(fmt::format("{} {}: delete {}", (folder_ / name).string(), what,
                               (root_ / kRunFile).string()));
}

void SealedShelf::fail(const std::string& name, std::string_view what, int error) const {
  throw ShelfError(fmt::format("{}: {}: {}", (folder_ / name).string(), what,
                               std::generic_category().message(error)));
}

}  // namespace tetmend::pieces
