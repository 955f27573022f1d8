// SPDX-License-Identifier: MIT
#include "pieces/figures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "face/bad_tets.h"
#include "kernel/boundary_layers.h"
#include "kernel/integrity.h"
#include "kernel/mesh_builder.h"
#include "kernel/surface_fingerprint.h"
#include "pieces/bytes.h"
#include "pieces/piece_task.h"

namespace tetmend::pieces {

namespace {

void add_shares(const MeshStatistics& part, MeshStatistics& all) {
  const double old_share =
      static_cast<double>(all.tets) / static_cast<double>(all.tets + part.tets);
  const auto mean = [old_share](double& to, double from) {
    to = old_share * to + (1 - old_share) * from;
  };
  mean(all.lambda, part.lambda);
  for (std::size_t i = 0; i < all.lambda_bands.size(); ++i) {
    mean(all.lambda_bands[i], part.lambda_bands[i]);
  }
  mean(all.q_mean, part.q_mean);
  const double bad = static_cast<double>(std::max<std::size_t>(1, all.n_bad + part.n_bad));
  all.q_aver = (all.q_aver * static_cast<double>(all.n_bad) +
                part.q_aver * static_cast<double>(part.n_bad)) /
               bad;
}

/// Both have tets.
void add_tets(const MeshStatistics& part, MeshStatistics& all) {
  add_shares(part, all);
  all.tets += part.tets;
  all.inverted += part.inverted;
  all.flat += part.flat;
  all.volume += part.volume;
  // Of the larger scale: what the other adds is small then.
  const int scale = std::max(all.scale, part.scale);
  all.scaled_volume = std::ldexp(all.scaled_volume, 3 * (all.scale - scale)) +
                      std::ldexp(part.scaled_volume, 3 * (part.scale - scale));
  all.scale = scale;
  all.theta_min = std::min(all.theta_min, part.theta_min);
  all.theta_max = std::max(all.theta_max, part.theta_max);
  all.q_worst = std::min(all.q_worst, part.q_worst);
  all.n_bad += part.n_bad;
  for (std::size_t i = 0; i < all.histogram.size(); ++i) all.histogram[i] += part.histogram[i];
}

/// A part may own vertices and faces, and no tet.
void add_statistics(const MeshStatistics& part, MeshStatistics& all) {
  const std::size_t vertices = all.vertices + part.vertices;
  const std::size_t boundary_triangles = all.boundary_triangles + part.boundary_triangles;
  if (all.tets == 0) {
    all = part;
  } else if (part.tets > 0) {
    add_tets(part, all);
  }
  all.vertices = vertices;
  all.boundary_triangles = boundary_triangles;
}

/// @param numbers of the tets in the piece, by slot
void count_protected(const Piece& own, std::span<const std::uint32_t> numbers,
                     const Standard& standard, TetMesh& mesh, Figures& figures) {
  figures.protected_tets = static_cast<std::size_t>(std::count_if(
      own.tets.begin(), own.tets.end(), [](const PieceTet& tet) { return tet.is_protected(); }));
  if (figures.protected_tets == 0) return;
  mesh.set_standard(standard);
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const bool counts = own.tets[numbers[slot]].is_protected();
    if (counts && mesh.quality(TetHandle(slot)) < kBadThreshold) ++figures.protected_bad_tets;
  }
}

std::size_t count_touched(const Piece& own) {
  return static_cast<std::size_t>(
      std::count_if(own.tets.begin(), own.tets.end(), [&](const PieceTet& tet) {
        return (tet.origin & ~PieceTet::kProtected) == PieceTet::kNone ||
               std::any_of(tet.vertices.begin(), tet.vertices.end(),
                           [&](std::uint32_t v) { return (own.marks[v] & kMoved) != 0; });
      }));
}

}  // namespace

void Figures::add(const Figures& other) {
  add_statistics(other.statistics, statistics);
  surface += other.surface;
  not_positive += other.not_positive;
  peculiar += other.peculiar;
  constrained_faces += other.constrained_faces;
  layer_tets += other.layer_tets;
  touched += other.touched;
  protected_tets += other.protected_tets;
  protected_bad_tets += other.protected_bad_tets;
  misfits += other.misfits;
  rulers.add(other.rulers);
  sizes.add(other.sizes);
}

