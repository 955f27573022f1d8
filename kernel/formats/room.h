// SPDX-License-Identifier: MIT
// What a format can hold of a mesh, and what is lost in it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// What of a MeshData a format can hold besides points, tets and triangles.
struct Room {
  bool data = false;      ///< named arrays
  unsigned data_of = 15;  ///< where it has them: 1 << dimension of the elements
  bool groups = false;    ///< with names and parts
  bool geometry = true;   ///< with groups, also entities and periodic links
  bool others = false;    ///< elements of other kinds
  bool required_vertices = false;
  bool second_order = false;       ///< as elements of other kinds
  bool second_order_edges = true;  ///< else only in a mesh with a deck of the format
  bool both_orders = true;         ///< triangles and edges of first order beside tets of second
  bool marks = false;              ///< groups of the names of kMeditMarks, and kMeditVectors
  bool point_labels = true;
  bool tet_labels = true;
  bool edges = true;
  /// Which kinds of other elements; null: all, if any.
  bool (*holds)(int vtk_type) = nullptr;
  /// Dimensions of groups whose names it keeps if they have all elements of a label: 1 << 2.
  unsigned named_labels = 0;
  /// Which names it takes as they are; null: all.
  bool (*takes_name)(std::string_view name) = nullptr;
  bool names_are_text = false;    ///< of arrays: printable()
  bool names_are_unique = false;  ///< of arrays of one kind of element: it has the first of a name
  bool group_names_are_unique = false;  ///< of one dimension: others get a number behind them
  bool periodic = false;
  bool low_labels = true;     ///< below 0
  bool absent_labels = true;  ///< 0, beside others
  /// Arrays whose names begin so are its own.
  std::string_view own_arrays = {};
  /// MeshData::variant of a mesh whose deck it can write.
  std::string_view deck = {};
};

inline constexpr unsigned kDataOfVolumes = 9;  // and points
inline constexpr unsigned kDataOfAllButFaces = 11;
inline constexpr unsigned kNamesOfTriangles = 1U << 2;
inline constexpr unsigned kNamesOfElements = 14;
inline constexpr unsigned kAllNames = 15;

/// What the variant of a file costs, and what else is to be said of it, one sentence each.
struct FormNotes {
  std::vector<std::string> lost;
  std::vector<std::string> remarks;  ///< nothing is lost, but not all programs read it
};

/// A name of one word without signs that open comments or values.
bool is_word(std::string_view name);

/// What of `mesh` is lost, one sentence each. `extension` is what the sentences call the format.
std::vector<std::string> lost_in(const Room& room, const std::string& extension,
                                 const MeshData& mesh);

}  // namespace tetmend::formats
