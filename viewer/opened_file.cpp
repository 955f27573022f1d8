// SPDX-License-Identifier: MIT
#include "viewer/opened_file.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "explain/lesson_guide.h"
#include "kernel/error.h"
#include "kernel/formats/degenerate.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/tet_mesh_io.h"
#include "kernel/grouped.h"
#include "viewer/debugger/openable.h"
#include "viewer/live/carried_data.h"

namespace tetmend::viewer {

namespace {

/// What a file holds that the mesh in the window does not: "2 arrays, 3 groups"; empty: nothing.
std::string named_beside(const MeshData& data) {
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, std::string_view what) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, what));
  };
  add(data.point_data.size() + data.tet_data.size() + data.triangle_data.size() +
          data.edge_data.size(),
      "arrays");
  add(data.groups.size(), "groups");
  add(data.other_elements.size(), "kinds of other elements");
  add(data.mid_nodes.size(), "mid-side nodes as such");
  add(data.deck.size(), "pieces of a deck");
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Readers of meshes would speak of extensions.
void refuse_what_is_neither(const std::filesystem::path& file) {
  std::error_code none;
  if (std::filesystem::is_directory(file, none)) {
    throw Error(fmt::format("{}: this is a folder", file.string()));
  }
  refuse_what_is_no_mesh(file);
  if (file.extension() != ".trace") return;
  throw Error(std::filesystem::is_empty(file, none)
                  ? fmt::format("{}: the file is empty", file.string())
                  : fmt::format("{}: this is no trace: it does not begin as one", file.string()));
}

/// What was put right in a mesh, or is wrong with it.
std::vector<std::string> notes_of(const BuildReport& report) {
  std::vector<std::string> notes;
  if (report.mirrored) {
    notes.emplace_back("the mesh was mirrored: two vertices were swapped in every tet");
  }
  const auto note = [&](std::size_t count, std::string_view what) {
    if (count > 0) notes.push_back(fmt::format("{} {}", grouped(count), what));
  };
  note(report.reordered_tets, "tets listed the vertices the other way round: corrected");
  note(report.inverted_tets, "tets have negative volume");
  note(report.flat_tets, "tets have no volume");
  note(report.unused_points, "points are in no tet");
  return notes;
}

OpenedFile read_trace(const std::filesystem::path& file, const auto& tell) {
  OpenedFile opened;
  opened.file = file;
  opened.debugger = std::make_unique<Debugger>(file);
  tell(OpeningStage::building);
  TetMesh mesh = opened.debugger->mesh();
  tell(OpeningStage::measuring);
  opened.mesh = MeasuredMesh(std::move(mesh));
  return opened;
}

}  // namespace

OpenedFile read_file(const std::filesystem::path& file, const Standard& standard,
                     std::atomic<OpeningStage>* stage) {
  const auto tell = [&](OpeningStage now) {
    if (stage != nullptr) *stage = now;
  };
  tell(OpeningStage::reading);
  if (is_trace(file)) return read_trace(file, tell);
  if (file.extension() == ".json") return read_trace(explain::trace_of_lesson(file), tell);
  refuse_what_is_neither(file);
  OpenedFile opened;
  opened.file = file;
  MeshData data = read_mesh(file);
  opened.notes = data.notes;
  std::erase_if(opened.notes, [](const auto& note) { return !formats::tells_of_dropped(note); });
  opened.beside = named_beside(data);
  if (holds_more_than_mesh(data)) {
    opened.data = std::make_shared<const MeshData>(data);
  }
  tell(OpeningStage::building);
  BuildReport report;
  TetMesh read = build_tet_mesh(file, std::move(data), MeshOrder::of_file, &report);
  tell(OpeningStage::measuring);
  read.set_standard(standard);
  for (std::string& note : notes_of(report)) opened.notes.push_back(std::move(note));
  for (std::string& note : notes_of_parts(read)) opened.notes.push_back(std::move(note));
  if (report.mirrored) opened.remark = notes_of(report).front();
  opened.mesh = MeasuredMesh(std::move(read));
  return opened;
}

Opening::Opening(std::filesystem::path file, const Standard& standard)
    : file_(std::move(file)), result_(std::async(std::launch::async, [this, standard] {
        return read_file(file_, standard, &stage_);
      })) {}

bool Opening::wait(double seconds) const {
  return result_.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
}

std::string_view Opening::stage() const {
  constexpr std::array<std::string_view, 3> kNames = {"reading", "building the mesh", "measuring"};
  return kNames[static_cast<std::size_t>(stage_.load())];
}

/// About what each takes of a mesh of a million tets.
double Opening::share() const {
  constexpr std::array<double, 3> kBehind = {0.1, 0.5, 0.8};
  return kBehind[static_cast<std::size_t>(stage_.load())];
}

double Opening::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace tetmend::viewer
