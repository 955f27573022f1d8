// SPDX-License-Identifier: MIT
#include "kernel/judge.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernel/curved.h"
#include "kernel/judge_limits.h"
#include "kernel/size_field.h"
#include "kernel/solver_rulers.h"
#include "kernel/thin_stars.h"
#include "kernel/transaction.h"
#include "kernel/wanted_lengths.h"

namespace tetmend {

namespace {

/// Ascending.
std::ptrdiff_t count_bad(std::span<const Quality> qualities) {
  return std::lower_bound(qualities.begin(), qualities.end(), kBadThreshold) - qualities.begin();
}

std::ptrdiff_t count_more_bad(Comparison& qualities) {
  return count_bad(qualities.now()) - count_bad(qualities.before());
}

bool is_better(Comparison& qualities) {
  if (qualities.has_both()) {
    const Quality before = qualities.worst_before();
    const Quality now = qualities.worst_now();
    if (now < before) return false;
    if (now > before + kQualityTolerance) return true;
  }
  return improves(qualities.now(), qualities.before());
}

bool has_bad(const Comparison& qualities) {
  return !qualities.has_both() || qualities.worst_before() < kBadThreshold ||
         qualities.worst_now() < kBadThreshold;
}

bool is_there(const TetMesh& mesh, TetHandle t, const TetVertices& corners) {
  return t.index() < mesh.tet_slots() && !mesh.is_deleted(t) && mesh.vertices(t) == corners;
}

bool reaches_goal(const Change& change, double goal) {
  if (!change.aimed_at.is_valid()) return false;
  const TetMesh& mesh = change.transaction.mesh();
  return !is_there(mesh, change.aimed_at, change.corners) ||
         mesh.quality(change.aimed_at) > goal - kQualityTolerance;
}

std::ptrdiff_t count_not_positive(std::span<const Quality> ascending) {
  return std::upper_bound(ascending.begin(), ascending.end(), Quality{0}) - ascending.begin();
}

/// Fewer tets are inverted or flat.
bool mends(Comparison& qualities) {
  return count_not_positive(qualities.now()) < count_not_positive(qualities.before());
}

/// Every new tet keeps the bounds, or is no further beyond them than the old tets.
bool is_no_further_beyond(const Transaction& transaction, Bounds bounds) {
  const Transaction::Tets tets = transaction.tets();
  for (const auto& [a, b, c, d] : tets.before) bounds.widen(a, b, c, d);
  return std::all_of(tets.now.begin(), tets.now.end(),
                     [&](const auto& tet) { return bounds.admit(tet[0], tet[1], tet[2], tet[3]); });
}

/// Every new tet keeps the bounds of the mesh. Where they yield to mending, inverted tets go before;
/// what follows then brings no tet that is further beyond than those that it replaces.
bool keeps_bounds(const Transaction& transaction, Comparison& qualities) {
  const TetMesh& mesh = transaction.mesh();
  const Bounds& bounds = mesh.bounds();
  if (!qualities.has_both() || qualities.worst_now() >= bounds.safe()) return true;
  std::vector<TetHandle> changed;
  transaction.list_changed(changed);
  const bool are_kept = std::all_of(changed.begin(), changed.end(), [&](TetHandle t) {
    const TetVertices& v = mesh.vertices(t);
    return mesh.quality(t) >= bounds.safe() ||
           bounds.admit(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
  });
  if (are_kept || !bounds.are_of_inverted()) return are_kept;
  return (bounds.yield_to_mending() && mends(qualities)) ||
         is_no_further_beyond(transaction, bounds);
}

/// How many dihedral angles of the tets are at the ends of the goal or outside.
std::size_t count_bad_angles(std::span<const std::array<Point, 4>> tets, const Goal& goal) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double most = std::cos(goal.min_angle * kDegree);
  const double least = std::cos(goal.max_angle * kDegree);
  std::size_t count = 0;
  for (const auto& p : tets) {
    std::array<Point, 4> normal;
    for (std::size_t f = 0; f < 4; ++f) {
      const auto& [i, j, k] = kFaceVertices[f];
      normal[f] = (p[j] - p[i]).cross(p[k] - p[i]).normalized();
    }
    for (const auto& [k, l] : kEdgeVertices) {
      const double cosine = -normal[k].dot(normal[l]);
      if (!(cosine < most && cosine > least)) ++count;
    }
  }
  return count;
}

/// What a change adds at some vertices to mass - step^2 * stiffness, which no vertex may have below 0.
class SlackOfStep {
 public:
  explicit SlackOfStep(double step2) : step2_(step2) {}