Bounds bounds_of_own(const Piece& gathered, const Parting& parting, std::uint32_t number,
                     const Standard& standard) {
  const std::vector<std::uint32_t> parts = parting.parts_of(gathered);
  Bounds bounds = Bounds::of_goal(standard);
  for (const PieceTet& tet : gathered.tets) {
    if (!is_own(tet.vertices, parts, number)) continue;
    const auto point = [&](std::size_t i) { return gathered.points[tet.vertices[i]]; };
    bounds.widen(point(0), point(1), point(2), point(3));
  }
  return bounds;
}

namespace {

/// A tet of the piece that has the corners of another one; nothing: there is none.
std::optional<std::size_t> find_again(const Piece& gathered, std::size_t tet) {
  const auto corners = [&](std::size_t t) {
    auto v = gathered.tets[t].vertices;
    std::sort(v.begin(), v.end());
    return v;
  };
  const auto wanted = corners(tet);
  for (std::size_t t = 0; t < gathered.tets.size(); ++t) {
    if (t != tet && corners(t) == wanted) return t;
  }
  return std::nullopt;
}

/// @throws Error with the number in the file of a tet that does not fit
TetMesh build_first(const Piece& gathered, BuildReport& report,
                    std::vector<std::uint32_t>* numbers = nullptr) {
  MeshData data = to_data(gathered);
  try {
    return TetMesh::build(data, {.report = &report, .tet_numbers = numbers});
  } catch (const BuildError& error) {
    const auto number_of = [&](std::size_t t) {
      return gathered.tets[t].origin & ~PieceTet::kProtected;
    };
    const std::uint32_t number = number_of(error.tet());
    if (number == PieceTet::kNone) throw;
    if (const auto other = find_again(gathered, error.tet())) {
      const auto [first, again] =
          std::minmax({number, number_of(*other)});  // values, not references
      throw Error(fmt::format(
          "tet {} of the file is tet {} again: a run in pieces drops none, 'tetmend convert' does",
          std::uint64_t{again} + 1, std::uint64_t{first} + 1));
    }
    throw Error(fmt::format("tet {} of the file: counted from 0 in its piece, {}",
                            std::uint64_t{number} + 1, error.what()));
  }
}

/// What is a piece's own in a mesh of all of it.
class OwnOf {
 public:
  OwnOf(const TetMesh& mesh, const Piece& gathered, const Parting& parting, std::uint32_t number)
      : mesh_(mesh), gathered_(gathered), parts_(parting.parts_of(gathered)), number_(number) {}

  bool has(const std::array<VertexHandle, 3>& face) const {
    std::array<std::uint32_t, 3> vertices{};
    for (std::size_t i = 0; i < 3; ++i) vertices[i] = mesh_.origin(face[i]);
    return is_own(vertices, parts_, number_);
  }
  bool has(const PieceTet& tet) const { return is_own(tet.vertices, parts_, number_); }
  std::uint32_t part() const { return number_; }
  bool has(VertexHandle v) const { return parts_[mesh_.origin(v)] == number_; }
  bool has(VertexHandle a, VertexHandle b) const {
    return is_own(std::array{mesh_.origin(a), mesh_.origin(b)}, parts_, number_);
  }
  RulerScope scope() const {
    return {.has_face = [this](HalfFace face) { return has(mesh_.vertices(face)); },
            .has_vertex = [this](VertexHandle v) { return has(v); }};
  }
  /// Of an own vertex of the file.
  std::optional<std::uint64_t> number_in_file(VertexHandle v, const Survey& survey) const {
    const std::uint64_t number = gathered_.ids[mesh_.origin(v)] - survey.first_id;
    return has(v) && number < survey.vertices ? std::optional(number) : std::nullopt;
  }

