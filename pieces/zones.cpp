// SPDX-License-Identifier: MIT
#include "pieces/zones.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace tetmend::pieces {

namespace {

/// In longest edges of a bad tet: farther than operators reach.
constexpr double kRadius = 4;

/// Sets of balls that touch.
class Clusters {
 public:
  std::size_t find(std::size_t i) {
    while (leader_[i] != i) i = leader_[i] = leader_[leader_[i]];
    return i;
  }
  /// A ball, and others that it touches.
  void add(std::span<const std::size_t> touched) {
    const std::size_t now = leader_.size();
    leader_.push_back(now);
    for (const std::size_t other : touched) leader_[find(other)] = now;
  }

 private:
  std::vector<std::size_t> leader_;
};

struct WeighedBall {
  Ball* ball;
  std::int64_t points;
};

/// Where balls along an axis are parted: near this share of their points, where the gap is widest.
std::size_t place_to_cut(std::span<const WeighedBall> balls, Eigen::Index axis, std::int64_t total,
                         std::int64_t wanted) {
  constexpr std::int64_t kSlack = 8;  // off by this part of all at most, where it can be
  std::size_t place = 1;
  std::int64_t least_off = std::numeric_limits<std::int64_t>::max();
  double widest = 0;
  std::int64_t before = 0;
  for (std::size_t i = 1; i < balls.size(); ++i) {
    before += balls[i - 1].points;
    const std::int64_t off = std::max(std::abs(before - wanted) - total / kSlack, std::int64_t{0});
    const double gap = balls[i].ball->centre[axis] - balls[i - 1].ball->centre[axis];
    if (off > least_off || (off == least_off && gap <= widest)) continue;
    place = i;
    least_off = off;
    widest = gap;
  }
  return place;
}

/// Parts balls of one zone until none has more points. New zones are numbered from `next` on.
void halve(std::span<WeighedBall> balls, std::int64_t most, std::uint32_t& next) {
  std::int64_t total = 0;
  for (const WeighedBall& each : balls) total += each.points;
  if (total <= most || balls.size() < 2) return;
  std::array<Point, 2> box = {balls[0].ball->centre, balls[0].ball->centre};
  for (const WeighedBall& each : balls) {
    box[0] = box[0].cwiseMin(each.ball->centre);
    box[1] = box[1].cwiseMax(each.ball->centre);
  }
  Eigen::Index axis = 0;
  (box[1] - box[0]).maxCoeff(&axis);
  std::sort(balls.begin(), balls.end(), [axis](const WeighedBall& a, const WeighedBall& b) {
    const auto key = [axis](const Ball& ball) {
      return std::tuple(ball.centre[axis], ball.centre.x(), ball.centre.y(), ball.centre.z(),
                        ball.radius);
    };
    return key(*a.ball) < key(*b.ball);
  });
  const std::int64_t parts = (total + most - 1) / most;
  const std::size_t place = place_to_cut(balls, axis, total, total * (parts / 2) / parts);
  const std::span<WeighedBall> before = balls.first(place);
  const std::span<WeighedBall> behind = balls.subspan(place);
  const bool is_worst_behind = std::any_of(behind.begin(), behind.end(),
                                           [](const WeighedBall& b) { return b.ball->is_worst; });
  for (const WeighedBall& each : is_worst_behind ? before : behind) each.ball->zone = next;
  ++next;
  halve(before, most, next);
  halve(behind, most, next);
}

}  // namespace

bool operator<(const WorstTet& a, const WorstTet& b) {
  const auto key = [](const WorstTet& t) {
    return std::tuple(t.quality, t.centre.x(), t.centre.y(), t.centre.z(), t.reach);
  };
  return key(a) < key(b);
}

void WorstTets::add(const WorstTet& tet) {
  tets_.push_back(tet);
  if (tets_.size() >= 2 * kMost) shorten();
}

void WorstTets::add(const WorstTets& others) {
  for (const WorstTet& tet : others.tets_) add(tet);
}

void WorstTets::shorten() {
  std::sort(tets_.begin(), tets_.end());
  tets_.resize(std::min(tets_.size(), kMost));
}

std::vector<WorstTet> WorstTets::take() const {
  WorstTets all = *this;
  all.shorten();
  std::vector<WorstTet>& tets = all.tets_;
  const auto milder = std::find_if(tets.begin(), tets.end(),
                                   [](const WorstTet& tet) { return tet.quality >= kLimit; });
  const auto below = static_cast<std::size_t>(milder - tets.begin());
  tets.resize(std::min(tets.size(), std::max(below, kLeast)));
  return std::move(tets);
}

