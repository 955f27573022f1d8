// SPDX-License-Identifier: MIT
// Reading and writing of tetrahedral mesh files; the format follows from the extension.
#include "kernel/formats/mesh_io.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/gmsh.h"
#include "kernel/formats/inp.h"
#include "kernel/formats/inp_deck.h"
#include "kernel/formats/medit_ascii.h"
#include "kernel/formats/medit_binary.h"
#include "kernel/formats/medit_marks.h"
#include "kernel/formats/tet_place.h"
#include "kernel/formats/tetgen.h"
#include "kernel/formats/vtk_legacy.h"
#include "kernel/formats/vtu.h"
#include "kernel/parts.h"

namespace tetmend {
namespace {

/// What of a MeshData a format can hold besides points, tets, triangles, edges and labels.
struct Room {
  bool data = false;    ///< named arrays
  bool groups = false;  ///< with names and parts, entities and periodic links
  bool others = false;  ///< elements of other kinds
  bool required_vertices = false;
  bool marks = false;    ///< groups of the names of kMeditMarks
  bool is_deck = false;  ///< with what a deck holds besides its mesh
};

struct Codec {
  MeshData (*read)(const std::filesystem::path&, const formats::ReadRequest&);
  void (*write)(const std::filesystem::path&, const MeshView&);
  Room room;
  /// What else is lost, one sentence each; may be null.
  std::vector<std::string> (*lost)(const std::filesystem::path&, const MeshData&) = nullptr;
};

/// For formats that have one place for labels.
template <MeshData (*Read)(const std::filesystem::path&, formats::TetPlace*)>
MeshData read_plain(const std::filesystem::path& file, const formats::ReadRequest& request) {
  if (!request.label_array.empty()) {
    throw Error(fmt::format("{}: the format has no arrays: none is named '{}'", file.string(),
                            request.label_array));
  }
  return Read(file, request.question);
}

constexpr std::array<MeshFormat, 8> kFormatsTable = {{{"MEDIT ASCII", ".mesh"},
                                                      {"MEDIT binary", ".meshb"},
                                                      {"TetGen", ".node"},
                                                      {"TetGen", ".ele"},
                                                      {"legacy VTK", ".vtk"},
                                                      {"VTK XML", ".vtu"},
                                                      {"Gmsh", ".msh"},
                                                      {"Abaqus, CalculiX", ".inp"}}};

// In the order of formats_table.
constexpr std::array<Codec, 8> kCodecs = {
    {{read_plain<formats::read_medit_ascii>,
      formats::write_medit_ascii,
      {.required_vertices = true, .marks = true}},
     {read_plain<formats::read_medit_binary>,
      formats::write_medit_binary,
      {.required_vertices = true, .marks = true}},
     {read_plain<formats::read_tetgen>, formats::write_tetgen, {}},
     {read_plain<formats::read_tetgen>, formats::write_tetgen, {}},
     {formats::read_vtk_legacy, formats::write_vtk_legacy, {.data = true, .others = true}},
     {formats::read_vtu, formats::write_vtu, {.data = true, .others = true}},
     {read_plain<formats::read_gmsh>,
      formats::write_gmsh,
      {.data = true, .groups = true, .others = true}},
     {read_plain<formats::read_inp>,
      formats::write_inp,
      {.groups = true, .others = true, .required_vertices = true, .is_deck = true},
      formats::not_in_inp}}};

/// Of "part.vtu.gz" that is ".vtu". A TetGen mesh is several files, which nobody packs one by one.
const Codec& find_codec(const std::filesystem::path& file) {
  const bool is_packed = file.extension() == ".gz";
  std::string extension = (is_packed ? file.stem() : file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string valid;
  for (std::size_t i = 0; i < kFormatsTable.size(); ++i) {
    const bool is_tetgen = kFormatsTable[i].name == "TetGen";
    if (kFormatsTable[i].extension == extension && !(is_packed && is_tetgen)) return kCodecs[i];
    valid += valid.empty() ? "" : ", ";
    valid += kFormatsTable[i].extension;
  }
  throw Error(fmt::format("{}: the extension '{}' is not that of a mesh format: expected one of {}",
                          file.string(), file.extension().string(), valid));
}

}  // namespace

std::span<const MeshFormat> mesh_formats() {
  return kFormatsTable;
}

MeshData read_mesh(const std::filesystem::path& file, const std::string& label_array) {
  try {
    return find_codec(file).read(file, {nullptr, label_array});
  } catch (const std::bad_alloc&) {
    throw Error(fmt::format("{}: cannot be read: not enough memory", file.string()));
  }
}

std::string locate_tet(const std::filesystem::path& file, std::size_t tet) {
  formats::TetPlace question{tet, file.string()};
  find_codec(file).read(file, {&question, {}});
  return question.place;
}

std::vector<std::string> not_written(const std::filesystem::path& file, const MeshData& mesh) {
  const Codec& codec = find_codec(file);
  const Room& room = codec.room;
  std::vector<std::string> notes;
  const auto arrays = [&](std::string_view of, const std::vector<DataArray>& list) {
    if (room.data) return;
    for (const DataArray& array : list) {
      notes.push_back(fmt::format("the array '{}' of {} is not kept: {} holds none", array.name, of,
                                  file.extension().string()));
    }
  };
  arrays("points", mesh.point_data);
  arrays("tets", mesh.tet_data);
  arrays("triangles", mesh.triangle_data);
  arrays("edges", mesh.edge_data);
  const auto lost = [&](bool held, std::size_t count, std::string_view what) {
    if (held || count == 0) return;
    notes.push_back(fmt::format("{} {} not kept: {} has no place for them", count, what,
                                file.extension().string()));
  };
  for (const OtherElements& others : mesh.other_elements) {
    lost(room.others, others.labels.size(),
         fmt::format("elements of VTK's type {} are", others.vtk_type));
  }
  const auto is_lost = [&room](const Group& group) {
    const bool is_mark = std::any_of(formats::kMeditMarks.begin(), formats::kMeditMarks.end(),
                                     [&](const auto& mark) { return mark.section == group.name; });
    return !group.name.empty() && !(is_mark && room.marks);  // one without a name is a label
  };
  const auto groups = std::count_if(mesh.groups.begin(), mesh.groups.end(), is_lost);
  lost(room.groups, static_cast<std::size_t>(groups), "groups, with their names, are");
  const bool by_labels = !are_finer_than_labels(mesh.tets, mesh.tet_parts) &&
                         !are_finer_than_labels(mesh.triangles, mesh.triangle_parts) &&
                         !are_finer_than_labels(mesh.edges, mesh.edge_parts);
  lost(room.groups || by_labels, mesh.entities.size(), "entities of the geometry are");
  lost(room.groups, mesh.periodic.size(), "periodic links are");
  lost(room.required_vertices, mesh.required_vertices.size(), "required vertices are");
  if (!room.is_deck && formats::is_inp_deck(mesh.deck)) {
    notes.push_back(
        fmt::format("what the deck holds besides its mesh is not kept: {} has no place for it",
                    file.extension().string()));
  }
  if (codec.lost != nullptr) {
    for (std::string& note : codec.lost(file, mesh)) notes.push_back(std::move(note));
  }
  return notes;
}

void write_mesh(const std::filesystem::path& file, const MeshData& mesh) {
  assert(mesh.point_labels.empty() || mesh.point_labels.size() == mesh.points.size());
  write_mesh(file, MeshView(mesh));
}

void write_mesh(const std::filesystem::path& file, const MeshView& mesh) {
  find_codec(file).write(file, mesh);
}

}  // namespace tetmend
