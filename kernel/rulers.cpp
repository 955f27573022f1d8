// SPDX-License-Identifier: MIT
// Rulers of a mesh in one pass, four tets or faces at a time.
//
//   a value enters as a score: smaller is worse; a large value that is bad changes its sign, and an
//   angle is represented by its cosine
//   a sample of the tets tells a limit that about 3 % of the scores lie below
//   the pass sums up, and keeps the scores below the limit; the 1 % that are worst are among them
#include "kernel/rulers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "kernel/chunks.h"
#include "kernel/compensated_sum.h"
#include "kernel/ruler_histogram.h"
#include "kernel/ruler_shares.h"
#include "kernel/solver_rulers.h"
#include "kernel/tet_rows.h"

namespace tetmend {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();  // no score: below no limit
constexpr std::size_t kTetRulers = 8;
constexpr std::size_t kFaceRulers = 2;
constexpr std::size_t kSurveyed = kTetRulers + kFaceRulers;  // the others are of vertices
static_assert(kSurveyed + 1 == kRulerCount);

constexpr std::size_t at(Ruler ruler) {
  return static_cast<std::size_t>(ruler);
}

using Limits = std::array<double, kSurveyed>;

/// Of one ruler: the scores below a limit, and how many are just there.
struct Sieve {
  std::vector<double> kept;
  std::size_t equal = 0;

  void add(const WideVector& scores, double limit) {
    for (std::size_t i = 0; i < kWideLanes; ++i) {
      if (scores[i] < limit) kept.push_back(scores[i]);
      equal += scores[i] == limit ? 1 : 0;
    }
  }
};

/// The scores of N rulers for one block of tets or faces, and what they come to so far.
template <std::size_t N>
struct Tally {
  static constexpr std::size_t kGroups = PointRows<4>::kMost / kWideLanes;
  std::array<std::array<WideVector, kGroups>, N> scores;
  std::array<double, N> limits;
  std::array<std::uint32_t, N>
      low{};  // a bit for each group with a score that is not above the limit
  static_assert(kGroups == 32);
  std::array<WideVector, N> worst;
  std::array<WideSum, N> sums{};
  Tally(const Limits& all, std::size_t first) {
    worst.fill(WideVector{} + kUnbounded);
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(first), N, limits.begin());
  }
};

/// Enters the scores of the lanes that count. Not a number, after overflow, is as bad as can be.
template <std::size_t N, class Mask>
TETMEND_WIDE_INLINE void enter(Tally<N>& tally, std::size_t ruler, std::size_t n, WideVector score,
                               const Mask& counts) {
  const WideVector nothing = WideVector{} + kNothing;
  score = score == score ? score : WideVector{} - kUnbounded;
  const WideVector counted = counts ? score : nothing;
  tally.scores[ruler][n] = counted;
  tally.worst[ruler] = smaller(counted, tally.worst[ruler]);
  const auto low = counted <= tally.limits[ruler];
  tally.low[ruler] |= (low[0] | low[1] | low[2] | low[3]) != 0 ? 1u << n : 0u;
  add_to(tally.sums[ruler], counts ? score : WideVector{});
}

TETMEND_WIDE_INLINE WideVector root(const WideVector& p) {
  WideVector result = {};
  for (std::size_t i = 0; i < kWideLanes; ++i) result[i] = std::sqrt(p[i]);
  return result;
}
TETMEND_WIDE_INLINE WidePoint operator*(const WideVector& f, const WidePoint& p) {
  return {f * p.x, f * p.y, f * p.z};
}
TETMEND_WIDE_INLINE WidePoint operator+(const WidePoint& p, const WidePoint& q) {
  return {p.x + q.x, p.y + q.y, p.z + q.z};
}

/// Of a number that is not negative, to the last bit but one. A third of the exponent and Halley's
/// method, which triples the digits in each step.
TETMEND_WIDE_INLINE WideVector cube_root(const WideVector& x) {
  WideVector y = {};
  for (std::size_t i = 0; i < kWideLanes; ++i) {
    const double lane = x[i];
    y[i] = std::bit_cast<double>(std::bit_cast<std::uint64_t>(lane) / 3 + 0x2A9F789300000000ull);
  }
  for (int step = 0; step < 3; ++step) {
    const WideVector cube = y * y * y;
    y *= (cube + 2 * x) / (2 * cube + x);
  }
  return x > 0.0 ? y : WideVector{};
}

