// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/petsc/exchange.h"
#include "bindings/petsc/plex_arrays.h"

namespace tetmend::petsc {

namespace {

using Point = std::array<double, 3>;

template <std::size_t N>
struct Element {
  std::array<std::uint64_t, N> vertices;
  std::int32_t label;

  friend bool operator<(const Element& a, const Element& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.label < b.label;
  }
};

/// Points of a chart, one kind of them.
struct Stratum {
  PetscInt begin = 0, end = 0;
  bool has(PetscInt point) const { return point >= begin && point < end; }
};

/// The values of a label in a stratum.
struct Values {
  std::vector<std::pair<PetscInt, std::int32_t>> of;  ///< by ascending points
  bool has_others = false;                            ///< points outside the stratum
  std::string complaint;
};

std::string quoted(const std::string& name) {
  return "label '" + name + "'";
}

/// Six times the volume, positive where corner 3 is on the side to which 0, 1, 2 turn left.
double determinant(const std::array<Point, 4>& p) {
  std::array<Point, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) e[i][k] = p[i + 1][k] - p[0][k];
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// What a determinant is off by rounding at most, generously.
double rounding(const std::array<Point, 4>& p) {
  double length = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) length = std::max(length, std::abs(p[i][k] - p[0][k]));
  }
  return 1e-14 * length * length * length;
}

/// The same tet, turned so that it begins with its smallest vertex, then the next that can be.
void turn(std::array<std::uint64_t, 4>& tet) {
  const auto first = std::min_element(tet.begin(), tet.end()) - tet.begin();
  if (first != 0) {
    std::swap(tet[0], tet[static_cast<std::size_t>(first)]);
    std::swap(tet[first == 1 ? 2 : 1], tet[first == 3 ? 2 : 3]);
  }
  std::rotate(tet.begin() + 1, std::min_element(tet.begin() + 1, tet.end()), tet.end());
}

/// Points of all ranks, in ascending order over the ranks.
struct Sorted {
  std::vector<Point> points;           ///< that have come to this rank
  std::vector<std::uint64_t> numbers;  ///< of those that it has given, in their order
};

/// Splits the order so that each rank gets about as many points.
std::vector<Point> find_splitters(Ranks& ranks, std::vector<Point> points) {
  constexpr std::size_t kSamples = 64;
  std::sort(points.begin(), points.end());
  std::vector<Point> samples;
  for (std::size_t i = 0; i < kSamples && !points.empty(); ++i) {
    samples.push_back(points[points.size() * i / kSamples]);
  }
  samples = gather(ranks, samples);
  std::sort(samples.begin(), samples.end());
  std::vector<Point> splitters;
  for (std::size_t r = 1; r < ranks.count() && !samples.empty(); ++r) {
    splitters.push_back(samples[samples.size() * r / ranks.count()]);
  }
  return splitters;
}

/// All ranks. Points in one place are in the order of the ranks that give them.
Sorted sort_points(Ranks& ranks, const std::vector<Point>& mine) {
  struct Place {
    Point point;
    std::size_t rank, index;
  };
  const std::vector<Point> splitters = find_splitters(ranks, mine);
  const auto rank_of = [&](const Point& p) {
    return static_cast<std::size_t>(std::upper_bound(splitters.begin(), splitters.end(), p) -
                                    splitters.begin());
  };
  std::vector<std::vector<Point>> to(ranks.count());
  for (const Point& p : mine) to[rank_of(p)].push_back(p);
  const auto came = exchange_values(ranks, to);
  std::vector<Place> places;
  std::vector<std::vector<std::uint64_t>> numbers(came.size());
  for (std::size_t r = 0; r < came.size(); ++r) {
    numbers[r].resize(came[r].size());
    for (std::size_t i = 0; i < came[r].size(); ++i) places.push_back({came[r][i], r, i});
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.point < b.point; });
  Sorted sorted;
  std::uint64_t number = Ranges(ranks, places.size()).begin();
  for (const Place& place : places) {
    sorted.points.push_back(place.point);
    numbers[place.rank][place.index] = number++;
  }
  const auto answers = exchange_values(ranks, numbers);
  std::vector<std::size_t> taken(answers.size());
  for (const Point& p : mine) {
    const std::size_t r = rank_of(p);
    sorted.numbers.push_back(answers[r][taken[r]++]);
  }
  return sorted;
}

