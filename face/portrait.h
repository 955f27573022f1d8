// SPDX-License-Identifier: MIT
// What a picture of a run needs: the surface, and the bad tets before and after.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <tetmend/improve.h>
#include <tetmend/measure.h>

#include "kernel/mesh_data.h"
#include "kernel/ruler_histogram.h"
#include "kernel/tet_mesh.h"

namespace tetmend::face {

/// A tet to be drawn. Lengths are those of the file.
struct DrawnTet {
  std::array<Point, 4> corners;
  std::array<bool, 4> is_free{};  ///< of each corner: it may move
  BadTet facts;
};

/// Of one run of improve(). The surface is the same before and after.
struct Portrait {
  std::vector<Point> points;                            ///< of the surface
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of the boundary, seen from outside
  std::vector<Label> labels;                            ///< of the tet at each triangle
  /// Between tets of different labels: each once, seen from the second.
  std::vector<std::array<std::uint32_t, 3>> walls;
  std::vector<std::array<Label, 2>> wall_labels;  ///< of the tets behind and in front
  std::vector<DrawnTet> bad_before;               ///< the worst first; why is not known
  std::vector<DrawnTet> bad_after;                ///< the worst first
  bool are_reasons_known = false;                 ///< of `bad_after`; not if interrupted
  std::optional<RulerHistograms> rulers_before, rulers_after;

  /// Takes the surface, the bad tets and the histograms of the input.
  /// @param rulers of the mesh; may be nothing
  void draw_before(const TetMesh& mesh, const std::optional<MeshRulers>& rulers);
  /// The same of the improved mesh; what was drawn of it earlier is gone.
  /// @param hindrances why each bad tet is there; empty: not known
  void draw_after(const TetMesh& mesh,
                  const std::vector<std::pair<TetHandle, Hindrance>>& hindrances,
                  const std::optional<MeshRulers>& rulers);

 private:
  MeshRulers means_;  // of the mesh before: for the bins of both
};

/// Gives the bad tets after the run the numbers that the file of the mesh has, where it has its own.
void number_tets(Portrait& portrait, const Mesh& mesh);

}  // namespace tetmend::face
