// SPDX-License-Identifier: MIT
//   walk: neighbours among the tets -> from a tet at a known point towards the place
//   tree: the tets along a curve -> boxes of halves of the list
#include "face/tet_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/LU>

#include "kernel/face_matcher.h"
#include "kernel/hilbert.h"

namespace tetmend::face {

namespace {

constexpr std::uint32_t kTetsOfLeaf = 8;

struct Weights {
  std::array<double, 4> of_vertices{};
  bool has_volume = true;  // else the tet holds nothing

  /// 0 where none is below.
  double least() const {
    if (!has_volume) return std::numeric_limits<double>::lowest();
    return std::min(*std::min_element(of_vertices.begin(), of_vertices.end()), 0.0);
  }
};

/// See weights_in().
Weights find_weights(const MeshData& data, std::uint32_t tet, const Point& place) {
  const auto& v = data.tets[tet].vertices;
  Weights weights;
  Eigen::Matrix3d edges;
  for (Eigen::Index k = 0; k < 3; ++k) {
    edges.col(k) = data.points[v[static_cast<std::size_t>(k) + 1]] - data.points[v[0]];
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(edges);
  weights.has_volume = solver.isInvertible();
  if (!weights.has_volume) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < 4; ++k) {
      const auto distance = [&](std::size_t i) {
        return (data.points[v[i]] - place).squaredNorm();
      };
      if (distance(k) < distance(nearest)) nearest = k;
    }
    weights.of_vertices[nearest] = 1;
    return weights;
  }
  const Point offset = place - data.points[v[0]];
  Point w = solver.solve(offset);
  w += solver.solve(offset - edges * w);  // a flat tet loses digits, which this gives back
  for (std::size_t k = 0; k < 3; ++k) weights.of_vertices[k + 1] = w[static_cast<Eigen::Index>(k)];
  weights.of_vertices[0] = 1 - w.sum();
  return weights;
}

}  // namespace

struct TetLocator::Best {
  TetPlace place;
  double smallest_weight = -std::numeric_limits<double>::infinity();  // 0: none is below
  double distance2 = std::numeric_limits<double>::infinity();  // of the box, where none holds it

  bool is_inside() const { return smallest_weight >= 0; }
  bool is_any() const { return distance2 < std::numeric_limits<double>::infinity(); }
  /// Of several that hold the place the first, so that only the tets there decide.
  bool is_better(std::uint32_t tet, double weight, double to_tet) const {
    if (to_tet != distance2) return to_tet < distance2;
    if (weight != smallest_weight) return weight > smallest_weight;
    return tet < place.tet;
  }
};

TetLocator::TetLocator(const MeshData& data, const Bodies& bodies, std::vector<std::uint32_t> tets)
    : data_(data), bodies_(bodies), tets_(std::move(tets)) {
  if (tets_.empty()) return;
  join_neighbours();
}

namespace {

constexpr std::uint32_t kNone = Bodies::kNone;

}  // namespace

void TetLocator::join_neighbours() {
  neighbours_.assign(4 * tets_.size(), kNone);
  starts_.assign(data_.points.size(), kNone);
  const bool are_bodies_told = bodies_.count() > 1;
  std::vector<std::uint32_t> bodies;
  for (std::size_t i = 0; are_bodies_told && i < tets_.size(); ++i) {
    bodies.push_back(bodies_.of_tet(tets_[i]));
  }
  FaceMatcher matcher(data_.points.size(), neighbours_.size());
  for (std::uint32_t i = 0; i < tets_.size(); ++i) {
    const auto& v = data_.tets[tets_[i]].vertices;
    for (std::uint32_t k = 0; k < 4; ++k) {
      starts_[v[k]] = i;
      const std::uint32_t side = 4 * i + k;
      const std::uint32_t other =
          matcher.add(side, {v[(k + 1) % 4], v[(k + 2) % 4], v[(k + 3) % 4]});
      if (other == kNone) continue;
      if (are_bodies_told && bodies[i] != bodies[other / 4]) continue;
      neighbours_[side] = other / 4;
      neighbours_[other] = i;
    }
  }
}