/// With r_i = 1 / l_i, the sum of r_i r_j r_k over the pairs ij of opposite edges and the four other
/// edges k: what SIGE has besides the volume.
TETMEND_WIDE_INLINE WideVector inverse_lengths(const std::array<WideVector, 6>& l) {
  const WideVector p = l[0] * l[5], q = l[1] * l[4], r = l[2] * l[3];  // opposite edges
  const WideVector inverse = 1.0 / (p * q * r);
  const WideVector qr = inverse * (q * r), pr = inverse * (p * r), pq = inverse * (p * q);
  const WideVector by_p = (l[0] + l[5]) * qr, by_q = (l[1] + l[4]) * pr, by_r = (l[2] + l[3]) * pq;
  return qr * (by_q + by_r) + pr * (by_p + by_r) + pq * (by_p + by_q);
}

/// Enters the scores of a block of tets. With u, v, w the edges from the first vertex and n_i the
/// four normals, twice the areas:
///   circumradius = ||u|^2 v x w + |v|^2 w x u + |w|^2 u x v| / (2 V6), inradius = V6 / sum |n_i|
///   |S|^2 |S^-1|^2 = (sum of l^2 / 2) (sum of |n|^2 / (2 V6^2)), S the map from the regular tet
TETMEND_WIDE void measure(const PointRows<4>& rows, Tally<kTetRulers>& tally,
                          WideVector& shortest_edge) {
  const WideVector zero = {};
  const WideVector infinity = zero + kUnbounded;
  for (std::size_t g = 0; g < rows.groups(); ++g) {
    const auto in_use = lanes_in_use(rows, g);
    const WidePoint p0 = wide_point(rows.group(g), 0), p1 = wide_point(rows.group(g), 1);
    const WidePoint p2 = wide_point(rows.group(g), 2), p3 = wide_point(rows.group(g), 3);
    const WidePoint u = p1 - p0, v = p2 - p0, w = p3 - p0, r = p2 - p1, s = p3 - p1, t = p3 - p2;
    const WidePoint a = cross(r, s), b = cross(v, w), c = cross(w, u), d = cross(u, v);
    const WideVector aa = dot(a, a), bb = dot(b, b), cc = dot(c, c), dd = dot(d, d);
    const WideVector uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
    const std::array<WideVector, 6> l = {root(uu),        root(vv),        root(ww),
                                         root(dot(r, r)), root(dot(s, s)), root(dot(t, t))};
    const WideVector longest = larger(larger(larger(l[0], l[1]), larger(l[2], l[3])),  //
                                      larger(l[4], l[5]));
    const WideVector shortest =
        smaller(smaller(smaller(l[0], l[1]), smaller(l[2], l[3])), smaller(l[4], l[5]));
    shortest_edge = smaller(in_use ? shortest : infinity, shortest_edge);
    const WideVector v6 = dot(u, b);
    const WideVector size = magnitude(v6);
    const WideVector squares = uu + vv + ww + dot(r, r) + dot(s, s) + dot(t, t);
    const WideVector area = root(aa) + root(bb) + root(cc) + root(dd);  // twice

    const WideVector third = cube_root(0.5 * size);
    const WideVector mean_ratio = 12.0 * third * third / squares;
    enter(tally, at(Ruler::mean_ratio), g,
          size > 0.0 ? (v6 < 0.0 ? -mean_ratio : mean_ratio) : zero, in_use);
    const WidePoint alpha = uu * b + vv * c + ww * d;
    const WideVector spheres = area * root(dot(alpha, alpha));
    enter(tally, at(Ruler::radius_ratio), g, spheres > 0.0 ? 6.0 * v6 * size / spheres : zero,
          in_use);
    const WideVector norms = root(squares * (aa + bb + cc + dd));
    enter(tally, at(Ruler::sicn), g, norms > 0.0 ? 6.0 * v6 / norms : zero, in_use);
    const WideVector sige = (std::numbers::sqrt2 / 12) * v6 * inverse_lengths(l);
    enter(tally, at(Ruler::sige), g, shortest > 0.0 ? sige : zero, in_use);
    enter(tally, at(Ruler::condition), g, v6 > 0.0 ? -norms / (6.0 * v6) : -infinity, in_use);
    const WideVector aspect = longest * area / (2 * std::sqrt(6.0) * v6);
    enter(tally, at(Ruler::aspect_ratio), g, v6 > 0.0 ? -aspect : -infinity, in_use);
    enter(tally, at(Ruler::edge_ratio), g, shortest > 0.0 ? -longest / shortest : -infinity,
          in_use);
    const WideVector largest = root(larger(larger(aa, bb), larger(cc, dd)));
    enter(tally, at(Ruler::least_altitude), g, largest > 0.0 ? v6 / largest : zero, in_use);
  }
}

