// SPDX-License-Identifier: MIT
// An operator of a program, which does what flip_3_2 does.
#pragma once

#include <tetmend/improve.h>

namespace tetmend::test {

/// Three tets of an edge become two.
inline kernel::Verdict flip_to_two(const kernel::TetMesh& look, kernel::TetEdge e,
                                   kernel::Proposal& out) {
  const kernel::Ring r = look.ring(e);
  if (!r.closed || r.tets.size() != 3) return kernel::Verdict::not_applicable;
  const auto& p = r.vertices;
  return out.replace(r.tets, {{r.a, p[0], p[1], p[2]}, {p[0], p[1], p[2], r.b}});
}

}  // namespace tetmend::test
