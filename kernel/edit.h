// SPDX-License-Identifier: MIT
// The record of one change of a mesh, and the journal that holds them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <tetmend/api.h>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// One change: a set of tets replaced by another with the same outer surface (or one that the guard
/// of the surface allows), or a vertex moved, added or removed. The data lie in the arrays of the journal; `*_begin` to `*_end` name the part.
struct TETMEND_API Edit {
  enum class Kind : std::uint8_t { replace_cavity, move_vertex, add_vertex, remove_vertex };

  Kind kind{};
  VertexHandle vertex;                                   ///< moved, added or removed
  Point point = Point::Zero();                           ///< before: of the moved or removed vertex
  std::uint32_t removed_begin = 0, removed_end = 0;      ///< replace_cavity
  std::uint32_t created_begin = 0, created_end = 0;      ///< replace_cavity
  std::uint32_t links_begin = 0, links_end = 0;          ///< replace_cavity
  std::uint32_t qualities_begin = 0, qualities_end = 0;  ///< move_vertex
  /// Slots that came from growth, not from the free list: the last ones created.
  std::uint32_t appended = 0;
  std::uint32_t flagged_begin = 0, flagged_end = 0;  ///< replace_cavity
  /// The surface changed with it: its guard has to be told of an undo.
  bool surface = false;
};

/// Edits in the order in which they happened, with all that undoing them needs.
struct TETMEND_API Journal {
  struct RemovedTet {
    TetHandle tet;
    TetVertices vertices;
    std::array<HalfFace, 4> neighbours;
    Quality quality;
    Label label;
    std::uint16_t flags;
  };
  struct VertexLink {
    VertexHandle vertex;
    TetHandle tet;  // before
  };
  struct TetQuality {
    TetHandle tet;
    Quality quality;  // before
  };
  struct VertexFlags {
    VertexHandle vertex;
    std::uint8_t flags;  // before
  };
  struct RemovedVertex {
    Date date;
    Date moved;
    std::uint32_t origin;
    std::uint8_t flags;
  };

  std::vector<Edit> edits;
  std::vector<RemovedTet> removed;
  std::vector<TetHandle> created;
  std::vector<VertexLink> links;
  std::vector<TetQuality> qualities;
  std::vector<VertexFlags> flagged;
  std::vector<RemovedVertex> removed_vertices;  // one for each remove_vertex

  bool empty() const { return edits.empty(); }
  void clear() {
    edits.clear();
    removed.clear();
    created.clear();
    links.clear();
    qualities.clear();
    flagged.clear();
    removed_vertices.clear();
  }
};

/// Told of every edit and of every undo, in the order in which they happen; also of edits in
/// attempts that are refused later. Must not throw: an edit is made, and undone, whatever becomes
/// of who listens.
class TETMEND_API EditListener {
 public:
  virtual ~EditListener() = default;
  /// The last edit of the journal was just made: the mesh holds what it created. A vertex that lost
  /// its last tet is removed right after, by an edit of its own.
  virtual void edit_made(const TetMesh& mesh, const Journal& journal) noexcept = 0;
  /// The last edit that was made and not undone yet was just undone.
  virtual void edit_undone() noexcept = 0;
};

}  // namespace tetmend
