// SPDX-License-Identifier: MIT
// One attempt at one place: to look at it, or to repeat what a trace shows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "schedule/composition.h"
#include "schedule/run.h"

namespace tetmend {

struct SingleAttempt {
  Composition what;  ///< an operator or a sequence
  /// Of the target; numbers as in MeshView(mesh), so at first those of the mesh's file.
  std::vector<std::uint32_t> vertices;
  /// Of the tet that names the target; empty: any. Operators start their walks there, so what they
  /// try in which order may depend on it.
  std::vector<std::uint32_t> tet = {};
};

/// A pass of one attempt. If several tets may name the target, it is one that lists the vertices in
/// the order given, where there is one.
/// @throws Error for an unknown operator or parameter, a vertex that does not exist, or when no
/// tet, edge, face or vertex is made up of the vertices. Cost: linear in the mesh.
void attempt_once(Run& run, const SingleAttempt& options);

/// The same, at what these vertices make up. Cost: that of the attempt and of a pass.
void attempt_at(Run& run, const Composition& what, std::span<const VertexHandle> vertices);

}  // namespace tetmend
