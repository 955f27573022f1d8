// SPDX-License-Identifier: MIT
// <tetmend/tetmend.h>: arrays in and out, errors with their place, and the same work as in C++.
#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <tetmend/improve.h>
#include <tetmend/tetmend.h>

#include "tests/face/meshes.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend::test;

namespace {

struct Destroyer {
  void operator()(tetmend_mesh* mesh) const { tetmend_destroy(mesh); }
};
using Handle = std::unique_ptr<tetmend_mesh, Destroyer>;

Handle create() {
  return Handle(tetmend_create());
}

const std::vector<double> kPoints = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
const std::vector<std::int32_t> kTets = {0, 1, 2, 3, 1, 2, 3, 4};

/// Two tets that share a face.
Handle two_tets_in(int first_number = 0) {
  Handle mesh = create();
  REQUIRE(tetmend_set_first_number(mesh.get(), first_number) == TETMEND_OK);
  REQUIRE(tetmend_set_points(mesh.get(), kPoints.data(), 5) == TETMEND_OK);
  std::vector<std::int32_t> tets = kTets;
  for (std::int32_t& v : tets) v += first_number;
  const std::vector<std::int32_t> labels = {7, 8};
  REQUIRE(tetmend_set_tets(mesh.get(), tets.data(), 2, labels.data()) == TETMEND_OK);
  return mesh;
}

std::string error_of(const Handle& mesh) {
  return tetmend_last_error(mesh.get());
}

std::vector<double> points_of(const Handle& mesh) {
  std::vector<double> xyz(3 * tetmend_count(mesh.get(), TETMEND_POINTS));
  CHECK(tetmend_get_points(mesh.get(), xyz.data(), xyz.size() / 3) == TETMEND_OK);
  return xyz;
}

std::vector<std::int32_t> tets_of(const Handle& mesh) {
  std::vector<std::int32_t> tets(4 * tetmend_count(mesh.get(), TETMEND_TETS));
  CHECK(tetmend_get_tets(mesh.get(), tets.data(), nullptr, tets.size() / 4) == TETMEND_OK);
  return tets;
}

std::string saved(const Handle& mesh, const TempFolder& folder) {
  const auto file = folder / "of_c.meshb";
  CHECK(tetmend_save(mesh.get(), file.c_str()) == TETMEND_OK);
  return read_text(file);
}

std::string saved(const tetmend::Mesh& mesh, const TempFolder& folder) {
  const auto file = folder / "of_cpp.meshb";
  save(file, mesh);
  return read_text(file);
}

}  // namespace

TEST_CASE("in C: a wrapper's own complaint is the last error until the next call") {
  const Handle mesh = two_tets_in();
  CHECK(tetmend_refuse(mesh.get(), "xyz has shape (4, 3)") == TETMEND_WRONG_CALL);
  CHECK(error_of(mesh) == "xyz has shape (4, 3)");
  CHECK(tetmend_check_options(mesh.get()) == TETMEND_OK);
  CHECK(error_of(mesh) == "");
  CHECK(tetmend_refuse(mesh.get(), nullptr) == TETMEND_WRONG_CALL);
  CHECK(error_of(mesh) == "message is null");
  CHECK(tetmend_refuse(nullptr, "no handle") == TETMEND_WRONG_CALL);
}