class PlexReader {
 public:
  PlexReader(DM dm, const Labels& labels, Ranks& ranks) : dm_(dm), asked_(labels), ranks_(ranks) {}

  PlexArrays read() {
    check_kind();
    check_cells();
    read_coordinates();
    compare_coordinates();
    number_vertices();
    add_cells();
    add_labelled(asked_.faces, faces_, "a face", made_.labels.faces, made_.mesh.triangles,
                 made_.mesh.triangle_labels);
    add_labelled(asked_.edges, edges_, "an edge", made_.labels.edges, made_.mesh.edges,
                 made_.mesh.edge_labels);
    add_labelled_vertices();
    note_other_labels();
    return std::move(made_);
  }

 private:
  void check_kind();
  void check_cells();
  void read_coordinates();
  void compare_coordinates() const;
  template <class Value>
  void take_from_owners(std::vector<Value>& values, MPI_Datatype type) const;
  void number_vertices();
  std::string count_orientations(std::array<std::int64_t, 2>& counts) const;
  std::string find_inverted(bool is_turned) const;
  void add_cells();
  Values values_of_label(const std::string& name, Stratum stratum) const;
  std::vector<std::pair<PetscInt, std::int32_t>> take_label(const std::string& name,
                                                            Stratum stratum, std::string_view kind,
                                                            std::string& carried);
  template <std::size_t N>
  void add_labelled(const std::string& name, Stratum stratum, std::string_view kind,
                    std::string& carried, std::vector<std::array<std::uint64_t, N>>& elements,
                    std::vector<std::int32_t>& labels);
  template <std::size_t N>
  std::vector<Element<N>> bring(const std::vector<Element<N>>& mine, const std::string& name,
                                std::string_view kind);
  void add_labelled_vertices();
  void note_other_labels();

  std::string of_rank() const { return " of rank " + std::to_string(ranks_.number()); }

  /// Of a cell or what belongs to it. Fewer than it should have: 0 in their place.
  template <std::size_t N>
  std::array<PetscInt, N> vertices_of(PetscInt point) const {
    PetscInt count = 0;
    PetscInt* closure = nullptr;
    check(DMPlexGetTransitiveClosure(dm_, point, PETSC_TRUE, &count, &closure));
    std::array<PetscInt, N> found{};
    std::size_t n = 0;
    for (PetscInt i = 0; i < 2 * count; i += 2) {
      if (vertices_.has(closure[i]) && n < N) found[n++] = closure[i];
    }
    check(DMPlexRestoreTransitiveClosure(dm_, point, PETSC_TRUE, &count, &closure));
    return found;
  }
  template <std::size_t N>
  std::array<std::uint64_t, N> numbers_of(PetscInt point) const {
    std::array<std::uint64_t, N> numbers{};
    const auto vertices = vertices_of<N>(point);
    for (std::size_t i = 0; i < N; ++i) {
      numbers[i] = static_cast<std::uint64_t>(numbers_[static_cast<std::size_t>(vertices[i])]);
    }
    return numbers;
  }
  std::array<Point, 4> corners_of(PetscInt cell) const {
    std::array<Point, 4> corners{};
    const auto vertices = vertices_of<4>(cell);
    for (std::size_t i = 0; i < 4; ++i) {
      corners[i] = points_[static_cast<std::size_t>(vertices[i] - vertices_.begin)];
    }
    return corners;
  }

  DM dm_;
  const Labels& asked_;
  Ranks& ranks_;
  PlexArrays made_;
  Stratum chart_, cells_, faces_, edges_, vertices_;
  std::vector<char> is_ghost_;         ///< by point: another rank has it
  std::vector<Point> points_;          ///< of all vertices here
  std::vector<std::int64_t> numbers_;  ///< by point, of vertices: in the whole mesh
};

/// What all ranks see alike.
void PlexReader::check_kind() {
  PetscBool is_plex = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(dm_), DMPLEX, &is_plex));
  if (is_plex == PETSC_FALSE) {
    const char* type = nullptr;
    check(DMGetType(dm_, &type));
    throw Error(std::string("DM: is no DMPlex, but ") + (type != nullptr ? type : "of no type"));
  }
  PetscInt dimension = 0;
  PetscInt space = 0;
  PetscBool is_localized = PETSC_FALSE;
  check(DMGetDimension(dm_, &dimension));
  check(DMGetCoordinateDim(dm_, &space));
  check(DMGetCoordinatesLocalized(dm_, &is_localized));
  if (dimension != 3 || space != 3) {
    throw Error("DMPlex: has cells of dimension " + std::to_string(dimension) + " in space of " +
                std::to_string(space) + ": tets in space are needed");
  }
  if (is_localized != PETSC_FALSE) throw Error("DMPlex: is periodic, which tetmend does not know");
}