/// Faces that count: the vertex opposite, the three of the face counterclockwise as seen from
/// outside, and the vertex beyond; on the boundary the first again.
struct FaceRows {
  PointRows<5> points;
  std::array<WideVector, PointRows<5>::kMost / kWideLanes> is_inner{};  // 1 or 0

  void add(const std::array<const Point*, 5>& face, bool inner) {
    const std::size_t i = points.size();
    is_inner[i / kWideLanes][i % kWideLanes] = inner ? 1 : 0;
    points.add(face);
  }
};

/// Cosine of the non-orthogonality, and skewness with changed sign.
struct FaceScores {
  WideVector cosine;
  WideVector skewness;
};

/// Of the face opposite `apex`, as OpenFOAM defines them; f0, f1, f2 counterclockwise as seen from
/// outside. Beyond the boundary there is the mirror image of the tet's centroid.
template <class Mask>
TETMEND_WIDE_INLINE FaceScores score_face(const WidePoint& apex, const WidePoint& f0,
                                          const WidePoint& f1, const WidePoint& f2,
                                          const WidePoint& beyond, const Mask& on_boundary) {
  constexpr double kTiny = 1e-150;
  const WideVector third = WideVector{} + 1.0 / 3, quarter = WideVector{} + 0.25;
  const WidePoint p = f1 - f0, q = f2 - f0, r = apex - f0;
  const WidePoint normal = cross(p, q);
  const WideVector square = dot(normal, normal);
  const WidePoint centre = third * (p + q);  // as all that follows: from f0
  const WidePoint to_face = centre - quarter * (p + q + r);
  const WideVector height = dot(normal, to_face);
  const WidePoint to_other = quarter * (beyond - apex);
  const WideVector along = dot(normal, to_other);
  const WideVector distance = root(dot(to_other, to_other));
  const WideVector norm = root(square);
  // Where the line from centroid to centroid meets the face's plane: `share` of its way.
  const WideVector share = height / ((on_boundary ? square : along) + kTiny);
  const WidePoint way = {on_boundary ? normal.x : to_other.x, on_boundary ? normal.y : to_other.y,
                         on_boundary ? normal.z : to_other.z};
  const WidePoint skew = to_face - share * way;
  const WideVector skew2 = dot(skew, skew);
  const WideVector reach =
      larger(magnitude(dot(skew, centre)),
             larger(magnitude(dot(skew, p - centre)), magnitude(dot(skew, q - centre))));
  const WideVector apart = on_boundary ? 2.0 * magnitude(share) * norm : distance;
  const WideVector extent = larger(0.2 * apart * root(skew2), reach);  // times the skewness vector
  const WideVector lengths = distance * norm;
  return {lengths > 0.0 ? along / lengths : WideVector{}, -(skew2 / (extent + kTiny))};
}

/// Faces between two tets of a larger non-orthogonality than that of a cosine.
struct FacesAbove {
  double cosine;
  WideVector counts = {};
};