TEST_CASE("in C: arrays come out of a handle as they went in, numbered from 0 or from 1") {
  for (const int first : {0, 1}) {
    const Handle mesh = two_tets_in(first);
    const std::int32_t a = first;
    const std::vector<std::int32_t> triangles = {a + 1, a + 2, a + 3};
    const std::vector<std::int32_t> edges = {a, a + 1};
    const std::vector<std::int32_t> point_labels = {0, 0, 3, 0, 0};
    const std::int32_t label = -5;
    CHECK(tetmend_set_triangles(mesh.get(), triangles.data(), 1, &label) == TETMEND_OK);
    CHECK(tetmend_set_edges(mesh.get(), edges.data(), 1, nullptr) == TETMEND_OK);
    CHECK(tetmend_set_point_labels(mesh.get(), point_labels.data()) == TETMEND_OK);
    CHECK(tetmend_set_required_vertices(mesh.get(), edges.data(), 1) == TETMEND_OK);
    CHECK(tetmend_count(mesh.get(), TETMEND_POINTS) == 5);
    CHECK(tetmend_count(mesh.get(), TETMEND_TRIANGLES) == 1);
    CHECK(points_of(mesh) == kPoints);
    std::vector<std::int32_t> tets(8), labels(2), out(5);
    CHECK(tetmend_get_tets(mesh.get(), tets.data(), labels.data(), 2) == TETMEND_OK);
    for (std::size_t i = 0; i < 8; ++i) CHECK(tets[i] == kTets[i] + first);
    CHECK(labels == std::vector<std::int32_t>{7, 8});
    CHECK(tetmend_get_triangles(mesh.get(), tets.data(), labels.data(), 1) == TETMEND_OK);
    CHECK(std::equal(triangles.begin(), triangles.end(), tets.begin()));
    CHECK(labels[0] == -5);
    CHECK(tetmend_get_edges(mesh.get(), tets.data(), labels.data(), 1) == TETMEND_OK);
    CHECK(std::equal(edges.begin(), edges.end(), tets.begin()));
    CHECK(labels[0] == 0);
    CHECK(tetmend_get_point_labels(mesh.get(), out.data(), 5) == TETMEND_OK);
    CHECK(out == point_labels);
    CHECK(error_of(mesh).empty());
  }
}

TEST_CASE("in C: what is wrong with an array is told with its place, and the old one stays") {
  for (const int first : {0, 1}) {
    const Handle mesh = two_tets_in(first);
    const std::string from = ", counted from " + std::to_string(first);
    const auto tets_with = [&](std::size_t i, std::int32_t number) {
      std::vector<std::int32_t> tets = kTets;
      for (std::int32_t& v : tets) v += first;
      tets[i] = number;
      return tetmend_set_tets(mesh.get(), tets.data(), 2, nullptr);
    };
    for (const std::int32_t number :
         {first - 1, first + 5, std::numeric_limits<std::int32_t>::min(),
          std::numeric_limits<std::int32_t>::max()}) {
      CHECK(tets_with(6, number) == TETMEND_WRONG_INPUT);
      CHECK(error_of(mesh) == "tets[" + std::to_string(1 + first) + "]: (" +
                                  std::to_string(1 + first) + ", " + std::to_string(2 + first) +
                                  ", " + std::to_string(number) + ", " + std::to_string(4 + first) +
                                  "): no point " + std::to_string(number) + ", there are 5" + from);
    }
    CHECK(tets_with(0, first + 3) == TETMEND_WRONG_INPUT);
    CHECK(error_of(mesh).find("the same vertex twice" + from) != std::string::npos);
    std::vector<double> xyz = kPoints;
    xyz[10] = std::nan("");
    CHECK(tetmend_set_points(mesh.get(), xyz.data(), 5) == TETMEND_WRONG_INPUT);
    CHECK(error_of(mesh) == "points[" + std::to_string(3 + first) + "]: not finite" + from);
    const std::int32_t vertex = first + 5;
    CHECK(tetmend_set_required_vertices(mesh.get(), &vertex, 1) == TETMEND_WRONG_INPUT);
    CHECK(error_of(mesh).starts_with("required_vertices["));
    CHECK(points_of(mesh) == kPoints);
    CHECK(tets_of(mesh)[6] == 3 + first);
  }
}

