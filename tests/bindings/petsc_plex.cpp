// SPDX-License-Identifier: MIT
// A DMPlex of PETSc on processes of MPI is improved, and what was wrong with it or became of it is
// printed. tests/bindings/petsc_test.py runs it.
//
//   petsc_plex improve FILE [-plain] [-threads N] [-turned]    writes the mesh as it lies on the ranks
//   petsc_plex mistakes                                        prints what the errors say
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <petscdmda.h>
#include <petscdmplex.h>
#include <petscsf.h>
#include <tetmend/petsc.h>

namespace {

using Point = std::array<double, 3>;
using Lattice = std::array<PetscInt, 3>;

constexpr PetscInt kCells = 8;  // of the lattice in each direction, six tets each
constexpr PetscInt kNodes = kCells + 1;
constexpr std::array<const char*, 4> kLabels = {"Cell Sets", "Face Sets", "Edge Sets",
                                                "Vertex Sets"};
int failures = 0;

int rank_here() {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  return rank;
}

void check(bool holds, const std::string& what) {
  if (holds) return;
  ++failures;
  std::printf("FAIL on rank %d: %s\n", rank_here(), what.c_str());
}

void must(PetscErrorCode code) {
  if (code != 0) MPI_Abort(PETSC_COMM_WORLD, 9);
}

PetscInt node(const Lattice& at) {
  return at[0] + kNodes * (at[1] + kNodes * at[2]);
}

Lattice lattice_of(PetscInt number) {
  return {number % kNodes, number / kNodes % kNodes, number / kNodes / kNodes};
}

bool is_inside(const Lattice& at) {
  return std::all_of(at.begin(), at.end(), [](PetscInt i) { return i > 0 && i < kCells; });
}

/// Inner nodes are moved about, but for those of the plane between the regions and of what is
/// labelled inside.
Point place(PetscInt number) {
  const Lattice at = lattice_of(number);
  Point p{};
  unsigned noise = 2654435761U * static_cast<unsigned>(number + 1);
  for (std::size_t k = 0; k < 3; ++k) {
    noise = noise * 1664525U + 1013904223U;
    p[k] = static_cast<double>(at[k]);
    const bool may_move = is_inside(at) && at[0] != kCells / 2 && at[0] != 2;
    if (may_move) p[k] += 0.45 * (static_cast<double>(noise >> 8U) / (1U << 24U) - 0.5);
    p[k] /= static_cast<double>(kCells);
  }
  return p;
}

/// Six tets around a diagonal of each cube. PETSc's order, or turned and begun elsewhere.
std::vector<PetscInt> lattice_cells(bool is_turned) {
  std::vector<PetscInt> cells;
  std::array<std::size_t, 3> axes = {0, 1, 2};
  for (PetscInt i = 0; i < kCells * kCells * kCells; ++i) {
    std::array<std::size_t, 3> order = axes;
    do {
      Lattice at = {i % kCells, i / kCells % kCells, i / kCells / kCells};
      std::array<PetscInt, 4> tet = {node(at)};
      for (std::size_t k = 0; k < 3; ++k) {
        ++at[order[k]];
        tet[k + 1] = node(at);
      }
      const bool is_even = (order[1] + 3 - order[0]) % 3 == 1;
      if (is_even != is_turned) std::swap(tet[0], tet[1]);
      if (is_turned) std::rotate(tet.begin(), tet.begin() + 2, tet.end());  // the same tet
      cells.insert(cells.end(), tet.begin(), tet.end());
    } while (std::next_permutation(order.begin(), order.end()));
  }
  return cells;
}

template <std::size_t N>
std::array<PetscInt, N> vertices_of(DM dm, PetscInt point) {
  PetscInt begin = 0;
  PetscInt end = 0;
  PetscInt count = 0;
  PetscInt* closure = nullptr;
  must(DMPlexGetDepthStratum(dm, 0, &begin, &end));
  must(DMPlexGetTransitiveClosure(dm, point, PETSC_TRUE, &count, &closure));
  std::array<PetscInt, N> found{};
  std::size_t n = 0;
  for (PetscInt i = 0; i < 2 * count; i += 2) {
    if (closure[i] >= begin && closure[i] < end && n < N) found[n++] = closure[i];
  }
  must(DMPlexRestoreTransitiveClosure(dm, point, PETSC_TRUE, &count, &closure));
  return found;
}

void for_each(DM dm, PetscInt depth, const std::function<void(PetscInt)>& work) {
  PetscInt begin = 0;
  PetscInt end = 0;
  must(DMPlexGetDepthStratum(dm, depth, &begin, &end));
  for (PetscInt point = begin; point < end; ++point) work(point);
}

/// On the rank that has everything, in the order of the lattice: regions, sides of the box, faces inside a region, a line, vertices.
void set_labels(DM dm) {
  PetscInt begin = 0;
  must(DMPlexGetDepthStratum(dm, 0, &begin, nullptr));
  const auto at = [&](PetscInt vertex) { return lattice_of(vertex - begin); };
  PetscInt depth = 0;
  must(DMPlexGetDepth(dm, &depth));
  for_each(dm, depth, [&](PetscInt cell) {
    PetscInt x = kCells;
    PetscInt most = 0;
    for (const PetscInt v : vertices_of<4>(dm, cell)) {
      const Lattice here = at(v);
      x = std::min(x, here[0]);
      most = std::max({most, here[0], here[1], here[2]});
    }
    if (most > 1) must(DMSetLabelValue(dm, "Cell Sets", cell, x < kCells / 2 ? 4 : 2));
  });
  for_each(dm, 0, [&](PetscInt v) {
    if (at(v) == Lattice{5, 3, 3}) must(DMSetLabelValue(dm, "Vertex Sets", v, 11));
    if (at(v) == Lattice{6, 5, 4}) must(DMSetLabelValue(dm, "Vertex Sets", v, 0));
  });
  if (depth != 3) return;
  for_each(dm, 2, [&](PetscInt face) {
    const auto v = vertices_of<3>(dm, face);
    for (std::size_t k = 0; k < 3; ++k) {
      for (const PetscInt side : {PetscInt{0}, kCells, PetscInt{2}}) {
        const auto is_there = [&](PetscInt each) {
          const Lattice here = at(each);
          return here[k] == side && (side != 2 || (k == 0 && here[1] > 2 && here[1] < 6));
        };
        if (!std::all_of(v.begin(), v.end(), is_there)) continue;
        must(DMSetLabelValue(dm, "Face Sets", face, static_cast<PetscInt>(10 * k) + side));
      }
    }
  });
  for_each(dm, 1, [&](PetscInt edge) {
    const auto v = vertices_of<2>(dm, edge);
    const auto is_there = [&](PetscInt each) { return at(each)[0] == 6 && at(each)[1] == 6; };
    if (std::all_of(v.begin(), v.end(), is_there)) {
      must(DMSetLabelValue(dm, "Edge Sets", edge, 3));
    }
  });
}

/// All of it on the first rank, then distributed by PETSc.
DM make_box(bool is_interpolated, bool is_turned, PetscInt overlap = 0) {
  std::vector<PetscInt> cells;
  std::vector<double> points;
  if (rank_here() == 0) {
    cells = lattice_cells(is_turned);
    for (PetscInt v = 0; v < kNodes * kNodes * kNodes; ++v) {
      for (const double x : place(v)) points.push_back(x);
    }
  }
  DM dm = nullptr;
  PetscSF sf = nullptr;
  must(DMPlexCreateFromCellListParallelPetsc(
      PETSC_COMM_WORLD, 3, static_cast<PetscInt>(cells.size() / 4),
      static_cast<PetscInt>(points.size() / 3), PETSC_DETERMINE, 4,
      is_interpolated ? PETSC_TRUE : PETSC_FALSE, cells.data(), 3, points.data(), &sf, nullptr,
      &dm));
  for (const char* name : kLabels) must(DMCreateLabel(dm, name));
  if (rank_here() == 0) set_labels(dm);
  must(PetscSFDestroy(&sf));
  DM there = nullptr;
  must(DMPlexDistribute(dm, overlap, nullptr, &there));
  if (there == nullptr) return dm;
  must(DMDestroy(&dm));
  return there;
}

/// What lies on all ranks, as the first one sees it.
struct Picture {
  std::vector<std::array<double, 13>> cells;                 ///< corners and label, in their order
  std::array<std::vector<std::array<double, 10>>, 3> parts;  ///< labelled faces, edges, vertices
  std::vector<std::int64_t> cells_of_rank;
  std::int64_t vertices = 0;
};

template <class Value>
std::vector<Value> gathered(const std::vector<Value>& mine) {
  int ranks = 0;
  MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
  const int size = static_cast<int>(mine.size() * sizeof(Value));
  std::vector<int> sizes(static_cast<std::size_t>(ranks));
  std::vector<int> begins(sizes.size());
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, PETSC_COMM_WORLD);
  int total = 0;
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    begins[r] = total;
    total += sizes[r];
  }
  std::vector<Value> all(static_cast<std::size_t>(total) / sizeof(Value));
  MPI_Allgatherv(mine.data(), size, MPI_BYTE, all.data(), sizes.data(), begins.data(), MPI_BYTE,
                 PETSC_COMM_WORLD);
  return all;
}

