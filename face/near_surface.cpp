// SPDX-License-Identifier: MIT
#include "face/near_surface.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "envelope/cover.h"
#include "envelope/element.h"
#include "envelope/features.h"
#include "kernel/chunks.h"
#include "kernel/scale.h"

namespace tetmend::face {

namespace {

/// A sheet, and corners in an order of their own.
using Key = std::pair<std::uint32_t, std::array<std::array<double, 3>, 3>>;

Key key_of(const Element& element) {
  Key key{element.sheet, {}};
  for (unsigned k = 0; k < 3; ++k) {
    const Point& p = element.points[k];
    key.second[k] = {p.x(), p.y(), p.z()};
  }
  std::sort(key.second.begin(), key.second.end());
  return key;
}

std::vector<Key> sorted_keys(std::span<const Element> elements) {
  std::vector<Key> keys;
  keys.reserve(elements.size());
  for (const Element& element : elements) keys.push_back(key_of(element));
  std::sort(keys.begin(), keys.end());
  return keys;
}

struct Surface {
  std::vector<Element> elements;
  std::vector<Key> keys;
  ElementTree tree;

  void build() {
    keys = sorted_keys(elements);
    std::vector<std::uint32_t> sheets;
    std::uint32_t most = 0;
    for (const Element& element : elements) {
      sheets.push_back(element.sheet);
      most = std::max(most, element.sheet + 1);
    }
    tree = ElementTree(elements, sheets, most);
    count_ = most;
  }
  bool has(const Element& element) const {
    return std::binary_search(keys.begin(), keys.end(), key_of(element));
  }
  bool has_sheet(std::uint32_t sheet) const { return sheet < count_; }

 private:
  std::uint32_t count_ = 0;
};

Surface surface_of(std::span<const SurfacePiece> pieces, const Scale& scale) {
  Surface surface;
  surface.elements.reserve(pieces.size());
  for (const SurfacePiece& piece : pieces) {
    Element element;
    for (unsigned k = 0; k < 3; ++k) element.points[k] = scale.to_work(piece.points[k]);
    element.corners = piece.corners;
    element.sheet = piece.sheet;
    element.normal = normal_of(element.points, element.corners, 0);
    surface.elements.push_back(element);
  }
  return surface;
}

/// As envelope/reference.cpp has them.
void set_tolerances(std::vector<Element>& elements, const EnvelopeOptions& options, double diagonal,
                    double flat) {
  const double most_share = 0.01 * diagonal;
  double most = flat;
  for (Element& element : elements) {
    if (element.corners != 3) continue;
    const double tolerance = options.length > 0
                                 ? options.length
                                 : std::min(options.share * mean_edge(element.points), most_share);
    // Cuts and files round.
    constexpr double kRounding = 1e-9;
    element.tolerance = tolerance * (1 + kRounding) + 4 * flat;
    most = std::max(most, element.tolerance);
  }
  for (Element& element : elements) {
    if (element.corners == 2) element.tolerance = most;
  }
}

/// Each piece in turn, with the pieces of the other surface that may be near.
class Prover {
 public:
  /// `own`: the pieces have tolerances; else those of the other surface have.
  Prover(const Surface& other, bool own) : other_(other), own_(own) {
    constexpr unsigned kMostPieces = 1U << 15U;
    cover_.set_most_pieces(kMostPieces);
  }

  bool proves(const Element& piece) {
    if (!other_.has_sheet(piece.sheet)) return false;
    near_.clear();
    Box box = box_of(piece.points);
    if (own_) {
      const Point room = Point::Constant(piece.tolerance);
      box = Box(box.min() - room, box.max() + room);
    }
    other_.tree.find(other_.elements, piece.sheet, box, near_);
    targets_.clear();
    for (const std::uint32_t i : near_) {
      const Element& element = other_.elements[i];
      targets_.push_back({element.points, element.corners,
                          own_ ? piece.tolerance : element.tolerance, element.normal});
    }
    constexpr bool kNearest = true;
    if (!cover_.covers(piece.points, piece.corners, targets_, kNearest)) return false;
    bound_ = std::max(bound_, cover_.bound());
    return true;
  }
  double bound() const { return bound_; }

 private:
  const Surface& other_;
  bool own_;
  CoverTest cover_;
  std::vector<std::uint32_t> near_;
  std::vector<CoverTarget> targets_;
  double bound_ = 0;
};

/// Of all pieces of one surface that the other has not.
Nearness prove_one_way(const Surface& pieces, const Surface& other, bool own) {
  constexpr std::size_t kPieces = 64;
  const auto results = map_chunks<Nearness>(
      pieces.elements.size(),
      [&](std::size_t begin, std::size_t end) {
        Nearness found;
        Prover prover(other, own);
        for (std::size_t i = begin; i < end; ++i) {
          if (other.has(pieces.elements[i])) continue;
          ++found.others;
          if (!prover.proves(pieces.elements[i])) ++found.unproven;
        }
        found.distance = prover.bound();
        return found;
      },
      kPieces);
  Nearness all;
  for (const Nearness& each : results) {
    all.others += each.others;
    all.unproven += each.unproven;
    all.distance = std::max(all.distance, each.distance);
  }
  return all;
}

}  // namespace

Nearness prove_near(std::span<const SurfacePiece> before, std::span<const SurfacePiece> after,
                    const NearTolerance& tolerance) {
  std::vector<Point> points;
  for (const auto& pieces : {before, after}) {
    for (const SurfacePiece& piece : pieces) {
      points.insert(points.end(), piece.points.begin(), piece.points.end());
    }
  }
  if (points.empty()) return {};
  const Scale scale = Scale::of(points);
  Surface was = surface_of(before, scale);
  Surface is = surface_of(after, scale);
  EnvelopeOptions options = tolerance.surface.envelope_options();
  options.length = scale.to_work(options.length);
  const Point low = scale.to_work(tolerance.low), high = scale.to_work(tolerance.high);
  set_tolerances(was.elements, options, (high - low).norm(), flatness(low, high));
  was.build();
  is.build();
  const Nearness there = prove_one_way(is, was, false);
  const Nearness back = prove_one_way(was, is, true);
  return {there.others, there.unproven + back.unproven,
          scale.to_file(std::max(there.distance, back.distance))};
}

}  // namespace tetmend::face