/// Enters the scores of faces, and counts those of more than 70 degrees.
TETMEND_WIDE void measure_faces(const FaceRows& rows, Tally<kFaceRulers>& tally,
                                FacesAbove& above) {
  const WideVector zero = {};
  const WideVector one = zero + 1.0;
  for (std::size_t g = 0; g < rows.points.groups(); ++g) {
    const auto in_use = lanes_in_use(rows.points, g);
    const auto& group = rows.points.group(g);
    const auto is_inner = rows.is_inner[g] > 0.0;
    const FaceScores scores =
        score_face(wide_point(group, 0), wide_point(group, 1), wide_point(group, 2),
                   wide_point(group, 3), wide_point(group, 4), !is_inner);
    enter(tally, 0, g, scores.cosine, in_use & is_inner);
    above.counts += tally.scores[0][g] < above.cosine ? one : zero;
    enter(tally, 1, g, scores.skewness, in_use);
  }
}

/// The rulers of some tets and of their faces, before shares are taken.
struct Part {
  struct Scores {
    std::size_t count = 0;
    double worst = kUnbounded;
    CompensatedSum sum;
    Sieve sieve;
  };
  std::array<Scores, kSurveyed> of;
  std::size_t faces_above_70 = 0;
  double shortest_edge = kUnbounded;
};

double value_of(Ruler ruler, double score);

/// What a survey is of.
struct Subject {
  bool tets = true;
  bool faces = true;
  const std::function<bool(HalfFace)>* has_face = nullptr;  ///< null: all faces count
};

/// Measures the tets of a chunk, or every step-th of them.
class Surveyor {
 public:
  /// @param counts null, or counts what is measured
  Surveyor(const TetMesh& mesh, const Limits& limits, RulerHistograms* counts = nullptr,
           const Subject& subject = {})
      : mesh_(mesh),
        counts_(counts),
        subject_(subject),
        tets_(limits, 0),
        faces_(limits, kTetRulers),
        faces_above_70_{std::cos(70 * std::numbers::pi / 180)} {}

  Part run(std::size_t begin, std::size_t end, std::size_t step) {
    visit_rows(mesh_, begin, end, step, [&](const TetRows& rows) {
      for (std::size_t i = 0; i < rows.points.size(); ++i) {
        for (const HalfFace twin : mesh_.neighbours(rows.tets[i])) {
          if (!twin.is_outside()) mesh_.prefetch(twin.tet());
        }
      }
      if (subject_.tets) {
        measure(rows.points, tets_, shortest_edge_);
        sift(tets_, 0);
        count(tets_, 0, rows.points.size());
        for (std::size_t r = 0; r < kTetRulers; ++r) part_.of[r].count += rows.points.size();
      }
      if (subject_.faces) look_around(rows);
    });
    finish_faces();
    for (std::size_t i = 0; i < kWideLanes; ++i) {
      part_.shortest_edge = std::min<double>(part_.shortest_edge, shortest_edge_[i]);
      part_.faces_above_70 += static_cast<std::size_t>(faces_above_70_.counts[i]);
    }
    for (std::size_t r = 0; r < kTetRulers; ++r) close(tets_, r, r);
    for (std::size_t r = 0; r < kFaceRulers; ++r) close(faces_, r, kTetRulers + r);
    return std::move(part_);
  }

 private:
  template <std::size_t N>
  void count(const Tally<N>& tally, std::size_t first, std::size_t size) {
    if (counts_ == nullptr) return;
    for (std::size_t r = 0; r < N; ++r) {
      RulerHistogram& histogram = (*counts_)[first + r];
      const auto ruler = static_cast<Ruler>(first + r);
      const auto* scores = reinterpret_cast<const double*>(tally.scores[r].data());
      for (std::size_t i = 0; i < size; ++i) {
        if (std::isnan(scores[i])) continue;  // no score
        const double value = value_of(ruler, scores[i]);
        ++histogram
              .counts[histogram.bins.find(is_length(ruler) ? mesh_.scale().to_file(value) : value)];
      }
    }
  }
  template <std::size_t N>
  void sift(Tally<N>& tally, std::size_t first) {
    for (std::size_t r = 0; r < N; ++r) {
      Sieve& sieve = part_.of[first + r].sieve;
      for (std::uint32_t low = std::exchange(tally.low[r], 0u); low != 0; low &= low - 1) {
        sieve.add(tally.scores[r][static_cast<std::size_t>(std::countr_zero(low))],
                  tally.limits[r]);
      }
    }
  }
  template <std::size_t N>
  void close(const Tally<N>& tally, std::size_t row, std::size_t ruler) {
    Part::Scores& scores = part_.of[ruler];
    for (std::size_t i = 0; i < kWideLanes; ++i) {
      scores.worst = std::min<double>(scores.worst, tally.worst[row][i]);
    }
    scores.sum.add(tally.sums[row].total());
  }

