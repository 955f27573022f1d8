// SPDX-License-Identifier: MIT
// Building a mesh from a file's contents, writing it back, and re-ordering it.
#include "kernel/tet_mesh.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "kernel/exact_orientation.h"
#include "kernel/integrity.h"
#include "kernel/surface_fingerprint.h"
#include "kernel/transaction.h"
#include "kernel/workspace.h"
#include "tests/support/threads.h"
#include "tests/support/turned_ring.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

void check_same(const MeshData& a, const MeshData& b) {
  CHECK(a.points == b.points);
  CHECK(a.point_labels == b.point_labels);
  CHECK(a.tets == b.tets);
  CHECK(a.triangles == b.triangles);
  CHECK(a.edges == b.edges);
  CHECK(a.required_vertices == b.required_vertices);
}

/// Tets as sets of vertices with their label: what stays when tets are re-ordered.
std::multiset<std::pair<std::set<std::uint32_t>, Label>> tet_sets(const MeshData& data) {
  std::multiset<std::pair<std::set<std::uint32_t>, Label>> sets;
  for (const MeshData::Tet& t : data.tets) {
    sets.insert({{t.vertices.begin(), t.vertices.end()}, t.label});
  }
  return sets;
}

/// A ball with everything that a file can name.
MeshData rich_ball() {
  MeshData data = zoo_data("ball_60");
  for (std::size_t i = 0; i < data.tets.size(); ++i) {
    data.tets[i].label = data.points[data.tets[i].vertices[0]].x() < 0 ? 3 : 8;
  }
  const auto& t = data.tets[17].vertices;
  data.triangles = {{{t[0], t[1], t[2]}, 5}, {{t[3], t[0], t[1]}, 6}};
  data.edges = {{{t[2], t[3]}, 9}};
  data.required_vertices = {4, 40};
  data.point_labels.resize(data.points.size());
  for (std::size_t i = 0; i < data.points.size(); ++i) data.point_labels[i] = Label(i * i % 7);
  return data;
}

/// Leaves deleted slots of tets and vertices: fills a tet's corner with a vertex, then takes out
/// other vertices of degree four made the same way.
void make_holes(TetMesh& mesh) {
  Workspace workspace(mesh);
  const auto split = [&](TetHandle t) {
    Transaction tx(mesh, workspace);
    const TetVertices v = mesh.vertices(t);
    Point centre = Point::Zero();
    for (const VertexHandle w : v) centre += mesh.point(w) / 4;
    const VertexHandle m = tx.add_vertex(centre);
    std::array<TetVertices, 4> created = {v, v, v, v};
    for (unsigned i = 0; i < 4; ++i) created[i][i] = m;
    REQUIRE(tx.replace_cavity({&t, 1}, created) == EditResult::made);
    const std::vector<TetHandle> tets(tx.created().begin(), tx.created().end());
    tx.keep();
    return tets;
  };
  std::vector<TetHandle> big = live_tets(mesh);
  std::sort(big.begin(), big.end(),
            [&](TetHandle a, TetHandle b) { return mesh.quality(a) > mesh.quality(b); });
  std::vector<std::pair<std::vector<TetHandle>, TetVertices>> split_tets;
  for (unsigned i = 0; i < 3; ++i) {
    const TetVertices v = mesh.vertices(big[i]);
    split_tets.emplace_back(split(big[i]), v);
  }
  for (unsigned i = 0; i < 2; ++i) {
    Transaction tx(mesh, workspace);
    REQUIRE(tx.replace_cavity(split_tets[i].first, {&split_tets[i].second, 1}) == EditResult::made);
    tx.keep();
  }
}

}  // namespace

TEST_CASE("a tet takes at most 48 bytes and a vertex at most 48") {
  CHECK(TetMesh::bytes_per_tet() <= 48);
  CHECK(TetMesh::bytes_per_vertex() <= 48);
}

