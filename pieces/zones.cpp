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
constexpr double kRadius = 3;

/// In radii: within that a point belongs to the ball of the worse tet. So no border is near the worst.
constexpr double kCore = 0.5;

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

/// Parts the balls of one zone, if they have more points. Each new one is the worst ball that is left
/// with those nearest to it, as measured by radii: so no border is near the worst. The first keeps the
/// number of the zone, others have those from `next` on.
void part(std::vector<WeighedBall> balls, std::int64_t most, std::uint32_t& next) {
  std::int64_t total = 0;
  for (const WeighedBall& each : balls) total += each.points;
  for (bool is_first = true; !balls.empty() && (total > most || !is_first); is_first = false) {
    const auto worst = std::min_element(
        balls.begin(), balls.end(),
        [](const WeighedBall& a, const WeighedBall& b) { return a.ball->rank < b.ball->rank; });
    const Ball& centre = *worst->ball;
    const auto key = [&centre](const Ball& ball) {
      const double apart = (ball.centre - centre.centre).norm();
      return std::pair(apart / (ball.radius + centre.radius), ball.rank);
    };
    std::sort(balls.begin(), balls.end(), [&](const WeighedBall& a, const WeighedBall& b) {
      return key(*a.ball) < key(*b.ball);
    });
    std::int64_t points = 0;
    std::size_t taken = 0;
    while (taken < balls.size() && (taken == 0 || points + balls[taken].points <= most)) {
      points += balls[taken].points;
      if (!is_first) balls[taken].ball->zone = next;
      ++taken;
    }
    if (!is_first) ++next;
    balls.erase(balls.begin(), balls.begin() + static_cast<std::ptrdiff_t>(taken));
  }
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
    if (zone == std::numeric_limits<std::uint32_t>::max()) zone = next++;
    balls[i].zone = balls[i].cluster = zone;
    balls[i].rank = static_cast<std::uint32_t>(i);
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
    const std::pair key(distance <= kCore * kCore ? 0 : distance, ball.rank);
    const bool is_nearest =
        nearest.ball == nullptr || key < std::pair(nearest.distance, nearest.ball->rank);
    if (is_nearest) nearest = {&ball, key.first};
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
  for (std::vector<WeighedBall>& zone : zones) part(std::move(zone), most, next);
  note_clusters();
}

}  // namespace tetmend::pieces