  /// Each inner face counts once, with the tet of the lower number.
  void look_around(const TetRows& rows) {
    for (std::size_t i = 0; i < rows.points.size(); ++i) {
      const TetHandle t = rows.tets[i];
      const TetVertices& v = mesh_.vertices(t);
      const auto& twins = mesh_.neighbours(t);
      for (unsigned f = 0; f < 4; ++f) {
        const bool is_inner = !twins[f].is_outside();
        if (is_inner && twins[f].tet() < t) continue;
        if (subject_.has_face != nullptr && !(*subject_.has_face)(HalfFace(t, f))) continue;
        const VertexHandle beyond =
            is_inner ? mesh_.vertices(twins[f].tet())[twins[f].face()] : v[f];
        const auto& [j, k, l] = kFaceVertices[f];
        face_rows_.add({&mesh_.point(v[f]), &mesh_.point(v[j]), &mesh_.point(v[k]),
                        &mesh_.point(v[l]), &mesh_.point(beyond)},
                       is_inner);
        part_.of[at(Ruler::non_orthogonality)].count += is_inner ? 1 : 0;
        ++part_.of[at(Ruler::skewness)].count;
        if (face_rows_.points.is_full()) finish_faces();
      }
    }
  }
  void finish_faces() {
    if (face_rows_.points.size() == 0) return;
    face_rows_.points.pad();
    measure_faces(face_rows_, faces_, faces_above_70_);
    sift(faces_, kTetRulers);
    count(faces_, kTetRulers, face_rows_.points.size());
    face_rows_.points.clear();
  }

  const TetMesh& mesh_;
  RulerHistograms* counts_;
  Subject subject_;
  FaceRows face_rows_;
  Tally<kTetRulers> tets_;
  Tally<kFaceRulers> faces_;
  FacesAbove faces_above_70_;
  WideVector shortest_edge_ = WideVector{} + kUnbounded;
  Part part_;
};

/// Small meshes are to keep several threads busy, too.
constexpr std::size_t kTetsOfPart = kChunkSize / 4;

std::vector<Part> survey(const TetMesh& mesh, const Limits& limits, std::size_t step) {
  return map_chunks<Part>(
      mesh.tet_slots(),
      [&](std::size_t begin, std::size_t end) {
        return Surveyor(mesh, limits).run(begin, end, step);
      },
      step * kTetsOfPart);
}

/// Score number `rank`, from 0 for the worst; nothing if too few lie below the limit.
std::optional<double> find_score(std::vector<Part>& parts, std::size_t ruler, std::size_t rank,
                                 double limit) {
  std::vector<double> kept;
  std::size_t equal = 0;
  for (Part& part : parts) {
    Sieve& sieve = part.of[ruler].sieve;
    kept.insert(kept.end(), sieve.kept.begin(), sieve.kept.end());
    equal += sieve.equal;
  }
  if (rank < kept.size()) {
    const auto place = kept.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(kept.begin(), place, kept.end());
    return *place;
  }
  return rank < kept.size() + equal ? std::optional(limit) : std::nullopt;
}

std::size_t count_scores(const std::vector<Part>& parts, std::size_t ruler) {
  std::size_t count = 0;
  for (const Part& part : parts) count += part.of[ruler].count;
  return count;
}

