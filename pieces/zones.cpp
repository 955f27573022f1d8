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
/// Tets in a ball of that radius, if all edges are as long as that one.
constexpr std::size_t kTetsOfBall = 2300;

/// Sets of balls, each with its number of tets.
class Clusters {
 public:
  std::size_t find(std::size_t i) {
    while (leader_[i] != i) i = leader_[i] = leader_[leader_[i]];
    return i;
  }
  std::size_t size(std::size_t leader) const { return size_[leader]; }
  void add(std::span<const std::size_t> leaders) {
    const std::size_t now = leader_.size();
    leader_.push_back(now);
    size_.push_back(kTetsOfBall);
    for (const std::size_t other : leaders) {
      leader_[other] = now;
      size_[now] += size_[other];
    }
  }

 private:
  std::vector<std::size_t> leader_;
  std::vector<std::size_t> size_;
};

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

ZoneMap::ZoneMap(std::span<const WorstTet> worst, std::size_t most) {
  Clusters clusters;
  std::vector<Ball> balls;
  for (const WorstTet& tet : worst) {
    const Ball ball{tet.centre, kRadius * tet.reach, 0};
    std::vector<std::size_t> touched;
    std::size_t size = kTetsOfBall;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      if ((balls[i].centre - ball.centre).norm() > balls[i].radius + ball.radius) continue;
      const std::size_t leader = clusters.find(i);
      if (std::find(touched.begin(), touched.end(), leader) != touched.end()) continue;
      touched.push_back(leader);
      size += clusters.size(leader);
    }
    if (!touched.empty() && size > most) continue;
    clusters.add(touched);
    balls.push_back(ball);
  }
  // Zones are numbered by their worst tets.
  std::vector<std::uint32_t> zone_of(balls.size(), std::numeric_limits<std::uint32_t>::max());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    std::uint32_t& zone = zone_of[clusters.find(i)];
    if (zone == std::numeric_limits<std::uint32_t>::max()) zone = next++;
    balls[i].zone = zone;
  }
  *this = ZoneMap(std::move(balls));
}

ZoneMap::ZoneMap(std::vector<Ball> balls) : balls_(std::move(balls)), boxes_(balls_.size()) {
  for (const Ball& ball : balls_) count_ = std::max<std::size_t>(count_, ball.zone + 1);
  arrange(0, balls_.size());
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
  const Ball* ball = search(0, balls_.size(), p);
  return ball == nullptr ? -1 : static_cast<int>(ball->zone);
}

const Ball* ZoneMap::search(std::size_t begin, std::size_t end, const Point& p) const {
  if (begin == end) return nullptr;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto& [low, high] = boxes_[middle];
  if (!(p.array() >= low.array()).all() || !(p.array() <= high.array()).all()) return nullptr;
  const Ball& ball = balls_[middle];
  if ((p - ball.centre).norm() <= ball.radius) return &ball;
  const Ball* found = search(begin, middle, p);
  return found != nullptr ? found : search(middle + 1, end, p);
}

}  // namespace tetmend::pieces
