// SPDX-License-Identifier: MIT
// The kernel as programs see it: walks, properties, edits, the way from a Mesh and back.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <random>
#include <ranges>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <tetmend/improve.h>
#include <tetmend/measure.h>

#include "contract/zoo.h"
#include "face/kernel/extract.h"
#include "face/kernel/own_operators.h"
#include "face/kernel/transaction.h"
#include "face/mesh_access.h"
#include "tests/face/meshes.h"
#include "tests/face/own_flip.h"
#include "tests/support/costly.h"
#include "tests/support/mixed_mesh.h"
#include "tests/support/second_order.h"

namespace tetmend::kernel {

using tetmend::test::message_of;

namespace {

TetMesh ball(unsigned points = 300) {
  return TetMesh(tetmend::MeshAccess::make(contract::delaunay_ball(points, 1)));
}

std::array<std::uint32_t, 2> ends(VertexHandle a, VertexHandle b) {
  return {std::min(a.index(), b.index()), std::max(a.index(), b.index())};
}

/// What of a mesh an undo must bring back.
struct Picture {
  std::vector<std::array<double, 3>> points;
  std::vector<TetVertices> tets;
  std::vector<Quality> qualities;
  std::size_t slots = 0;
  friend bool operator==(const Picture&, const Picture&) = default;
};

Picture picture_of(const TetMesh& mesh) {
  Picture picture;
  picture.slots = mesh.tet_slots() + mesh.vertex_slots();
  for (const VertexHandle v : mesh.vertices()) {
    const Point p = mesh.point(v);
    picture.points.push_back({p.x(), p.y(), p.z()});
  }
  for (const TetHandle t : mesh.tets()) {
    picture.tets.push_back(mesh.vertices(t));
    picture.qualities.push_back(mesh.quality(t));
  }
  return picture;
}

TetEdge any_edge(const TetMesh& mesh, std::mt19937& random) {
  for (;;) {
    const TetHandle t(static_cast<std::uint32_t>(random() % mesh.tet_slots()));
    if (!mesh.is_deleted(t)) return {t, static_cast<unsigned>(random() % 6)};
  }
}

Point middle(const TetMesh& mesh, TetEdge e) {
  const auto [a, b] = mesh.vertices(e);
  return (mesh.point(a) + mesh.point(b)) / 2;
}

EditResult any_edit(const TetMesh& mesh, Transaction& edit, std::mt19937& random) {
  const TetEdge e = any_edge(mesh, random);
  const auto [a, b] = mesh.vertices(e);
  switch (random() % 7) {
    case 0:
      return edit.flip_3_2(e);
    case 1:
      return edit.flip_2_3(HalfFace(e.tet(), e.edge() % 4));
    case 2:
      return edit.flip_4_4(e, random() % 2);
    case 3:
      return edit.contract(a, b);
    case 4:
      edit.split(e, middle(mesh, e));
      return edit.result();
    case 5:
      edit.split(HalfFace(e.tet(), e.edge() % 4), middle(mesh, e));
      return edit.result();
    default:
      return edit.move(a, (9 * mesh.point(a) + mesh.point(b)) / 10);
  }
}

/// A closed edge whose tets can be split.
TetEdge inner_edge(const TetMesh& mesh) {
  for (const TetEdge e : mesh.edges()) {
    const Ring ring = mesh.ring(e);
    if (ring.closed && !mesh.is_fixed(ring.a)) return e;
  }
  FAIL("no edge inside");
  return {};
}

VertexHandle inner_vertex(const TetMesh& mesh) {
  for (const VertexHandle v : mesh.vertices()) {
    if (!mesh.is_fixed(v)) return v;
  }
  FAIL("no vertex inside");
  return {};
}

bool are_equal(const Mesh& a, const Mesh& b) {
  const MeshArrays& x = a.arrays();
  const MeshArrays& y = b.arrays();
  return x.points == y.points && x.point_labels == y.point_labels && x.tets == y.tets &&
         x.tet_labels == y.tet_labels && x.triangles == y.triangles &&
         x.triangle_labels == y.triangle_labels && x.edges == y.edges &&
         x.edge_labels == y.edge_labels && x.required_vertices == y.required_vertices &&
         x.point_data == y.point_data && x.tet_data == y.tet_data && x.groups == y.groups &&
         x.tet_parts == y.tet_parts && x.mid_nodes == y.mid_nodes && a.notes() == b.notes();
}

MeshArrays rich_arrays() {
  MeshArrays arrays = tetmend::test::two_tet_arrays();
  arrays.tet_labels = {7, 7};
  arrays.tet_parts = {1, 2};
  arrays.point_data = {{"heat", 1, std::vector<double>{1, 2, 3, 4, 5}}};
  arrays.tet_data = {{"age", 2, std::vector<std::int32_t>{1, 2, 3, 4}}};
  arrays.groups = {{3, 1, "left", {1}, {}}, {0, 2, "marks", {}, {0, 4}}};
  return arrays;
}

template <class Range>
constexpr bool kIsRange = std::ranges::forward_range<Range>&& std::ranges::viewable_range<Range>;
static_assert(kIsRange<decltype(std::declval<TetMesh>().tets())>);
static_assert(kIsRange<decltype(std::declval<TetMesh>().faces())>);
static_assert(kIsRange<decltype(std::declval<TetMesh>().edges())>);
static_assert(kIsRange<decltype(std::declval<TetMesh>().neighbours(TetHandle()))>);
static_assert(kIsRange<Star> && std::ranges::contiguous_range<Star>);

}  // namespace

TEST_CASE("a mesh that nobody edits comes back as it was, with all that it held") {
  const Mesh rich{rich_arrays()};
  CHECK(are_equal(TetMesh(rich).to_mesh(), rich));
  const MeshData curved = tetmend::test::second_order(contract::delaunay_ball(60, 1), 0.1);
  const Mesh second = tetmend::MeshAccess::make(curved);
  CHECK(are_equal(TetMesh(second).to_mesh(), second));
  MeshData noted = contract::delaunay_ball(60, 2);
  noted.notes = {"3 springs"};
  const Mesh with_note = tetmend::MeshAccess::make(noted);
  CHECK(TetMesh(with_note).to_mesh().notes() == noted.notes);
}

TEST_CASE("after edits, garbage collection and sorting the data of a mesh are where they belong") {
  MeshData data = contract::delaunay_ball(200, 1);
  std::vector<double> places, numbers;
  for (const Point& p : data.points) places.push_back(2 * p.x() + p.y());
  for (std::size_t t = 0; t < data.tets.size(); ++t)
    numbers.push_back(static_cast<double>(t) + 0.5);  // no identifiers
  data.point_data = {{"place", 1, places}};
  data.tet_data = {{"number", 1, numbers}};
  const auto old_tets = data.tets;
  const auto old_points = data.points;
  TetMesh mesh(tetmend::MeshAccess::make(std::move(data)));
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    Transaction edit(mesh);
    if (any_edit(mesh, edit, random) == EditResult::made) edit.keep();
  }
  mesh.collect_garbage();
  mesh.sort_spatially();
  CHECK(mesh.check().empty());
  const Mesh after = mesh.to_mesh();
  const auto& heat = std::get<std::vector<double>>(after.point_data()[0].values);
  std::size_t same = 0;
  for (std::size_t i = 0; i < after.point_count(); ++i) {
    const auto& p = after.points()[i];
    CHECK(heat[i] == doctest::Approx(2 * p[0] + p[1]));
  }
  const auto& number = std::get<std::vector<double>>(after.tet_data()[0].values);
  std::map<std::set<std::array<double, 3>>, double> known;
  for (std::size_t t = 0; t < old_tets.size(); ++t) {
    std::set<std::array<double, 3>> corners;
    for (const std::uint32_t v : old_tets[t].vertices) {
      corners.insert({old_points[v].x(), old_points[v].y(), old_points[v].z()});
    }
    known[corners] = static_cast<double>(t) + 0.5;
  }
  for (std::size_t t = 0; t < after.tet_count(); ++t) {
    std::set<std::array<double, 3>> corners;
    for (const std::uint32_t v : after.tets()[t]) corners.insert(after.points()[v]);
    const auto found = known.find(corners);
    if (found == known.end()) continue;
    ++same;
    CHECK(number[t] == found->second);
  }
  CHECK(same > 50);
}