TEST_CASE("in C: a wrong call is told, and does nothing") {
  CHECK(tetmend_improve(nullptr) == TETMEND_WRONG_CALL);
  CHECK(tetmend_set(nullptr, "goal", "30") == TETMEND_WRONG_CALL);
  CHECK(tetmend_count(nullptr, TETMEND_POINTS) == 0);
  CHECK(tetmend_note(nullptr, 0) == nullptr);
  CHECK(tetmend_worse_count(nullptr) == 0);
  CHECK(tetmend_worse(nullptr, 0) == nullptr);
  CHECK(std::string(tetmend_last_error(nullptr)) == "the handle is null");
  tetmend_destroy(nullptr);
  const Handle mesh = two_tets_in();
  std::vector<double> xyz(15);
  CHECK(tetmend_get_points(mesh.get(), xyz.data(), 4) == TETMEND_WRONG_CALL);
  CHECK(error_of(mesh) == "room for 4, but there are 5");
  CHECK(tetmend_get_points(mesh.get(), nullptr, 5) == TETMEND_WRONG_CALL);
  CHECK(tetmend_set_points(mesh.get(), nullptr, 5) == TETMEND_WRONG_CALL);
  CHECK(error_of(mesh) == "xyz is null");
  CHECK(tetmend_set_tets(mesh.get(), nullptr, 1, nullptr) == TETMEND_WRONG_CALL);
  CHECK(tetmend_set_first_number(mesh.get(), 2) == TETMEND_WRONG_CALL);
  CHECK(tetmend_load(mesh.get(), nullptr) == TETMEND_WRONG_CALL);
  CHECK(tetmend_set(mesh.get(), "goal", nullptr) == TETMEND_WRONG_CALL);
  std::int32_t map[5];
  CHECK(tetmend_get_vertex_map(mesh.get(), map, 5) == TETMEND_WRONG_CALL);
  CHECK(error_of(mesh) == "this mesh has not been improved");
  CHECK(tetmend_count(mesh.get(), TETMEND_TETS) == 2);
  CHECK(tetmend_ruler_name(-1) == nullptr);
  CHECK(std::string(tetmend_ruler_name(0)) == "mean_ratio");
}

TEST_CASE("in C: a mesh of broken topology, a missing file and an empty mesh are errors") {
  const Handle mesh = two_tets_in();
  CHECK(tetmend_load(mesh.get(), "missing.mesh") == TETMEND_WRONG_INPUT);
  CHECK(error_of(mesh).starts_with("missing.mesh"));
  CHECK(tetmend_count(mesh.get(), TETMEND_TETS) == 2);
  const std::vector<std::int32_t> same = {0, 1, 2, 3, 0, 1, 2, 3};
  CHECK(tetmend_set_tets(mesh.get(), same.data(), 2, nullptr) == TETMEND_OK);
  CHECK(tetmend_improve(mesh.get()) == TETMEND_WRONG_INPUT);
  CHECK(error_of(mesh).find("counted from 0") != std::string::npos);
  CHECK(tets_of(mesh) == same);
  const Handle empty = create();
  CHECK(tetmend_improve(empty.get()) == TETMEND_WRONG_INPUT);
  CHECK(error_of(empty) == "the mesh has no tetrahedra");
  const TempFolder folder;
  CHECK(tetmend_save(empty.get(), (folder / "a.mesh").c_str()) == TETMEND_WRONG_CALL);
  CHECK(error_of(empty).starts_with("the mesh is empty"));
  CHECK(!std::filesystem::exists(folder / "a.mesh"));
  CHECK(tetmend_load(empty.get(), asset("sheet.mesh").c_str()) == TETMEND_OK);
  CHECK(tetmend_set_tets(empty.get(), kTets.data(), 2, nullptr) == TETMEND_WRONG_CALL);
  CHECK(error_of(empty).starts_with("the mesh is from a file"));
}