std::span<const std::uint32_t> TetLocator::tets_at(std::uint32_t point) const {
  std::call_once(has_lists_, [this] { list_tets_at(); });
  const std::uint32_t begin = first_at_[point];
  return {tets_at_.data() + begin, first_at_[point + 1] - begin};
}

void TetLocator::list_tets_at() const {
  first_at_.assign(data_.points.size() + 1, 0);
  for (const std::uint32_t t : tets_) {
    for (const std::uint32_t v : data_.tets[t].vertices) ++first_at_[v];
  }
  // Each is where its own end; filling from behind makes it its begin.
  std::partial_sum(first_at_.begin(), first_at_.end(), first_at_.begin());
  tets_at_.resize(4 * tets_.size());
  for (auto i = tets_.size(); i-- > 0;) {
    for (const std::uint32_t v : data_.tets[tets_[i]].vertices) tets_at_[--first_at_[v]] = tets_[i];
  }
}

void TetLocator::need_tree() const {
  std::call_once(has_tree_, [this] {
    sort_leaves();
    nodes_.reserve(leaves_.size() / 2 + 1);
    build(0, static_cast<std::uint32_t>(leaves_.size()));
  });
}

/// Tets that follow each other along a curve are neighbours: so halves of the list are halves of the
/// space.
void TetLocator::sort_leaves() const {
  std::vector<Point> centres(tets_.size());
  for (std::size_t i = 0; i < tets_.size(); ++i) centres[i] = box_of(tets_[i]).center();
  const HilbertCurve curve(centres);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed(tets_.size());
  for (std::size_t i = 0; i < keyed.size(); ++i) keyed[i] = {curve.key(centres[i]), tets_[i]};
  std::sort(keyed.begin(), keyed.end());
  leaves_.reserve(keyed.size());
  for (const auto& each : keyed) leaves_.push_back(each.second);
}

TetLocator::Box TetLocator::box_of(std::uint32_t tet) const {
  Box box;
  for (const std::uint32_t v : data_.tets[tet].vertices) box.extend(data_.points[v]);
  return box;
}

std::uint32_t TetLocator::build(std::uint32_t begin, std::uint32_t end) const {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  if (end - begin <= kTetsOfLeaf) {
    Box box;
    for (std::uint32_t i = begin; i < end; ++i) box.extend(box_of(leaves_[i]));
    nodes_[number] = {box, begin, end, 0};
    return number;
  }
  const std::uint32_t middle = begin + (end - begin) / 2;
  build(begin, middle);
  const std::uint32_t right = build(middle, end);
  nodes_[number] = {nodes_[number + 1].box.merged(nodes_[right].box), begin, end, right};
  return number;
}

bool TetLocator::is_among(std::uint32_t tet, Among among) const {
  return among.empty() || std::binary_search(among.begin(), among.end(), bodies_.of_tet(tet));
}

// --- walk ----------------------------------------------------------------------------------------

namespace {

/// How a place lies in a tet, as far as rounding cannot matter.
struct Lie {
  std::array<double, 4> volumes;  // with the face opposite each vertex; all positive: inside
  double least;                   // of them
  double limit;                   // what rounding may be, amply
  bool is_clear;                  // the tet is not flat