  struct Entry {
    VertexHandle vertex;
    double gain = 0;
    double mass = 0;  // of all that was added: what the gain is exact to

    bool has_gained() const {
      constexpr double kRounding = 1e-12;
      return gain > kRounding * mass;
    }
  };

  void look_at(VertexHandle v) {
    if (find(v) == entries_.end()) entries_.push_back({.vertex = v});
  }
  std::span<const Entry> entries() const { return entries_; }

  void add(const Transaction::Tets& tets) {
    for (std::size_t i = 0; i < tets.now.size(); ++i) add(tets.now[i], tets.vertices_now[i], 1);
    for (std::size_t i = 0; i < tets.before.size(); ++i) {
      add(tets.before[i], tets.vertices_before[i], -1);
    }
  }

 private:
  void add(const std::array<Point, 4>& tet, const TetVertices& vertices, double sign) {
    std::optional<P1Diagonal> of;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto entry = find(vertices[i]);
      if (entry == entries_.end()) continue;
      if (!of) of = p1_diagonal(tet[0], tet[1], tet[2], tet[3]);
      constexpr double kUnknown = -std::numeric_limits<double>::infinity();
      entry->gain += of->mass > 0 ? sign * (of->mass - step2_ * of->stiffness[i]) : kUnknown;
      entry->mass += of->mass;
    }
  }
  std::vector<Entry>::iterator find(VertexHandle v) {
    return std::find_if(entries_.begin(), entries_.end(),
                        [v](const Entry& entry) { return entry.vertex == v; });
  }

  double step2_;
  std::vector<Entry> entries_;
};

/// No vertex allows a smaller step of explicit time integration than the worst at first. Stars are
/// walked only where a tet is thin and the vertex lost something.
bool keeps_step(const Transaction& transaction) {
  const TetMesh& mesh = transaction.mesh();
  const double least2 = mesh.bounds().least_step2();
  if (least2 <= 0) return true;
  ThinStars* const thin = mesh.thin_stars();
  const Transaction::Tets tets = transaction.tets();
  SlackOfStep slack(least2);
  for (std::size_t i = 0; i < tets.now.size(); ++i) {
    const auto& [a, b, c, d] = tets.now[i];
    const P1Diagonal of = p1_diagonal(a, b, c, d);
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const VertexHandle v = tets.vertices_now[i][corner];
      const bool is_thin = ThinStars::is_thin(of, corner, least2);
      if (is_thin && thin != nullptr) thin->add(v);
      if (is_thin || thin == nullptr || thin->contains(v)) slack.look_at(v);
    }
  }
  if (slack.entries().empty()) return true;
  slack.add(tets);
  return std::all_of(slack.entries().begin(), slack.entries().end(), [&](const auto& entry) {
    if (entry.has_gained()) return true;
    const std::optional<double> step2 = squared_step_at(mesh, entry.vertex);
    return step2 && *step2 >= least2;
  });
}

double gain_of_means(const Transaction& transaction, double usual) {
  const auto sum = [usual](std::span<const std::array<Point, 4>> tets) {
    double total = 0;
    for (const auto& [a, b, c, d] : tets) total += mean_ratio(a, b, c, d) - usual;
    return total;
  };
  const Transaction::Tets tets = transaction.tets();
  return sum(tets.now) - sum(tets.before);
}

/// What makes the mesh grow adds tets that are round enough.
bool keeps_mean(const Transaction& transaction) {
  const double usual = transaction.mesh().bounds().least_mean();
  if (usual <= 0) return true;
  const Transaction::Tets tets = transaction.tets();
  if (tets.now.size() <= tets.before.size()) return true;
  return gain_of_means(transaction, usual) >= 0;
}

