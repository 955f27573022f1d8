// SPDX-License-Identifier: MIT
// What a user should know about a mesh before a run, and about what held the run back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <tetmend/improve.h>

#include "kernel/tet_mesh.h"

namespace tetmend::face {

/// Says where points touch without being joined and which boundary layers are kept, and warns of a
/// mesh that is stretched throughout. Reads the statistics before the run and the numbers of layers.
/// Cost: that of find_unjoined(); linear where a third of the tets is bad.
std::vector<std::string> advice_before(const TetMesh& mesh, const Result& result);

/// Says how many tets are inverted or flat and why, unless the run was cancelled; which constraints
/// hold a tenth or more of the bad tets that are left, and what would free them. A constraint holds
/// a tet if a face or an edge of the tet is one, or if it alone fixes one of its vertices. Offers
/// `--surface flat` where it would remove 10 of them or more, and a twentieth. Cost: linear, little
/// where no constraints are inside; see count_inverted(), estimate_freed_by_flat().
/// @param input what the mesh was built of
std::vector<std::string> advice_after(const TetMesh& mesh, const MeshData& input,
                                      const Options& options, const Result& result);

/// What holds a bad tet, as far as vertices tell whose tets are all there.
struct Holders {
  bool named = false;   ///< a named face, edge or vertex inside
  bool border = false;  ///< a face between labels
  bool frozen = false;
  std::uint8_t at_surface = 0;  ///< a bit for each corner that lies there
  std::uint8_t fixed = 0;       ///< likewise, that must not move

  void add(const Holders& other);
};

/// Bad tets that are not frozen, by what holds them; one may count for several.
struct Held {
  std::size_t bad = 0;  ///< all of them
  std::size_t by_named = 0;
  std::size_t by_border = 0;
  std::size_t by_frozen = 0;
  std::size_t by_surface = 0;   ///< all vertices lie there, and nothing else holds it
  std::size_t named_faces = 0;  ///< named triangles between two tets of one label

  void add(const Holders& holders);
  void add(const Held& other);
};

/// Finds what holds the bad tets of a mesh, or of a piece of one.
class HolderSearch {
 public:
  /// Has all tets at a vertex.
  using Knows = std::function<bool(VertexHandle)>;
  /// @param knows null: all vertices. Cost: linear, little where no constraints are inside.
  explicit HolderSearch(const TetMesh& mesh, Knows knows = {});

  /// What the known vertices tell of a tet.
  Holders find(TetHandle t) const;
  /// The named triangles between two tets of one label, each once.
  const std::vector<HalfFace>& named_faces() const { return named_faces_; }

 private:
  bool knows(VertexHandle v) const { return !knows_ || knows_(v); }
  bool is_named_inside(TetEdge e) const;

  const TetMesh& mesh_;
  Knows knows_;
  std::vector<HalfFace> named_faces_;
  std::vector<char> on_border_;  // by vertex slot: on a face between two labels
};

/// Which constraints hold a tenth or more of the bad tets, see advice_after().
std::vector<std::string> advice_on(const Held& held, const Options& options, const Result& result);

}  // namespace tetmend::face