TEST_CASE("every mesh of the zoo is sound and comes back as it was given") {
  for (const NamedMesh& named : zoo()) {
    CAPTURE(named.name);
    const TetMesh mesh(named.data);
    CHECK(to_string(check_integrity(mesh)) == "");
    check_same(mesh.to_data(), named.data);
    CHECK(mesh.tet_count() == named.data.tets.size());
    CHECK(mesh.vertex_count() == named.data.points.size());
  }
}

TEST_CASE("labels, named triangles and edges and required vertices survive a round trip") {
  const MeshData data = rich_ball();
  BuildReport report;
  const TetMesh mesh(data, &report);
  CHECK(to_string(check_integrity(mesh)) == "");
  check_same(mesh.to_data(), data);
  CHECK(report.loose_triangles == 0);
  CHECK(report.loose_edges == 0);
  for (const std::uint32_t v : data.required_vertices) CHECK(mesh.is_fixed(VertexHandle(v)));
  for (const auto& edge : data.edges) {
    for (const std::uint32_t v : edge.vertices) CHECK(mesh.is_fixed(VertexHandle(v)));
  }
}

TEST_CASE("a mirrored mesh is corrected") {
  const MeshData data = zoo_data("ball_60");
  MeshData mirrored = data;
  for (MeshData::Tet& t : mirrored.tets) std::swap(t.vertices[0], t.vertices[1]);
  BuildReport report;
  const TetMesh mesh(mirrored, &report);
  CHECK(report.mirrored);
  CHECK(report.inverted_tets == 0);
  CHECK(report.reordered_tets == 0);
  CHECK(count_not_positive(mesh) == 0);
  CHECK(to_string(check_integrity(mesh)) == "");
  CHECK(tet_sets(mesh.to_data()) == tet_sets(data));
}

TEST_CASE("single tets that list their vertices in the wrong sense are corrected") {
  MeshData data = zoo_data("ball_60");
  for (const std::size_t t : {3, 4, 100})
    std::swap(data.tets[t].vertices[1], data.tets[t].vertices[3]);
  BuildReport report;
  const TetMesh mesh(data, &report);
  CHECK_FALSE(report.mirrored);
  CHECK(report.reordered_tets == 3);
  CHECK(report.inverted_tets == 0);
  CHECK(count_not_positive(mesh) == 0);
  CHECK(to_string(check_integrity(mesh)) == "");
}

TEST_CASE("an inverted tet and a flat tet are kept and reported") {
  BuildReport report;
  const TetMesh inverted(zoo_data("inverted_tet"), &report);
  CHECK(report.inverted_tets == 1);
  CHECK(report.flat_tets == 0);
  CHECK(report.reordered_tets == 0);
  CHECK(count_orientations(inverted) == ExactOrientation{4, 0, 1});
  BuildReport of_flat;
  const TetMesh flat(zoo_data("flat_tet"), &of_flat);
  CHECK(of_flat.flat_tets == 1);
  CHECK(of_flat.inverted_tets == 0);
  CHECK(flat.quality(TetHandle(0)) == 0);
}

TEST_CASE("a tet in the wrong sense is corrected although another one is really inverted or flat") {
  for (const char* name : {"inverted_tet", "flat_tet", "tangled_ball_60"}) {
    CAPTURE(name);
    const MeshData data = zoo_data(name);
    const TetMesh expected(data);
    // A positive tet: the first tets of the three are not positive or may not be.
    std::uint32_t wrong = 1;
    while (expected.quality(TetHandle(wrong)) < 0.1f) ++wrong;
    MeshData changed = data;
    std::swap(changed.tets[wrong].vertices[0], changed.tets[wrong].vertices[1]);
    BuildReport report;
    const TetMesh mesh(changed, &report);
    CHECK(report.reordered_tets == 1);
    CHECK(to_string(check_integrity(mesh)) == "");
    CHECK(count_orientations(mesh) == count_orientations(expected));
  }
}

TEST_CASE("a flat tet in the wrong sense is corrected by its neighbours") {
  MeshData data = zoo_data("flat_tet");
  std::swap(data.tets[0].vertices[0], data.tets[0].vertices[1]);
  BuildReport report;
  const TetMesh mesh(data, &report);
  CHECK(report.reordered_tets == 1);
  CHECK(report.flat_tets == 1);
  CHECK(to_string(check_integrity(mesh)) == "");
}