/// The edges that changed are as long as the size field admits.
bool keeps_lengths(const Transaction& transaction) {
  const TetMesh& mesh = transaction.mesh();
  const SizeField* field = mesh.size_field();
  if (field == nullptr) return true;
  std::vector<EdgePlaces> now;
  if (field->looks_back()) {
    std::vector<EdgePlaces> before;
    transaction.list_changed_edges(before, now);
    return field->admits(before, now);
  }
  std::vector<std::array<VertexHandle, 2>> edges;
  transaction.list_new_edges(edges);
  for (const auto& [a, b] : edges) now.push_back({mesh.point(a), mesh.point(b)});
  return field->admits({}, now);
}

/// An edge gives way between whose ends much shorter ones are wanted than there, and none that comes
/// is too short: a split that is needed in any case, though those that come may miss by more.
bool cuts_blind_edge(const WantedLengths& wanted, std::span<const EdgePlaces> before,
                     std::span<const EdgePlaces> now) {
  if (before.size() != 1 || now.size() < 2) return false;
  const auto& [a, b] = before[0];
  const double by_ends =
      WantedLengths::relative_length((b - a).norm(), wanted.length(a), wanted.length(b));
  return by_ends > WantedLengths::kMost && wanted.relative_length(a, b) > by_ends &&
         std::all_of(now.begin(), now.end(), [&](const EdgePlaces& edge) {
           return wanted.relative_length(edge[0], edge[1]) >= WantedLengths::kLeast;
         });
}

/// The edges keep better to the wanted lengths.
bool fits_better(const Transaction& transaction) {
  const SizeField* field = transaction.mesh().size_field();
  assert(field != nullptr && field->wanted() != nullptr);
  std::vector<EdgePlaces> before;
  std::vector<EdgePlaces> now;
  transaction.list_changed_edges(before, now);
  const WantedLengths& wanted = *field->wanted();
  return improves(wanted.misfits(now), wanted.misfits(before)) ||
         cuts_blind_edge(wanted, before, now);
}

/// No new tet is turned over by its curved edges, or nearer to it than the worst at first.
bool keeps_curved(const Transaction& transaction) {
  const TetMesh& mesh = transaction.mesh();
  const CurvedEdges* edges = mesh.curved_edges();
  if (edges == nullptr) return true;
  std::vector<TetHandle> changed;
  transaction.list_changed(changed);
  return std::all_of(changed.begin(), changed.end(),
                     [&](TetHandle t) { return edges->admit(mesh, mesh.vertices(t)); });
}

/// Whatever the promise is.
bool keeps_limits(const Transaction& transaction, Comparison& qualities, Judge::Kind kind) {
  // The edges of a tangled mesh are too long to be held to.
  const bool may_have_any_length = kind == Judge::Kind::untangles;
  // Its promise is about lengths.
  const bool fits_lengths = kind == Judge::Kind::fits_lengths;
  return keeps_bounds(transaction, qualities) && !transaction.has_too_many_tets() &&
         (may_have_any_length || fits_lengths || keeps_lengths(transaction)) &&
         keeps_curved(transaction) &&
         (may_have_any_length || (keeps_step(transaction) &&
                                  (kind == Judge::Kind::raises_mean || keeps_mean(transaction))));
}

double largest_angle_sine(const Transaction& transaction) {
  const TetMesh& mesh = transaction.mesh();
  std::vector<TetHandle> changed;
  transaction.list_changed(changed);
  double sine = 1;
  for (const TetHandle t : changed) {
    const TetVertices& v = mesh.vertices(t);
    sine = std::min(sine, tetmend::largest_angle_sine(mesh.point(v[0]), mesh.point(v[1]),
                                                      mesh.point(v[2]), mesh.point(v[3])));
  }
  return sine * std::sqrt(mesh.standard().obtuse2());
}

}  // namespace

bool improves(std::span<const Quality> now, std::span<const Quality> before) {
  const std::size_t common = std::min(now.size(), before.size());
  for (std::size_t i = 0; i < common; ++i) {
    if (now[i] < before[i]) return false;
    if (now[i] > before[i] + kQualityTolerance) return true;
  }
  return now.size() < before.size();
}

void Comparison::forget() {
  before_.clear();
  now_.clear();
  sorted_ = true;
}

void Comparison::look_at(const Transaction& transaction) {
  transaction.list_qualities(before_, now_);
  sorted_ = false;
}

