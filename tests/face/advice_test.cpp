// SPDX-License-Identifier: MIT
// Boundary layers come out as they went in; a run says what is kept, and what holds the bad tets.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <tetmend/improve.h>

#include "kernel/grouped.h"
#include "tests/support/layered_mesh.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const std::string kNothing = "-- nothing";

MeshArrays to_arrays(const MeshData& data) {
  MeshArrays arrays;
  for (const Point& p : data.points) arrays.points.push_back({p.x(), p.y(), p.z()});
  for (const MeshData::Tet& tet : data.tets) {
    arrays.tets.push_back(tet.vertices);
    arrays.tet_labels.push_back(tet.label);
  }
  return arrays;
}

LayeredMesh layered_ball() {
  return make_layered(
      ball_wall(3),
      {.heights = growing_heights(6, 0.02, 1.4), .core = {0.6, 0.9, 0.9}, .jitter = 0.15});
}

/// 6^3 cells with slivers. Label 2 from the middle on.
MeshData two_labels() {
  const std::vector<double> unit = axis_of(std::vector<double>(6, 1));
  MeshData data = make_lattice(unit, unit, unit, 0.3);
  for (std::size_t t = 0; t < data.tets.size(); ++t) {
    data.tets[t].label = t < data.tets.size() / 2 ? 1 : 2;
  }
  return data;
}

/// Whichever way round its vertices are listed.
bool is_bad(const MeshData& data, const MeshData::Tet& tet) {
  const auto p = [&](std::size_t i) { return data.points[tet.vertices[i]]; };
  return static_cast<Quality>(std::abs(minimum_sine(p(0), p(1), p(2), p(3)))) < 0.5f;
}

/// Bad tets that touch the middle of two_labels(): they have a free-standing vertex there or a face.
std::size_t count_at_middle(const MeshData& data, Label label) {
  std::size_t count = 0;
  for (const MeshData::Tet& tet : data.tets) {
    if ((label != 0 && tet.label != label) || !is_bad(data, tet)) continue;
    std::size_t in_plane = 0;
    bool inside = false;
    for (const std::uint32_t v : tet.vertices) {
      const std::uint32_t x = v % 7;
      const std::uint32_t y = v / 7 % 7;
      if (v / 49 != 3) continue;
      ++in_plane;
      inside = inside || (x > 0 && x < 6 && y > 0 && y < 6);
    }
    count += inside || in_plane == 3 ? 1 : 0;
  }
  return count;
}

bool mentions(const std::vector<std::string>& notes, const std::string& text) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

/// So many tets a run offers to remove with a flat surface; 0: no such offer.
std::size_t offered(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (note.find("would go with --surface flat") == std::string::npos) continue;
    std::string digits = note.substr(0, note.find(" of the "));
    std::erase_if(digits, [](char c) { return c < '0' || c > '9'; });
    return std::stoul(digits);
  }
  return 0;
}

}  // namespace

TEST_CASE("boundary layers stay bit for bit while the rest improves, and are counted") {
  const LayeredMesh layered = layered_ball();
  const Mesh old(to_arrays(layered.data));
  for (const int threads : {1, 2}) {
    Mesh mesh = old;
    std::vector<std::string> said;
    const Result result = improve(
        mesh, {.schedule = "thorough", .threads = threads, .note = [&](std::string_view text) {
                 said.emplace_back(text);
               }});
    CHECK(result.layer_tets == layered.layer_tets);
    CHECK(result.layer_bad_tets > layered.layer_tets / 2);
    CHECK(result.protected_tets == 0);
    CHECK(result.before.n_bad > result.layer_bad_tets + 100);
    CHECK(result.after.n_bad < result.before.n_bad);
    for (std::size_t v = 0; v < layered.layer_points; ++v) {
      REQUIRE(result.vertex_map[v] != kGone);
      REQUIRE(mesh.points()[result.vertex_map[v]] == old.points()[v]);
    }
    for (std::size_t t = 0; t < layered.layer_tets; ++t) {
      REQUIRE(result.tet_map[t] != kGone);
      auto now = mesh.tets()[result.tet_map[t]];
      auto then = old.tets()[t];
      for (std::uint32_t& v : then) v = result.vertex_map[v];
      std::sort(now.begin(), now.end());
      std::sort(then.begin(), then.end());
      REQUIRE(now == then);
    }
    REQUIRE(!result.notes.empty());
    CHECK(result.notes[0] == grouped(layered.layer_tets) +
                                 " tets of boundary layers kept; --layers improve works on them "
                                 "too");
    CHECK(std::count(said.begin(), said.end(), result.notes[0]) == 1);
  }
}

