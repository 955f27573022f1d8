// SPDX-License-Identifier: MIT
// Numbers that belong to each tet of a mesh: values of a quality measure, distances from the
// boundary.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "kernel/quality.h"
#include "kernel/tet_mesh.h"
#include "viewer/mesh/histogram.h"

namespace tetmend::viewer {

/// What tets can be coloured, listed and filtered by.
struct TetValue {
  std::string_view name;
  std::string_view help;                    ///< one line
  const QualityMeasure* measure = nullptr;  ///< null: the quality that the mesh stores
  /// That histograms and colours cover: 0 to the value of the regular tet; for the quality that the
  /// mesh stores, with the goal in the middle.
  Range range;
  std::string_view unit = {};

  /// For people: "min angle, degrees".
  std::string title() const;
};

/// The quality by the standard of the mesh, which is the default; then all measures.
std::span<const TetValue> tet_values();
/// @throws Error for an unknown name, with the valid ones.
const TetValue& find_tet_value(std::string_view name);

/// Not a number for a deleted slot.
float evaluate_tet(const TetMesh& mesh, const TetValue& value, TetHandle t);
/// Of every tet, by slot; not a number for deleted slots. Cost: at most one evaluation a tet.
std::vector<float> evaluate_tets(const TetMesh& mesh, const TetValue& value);

/// How many tets lie between a tet and the boundary, by slot: 0 for tets with a boundary face.
/// Cost: linear.
std::vector<std::uint32_t> distances_from_boundary(const TetMesh& mesh);

/// The `count` tets of least value, worst first, in the order of their numbers among equals; those
/// that are not a number are left out. Cost: linear, and count log count.
std::vector<TetHandle> worst_tets(std::span<const float> values, std::size_t count);

/// All labels of tets, ascending. Cost: linear.
std::vector<Label> region_labels(const TetMesh& mesh);

}  // namespace tetmend::viewer
