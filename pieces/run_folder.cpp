// SPDX-License-Identifier: MIT
#include "pieces/run_folder.h"

#include <array>
#include <cerrno>
#include <limits>
#include <system_error>

#include <fmt/format.h>
#include <tetmend/catalogue.h>

#include "kernel/formats/compression.h"
#include "pieces/bytes.h"

namespace tetmend::pieces {

namespace {

constexpr const char* kSurface = "surface";
constexpr const char* kLock = "lock";
constexpr std::string_view kStep = "step-";
/// What the lock says where the folder was not there before.
constexpr std::string_view kMadeFolder = "tetmend made this folder\n";

/// What a file of this version begins with.
std::string signature() {
  return fmt::format("tetmend {}: a run in pieces, 12\n", version());
}

void append_run(const SavedRun& saved, std::string& bytes) {
  put(saved.input, bytes);
  put(saved.output, bytes);
  put(saved.input_content.size, bytes);
  put(saved.input_content.checksum, bytes);
  put(saved.size_content.size, bytes);
  put(saved.size_content.checksum, bytes);
  put(saved.vertices, bytes);
  put(saved.holds_more, bytes);
  put(saved.label_array, bytes);
  put(saved.variant, bytes);
  put(saved.asks_for_goal, bytes);
  put(std::uint64_t{saved.options.size()}, bytes);
  for (const auto& [name, value] : saved.options) {
    put(name, bytes);
    put(value, bytes);
  }
  put(saved.division, bytes);
  append(saved.before, bytes);
  append(saved.run, bytes);
  append(saved.mesh, bytes);
  put(saved.is_finished, bytes);
}

bool is_likely(const SavedRun& saved) {
  constexpr unsigned kMostSteps = 64;
  constexpr std::size_t kMostPieces = 65'535;
  const Division& division = saved.division;
  return division.pieces >= 1 && division.pieces <= kMostPieces && division.divisions >= 1 &&
         division.divisions <= kMostSteps && division.zone_rounds <= kMostSteps &&
         saved.run.records.size() <= division.divisions + division.zone_rounds;
}

}  // namespace

std::uint32_t number_of(const SavedRun& saved) {
  std::string bytes;
  put(saved.input, bytes);
  put(saved.input_content.size, bytes);
  put(saved.input_content.checksum, bytes);
  put(saved.size_content.size, bytes);
  put(saved.size_content.checksum, bytes);
  put(saved.label_array, bytes);
  for (const auto& [name, value] : saved.options) {
    put(name, bytes);
    put(value, bytes);
  }
  put(std::uint64_t{saved.division.pieces}, bytes);
  return formats::checksum(bytes);
}

FileIdentity identify(const std::filesystem::path& file, Ranks& ranks) {
  FileIdentity identity;
  const auto opened = ranks.is_first() ? platform::open_to_read(file)
                                       : platform::Answer<platform::Descriptor>{{}, ENOENT};
  std::string block(opened ? std::size_t{1} << 18 : 0, '\0');
  for (bool is_at_end = !opened; !is_at_end;) {
    const auto got = platform::read_some(opened.value.number(), block);
    is_at_end = !got || got.value == 0;
    identity.checksum =
        formats::checksum(std::string_view(block).substr(0, got.value), identity.checksum);
    identity.size += got.value;
  }
  std::string mine;
  put(identity.size, mine);
  put(identity.checksum, mine);
  const std::vector<std::string> all = ranks.gather(mine);
  std::string_view first = all.front();
  take(first, identity.size);
  take(first, identity.checksum);
  return identity;
}

SavedRun take_run(std::string_view bytes) {
  SavedRun saved;
  take(bytes, saved.input);
  take(bytes, saved.output);
  take(bytes, saved.input_content.size);
  take(bytes, saved.input_content.checksum);
  take(bytes, saved.size_content.size);
  take(bytes, saved.size_content.checksum);
  take(bytes, saved.vertices);
  take(bytes, saved.holds_more);
  take(bytes, saved.label_array);
  take(bytes, saved.variant);
  take(bytes, saved.asks_for_goal);
  std::uint64_t count = 0;
  take(bytes, count);
  for (std::uint64_t i = 0; i < count; ++i) {
    auto& [name, value] = saved.options.emplace_back();
    take(bytes, name);
    take(bytes, value);
  }
  take(bytes, saved.division);
  saved.before = take_measured(bytes);
  saved.run = take_run_state(bytes);
  saved.mesh = take_state(bytes);
  take(bytes, saved.is_finished);
  if (!bytes.empty() || !is_likely(saved)) throw Error("a run contradicts itself");
  return saved;
}

namespace {

std::string content_of(const platform::Descriptor& file) {
  std::array<char, 64> content{};
  const auto got = platform::read_at(file.number(), 0, content);
  return got ? std::string(content.data(), got.value) : std::string();
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, platform::Sharing sharing)
    : folder_(folder) {
  std::error_code error;
  const bool made = std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
  }
  auto locked = platform::open_locked(folder / kLock, sharing);
  if (locked.error == EWOULDBLOCK) {
    throw Error(
        fmt::format("{}: another program works on the run of this folder", folder.string()));
  }
  if (!locked && locked.error != ENOLCK) {
    throw Error(fmt::format("{}: cannot be locked: {}", folder.string(),
                            std::generic_category().message(locked.error)));
  }
  file_ = std::move(locked.value);
  if (made) static_cast<void>(platform::write_fully(file_.number(), kMadeFolder));
  made_folder_ = content_of(file_) == kMadeFolder;
}

FolderLock::~FolderLock() {
  if (!RunFolder(folder_).is_empty()) return;
  platform::remove_file((folder_ / kLock).c_str());
  std::error_code ignored;
  if (made_folder_) std::filesystem::remove(folder_, ignored);
}

formats::FileSet RunFolder::files() const {
  return {.files = {folder_ / kRunFile, folder_ / kSurface, folder_ / kLock},
          .numbered = {{.folder = folder_, .begin = std::string(kStep), .end = {}}}};
}

bool RunFolder::has_run() const {
  return root(0).has(kRunFile);
}

bool RunFolder::is_empty() const {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error)) {
    if (entry.path().filename() != kLock) return false;
  }
  return !error;
}