TEST_CASE("in C: data of every type go in, come out, and come over to the improved mesh") {
  const Handle mesh = two_tets_in();
  const std::vector<std::int64_t> order = {1LL << 40, -1};
  const std::vector<float> pairs = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const std::vector<std::int32_t> marks = {5, 6, 7, 8, 9};
  CHECK(tetmend_set_data(mesh.get(), TETMEND_TETS, "order", TETMEND_INT64, 1, order.data()) ==
        TETMEND_OK);
  CHECK(tetmend_set_data(mesh.get(), TETMEND_POINTS, "marks", TETMEND_INT32, 1, marks.data()) ==
        TETMEND_OK);
  for (int twice = 0; twice < 2; ++twice) {
    CHECK(tetmend_set_data(mesh.get(), TETMEND_POINTS, "pairs", TETMEND_FLOAT, 2, pairs.data()) ==
          TETMEND_OK);
  }
  CHECK(tetmend_improve(mesh.get()) == TETMEND_OK);
  CHECK(tetmend_data_count(mesh.get(), TETMEND_POINTS) == 2);
  const char* name = nullptr;
  tetmend_type type = TETMEND_DOUBLE;
  size_t components = 0;
  CHECK(tetmend_data_info(mesh.get(), TETMEND_POINTS, 1, &name, &type, &components) == TETMEND_OK);
  CHECK(std::string(name) == "pairs");
  CHECK(type == TETMEND_FLOAT);
  CHECK(components == 2);
  CHECK(tetmend_data_info(mesh.get(), TETMEND_POINTS, 2, &name, &type, &components) ==
        TETMEND_WRONG_CALL);
  std::vector<float> out(10);
  CHECK(tetmend_get_data(mesh.get(), TETMEND_POINTS, "pairs", TETMEND_FLOAT, out.data(), 10) ==
        TETMEND_OK);
  CHECK(out == pairs);
  CHECK(tetmend_get_data(mesh.get(), TETMEND_POINTS, "pairs", TETMEND_DOUBLE, out.data(), 10) ==
        TETMEND_WRONG_CALL);
  CHECK(tetmend_get_data(mesh.get(), TETMEND_POINTS, "pairs", TETMEND_FLOAT, out.data(), 9) ==
        TETMEND_WRONG_CALL);
  CHECK(tetmend_get_data(mesh.get(), TETMEND_TETS, "pairs", TETMEND_FLOAT, out.data(), 10) ==
        TETMEND_WRONG_CALL);
  CHECK(error_of(mesh) == "tets have no data 'pairs'");
  std::vector<std::int64_t> order_out(2);
  CHECK(tetmend_get_data(mesh.get(), TETMEND_TETS, "order", TETMEND_INT64, order_out.data(), 2) ==
        TETMEND_OK);
  CHECK(order_out == order);
}

TEST_CASE("in C: groups go in, come out, and come over to the improved mesh") {
  for (const std::int32_t first : {0, 1}) {
    const Handle mesh = two_tets_in(first);
    const std::vector<std::int32_t> upper = {first + 1};
    const std::vector<std::int32_t> ends = {first + 4, first};
    CHECK(tetmend_set_group(mesh.get(), TETMEND_TETS, 3, "upper", upper.data(), 1) == TETMEND_OK);
    for (int twice = 0; twice < 2; ++twice) {
      CHECK(tetmend_set_group(mesh.get(), TETMEND_POINTS, 0, "ends", ends.data(), 2) == TETMEND_OK);
    }
    CHECK(tetmend_set_group(mesh.get(), TETMEND_TETS, 7, "lower", nullptr, 0) == TETMEND_OK);
    CHECK(tetmend_group_count(mesh.get()) == 3);
    CHECK(tetmend_improve(mesh.get()) == TETMEND_OK);
    REQUIRE(tetmend_group_count(mesh.get()) == 3);
    tetmend_place place = TETMEND_EDGES;
    std::int32_t number = -1;
    const char* name = nullptr;
    size_t count = 0;
    CHECK(tetmend_group_info(mesh.get(), 1, &place, &number, &name, &count) == TETMEND_OK);
    CHECK(place == TETMEND_POINTS);
    CHECK(number == 0);
    CHECK(std::string(name) == "ends");
    REQUIRE(count == 2);
    std::vector<std::int32_t> members(2);
    CHECK(tetmend_get_group(mesh.get(), 1, members.data(), 2) == TETMEND_OK);
    std::sort(members.begin(), members.end());
    CHECK(members == std::vector<std::int32_t>{first, first + 4});
    CHECK(tetmend_get_group(mesh.get(), 1, members.data(), 1) == TETMEND_WRONG_CALL);
    CHECK(error_of(mesh) == "room for 1, but there are 2");
    std::vector<std::int32_t> labels(2), tets(8);
    CHECK(tetmend_get_tets(mesh.get(), tets.data(), labels.data(), 2) == TETMEND_OK);
    CHECK(tetmend_get_group(mesh.get(), 0, members.data(), 2) == TETMEND_OK);
    CHECK(labels[static_cast<std::size_t>(members[0] - first)] == 8);
    CHECK(tetmend_get_group(mesh.get(), 2, members.data(), 2) == TETMEND_OK);
    CHECK(labels[static_cast<std::size_t>(members[0] - first)] == 7);
    CHECK(tetmend_group_info(mesh.get(), 2, nullptr, nullptr, nullptr, &count) == TETMEND_OK);
    CHECK(count == 1);
  }
}