TEST_CASE("boundary layers are worked on if so wanted") {
  const LayeredMesh layered = layered_ball();
  Mesh mesh(to_arrays(layered.data));
  const Result result = improve(mesh, {.layers = Layers::improve});
  CHECK(result.layer_tets == 0);
  CHECK(!mentions(result.notes, "boundary layers"));
  const auto end = result.tet_map.begin() + static_cast<std::ptrdiff_t>(layered.layer_tets);
  CHECK(std::count(result.tet_map.begin(), end, kGone) > 1000);
}

TEST_CASE("layers and regions are kept side by side, and counted one by one") {
  LayeredMesh layered = layered_ball();
  std::size_t chosen = 0;
  for (std::size_t t = 0; t < layered.data.tets.size(); ++t) {
    const bool is_chosen = t % layered.layer_tets < 300;  // of the layers, of the core
    layered.data.tets[t].label = is_chosen ? 3 : 0;
    chosen += is_chosen ? 1 : 0;
  }
  REQUIRE(chosen >= 600);
  Mesh mesh(to_arrays(layered.data));
  const Result result = improve(mesh, {.script = kNothing, .protect = {"label:3"}});
  CHECK(result.protected_tets == chosen);
  CHECK(result.layer_tets == layered.layer_tets);
}

TEST_CASE("named triangles inside that hold many bad tets are named as the cause") {
  MeshData data = two_labels();
  for (MeshData::Tet& tet : data.tets) tet.label = 0;
  const TetMesh plain(data);
  MeshArrays arrays = to_arrays(data);
  for (std::uint32_t i = 0; i < 4 * plain.tet_slots(); ++i) {
    const HalfFace face = HalfFace::from_code(i);
    if (plain.is_boundary(face) || plain.twin(face) < face) continue;
    const auto [a, b, c] = plain.vertices(face);
    arrays.triangles.push_back({a.index(), b.index(), c.index()});
  }
  Mesh mesh(arrays);
  const Result held = improve(mesh);
  CHECK(held.notes ==
        std::vector<std::string>{fmt::format(
            "{} named inner triangles hold {} bad tets; --ignore-interior would free them",
            grouped(arrays.triangles.size()), grouped(held.after.n_bad))});
  mesh = Mesh(arrays);
  const Result free = improve(mesh, {.ignore_interior = true});
  CHECK(free.after.n_bad < held.after.n_bad / 10);
  CHECK(!mentions(free.notes, "named"));

  arrays.triangles.resize(1);  // too few to speak of
  mesh = Mesh(arrays);
  CHECK(improve(mesh, {.script = kNothing}).notes.empty());
  arrays.triangles.clear();
  for (std::uint32_t v = 0; v < arrays.points.size(); ++v) arrays.required_vertices.push_back(v);
  mesh = Mesh(arrays);
  CHECK(
      mentions(improve(mesh, {.script = kNothing}).notes, "edges and vertices named inside hold "));
}

