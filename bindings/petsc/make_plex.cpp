// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings/petsc/exchange.h"
#include "bindings/petsc/plex_arrays.h"

namespace tetmend::petsc {

namespace {

static_assert(std::is_same_v<PetscReal, double>, "tetmend's coordinates are doubles");

template <std::size_t N>
struct Element {
  std::array<std::uint64_t, N> vertices;
  std::int32_t label;
};

struct Destroy {
  void operator()(DM dm) const { DMDestroy(&dm); }
};

class PlexMaker {
 public:
  PlexMaker(MPI_Comm comm, PlexArrays& arrays, Ranks& ranks)
      : comm_(comm),
        arrays_(arrays),
        mesh_(arrays.mesh),
        ranks_(ranks),
        points_(ranks, arrays.mesh.points.size()) {}

  DM make() {
    share_tets();
    create();
    label_cells();
    label<3>(arrays_.labels.faces, mesh_.triangles, mesh_.triangle_labels);
    label<2>(arrays_.labels.edges, mesh_.edges, mesh_.edge_labels);
    label_vertices();
    return dm_.release();
  }

 private:
  void share_tets();
  void create();
  void label_cells();
  void label_vertices();
  template <std::size_t N>
  void label(const std::string& name, const std::vector<std::array<std::uint64_t, N>>& elements,
             const std::vector<std::int32_t>& labels);
  template <std::size_t N>
  std::vector<Element<N>> near_here(const std::vector<std::array<std::uint64_t, N>>& elements,
                                    const std::vector<std::int32_t>& labels);
  template <std::size_t N>
  PetscInt find(const std::array<std::uint64_t, N>& vertices) const;

  DMLabel make_label(const std::string& name) const {
    DMLabel label = nullptr;
    check(DMCreateLabel(dm_.get(), name.c_str()));
    check(DMGetLabel(dm_.get(), name.c_str(), &label));
    return label;
  }

  MPI_Comm comm_;
  PlexArrays& arrays_;
  RankArrays& mesh_;
  Ranks& ranks_;
  Ranges points_;  ///< which of them the ranks have in the arrays
  std::vector<Element<4>> tets_;
  std::unique_ptr<std::remove_pointer_t<DM>, Destroy> dm_;
  std::vector<std::pair<std::uint64_t, PetscInt>> vertices_;  ///< number, point; ascending
  std::vector<char> is_ghost_;                                ///< by point: another rank has it
};

/// In their order: they lie near each other, and each rank gets as many.
void PlexMaker::share_tets() {
  const Ranges tets(ranks_, mesh_.tets.size());
  const std::uint64_t count = ranks_.count();
  const auto end_of = [&](std::uint64_t rank) { return tets.total() * (rank + 1) / count; };
  std::vector<std::vector<Element<4>>> to(count);
  std::size_t rank = 0;
  for (std::size_t i = 0; i < mesh_.tets.size(); ++i) {
    while (end_of(rank) <= tets.begin() + i) ++rank;
    to[rank].push_back({mesh_.tets[i], mesh_.tet_labels.empty() ? 0 : mesh_.tet_labels[i]});
  }
  mesh_.tets = {};
  mesh_.tet_labels = {};
  tets_ = exchange_all(ranks_, to);
}

void PlexMaker::create() {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<PetscInt>::max());
  if (points_.total() > kMost) {
    throw Error("DMPlex: " + std::to_string(points_.total()) +
                " vertices are more than this PETSc can count: it needs 64-bit indices");
  }
  std::vector<PetscInt> cells;
  cells.reserve(4 * tets_.size());
  for (const Element<4>& tet : tets_) {
    for (const std::size_t k : {1, 0, 2, 3}) {  // PETSc's cells turn the other way
      cells.push_back(static_cast<PetscInt>(tet.vertices[k]));
    }
  }
  DM dm = nullptr;
  PetscSF of_vertices = nullptr;
  check(DMPlexCreateFromCellListParallelPetsc(
      comm_, 3, static_cast<PetscInt>(tets_.size()), static_cast<PetscInt>(mesh_.points.size()),
      static_cast<PetscInt>(points_.total()), 4, arrays_.is_interpolated ? PETSC_TRUE : PETSC_FALSE,
      cells.data(), 3, mesh_.points.empty() ? nullptr : mesh_.points.front().data(), &of_vertices,
      nullptr, &dm));
  dm_.reset(dm);
  PetscInt begin = 0;
  PetscInt end = 0;
  check(DMPlexGetDepthStratum(dm, 0, &begin, &end));
  // Roots are the vertices of the arrays, leaves those of the DMPlex.
  std::vector<PetscInt> of_roots(mesh_.points.size());
  std::vector<PetscInt> of_leaves(static_cast<std::size_t>(end - begin));
  std::iota(of_roots.begin(), of_roots.end(), static_cast<PetscInt>(points_.begin()));
  const auto bcast = [&](auto* function) {
    check(function(of_vertices, MPIU_INT, of_roots.data(), of_leaves.data(), MPI_REPLACE));
  };
  bcast(PetscSFBcastBegin);
  bcast(PetscSFBcastEnd);
  for (const PetscInt number : of_leaves) {
    vertices_.emplace_back(static_cast<std::uint64_t>(number), begin++);
  }
  std::sort(vertices_.begin(), vertices_.end());
  check(PetscSFDestroy(&of_vertices));