TEST_CASE(
    "in C: what is wrong with a group is told with its place, and groups go with their tets") {
  const Handle mesh = two_tets_in();
  const std::vector<std::int32_t> tets = {1, 2, 1};
  const std::int32_t point = 5;
  const auto set = [&](std::int32_t number, const char* name, std::size_t from, std::size_t n) {
    return tetmend_set_group(mesh.get(), TETMEND_TETS, number, name, tets.data() + from, n);
  };
  CHECK(set(1, "one", 0, 1) == TETMEND_OK);
  CHECK(set(1, "two", 0, 1) == TETMEND_WRONG_INPUT);
  CHECK(error_of(mesh) == "group 'two': number 1 is that of group 'one'");
  CHECK(set(2, "two", 0, 2) == TETMEND_WRONG_INPUT);
  CHECK(error_of(mesh) == "members[1]: no 2 of the tets, there are 2, counted from 0");
  const std::vector<std::int32_t> same = {0, 0};
  CHECK(tetmend_set_group(mesh.get(), TETMEND_TETS, 2, "two", same.data(), 2) ==
        TETMEND_WRONG_INPUT);
  CHECK(error_of(mesh) == "members[1]: 0 twice, counted from 0");
  CHECK(tetmend_set_group(mesh.get(), TETMEND_POINTS, 2, "p", &point, 1) == TETMEND_WRONG_INPUT);
  CHECK(tetmend_set_group(mesh.get(), TETMEND_POINTS, 2, nullptr, &point, 1) == TETMEND_WRONG_CALL);
  CHECK(tetmend_set_group(mesh.get(), TETMEND_POINTS, 2, "p", nullptr, 1) == TETMEND_WRONG_CALL);
  // So many cannot be: none of them is looked at.
  for (const std::size_t n : {std::size_t{3}, std::size_t{1} << 31, SIZE_MAX}) {
    CHECK(tetmend_set_group(mesh.get(), TETMEND_TETS, 2, "two", same.data(), n) ==
          TETMEND_WRONG_CALL);
    CHECK(error_of(mesh) == std::to_string(n) + " members of the tets, but there are 2");
  }
  CHECK(tetmend_set_required_vertices(mesh.get(), &point, SIZE_MAX) == TETMEND_WRONG_CALL);
  CHECK(error_of(mesh) == "required vertices: more than 2^31 - 1");
  CHECK(tetmend_set_points(mesh.get(), kPoints.data(), SIZE_MAX) == TETMEND_WRONG_CALL);
  CHECK(tetmend_set_tets(mesh.get(), kTets.data(), SIZE_MAX, nullptr) == TETMEND_WRONG_CALL);
  CHECK(tetmend_group_info(mesh.get(), 1, nullptr, nullptr, nullptr, nullptr) ==
        TETMEND_WRONG_CALL);
  CHECK(error_of(mesh) == "no group 1, there is 1, counted from 0");
  CHECK(tetmend_set_tets(mesh.get(), kTets.data(), 1, nullptr) == TETMEND_OK);
  CHECK(tetmend_group_count(mesh.get()) == 0);
  CHECK(tetmend_group_count(nullptr) == 0);
  CHECK(tetmend_get_group(nullptr, 0, nullptr, 0) == TETMEND_WRONG_CALL);
}