TEST_CASE("two tets on one side of a face are one that lists its vertices the other way round") {
  MeshData data = two_tets();
  data.points[4].z() = 0.7;
  data.tets[1].vertices = {0, 1, 2, 4};
  BuildReport report;
  const TetMesh mesh(data, &report);
  CHECK(report.reordered_tets == 1);
  CHECK(report.inverted_tets == 1);
  CHECK(to_string(check_integrity(mesh)) == "");
}

TEST_CASE("one inverted tet among tets of both senses is counted, and all others are put right") {
  MeshData data = zoo_data("inverted_tet");
  BuildReport plain;
  const TetMesh expected(data, &plain);
  for (std::size_t t = 0; t < data.tets.size(); t += 2) {
    std::swap(data.tets[t].vertices[0], data.tets[t].vertices[1]);
  }
  BuildReport report;
  const TetMesh mesh(data, &report);
  CHECK(report.inverted_tets == plain.inverted_tets);
  CHECK(count_orientations(mesh) == count_orientations(expected));
  CHECK(to_string(check_integrity(mesh)) == "");
}

TEST_CASE("a part that is mirrored as a whole is put right beside one that is not") {
  MeshData data = zoo_data("ball_60");
  const std::size_t tets = data.tets.size();
  const auto points = static_cast<std::uint32_t>(data.points.size());
  for (std::uint32_t v = 0; v < points; ++v) {
    data.points.push_back(data.points[v] + Point(10, 0, 0));
  }
  for (std::size_t t = 0; t < tets; ++t) {
    auto [a, b, c, d] = data.tets[t].vertices;
    data.tets.push_back({{b + points, a + points, c + points, d + points}, 0});
  }
  BuildReport report;
  const TetMesh mesh(data, &report);
  CHECK_FALSE(report.mirrored);
  CHECK(report.reordered_tets == tets);
  CHECK(report.inverted_tets == 0);
  CHECK(count_not_positive(mesh) == 0);
}

TEST_CASE("tets that no order of vertices puts on two sides of a face are an error") {
  try {
    const TetMesh mesh(turned_ring());
    FAIL("built");
  } catch (const BuildError& error) {
    CHECK(error.tet() == 5);
    CHECK(std::string(error.what()).find("same side") != std::string::npos);
    CHECK(std::string(error.what()).find("tet 6 (vertices 6 7 8 2)") != std::string::npos);
  }
}

TEST_CASE("a tet that is listed again is called so") {
  MeshData data = zoo_data("ball_60");
  data.tets.push_back(data.tets[7]);
  try {
    const TetMesh mesh(data);
    FAIL("built");
  } catch (const BuildError& error) {
    CHECK(error.tet() == data.tets.size() - 1);
    CHECK(std::string(error.what()).ends_with(" is tet 8 again"));
  }
}

TEST_CASE("three tets at one face are an error that names the third") {
  MeshData data = two_tets();
  data.points.push_back({0.2, 0.1, -2});
  data.tets.push_back({{0, 2, 1, 5}, 0});
  try {
    const TetMesh mesh(data);
    FAIL("built");
  } catch (const BuildError& error) {
    CHECK(error.tet() == 2);
    CHECK(std::string(error.what()).find("more than two") != std::string::npos);
  }
}

TEST_CASE("indices out of range, repeated vertices and an empty mesh are errors") {
  CHECK_THROWS_AS(TetMesh{MeshData()}, Error);
  MeshData data = one_tet();
  data.tets[0].vertices[2] = 4;
  CHECK_THROWS_AS(TetMesh{data}, BuildError);
  data = one_tet();
  data.tets[0].vertices[2] = 0;
  CHECK_THROWS_AS(TetMesh{data}, BuildError);
  data = one_tet();
  data.triangles.push_back({{0, 1, 9}, 0});
  CHECK_THROWS_AS(TetMesh{data}, Error);
  data = one_tet();
  data.edges.push_back({{0, 9}, 0});
  CHECK_THROWS_AS(TetMesh{data}, Error);
  data = one_tet();
  data.required_vertices.push_back(4);
  CHECK_THROWS_AS(TetMesh{data}, Error);
}