TEST_CASE("walks and finds agree with a look at every tet") {
  TetMesh mesh = ball();
  mesh.sort_spatially();
  std::map<std::uint32_t, std::set<TetHandle>> stars;
  std::map<std::uint32_t, std::set<VertexHandle>> rings;
  std::map<std::array<std::uint32_t, 2>, std::set<TetHandle>> edges;
  for (const TetHandle t : mesh.tets()) {
    for (const VertexHandle v : mesh.vertices(t)) {
      stars[v.index()].insert(t);
      for (const VertexHandle w : mesh.vertices(t)) {
        if (v == w) continue;
        rings[v.index()].insert(w);
        edges[ends(v, w)].insert(t);
      }
    }
  }
  const Rows<TetHandle> all_stars = mesh.stars();
  const Rows<VertexHandle> all_rings = mesh.one_rings();
  for (const VertexHandle v : mesh.vertices()) {
    const Star star = mesh.star(v);
    CHECK(std::set<TetHandle>(star.begin(), star.end()) == stars[v.index()]);
    CHECK(star.size() == stars[v.index()].size());
    CHECK(std::equal(star.begin(), star.end(), all_stars[v].begin(), all_stars[v].end()));
    const OneRing ring = mesh.one_ring(v);
    CHECK(std::set<VertexHandle>(ring.begin(), ring.end()) == rings[v.index()]);
    CHECK(ring.size() == rings[v.index()].size());
    CHECK(std::equal(ring.begin(), ring.end(), all_rings[v].begin(), all_rings[v].end()));
  }
  CHECK(mesh.edges().size() == edges.size());
  std::set<std::array<std::uint32_t, 2>> listed;
  std::size_t open = 0;
  for (const TetEdge e : mesh.edges()) {
    const Ring ring = mesh.ring(e);
    listed.insert(ends(ring.a, ring.b));
    CHECK(std::set<TetHandle>(ring.tets.begin(), ring.tets.end()) == edges[ends(ring.a, ring.b)]);
    CHECK(ring.vertices.size() == ring.tets.size() + (ring.closed ? 0 : 1));
    open += ring.closed ? 0 : 1;
    for (std::size_t i = 0; i < ring.tets.size(); ++i) {
      const VertexHandle p = ring.vertices[i];
      const VertexHandle q = ring.vertices[i + 1 == ring.vertices.size() ? 0 : i + 1];
      CHECK(mesh.find_tet(ring.a, ring.b, p, q) == ring.tets[i]);
      CHECK(volume6(mesh.point(ring.a), mesh.point(ring.b), mesh.point(p), mesh.point(q)) > 0);
    }
    CHECK(mesh.find_edge(ring.b, ring.a).has_value());
    CHECK(mesh.is_boundary(e) == !ring.closed);
  }
  CHECK(listed.size() == edges.size());
  std::size_t faces = 0, outer = 0;
  for (const HalfFace f : mesh.faces()) {
    ++faces;
    const auto [a, b, c] = mesh.vertices(f);
    CHECK(mesh.find_face(a, b, c) == f);
    CHECK(mesh.find_face(b, c, a) == f);
    if (!mesh.is_boundary(f)) CHECK(mesh.find_face(a, c, b) == mesh.twin(f));
    CHECK(mesh.twins(f.tet())[f.face()] == mesh.twin(f));
  }
  for (const HalfFace f : mesh.boundary()) outer += mesh.is_boundary(f) ? 1 : 0;
  CHECK(2 * faces == 4 * mesh.tet_count() + outer);
  CHECK(2 * open == 3 * outer);  // a closed surface
}