void PlexReader::check_cells() {
  PetscInt depth = 0;
  check(DMPlexGetDepth(dm_, &depth));
  check(DMPlexGetChart(dm_, &chart_.begin, &chart_.end));
  check(DMPlexGetHeightStratum(dm_, 0, &cells_.begin, &cells_.end));
  check(DMPlexGetDepthStratum(dm_, 0, &vertices_.begin, &vertices_.end));
  PetscSF sf = nullptr;
  PetscInt roots = 0;
  PetscInt leaves = 0;
  const PetscInt* points = nullptr;
  check(DMGetPointSF(dm_, &sf));
  check(PetscSFGetGraph(sf, &roots, &leaves, &points, nullptr));
  is_ghost_.assign(static_cast<std::size_t>(chart_.end), 0);
  for (PetscInt i = 0; i < leaves; ++i) {
    is_ghost_[static_cast<std::size_t>(points != nullptr ? points[i] : i)] = 1;
  }
  std::string complaint;
  for (PetscInt cell = cells_.begin; cell < cells_.end && complaint.empty(); ++cell) {
    DMPolytopeType type = DM_POLYTOPE_UNKNOWN;
    check(DMPlexGetCellType(dm_, cell, &type));
    if (type != DM_POLYTOPE_TETRAHEDRON) {
      complaint = " is a " + std::string(DMPolytopeTypes[type]) + ", and no tet";
    } else if (is_ghost_[static_cast<std::size_t>(cell)] != 0) {
      complaint = " belongs to another rank: there must be no overlap";
    }
    if (!complaint.empty()) complaint = "cell " + std::to_string(cell) + of_rank() + complaint;
  }
  for (PetscInt point = chart_.begin; point < chart_.end && complaint.empty(); ++point) {
    PetscInt count = 0;
    check(DMPlexGetSupportSize(dm_, point, &count));
    if (count > 0 || cells_.has(point)) continue;
    complaint = "point " + std::to_string(point) + of_rank() + " belongs to no cell";
  }
  if (complaint.empty() && cells_.end > cells_.begin && depth != 1 && depth != 3) {
    complaint = "has faces or edges, but not both";
  }
  agree(ranks_, complaint.empty() ? complaint : "DMPlex: " + complaint);
  std::array<std::int64_t, 1> count = {cells_.end - cells_.begin};
  ranks_.add(count);
  if (count[0] == 0) throw Error("DMPlex: has no cells");
  made_.is_interpolated = ranks_.any(depth == 3 && cells_.end > cells_.begin);
  if (made_.is_interpolated) {
    check(DMPlexGetDepthStratum(dm_, 1, &edges_.begin, &edges_.end));
    check(DMPlexGetDepthStratum(dm_, 2, &faces_.begin, &faces_.end));
  }
}

void PlexReader::read_coordinates() {
  PetscSection section = nullptr;
  Vec vector = nullptr;
  check(DMGetCoordinateSection(dm_, &section));
  check(DMGetCoordinatesLocal(dm_, &vector));
  if (vector == nullptr) throw Error("DMPlex: has no coordinates");
  const PetscScalar* values = nullptr;
  PetscInt size = 0;
  check(VecGetLocalSize(vector, &size));
  check(VecGetArrayRead(vector, &values));
  std::string complaint;
  PetscInt read = 0;
  for (PetscInt v = vertices_.begin; v < vertices_.end; ++v) {
    PetscInt count = 0;
    PetscInt begin = 0;
    check(PetscSectionGetDof(section, v, &count));
    check(PetscSectionGetOffset(section, v, &begin));
    Point& p = points_.emplace_back();
    bool is_finite = count == 3 && begin >= 0 && begin + 3 <= size;
    for (PetscInt k = 0; k < 3 && is_finite; ++k) {
      const double value = PetscRealPart(values[begin + k]);
      p[static_cast<std::size_t>(k)] = value;
      is_finite = std::isfinite(value);
    }
    read += count;
    if (is_finite || !complaint.empty()) continue;
    complaint = "DMPlex: a coordinate of vertex " + std::to_string(v) + of_rank() +
                (count == 3 ? " is not a finite number" : " is missing");
  }
  check(VecRestoreArrayRead(vector, &values));
  if (complaint.empty() && read < size) {
    complaint = "DMPlex: has coordinates besides those of its vertices: curved cells are not known";
  }
  agree(ranks_, complaint);
}