TEST_CASE("triangles and edges of no tet are kept, reported and hold their vertices") {
  MeshData data = zoo_data("ball_60");
  const TetMesh plain(data);
  std::vector<std::uint32_t> inner;
  for (const VertexHandle v : live_vertices(plain)) {
    if (!plain.is_fixed(v)) inner.push_back(v.index());
  }
  REQUIRE(inner.size() > 10);
  // Inner vertices that do not share a tet.
  Workspace workspace(plain);
  const auto apart = [&](std::uint32_t a, std::uint32_t b) {
    for (const TetHandle t : live_tets(plain)) {
      if (plain.local_index(t, VertexHandle(a)) != 4 && plain.local_index(t, VertexHandle(b)) != 4)
        return false;
    }
    return true;
  };
  std::uint32_t a = inner[0];
  std::uint32_t b =
      *std::find_if(inner.begin() + 1, inner.end(), [&](std::uint32_t v) { return apart(a, v); });
  data.edges.push_back({{a, b}, 2});
  data.triangles.push_back({{a, b, inner[5]}, 3});
  BuildReport report;
  TetMesh mesh(data, &report);
  CHECK(report.loose_edges == 1);
  CHECK(report.loose_triangles == 1);
  CHECK(report.constrained_faces == 0);
  CHECK(to_string(check_integrity(mesh)) == "");
  for (const std::uint32_t v : {a, b, inner[5]}) CHECK(mesh.is_fixed(VertexHandle(v)));
  mesh.sort_spatially();
  check_same(
      [&] {
        MeshData copy = mesh.to_data();
        copy.tets = data.tets;
        return copy;
      }(),
      data);
}

TEST_CASE("the vertices of a loose edge are fixed, so that the edge can always be written") {
  MeshData data = zoo_data("ball_60");
  BuildReport report;
  data.edges.push_back({{0, 0}, 1});
  for (std::uint32_t v = 1; v < 60; ++v) data.edges.push_back({{0, v}, 1});
  const TetMesh mesh(data, &report);
  CHECK(report.loose_edges > 10);
  for (const VertexHandle v : live_vertices(mesh)) CHECK(mesh.is_fixed(v));
}

TEST_CASE("a triangle named twice constrains once and is written twice") {
  MeshData data = constrained_face();
  data.triangles.push_back(data.triangles[0]);
  BuildReport report;
  const TetMesh mesh(data, &report);
  CHECK(report.constrained_faces == 1);
  CHECK(report.loose_triangles == 1);
  CHECK(to_string(check_integrity(mesh)) == "");
  check_same(mesh.to_data(), data);
}

TEST_CASE("the border between two labels is constrained without being named") {
  BuildReport report;
  const MeshData data = two_regions();
  const TetMesh mesh(data, &report);
  CHECK(report.constrained_faces == 8);
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      if (mesh.is_boundary(face)) continue;
      const bool border = mesh.label(t) != mesh.label(mesh.twin(face).tet());
      CHECK(mesh.is_constrained(face) == border);
      if (!border) continue;
      for (const VertexHandle v : mesh.vertices(face)) CHECK(mesh.is_fixed(v));
    }
  }
  CHECK(mesh.to_data().triangles.empty());
}

TEST_CASE("a point of a prism alone is used, though no tet has it") {
  MeshData data = one_tet();
  const auto first = static_cast<std::uint32_t>(data.points.size());
  for (int i = 0; i < 7; ++i) data.points.emplace_back(9 + i, i * i, 9);
  data.other_elements.push_back({13, 6, {}, {1}, {}, {}, {}});
  for (std::uint32_t i = 0; i < 6; ++i) data.other_elements[0].vertices.push_back(first + i);
  BuildReport report;
  const TetMesh mesh(data, &report);
  CHECK(report.unused_points == 1);
  BuildReport sorted;
  TetMesh::sorted(data, &sorted);
  CHECK(sorted.unused_points == 1);
}