TEST_CASE("nested loops over one-rings see what each of them sees alone") {
  const TetMesh mesh = ball();
  for (const VertexHandle v : mesh.vertices()) {
    std::set<VertexHandle> nested, apart;
    for (const VertexHandle w : mesh.one_ring(v)) {
      for (const VertexHandle x : mesh.one_ring(w)) nested.insert(x);
    }
    const OneRing ring = mesh.one_ring(v);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const OneRing other = mesh.one_ring(ring[i]);
      apart.insert(other.begin(), other.end());
    }
    CHECK(nested == apart);
  }
}

TEST_CASE("random edits that are undone leave mesh and properties of three types bit for bit") {
  TetMesh mesh = ball();
  auto number = mesh.tet_property<int>("number", -1);
  auto name = mesh.tet_property<std::string>("name", "new", NewTets::inherited);
  auto mark = mesh.vertex_property<bool>("mark", true);
  std::mt19937 random(7);
  for (const TetHandle t : mesh.tets()) {
    number[t] = static_cast<int>(random() % 1000);
    name[t] = "a tet with a long name, number " + std::to_string(t.index());
  }
  for (const VertexHandle v : mesh.vertices()) mark[v] = random() % 2 == 0;
  const auto values = [&] {
    std::vector<std::pair<int, std::string>> all;
    for (const TetHandle t : mesh.tets()) all.emplace_back(number[t], name[t]);
    for (const VertexHandle v : mesh.vertices()) all.emplace_back(mark[v], "");
    return all;
  };
  std::size_t made = 0;
  for (int round = 0; round < 300; ++round) {
    const Picture before = picture_of(mesh);
    const auto before_values = values();
    {
      Transaction edit(mesh);
      for (int i = 0; i < 4; ++i) {
        if (any_edit(mesh, edit, random) == EditResult::made) ++made;
        Transaction inner(mesh);
        any_edit(mesh, inner, random);
        if (i % 2 == 0) inner.keep();
      }
      if (round % 3 == 0) {
        edit.undo();
        any_edit(mesh, edit, random);
      }
    }
    REQUIRE(picture_of(mesh) == before);
    REQUIRE(values() == before_values);
    {
      Transaction kept(mesh);
      if (any_edit(mesh, kept, random) == EditResult::made) kept.keep();
    }
    if (round % 100 == 99) {
      REQUIRE(mesh.check().empty());
      mesh.collect_garbage();
    }
  }
  CHECK(made > 300);
  CHECK(mesh.check().empty());
  CHECK(tetmend::measure(mesh.to_mesh()).statistics.inverted == 0);
}

TEST_CASE("a million random edits, undone or kept, leave a sound mesh and properties in step") {
  constexpr std::size_t kEdits = 1'000'000;
  TetMesh mesh = ball(40);
  auto number = mesh.tet_property<int>("number", -1);
  auto name = mesh.tet_property<std::string>("name", "new", NewTets::inherited);
  auto sum = mesh.tet_property<double>(
      "sum", 0, [](std::span<const double> old, TetHandle) { return old[0] + 1; });
  for (const TetHandle t : mesh.tets()) {
    number[t] = static_cast<int>(t.index());
    name[t] = "a name that is too long to lie in the string itself";
  }
  const std::string inherited = name[*mesh.tets().begin()];
  std::mt19937 random(11);
  std::size_t attempts = 0, made = 0;
  for (std::size_t round = 0; attempts < kEdits; ++round) {
    {
      Transaction edit(mesh);
      for (int i = 0; i < 5; ++i, ++attempts) {
        made += any_edit(mesh, edit, random) == EditResult::made ? 1 : 0;
        if (i == 2 && random() % 4 == 0) edit.undo();
      }
      // The mesh stays as small as it is: growth is undone.
      if (mesh.tet_count() < 400 && random() % 2 == 0) edit.keep();
    }
    if (round % 20 == 19 && !mesh.check().empty()) FAIL("broken after attempt ", attempts);
    if (round % 5000 == 4999) mesh.collect_garbage();
  }
  CHECK(made > kEdits / 20);
  REQUIRE(mesh.check().empty());
  std::size_t kept = 0;
  for (const TetHandle t : mesh.tets()) {
    // A tet that nothing has replaced has all that it had; one that was made has what its rules say.
    CHECK((number[t] == -1) == (sum[t] > 0));
    CHECK(name[t] == inherited);
    kept += number[t] == -1 ? 0 : 1;
  }
  MESSAGE(made, " edits, ", kept, " tets of the start left of ", mesh.tet_count());
}