 private:
  const TetMesh& mesh_;
  const Piece& gathered_;
  const std::vector<std::uint32_t> parts_;
  const std::uint32_t number_;
};

/// Without its constraints.
TetMesh build_own(const Piece& own, std::vector<std::uint32_t>* numbers) {
  MeshData data = to_data(own);
  data.triangles.clear();
  data.edges.clear();
  return TetMesh::build(data, {.report = nullptr, .tet_numbers = numbers});
}

constexpr std::uint8_t kAllFixed = 0b1111;

bool is_worse_tet(const NamedTet& a, const NamedTet& b) {
  return std::tie(a.facts.quality, a.part, a.facts.tet) <
         std::tie(b.facts.quality, b.part, b.facts.tet);
}

void keep_worst(std::vector<NamedTet>& tets) {
  std::sort(tets.begin(), tets.end(), is_worse_tet);
  if (tets.size() > kMostNamed) tets.resize(kMostNamed);
}

/// Of other parts: 0 where those have no such vertex.
void add_lengths(std::span<const double> others, std::span<double> lengths) {
  for (std::size_t i = 0; i < lengths.size(); ++i) lengths[i] = std::max(lengths[i], others[i]);
}

/// @param number in the piece
NamedTet name_tet(const TetMesh& mesh, TetHandle t, const Piece& gathered, std::uint64_t number,
                  std::uint8_t fixed) {
  NamedTet named{.facts = face::describe(mesh, t, Hindrance::search)};
  for (unsigned i = 0; i < 4; ++i) {
    const VertexHandle v = mesh.vertices(t)[i];
    named.vertices[i] = gathered.ids[mesh.origin(v)];
    const Point p = mesh.point_in_file(v);
    named.corners[i] = {p.x(), p.y(), p.z()};
  }
  named.fixed = fixed;
  named.facts.tet = number;
  return named;
}

/// Bad tets with an own vertex: the worst of its own, and what holds those that are not protected.
void find_holders(TetMesh& mesh, std::span<const std::uint32_t> numbers, const Piece& gathered,
                  const OwnOf& own, const Standard& standard, Survey& survey) {
  std::vector<NamedTet> worst;
  mesh.set_standard(standard);
  mesh.freeze([&](TetHandle t) { return gathered.tets[numbers[t.index()]].is_protected(); });
  const face::HolderSearch search(mesh, [&](VertexHandle v) { return own.has(v); });
  for (const HalfFace face : search.named_faces()) {
    survey.held.named_faces += own.has(mesh.vertices(face)) ? 1 : 0;
  }
  mesh.visit_below(kBadThreshold, 0, mesh.tet_slots(), [&](TetHandle t) {
    const TetVertices& v = mesh.vertices(t);
    const auto is_mine = [&](VertexHandle w) { return own.has(w); };
    const bool is_protected = mesh.is_frozen(t);
    if (std::none_of(v.begin(), v.end(), is_mine)) return;
    const face::Holders holders = search.find(t);
    const bool is_own_tet = own.has(gathered.tets[numbers[t.index()]]);
    if (is_own_tet && misses_goal(mesh, t)) {
      const std::uint8_t fixed = is_protected ? kAllFixed : holders.fixed;
      worst.push_back(name_tet(mesh, t, gathered, numbers[t.index()], fixed));
      if (worst.size() > 64 * kMostNamed) keep_worst(worst);
    }
    if (is_protected) return;
    if (std::all_of(v.begin(), v.end(), is_mine)) return survey.held.add(holders);
    const auto id = [&](unsigned i) { return gathered.ids[mesh.origin(v[i])]; };
    std::array<unsigned, 4> order = {0, 1, 2, 3};
    std::sort(order.begin(), order.end(), [&](unsigned a, unsigned b) { return id(a) < id(b); });
    SharedTet& shared = survey.shared.emplace_back();
    shared.holders = holders;
    shared.holders.at_surface = shared.holders.fixed = 0;
    for (unsigned i = 0; i < 4; ++i) {
      shared.vertices[i] = id(order[i]);
      const auto move = [&](unsigned bits) {
        return static_cast<std::uint8_t>(((bits >> order[i]) & 1U) << i);
      };
      shared.holders.at_surface |= move(holders.at_surface);
      shared.holders.fixed |= move(holders.fixed);
    }
  });
  keep_worst(worst);
  for (NamedTet& tet : worst) {  // its number among those that are stored
    const auto end = gathered.tets.begin() + static_cast<std::ptrdiff_t>(tet.facts.tet);
    tet.part = own.part();
    tet.facts.tet = static_cast<std::size_t>(std::count_if(
        gathered.tets.begin(), end, [&](const PieceTet& other) { return own.has(other); }));
    survey.worst_tets.push_back(tet);
  }
  keep_worst(survey.worst_tets);
}

/// What is asked of a mesh that has all tets at the own faces and vertices.
void measure_all(const TetMesh& mesh, const OwnOf& own, Survey* survey, Figures& figures) {
  const auto is_own_face = [&](const std::array<VertexHandle, 3>& face) { return own.has(face); };
  figures.surface = surface_fingerprint(mesh, is_own_face);
  figures.layer_tets = find_boundary_layers(mesh).tets.size();
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(TetHandle(slot), f);
      const HalfFace twin = mesh.twin(face);
      const bool is_inner = !twin.is_outside();
      if (is_inner && (twin < face || !mesh.is_constrained(face))) continue;
      if (!own.has(mesh.vertices(face))) continue;
      ++(is_inner ? figures.constrained_faces : figures.statistics.boundary_triangles);
    }
  }
  if (survey == nullptr) return;
  measure_around(mesh, own.scope(), figures.rulers, survey->worst);
  survey->lengths.add(mesh, [&](VertexHandle v) { return own.number_in_file(v, *survey); });
}

