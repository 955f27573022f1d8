// SPDX-License-Identifier: MIT
// What an attempt is aimed at.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <tetmend/api.h>

#include "kernel/handles.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

enum class TargetKind : std::uint8_t { tet, edge, face, vertex };

/// What an attempt is aimed at: a handle and its kind.
struct TETMEND_API Target {
  TargetKind kind;
  std::uint32_t code;

  static Target of(TetHandle t) { return {TargetKind::tet, t.index()}; }
  static Target of(TetEdge e) { return {TargetKind::edge, e.code()}; }
  static Target of(HalfFace f) { return {TargetKind::face, f.code()}; }
  static Target of(VertexHandle v) { return {TargetKind::vertex, v.index()}; }
  /// Precondition of each: the kind is right.
  TetHandle tet() const { return TetHandle(code); }
  TetEdge edge() const { return TetEdge::from_code(code); }
  HalfFace face() const { return HalfFace::from_code(code); }
  VertexHandle vertex() const { return VertexHandle(code); }
};

/// The vertices of a target, which outlive its handle: 1 of a vertex, 2 of an edge, 3 of a face, 4
/// of a tet.
class TETMEND_API TargetVertices {
 public:
  TargetVertices(const TetMesh& mesh, Target target);
  std::span<const VertexHandle> all() const { return {vertices_.data(), count_}; }

 private:
  std::array<VertexHandle, 4> vertices_;
  std::size_t count_ = 0;
};

}  // namespace tetmend