TEST_CASE("many threads may walk a mesh at the same time") {
  const TetMesh mesh = ball(600);
  const auto walk = [&mesh] {
    std::size_t sum = 0;
    for (const VertexHandle v : mesh.vertices()) {
      sum += mesh.star(v).size() + mesh.link(v).size() + mesh.one_ring(v).size();
      sum += mesh.is_boundary(v) || mesh.is_fixed(v) ? 1 : 0;
    }
    for (const TetEdge e : mesh.edges()) {
      const Ring ring = mesh.ring(e);
      sum += ring.tets.size() + ring.vertices.size();
      sum += mesh.find_edge(ring.a, ring.b) ? 1 : 0;
    }
    for (const HalfFace f : mesh.faces()) {
      const auto [a, b, c] = mesh.vertices(f);
      sum += mesh.find_face(a, b, c) ? 1 : 0;
    }
    for (const TetHandle t : mesh.tets()) {
      const TetVertices& v = mesh.vertices(t);
      sum += mesh.find_tet(v[0], v[1], v[2], v[3]) ? mesh.neighbours(t).size() : 0;
      sum += mesh.quality(t) > 0 ? 1 : 0;
    }
    return sum + mesh.one_rings().values.size() + mesh.stars().values.size() + mesh.check().size() +
           mesh.to_mesh().tet_count();
  };
  const std::size_t expected = walk();
  std::array<std::size_t, 4> sums{};
  {
    std::vector<std::thread> threads;
    for (std::size_t& sum : sums) threads.emplace_back([&] { sum = walk(); });
    for (std::thread& thread : threads) thread.join();
  }
  for (const std::size_t sum : sums) CHECK(sum == expected);
}

TEST_CASE(
    "properties begin with the arrays of a mesh and come back as such, after all that happens") {
  MeshArrays arrays = ball().to_mesh().arrays();
  std::vector<double> age;
  std::vector<std::int32_t> name;
  std::vector<float> wind;
  for (std::size_t t = 0; t < arrays.tets.size(); ++t) age.push_back(static_cast<double>(t) + 0.5);
  for (std::size_t v = 0; v < arrays.points.size(); ++v) {
    name.push_back(static_cast<std::int32_t>(7 * v));
    wind.insert(wind.end(), {static_cast<float>(v), 2, 3});
  }
  arrays.tet_data = {{"age", 1, age}};
  arrays.point_data = {{"name", 1, name}, {"wind", 3, wind}};
  TetMesh mesh{Mesh(arrays)};
  const auto ages = mesh.tet_data<double>("age", -1);
  const auto names = mesh.point_data<std::int64_t>("name");
  const auto winds = mesh.point_data<Point>("wind", Point(9, 9, 9));
  const auto marks = mesh.tet_data<bool>("mark", true);
  for (const TetHandle t : mesh.tets()) {
    CHECK(ages[t] == t.index() + 0.5);
    marks[t] = false;
  }
  for (const VertexHandle v : mesh.vertices()) {
    CHECK(names[v] == 7 * v.index());
    CHECK(winds[v] == Point(v.index(), 2, 3));
  }
  {
    Transaction edit(mesh);
    const TetEdge e = inner_edge(mesh);
    const VertexHandle middle_vertex = edit.split(e, middle(mesh, e));
    REQUIRE(middle_vertex.is_valid());
    edit.keep();
    names[middle_vertex] = -5;
  }
  mesh.sort_spatially();
  const Mesh out = mesh.to_mesh();
  const auto find = [](const auto& list, std::string_view wanted) {
    const auto found = std::find_if(list.begin(), list.end(),
                                    [&](const auto& each) { return each.name == wanted; });
    REQUIRE(found != list.end());
    return *found;
  };
  const auto out_ages = std::get<std::vector<double>>(find(out.arrays().tet_data, "age").values);
  const auto out_marks =
      std::get<std::vector<std::int32_t>>(find(out.arrays().tet_data, "mark").values);
  REQUIRE(out_ages.size() == out.tet_count());
  std::size_t made = 0;
  for (std::size_t t = 0; t < out.tet_count(); ++t) {
    CHECK((out_ages[t] == -1) == (out_marks[t] == 1));
    made += out_ages[t] == -1 ? 1 : 0;
    if (out_ages[t] == -1) continue;
    // The same corners as the tet of that age had.
    auto was = arrays.tets[static_cast<std::size_t>(out_ages[t])];
    auto is = out.tets()[t];
    std::sort(was.begin(), was.end());
    std::sort(is.begin(), is.end());
    CHECK(was == is);
  }
  CHECK(made > 5);
  const auto out_names =
      std::get<std::vector<std::int64_t>>(find(out.arrays().point_data, "name").values);
  REQUIRE(out_names.size() == out.point_count());
  CHECK(out_names.back() == -5);
  CHECK(out_names[3] == 21);
  CHECK(std::get<std::vector<double>>(find(out.arrays().point_data, "wind").values)[9] == 3);
  CHECK(find(out.arrays().point_data, "wind").components == 3);
}

TEST_CASE("an array of a mesh that does not fit the type of a property is refused with its name") {
  TetMesh mesh{Mesh(rich_arrays())};
  CHECK(message_of([&] { mesh.tet_data<int>("age"); }) ==
        "array 'age' has 2 numbers each, and the property 1");
  MeshArrays arrays = rich_arrays();
  arrays.point_data = {{"heat", 1, std::vector<double>{1, 2, 3.5, 4, 5}}};
  TetMesh other{Mesh(arrays)};
  CHECK(message_of([&] { other.point_data<int>("heat"); }).find("3.5 at 2 is no value") !=
        std::string::npos);
}

TEST_CASE("new tets get the initial value, that of an old tet, or what a function says") {
  TetMesh mesh = ball();
  auto initial = mesh.tet_property<int>("initial", 5);
  auto inherited = mesh.tet_property<int>("inherited", 0, NewTets::inherited);
  auto sum = mesh.tet_property<double>("sum", 0.0, [](std::span<const double> old, TetHandle) {
    double total = 0;
    for (const double value : old) total += value;
    return total;
  });
  for (const TetHandle t : mesh.tets()) initial[t] = 1, inherited[t] = 2, sum[t] = 1;
  const TetEdge e = inner_edge(mesh);
  const std::size_t degree = mesh.ring(e).tets.size();
  Transaction edit(mesh);
  REQUIRE(edit.split(e, middle(mesh, e)).is_valid());
  const auto created = edit.created();
  CHECK(created.size() == 2 * degree);
  for (const TetHandle t : created) {
    CHECK(initial[t] == 5);
    CHECK(inherited[t] == 2);
    CHECK(sum[t] == static_cast<double>(degree));
  }
}