  bool is_outside() const { return is_clear && least < -limit; }
  bool is_inside() const { return is_clear && least > limit; }
};

Lie lie_of(const MeshData& data, std::uint32_t tet, const Point& place) {
  constexpr double kRounding = 1e-12;
  const auto& v = data.tets[tet].vertices;
  const Point a = data.points[v[0]] - place;
  const Point b = data.points[v[1]] - place;
  const Point c = data.points[v[2]] - place;
  const Point d = data.points[v[3]] - place;
  const double length2 = std::max(std::max(a.squaredNorm(), b.squaredNorm()),
                                  std::max(c.squaredNorm(), d.squaredNorm()));
  const Point across = c.cross(d);
  const Point along = a.cross(b);
  Lie lie{{b.dot(across), -a.dot(across), d.dot(along), -c.dot(along)}, 0, 0, false};
  const double sum = (lie.volumes[0] + lie.volumes[1]) + (lie.volumes[2] + lie.volumes[3]);
  lie.limit = kRounding * length2 * std::sqrt(length2);
  lie.is_clear = std::abs(sum) > lie.limit;
  const double sense = sum < 0 ? -1 : 1;
  for (double& volume : lie.volumes) volume *= sense;
  lie.least =
      std::min(std::min(lie.volumes[0], lie.volumes[1]), std::min(lie.volumes[2], lie.volumes[3]));
  return lie;
}

}  // namespace

/// Where what became of a tet, a way from the points of the origin, or the tets there lead to a tet that
/// holds the place: that one; its weights may be missing. False behind bends of what the tets fill.
bool TetLocator::walk(const Point& place, const Origin& origin, Best& best) const {
  if (origin.tet != kNone && lie_of(data_, origin.tet, place).is_inside()) {
    best = {{origin.tet, {}}, 0, 0};
    return true;
  }
  for (const std::uint32_t point : origin.points) {
    const std::uint32_t start = starts_[point];
    if (start == kNone || !is_among(tets_[start], origin.bodies)) continue;
    if (walk_from(start, place, best)) return true;
  }
  for (const std::uint32_t point : origin.points) {
    for (const std::uint32_t t : tets_at(point)) {
      if (is_among(t, origin.bodies) && take(t, place, best)) return true;
    }
  }
  return false;
}

bool TetLocator::walk_from(std::uint32_t start, const Point& place, Best& best) const {
  constexpr int kMostSteps = 24;
  std::uint32_t here = start;
  std::uint32_t last = kNone;
  for (int step = 0; step < kMostSteps; ++step) {
    const Lie lie = lie_of(data_, tets_[here], place);
    if (lie.is_inside()) {
      best = {{tets_[here], {}}, 0, 0};
      return true;
    }
    if (!lie.is_outside()) return take(tets_[here], place, best);
    std::uint32_t next = kNone;
    double least = -lie.limit;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t beyond = neighbours_[4 * here + k];
      if (lie.volumes[k] >= least || beyond == kNone || beyond == last) continue;
      least = lie.volumes[k];
      next = beyond;
    }
    if (next == kNone) return false;
    last = std::exchange(here, next);
  }
  return false;
}

/// A tet that holds the place for certain is the one, for then no other of its body does. Where that is
/// not certain, all that hold it meet there.
bool TetLocator::take(std::uint32_t tet, const Point& place, Best& best) const {
  const Lie lie = lie_of(data_, tet, place);
  if (lie.is_outside()) return false;
  if (lie.is_inside()) {
    best = {{tet, {}}, 0, 0};
    return true;
  }
  const std::uint32_t body = bodies_.of_tet(tet);
  for (const std::uint32_t v : data_.tets[tet].vertices) {
    for (const std::uint32_t other : tets_at(v)) {
      if (bodies_.of_tet(other) == body) try_holder(other, place, best);
    }
  }
  return best.is_inside();
}

/// If it holds the place, and is the first that does.
void TetLocator::try_holder(std::uint32_t tet, const Point& place, Best& best) const {
  if ((best.is_inside() && tet >= best.place.tet) || !box_of(tet).contains(place)) return;
  const Lie lie = lie_of(data_, tet, place);
  if (lie.is_outside()) return;
  if (lie.is_inside() || find_weights(data_, tet, place).least() >= 0) best = {{tet, {}}, 0, 0};
}

TetPlace TetLocator::find(const Point& place, const Origin& origin) const {
  const std::uint32_t tet = find_tet(place, origin);
  return {tet, weights_in(data_, tet, place)};
}