std::vector<WorstTet> WorstTets::all() const {
  WorstTets copy = *this;
  copy.shorten();
  return std::move(copy.tets_);
}

ZoneMap::ZoneMap(std::span<const WorstTet> worst) {
  Clusters clusters;
  std::vector<Ball> balls;
  for (const WorstTet& tet : worst) {
    const Ball ball{tet.centre, kRadius * tet.reach};
    std::vector<std::size_t> touched;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const double apart = (balls[i].centre - ball.centre).norm();
      if (apart <= balls[i].radius + ball.radius) touched.push_back(i);
    }
    clusters.add(touched);
    balls.push_back(ball);
  }
  // Zones are numbered by their worst tets.
  std::vector<std::uint32_t> zone_of(balls.size(), std::numeric_limits<std::uint32_t>::max());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    std::uint32_t& zone = zone_of[clusters.find(i)];
    balls[i].is_worst = zone == std::numeric_limits<std::uint32_t>::max();
    if (balls[i].is_worst) zone = next++;
    balls[i].zone = balls[i].cluster = zone;
  }
  *this = ZoneMap(std::move(balls));
}

ZoneMap::ZoneMap(std::vector<Ball> balls) : balls_(std::move(balls)), boxes_(balls_.size()) {
  note_clusters();
  arrange(0, balls_.size());
}

void ZoneMap::note_clusters() {
  for (const Ball& ball : balls_) count_ = std::max<std::size_t>(count_, ball.zone + 1);
  clusters_.resize(count_);
  for (const Ball& ball : balls_) clusters_[ball.zone] = ball.cluster;
}

std::size_t ZoneMap::share(std::size_t all, std::size_t zone) const {
  const std::uint32_t cluster = clusters_[zone];
  const auto zones =
      static_cast<std::size_t>(std::count(clusters_.begin(), clusters_.end(), cluster));
  const std::size_t clusters = 1 + *std::max_element(clusters_.begin(), clusters_.end());
  const std::size_t of_cluster = all / clusters;
  if (zones == 1) return of_cluster;
  return zone == cluster ? of_cluster / 2 : of_cluster / 2 / (zones - 1);
}

void ZoneMap::arrange(std::size_t begin, std::size_t end) {
  if (begin == end) return;
  std::array<Point, 2> box = {balls_[begin].centre, balls_[begin].centre};
  for (std::size_t i = begin; i < end; ++i) {
    box[0] = box[0].cwiseMin(balls_[i].centre - Point::Constant(balls_[i].radius));
    box[1] = box[1].cwiseMax(balls_[i].centre + Point::Constant(balls_[i].radius));
  }
  Eigen::Index axis = 0;
  (box[1] - box[0]).maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return balls_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [axis](const Ball& a, const Ball& b) {
    return a.centre[axis] < b.centre[axis];
  });
  boxes_[middle] = box;
  arrange(begin, middle);
  arrange(middle + 1, end);
}

int ZoneMap::find(const Point& p) const {
  Nearest nearest;
  search(0, balls_.size(), p, nearest);
  return nearest.ball == nullptr ? -1 : static_cast<int>(nearest.ball->zone);
}

void ZoneMap::search(std::size_t begin, std::size_t end, const Point& p, Nearest& nearest) const {
  if (begin == end) return;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto& [low, high] = boxes_[middle];
  if (!(p.array() >= low.array()).all() || !(p.array() <= high.array()).all()) return;
  const Ball& ball = balls_[middle];
  const Point from_centre = p - ball.centre;
  if (from_centre.norm() <= ball.radius) {
    const double distance = from_centre.squaredNorm() / (ball.radius * ball.radius);
    if (nearest.ball == nullptr || distance < nearest.distance) nearest = {&ball, distance};
  }
  search(begin, middle, p, nearest);
  search(middle + 1, end, p, nearest);
}

void ZoneMap::count(std::span<const Point> points, std::span<std::int64_t> by_ball) const {
  for (const Point& p : points) {
    Nearest nearest;
    search(0, balls_.size(), p, nearest);
    if (nearest.ball != nullptr) ++by_ball[static_cast<std::size_t>(nearest.ball - balls_.data())];
  }
}

void ZoneMap::cut(std::span<const std::int64_t> by_ball, std::int64_t most) {
  std::vector<std::vector<WeighedBall>> zones(count_);
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    zones[balls_[i].zone].push_back({&balls_[i], by_ball[i]});
  }
  auto next = static_cast<std::uint32_t>(count_);
  for (std::vector<WeighedBall>& zone : zones) halve(zone, most, next);
  note_clusters();
}

}  // namespace tetmend::pieces