/// Of one value for each point, those of ghosts become what their owners have.
template <class Value>
void PlexReader::take_from_owners(std::vector<Value>& values, MPI_Datatype type) const {
  PetscSF sf = nullptr;
  PetscInt roots = 0;
  check(DMGetPointSF(dm_, &sf));
  check(PetscSFGetGraph(sf, &roots, nullptr, nullptr, nullptr));
  if (!ranks_.any(roots >= 0)) return;  // one rank, or a mesh that was never distributed
  const std::vector<Value> of_owner = values;
  check(PetscSFBcastBegin(sf, type, of_owner.data(), values.data(), MPI_REPLACE));
  check(PetscSFBcastEnd(sf, type, of_owner.data(), values.data(), MPI_REPLACE));
}

/// Who moves vertices in the local vector alone leaves the ranks with two meshes.
void PlexReader::compare_coordinates() const {
  std::string complaint;
  std::vector<double> values(static_cast<std::size_t>(chart_.end));
  for (std::size_t k = 0; k < 3; ++k) {
    for (PetscInt v = vertices_.begin; v < vertices_.end; ++v) {
      values[static_cast<std::size_t>(v)] =
          points_[static_cast<std::size_t>(v - vertices_.begin)][k];
    }
    take_from_owners(values, MPI_DOUBLE);
    for (PetscInt v = vertices_.begin; v < vertices_.end && complaint.empty(); ++v) {
      if (values[static_cast<std::size_t>(v)] ==
          points_[static_cast<std::size_t>(v - vertices_.begin)][k]) {
        continue;
      }
      complaint =
          "DMPlex: vertex " + std::to_string(v) + of_rank() +
          " lies elsewhere than the rank that owns it says: its local coordinates are stale";
    }
  }
  agree(ranks_, complaint);
}

/// The owner of a vertex gets its number, the others get that from the owner.
void PlexReader::number_vertices() {
  std::vector<Point> owned;
  for (PetscInt v = vertices_.begin; v < vertices_.end; ++v) {
    if (is_ghost_[static_cast<std::size_t>(v)] != 0) continue;
    owned.push_back(points_[static_cast<std::size_t>(v - vertices_.begin)]);
  }
  Sorted sorted = sort_points(ranks_, owned);
  made_.mesh.points = std::move(sorted.points);
  numbers_.assign(static_cast<std::size_t>(chart_.end), -1);
  auto next = sorted.numbers.begin();
  for (PetscInt v = vertices_.begin; v < vertices_.end; ++v) {
    const auto at = static_cast<std::size_t>(v);
    if (is_ghost_[at] == 0) numbers_[at] = static_cast<std::int64_t>(*next++);
  }
  take_from_owners(numbers_, MPI_INT64_T);
}

std::string PlexReader::count_orientations(std::array<std::int64_t, 2>& counts) const {
  for (PetscInt cell = cells_.begin; cell < cells_.end; ++cell) {
    auto v = vertices_of<4>(cell);
    std::sort(v.begin(), v.end());
    if (std::adjacent_find(v.begin(), v.end()) != v.end() || !vertices_.has(v[0])) {
      return "DMPlex: cell " + std::to_string(cell) + of_rank() + " has not four vertices";
    }
    const double volume = determinant(corners_of(cell));
    counts[0] += volume < 0 ? 1 : 0;
    counts[1] += volume > 0 ? 1 : 0;
  }
  return {};
}

std::string PlexReader::find_inverted(bool is_turned) const {
  for (PetscInt cell = cells_.begin; cell < cells_.end; ++cell) {
    const std::array<Point, 4> corners = corners_of(cell);
    const double volume = determinant(corners) * (is_turned ? -1 : 1);
    if (volume < -rounding(corners)) {
      return "DMPlex: cell " + std::to_string(cell) + of_rank() +
             " is inverted: its vertices turn another way than those of most cells";
    }
  }
  return {};
}