TEST_CASE("an exception of a rule for new tets comes out of the edit, which is undone") {
  TetMesh mesh = ball();
  mesh.tet_property<int>("plain", 3);
  mesh.tet_property<int>("odd", 0,
                         [](std::span<const int>, TetHandle) -> int { throw Error("no value"); });
  const Picture before = picture_of(mesh);
  const TetEdge e = inner_edge(mesh);
  {
    Transaction edit(mesh);
    CHECK(message_of([&] { edit.split(e, middle(mesh, e)); }) == "no value");
    edit.keep();
  }
  CHECK(picture_of(mesh) == before);
  CHECK(message_of([&] {
          for (const TetEdge each : mesh.edges()) attempt(mesh, "edge_removal", each);
        }) == "no value");
  CHECK(picture_of(mesh) == before);
  CHECK(mesh.check().empty());
  mesh.remove_tet_property("odd");
  Transaction edit(mesh);
  CHECK(edit.split(e, middle(mesh, e)).is_valid());
}

TEST_CASE("undo brings back the values that a program wrote before an edit") {
  TetMesh mesh = ball();
  auto colour = mesh.tet_property<std::string>("colour", "none");
  auto weight = mesh.vertex_property<double>("weight", -1);
  const TetHandle t(7);
  colour[t] = "from the file";
  const TetVertices whole = mesh.vertices(t);
  Transaction edit(mesh);
  const auto [a, b, c, d] = mesh.points(t);
  const VertexHandle m = edit.split(t, (a + b + c + d) / 4);
  REQUIRE(m.is_valid());
  CHECK(weight[m] == -1);
  weight[m] = 3;
  const auto four = edit.created();
  REQUIRE(four.size() == 4);
  for (const TetHandle u : four) {
    CHECK(colour[u] == "none");
    colour[u] = "mine";
  }
  {
    Transaction inner(mesh);
    REQUIRE(inner.replace(four, {whole}) == EditResult::made);
    CHECK(colour[inner.created()[0]] == "none");
  }
  for (const TetHandle u : four) CHECK(colour[u] == "mine");
  CHECK(weight[m] == 3);
  edit.undo();
  CHECK(colour[t] == "from the file");
}

TEST_CASE("an edit for whose properties memory runs out has changed nothing") {
  using tetmend::test::Costly;
  TetMesh mesh = ball();
  auto colour = mesh.tet_property<std::string>("colour", "none", NewTets::inherited);
  auto tets = mesh.tet_property<Costly>("costly", Costly(1));
  auto vertices = mesh.vertex_property<Costly>("costly", Costly(2));
  const TetHandle t(7);
  tets[t] = Costly(7);
  for (const TetHandle u : mesh.tets()) colour[u] = std::to_string(u.index());
  const Picture before = picture_of(mesh);
  const TetVertices whole = mesh.vertices(t);
  const auto [a, b, c, d] = mesh.points(t);
  int copies = 0;
  for (bool made = false; !made; ++copies) {
    {
      Transaction edit(mesh);
      Costly::copies_left = copies;
      try {
        const VertexHandle m = edit.split(t, (a + b + c + d) / 4);
        REQUIRE(m.is_valid());
        made = edit.replace(edit.created(), {whole}) == EditResult::made;
      } catch (const std::bad_alloc&) {
      }
      Costly::copies_left = Costly::kPlenty;
    }
    CHECK(picture_of(mesh) == before);
    for (const TetHandle u : mesh.tets()) {
      CHECK(tets[u].value == (u == t ? 7 : 1));
      CHECK(colour[u] == std::to_string(u.index()));
    }
    for (const VertexHandle v : mesh.vertices()) CHECK(vertices[v].value == 2);
  }
  CHECK(copies > 5);
}

TEST_CASE("a locked vertex neither moves nor vanishes, whoever tries") {
  TetMesh mesh = ball();
  const VertexHandle v = inner_vertex(mesh);
  mesh.lock(v);
  CHECK(mesh.is_fixed(v));
  const Point place = mesh.point(v);
  {
    Transaction edit(mesh);
    CHECK(edit.move(v, place + Point(1e-9, 0, 0)) == EditResult::constrained);
    for (const VertexHandle w : mesh.one_ring(v)) CHECK(edit.contract(v, w) != EditResult::made);
    edit.keep();
  }
  CHECK(attempt(mesh, "smoothing", v).verdict == Verdict::constrained);
  for (const VertexHandle w : mesh.vertices()) attempt(mesh, "edge_contraction", w);
  CHECK(!mesh.is_deleted(v));
  CHECK(mesh.point(v) == place);
  mesh.unlock(v);
  Transaction edit(mesh);
  CHECK(edit.move(v, place + Point(1e-9, 0, 0)) == EditResult::made);
}