/// For each ruler a score that more than 1 % of all lie below, most likely. It decides what a pass
/// keeps, never a result.
Limits estimate_limits(const TetMesh& mesh) {
  constexpr std::size_t kStep = 61;
  constexpr std::size_t kLeast = 1000;  // tets of a sample that tells anything
  Limits limits;
  limits.fill(kUnbounded);
  if (mesh.tet_count() < kLeast * kStep) return limits;
  auto sample = survey(mesh, limits, kStep);
  Limits estimate;
  for (std::size_t r = 0; r < kSurveyed; ++r) {
    const std::size_t rank = 3 * count_scores(sample, r) / 100;
    estimate[r] = find_score(sample, r, rank, kUnbounded).value_or(kUnbounded);
  }
  return estimate;
}

/// What a score stands for.
double value_of(Ruler ruler, double score) {
  if (ruler == Ruler::non_orthogonality) {
    return std::acos(std::clamp(score, -1.0, 1.0)) * 180 / std::numbers::pi;
  }
  return kRulers[at(ruler)].large_is_good ? score : 0 - score;
}

/// Nothing if the limit was too low.
std::optional<RulerFigures> figures_of(Ruler ruler, std::vector<Part>& parts, double limit) {
  const std::size_t count = count_scores(parts, at(ruler));
  if (count == 0) return RulerFigures();
  const auto one_percent = find_score(parts, at(ruler), (count + 99) / 100 - 1, limit);
  if (!one_percent) return std::nullopt;
  double worst = kUnbounded;
  CompensatedSum sum;
  for (const Part& part : parts) {
    worst = std::min(worst, part.of[at(ruler)].worst);
    sum.add(part.of[at(ruler)].sum);
  }
  const double mean = std::isinf(worst) ? worst : sum.value() / static_cast<double>(count);
  return RulerFigures{value_of(ruler, worst), value_of(ruler, *one_percent), value_of(ruler, mean)};
}

/// Of all vertices of tets, in the order of their slots.
std::vector<double> steps_of(const P1Diagonals& diagonals) {
  std::vector<double> steps;
  for (std::size_t i = 0; i < diagonals.mass.size(); ++i) {
    const VertexHandle v(static_cast<std::uint32_t>(i));
    if (diagonals.is_in_use(v)) steps.push_back(diagonals.step(v));
  }
  return steps;
}

RulerFigures step_figures(const P1Diagonals& diagonals) {
  std::vector<double> steps = steps_of(diagonals);
  if (steps.empty()) return {};
  CompensatedSum sum;
  for (const double step : steps) sum.add(step);
  const auto rank = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() + 99) / 100 - 1);
  std::nth_element(steps.begin(), rank, steps.end());
  return {stable_step(diagonals), *rank, sum.value() / static_cast<double>(steps.size())};
}

}  // namespace

MeshRulers measure_rulers(const TetMesh& mesh, CgSteps steps) {
  return measure_rulers(mesh, p1_diagonals(mesh), steps);
}

MeshRulers measure_rulers(const TetMesh& mesh, const P1Diagonals& diagonals, CgSteps steps) {
  Limits limits = estimate_limits(mesh);
  auto parts = survey(mesh, limits, 1);
  MeshRulers result;
  if (mesh.tet_count() > 0) result.shortest_edge = kUnbounded;
  for (const Part& part : parts) {
    result.shortest_edge = std::min(result.shortest_edge, part.shortest_edge);
    result.inner_faces += part.of[at(Ruler::non_orthogonality)].count;
    result.faces_above_70 += part.faces_above_70;
  }
  for (std::size_t r = 0; r < kSurveyed; ++r) {
    auto figures = figures_of(static_cast<Ruler>(r), parts, limits[r]);
    if (!figures) {  // the sample was misleading: keep all
      limits.fill(kUnbounded);
      parts = survey(mesh, limits, 1);
      figures = figures_of(static_cast<Ruler>(r), parts, kUnbounded);
    }
    result.figures[r] = *figures;
  }
  result.figures[at(Ruler::step)] = step_figures(diagonals);
  result.cg_steps = steps == CgSteps::estimated ? estimate_cg_steps(mesh, diagonals) : kNothing;
  result.work = static_cast<double>(mesh.tet_count()) * result.cg_steps;
  const Scale& scale = mesh.scale();
  result.shortest_edge = scale.to_file(result.shortest_edge);
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    if (!is_length(static_cast<Ruler>(r))) continue;
    RulerFigures& of = result.figures[r];
    for (double* length : {&of.worst, &of.one_percent, &of.mean}) *length = scale.to_file(*length);
  }
  return result;
}

