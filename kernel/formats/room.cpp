// SPDX-License-Identifier: MIT
#include "kernel/formats/room.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "kernel/formats/cgns.h"
#include "kernel/formats/element_kinds.h"
#include "kernel/formats/exodus.h"
#include "kernel/formats/label_names.h"
#include "kernel/formats/med.h"
#include "kernel/formats/medit_marks.h"
#include "kernel/formats/medit_vectors.h"
#include "kernel/formats/nastran.h"
#include "kernel/formats/unv.h"
#include "kernel/formats/vtk_roles.h"
#include "kernel/formats/xdmf.h"
#include "kernel/parts.h"
#include "kernel/printable.h"
#include "kernel/second_order.h"

namespace tetmend::formats {
namespace {

struct LostNotes {
  explicit LostNotes(std::string of_format) : extension(std::move(of_format)) {}

  void arrays(std::string_view of, const std::vector<DataArray>& list, const Room& room) {
    for (const DataArray& array : list) {
      if (!room.own_arrays.empty() && array.name.starts_with(room.own_arrays)) continue;
      if (room.marks && of == "points" && is_medit_vectors(array.name)) continue;
      sentences.push_back(fmt::format("the array '{}' of {} is not kept: {} holds none",
                                      printable(array.name), of, extension));
    }
  }
  /// Of XML.
  void text_names(std::string_view of, const std::vector<DataArray>& list) {
    for (const DataArray& array : list) {
      if (is_printable(array.name)) continue;
      sentences.push_back(
          fmt::format("the name of the array '{}' of {} is not kept as it is: {} "
                      "has text alone",
                      printable(array.name), of, extension));
    }
  }
  void repeated_names(std::string_view of, const std::vector<DataArray>& list) {
    std::set<std::string_view> names;
    for (const DataArray& array : list) {
      if (names.insert(array.name).second) continue;
      sentences.push_back(
          fmt::format("the second array '{}' of {} is not kept: {} has one of a name",
                      printable(array.name), of, extension));
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

/// How many labels volumes have; 0 if they are all the same: nothing is told apart by them.
std::size_t several_volume_labels(const MeshData& mesh) {
  std::set<Label> labels;
  const auto add = [&](Label label) {
    if (labels.empty() || label != *labels.begin()) labels.insert(label);
  };
  for (const MeshData::Tet& tet : mesh.tets) add(tet.label);
  for (const OtherElements& others : mesh.other_elements) {
    const ElementKind* kind = element_kind(others.vtk_type);
    if (kind == nullptr || kind->dimension != 3) continue;
    std::for_each(others.labels.begin(), others.labels.end(), add);
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

/// Have some elements of a dimension a label, and others none?
bool lacks_labels(const MeshData& mesh) {
  const auto lacks = [](const auto& elements) {
    const auto is_none = [](const auto& element) { return element.label == 0; };
    return std::any_of(elements.begin(), elements.end(), is_none) &&
           !std::all_of(elements.begin(), elements.end(), is_none);
  };
  return lacks(mesh.tets) || lacks(mesh.triangles);
}

bool is_medits(const Group& group) {
  return is_medit_vectors(group.name) ||
         std::any_of(kMeditMarks.begin(), kMeditMarks.end(),
                     [&](const MeditMark& mark) { return mark.section == group.name; });
}

/// Groups with a name, which the format keeps; one without is a label.
std::vector<const Group*> kept_groups(const MeshData& mesh, const Room& room) {
  std::set<const Group*> whole;
  if (room.named_labels != 0 && !mesh.groups.empty()) {
    const LabelNames names(mesh);
    for (int dimension = 1; dimension < 4; ++dimension) {
      if ((room.named_labels >> dimension & 1U) == 0) continue;
      for (const auto& [label, group] : names.named(dimension)) whole.insert(group);
    }
  }
  const bool keeps_points = (room.named_labels & 1U) != 0;
  std::vector<const Group*> kept;
  for (const Group& group : mesh.groups) {
    if (group.name.empty()) continue;
    if (group.dimension == 1 && !room.edges) continue;
    const bool is_point_group = keeps_points && group.dimension == 0 && group.number > 0;
    if (room.groups || is_point_group || (room.marks && is_medits(group)) ||
        whole.contains(&group)) {
      kept.push_back(&group);
    }
  }
  return kept;
}

/// Groups that are lost, and names that the writer has to change.
void note_groups(const Room& room, const MeshData& mesh, LostNotes& notes) {
  const std::vector<const Group*> kept = kept_groups(mesh, room);
  const auto named = std::count_if(mesh.groups.begin(), mesh.groups.end(),
                                   [](const Group& group) { return !group.name.empty(); });
  notes.lost(false, static_cast<std::size_t>(named) - kept.size(), "groups, with their names, are");
  std::set<std::pair<int, std::string_view>> names;
  std::size_t twice = 0;
  for (const Group* group : kept)
    twice += names.insert({group->dimension, group->name}).second ? 0 : 1;
  if (room.group_names_are_unique && twice > 0) {
    notes.sentences.push_back(fmt::format("{} names of groups get a number: {} has each name once",
                                          twice, notes.extension));
  }
  const bool is_own = !room.deck.empty() && room.deck == mesh.variant;  // its names are good
  if (room.takes_name == nullptr || is_own) return;
  const auto is_changed = [&](const Group* group) { return !room.takes_name(group->name); };
  const auto first = std::find_if(kept.begin(), kept.end(), is_changed);
  if (first == kept.end()) return;
  notes.sentences.push_back(fmt::format(
      "names of groups are not kept as they are: {} has other rules for {} of them, "
      "the first is '{}'",
      notes.extension, std::count_if(first, kept.end(), is_changed), printable((*first)->name)));
}

/// Triangles and edges, of a mesh whose tets are of second order.
std::size_t of_first_order(const MeshData& mesh) {
  if (mesh.mid_nodes.empty()) return 0;
  const MidNodes nodes(mesh.mid_nodes);
  const auto count = [&](const auto& elements) {
    return std::count_if(elements.begin(), elements.end(),
                         [&](const auto& element) { return nodes.of(element.vertices).empty(); });
  };
  return static_cast<std::size_t>(count(mesh.triangles) + count(mesh.edges));
}

/// What another format cannot take of them; the rest means nothing there.
std::size_t deck_pieces_to_miss(const MeshData& mesh) {
  if (mesh.variant == kMed) return med_remarks_to_miss(mesh);
  if (mesh.variant == kExodus) return exodus_pieces_to_miss(mesh);
  if (mesh.variant == kCgns) return cgns_pieces_to_miss(mesh);
  if (mesh.variant == kNastran) return nastran_pieces_to_miss(mesh);
  if (mesh.variant == kXdmf) return 0;
  if (mesh.variant == kUnv) return unv_pieces_to_miss(mesh);
  return mesh.deck.size();
}

}  // namespace

bool is_word(std::string_view name) {
  return !name.empty() && std::none_of(name.begin(), name.end(), [](char c) {
    return c == '#' || c == '%' || c == '=' || static_cast<unsigned char>(c) <= ' ';
  });
}

std::vector<std::string> lost_in(const Room& room, const std::string& extension,
                                 const MeshData& mesh) {
  LostNotes notes(extension);
  const auto has_data = [&](int dimension) {
    return room.data && (room.data_of >> dimension & 1U) != 0;
  };
  if (!has_data(0)) notes.arrays("points", mesh.point_data, room);
  if (!has_data(3)) notes.arrays("tets", mesh.tet_data, room);
  if (!has_data(2)) notes.arrays("triangles", mesh.triangle_data, room);
  if (!has_data(1)) notes.arrays("edges", mesh.edge_data, room);
  if (room.names_are_text) {
    notes.text_names("points", mesh.point_data);
    notes.text_names("tets", mesh.tet_data);
    notes.text_names("triangles", mesh.triangle_data);
    notes.text_names("edges", mesh.edge_data);
  }
  if (room.names_are_unique) {
    notes.repeated_names("points", mesh.point_data);
    notes.repeated_names("tets", mesh.tet_data);
    notes.repeated_names("triangles", mesh.triangle_data);
    notes.repeated_names("edges", mesh.edge_data);
  }
  for (const OtherElements& others : mesh.other_elements) {
    const bool held = room.others && (room.holds == nullptr || room.holds(others.vtk_type));
    notes.lost(held, others.labels.size(),
               fmt::format("elements of VTK's type {} are", others.vtk_type));
    const ElementKind* kind = element_kind(others.vtk_type);
    if (held && room.data && kind != nullptr && !has_data(kind->dimension))
      notes.arrays(kind->name, others.data, room);
  }
  const bool has_deck = !room.deck.empty() && room.deck == mesh.variant;
  const bool by_labels = !are_finer_than_labels(mesh.tets, mesh.tet_parts) &&
                         !are_finer_than_labels(mesh.triangles, mesh.triangle_parts) &&
                         !are_finer_than_labels(mesh.edges, mesh.edge_parts);
  notes.lost(room.edges, mesh.edges.size(), "edges are");
  notes.lost(room.tet_labels, several_volume_labels(mesh), "labels of tets are");
  notes.lost(room.low_labels, low_labels(mesh), "labels below 1 are");
  if (!room.absent_labels && !has_deck && lacks_labels(mesh)) {
    notes.sentences.push_back(fmt::format(
        "elements without a label beside others get one: {} has no label 0", extension));
  }
  notes.lost(room.point_labels, several_labels(mesh), "labels of points are");
  note_groups(room, mesh, notes);
  const bool has_geometry = room.groups && room.geometry;
  notes.lost(has_geometry || by_labels, mesh.entities.size(), "entities of the geometry are");
  notes.lost(has_geometry || room.periodic, mesh.periodic.size(), "periodic links are");
  notes.lost(room.second_order, mesh.mid_nodes.size(), "mid-side nodes of curved elements are");
  if (!room.both_orders) {
    notes.lost(false, of_first_order(mesh), "triangles and edges without nodes between are");
  }
  notes.lost(room.required_vertices || has_deck, mesh.required_vertices.size(),
             "required vertices are");
  notes.lost(has_deck || has_only_roles(mesh), deck_pieces_to_miss(mesh),
             "pieces of a deck, all that is no mesh, are");
  notes.lost(has_deck || mesh.variant != kExodus, exodus_numbers_to_miss(mesh),
             "numbers of blocks and sets that others have, too, are");
  return std::move(notes.sentences);
}

}  // namespace tetmend::formats