TEST_CASE("mistakes are refused with words") {
  TetMesh mesh = ball();
  const TetEdge e = inner_edge(mesh);
  const VertexHandle v = inner_vertex(mesh);
  const auto all = [&] { return std::vector<TetHandle>{e.tet()}; };
  Transaction edit(mesh);
  CHECK(message_of([&] { edit.replace(all(), {TetVertices()}); }) ==
        "replace: a handle of no vertex, as the corners of a deleted tet are");
  CHECK(message_of([&] {
          mesh.neighbours(TetHandle(4000000));
        }).starts_with("neighbours: no tet 4000000: "));
  CHECK(message_of([&] { mesh.star(VertexHandle(100000)); }) ==
        "star: no vertex 100000: the mesh has slots 0 to " +
            std::to_string(mesh.vertex_slots() - 1));
  CHECK(message_of([&] { mesh.tet_property<int>("late"); }) ==
        "a property is added while a transaction is open: it ends with its scope, kept or not");
  CHECK(message_of([&] { mesh.collect_garbage(); }) ==
        "collect_garbage() while a transaction is open: it ends with its scope, kept or not");
  CHECK(message_of([&] { mesh.to_mesh(); }) ==
        "to_mesh() while a transaction is open: it ends with its scope, kept or not");
  CHECK(message_of([&] { TetMesh copy(mesh); }) ==
        "a copy is made while a transaction is open: it ends with its scope, kept or not");
  CHECK(message_of([&] { edit.move(v, Point(std::nan(""), 0, 0)); }) ==
        "move: (nan, 0, 0) is not finite");
  {
    Transaction inner(mesh);
    CHECK(message_of([&] { edit.split(e, middle(mesh, e)); }) ==
          "an edit while a transaction inside is open");
    CHECK(message_of([&] { edit.keep(); }) == "keep() while a transaction inside is open");
    const VertexHandle lost = inner.add_vertex(Point(0, 0, 0));
    CHECK(message_of([&] { inner.keep(); }) ==
          "keep(): vertex " + std::to_string(lost.index()) + " was added, and no tet has it");
  }
  CHECK(edit.replace(std::vector<TetHandle>{e.tet(), e.tet()},
                     {mesh.vertices(e.tet()), mesh.vertices(e.tet())}) == EditResult::not_closed);
  CHECK(edit.move(v, Point(1e9, 0, 0)) == EditResult::inverted);
  edit.keep();
  CHECK(message_of([&] { edit.move(v, mesh.point(v)); }) ==
        "an edit in a transaction that was kept: open another one");
  CHECK(mesh.check().empty());
}

TEST_CASE("a handle of something deleted is refused, and walks of it are empty") {
  TetMesh mesh = ball();
  VertexHandle gone;
  for (const VertexHandle v : mesh.vertices()) {
    if (gone.is_valid()) break;
    for (const VertexHandle w : mesh.one_ring(v)) {
      Transaction edit(mesh);
      if (edit.contract(v, w) != EditResult::made) continue;
      edit.keep();
      gone = v;
      break;
    }
  }
  REQUIRE(mesh.is_deleted(gone));
  CHECK(mesh.star(gone).empty());
  CHECK(mesh.one_ring(gone).empty());
  TetHandle free;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (mesh.is_deleted(TetHandle(i))) free = TetHandle(i);
  }
  REQUIRE(free.is_valid());
  CHECK(mesh.ring(TetEdge(free, 0)).tets.empty());
  CHECK(mesh.neighbours(free).size() == 0);
  CHECK(attempt(mesh, "edge_removal", TetEdge(free, 0)).verdict == Verdict::not_applicable);
  Transaction edit(mesh);
  CHECK(edit.flip_3_2(TetEdge(free, 1)) == EditResult::not_closed);
  CHECK(edit.flip_2_3(HalfFace(free, 1)) == EditResult::not_closed);
  CHECK(!edit.split(free, Point(0, 0, 0)).is_valid());
  CHECK(edit.move(gone, Point(0, 0, 0)) == EditResult::not_closed);
  const TetHandle live = *mesh.tets().begin();
  TetVertices with_gone = mesh.vertices(live);
  with_gone[0] = gone;
  CHECK(edit.replace(std::vector<TetHandle>{live}, {with_gone}) == EditResult::not_closed);
}

TEST_CASE("rows of all vertices have none for a vertex that was added later") {
  TetMesh mesh = ball();
  const Rows<TetHandle> stars = mesh.stars();
  const TetHandle t = *mesh.tets().begin();
  Transaction edit(mesh);
  Point centre = Point::Zero();
  for (const Point& p : mesh.points(t)) centre += p / 4;
  const VertexHandle v = edit.split(t, centre);
  REQUIRE(v.is_valid());
  CHECK(stars[v].empty());
  CHECK(!mesh.star(v).empty());
}

TEST_CASE("a loop over edges that edits sees each edge that is still there once") {
  TetMesh mesh = ball();
  std::set<std::array<std::uint32_t, 2>> seen;
  std::size_t flips = 0;
  for (const TetEdge e : mesh.edges()) {
    REQUIRE(!mesh.is_deleted(e.tet()));
    const auto [a, b] = mesh.vertices(e);
    CHECK(seen.insert(ends(a, b)).second);
    Transaction edit(mesh);
    if (edit.flip_3_2(e) != EditResult::made) continue;
    edit.keep();
    ++flips;
    CHECK(!mesh.find_edge(a, b).has_value());
  }
  CHECK(flips > 10);
  for (const TetEdge e : mesh.edges()) {
    const auto [a, b] = mesh.vertices(e);
    CHECK(seen.count(ends(a, b)) == 1);
  }
}