TEST_CASE("in C: improving is that of C++: bytes, figures, maps and notes") {
  const TempFolder folder;
  const std::string file = asset("two_materials.mesh");
  tetmend::Mesh expected = tetmend::load(file);
  const tetmend::Result result =
      tetmend::improve(expected, {.schedule = "conservative", .threads = 2, .limit = true});
  for (const int first : {0, 1}) {
    const Handle mesh = create();
    CHECK(tetmend_set_first_number(mesh.get(), first) == TETMEND_OK);
    CHECK(tetmend_set(mesh.get(), "schedule", "conservative") == TETMEND_OK);
    CHECK(tetmend_set(mesh.get(), "threads", "2") == TETMEND_OK);
    CHECK(tetmend_set(mesh.get(), "limit", "true") == TETMEND_OK);
    CHECK(tetmend_load(mesh.get(), file.c_str()) == TETMEND_OK);
    CHECK(tetmend_improve(mesh.get()) == TETMEND_OK);
    tetmend_statistics before, after;
    CHECK(tetmend_get_statistics(mesh.get(), &before, &after) == TETMEND_OK);
    CHECK(before.tets == result.before.tets);
    CHECK(before.theta_min == result.before.theta_min);
    CHECK(after.theta_max == result.after.theta_max);
    CHECK(after.n_bad == result.after.n_bad);
    CHECK(after.vertices == expected.point_count());
    CHECK(after.rulers[0].worst == (*result.rulers_after)[tetmend::Ruler::mean_ratio].worst);
    CHECK(after.rulers[10].worst == (*result.rulers_after)[tetmend::Ruler::step].worst);
    CHECK(after.cg_steps == result.rulers_after->cg_steps);
    CHECK(after.work == result.rulers_after->work);
    CHECK(std::accumulate(after.histogram, after.histogram + TETMEND_BINS, std::size_t{0}) ==
          6 * after.tets);
    tetmend_result outcome;
    CHECK(tetmend_get_result(mesh.get(), &outcome) == TETMEND_OK);
    CHECK(outcome.ending == TETMEND_FINISHED);
    CHECK(outcome.surface_fingerprint == result.surface_fingerprint);
    CHECK(outcome.passes == result.passes.size());
    CHECK(outcome.touched_tets == result.touched_tets);
    REQUIRE(tetmend_note_count(mesh.get()) == result.notes.size());
    for (std::size_t i = 0; i < result.notes.size(); ++i) {
      CHECK(tetmend_note(mesh.get(), i) == result.notes[i]);
    }
    const std::vector<std::string> worse = result.worse_than_before();
    REQUIRE(tetmend_worse_count(mesh.get()) == worse.size());
    for (std::size_t i = 0; i < worse.size(); ++i) CHECK(tetmend_worse(mesh.get(), i) == worse[i]);
    CHECK(tetmend_worse(mesh.get(), worse.size()) == nullptr);
    std::vector<std::int32_t> map(before.vertices), tet_map(before.tets);
    CHECK(tetmend_get_vertex_map(mesh.get(), map.data(), map.size() - 1) == TETMEND_WRONG_CALL);
    CHECK(tetmend_get_vertex_map(mesh.get(), map.data(), map.size()) == TETMEND_OK);
    CHECK(tetmend_get_tet_map(mesh.get(), tet_map.data(), tet_map.size()) == TETMEND_OK);
    const auto agrees = [first](const auto& of_c, const auto& of_cpp) {
      return std::equal(of_c.begin(), of_c.end(), of_cpp.begin(), of_cpp.end(),
                        [first](std::int32_t a, std::uint32_t b) {
                          return a ==
                                 (b == tetmend::kGone ? -1 : static_cast<std::int32_t>(b)) + first;
                        });
    };
    CHECK(agrees(map, result.vertex_map));
    CHECK(agrees(tet_map, result.tet_map));
    CHECK(saved(mesh, folder) == saved(expected, folder));
    tetmend_statistics measured;
    CHECK(tetmend_measure(mesh.get(), &measured) == TETMEND_OK);
    CHECK(measured.theta_min == after.theta_min);
  }
}