/// PETSc's cells turn the other way than ours; whoever made a DMPlex may have left that to chance.
void PlexReader::add_cells() {
  std::array<std::int64_t, 2> counts{};
  agree(ranks_, count_orientations(counts));
  ranks_.add(counts);
  const bool is_turned = counts[0] >= counts[1];
  agree(ranks_, find_inverted(is_turned));
  const auto values = take_label(asked_.cells, cells_, "a cell", made_.labels.cells);
  DMLabel label = nullptr;
  if (!made_.labels.cells.empty()) {
    check(DMGetLabel(dm_, made_.labels.cells.c_str(), &label));
  }
  if (label != nullptr) {
    PetscInt none = 0;
    check(DMLabelGetDefaultValue(label, &none));
    made_.no_region = static_cast<std::int32_t>(none);
  }
  const Ranges ranges(ranks_, made_.mesh.points.size());
  std::vector<std::vector<Element<4>>> to(ranks_.count());
  auto value = values.begin();
  for (PetscInt cell = cells_.begin; cell < cells_.end; ++cell) {
    Element<4> tet{numbers_of<4>(cell), made_.no_region};
    if (value != values.end() && value->first == cell) tet.label = (value++)->second;
    if (is_turned) std::swap(tet.vertices[0], tet.vertices[1]);
    turn(tet.vertices);
    to[ranges.rank_of(tet.vertices[0])].push_back(tet);
  }
  std::vector<Element<4>> tets = exchange_all(ranks_, to);
  std::sort(tets.begin(), tets.end());
  for (const Element<4>& tet : tets) {
    made_.mesh.tets.push_back(tet.vertices);
    made_.mesh.tet_labels.push_back(tet.label);
  }
}

Values PlexReader::values_of_label(const std::string& name, Stratum stratum) const {
  Values values;
  DMLabel label = nullptr;
  check(DMGetLabel(dm_, name.c_str(), &label));
  if (label == nullptr) return values;
  IS all = nullptr;
  PetscInt strata = 0;
  const PetscInt* numbers = nullptr;
  check(DMLabelGetNumValues(label, &strata));
  check(DMLabelGetValueIS(label, &all));
  if (strata > 0) check(ISGetIndices(all, &numbers));
  for (PetscInt i = 0; i < strata; ++i) {
    const auto value = static_cast<std::int32_t>(numbers[i]);
    if (value != numbers[i]) {
      values.complaint = quoted(name) + ": " + std::to_string(numbers[i]) + " has over 32 bits";
    }
    IS points = nullptr;
    check(DMLabelGetStratumIS(label, numbers[i], &points));
    if (points == nullptr) continue;
    PetscInt count = 0;
    const PetscInt* indices = nullptr;
    check(ISGetLocalSize(points, &count));
    check(ISGetIndices(points, &indices));
    for (PetscInt k = 0; k < count; ++k) {
      if (stratum.has(indices[k])) values.of.emplace_back(indices[k], value);
      values.has_others = values.has_others || !stratum.has(indices[k]);
    }
    check(ISRestoreIndices(points, &indices));
    check(ISDestroy(&points));
  }
  if (strata > 0) check(ISRestoreIndices(all, &numbers));
  check(ISDestroy(&all));
  std::sort(values.of.begin(), values.of.end());
  const auto twice = std::adjacent_find(values.of.begin(), values.of.end(),
                                        [](auto& a, auto& b) { return a.first == b.first; });
  if (twice != values.of.end()) {
    values.complaint = quoted(name) + ": point " + std::to_string(twice->first) + of_rank() +
                       " has two values, " + std::to_string(twice->second) + " and " +
                       std::to_string((twice + 1)->second);
  }
  return values;
}

/// All ranks. Sets `carried` to the name if any rank has such a label.
std::vector<std::pair<PetscInt, std::int32_t>> PlexReader::take_label(const std::string& name,
                                                                      Stratum stratum,
                                                                      std::string_view kind,
                                                                      std::string& carried) {
  if (name.empty()) return {};
  PetscBool is_here = PETSC_FALSE;
  check(DMHasLabel(dm_, name.c_str(), &is_here));
  if (!ranks_.any(is_here != PETSC_FALSE)) return {};
  carried = name;
  Values values = values_of_label(name, stratum);
  agree(ranks_, values.complaint);
  if (ranks_.any(values.has_others)) {
    made_.left_behind.push_back(quoted(name) + " of points each of which is not " +
                                std::string(kind));
  }
  return std::move(values.of);
}