class Observer {
 public:
  explicit Observer(DM dm) : dm_(dm) {
    PetscInt end = 0;
    PetscInt leaves = 0;
    const PetscInt* points = nullptr;
    must(DMPlexGetDepth(dm, &depth_));
    must(DMPlexGetChart(dm, nullptr, &end));
    must(DMGetPointSF(dm, &sf_));
    must(PetscSFGetGraph(sf_, &roots_, &leaves, &points, nullptr));
    is_ghost_.assign(static_cast<std::size_t>(end), false);
    for (PetscInt i = 0; i < leaves; ++i) {
      is_ghost_[static_cast<std::size_t>(points != nullptr ? points[i] : i)] = true;
    }
    Vec vector = nullptr;
    PetscSection section = nullptr;
    const PetscScalar* values = nullptr;
    must(DMGetCoordinatesLocal(dm, &vector));
    must(DMGetCoordinateSection(dm, &section));
    must(VecGetArrayRead(vector, &values));
    points_.resize(static_cast<std::size_t>(end));
    for_each(dm, 0, [&](PetscInt v) {
      PetscInt begin = 0;
      must(PetscSectionGetOffset(section, v, &begin));
      std::copy_n(values + begin, 3, points_[static_cast<std::size_t>(v)].begin());
    });
    must(VecRestoreArrayRead(vector, &values));
  }

