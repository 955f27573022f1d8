// SPDX-License-Identifier: MIT
// Reading and writing of tetrahedral mesh files; the format follows from the extension.
#include "kernel/formats/mesh_io.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <new>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/elmer.h"
#include "kernel/formats/gmsh.h"
#include "kernel/formats/label_names.h"
#include "kernel/formats/medit_ascii.h"
#include "kernel/formats/medit_binary.h"
#include "kernel/formats/medit_marks.h"
#include "kernel/formats/nastran.h"
#include "kernel/formats/netgen.h"
#include "kernel/formats/su2.h"
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
  bool marks = false;  ///< groups of the names of kMeditMarks
  bool point_labels = true;
  bool tet_labels = true;
  bool edges = true;
  /// Which kinds of other elements; null: all, if any.
  bool (*holds)(int vtk_type) = nullptr;
  /// Dimensions of groups whose names it keeps if they have all elements of a label: 1 << 2.
  unsigned named_labels = 0;
  bool periodic = false;
  bool low_labels = true;  ///< below 1
  /// Arrays whose names begin so are its own.
  std::string_view own_arrays = {};
  /// MeshData::variant of a mesh whose deck it can write.
  std::string_view deck = {};
};

constexpr unsigned kNamesOfTriangles = 1U << 2;
constexpr unsigned kNamesOfElements = 14;
constexpr unsigned kAllNames = 15;

struct Codec {
  MeshData (*read)(const std::filesystem::path&, const formats::ReadRequest&);
  void (*write)(const std::filesystem::path&, const MeshView&);
  Room room;
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

constexpr std::array<MeshFormat, 12> kFormatsTable = {{{"MEDIT ASCII", ".mesh"},
                                                       {"MEDIT binary", ".meshb"},
                                                       {"TetGen", ".node"},
                                                       {"TetGen", ".ele"},
                                                       {"legacy VTK", ".vtk"},
                                                       {"VTK XML", ".vtu"},
                                                       {"Gmsh", ".msh"},
                                                       {"SU2", ".su2"},
                                                       {"Netgen", ".vol"},
                                                       {"Nastran", ".bdf"},
                                                       {"Nastran", ".nas"},
                                                       {"Elmer", ".header"}}};

constexpr Room kNastranRoom = {.others = true,
                               .required_vertices = false,
                               .point_labels = false,
                               .edges = false,
                               .holds = formats::nastran_holds,
                               .low_labels = false,
                               .deck = formats::kNastran};

// In the order of formats_table.
constexpr std::array<Codec, 12> kCodecs = {
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
     {read_plain<formats::read_su2>,
      formats::write_su2,
      {.others = true,
       .point_labels = false,
       .tet_labels = false,
       .edges = false,
       .holds = formats::su2_holds,
       .named_labels = kNamesOfTriangles,
       .deck = formats::kSu2}},
     {read_plain<formats::read_netgen>,
      formats::write_netgen,
      {.others = true,
       .point_labels = false,
       .holds = formats::netgen_holds,
       .named_labels = kAllNames,
       .periodic = true,
       .own_arrays = "netgen:",
       .deck = formats::kNetgen}},
     {read_plain<formats::read_nastran>, formats::write_nastran, kNastranRoom},
     {read_plain<formats::read_nastran>, formats::write_nastran, kNastranRoom},
     {read_plain<formats::read_elmer>,
      formats::write_elmer,
      {.others = true,
       .point_labels = false,
       .holds = formats::elmer_holds,
       .named_labels = kNamesOfElements}}}};

