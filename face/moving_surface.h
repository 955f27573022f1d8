// SPDX-License-Identifier: MIT
// Options::surface, read; and what it makes of a mesh.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tetmend/improve.h>

#include "envelope/envelope.h"
#include "kernel/surface_guard.h"
#include "kernel/tet_mesh.h"

namespace tetmend::face {

/// How far the surface may move.
class SurfaceTolerance {
 public:
  /// @throws OptionError for a text that is neither empty nor flat nor a share nor a length, and for
  /// an angle that is none
  explicit SurfaceTolerance(const Options& options);

  bool is_fixed() const { return is_fixed_; }
  /// Nothing but what changes no shape.
  bool is_flat() const { return !is_fixed_ && share_ == 0 && length_ == 0; }
  /// The same for an envelope; a length as the file has it. Precondition: not fixed.
  EnvelopeOptions envelope_options() const {
    return {.share = share_, .length = length_, .angle = feature_angle_};
  }
  /// @param diagonal of the box around the mesh, as the file has lengths
  /// @throws OptionError for a length above 5 % of it, unless it is marked as meant: often its percent
  /// sign is missing
  void check_length(double diagonal) const;
  /// What decides about changes of the surface of a mesh that was just built of `input`. Points that
  /// the file pairs with others or marks stay (kept_points.h). Precondition: not fixed; frozen tets are marked.
  /// @throws OptionError for a mesh whose surface must not move: one of second order; as check_length()
  std::unique_ptr<SurfaceGuard> guard(const TetMesh& mesh, const MeshData& input) const;

  /// Of the mesh when it got its guard.
  static SurfaceChange measure_before(const TetMesh& mesh);
  /// Fills in the rest. Cost: linear, apart from samples where the surface has changed.
  static void measure_after(const TetMesh& mesh, SurfaceChange& change);

 private:
  bool is_fixed_ = true;
  double share_ = 0;       // of the lengths of edges
  double length_ = 0;      // as the file has lengths
  bool is_meant_ = false;  // 1!
  double feature_angle_ = 40;
};

}  // namespace tetmend::face