Quality Comparison::worst_before() const {
  return sorted_ ? before_[0] : *std::min_element(before_.begin(), before_.end());
}

Quality Comparison::worst_now() const {
  return sorted_ ? now_[0] : *std::min_element(now_.begin(), now_.end());
}

std::span<const Quality> Comparison::before() {
  sort();
  return before_;
}

std::span<const Quality> Comparison::now() {
  sort();
  return now_;
}

void Comparison::sort() {
  if (sorted_) return;
  std::sort(before_.begin(), before_.end());
  std::sort(now_.begin(), now_.end());
  sorted_ = true;
}

Judge Judge::fair(const Fairness& fairness) {
  Judge judge(Kind::fair);
  judge.fairness_ = fairness;
  return judge;
}

Judge Judge::reaches(Quality goal) {
  Judge judge(Kind::reaches);
  judge.bound_ = goal;
  return judge;
}

Judge Judge::lowers_angle(double sine) {
  Judge judge(Kind::lowers_angle);
  judge.bound_ = sine;
  return judge;
}

Judge Judge::raises_mean(double usual) {
  Judge judge(Kind::raises_mean);
  judge.bound_ = usual;
  return judge;
}

Judge Judge::fits_lengths(Quality least) {
  Judge judge(Kind::fits_lengths);
  judge.bound_ = least;
  return judge;
}

Judge Judge::opening(double share) {
  Judge judge(Kind::opening);
  judge.bound_ = share;
  return judge;
}

std::string_view Judge::promise() const {
  switch (kind_) {
    case Kind::strict:
      return "the quality vector of what changed is better, and the worst tet gained the "
             "standard's price of each more bad tet";
    case Kind::fair:
      return "the quality vector is better, and the bad tets lack no more in sum or a desperate "
             "worst tet gained the price of each more bad tet";
    case Kind::reaches:
      return "the quality vector is better, or the tet aimed at reaches the goal and no bad tet is "
             "new or worse";
    case Kind::lowers_angle:
      return "the sine of the largest angle gained the price of each more bad tet, and the worst "
             "tet is no worse";
    case Kind::raises_mean:
      return "the mean ratios, each less a usual one, have a larger sum, and no bad tet is new or "
             "worse";
    case Kind::fits_lengths:
      return "the lengths that miss the wanted range are better as a vector, and no tet is below a "
             "least quality or the worst there was";
    case Kind::untangles:
      return "fewer tets are inverted or flat, and no more are bad";
    case Kind::opening:
      return "the worst tet keeps a share of the quality that the worst had";
  }
  return "";
}

double Judge::floor(double worst, double least_gain) const {
  switch (kind_) {
    case Kind::strict:
    case Kind::fair:
      return worst + least_gain;
    case Kind::reaches:
      return std::min(worst + least_gain, static_cast<double>(kBadThreshold));
    case Kind::raises_mean:
      return std::min(worst, static_cast<double>(kBadThreshold));
    case Kind::fits_lengths:
      return std::min(worst, bound_);
    case Kind::lowers_angle:
    case Kind::untangles:
      return worst;
    case Kind::opening:
      return bound_ * std::max(worst, 0.0);
  }
  return worst;
}

double Judge::deficit_limit(double worst, double lack) const {
  // deficit() has the exponent of the default; another one is for accepts() alone.
  const bool asks = kind_ == Kind::fair && fairness_.exponent == Fairness{}.exponent;
  return asks && worst >= fairness_.desperate ? lack : std::numeric_limits<double>::infinity();
}

bool keeps_limits(const Transaction& transaction, Comparison& qualities) {
  return keeps_limits(transaction, qualities, Judge::Kind::strict);
}

bool Judge::accepts(const Change& change) const {
  if (change.transaction.empty()) {
    change.qualities.forget();
    return false;
  }
  change.qualities.look_at(change.transaction);
  Aim aim;
  aim.price = change.transaction.mesh().standard().price();
  if (kind_ == Kind::reaches) aim.reached = reaches_goal(change, bound_);
  if (kind_ == Kind::lowers_angle) aim.sine = largest_angle_sine(change.transaction);
  if (kind_ == Kind::raises_mean) aim.gain = gain_of_means(change.transaction, bound_);
  if (kind_ == Kind::raises_mean && has_bad(change.qualities)) {
    const Goal goal = change.transaction.mesh().standard().goal();
    const Transaction::Tets tets = change.transaction.tets();
    aim.more_bad_angles = count_bad_angles(tets.now, goal) > count_bad_angles(tets.before, goal);
  }
  // The edges cost more than all qualities.
  if (kind_ == Kind::fits_lengths && keeps_share(change.qualities))
    aim.fits = fits_better(change.transaction);
  return holds_for(change.qualities, aim) &&
         (kind_ == Kind::opening || keeps_limits(change.transaction, change.qualities, kind_));
}