TEST_CASE("garbage collection and sorting say where everything went, and properties follow") {
  TetMesh mesh = ball();
  auto number = mesh.tet_property<std::uint32_t>("number");
  auto place = mesh.vertex_property<Point>("place", Point::Zero());
  for (const VertexHandle v : mesh.vertices()) {
    for (const VertexHandle w : mesh.one_ring(v)) {
      Transaction edit(mesh);
      if (mesh.vertex_count() < 290 || edit.contract(v, w) != EditResult::made) continue;
      edit.keep();
      break;
    }
  }
  REQUIRE(mesh.tet_count() < mesh.tet_slots());
  for (const TetHandle t : mesh.tets()) number[t] = t.index();
  for (const VertexHandle v : mesh.vertices()) place[v] = mesh.point(v);
  std::vector<TetVertices> old(mesh.tet_slots());
  for (const TetHandle t : mesh.tets()) old[t.index()] = mesh.vertices(t);
  const Renumbering went = mesh.sort_spatially();
  CHECK(mesh.tet_count() == mesh.tet_slots());
  for (std::uint32_t i = 0; i < old.size(); ++i) {
    const bool was_there = old[i][0].is_valid();
    REQUIRE((went.tets[i] != kGoneSlot) == was_there);
    if (!was_there) continue;
    CHECK(number[TetHandle(went.tets[i])] == i);
    for (const VertexHandle v : old[i]) {
      const auto& now = mesh.vertices(TetHandle(went.tets[i]));
      CHECK(std::count(now.begin(), now.end(), VertexHandle(went.vertices[v.index()])) == 1);
    }
  }
  for (const VertexHandle v : mesh.vertices()) CHECK(place[v] == mesh.point(v));
  CHECK(mesh.check().empty());
}

TEST_CASE("an attempt that is only tried shows its tree and leaves the mesh alone") {
  TetMesh mesh = ball();
  auto age = mesh.tet_property<int>("age", 0);
  for (const TetHandle t : mesh.tets()) age[t] = 1;
  std::size_t accepted = 0, deep = 0;
  for (const TetEdge e : mesh.edges()) {
    if (mesh.quality(e.tet()) >= 1) continue;
    const Picture before = picture_of(mesh);
    const Call tried = try_only(mesh, "recursive_shell_transformation", e, {{"max_level", 3}});
    REQUIRE(picture_of(mesh) == before);
    const Call made = attempt(mesh, "recursive_shell_transformation", e, {{"max_level", 3}});
    CHECK(made.text() == tried.text());
    CHECK(made.target.size() == 2);
    CHECK((picture_of(mesh) == before) == !made.accepted());
    accepted += made.accepted() ? 1 : 0;
    deep += made.children.empty() ? 0 : 1;
    if (made.accepted()) CHECK(made.worst_after > made.worst_before);
  }
  CHECK(accepted > 0);
  CHECK(deep > 0);
  CHECK(std::count_if(mesh.tets().begin(), mesh.tets().end(),
                      [&](TetHandle t) { return age[t] == 0; }) > 0);
  CHECK(message_of([&] { attempt(mesh, "edge_removal", VertexHandle(0)); }) ==
        "attempt: operator 'edge_removal' is for a target of kind edge, not vertex");
  CHECK(message_of([&] { attempt(mesh, "nothing", TetHandle(0)); }).find("unknown operator") == 0);
}

TEST_CASE("an operator of a program does what that of tetmend does, under the same judge") {
  TetMesh mesh = ball();
  Operators own;
  own.add("my_flip", "three tets of an edge become two", test::flip_to_two);
  std::size_t accepted = 0;
  for (const TetEdge e : mesh.edges()) {
    const Picture before = picture_of(mesh);
    const Call theirs = try_only(mesh, "flip_3_2", e);
    const Call tried = try_only(mesh, own, "my_flip", e);
    REQUIRE(picture_of(mesh) == before);
    CHECK(tried.accepted() == theirs.accepted());
    CHECK(tried.target.size() == 2);
    const Call made = attempt(mesh, own, "my_flip", e);
    CHECK(made.text() == tried.text());
    CHECK((picture_of(mesh) == before) == !made.accepted());
    if (!made.accepted()) continue;
    ++accepted;
    CHECK(made.worst_after == theirs.worst_after);
  }
  CHECK(accepted > 0);
  CHECK(mesh.check().empty());
  CHECK(attempt(mesh, own, "smoothing", inner_vertex(mesh)).operator_name == "smoothing");
  CHECK(message_of([&] { attempt(mesh, own, "my_flip", TetHandle(0)); }) ==
        "attempt: operator 'my_flip' is for a target of kind edge, not tet");
  CHECK(message_of([&] {
          own.add("my_flip", "again",
                  [](const TetMesh&, TetHandle, Proposal&) { return Verdict::not_applicable; });
        }) == "operator 'my_flip' is registered twice");
  CHECK(message_of([&] {
          own.add("smoothing", "another",
                  [](const TetMesh&, TetHandle, Proposal&) { return Verdict::not_applicable; });
        }) == "operator 'smoothing' is one of tetmend");
}

TEST_CASE("an operator of a program is judged by its own criterion, and a wrong one is refused") {
  TetMesh mesh = ball();
  Operators own;
  std::size_t asked = 0;
  own.add(
      "shift", "a vertex to the mean of those around",
      [](const TetMesh& look, VertexHandle v, Proposal& out) {
        Point mean = Point::Zero();
        const OneRing ring = look.one_ring(v);
        for (const VertexHandle w : ring) {
          mean += look.point(w) / static_cast<double>(ring.size());
        }
        return out.move(v, mean);
      },
      Judge::by([&](Judge::Tets before, Judge::Tets now) {
        ++asked;
        CHECK(before.size() == now.size());
        return asked % 2 == 0;
      }));
  std::size_t accepted = 0;
  for (const VertexHandle v : mesh.vertices()) {
    const Point place = mesh.point(v);
    const Call call = attempt(mesh, own, "shift", v);
    if (mesh.is_fixed(v)) CHECK(call.verdict == Verdict::constrained);
    CHECK((mesh.point(v) != place) == call.accepted());
    accepted += call.accepted() ? 1 : 0;
  }
  CHECK(asked > 10);
  CHECK(accepted == asked / 2);

  own.add("wrong", "turns a tet over", [](const TetMesh& look, TetHandle t, Proposal& out) {
    TetVertices v = look.vertices(t);
    std::swap(v[0], v[1]);
    return out.replace(std::vector<TetHandle>{t}, {v});
  });
  own.add("empty", "proposes nothing",
          [](const TetMesh&, TetHandle, Proposal&) { return Verdict::accepted; });
  own.add("broken", "throws",
          [](const TetMesh&, TetHandle, Proposal&) -> Verdict { throw Error("no idea"); });
  const Picture before = picture_of(mesh);
  const TetHandle t = *mesh.tets().begin();
  CHECK(attempt(mesh, own, "wrong", t).verdict == Verdict::inverted);
  CHECK(attempt(mesh, own, "empty", t).verdict == Verdict::not_applicable);
  CHECK(message_of([&] { attempt(mesh, own, "broken", t); }) == "no idea");
  CHECK(picture_of(mesh) == before);
}

