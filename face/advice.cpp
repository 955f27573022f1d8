// SPDX-License-Identifier: MIT
// Counts the bad tets that are left by what holds them.
//
//   mark the vertices of borders between labels -> for each bad tet: which kinds of constraints
//   touch it -> a sentence for each kind that holds a tenth of them -> what a flat surface would free
#include "face/advice.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "envelope/unjoined.h"
#include "face/flat_offer.h"
#include "kernel/chunks.h"
#include "kernel/grouped.h"
#include "kernel/stretching.h"
#include "schedule/limit/inverted_tets.h"

namespace tetmend::face {

namespace {

std::string counted(std::size_t number, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", grouped(number), number == 1 ? one : many);
}

/// Constrained faces inside, and where they lie.
struct InnerFaces {
  std::size_t named = 0;        ///< between two tets of one label
  std::vector<char> on_border;  ///< by vertex slot: on a face between two labels
};

InnerFaces find_inner_faces(const TetMesh& mesh) {
  InnerFaces faces;
  faces.on_border.resize(mesh.vertex_slots(), 0);
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (!mesh.has_constraints(t) || mesh.is_deleted(t)) continue;
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      const HalfFace twin = mesh.twin(face);
      if (twin.is_outside() || !mesh.is_constrained(face) || twin < face) continue;
      if (mesh.label(t) == mesh.label(twin.tet())) {
        ++faces.named;
        continue;
      }
      for (const VertexHandle v : mesh.vertices(face)) faces.on_border[v.index()] = 1;
    }
  }
  return faces;
}

/// Bad tets by what holds them; one may count for several.
struct Held {
  std::size_t bad = 0;  ///< all that are not frozen
  std::size_t by_named = 0;
  std::size_t by_border = 0;
  std::size_t by_frozen = 0;
  std::size_t by_surface = 0;  ///< all vertices lie there, and nothing else holds it
};

/// Looks at one bad tet after the other.
class Holders {
 public:
  Holders(const TetMesh& mesh, const InnerFaces& faces) : mesh_(mesh), faces_(faces) {}

  void add(TetHandle t, Held& held) const {
    bool named = false;
    bool border = false;
    bool frozen = false;
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      if (mesh_.is_boundary(face)) continue;
      const TetHandle other = mesh_.twin(face).tet();
      if (mesh_.is_constrained(face)) {
        (mesh_.label(t) == mesh_.label(other) ? named : border) = true;
      } else {
        frozen = frozen || mesh_.is_frozen(other);
      }
    }
    for (unsigned e = 0; e < 6; ++e) named = named || is_named_inside(TetEdge(t, e));
    bool surface = true;
    for (const VertexHandle v : mesh_.vertices(t)) {
      surface = surface && mesh_.is_boundary(v);
      if (!mesh_.is_fixed(v) || mesh_.is_boundary(v)) continue;
      (faces_.on_border[v.index()] != 0 ? border : mesh_.is_frozen(v) ? frozen : named) = true;
    }
    ++held.bad;
    held.by_named += named ? 1 : 0;
    held.by_border += border ? 1 : 0;
    held.by_frozen += frozen ? 1 : 0;
    held.by_surface += surface && !named && !border && !frozen ? 1 : 0;
  }

 private:
  /// A named edge that --ignore-interior would drop.
  bool is_named_inside(TetEdge e) const {
    if (!mesh_.is_constrained(e)) return false;
    const auto [a, b] = mesh_.vertices(e);
    const auto on_face = [&](VertexHandle v) {
      return mesh_.is_boundary(v) || faces_.on_border[v.index()] != 0;
    };
    return !on_face(a) || !on_face(b);
  }

  const TetMesh& mesh_;
  const InnerFaces& faces_;
};

Held count_held(const TetMesh& mesh, const InnerFaces& faces) {
  const Holders holders(mesh, faces);
  const auto parts = map_chunks<Held>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    Held part;
    mesh.visit_below(kBadThreshold, begin, end, [&](TetHandle t) {
      if (!mesh.is_frozen(t)) holders.add(t, part);
    });
    return part;
  });
  Held sum;
  for (const Held& part : parts) {
    sum.bad += part.bad;
    sum.by_named += part.by_named;
    sum.by_border += part.by_border;
    sum.by_frozen += part.by_frozen;
    sum.by_surface += part.by_surface;
  }
  return sum;
}

/// "754 bad tets", or "750 of the 800 bad tets left".
std::string share_of_bad(std::size_t count, std::size_t all) {
  if (count == all) return counted(count, "bad tet", "bad tets");
  return fmt::format("{} of the {} bad tets left", grouped(count), grouped(all));
}