face::SizeCounts sizes_of_own(const TetMesh& mesh, std::span<const std::uint32_t> numbers,
                              const Piece& gathered, const OwnOf& own,
                              const WantedLengths& of_file) {
  const auto field = in_work(of_file, mesh.scale());
  const WantedLengths& wanted = *field;
  const auto has_tet = [&](TetHandle t) { return own.has(gathered.tets[numbers[t.index()]]); };
  const auto has_edge = [&](VertexHandle a, VertexHandle b) { return own.has(a, b); };
  const auto has_vertex = [&](VertexHandle v) { return own.has(v); };
  return face::count_sizes(mesh, wanted, {has_edge, has_tet, has_vertex});
}

}  // namespace

void Survey::add(Survey other) {
  for (std::size_t r = 0; r < kRulerCount; ++r) worst.add(r, other.worst.sorted(r));
  add_lengths(other.lengths.lengths(), lengths.lengths());
  held.add(other.held);
  shared.insert(shared.end(), other.shared.begin(), other.shared.end());
  worst_tets.insert(worst_tets.end(), other.worst_tets.begin(), other.worst_tets.end());
  keep_worst(worst_tets);
}

Figures measure_own(const Piece& gathered, const Parting& parting, std::uint32_t number,
                    const Standard& standard, Survey* survey, const WantedLengths* wanted,
                    const HeldSurface* surface) {
  Figures figures;
  if (!gathered.tets.empty()) {
    BuildReport report;
    std::vector<std::uint32_t> numbers;
    TetMesh mesh = build_first(gathered, report, &numbers);
    figures.peculiar = report.reordered_tets + report.inverted_tets + report.flat_tets +
                       (report.mirrored ? gathered.tets.size() : 0);
    const OwnOf own(mesh, gathered, parting, number);
    measure_all(mesh, own, survey, figures);
    if (wanted != nullptr) figures.sizes = sizes_of_own(mesh, numbers, gathered, own, *wanted);
    if (surface != nullptr) {
      figures.misfits = surface->count_misfits(mesh, gathered, parting, number);
    }
    if (survey != nullptr && survey->finds_holders) {
      find_holders(mesh, numbers, gathered, own, standard, *survey);
    }
  }
  const Piece own = own_part(gathered, parting, number);
  figures.touched = count_touched(own);
  const std::size_t boundary = figures.statistics.boundary_triangles;
  if (!own.tets.empty()) {
    std::vector<std::uint32_t> numbers;
    TetMesh mesh = build_own(own, &numbers);
    figures.statistics = compute_statistics(mesh, standard.goal());
    figures.not_positive = count_not_positive(mesh, figures.statistics);
    if (survey != nullptr) measure_tets(mesh, figures.rulers, survey->worst);
    count_protected(own, numbers, standard, mesh, figures);
  }
  figures.statistics.boundary_triangles = boundary;
  figures.statistics.vertices = static_cast<std::size_t>(std::count_if(
      own.marks.begin(), own.marks.end(), [](unsigned m) { return (m & kOwn) != 0; }));
  return figures;
}