SealedShelf RunFolder::root(std::uint32_t run) const {
  return {folder_, "", run};
}

SavedRun RunFolder::load() const {
  const SealedShelf shelf = root(0);
  if (!shelf.has(kRunFile)) {
    throw Error(fmt::format("{}: there is no run in pieces", folder_.string()));
  }
  const std::string begin = signature();
  if (shelf.first_bytes(kRunFile, begin.size()) != begin) {
    throw Error(fmt::format("{}: is damaged, or was not written by tetmend {}",
                            (folder_ / kRunFile).string(), version()));
  }
  const std::string bytes = shelf.read(kRunFile);
  SavedRun saved;
  shelf.parse(kRunFile, [&] { saved = take_run(std::string_view(bytes).substr(begin.size())); });
  return saved;
}

void RunFolder::save(const SavedRun& run) const {
  std::string bytes = signature();
  append_run(run, bytes);
  root(0).put(kRunFile, std::move(bytes));
  remove_steps_but(run.is_finished ? std::numeric_limits<std::size_t>::max() : step_of(run.run));
}

void RunFolder::save_surface(const SavedRun& run, const std::string& bytes) const {
  root(number_of(run)).put(kSurface, bytes);
}

std::string RunFolder::load_surface(const SavedRun& run) const {
  const SealedShelf shelf = root(number_of(run));
  const std::string bytes = shelf.read(kSurface);
  shelf.parse(kSurface, [&] {
    for (std::string_view rest = bytes; !rest.empty();) take_share(rest);
  });
  return bytes;
}

SealedShelf RunFolder::step(std::size_t number, const SavedRun& run) const {
  return {folder_, fmt::format("{}{}", kStep, number), number_of(run)};
}

SealedShelf RunFolder::new_step(std::size_t number, const SavedRun& run) const {
  make_step(number);
  return step(number, run);
}

std::filesystem::path RunFolder::make_step(std::size_t number) const {
  const std::filesystem::path made = folder_ / fmt::format("{}{}", kStep, number);
  std::error_code error;
  std::filesystem::remove_all(made, error);
  std::filesystem::create_directories(made, error);
  if (error) {
    throw Error(fmt::format("cannot make the folder {}: {}", made.string(), error.message()));
  }
  return made;
}

void RunFolder::remove_steps_but(std::size_t number) const {
  const std::string kept = fmt::format("{}{}", kStep, number);
  std::error_code ignored;
  std::vector<std::filesystem::path> others;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kStep) && name != kept) others.push_back(entry.path());
  }
  for (const std::filesystem::path& other : others) std::filesystem::remove_all(other, ignored);
}

void RunFolder::clear() const {
  remove_steps_but(std::numeric_limits<std::size_t>::max());
  for (const char* name : {kRunFile, kSurface}) platform::remove_file((folder_ / name).c_str());
}

}  // namespace tetmend::pieces