  PetscSF sf = nullptr;
  PetscInt leaves = 0;
  const PetscInt* points = nullptr;
  check(DMPlexGetChart(dm, &begin, &end));
  check(DMGetPointSF(dm, &sf));
  check(PetscSFGetGraph(sf, nullptr, &leaves, &points, nullptr));
  is_ghost_.assign(static_cast<std::size_t>(end), 0);
  for (PetscInt i = 0; i < leaves; ++i) {
    is_ghost_[static_cast<std::size_t>(points != nullptr ? points[i] : i)] = 1;
  }
}

void PlexMaker::label_cells() {
  if (arrays_.labels.cells.empty()) return;
  DMLabel label = make_label(arrays_.labels.cells);
  check(DMLabelSetDefaultValue(label, arrays_.no_region));
  PetscInt begin = 0;
  check(DMPlexGetHeightStratum(dm_.get(), 0, &begin, nullptr));
  for (std::size_t i = 0; i < tets_.size(); ++i) {
    if (tets_[i].label == arrays_.no_region) continue;
    check(DMLabelSetValue(label, begin + static_cast<PetscInt>(i), tets_[i].label));
  }
}

/// All ranks: the elements whose first vertex is on this rank, whoever has them in the arrays.
template <std::size_t N>
std::vector<Element<N>> PlexMaker::near_here(
    const std::vector<std::array<std::uint64_t, N>>& elements,
    const std::vector<std::int32_t>& labels) {
  const auto by_first = [](const Element<N>& a, const Element<N>& b) {
    return a.vertices[0] < b.vertices[0];
  };
  std::vector<std::vector<Element<N>>> to(ranks_.count());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    to[points_.rank_of(elements[i][0])].push_back({elements[i], labels.empty() ? 0 : labels[i]});
  }
  std::vector<Element<N>> known = exchange_all(ranks_, to);
  std::stable_sort(known.begin(), known.end(), by_first);
  std::vector<std::vector<std::uint64_t>> asked(ranks_.count());
  for (const auto& vertex : vertices_) asked[points_.rank_of(vertex.first)].push_back(vertex.first);
  const auto questions = exchange_values(ranks_, asked);
  std::vector<std::vector<Element<N>>> answers(ranks_.count());
  for (std::size_t r = 0; r < questions.size(); ++r) {
    for (const std::uint64_t vertex : questions[r]) {
      const auto [begin, end] =
          std::equal_range(known.begin(), known.end(), Element<N>{{vertex}, 0}, by_first);
      answers[r].insert(answers[r].end(), begin, end);
    }
  }
  return exchange_all(ranks_, answers);
}

/// The point with these vertices, or -1 if this rank has none.
template <std::size_t N>
PetscInt PlexMaker::find(const std::array<std::uint64_t, N>& vertices) const {
  std::array<PetscInt, N> points{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto found = std::lower_bound(vertices_.begin(), vertices_.end(),
                                        std::pair<std::uint64_t, PetscInt>(vertices[i], 0));
    if (found == vertices_.end() || found->first != vertices[i]) return -1;
    points[i] = found->second;
  }
  if (N == 1) return points[0];
  PetscInt count = 0;
  const PetscInt* joined = nullptr;
  check(DMPlexGetFullJoin(dm_.get(), N, points.data(), &count, &joined));
  const PetscInt point = count == 1 ? joined[0] : -1;
  check(DMPlexRestoreJoin(dm_.get(), N, points.data(), &count, &joined));
  return point;
}

/// On each rank that has such a point, be it another's.
template <std::size_t N>
void PlexMaker::label(const std::string& name,
                      const std::vector<std::array<std::uint64_t, N>>& elements,
                      const std::vector<std::int32_t>& labels) {
  if (name.empty()) return;
  DMLabel label = make_label(name);
  std::array<std::int64_t, 2> counts = {static_cast<std::int64_t>(elements.size()), 0};
  for (const Element<N>& element : near_here(elements, labels)) {
    const PetscInt point = find(element.vertices);
    if (point < 0) continue;
    check(DMLabelSetValue(label, point, element.label));
    counts[1] += is_ghost_[static_cast<std::size_t>(point)] != 0 ? 0 : 1;
  }
  ranks_.add(counts);
  if (counts[0] == counts[1]) return;
  throw Error("label '" + name + "': of " + std::to_string(counts[0]) + " points " +
              std::to_string(counts[1]) + " are there: this is a bug of tetmend, please report it");
}

void PlexMaker::label_vertices() {
  std::vector<std::array<std::uint64_t, 1>> elements;
  std::vector<std::int32_t> labels;
  for (const std::uint64_t vertex : mesh_.required_vertices) {
    elements.push_back({vertex});
    if (mesh_.point_labels.empty()) continue;
    labels.push_back(mesh_.point_labels[vertex - points_.begin()]);
  }
  label<1>(arrays_.labels.vertices, elements, labels);
}

}  // namespace

DM make_plex(MPI_Comm comm, PlexArrays& arrays, Ranks& ranks) {
  return PlexMaker(comm, arrays, ranks).make();
}

}  // namespace tetmend::petsc