TEST_CASE("a vertex of no tet is kept and reported") {
  MeshData data = one_tet();
  data.points.insert(data.points.begin(), {9, 9, 9});
  for (std::uint32_t& v : data.tets[0].vertices) ++v;
  BuildReport report;
  const TetMesh mesh(data, &report);
  CHECK(report.unused_points == 1);
  CHECK_FALSE(mesh.tet_of(VertexHandle(0)).is_valid());
  check_same(mesh.to_data(), data);
}

TEST_CASE("a vertex of no tet that another element has is used") {
  MeshData data = one_tet();
  data.points.emplace_back(9, 9, 9);
  data.points.emplace_back(8, 9, 9);
  OtherElements others;
  others.vtk_type = 13;
  others.vertex_count = 6;
  others.vertices = {0, 1, 2, 4, 4, 4};
  others.labels = {0};
  data.other_elements.push_back(others);
  BuildReport report;
  const TetMesh mesh(data, &report);
  CHECK(report.unused_points == 1);
}

TEST_CASE("garbage collection and sorting keep content and soundness, and say where it went") {
  for (const bool sort : {false, true}) {
    CAPTURE(sort);
    TetMesh mesh(rich_ball());
    make_holes(mesh);
    REQUIRE(mesh.tet_count() < mesh.tet_slots());
    REQUIRE(mesh.vertex_count() < mesh.vertex_slots());
    const auto text = [&](TetHandle t) {
      std::multiset<double> x;
      for (const VertexHandle v : mesh.vertices(t)) x.insert(mesh.point(v).x());
      std::string s;
      for (const double value : x) s += std::to_string(value) + " ";
      return s;
    };
    std::vector<std::string> names(mesh.tet_slots());
    std::vector<double> places(mesh.vertex_slots());
    for (const TetHandle t : live_tets(mesh)) names[t.index()] = text(t);
    for (const VertexHandle v : live_vertices(mesh)) places[v.index()] = mesh.point(v).x();
    const MeshData before = mesh.to_data();
    const std::uint64_t surface = surface_fingerprint(mesh);

    const TetMesh::KeptSlots kept = sort ? mesh.sort_spatially() : mesh.collect_garbage();
    CHECK(mesh.tet_slots() == mesh.tet_count());
    CHECK(mesh.vertex_slots() == mesh.vertex_count());
    CHECK(to_string(check_integrity(mesh)) == "");
    CHECK(surface_fingerprint(mesh) == surface);
    REQUIRE(kept.tets.size() == mesh.tet_slots());
    REQUIRE(kept.vertices.size() == mesh.vertex_slots());
    for (const TetHandle t : live_tets(mesh)) CHECK(names[kept.tets[t.index()]] == text(t));
    for (const VertexHandle v : live_vertices(mesh)) {
      CHECK(places[kept.vertices[v.index()]] == mesh.point(v).x());
    }
    MeshData after = mesh.to_data();
    CHECK(tet_sets(after).size() == tet_sets(before).size());
    if (!sort) CHECK(tet_sets(after) == tet_sets(before));
    after.tets = before.tets;
    // Vertices of the file keep their order, whatever their slot.
    check_same(after, before);
  }
}

TEST_CASE("a mesh that is taken apart gives the same data, and is empty then") {
  TetMesh mesh(rich_ball());
  make_holes(mesh);
  const MeshData expected = mesh.to_data();
  check_same(std::move(mesh).to_data(), expected);
  CHECK(mesh.tet_count() == 0);
  CHECK(mesh.vertex_slots() == 0);
}

TEST_CASE("building tells the number of each tet in the data, and empties the data") {
  const MeshData given = rich_ball();
  for (const bool sorted : {false, true}) {
    MeshData data = given;
    std::vector<std::uint32_t> numbers;
    const TetMesh mesh = TetMesh::build(data, {.sorted = sorted, .tet_numbers = &numbers});
    CHECK(data.tets.empty());
    CHECK(data.points.empty());
    REQUIRE(numbers.size() == given.tets.size());
    for (const TetHandle t : live_tets(mesh)) {
      for (unsigned i = 0; i < 4; ++i) {
        CHECK(mesh.origin(mesh.vertices(t)[i]) == given.tets[numbers[t.index()]].vertices[i]);
      }
    }
  }
}