std::string advice_on_frozen(const Options& options, const Result& result, std::size_t count,
                             std::size_t bad) {
  const bool regions = !options.protect.empty() || !options.only.empty();
  const bool layers = result.layer_tets > 0;
  return fmt::format("{} kept as they are hold {} beside them; {} would free these",
                     layers && regions ? "boundary layers and regions"
                     : layers          ? "boundary layers"
                                       : "regions",
                     share_of_bad(count, bad),
                     layers && regions ? "--layers improve and smaller regions"
                     : layers          ? "--layers improve"
                                       : "smaller regions");
}

/// How many tets are inverted or flat, and why. A tet with a free vertex that sees all of its link
/// from somewhere could be mended alone, but for what it would do to others.
std::string reasons_of_inverted(const InvertedTets& count) {
  std::vector<std::string> reasons;
  const auto add = [&](std::size_t number, std::string_view reason) {
    if (number > 0) reasons.push_back(fmt::format("{} {}", grouped(number), reason));
  };
  add(count.frozen, "kept as wished");
  add(count.fixed, "with fixed vertices only");
  add(count.sealed, "whose free vertices, one by one, have no place that mends all tets there");
  add(count.open, "that the search has not mended, though one vertex has a place");
  return fmt::format("{} left: {}",
                     counted(count.all(), "inverted or flat tet is", "inverted or flat tets are"),
                     fmt::join(reasons, ", "));
}

constexpr std::size_t kLeastOffer = 10;

/// What a script of the user makes of a surface that moves, nobody knows.
bool offers_flat(const Options& options, const Result& result) {
  const bool is_fixed = options.surface.empty() || options.surface == "fixed";
  return is_fixed && options.script.empty() && result.ending != Ending::cancelled;
}

}  // namespace

std::vector<std::string> advice_before(const TetMesh& mesh, const Result& result) {
  std::vector<std::string> texts = describe(find_unjoined(mesh), mesh.vertex_count());
  if (result.layer_tets > 0) {
    texts.push_back(fmt::format("{} of boundary layers kept; --layers improve works on them too",
                                counted(result.layer_tets, "tet", "tets")));
  }
  if (3 * result.before.n_bad < result.before.tets) return texts;
  const Stretching stretching = measure_stretching(mesh);
  if (!stretching.is_throughout()) return texts;
  texts.push_back(fmt::format(
      "warning: {:.0f} % of the tets are flat and lie alike; if that is wanted, --protect keeps "
      "them",
      100 * static_cast<double>(stretching.flat) / static_cast<double>(stretching.tets)));
  return texts;
}

std::vector<std::string> advice_after(const TetMesh& mesh, const MeshData& input,
                                      const Options& options, const Result& result) {
  if (result.after.n_bad == 0) return {};
  const InnerFaces faces = find_inner_faces(mesh);
  const Held held = count_held(mesh, faces);
  const auto binds = [&](std::size_t count) { return count > 0 && 10 * count >= held.bad; };
  std::vector<std::string> texts;
  if (result.ending != Ending::cancelled) {  // who stops a run waits for the program to end
    const InvertedTets inverted = count_inverted(mesh);
    if (inverted.all() > 0) texts.push_back(reasons_of_inverted(inverted));
  }
  if (binds(held.by_named)) {
    const bool only_faces = faces.named > 0;
    texts.push_back(fmt::format(
        "{} {} {}; --ignore-interior would free them",
        only_faces ? counted(faces.named, "named inner triangle", "named inner triangles")
                   : "edges and vertices named inside",
        only_faces && faces.named == 1 ? "holds" : "hold", share_of_bad(held.by_named, held.bad)));
  }
  if (binds(held.by_border)) {
    texts.push_back(fmt::format("faces between labels hold {}; one label would free them",
                                share_of_bad(held.by_border, held.bad)));
  }
  if (binds(held.by_frozen)) {
    texts.push_back(advice_on_frozen(options, result, held.by_frozen, held.bad));
  }
  if (held.by_surface > 0 && 2 * held.by_surface >= held.bad) {
    texts.push_back(fmt::format("the surface, which stays, has all vertices of {}",
                                share_of_bad(held.by_surface, held.bad)));
  }
  if (held.bad >= kLeastOffer && offers_flat(options, result)) {
    const std::size_t least = std::max(kLeastOffer, (held.bad + 19) / 20);  // a twentieth
    const std::size_t freed = estimate_freed_by_flat(mesh, input, held.bad, least);
    if (freed >= least) {
      texts.push_back(fmt::format("about {} of the {} bad tets left would go with --surface flat",
                                  grouped(freed), grouped(held.bad)));
    }
  }
  return texts;
}

}  // namespace tetmend::face