TetPlace TetLocator::find_roughly(const Point& place, const Origin& origin) const {
  const std::uint32_t tet = find_tet(place, origin);
  const Lie lie = lie_of(data_, tet, place);
  if (!lie.is_clear) return {tet, weights_in(data_, tet, place)};
  TetPlace found{tet, lie.volumes};
  const double sum = (lie.volumes[0] + lie.volumes[1]) + (lie.volumes[2] + lie.volumes[3]);
  for (double& weight : found.weights) weight /= sum;
  return found;
}

std::uint32_t TetLocator::find_tet(const Point& place, const Origin& origin) const {
  Best best;
  if (!walk(place, origin, best)) best = search(place, origin.bodies);
  return best.place.tet;
}

// --- tree ----------------------------------------------------------------------------------------

TetLocator::Best TetLocator::search(const Point& place, Among among) const {
  need_tree();
  Best best;
  find_holder(place, among, best);
  if (!best.is_inside()) search(0, place, among, best);
  return best.is_any() || among.empty() ? best : search(place, {});
}

/// Looks where boxes hold the place: mostly that is all, and few of their tets need exact weights.
void TetLocator::find_holder(const Point& place, Among among, Best& best) const {
  constexpr std::size_t kDeepest = 64;
  std::array<std::uint32_t, kDeepest> open{};
  std::size_t count = 1;
  while (count > 0) {
    const std::uint32_t number = open[--count];
    const Node& here = nodes_[number];
    if (!here.box.contains(place)) continue;
    if (here.right != 0) {
      open[count++] = here.right;
      open[count++] = number + 1;
      continue;
    }
    for (std::uint32_t i = here.begin; i < here.end; ++i) {
      if (is_among(leaves_[i], among)) try_holder(leaves_[i], place, best);
    }
  }
}

/// Looks into a box if it holds the place, or if no tet does so far and it is no farther than the best.
void TetLocator::search(std::uint32_t node, const Point& place, Among among, Best& best) const {
  const Node& here = nodes_[node];
  const double distance2 = here.box.squaredExteriorDistance(place);
  if (distance2 > best.distance2) return;
  if (here.right != 0) {
    std::uint32_t near = node + 1;
    std::uint32_t far = here.right;
    if (nodes_[far].box.squaredExteriorDistance(place) <
        nodes_[near].box.squaredExteriorDistance(place)) {
      std::swap(near, far);
    }
    search(near, place, among, best);
    search(far, place, among, best);
    return;
  }
  for (std::uint32_t i = here.begin; i < here.end; ++i) {
    const double to_tet = box_of(leaves_[i]).squaredExteriorDistance(place);
    if (to_tet > best.distance2 || (best.is_inside() && leaves_[i] > best.place.tet)) continue;
    if (!is_among(leaves_[i], among)) continue;
    const Weights weights = find_weights(data_, leaves_[i], place);
    const double weight = weights.least();
    if (best.is_better(leaves_[i], weight, to_tet)) {
      best = {{leaves_[i], weights.of_vertices}, weight, to_tet};
    }
  }
}

std::vector<std::uint32_t> TetLocator::near(const std::array<Point, 4>& tet, Among among) const {
  Box box;
  for (const Point& p : tet) box.extend(p);
  std::vector<std::uint32_t> found;
  if (tets_.empty()) return found;
  need_tree();
  search(0, box, among, found);
  std::sort(found.begin(), found.end());
  return found;
}

void TetLocator::search(std::uint32_t node, const Box& box, Among among,
                        std::vector<std::uint32_t>& found) const {
  const Node& here = nodes_[node];
  if (!here.box.intersects(box)) return;
  if (here.right != 0) {
    search(node + 1, box, among, found);
    search(here.right, box, among, found);
    return;
  }
  for (std::uint32_t i = here.begin; i < here.end; ++i) {
    if (is_among(leaves_[i], among) && box_of(leaves_[i]).intersects(box))
      found.push_back(leaves_[i]);
  }
}

std::array<double, 4> weights_in(const MeshData& data, std::uint32_t tet, const Point& place) {
  return find_weights(data, tet, place).of_vertices;
}

}  // namespace tetmend::face