TEST_CASE("scattering a compact mesh gives it the slots that it had, holes included") {
  TetMesh mesh(rich_ball());
  make_holes(mesh);
  const TetMesh before = mesh;
  std::vector<std::uint32_t> tets;
  std::vector<std::uint32_t> vertices;
  for (const TetHandle t : live_tets(mesh)) tets.push_back(t.index());
  for (const VertexHandle v : live_vertices(mesh)) vertices.push_back(v.index());
  REQUIRE(tets.size() < mesh.tet_slots());
  REQUIRE(vertices.size() < mesh.vertex_slots());
  mesh.collect_garbage();
  mesh.scatter(vertices, tets);
  CHECK(to_string(check_integrity(mesh)) == "");
  CHECK(live_tets(mesh) == live_tets(before));
  for (const TetHandle t : live_tets(before)) {
    CHECK(mesh.vertices(t) == before.vertices(t));
    CHECK(mesh.quality(t) == before.quality(t));
  }
  for (const VertexHandle v : live_vertices(before)) CHECK(mesh.point(v) == before.point(v));
}

namespace {

/// Larger than some chunks, in no order, with all that a file can name.
MeshData shuffled_cube() {
  MeshData data = kuhn_cube(16, 0.2, 5);
  std::mt19937 random(3);
  const auto shuffle = [&](auto& values) {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[random() % i]);
  };
  std::vector<std::uint32_t> number(data.points.size());
  for (std::uint32_t i = 0; i < number.size(); ++i) number[i] = i;
  shuffle(number);
  std::vector<Point> points(number.size());
  for (std::size_t i = 0; i < number.size(); ++i) points[number[i]] = data.points[i];
  data.points = points;
  for (MeshData::Tet& tet : data.tets) {
    for (std::uint32_t& v : tet.vertices) v = number[v];
    tet.label = data.points[tet.vertices[0]].x() < 0.4 ? 3 : 8;
  }
  shuffle(data.tets);
  for (std::size_t i = 0; i < data.tets.size(); i += 50) {
    const auto& t = data.tets[i].vertices;
    data.triangles.push_back({{t[2], t[0], t[3]}, Label(i % 9)});
    if (i % 100 == 0) data.edges.push_back({{t[2], t[1]}, Label(i % 5)});
  }
  data.triangles.push_back({{0, 1, 2}, 4});  // of no tet
  data.required_vertices = {4, 40, 1000};
  data.point_labels.resize(data.points.size());
  for (std::size_t i = 0; i < data.points.size(); ++i) data.point_labels[i] = Label(i * i % 7);
  return data;
}

bool same_surface(const TetMesh& a, const TetMesh& b) {
  return std::equal(a.surface_triangles().begin(), a.surface_triangles().end(),
                    b.surface_triangles().begin(), b.surface_triangles().end(),
                    [](const SurfaceTriangle& s, const SurfaceTriangle& t) {
                      return s.vertices == t.vertices && s.label == t.label && s.named == t.named &&
                             s.interior == t.interior && s.loose == t.loose;
                    });
}

bool same_report(const BuildReport& a, const BuildReport& b) {
  return a.mirrored == b.mirrored && a.reordered_tets == b.reordered_tets &&
         a.inverted_tets == b.inverted_tets && a.flat_tets == b.flat_tets &&
         a.loose_triangles == b.loose_triangles && a.loose_edges == b.loose_edges &&
         a.unused_points == b.unused_points && a.constrained_faces == b.constrained_faces;
}

}  // namespace