TEST_CASE("in C: measuring tells where points touch without being joined") {
  const Handle mesh = create();
  const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, -1};
  const std::int32_t tets[] = {0, 1, 2, 3, 4, 5, 6, 7};
  CHECK(tetmend_set_points(mesh.get(), points, 8) == TETMEND_OK);
  CHECK(tetmend_set_tets(mesh.get(), tets, 2, nullptr) == TETMEND_OK);
  tetmend_statistics measured;
  CHECK(tetmend_measure(mesh.get(), &measured) == TETMEND_OK);
  REQUIRE(tetmend_note_count(mesh.get()) == 1);
  CHECK(std::strstr(tetmend_note(mesh.get(), 0), "3 of 8 points lie on others") != nullptr);
}

TEST_CASE("in C: a progress function sees the run and stops it") {
  struct Seen {
    int calls = 0;
    bool improves = false;
  } seen;
  const Handle mesh = create();
  CHECK(tetmend_load(mesh.get(), asset("sheet.mesh").c_str()) == TETMEND_OK);
  const auto stop = [](void* user, const tetmend_progress* progress) {
    auto& all = *static_cast<Seen*>(user);
    ++all.calls;
    all.improves |= progress->stage == TETMEND_IMPROVING;
    return all.improves ? 1 : 0;
  };
  CHECK(tetmend_set_progress(mesh.get(), stop, &seen) == TETMEND_OK);
  CHECK(tetmend_improve(mesh.get()) == TETMEND_OK);
  tetmend_result result;
  CHECK(tetmend_get_result(mesh.get(), &result) == TETMEND_OK);
  CHECK(result.ending == TETMEND_STOPPED);
  CHECK(seen.improves);
  CHECK(tetmend_set_progress(mesh.get(), nullptr, nullptr) == TETMEND_OK);
  CHECK(tetmend_improve(mesh.get()) == TETMEND_OK);
  CHECK(tetmend_get_result(mesh.get(), &result) == TETMEND_OK);
  CHECK(result.ending == TETMEND_FINISHED);
}

TEST_CASE("in C: options are told apart, added to, and reset") {
  const Handle mesh = two_tets_in();
  CHECK(tetmend_set(mesh.get(), "plugin", "") == TETMEND_WRONG_OPTION);
  CHECK(error_of(mesh).find("no file is named") != std::string::npos);
  CHECK(tetmend_set(mesh.get(), "time_limit", "5") == TETMEND_WRONG_OPTION);
  CHECK(error_of(mesh).starts_with("there is no option 'time_limit': expected schedule, "));
  CHECK(error_of(mesh).ends_with(", label-array, variant"));
  CHECK(tetmend_set(mesh.get(), "time-limit", "five") == TETMEND_WRONG_OPTION);
  CHECK(error_of(mesh).starts_with("time-limit: 'five' is not a number"));
  CHECK(tetmend_set(mesh.get(), "protect", "label:7") == TETMEND_OK);
  CHECK(tetmend_set(mesh.get(), "protect", "label:8") == TETMEND_OK);
  CHECK(tetmend_check_options(mesh.get()) == TETMEND_OK);
  CHECK(tetmend_improve(mesh.get()) == TETMEND_OK);
  tetmend_result result;
  CHECK(tetmend_get_result(mesh.get(), &result) == TETMEND_OK);
  CHECK(result.protected_tets == 2);
  CHECK(tetmend_set(mesh.get(), "schedule", "varnish") == TETMEND_OK);
  CHECK(tetmend_check_options(mesh.get()) == TETMEND_WRONG_OPTION);
  CHECK(tetmend_reset_options(mesh.get()) == TETMEND_OK);
  CHECK(tetmend_improve(mesh.get()) == TETMEND_OK);
  CHECK(tetmend_get_result(mesh.get(), &result) == TETMEND_OK);
  CHECK(result.protected_tets == 0);
}