TEST_CASE("borders between labels that hold bad tets are named, and so are protected regions") {
  const MeshData data = two_labels();
  std::size_t bad = 0;
  std::size_t bad_of_1 = 0;
  for (const MeshData::Tet& tet : data.tets) {
    bad += is_bad(data, tet) ? 1 : 0;
    bad_of_1 += tet.label == 1 && is_bad(data, tet) ? 1 : 0;
  }
  const std::size_t touching = count_at_middle(data, 0);
  REQUIRE(10 * touching > bad);
  Mesh mesh(to_arrays(data));
  CHECK(improve(mesh, {.script = kNothing}).notes ==
        std::vector<std::string>{
            fmt::format("faces between labels hold {} of the {} bad tets left; one label would "
                        "free them",
                        grouped(touching), grouped(bad))});

  MeshArrays one_label = to_arrays(data);
  for (std::int32_t& label : one_label.tet_labels) label = 0;
  mesh = Mesh(one_label);
  const std::vector<std::string> notes =
      improve(mesh, {.script = kNothing, .protect = {"box:-1,-1,-1,7,7,3.5"}}).notes;
  REQUIRE(notes.size() == 1);
  CHECK(mentions(notes, "regions kept as they are hold "));
  CHECK(mentions(notes, " beside them; smaller regions would free these"));

  mesh = Mesh(to_arrays(data));
  CHECK(improve(mesh, {.script = kNothing, .protect = {"label:2"}}).notes ==
        std::vector<std::string>{
            fmt::format("faces between labels hold {} of the {} bad tets left; one label would "
                        "free them",
                        grouped(count_at_middle(data, 1)), grouped(bad_of_1))});
}

TEST_CASE("the surface is named where it has all vertices of the bad tets") {
  const std::vector<double> unit = axis_of(std::vector<double>(6, 1));
  Mesh mesh(to_arrays(make_lattice(unit, unit, axis_of({0.4}))));
  const Result result = improve(mesh, {.script = kNothing});
  CHECK(mentions(result.notes, fmt::format("the surface, which stays, has all vertices of {} bad "
                                           "tets",
                                           grouped(result.after.n_bad))));
  mesh = Mesh(to_arrays(make_lattice(unit, unit, axis_of({0.4}))));
  CHECK(mentions(improve(mesh, {.script = kNothing, .surface = "flat"}).notes,
                 "the surface, which moves no further, has all vertices of "));
}

TEST_CASE("a mesh that is stretched throughout gets a warning, layers that are kept do not") {
  const std::vector<double> unit = axis_of(std::vector<double>(6, 1));
  Mesh mesh(to_arrays(make_lattice(unit, unit, axis_of(std::vector<double>(6, 0.1)))));
  const std::string warning = "tets are flat and lie alike";
  CHECK(mentions(improve(mesh, {.script = kNothing}).notes, "warning: 100 % of the " + warning));
  const LayeredMesh layered = layered_ball();
  mesh = Mesh(to_arrays(layered.data));
  CHECK(!mentions(improve(mesh, {.script = kNothing}).notes, warning));
  mesh = Mesh(to_arrays(layered.data));
  CHECK(mentions(improve(mesh, {.script = kNothing, .layers = Layers::improve}).notes, warning));
}

TEST_CASE("a flat surface is offered for about as many bad tets as it removes") {
  const std::vector<double> cells = axis_of(std::vector<double>(14, 1));
  const MeshData flat_cells = make_lattice(cells, cells, axis_of({0.5, 0.5}));
  Mesh mesh(to_arrays(flat_cells));
  const Result fixed = improve(mesh, {.purpose = "angles"});
  const std::size_t offer = offered(fixed.notes);
  REQUIRE(fixed.after.n_bad > 50);
  CHECK(mentions(fixed.notes,
                 fmt::format(" of the {} bad tets left would go", grouped(fixed.after.n_bad))));
  mesh = Mesh(to_arrays(flat_cells));
  const Result flat = improve(mesh, {.purpose = "angles", .surface = "flat"});
  CHECK(offered(flat.notes) == 0);
  const std::size_t removed = fixed.after.n_bad - flat.after.n_bad;
  CHECK(3 * offer > 2 * removed);
  CHECK(2 * offer < 3 * removed);
}

TEST_CASE("a flat surface is not offered where vertices that stay hold the tets, nor to a script") {
  const std::vector<double> six = axis_of(std::vector<double>(6, 1));
  MeshArrays arrays = to_arrays(make_lattice(six, six, axis_of({0.5, 0.5})));
  Mesh mesh(arrays);
  CHECK(offered(improve(mesh, {.script = kNothing}).notes) == 0);
  for (std::uint32_t v = 0; v < arrays.points.size(); ++v) arrays.required_vertices.push_back(v);
  mesh = Mesh(arrays);
  CHECK(offered(improve(mesh).notes) == 0);
}