  Picture picture() {
    Picture seen;
    std::vector<std::array<double, 13>> cells;
    for_each(dm_, depth_, [&](PetscInt cell) {
      auto& row = cells.emplace_back();
      const auto v = vertices_of<4>(dm_, cell);
      for (std::size_t i = 0; i < 4; ++i) std::copy_n(point(v[i]).begin(), 3, &row[3 * i]);
      row[12] = static_cast<double>(value(kLabels[0], cell));
    });
    seen.cells = gathered(cells);
    seen.cells_of_rank =
        gathered(std::vector<std::int64_t>{static_cast<std::int64_t>(cells.size())});
    if (depth_ == 3) {
      seen.parts[0] = labelled<3>(kLabels[1], 2);
      seen.parts[1] = labelled<2>(kLabels[2], 1);
    }
    seen.parts[2] = labelled<1>(kLabels[3], 0);
    std::vector<std::int64_t> owned = {0};
    for_each(dm_, 0, [&](PetscInt v) { owned[0] += is_ghost(v) ? 0 : 1; });
    for (const std::int64_t count : gathered(owned)) seen.vertices += count;
    return seen;
  }

  /// Those who have a point of another say the same of it.
  void check_ghosts() {
    if (roots_ < 0) return;
    for (const char* name : kLabels) {
      std::vector<PetscInt> mine;
      for (PetscInt p = 0; p < static_cast<PetscInt>(is_ghost_.size()); ++p) {
        mine.push_back(value(name, p));
      }
      std::vector<PetscInt> of_owner = mine;
      must(PetscSFBcastBegin(sf_, MPIU_INT, mine.data(), of_owner.data(), MPI_REPLACE));
      must(PetscSFBcastEnd(sf_, MPIU_INT, mine.data(), of_owner.data(), MPI_REPLACE));
      check(mine == of_owner, std::string("ghosts have other values in ") + name);
    }
    std::vector<Point> of_owner = points_;
    MPI_Datatype triple = MPI_DATATYPE_NULL;
    MPI_Type_contiguous(3, MPI_DOUBLE, &triple);
    MPI_Type_commit(&triple);
    must(PetscSFBcastBegin(sf_, triple, points_.data(), of_owner.data(), MPI_REPLACE));
    must(PetscSFBcastEnd(sf_, triple, points_.data(), of_owner.data(), MPI_REPLACE));
    MPI_Type_free(&triple);
    check(points_ == of_owner, "ghosts lie in other places");
  }