RulerHistograms bins_for(const MeshRulers& means) {
  RulerHistograms empty;
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    empty[r].bins = RulerBins(static_cast<Ruler>(r), means.figures[r].mean);
  }
  return empty;
}

namespace {

/// Adds what a survey counts.
void count_survey(const TetMesh& mesh, const Subject& subject, RulerHistograms& counts) {
  Limits keep_none;
  keep_none.fill(-kUnbounded);
  RulerHistograms empty = counts;
  for (RulerHistogram& of : empty) of.counts = {};
  const auto parts =
      map_chunks<RulerHistograms>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
        RulerHistograms part = empty;
        Surveyor(mesh, keep_none, &part, subject).run(begin, end, 1);
        return part;
      });
  for (const RulerHistograms& part : parts) {
    for (std::size_t r = 0; r < kRulerCount; ++r) {
      for (std::size_t i = 0; i < RulerBins::kCount; ++i) counts[r].counts[i] += part[r].counts[i];
    }
  }
}

/// The steps at the vertices that count, as in the file, in the order of their slots.
std::vector<double> steps_of(const TetMesh& mesh, const RulerScope& scope,
                             const P1Diagonals& diagonals) {
  std::vector<double> steps;
  for (std::size_t i = 0; i < diagonals.mass.size(); ++i) {
    const VertexHandle v(static_cast<std::uint32_t>(i));
    if (!diagonals.is_in_use(v) || !scope.has_vertex(v)) continue;
    steps.push_back(mesh.scale().to_file(diagonals.step(v)));
  }
  return steps;
}

}  // namespace

RulerHistograms count_rulers(const TetMesh& mesh, const MeshRulers& means) {
  RulerHistograms all = bins_for(means);
  count_survey(mesh, {}, all);
  RulerHistogram& of_steps = all[at(Ruler::step)];
  for (const double step : steps_of(p1_diagonals(mesh))) {
    ++of_steps.counts[of_steps.bins.find(mesh.scale().to_file(step))];
  }
  return all;
}

// ---- Share by share -----------------------------------------------------------------------------

void RulerShare::add(const RulerShare& other) {
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    of[r].count += other.of[r].count;
    of[r].worst = std::min(of[r].worst, other.of[r].worst);
    of[r].sum.add(other.of[r].sum);
  }
  shortest_edge = std::min(shortest_edge, other.shortest_edge);
  faces_above_70 += other.faces_above_70;
  turned += other.turned;
}

/// A tet has four vertices and four faces at most.
WorstScores::WorstScores(std::uint64_t tets) {
  limits_.fill(kUnbounded);
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    most_[r] = static_cast<std::size_t>(place_of_one_percent(r < kTetRulers ? tets : 4 * tets) + 1);
  }
}

void WorstScores::add(std::size_t ruler, const std::vector<double>& scores) {
  std::vector<double>& all = scores_[ruler];
  const std::size_t most = most_[ruler];
  all.insert(all.end(), scores.begin(), scores.end());
  if (most == 0 || all.size() <= most + most / 4) return;
  const auto last = all.begin() + static_cast<std::ptrdiff_t>(most - 1);
  std::nth_element(all.begin(), last, all.end());
  limits_[ruler] = *last;
  all.resize(most);
}

const std::vector<double>& WorstScores::sorted(std::size_t ruler) {
  std::sort(scores_[ruler].begin(), scores_[ruler].end());
  return scores_[ruler];
}

