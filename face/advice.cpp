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

Held count_held(const TetMesh& mesh) {
  const HolderSearch search(mesh);
  const auto parts = map_chunks<Held>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    Held part;
    mesh.visit_below(kBadThreshold, begin, end, [&](TetHandle t) {
      if (!mesh.is_frozen(t)) part.add(search.find(t));
    });
    return part;
  });
  Held sum;
  sum.named_faces = search.named_faces().size();
  for (const Held& part : parts) sum.add(part);
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
bool is_surface_fixed(const Options& options) {
  return options.surface.empty() || options.surface == "fixed";
}

bool offers_flat(const Options& options, const Result& result) {
  return is_surface_fixed(options) && options.script.empty() && result.ending != Ending::cancelled;
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

void Holders::add(const Holders& other) {
  named = named || other.named;
  border = border || other.border;
  frozen = frozen || other.frozen;
  at_surface |= other.at_surface;
  fixed |= other.fixed;
}

void Held::add(const Holders& holders) {
  constexpr std::uint8_t kAllCorners = 0b1111;
  ++bad;
  by_named += holders.named ? 1 : 0;
  by_border += holders.border ? 1 : 0;
  by_frozen += holders.frozen ? 1 : 0;
  const bool is_free = !holders.named && !holders.border && !holders.frozen;
  by_surface += holders.at_surface == kAllCorners && is_free ? 1 : 0;
}

void Held::add(const Held& other) {
  bad += other.bad;
  by_named += other.by_named;
  by_border += other.by_border;
  by_frozen += other.by_frozen;
  by_surface += other.by_surface;
  named_faces += other.named_faces;
}

HolderSearch::HolderSearch(const TetMesh& mesh, Knows knows)
    : mesh_(mesh), knows_(std::move(knows)), on_border_(mesh.vertex_slots(), 0) {
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (!mesh.has_constraints(t) || mesh.is_deleted(t)) continue;
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      const HalfFace twin = mesh.twin(face);
      if (twin.is_outside() || !mesh.is_constrained(face) || twin < face) continue;
      if (mesh.label(t) == mesh.label(twin.tet())) {
        named_faces_.push_back(face);
        continue;
      }
      for (const VertexHandle v : mesh.vertices(face)) on_border_[v.index()] = 1;
    }
  }
}

Holders HolderSearch::find(TetHandle t) const {
  Holders holders;
  for (unsigned f = 0; f < 4; ++f) {
    const HalfFace face(t, f);
    const auto v = mesh_.vertices(face);
    const bool is_known = knows(v[0]) || knows(v[1]) || knows(v[2]);
    if (!is_known || mesh_.is_boundary(face)) continue;
    const TetHandle other = mesh_.twin(face).tet();
    if (mesh_.is_constrained(face)) {
      (mesh_.label(t) == mesh_.label(other) ? holders.named : holders.border) = true;
    } else {
      holders.frozen = holders.frozen || mesh_.is_frozen(other);
    }
  }
  for (unsigned e = 0; e < 6; ++e) {
    holders.named = holders.named || is_named_inside(TetEdge(t, e));
  }
  for (unsigned i = 0; i < 4; ++i) {
    const VertexHandle v = mesh_.vertices(t)[i];
    if (!knows(v)) continue;
    if (mesh_.is_boundary(v)) holders.at_surface |= static_cast<std::uint8_t>(1U << i);
    if (!mesh_.is_fixed(v)) continue;
    holders.fixed |= static_cast<std::uint8_t>(1U << i);
    if (mesh_.is_boundary(v)) continue;
    (on_border_[v.index()] != 0 ? holders.border
     : mesh_.is_frozen(v)       ? holders.frozen
                                : holders.named) = true;
  }
  return holders;
}

/// A named edge that --ignore-interior would drop. A vertex of a piece's border counts as at the
/// surface: who knows it tells whether it is.
bool HolderSearch::is_named_inside(TetEdge e) const {
  if (!mesh_.is_constrained(e)) return false;
  const auto [a, b] = mesh_.vertices(e);
  const auto is_inside = [&](VertexHandle v) {
    return knows(v) && !mesh_.is_boundary(v) && on_border_[v.index()] == 0;
  };
  return is_inside(a) || is_inside(b);
}

std::vector<std::string> advice_on(const Held& held, const Options& options, const Result& result) {
  std::vector<std::string> texts;
  const auto binds = [&](std::size_t count) { return count > 0 && 10 * count >= held.bad; };
  if (binds(held.by_named)) {
    const bool only_faces = held.named_faces > 0;
    texts.push_back(fmt::format(
        "{} {} {}; --ignore-interior would free them",
        only_faces ? counted(held.named_faces, "named inner triangle", "named inner triangles")
                   : "edges and vertices named inside",
        only_faces && held.named_faces == 1 ? "holds" : "hold",
        share_of_bad(held.by_named, held.bad)));
  }
  if (binds(held.by_border)) {
    texts.push_back(fmt::format("faces between labels hold {}; one label would free them",
                                share_of_bad(held.by_border, held.bad)));
  }
  if (binds(held.by_frozen)) {
    texts.push_back(advice_on_frozen(options, result, held.by_frozen, held.bad));
  }
  if (held.bad > 0 && (!options.size.empty() || options.size_at)) {
    texts.push_back(fmt::format(
        "lengths come first; 'tetmend improve' after this goes for {}, whatever their lengths",
        share_of_bad(held.bad, held.bad)));
  }
  if (held.by_surface > 0 && 2 * held.by_surface >= held.bad) {
    texts.push_back(fmt::format("the surface, which {}, has all vertices of {}",
                                is_surface_fixed(options) ? "stays" : "moves no further",
                                share_of_bad(held.by_surface, held.bad)));
  }
  return texts;
}

std::vector<std::string> advice_after(const TetMesh& mesh, const MeshData& input,
                                      const Options& options, const Result& result) {
  if (result.after.n_bad == 0) return {};
  const Held held = count_held(mesh);
  std::vector<std::string> texts;
  if (result.ending != Ending::cancelled) {  // who stops a run waits for the program to end
    const InvertedTets inverted = count_inverted(mesh);
    if (inverted.all() > 0) texts.push_back(reasons_of_inverted(inverted));
  }
  for (std::string& text : advice_on(held, options, result)) texts.push_back(std::move(text));
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