TEST_CASE("a mesh built in order is that built and then sorted, whatever its senses and threads") {
  const MeshData plain = shuffled_cube();
  MeshData mirrored = plain;
  for (MeshData::Tet& tet : mirrored.tets) std::swap(tet.vertices[0], tet.vertices[1]);
  MeshData mixed = plain;
  for (std::size_t t = 0; t < mixed.tets.size(); t += 7) {
    std::swap(mixed.tets[t].vertices[1], mixed.tets[t].vertices[2]);
  }
  for (const MeshData& data : {plain, mirrored, mixed}) {
    BuildReport expected_report;
    const TetMesh as_given = on_threads(1, [&] { return TetMesh(data, &expected_report); });
    CHECK(expected_report.constrained_faces > 400);
    CHECK(to_string(check_integrity(as_given)) == "");
    TetMesh expected = as_given;
    on_threads(1, [&] { expected.sort_spatially(); });
    CHECK(to_string(check_integrity(expected)) == "");
    CHECK_FALSE(expected == as_given);
    for (const int threads : {1, 2, 5}) {
      CAPTURE(threads);
      BuildReport report;
      CHECK(on_threads(threads, [&] { return TetMesh(data, &report); }) == as_given);
      CHECK(same_report(report, expected_report));
      BuildReport sorted_report;
      const TetMesh sorted =
          on_threads(threads, [&] { return TetMesh::sorted(data, &sorted_report); });
      CHECK(sorted == expected);
      CHECK(same_surface(sorted, expected));
      CHECK(same_report(sorted_report, expected_report));
      check_same(sorted.to_data(), expected.to_data());
    }
  }
}

TEST_CASE(
    "of several broken faces the first tet of the file is named, in every order and by all "
    "threads") {
  const MeshData good = shuffled_cube();
  MeshData folded = good;  // copies of tets far apart: two on one side, or three at a face
  folded.tets.push_back(good.tets[20000]);
  folded.tets.push_back(good.tets[100]);
  MeshData missing = good;
  missing.tets[20001].vertices[3] = 1u << 20;
  missing.tets[16400].vertices[1] = missing.tets[16400].vertices[2];
  const auto error_of = [](const auto& build) -> std::string {
    try {
      build();
    } catch (const BuildError& error) {
      return std::to_string(error.tet()) + ": " + error.what();
    }
    return "built";
  };
  const auto copy = std::to_string(good.tets.size());
  struct Case {
    const MeshData& data;
    std::string place;
  };
  for (const Case& bad : {Case{folded, copy + ": tet "}, Case{missing, "16400: tet 16401 "}}) {
    const MeshData& data = bad.data;
    const std::string expected = error_of([&] { on_threads(1, [&] { TetMesh{data}; }); });
    CHECK_MESSAGE(expected.starts_with(bad.place), expected);
    for (const int threads : {1, 4}) {
      CHECK(error_of([&] { on_threads(threads, [&] { TetMesh{data}; }); }) == expected);
      CHECK(error_of([&] { on_threads(threads, [&] { TetMesh::sorted(data); }); }) == expected);
    }
  }
}

TEST_CASE("tets below a limit are visited in the order of their slots, deleted ones never") {
  TetMesh mesh = TetMesh::sorted(kuhn_cube(6, 0.3, 1));
  Workspace workspace(mesh);
  workspace.provide(mesh, 100, 0);  // deleted slots at the end
  REQUIRE(mesh.tet_slots() > mesh.tet_count());
  const Quality limit = 1.2f;
  using Range = std::pair<std::size_t, std::size_t>;
  for (const Range& range :
       {Range{0, mesh.tet_slots()}, Range{5, 5}, Range{7, 200}, Range{33, 64}}) {
    const std::size_t begin = range.first;
    const std::size_t end = range.second;
    CAPTURE(begin);
    CAPTURE(end);
    std::vector<TetHandle> expected;
    for (const TetHandle t : live_tets(mesh)) {
      if (t.index() >= begin && t.index() < end && mesh.quality(t) < limit) expected.push_back(t);
    }
    std::vector<TetHandle> visited;
    mesh.visit_below(limit, begin, end, [&](TetHandle t) { visited.push_back(t); });
    CHECK(visited == expected);
    if (begin == 0) CHECK(expected.size() > mesh.tet_count() / 4);
  }
}
