// SPDX-License-Identifier: MIT
// An operator under each judge. What a judge promises is computed again, from the tets of the mesh
// before and after the attempt.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "contract/changed_tets.h"
#include "contract/portrait.h"
#include "contract/trials.h"
#include "kernel/integrity.h"
#include "kernel/workspace.h"

namespace tetmend::contract {

namespace {

/// The tets of a mesh that are not in the other.
struct OwnTets {
  std::vector<Quality> qualities;  // ascending
  double largest_angle = 0;        // degrees
  double mean_ratios = 0;          // sum
};

OwnTets describe(const TetMesh& mesh, const std::vector<NamedTet>& changed) {
  OwnTets side;
  for (const auto& [v, quality] : changed) {
    side.qualities.push_back(quality);
    const double size = std::abs(
        mean_ratio(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])));
    side.mean_ratios += quality < 0 ? -size : size;  // the order of the vertices has lost the sign
    const auto angles =
        dihedral_angles(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
    side.largest_angle =
        std::max(side.largest_angle, *std::max_element(angles.begin(), angles.end()));
  }
  std::sort(side.qualities.begin(), side.qualities.end());
  return side;
}

std::ptrdiff_t count_bad(const OwnTets& side) {
  return std::count_if(side.qualities.begin(), side.qualities.end(),
                       [](Quality q) { return q < kBadThreshold; });
}

double sum_of_lacks(const OwnTets& side, double exponent) {
  double sum = 0;
  for (const Quality q : side.qualities) {
    sum += q < kBadThreshold ? std::pow(double{kBadThreshold} - double{q}, exponent) : 0;
  }
  return sum;
}

bool is_better(const OwnTets& now, const OwnTets& before) {
  const auto is_less = [](Quality a, Quality b) { return a < b; };
  // The shorter is better where one continues the other.
  const auto [b, n] = std::mismatch(before.qualities.begin(), before.qualities.end(),
                                    now.qualities.begin(), now.qualities.end());
  if (n == now.qualities.end()) return b != before.qualities.end();
  return b != before.qualities.end() && is_less(*b, *n);
}

/// A judge, and whether its promise holds.
struct Case {
  std::string name;
  Judge judge;
  std::function<bool(const OwnTets& before, const OwnTets& now)> holds;
};

bool is_fair(const OwnTets& before, const OwnTets& now, const Fairness& fairness) {
  if (!is_better(now, before)) return false;
  constexpr double kRounding = 1e-9;
  const double more_lack =
      sum_of_lacks(now, fairness.exponent) - sum_of_lacks(before, fairness.exponent);
  const std::ptrdiff_t more_bad = count_bad(now) - count_bad(before);
  if (more_lack <= kRounding && (fairness.more_bad || more_bad <= 0)) return true;
  const double gain = now.qualities.empty() ? 1 : now.qualities[0] - before.qualities[0];
  return before.qualities[0] < fairness.desperate &&
         gain >= fairness.price * static_cast<double>(more_bad) - kRounding;
}

/// No bad tet is new or worse.
bool spares_bad(const OwnTets& before, const OwnTets& now) {
  const auto bad = static_cast<std::size_t>(count_bad(before));
  if (count_bad(now) > count_bad(before)) return false;
  for (std::size_t i = 0; i < std::min(bad, now.qualities.size()); ++i) {
    if (now.qualities[i] < before.qualities[i] - kQualityTolerance) return false;
  }
  return true;
}

double quality_of_largest(const Standard& standard, double angle) {
  return standard.quality_of_angle(std::max(angle, 90.001));
}

Case lowers_angle(const TetMesh& mesh, TetHandle t) {
  const TetVertices& v = mesh.vertices(t);
  const Standard standard = mesh.standard();
  const auto angles =
      dihedral_angles(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
  const double sine = quality_of_largest(standard, *std::max_element(angles.begin(), angles.end()));
  return {"lowers_angle", Judge::lowers_angle(sine),
          [sine, standard](const OwnTets& before, const OwnTets& now) {
            if (now.qualities.empty() || now.qualities[0] < before.qualities[0]) return false;
            const std::ptrdiff_t more_bad = count_bad(now) - count_bad(before);
            const double price =
                kPriceOfBad * static_cast<double>(std::max<std::ptrdiff_t>(1, more_bad));
            return quality_of_largest(standard, now.largest_angle) - sine >= price - 1e-6;
          }};
}

std::vector<Case> cases(const TetMesh& mesh, TetHandle t) {
  constexpr Fairness kMild = {.exponent = 12, .desperate = 0.7};
  constexpr Fairness kThrifty = {.price = 0.02, .more_bad = false};
  constexpr double kShare = 0.3;
  std::vector<Case> all = {
      {"strict", Judge::strict(),
       [](const OwnTets& b, const OwnTets& n) { return is_better(n, b); }},
      {"fair", Judge::fair({}),
       [](const OwnTets& b, const OwnTets& n) { return is_fair(b, n, {}); }},
      {"fair, exponent 12", Judge::fair(kMild),
       [=](const OwnTets& b, const OwnTets& n) { return is_fair(b, n, kMild); }},
      {"fair, no more bad tets", Judge::fair(kThrifty),
       [=](const OwnTets& b, const OwnTets& n) { return is_fair(b, n, kThrifty); }},
      {"reaches", Judge::reaches(1.2f),
       [](const OwnTets& b, const OwnTets& n) { return is_better(n, b) || spares_bad(b, n); }},
      {"opening", Judge::opening(kShare), [=](const OwnTets& b, const OwnTets& n) {
         return n.qualities.empty() ||
                n.qualities[0] >= kShare * std::max(0.f, b.qualities[0]) - 2 * kQualityTolerance;
       }}};
  all.push_back({"untangles", Judge::untangles(), [](const OwnTets& b, const OwnTets& n) {
                   const auto count_not_positive = [](const OwnTets& side) {
                     return std::count_if(side.qualities.begin(), side.qualities.end(),
                                          [](Quality q) { return q <= 0; });
                   };
                   return count_not_positive(n) < count_not_positive(b) &&
                          count_bad(n) <= count_bad(b);
                 }});
  all.push_back(lowers_angle(mesh, t));
  for (const double usual : {0.0, 0.7}) {
    all.push_back({fmt::format("raises_mean, usual {}", usual), Judge::raises_mean(usual),
                   [usual](const OwnTets& b, const OwnTets& n) {
                     const auto sum = [usual](const OwnTets& side) {
                       return side.mean_ratios - usual * static_cast<double>(side.qualities.size());
                     };
                     return sum(n) > sum(b) && spares_bad(b, n);
                   }});
  }
  return all;
}

TetHandle tet_at(const TetMesh& mesh, Target target) {
  switch (target.kind) {
    case TargetKind::tet:
      return target.tet();
    case TargetKind::edge:
      return target.edge().tet();
    case TargetKind::face:
      return target.face().tet();
    case TargetKind::vertex:
      break;
  }
  return mesh.tet_of(target.vertex());
}

std::string try_case(const Operator& op, const TetMesh& start, const Portrait& known, Target target,
                     const Case& tried, Outcome& outcome) {
  TetMesh mesh = start;
  Workspace workspace(mesh);
  OperatorStates states;
  OperatorContext context{mesh, workspace, states, nullptr, 0, &tried.judge};
  ++outcome.attempts;
  if (op.attempt(context, target) != Verdict::accepted) {
    return mesh == start ? "" : "the refusal left a trace";
  }
  ++outcome.accepted;
  if (const auto loss = complaint_about_loss(known, mesh); !loss.empty()) return loss;
  const ChangedTets changed = changed_tets(start, mesh);
  const bool holds = tried.holds(describe(start, changed.before), describe(mesh, changed.now));
  return holds ? "" : fmt::format("the promise is broken: {}", tried.judge.promise());
}

}  // namespace

Outcome try_under_judges(const Operator& op, const TetMesh& start, std::size_t count) {
  Outcome outcome;
  const Portrait known = portrait(start);
  for (const Target target : sample(targets(start, op.info().target), count, 3)) {
    if (!tet_at(start, target).is_valid()) continue;
    for (const Case& tried : cases(start, tet_at(start, target))) {
      const std::string about = try_case(op, start, known, target, tried, outcome);
      if (about.empty()) continue;
      outcome.complaint = fmt::format("judged by {}, {} {}: {}", tried.name, to_string(target.kind),
                                      target.code, about);
      return outcome;
    }
  }
  return outcome;
}

}  // namespace tetmend::contract
