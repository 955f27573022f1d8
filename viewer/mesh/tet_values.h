// SPDX-License-Identifier: MIT
// Numbers that belong to each tet of a mesh: values of a quality measure, distances from the
// boundary.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/quality.h"
#include "kernel/tet_mesh.h"
#include "viewer/mesh/histogram.h"

namespace tetmend::viewer {

/// The measure of every tet, by slot; not a number for deleted slots. Cost: one evaluation a tet.
std::vector<float> measure_tets(const TetMesh& mesh, const QualityMeasure& measure);

/// The range that histograms and colours of a measure cover: 0 to the value of the regular tet.
Range display_range(const QualityMeasure& measure);

/// How many tets lie between a tet and the boundary, by slot: 0 for tets with a boundary face.
/// Cost: linear.
std::vector<std::uint32_t> distances_from_boundary(const TetMesh& mesh);

/// The `count` tets of least value, worst first, in the order of their numbers among equals; those
/// that are not a number are left out. Cost: linear, and count log count.
std::vector<TetHandle> worst_tets(std::span<const float> values, std::size_t count);

/// All labels of tets, ascending. Cost: linear.
std::vector<Label> region_labels(const TetMesh& mesh);

}  // namespace tetmend::viewer
