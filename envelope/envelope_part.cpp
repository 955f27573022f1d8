// SPDX-License-Identifier: MIT
// Envelopes of surfaces that have moved already, and of parts of them.
//
//   present faces and edges -> elements of the reference near each -> proof of each element, or all that
//   may take part in one
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "envelope/envelope_journal.h"
#include "kernel/compensated_sum.h"

namespace tetmend {

std::unique_ptr<Envelope> Envelope::of_part(std::shared_ptr<const Reference> reference,
                                            std::span<const Point> points,
                                            const SurfaceFeatures& present) {
  PresentSurface surface(points, present);
  std::unique_ptr<Envelope> result(new Envelope(std::move(reference), std::move(surface)));
  if (!result->reference_->is_flat()) result->certify_part(present);
  return result;
}

void Envelope::certify_part(const SurfaceFeatures& present) {
  std::vector<std::pair<std::uint32_t, PresentKey>> near;  // element and what is near it
  Journal journal;
  const auto note = [&](const PresentKey& key, std::uint32_t sheet, const Box& box) {
    journal.elements.clear();
    reference_->tree.find(reference_->elements, sheet, box, journal.elements);
    for (const std::uint32_t element : journal.elements) near.emplace_back(element, key);
  };
  for (const auto& face : present.faces) {
    const auto& v = face.vertices;
    note(key_of(v), face.patch,
         box_of({present_.point(v[0]), present_.point(v[1]), present_.point(v[2])}));
  }
  for (const auto& edge : present.edges) {
    const Point& a = present_.point(edge.vertices[0]);
    const Point& b = present_.point(edge.vertices[1]);
    note(key_of(edge.vertices[0], edge.vertices[1]), reference_->sheet_of_line(edge.line),
         box_of({a, b, b}));
  }
  std::sort(near.begin(), near.end());
  covers_.resize(reference_->elements.size());
  std::vector<PresentKey> keys;
  for (std::size_t i = 0; i < near.size();) {
    const std::uint32_t element = near[i].first;
    keys.clear();
    for (; i < near.size() && near[i].first == element; ++i) keys.push_back(near[i].second);
    add_certifiers(journal, element, keys);
  }
}

void Envelope::add_certifiers(Journal& journal, std::uint32_t element,
                              const std::vector<PresentKey>& near) {
  const bool is_proven = offer_present(journal, element, near);
  for (std::size_t i = 0; i < journal.keys.size(); ++i) {
    if (is_proven && !journal.targets[i].used) continue;
    const PresentKey& key = journal.keys[i];
    covers_[element].push_back(key);
    present_.find(key[0])->served.push_back({key, element});
  }
}

SurfaceBound Envelope::prove() const {
  constexpr unsigned kManyPieces = 1U << 16;
  Journal journal;
  journal.cover.set_most_pieces(kManyPieces);
  journal.widening = 1 + 5e-10;  // half of what rounding was given
  SurfaceBound result = bound(journal);
  if (reference_->is_flat()) result.unproven += count_unproven_patches();
  return result;
}

/// Patches whose area is another one.
std::size_t Envelope::count_unproven_patches() const {
  std::vector<CompensatedSum> sums(reference_->patches.size());
  for (const auto& face : present().faces) {
    const auto& v = face.vertices;
    sums[face.patch].add(
        triangle_area({present_.point(v[0]), present_.point(v[1]), present_.point(v[2])}));
  }
  constexpr double kRounding = 1e-9;
  const std::vector<double>& was = reference_->areas;
  const double all = std::accumulate(was.begin(), was.end(), 0.0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    count += std::abs(sums[i].value() - was[i]) <= kRounding * all ? 0 : 1;
  }
  return count;
}

SurfaceFeatures Envelope::present() const {
  SurfaceFeatures result;
  result.places.assign(present_.slots(), SurfacePlace::inside);
  for (std::uint32_t i = 0; i < present_.slots(); ++i) {
    const VertexHandle v(i);
    const SurfaceVertex* const vertex = present_.find(v);
    if (vertex == nullptr) continue;
    result.places[i] = vertex->place;
    for (const auto& corner : vertex->corners) {
      if (corner.next < v || corner.previous < v) continue;
      result.faces.push_back({{v, corner.next, corner.previous}, corner.patch});
    }
    for (const auto& spoke : vertex->spokes) {
      if (v < spoke.end) result.edges.push_back({{v, spoke.end}, spoke.line});
    }
  }
  return result;
}

}  // namespace tetmend
