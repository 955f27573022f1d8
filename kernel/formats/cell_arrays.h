// SPDX-License-Identifier: MIT
// Arrays that a file gives over all of its cells: which of them holds the labels, and how the others
// go to tets, triangles, edges and other elements. The same for arrays over points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// By kind, and in the order in which MeshData has them: the numbers of the cells in the file.
struct CellNumbers {
  std::vector<std::uint32_t> tets, triangles, edges;
  std::vector<std::vector<std::uint32_t>> others;  ///< for each of MeshData::other_elements
};

/// What decides whether an array of cells holds labels. The questions are asked if need be.
struct ArrayFacts {
  std::string name;
  std::size_t components = 1;
  bool is_integral = false;
  std::function<bool()> has_fractions;      ///< also NaN
  std::function<bool()> looks_like_labels;  ///< see is_few_labels()
  std::function<bool()> is_constant;
};

/// True for an array with so many different numbers of `size`: more would be numbers of cells, not of
/// regions.
bool is_few_labels(std::size_t different, std::size_t size);
/// More than these need not be counted for that.
inline constexpr std::size_t kMostLabels = 1000;

/// What tells regions apart.
struct RegionArrays {
  std::optional<std::size_t> labels;  ///< the array that holds labels; nothing: none does
  /// Where several could: a face between different values of any of them stays.
  std::vector<std::size_t> parts;
};
/// @param wanted the name of the array of labels, see LabelChoice
/// @throws Error for a wanted array that is not there
RegionArrays choose_region_arrays(const std::vector<ArrayFacts>& arrays, const std::string& wanted,
                                  std::vector<std::string>& notes);
/// Whether an array of points of that name has their labels, if it is of integers.
bool is_point_label_array(std::string_view name);

/// @throws Error, about value `i` of array `array`
using ArrayFailure = std::function<void(std::size_t array, std::size_t i, std::string_view reason)>;

/// How readers are told which array holds the labels of cells.
struct LabelChoice {
  std::string wanted;  ///< its name; empty: a name that mesh tools use, or the only one of integers
  ArrayFailure fail;
};

/// Gives labels and data to the elements of `mesh`. An array of a known name that holds fractions is
/// data: a "material" may be a density.
/// @throws Error for labels that are no integers of 32 bits, where an array was asked for or its
/// type is one of integers; for a wanted array that is not there
void adopt_cell_arrays(MeshData& mesh, std::vector<DataArray> arrays, const CellNumbers& numbers,
                       const LabelChoice& choice);
/// The same for points. Only CellEntityIds and medit:ref are labels, as MEDIT files have them.
void adopt_point_arrays(MeshData& mesh, std::vector<DataArray> arrays, const ArrayFailure& fail);

/// All arrays of the elements of `mesh` by name, for formats that have one array over all cells:
/// tets, triangles, edges and others in this order. Where a kind of element has no such array, its
/// cells get 0 (integers) or NaN. Of several alike in one kind each is joined with one of the
/// others, in their order.
std::vector<DataArray> join_cell_arrays(const MeshData& mesh);

/// The rows of an array with these numbers, in this order.
DataArray selected_rows(const DataArray& array, std::span<const std::uint32_t> rows);

/// A number of an array, whatever its type.
double real_value(const DataArray& array, std::size_t i);

}  // namespace tetmend::formats