void count_own(const Piece& gathered, const Parting& parting, std::uint32_t number,
               RulerHistograms& counts) {
  if (gathered.tets.empty()) return;
  {
    BuildReport report;
    const TetMesh mesh = build_first(gathered, report);
    count_around(mesh, OwnOf(mesh, gathered, parting, number).scope(), counts);
  }
  const Piece own = own_part(gathered, parting, number);
  if (!own.tets.empty()) count_tets(build_own(own, nullptr), counts);
}

namespace {

/// Whole numbers in the order of the doubles.
std::uint64_t key_of(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return (bits >> 63) != 0 ? ~bits : bits | (std::uint64_t{1} << 63);
}
double number_of_key(std::uint64_t key) {
  return std::bit_cast<double>((key >> 63) != 0 ? key & ~(std::uint64_t{1} << 63) : ~key);
}

/// The score at 1 % of each ruler, over all ranks: bit after bit of its key, so that no rank has the
/// scores of others.
std::array<double, kRulerCount> find_one_percent(const RulerShare& all, WorstScores& worst,
                                                 Ranks& ranks) {
  std::array<std::uint64_t, kRulerCount> keys{};
  for (int bit = 63; bit >= 0; --bit) {
    std::array<std::int64_t, kRulerCount> below{};
    const auto tried = [&](std::size_t r) { return keys[r] | (std::uint64_t{1} << bit); };
    for (std::size_t r = 0; r < kRulerCount; ++r) {
      const std::vector<double>& scores = worst.sorted(r);
      below[r] = std::partition_point(scores.begin(), scores.end(),
                                      [&](double x) { return key_of(x) < tried(r); }) -
                 scores.begin();
    }
    ranks.add(below);
    for (std::size_t r = 0; r < kRulerCount; ++r) {
      const std::uint64_t count = all.of[r].count;
      if (count > 0 && static_cast<std::uint64_t>(below[r]) <= place_of_one_percent(count)) {
        keys[r] = tried(r);
      }
    }
  }
  std::array<double, kRulerCount> scores{};
  for (std::size_t r = 0; r < kRulerCount; ++r) scores[r] = number_of_key(keys[r]);
  return scores;
}

}  // namespace

namespace {

/// @param fixed a bit for each corner
face::DrawnTet draw(const NamedTet& tet, unsigned fixed) {
  face::DrawnTet drawn{.corners = {}, .facts = tet.facts};
  drawn.facts.free_vertices = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const auto& [x, y, z] = tet.corners[i];
    drawn.corners[i] = Point(x, y, z);
    drawn.is_free[i] = ((fixed >> i) & 1U) == 0;
    drawn.facts.free_vertices += drawn.is_free[i] ? 1 : 0;
  }
  return drawn;
}

/// With what all pieces know of a tet. @param shared ascending @param firsts of the tets of each part
std::vector<face::DrawnTet> draw(std::vector<NamedTet> tets, std::span<const SharedTet> shared,
                                 const std::vector<std::uint64_t>& firsts) {
  keep_worst(tets);
  std::vector<face::DrawnTet> drawn;
  for (NamedTet& tet : tets) {
    std::array<VertexId, 4> sorted = tet.vertices;
    std::sort(sorted.begin(), sorted.end());
    unsigned fixed = tet.fixed;
    for (const SharedTet& other : shared) {
      if (other.vertices != sorted) continue;
      for (unsigned i = 0; i < 4; ++i) {
        const auto at = std::find(sorted.begin(), sorted.end(), tet.vertices[i]) - sorted.begin();
        fixed |= ((unsigned{other.holders.fixed} >> at) & 1U) << i;
      }
    }
    tet.facts.tet += firsts[tet.part];
    tet.facts.number = static_cast<std::int64_t>(tet.facts.tet) + 1;
    drawn.push_back(draw(tet, fixed));
  }
  return drawn;
}

