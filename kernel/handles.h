// SPDX-License-Identifier: MIT
// Typed indices into a tetrahedral mesh. Handles of different kinds neither convert nor compare.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <type_traits>

#include <tetmend/api.h>

namespace tetmend {

/// A 32-bit index of one kind of entity. Default-constructed handles are invalid.
template <class Tag>
class TETMEND_API Handle {
 public:
  static constexpr std::uint32_t kInvalid = 0xFFFFFFFFu;

  constexpr Handle() = default;
  constexpr explicit Handle(std::uint32_t index) : index_(index) {}
  constexpr std::uint32_t index() const { return index_; }
  constexpr bool is_valid() const { return index_ != kInvalid; }
  friend constexpr auto operator<=>(const Handle&, const Handle&) = default;

 private:
  std::uint32_t index_ = kInvalid;
};

using VertexHandle = Handle<struct VertexTag>;
using TetHandle = Handle<struct TetTag>;

using TetVertices = std::array<VertexHandle, 4>;  ///< in positive order

static_assert(!std::is_convertible_v<VertexHandle, TetHandle>);
static_assert(!std::is_invocable_v<std::equal_to<>, VertexHandle, TetHandle>);

// Numbering inside a tet (v0, v1, v2, v3) of positive volume: (v1-v0) . ((v2-v0) x (v3-v0)) > 0.
// Face f lies opposite vertex f; its vertices are listed counterclockwise as seen from outside.
// Edge e joins two vertices, edge 5 - e the other two.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kFaceVertices = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> kEdgeVertices = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
/// kEdgeOf[i][j]: the edge that joins local vertices i and j.
inline constexpr std::array<std::array<std::uint8_t, 4>, 4> kEdgeOf = {
    {{9, 0, 1, 2}, {0, 9, 3, 4}, {1, 3, 9, 5}, {2, 4, 5, 9}}};

/// One side of a face: face f of tet t, coded 4 t + f. Codes with the top bit set stand for the
/// outside of the mesh and carry the number of a boundary triangle instead.
class TETMEND_API HalfFace {
 public:
  constexpr HalfFace() = default;
  constexpr HalfFace(TetHandle tet, unsigned face) : code_(4 * tet.index() + face) {}
  static constexpr HalfFace from_code(std::uint32_t code) { return HalfFace(code); }
  static constexpr HalfFace outside(std::uint32_t surface_triangle) {
    return HalfFace(kOutside | surface_triangle);
  }

  constexpr std::uint32_t code() const { return code_; }
  constexpr bool is_outside() const { return (code_ & kOutside) != 0; }
  /// Precondition for the next two: not outside.
  constexpr TetHandle tet() const { return TetHandle(code_ >> 2); }
  constexpr unsigned face() const { return code_ & 3u; }
  /// Precondition: outside. Index into TetMesh::surface_triangles().
  constexpr std::uint32_t surface_triangle() const { return code_ & ~kOutside; }
  friend constexpr auto operator<=>(const HalfFace&, const HalfFace&) = default;

 private:
  static constexpr std::uint32_t kOutside = 0x80000000u;
  constexpr explicit HalfFace(std::uint32_t code) : code_(code) {}
  std::uint32_t code_ = 0xFFFFFFFFu;
};

/// An edge named by a tet that contains it: edge e of tet t. The shell of the edge is found without
/// a search.
class TETMEND_API TetEdge {
 public:
  constexpr TetEdge() = default;
  constexpr TetEdge(TetHandle tet, unsigned edge) : code_(6 * tet.index() + edge) {}
  static constexpr TetEdge from_code(std::uint32_t code) {
    TetEdge result;
    result.code_ = code;
    return result;
  }
  constexpr std::uint32_t code() const { return code_; }
  constexpr TetHandle tet() const { return TetHandle(code_ / 6); }
  constexpr unsigned edge() const { return code_ % 6; }
  friend constexpr auto operator<=>(const TetEdge&, const TetEdge&) = default;

 private:
  std::uint32_t code_ = 0xFFFFFFFFu;
};

}  // namespace tetmend