 private:
  bool is_ghost(PetscInt p) const { return is_ghost_[static_cast<std::size_t>(p)]; }
  const Point& point(PetscInt v) const { return points_[static_cast<std::size_t>(v)]; }
  PetscInt value(const char* name, PetscInt p) const {
    PetscInt found = 0;
    must(DMGetLabelValue(dm_, name, p, &found));
    return found;
  }
  template <std::size_t N>
  std::vector<std::array<double, 10>> labelled(const char* name, PetscInt depth) {
    std::vector<std::array<double, 10>> mine;
    for_each(dm_, depth, [&](PetscInt p) {
      const PetscInt number = value(name, p);
      if (number == -1 || is_ghost(p)) return;
      std::array<Point, N> corners{};
      const auto v = vertices_of<N>(dm_, p);
      for (std::size_t i = 0; i < N; ++i) corners[i] = point(v[i]);
      std::sort(corners.begin(), corners.end());
      auto& row = mine.emplace_back();
      for (std::size_t i = 0; i < N; ++i) std::copy_n(corners[i].begin(), 3, &row[3 * i]);
      row[9] = static_cast<double>(number);
    });
    auto all = gathered(mine);
    std::sort(all.begin(), all.end());
    return all;
  }

  DM dm_;
  PetscSF sf_ = nullptr;
  PetscInt depth_ = 0;
  PetscInt roots_ = 0;
  std::vector<bool> is_ghost_;
  std::vector<Point> points_;
};

Point corner(const std::array<double, 13>& cell, std::size_t i) {
  return {cell[3 * i], cell[3 * i + 1], cell[3 * i + 2]};
}

double volume(const std::array<double, 13>& cell) {
  const Point a = corner(cell, 0);
  std::array<Point, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) e[i][k] = corner(cell, i + 1)[k] - a[k];
  }
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
          e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         -6;  // PETSc's order
}

/// Faces that one cell alone has, by their corners; each other one must have two cells.
std::vector<std::array<Point, 3>> surface_of(const Picture& picture) {
  std::map<std::array<Point, 3>, int> faces;
  for (const auto& cell : picture.cells) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<Point, 3> face{};
      for (std::size_t i = 0, n = 0; i < 4; ++i) {
        if (i != left_out) face[n++] = corner(cell, i);
      }
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  std::vector<std::array<Point, 3>> surface;
  for (const auto& [face, count] : faces) {
    check(count <= 2, "a face has more than two cells");
    if (count == 1) surface.push_back(face);
  }
  return surface;
}

std::map<double, double> volumes_of(const Picture& picture) {
  std::map<double, double> volumes;
  for (const auto& cell : picture.cells) {
    check(volume(cell) > 0, "a cell is inverted in PETSc's order");
    volumes[cell[12]] += volume(cell);
  }
  return volumes;
}

