// SPDX-License-Identifier: MIT
// A surface that may move, in pieces: what all of them are held to, and what is proven in the end.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/improve.h>

#include "envelope/envelope.h"
#include "pieces/parting.h"
#include "pieces/piece.h"

namespace tetmend::pieces {

/// Of the surface what is a piece's own, by ids.
struct SurfaceShare {
  struct Edge {
    std::array<VertexId, 2> vertices{};
    Label label = 0;
  };
  struct Volume {
    Label label = 0;
    double volume = 0;
  };

  std::vector<VertexId> ids;  ///< of its vertices, ascending
  std::vector<Point> points;
  std::vector<Label> labels;  ///< of the vertices, or none
  /// By number in `ids`; of a moved surface with their patches.
  std::vector<MeshData::Triangle> faces;
  std::vector<SurfaceInput::Kind> kinds;  ///< of each face; of a moved surface none
  std::vector<Edge> edges;                ///< named ones; of a moved surface feature edges
  std::vector<Edge> walls;                ///< see SurfaceInput
  std::vector<VertexId> kept;             ///< likewise; of a moved surface its corners
  std::vector<VertexId> held;             ///< likewise; of a moved surface none
  std::vector<Volume> volumes;            ///< of the own tets
};

void append(const SurfaceShare& share, std::string& bytes);
/// @throws Error when the bytes end too early, or contradict themselves.
SurfaceShare take_share(std::string_view& bytes);

/// Of a piece of the mesh as it was read.
SurfaceShare share_of_input(const Piece& gathered, const Parting& parting, std::uint32_t number);
/// Of what has been worked on. `own`: see own_part().
SurfaceShare share_of(const Piece& own);

/// The whole surface of the input, with its patches, lines and tolerances. It does not change: each piece
/// is held to it, so wherever the surface is worked on, the proofs are of the whole mesh.
class HeldSurface {
 public:
  /// @param shares of all parts, in their order
  /// @param low, high the box of the mesh
  /// @throws Error for a tolerance of the size of rounding, and a mesh of extreme size
  HeldSurface(const std::vector<SurfaceShare>& shares, const EnvelopeOptions& options,
              const Point& low, const Point& high);

  /// Gives a piece of the mesh as it was read its faces, feature edges and corners.
  void label(Piece& gathered, const Parting& parting, std::uint32_t number) const;
  /// What decides about the surface of a mesh that was built of the piece. Null: it stays, for the
  /// mesh is of extreme size. Precondition: frozen tets are marked.
  std::unique_ptr<Envelope> guard(const TetMesh& mesh, const Piece& piece) const;
  /// How many of the own faces of the piece are on the surface and not in its list, in the wrong patch,
  /// or in the list alone. `mesh` was built of it.
  std::size_t count_misfits(const TetMesh& mesh, const Piece& piece, const Parting& parting,
                            std::uint32_t number) const;

  /// Gives new vertices of the surface the label that those around them in the input have in common.
  void label_points(Piece& piece, VertexId first_new) const;

  /// As it is before: without a change.
  SurfaceChange unchanged() const;
  /// Proves anew how near the surface of the shares is, and measures it.
  /// @throws Error where it cannot be proven: somebody has broken a promise
  SurfaceChange measure(const std::vector<SurfaceShare>& shares) const;

 private:
  void take_labels(const std::vector<SurfaceShare>& shares);

  std::vector<VertexId> ids_;  // of vertices, ascending
  std::vector<Point> points_;
  std::vector<Label> labels_;  // empty: all are 0
  ElementTree faces_;          // by patch, where there are labels
  std::vector<Element> face_elements_;
  SurfaceFeatures features_;
  std::shared_ptr<const Reference> reference_;
  SurfaceChange before_;
};

}  // namespace tetmend::pieces