bool Judge::holds_for(Comparison& qualities, const Aim& aim) const {
  switch (kind_) {
    case Kind::strict:
      return is_better(qualities) && pays_price(qualities, aim.price);
    case Kind::fair:
      return is_better(qualities) && pays_price(qualities, aim.price) && is_fair(qualities);
    case Kind::reaches:
      return (is_better(qualities) && pays_price(qualities, aim.price)) ||
             (aim.reached && spares_bad(qualities));
    case Kind::lowers_angle:
      return lowers_angle(qualities, aim.sine);
    case Kind::raises_mean:
      return aim.gain > kQualityTolerance && !aim.more_bad_angles && spares_bad(qualities);
    case Kind::fits_lengths:
      return aim.fits && qualities.has_both() &&
             qualities.worst_now() >= floor(qualities.worst_before()) - kQualityTolerance;
    case Kind::untangles:
      return untangles(qualities);
    case Kind::opening:
      return keeps_share(qualities);
  }
  return false;
}

bool Judge::keeps_share(const Comparison& qualities) const {
  if (!qualities.has_both()) return true;
  return qualities.worst_now() >= floor(qualities.worst_before()) - kQualityTolerance;
}

bool Judge::pays_price(Comparison& qualities, double price) {
  if (price <= 0) return true;
  const std::ptrdiff_t more_bad = count_more_bad(qualities);
  if (more_bad <= 0) return true;
  if (!qualities.has_both()) return false;
  const double gain = qualities.worst_now() - qualities.worst_before();
  return gain >= price * static_cast<double>(more_bad);
}

bool Judge::is_fair(Comparison& qualities) const {
  if (pays(qualities)) return true;
  const double before = lack(qualities.before());
  const double now = lack(qualities.now());
  return fairness_.more_bad ? now < before : now <= before && count_more_bad(qualities) <= 0;
}

bool Judge::pays(Comparison& qualities) const {
  const auto before = qualities.before();
  const auto now = qualities.now();
  if (before.empty() || before[0] >= fairness_.desperate) return false;
  const double gain = now.empty() ? 1 : now[0] - before[0];
  return gain >= fairness_.price * static_cast<double>(count_more_bad(qualities));
}

double Judge::lack(std::span<const Quality> qualities) const {
  double sum = 0;
  const bool is_default = fairness_.exponent == Fairness{}.exponent;
  for (const Quality q : qualities) {
    if (q >= kBadThreshold) break;
    sum += is_default ? deficit(q) : std::pow(kBadThreshold - q, fairness_.exponent);
  }
  return sum;
}

bool Judge::spares_bad(Comparison& qualities) const {
  if (qualities.has_both() && qualities.worst_now() >= kBadThreshold &&
      qualities.worst_before() >= kBadThreshold) {
    return true;
  }
  const auto before = qualities.before();
  const auto now = qualities.now();
  const std::ptrdiff_t bad = count_bad(before);
  return count_bad(now) <= bad && static_cast<std::size_t>(bad) <= now.size() &&
         std::equal(before.begin(), before.begin() + bad, now.begin(),
                    [](Quality was, Quality is) { return is > was - kQualityTolerance; });
}

bool Judge::untangles(Comparison& qualities) {
  return mends(qualities) && count_more_bad(qualities) <= 0;
}

bool Judge::lowers_angle(Comparison& qualities, double sine) const {
  if (!qualities.has_both() || qualities.worst_now() < qualities.worst_before()) return false;
  const std::ptrdiff_t more_bad = std::max<std::ptrdiff_t>(1, count_more_bad(qualities));
  return sine - bound_ >= kPriceOfBad * static_cast<double>(more_bad);
}

}  // namespace tetmend