/// Of all ranks: what each piece knows of a tet comes together.
void gather_held(const Survey& survey, const std::vector<std::uint64_t>& tets_of_parts,
                 Ranks& ranks, Measured& measured) {
  std::string mine;
  put(survey.held, mine);
  put(survey.shared, mine);
  put(survey.worst_tets, mine);
  face::Held& all = measured.held;
  std::vector<SharedTet> shared;
  std::vector<NamedTet> worst;
  for (const std::string& from : ranks.gather(mine)) {
    std::string_view rest = from;
    face::Held held;
    std::vector<SharedTet> tets;
    take(rest, held);
    take(rest, tets);
    std::vector<NamedTet> named;
    take(rest, named);
    worst.insert(worst.end(), named.begin(), named.end());
    all.add(held);
    shared.insert(shared.end(), tets.begin(), tets.end());
  }
  std::sort(shared.begin(), shared.end(),
            [](const SharedTet& a, const SharedTet& b) { return a.vertices < b.vertices; });
  for (std::size_t i = 0; i < shared.size();) {
    face::Holders holders;
    const std::array<VertexId, 4> vertices = shared[i].vertices;
    for (; i < shared.size() && shared[i].vertices == vertices; ++i) holders.add(shared[i].holders);
    all.add(holders);
  }
  std::vector<std::uint64_t> firsts(tets_of_parts.size(), 0);
  std::exclusive_scan(tets_of_parts.begin(), tets_of_parts.end(), firsts.begin(), std::uint64_t{0});
  measured.worst_tets = draw(std::move(worst), shared, firsts);
}

}  // namespace

void add_survey(const std::vector<std::uint64_t>& tets, Survey survey, Ranks& ranks,
                Measured& measured) {
  if (survey.finds_holders) gather_held(survey, tets, ranks, measured);
  const RulerShare& all = measured.figures.rulers;
  measured.rulers = rulers_of(all, find_one_percent(all, survey.worst, ranks));
  const std::span<double> lengths = survey.lengths.lengths();
  std::string mine;
  put(std::vector<double>(lengths.begin(), lengths.end()), mine);
  for (const std::string& from : ranks.gather(mine)) {
    std::string_view rest = from;
    std::vector<double> others;
    take(rest, others);
    add_lengths(others, lengths);
  }
  measured.lengths = std::move(survey.lengths);
}

namespace {

void append(face::LocalLengths lengths, std::string& bytes) {
  put(std::uint64_t{lengths.count()}, bytes);
  put(std::vector<double>(lengths.lengths().begin(), lengths.lengths().end()), bytes);
}

face::LocalLengths take_lengths(std::string_view& bytes) {
  std::uint64_t count = 0;
  std::vector<double> values;
  take(bytes, count);
  take(bytes, values);
  face::LocalLengths lengths(count);
  if (values.size() != lengths.lengths().size()) throw Error("a run contradicts itself");
  std::copy(values.begin(), values.end(), lengths.lengths().begin());
  return lengths;
}

}  // namespace

void append(const Measured& measured, std::string& bytes) {
  put(measured.figures, bytes);
  put(measured.rulers.has_value(), bytes);
  put(measured.rulers.value_or(MeshRulers()), bytes);
  put(measured.histograms.has_value(), bytes);
  put(measured.histograms.value_or(RulerHistograms()), bytes);
  append(measured.lengths, bytes);
}

Measured take_measured(std::string_view& bytes) {
  Measured measured;
  bool has_rulers = false;
  bool has_histograms = false;
  take(bytes, measured.figures);
  take(bytes, has_rulers);
  take(bytes, measured.rulers.emplace());
  take(bytes, has_histograms);
  take(bytes, measured.histograms.emplace());
  if (!has_rulers) measured.rulers.reset();
  if (!has_histograms) measured.histograms.reset();
  measured.lengths = take_lengths(bytes);
  return measured;
}

}  // namespace tetmend::pieces