void compare(const Picture& before, const Picture& after) {
  check(surface_of(before) == surface_of(after), "the surface has changed");
  check(before.parts == after.parts, "labelled faces, edges or vertices are others");
  const std::map<double, double> then = volumes_of(before);
  const std::map<double, double> now = volumes_of(after);
  check(then.size() == 3 && now.size() == 3, "there are not three regions");
  for (const auto& [region, size] : then) {
    check(now.count(region) == 1 && std::abs(now.at(region) - size) < 1e-12, "volume of a region");
  }
  std::vector<Point> vertices;
  for (const auto& cell : after.cells) {
    for (std::size_t i = 0; i < 4; ++i) vertices.push_back(corner(cell, i));
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  check(static_cast<std::int64_t>(vertices.size()) == after.vertices,
        "not each vertex has one owner");
  const auto [least, most] =
      std::minmax_element(after.cells_of_rank.begin(), after.cells_of_rank.end());
  check(*most - *least <= 1, "cells are not shared out evenly");
}

void write(const Picture& picture, const std::string& file) {
  if (rank_here() != 0) return;
  std::ofstream out(file, std::ios::binary);
  const auto put = [&](const auto& rows) {
    out.write(reinterpret_cast<const char*>(rows.data()),
              static_cast<std::streamsize>(rows.size() * sizeof(rows[0])));
  };
  put(picture.cells);
  for (const auto& part : picture.parts) put(part);
}

bool has_option(const char* name) {
  PetscBool is_there = PETSC_FALSE;
  must(PetscOptionsHasName(nullptr, nullptr, name, &is_there));
  return is_there != PETSC_FALSE;
}

void improve_box(const std::string& file) {
  const bool is_interpolated = !has_option("-plain");
  PetscInt threads = 1;
  must(PetscOptionsGetInt(nullptr, nullptr, "-threads", &threads, nullptr));
  DM dm = make_box(is_interpolated, false);
  const Picture before = Observer(dm).picture();
  must(DMCreateLabel(dm, "by hand"));
  for_each(dm, 0, [&](PetscInt v) { must(DMSetLabelValue(dm, "by hand", v, 1)); });
  if (has_option(
          "-turned")) {  // the same mesh, made by somebody who knows nothing of PETSc's order
    must(DMDestroy(&dm));
    dm = make_box(is_interpolated, true);
  }
  DM better = nullptr;
  const tetmend::Result result =
      tetmend::petsc::improve(dm, &better, {.threads = static_cast<int>(threads)}, {.count = 3});
  check(Observer(dm).picture().vertices == before.vertices, "the old one has changed");
  check(result.worse().empty() && result.after.n_bad < result.before.n_bad / 4, "it is not better");
  check(result.after.tets == static_cast<std::size_t>(Observer(better).picture().cells.size()),
        "the result speaks of another number of tets");
  must(DMPlexCheck(better));
  must(DMPlexCheckPointSF(better, nullptr, PETSC_FALSE));
  PetscInt depth = 0;
  must(DMPlexGetDepth(better, &depth));
  check(depth == (is_interpolated ? 3 : 1), "it has faces and edges, or lacks them");
  if (!has_option("-turned")) {
    check(result.notes.size() == 1 && result.notes[0].find("'by hand'") != std::string::npos,
          "nobody says that a label is left behind");
  }
  Observer now(better);
  now.check_ghosts();
  const Picture after = now.picture();
  compare(before, after);
  write(after, file);
  if (rank_here() == 0) {
    std::printf(
        "bad tets %zu to %zu, least angle %.1f to %.1f, labelled %zu faces %zu edges %zu "
        "vertices\n",
        result.before.n_bad, result.after.n_bad, result.before.theta_min, result.after.theta_min,
        after.parts[0].size(), after.parts[1].size(), after.parts[2].size());
  }
  must(DMDestroy(&better));
  must(DMDestroy(&dm));
}

/// All ranks must get the same error.
void expect_error(const char* what, DM dm, const tetmend::Options& options = {},
                  const tetmend::Pieces& pieces = {.count = 2}) {
  std::string message = "nothing";
  DM better = nullptr;
  try {
    tetmend::petsc::improve(dm, &better, options, pieces);
  } catch (const tetmend::Error& error) {
    message = error.what();
  }
  check(better == nullptr, "there is a result of a mistake");
  std::vector<char> mine(200, ' ');
  std::copy_n(message.begin(), std::min(message.size(), mine.size()), mine.begin());
  const std::vector<char> all = gathered(mine);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] == mine[i % mine.size()]) continue;
    check(false, std::string(what) + ": ranks get different errors");
    break;
  }
  if (rank_here() == 0) std::printf("%s: %s\n", what, message.c_str());
  if (dm != nullptr) must(DMDestroy(&dm));
}