namespace {

constexpr std::size_t kSlotsAtOnce = 16 * kTetsOfPart;  // what is kept of them is little

/// The rulers [first, last) of a survey, with lengths as in the file.
void add_survey(const TetMesh& mesh, const Subject& subject, std::size_t first, std::size_t last,
                WorstScores& worst, RulerShare& share) {
  const auto to_file = [&](std::size_t ruler, double score) {
    return is_length(static_cast<Ruler>(ruler)) ? mesh.scale().to_file(score) : score;
  };
  for (std::size_t begin = 0; begin < mesh.tet_slots(); begin += kSlotsAtOnce) {
    Limits limits;
    std::copy_n(worst.limits().begin(), kSurveyed, limits.begin());
    for (std::size_t r = 0; r < kSurveyed; ++r) {
      if (is_length(static_cast<Ruler>(r))) limits[r] = mesh.scale().to_work(limits[r]);
    }
    const auto parts = map_chunks<Part>(
        std::min(kSlotsAtOnce, mesh.tet_slots() - begin),
        [&](std::size_t from, std::size_t to) {
          return Surveyor(mesh, limits, nullptr, subject).run(begin + from, begin + to, 1);
        },
        kTetsOfPart);
    for (const Part& part : parts) {
      for (std::size_t r = first; r < last; ++r) {
        RulerShare::Scores& of = share.of[r];
        of.count += part.of[r].count;
        of.worst = std::min(of.worst, to_file(r, part.of[r].worst));
        of.sum.add(to_file(r, part.of[r].sum.value()));
        std::vector<double> kept = part.of[r].sieve.kept;
        for (double& score : kept) score = to_file(r, score);
        worst.add(r, kept);
      }
      share.faces_above_70 += part.faces_above_70;
      share.shortest_edge = std::min(share.shortest_edge, mesh.scale().to_file(part.shortest_edge));
    }
  }
}

}  // namespace

void measure_tets(const TetMesh& mesh, RulerShare& share, WorstScores& worst) {
  add_survey(mesh, {.tets = true, .faces = false}, 0, kTetRulers, worst, share);
}

void measure_around(const TetMesh& mesh, const RulerScope& scope, RulerShare& share,
                    WorstScores& worst) {
  add_survey(mesh, {.tets = false, .faces = true, .has_face = &scope.has_face}, kTetRulers,
             kSurveyed, worst, share);
  const P1Diagonals diagonals = p1_diagonals(mesh);
  if (mesh.tet_count() > 0 && !diagonals.are_positive) ++share.turned;
  const std::vector<double> steps = steps_of(mesh, scope, diagonals);
  RulerShare::Scores& of_steps = share.of[at(Ruler::step)];
  of_steps.count += steps.size();
  for (const double step : steps) {
    of_steps.worst = std::min(of_steps.worst, step);
    of_steps.sum.add(step);
  }
  worst.add(at(Ruler::step), steps);
}

void count_tets(const TetMesh& mesh, RulerHistograms& counts) {
  count_survey(mesh, {.tets = true, .faces = false}, counts);
}

void count_around(const TetMesh& mesh, const RulerScope& scope, RulerHistograms& counts) {
  count_survey(mesh, {.tets = false, .faces = true, .has_face = &scope.has_face}, counts);
  RulerHistogram& of_steps = counts[at(Ruler::step)];
  for (const double step : steps_of(mesh, scope, p1_diagonals(mesh))) {
    ++of_steps.counts[of_steps.bins.find(step)];
  }
}

MeshRulers rulers_of(const RulerShare& all, const std::array<double, kRulerCount>& one_percent) {
  MeshRulers result;
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    const auto ruler = static_cast<Ruler>(r);
    const RulerShare::Scores& scores = all.of[r];
    if (scores.count == 0) continue;
    const double mean = std::isinf(scores.worst)
                            ? scores.worst
                            : scores.sum.value() / static_cast<double>(scores.count);
    result.figures[r] = {value_of(ruler, scores.worst), value_of(ruler, one_percent[r]),
                         value_of(ruler, mean)};
  }
  if (all.turned > 0) result.figures[at(Ruler::step)].worst = 0;
  result.shortest_edge = all.of[0].count > 0 ? all.shortest_edge : 0;
  result.inner_faces = all.of[at(Ruler::non_orthogonality)].count;
  result.faces_above_70 = all.faces_above_70;
  result.cg_steps = result.work = kNothing;
  return result;
}

}  // namespace tetmend
