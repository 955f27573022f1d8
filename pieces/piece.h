// SPDX-License-Identifier: MIT
// A piece of a mesh between two divisions: plain arrays, ready for memory, a file or a message.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::pieces {

/// What a vertex is called in all pieces. Vertices of the file have their number there; those that
/// were added follow.
using VertexId = std::uint64_t;

/// Marks of a vertex.
inline constexpr std::uint8_t kRequired = 1;  ///< must neither move nor vanish
inline constexpr std::uint8_t kOwn = 2;       ///< of this piece, not of a neighbour
inline constexpr std::uint8_t kBorder = 4;    ///< of a tet that was shared in the last division
/// Of a surface that may move a corner. In slices: a vertex that is to be one.
inline constexpr std::uint8_t kCorner = 8;
inline constexpr std::uint8_t kSent = 16;  ///< tets around it were sent to the part that it lies in
/// Not sent, but of a tet that was: other pieces have it, too.
inline constexpr std::uint8_t kSeam = 32;
inline constexpr std::uint8_t kMoved = 64;  ///< is no more where the file has it
/// In slices: of a surface that may move, what lies between such vertices stays.
inline constexpr std::uint8_t kHeld = 128;
/// Marks that a vertex never loses.
inline constexpr std::uint8_t kLasting = kRequired | kCorner | kMoved | kHeld;

inline bool is_own(std::uint8_t marks) {
  return (marks & kOwn) != 0;
}

struct PieceTet {
  std::array<std::uint32_t, 4> vertices{};  ///< in the piece
  Label label = 0;
  std::uint32_t origin = kNone;  ///< number in the file; with kProtected where it must stay

  static constexpr std::uint32_t kProtected = 0x80000000u;
  static constexpr std::uint32_t kNone = 0x7FFFFFFFu;
  bool is_protected() const { return (origin & kProtected) != 0; }
  friend bool operator==(const PieceTet&, const PieceTet&) = default;
};

/// Vertices by id, ascending, and what lies between them. Of its own are the vertices marked so, and
/// all tets, triangles and edges: each belongs to one piece. `labels` has one for each vertex, or
/// none.
struct Piece {
  std::vector<VertexId> ids;
  std::vector<Point> points;
  std::vector<Label> labels;
  std::vector<std::uint8_t> marks;
  std::vector<PieceTet> tets;
  std::vector<MeshData::Triangle> triangles;
  std::vector<MeshData::Edge> edges;
  /// Where the surface may move, and has been divided by patches: all of its faces, as SurfaceFace has
  /// them, with their patch for a label; and its feature edges, with their line.
  std::vector<MeshData::Triangle> surface;
  std::vector<MeshData::Edge> lines;

  Label label(std::size_t v) const { return labels.empty() ? 0 : labels[v]; }
};

/// Its arrays as those of a mesh, but for surface and lines.
MeshData to_data(const Piece& piece);

/// Appends the piece to `bytes`: 30 bytes a tet.
void append(const Piece& piece, std::string& bytes);
/// So many bytes are appended.
std::size_t byte_count(const Piece& piece);

/// Takes a piece off the front of `bytes`.
/// @throws Error when they end too early, or name a vertex that is not there.
Piece take_piece(std::string_view& bytes);

/// Of an appended piece, some of whose bytes can be read, the vertices from `begin` to `end`, as far as
/// there are so many; nothing else. @throws Error when they end too early, or contradict themselves
using ReadBytes = std::function<std::string(std::uint64_t begin, std::uint64_t size)>;
Piece read_vertices(const ReadBytes& read, std::uint64_t begin, std::uint64_t end);
/// The ids alone, of all vertices.
std::vector<VertexId> read_ids(const ReadBytes& read);

/// A mark for each vertex that is so many edges from one with one of these marks, or nearer.
std::vector<char> near_marked(const Piece& piece, std::uint8_t marks, unsigned rings);

/// The vertices of `wanted` (a mark for each) and these elements of a piece, with numbers of their own.
struct Extract {
  std::vector<char> wanted = {};
  std::vector<std::uint32_t> tets = {}, triangles = {}, edges = {}, surface = {}, lines = {};
};
Piece extract(const Piece& from, const Extract& what);

/// One piece of parts that share vertices. Elements come in the order of the parts.
/// @throws Error when a vertex lies at two places: the parts are not of one mesh.
Piece merge(std::vector<Piece> parts);

}  // namespace tetmend::pieces