/// A coordinate of the first vertex that the last rank owns gets another value, on all ranks.
template <class Move>
DM with_coordinate(Move&& move) {
  DM dm = make_box(true, false);
  Vec vector = nullptr;
  PetscScalar* values = nullptr;
  int ranks = 0;
  MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
  must(DMGetCoordinates(dm, &vector));
  must(VecGetArray(vector, &values));
  if (rank_here() == ranks - 1) values[1] = move(PetscRealPart(values[1]));
  must(VecRestoreArray(vector, &values));
  must(DMSetCoordinates(dm, vector));
  return dm;
}

/// Each rank moves what it sees of the whole mesh, as if nobody else saw it.
DM with_stale_coordinates() {
  DM dm = make_box(true, false);
  Vec vector = nullptr;
  must(DMGetCoordinatesLocal(dm, &vector));
  must(VecShift(vector, 0.01 * rank_here()));
  return dm;
}

void make_mistakes() {
  const std::array<PetscInt, 3> faces = {3, 3, 3};
  DM dm = nullptr;
  must(DMPlexCreateBoxMesh(PETSC_COMM_WORLD, 2, PETSC_FALSE, faces.data(), nullptr, nullptr,
                           nullptr, PETSC_TRUE, &dm));
  expect_error("flat", dm);
  must(DMPlexCreateBoxMesh(PETSC_COMM_WORLD, 3, PETSC_FALSE, faces.data(), nullptr, nullptr,
                           nullptr, PETSC_TRUE, &dm));
  expect_error("hexahedra", dm);
  must(DMDACreate1d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, 50, 1, 1, nullptr, &dm));
  must(DMSetUp(dm));
  expect_error("grid", dm);
  expect_error("none", nullptr);
  int ranks = 0;
  MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
  if (ranks > 1) expect_error("overlap", make_box(true, false, 1));
  expect_error("number",
               with_coordinate([](double) { return std::numeric_limits<double>::quiet_NaN(); }));
  // Wherever the vertex lies, it goes through the box and out on the other side.
  expect_error("inverted", with_coordinate([](double x) { return x < 0.5 ? 100. : -100.; }));
  if (ranks > 1) expect_error("stale", with_stale_coordinates());
  dm = make_box(true, false);
  must(DMSetLabelValue(dm, "Face Sets", 0, 3));  // a cell
  DMLabel label = nullptr;
  must(DMGetLabel(dm, "Cell Sets", &label));
  if (rank_here() == 0) {
    PetscInt value = 0;  // which cell this is depends on how they were shared out
    must(DMLabelGetValue(label, 0, &value));
    must(DMLabelClearValue(label, 0, value));
    must(DMLabelSetValue(label, 0, 4));
    must(DMLabelSetValue(label, 0, 9));
  }
  expect_error("values", dm);
  expect_error("pieces", make_box(false, false), {}, {.count = 1});
  expect_error("option", make_box(false, false), {.keep_size = true});
  must(DMPlexCreate(PETSC_COMM_WORLD, &dm));  // on each rank a cell, and a vertex too many
  must(DMSetDimension(dm, 3));
  must(DMPlexSetChart(dm, 0, 6));
  must(DMPlexSetConeSize(dm, 0, 4));
  must(DMSetUp(dm));
  const std::array<PetscInt, 4> cone = {1, 2, 3, 4};
  must(DMPlexSetCone(dm, 0, cone.data()));
  must(DMPlexSymmetrize(dm));
  must(DMPlexStratify(dm));
  expect_error("lone", dm);
  must(DMPlexCreate(PETSC_COMM_WORLD, &dm));
  must(DMSetDimension(dm, 3));
  must(DMPlexSetChart(dm, 0, 0));
  must(DMSetUp(dm));
  must(DMPlexStratify(dm));
  expect_error("empty", dm);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  must(PetscInitialize(&argc, &argv, nullptr, nullptr));
  try {
    if (std::strcmp(argv[1], "improve") == 0 && argc > 2) {
      improve_box(argv[2]);
    } else {
      make_mistakes();
    }
  } catch (const std::exception& error) {
    std::printf("FAIL on rank %d: %s\n", rank_here(), error.what());
    MPI_Abort(PETSC_COMM_WORLD, 1);
  }
  must(PetscFinalize());
  return failures == 0 ? 0 : 1;
}
