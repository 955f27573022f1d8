// SPDX-License-Identifier: MIT
#include "pieces/run_folder.h"

#include <fstream>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <tetmend/catalogue.h>

#include "kernel/formats/output_file.h"
#include "pieces/bytes.h"
#include "pieces/shelf.h"

namespace tetmend::pieces {

namespace {

constexpr const char* kName = "run";
constexpr const char* kSurface = "surface";
constexpr std::string_view kStep = "step-";

/// What a file of this version begins with.
std::string signature() {
  return fmt::format("tetmend {}: a run in pieces, 8\n", version());
}

void append(const SavedRun& saved, std::string& bytes) {
  put(saved.input, bytes);
  put(saved.output, bytes);
  put(saved.input_size, bytes);
  put(saved.vertices, bytes);
  put(saved.holds_more, bytes);
  put(saved.label_array, bytes);
  put(saved.variant, bytes);
  put(std::uint64_t{saved.options.size()}, bytes);
  for (const auto& [name, value] : saved.options) {
    put(name, bytes);
    put(value, bytes);
  }
  put(saved.division, bytes);
  put(saved.before, bytes);
  append(saved.run, bytes);
  append(saved.mesh, bytes);
  put(saved.is_finished, bytes);
}

SavedRun take_run(std::string_view bytes) {
  SavedRun saved;
  take(bytes, saved.input);
  take(bytes, saved.output);
  take(bytes, saved.input_size);
  take(bytes, saved.vertices);
  take(bytes, saved.holds_more);
  take(bytes, saved.label_array);
  take(bytes, saved.variant);
  std::uint64_t count = 0;
  take(bytes, count);
  for (std::uint64_t i = 0; i < count; ++i) {
    auto& [name, value] = saved.options.emplace_back();
    take(bytes, name);
    take(bytes, value);
  }
  take(bytes, saved.division);
  take(bytes, saved.before);
  saved.run = take_run_state(bytes);
  saved.mesh = take_state(bytes);
  take(bytes, saved.is_finished);
  return saved;
}

}  // namespace

formats::FileSet RunFolder::files() const {
  return {.files = {folder_ / kName, folder_ / kSurface},
          .numbered = {{.folder = folder_, .begin = std::string(kStep), .end = {}}}};
}

bool RunFolder::has_run() const {
  std::error_code ignored;
  return std::filesystem::exists(folder_ / kName, ignored);
}

SavedRun RunFolder::load() const {
  const std::filesystem::path file = folder_ / kName;
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) {
    throw Error(fmt::format("{}: there is no run in pieces", folder_.string()));
  }
  const std::string begin = signature();
  if (!bytes.starts_with(begin)) {
    throw Error(fmt::format("{}: was not written by tetmend {}", file.string(), version()));
  }
  try {
    return take_run(std::string_view(bytes).substr(begin.size()));
  } catch (const Error&) {
    throw Error(fmt::format("{}: the file ends too early", file.string()));
  }
}

void RunFolder::save(const SavedRun& run) const {
  std::string bytes = signature();
  append(run, bytes);
  OutputFile out(folder_ / kName);
  out.put(bytes);
  out.commit();
  remove_steps_but(run.is_finished ? std::numeric_limits<std::size_t>::max() : step_of(run.run));
}

void RunFolder::save_surface(const std::string& bytes) const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  FolderShelf(folder_, FolderShelf::Lasts::beyond_a_crash).put(kSurface, bytes);
}

std::string RunFolder::load_surface() const {
  std::string bytes = FolderShelf(folder_).read(kSurface);
  if (bytes.empty()) throw Error(fmt::format("there is no {}", (folder_ / kSurface).string()));
  return bytes;
}

std::filesystem::path RunFolder::step(std::size_t number) const {
  return folder_ / fmt::format("{}{}", kStep, number);
}

std::filesystem::path RunFolder::make_step(std::size_t number) const {
  const std::filesystem::path made = step(number);
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

void RunFolder::remove() const {
  remove_steps_but(std::numeric_limits<std::size_t>::max());
  std::error_code ignored;
  std::filesystem::remove(folder_ / kName, ignored);
  std::filesystem::remove(folder_ / kSurface, ignored);
  std::filesystem::remove(folder_, ignored);  // fails where a user has put something
}

}  // namespace tetmend::pieces