TEST_CASE("a part of a mesh has its labels, data, groups and mid-side nodes") {
  const Mesh rich{rich_arrays()};
  TetMesh mesh(rich);
  const Mesh part = extract(mesh, [&](TetHandle t) { return t.index() == 1; });
  CHECK(part.tet_count() == 1);
  CHECK(part.point_count() == 4);
  CHECK(part.triangle_count() == 1);
  CHECK(part.triangle_labels()[0] == 5);
  CHECK(part.edge_count() == 0);
  CHECK(std::get<std::vector<double>>(part.point_data()[0].values) ==
        std::vector<double>{2, 3, 4, 5});
  CHECK(std::get<std::vector<std::int32_t>>(part.tet_data()[0].values) ==
        std::vector<std::int32_t>{3, 4});
  REQUIRE(part.groups().size() == 2);
  CHECK(part.groups()[1].members == std::vector<std::uint32_t>{3});
  CHECK(part.required_vertices().size() == 1);
  CHECK(part.points()[part.required_vertices()[0]] == rich.points()[2]);

  const MeshData curved = tetmend::test::second_order(contract::delaunay_ball(60, 1), 0.1);
  TetMesh second(tetmend::MeshAccess::make(curved));
  CHECK(second.vertex_count() == contract::delaunay_ball(60, 1).points.size());
  const Mesh half = extract(second, [&](TetHandle t) { return second.points(t)[0].x() > 0; });
  CHECK(Mesh(MeshArrays(half.arrays())).tet_count() == half.tet_count());  // each edge has its node
  CHECK(half.tet_count() < second.tet_count());
}

TEST_CASE("other elements stay with a mesh, and a note says that a part has none") {
  const MeshData mixed = tetmend::test::tets_on(tetmend::test::Bed::wedges, 3, 1);
  const TetMesh mesh(tetmend::MeshAccess::make(mixed));
  const Mesh back = mesh.to_mesh();
  CHECK(tetmend::MeshAccess::data(back).other_elements == mixed.other_elements);
  const Mesh part = extract(mesh, [](TetHandle t) { return t.index() < 5; });
  REQUIRE(part.notes().size() == 1);
  CHECK(part.notes()[0] == "of a part of the mesh: 18 elements that are no tets not kept");
}

TEST_CASE("lengths are those of the file in a mesh of any size") {
  MeshData tiny = contract::delaunay_ball(60, 1);
  for (Point& p : tiny.points) p *= 0x1p-100;
  TetMesh mesh(tetmend::MeshAccess::make(tiny));
  for (const VertexHandle v : mesh.vertices()) CHECK(mesh.point(v) == tiny.points[v.index()]);
  const VertexHandle v = inner_vertex(mesh);
  const Point place = mesh.point(v) * 1.001;
  Transaction edit(mesh);
  REQUIRE(edit.move(v, place) == EditResult::made);
  CHECK(mesh.point(v) == place);
  const auto after = edit.after();
  CHECK(std::any_of(after.begin(), after.end(), [&](const std::array<Point, 4>& tet) {
    return std::find(tet.begin(), tet.end(), place) != tet.end();
  }));
}

TEST_CASE("coordinates are taken in and written out where a program has them") {
  const Mesh file = tetmend::MeshAccess::make(contract::delaunay_ball(60, 1));
  struct Node {
    double heat;
    double place[3];
  };
  std::vector<Node> nodes;
  for (const auto& p : file.points()) nodes.push_back({1, {p[0], p[1], p[2]}});
  TetMesh mesh(PointView(nodes[0].place, nodes.size(), 4), file.tets());
  const VertexHandle v = inner_vertex(mesh);
  CHECK(mesh.point(v).y() == file.points()[v.index()][1]);
  const Point place = mesh.point(v) + Point(1e-6, 0, 0);
  {
    Transaction edit(mesh);
    REQUIRE(edit.move(v, place) == EditResult::made);
    edit.keep();
  }
  mesh.write_points(nodes[0].place, 4);
  CHECK(nodes[v.index()].place[0] == place.x());
  CHECK(nodes[v.index()].heat == 1);
  const Mesh after = mesh.to_mesh();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    CHECK(nodes[i].place[2] == after.points()[i][2]);
  }
}

TEST_CASE("a program that was compiled with other headers is told both versions") {
  CHECK(message_of([] {
          check_layout({"0.0.9", sum_of_sizes()});
        }).find("with the headers of tetmend 0.0.9, and runs with libtetmend 0.1") !=
        std::string::npos);
  CHECK(message_of([] {
          check_layout({"0.1.7", sum_of_sizes() + 1});
        }).find("other sizes") != std::string::npos);
  CHECK(message_of([] { check_layout({"0.1.7", sum_of_sizes()}); }).empty());
}

}  // namespace tetmend::kernel