/// Of "part.vtu.gz" that is ".vtu". A mesh of TetGen or Elmer is several files, which nobody packs
/// one by one.
const Codec& find_codec(const std::filesystem::path& file) {
  const bool is_packed = file.extension() == ".gz";
  std::string extension = (is_packed ? file.stem() : file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string valid;
  for (std::size_t i = 0; i < kFormatsTable.size(); ++i) {
    const bool is_set = kFormatsTable[i].name == "TetGen" || kFormatsTable[i].name == "Elmer";
    if (kFormatsTable[i].extension == extension && !(is_packed && is_set)) return kCodecs[i];
    valid += valid.empty() ? "" : ", ";
    valid += kFormatsTable[i].extension;
  }
  throw Error(fmt::format("{}: the extension '{}' is not that of a mesh format: expected one of {}",
                          file.string(), file.extension().string(), valid));
}

/// The sentences of not_written().
struct LostNotes {
  explicit LostNotes(std::string of_format) : extension(std::move(of_format)) {}

  void arrays(std::string_view of, const std::vector<DataArray>& list, std::string_view own) {
    for (const DataArray& array : list) {
      if (!own.empty() && array.name.starts_with(own)) continue;
      sentences.push_back(fmt::format("the array '{}' of {} is not kept: {} holds none", array.name,
                                      of, extension));
    }
  }
  void lost(bool held, std::size_t count, std::string_view what) {
    if (held || count == 0) return;
    sentences.push_back(
        fmt::format("{} {} not kept: {} has no place for them", count, what, extension));
  }

  std::string extension;
  std::vector<std::string> sentences;
};

/// How many labels tets have; 0 if they are all the same: nothing is told apart by them.
std::size_t several_labels(const std::vector<MeshData::Tet>& tets) {
  std::set<Label> labels;
  for (const MeshData::Tet& tet : tets) {
    if (labels.empty() || tet.label != *labels.begin()) labels.insert(tet.label);
  }
  return labels.size() > 1 ? labels.size() : 0;
}

/// Labels of points that are not 0.
std::size_t several_labels(const MeshData& mesh) {
  const auto zeros = std::count(mesh.point_labels.begin(), mesh.point_labels.end(), 0);
  return mesh.point_labels.size() - static_cast<std::size_t>(zeros);
}

/// Different labels below 1; 0 alone is the absence of labels.
std::size_t low_labels(const MeshData& mesh) {
  std::set<Label> labels;
  const auto add = [&](const auto& elements) {
    for (const auto& element : elements) {
      if (element.label < 0) labels.insert(element.label);
    }
  };
  add(mesh.tets);
  add(mesh.triangles);
  return labels.size();
}

/// Groups with a name; one without is a label.
std::size_t lost_groups(const MeshData& mesh, const Room& room) {
  std::set<const Group*> kept;
  if (room.named_labels != 0 && !mesh.groups.empty()) {
    const formats::LabelNames names(mesh);
    for (int dimension = 1; dimension < 4; ++dimension) {
      if ((room.named_labels >> dimension & 1U) == 0) continue;
      for (const auto& [label, group] : names.named(dimension)) kept.insert(group);
    }
  }
  const bool keeps_points = (room.named_labels & 1U) != 0;
  const auto is_lost = [&](const Group& group) {
    if (keeps_points && group.dimension == 0 && group.number > 0) return false;
    const bool is_mark = std::any_of(formats::kMeditMarks.begin(), formats::kMeditMarks.end(),
                                     [&](const auto& mark) { return mark.section == group.name; });
    return !group.name.empty() && !(is_mark && room.marks) && !kept.contains(&group);
  };
  return static_cast<std::size_t>(std::count_if(mesh.groups.begin(), mesh.groups.end(), is_lost));
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
  const Room& room = find_codec(file).room;
  LostNotes notes(file.extension().string());
  if (!room.data) {
    notes.arrays("points", mesh.point_data, room.own_arrays);
    notes.arrays("tets", mesh.tet_data, room.own_arrays);
    notes.arrays("triangles", mesh.triangle_data, room.own_arrays);
    notes.arrays("edges", mesh.edge_data, room.own_arrays);
  }
  for (const OtherElements& others : mesh.other_elements) {
    const bool held = room.others && (room.holds == nullptr || room.holds(others.vtk_type));
    notes.lost(held, others.labels.size(),
               fmt::format("elements of VTK's type {} are", others.vtk_type));
  }
  notes.lost(room.edges, mesh.edges.size(), "edges are");
  notes.lost(room.tet_labels, several_labels(mesh.tets), "labels of tets are");
  notes.lost(room.low_labels, low_labels(mesh), "labels below 1 are");
  notes.lost(room.point_labels, several_labels(mesh), "labels of points are");
  notes.lost(room.groups, lost_groups(mesh, room), "groups, with their names, are");
  const bool by_labels = !are_finer_than_labels(mesh.tets, mesh.tet_parts) &&
                         !are_finer_than_labels(mesh.triangles, mesh.triangle_parts) &&
                         !are_finer_than_labels(mesh.edges, mesh.edge_parts);
  notes.lost(room.groups || by_labels, mesh.entities.size(), "entities of the geometry are");
  notes.lost(room.groups || room.periodic, mesh.periodic.size(), "periodic links are");
  notes.lost(room.required_vertices || (!room.deck.empty() && room.deck == mesh.variant),
             mesh.required_vertices.size(), "required vertices are");
  notes.lost(room.deck == mesh.variant, mesh.deck.size(),
             "pieces of a deck, all that is no mesh, are");
  return std::move(notes.sentences);
}

void write_mesh(const std::filesystem::path& file, const MeshData& mesh) {
  assert(mesh.point_labels.empty() || mesh.point_labels.size() == mesh.points.size());
  write_mesh(file, MeshView(mesh));
}

void write_mesh(const std::filesystem::path& file, const MeshView& mesh) {
  find_codec(file).write(file, mesh);
}

}  // namespace tetmend