TEST_CASE("in C: what a file cannot hold is in the notes of saving") {
  const TempFolder folder;
  const Handle mesh = two_tets_in();
  const std::vector<double> values(5, 0.5);
  CHECK(tetmend_set_data(mesh.get(), TETMEND_POINTS, "heat", TETMEND_DOUBLE, 1, values.data()) ==
        TETMEND_OK);
  CHECK(tetmend_save(mesh.get(), (folder / "a.mesh").c_str()) == TETMEND_OK);
  REQUIRE(tetmend_note_count(mesh.get()) == 1);
  CHECK(std::strstr(tetmend_note(mesh.get(), 0), "heat") != nullptr);
  CHECK(tetmend_save(mesh.get(), (folder / "a.vtu").c_str()) == TETMEND_OK);
  CHECK(tetmend_note_count(mesh.get()) == 0);
  CHECK(tetmend_save(mesh.get(), (folder / "a.msh").c_str()) == TETMEND_OK);
  CHECK(tetmend_set(mesh.get(), "variant", "2.2 ASCII") == TETMEND_OK);
  CHECK(tetmend_save(mesh.get(), (folder / "b.msh").c_str()) == TETMEND_OK);
  CHECK(read_text(folder / "b.msh").starts_with("$MeshFormat\n2.2 0 8\n"));
}

TEST_CASE("in C: the arithmetic of the caller neither changes the result nor is changed") {
  const TempFolder folder;
  const std::string file = asset("sheet.mesh");
  const auto improved = [&] {
    const Handle mesh = create();
    CHECK(tetmend_load(mesh.get(), file.c_str()) == TETMEND_OK);
    CHECK(tetmend_improve(mesh.get()) == TETMEND_OK);
    return saved(mesh, folder);
  };
  const std::string expected = improved();
  std::feclearexcept(FE_ALL_EXCEPT);
  std::fesetround(FE_UPWARD);
  const std::string made = improved();
  const int rounding = std::fegetround();
  const int flags = std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_UNDERFLOW);
  std::fesetround(FE_TONEAREST);
  CHECK(made == expected);
  CHECK(rounding == FE_UPWARD);
  CHECK(flags == 0);
}

TEST_CASE("in C: two threads work on two handles at once") {
  const TempFolder folder;
  std::vector<std::string> bytes(2);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 2; ++i) {
    threads.emplace_back([&, i] {
      const Handle mesh = create();
      tetmend_set(mesh.get(), "threads", "2");
      tetmend_load(mesh.get(), asset("sheet.mesh").c_str());
      tetmend_improve(mesh.get());
      const auto file = folder / ("thread" + std::to_string(i) + ".meshb");
      tetmend_save(mesh.get(), file.c_str());
      bytes[i] = read_text(file);
    });
  }
  for (std::thread& thread : threads) thread.join();
  tetmend::Mesh expected = tetmend::load(asset("sheet.mesh"));
  tetmend::improve(expected);
  CHECK(bytes[0] == saved(expected, folder));
  CHECK(bytes[1] == bytes[0]);
}