/// To the rank that has the smallest vertex; what several ranks have, once.
template <std::size_t N>
std::vector<Element<N>> PlexReader::bring(const std::vector<Element<N>>& mine,
                                          const std::string& name, std::string_view kind) {
  const Ranges ranges(ranks_, made_.mesh.points.size());
  std::vector<std::vector<Element<N>>> to(ranks_.count());
  for (const Element<N>& element : mine) {
    to[ranges.rank_of(element.vertices[0])].push_back(element);
  }
  std::vector<Element<N>> came = exchange_all(ranks_, to);
  std::sort(came.begin(), came.end());
  std::string complaint;
  for (std::size_t i = 1; i < came.size(); ++i) {
    if (came[i - 1].vertices == came[i].vertices && came[i - 1].label != came[i].label) {
      complaint = quoted(name) + ": " + std::string(kind) + " has " +
                  std::to_string(came[i - 1].label) + " on one rank and " +
                  std::to_string(came[i].label) + " on another";
    }
  }
  agree(ranks_, complaint);
  const auto is_same = [](auto& a, auto& b) { return a.vertices == b.vertices; };
  came.erase(std::unique(came.begin(), came.end(), is_same), came.end());
  return came;
}

template <std::size_t N>
void PlexReader::add_labelled(const std::string& name, Stratum stratum, std::string_view kind,
                              std::string& carried,
                              std::vector<std::array<std::uint64_t, N>>& elements,
                              std::vector<std::int32_t>& labels) {
  std::vector<Element<N>> mine;
  for (const auto& [point, value] : take_label(name, stratum, kind, carried)) {
    Element<N>& element = mine.emplace_back(Element<N>{numbers_of<N>(point), value});
    std::sort(element.vertices.begin(), element.vertices.end());
  }
  for (const Element<N>& element : bring(mine, name, kind)) {
    elements.push_back(element.vertices);
    labels.push_back(element.label);
  }
}

void PlexReader::add_labelled_vertices() {
  std::vector<Element<1>> mine;
  for (const auto& [point, value] :
       take_label(asked_.vertices, vertices_, "a vertex", made_.labels.vertices)) {
    const auto number = static_cast<std::uint64_t>(numbers_[static_cast<std::size_t>(point)]);
    mine.push_back({{number}, value});
  }
  const std::uint64_t begin = Ranges(ranks_, made_.mesh.points.size()).begin();
  made_.mesh.point_labels.assign(made_.mesh.points.size(), 0);
  for (const Element<1>& element : bring(mine, asked_.vertices, "a vertex")) {
    made_.mesh.required_vertices.push_back(element.vertices[0]);
    made_.mesh.point_labels[element.vertices[0] - begin] = element.label;
  }
}

void PlexReader::note_other_labels() {
  const std::set<std::string> known = {"depth",      "celltype",   "dim",          asked_.cells,
                                       asked_.faces, asked_.edges, asked_.vertices};
  PetscInt count = 0;
  check(DMGetNumLabels(dm_, &count));
  std::string mine;
  for (PetscInt i = 0; i < count; ++i) {
    const char* name = nullptr;
    DMLabel label = nullptr;
    PetscInt values = 0;
    check(DMGetLabelName(dm_, i, &name));
    check(DMGetLabel(dm_, name, &label));
    check(DMLabelGetNumValues(label, &values));
    if (values > 0 && known.count(name) == 0) mine += name + std::string(1, '\0');
  }
  std::set<std::string> names;
  for (std::string_view rest : ranks_.gather(mine)) {
    for (; !rest.empty(); rest.remove_prefix(rest.find('\0') + 1)) {
      names.emplace(rest.substr(0, rest.find('\0')));
    }
  }
  for (const std::string& name : names) made_.left_behind.push_back(quoted(name));
}

}  // namespace

PlexArrays read_plex(DM dm, const Labels& labels, Ranks& ranks) {
  return PlexReader(dm, labels, ranks).read();
}

}  // namespace tetmend::petsc
