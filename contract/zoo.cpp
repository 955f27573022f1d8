// SPDX-License-Identifier: MIT
// Builders of the zoo.
#include "contract/zoo.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "contract/delaunay.h"

namespace tetmend::contract {

namespace {

/// Adds the tet, its vertices in positive order.
void add_tet(MeshData& data, std::array<std::uint32_t, 4> v, Label label = 0) {
  const auto& p = data.points;
  if (volume6(p[v[0]], p[v[1]], p[v[2]], p[v[3]]) < 0) std::swap(v[2], v[3]);
  data.tets.push_back({v, label});
}

/// Vertices that lie on no boundary face.
std::vector<std::uint32_t> inner_vertices(const MeshData& data) {
  std::map<std::array<std::uint32_t, 3>, int> faces;
  for (const MeshData::Tet& tet : data.tets) {
    for (const auto& local : kFaceVertices) {
      std::array<std::uint32_t, 3> face{};
      for (std::size_t i = 0; i < 3; ++i) face[i] = tet.vertices[local[i]];
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  std::set<std::uint32_t> outer;
  for (const auto& [face, tets] : faces) {
    if (tets == 1) outer.insert(face.begin(), face.end());
  }
  std::vector<std::uint32_t> inner;
  for (std::uint32_t v = 0; v < data.points.size(); ++v) {
    if (!outer.contains(v)) inner.push_back(v);
  }
  return inner;
}

/// Adds an octahedron of radius 1 with its centre as a vertex; vertices at known places are
/// re-used.
void add_octahedron(MeshData& data, const Point& centre) {
  const auto vertex = [&](const Point& p) {
    const auto found = std::find(data.points.begin(), data.points.end(), p);
    if (found == data.points.end()) data.points.push_back(p);
    return static_cast<std::uint32_t>(std::find(data.points.begin(), data.points.end(), p) -
                                      data.points.begin());
  };
  const std::uint32_t middle = vertex(centre);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) {
        const std::uint32_t a = vertex(centre + Point(x, 0, 0));
        const std::uint32_t b = vertex(centre + Point(0, y, 0));
        const std::uint32_t c = vertex(centre + Point(0, 0, z));
        add_tet(data, {middle, a, b, c});
      }
    }
  }
}

}  // namespace

Point Random::in_ball(double radius) {
  for (;;) {
    const double x = real(-1, 1);
    const double y = real(-1, 1);
    const double z = real(-1, 1);
    if (x * x + y * y + z * z <= 1) return radius * Point(x, y, z);
  }
}

MeshData one_tet() {
  MeshData data;
  data.points = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  add_tet(data, {0, 1, 2, 3});
  return data;
}

//        3
//      / | \         Vertex 3 above, 4 below the triangle 0 1 2.
//     0--1--2
//      \ | /
//        4
MeshData two_tets() {
  MeshData data;
  data.points = {{1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}, {0, 0, 1}, {0.1, 0, -0.6}};
  add_tet(data, {0, 1, 2, 3});
  add_tet(data, {0, 1, 2, 4});
  return data;
}

//           b              a = vertex 0, b = vertex 1, ring = vertices 2 .. degree + 1.
//         / | \            Seen from b the ring runs counterclockwise.
//      p_0--|--p_1
//         \ | /
//           a
MeshData shell_mesh(const ShellShape& shape) {
  MeshData data;
  Random random(shape.seed);
  data.points = {{0, 0, -shape.height}, {0, 0, shape.height}};
  const unsigned m = shape.degree;
  for (unsigned i = 0; i < m; ++i) {
    const double angle = 2 * std::numbers::pi * i / m;
    Point p(std::cos(angle), shape.squash * std::sin(angle), 0);
    if (shape.jitter > 0) p += random.in_ball(shape.jitter);
    data.points.push_back(p);
  }
  const unsigned tets = shape.open ? m - 1 : m;
  for (unsigned i = 0; i < tets; ++i) data.tets.push_back({{0, 1, 2 + i, 2 + (i + 1) % m}, 0});
  return data;
}

//            b                Fan p0 p1 p2, p0 p2 p3, ... between a = vertex 0 and b = vertex 1:
//        / /   \ \            two tets for each triangle.
//      p0--p1--p2--p3
//        \ \   / /
//            a
MeshData sandwich(unsigned degree, double height) {
  MeshData data = shell_mesh({.degree = degree, .height = height});
  data.tets.clear();
  for (std::uint32_t i = 3; i + 1 < 2 + degree; ++i) {
    add_tet(data, {1, 2, i, i + 1});
    add_tet(data, {0, 2, i, i + 1});
  }
  return data;
}

MeshData constrained_face() {
  MeshData data = two_tets();
  data.triangles.push_back({{0, 1, 2}, 7});
  return data;
}

MeshData shell_with_constrained_face() {
  MeshData data = shell_mesh({.degree = 6, .height = 0.7});
  data.triangles.push_back({{0, 1, 4}, 3});
  return data;
}

MeshData shell_with_constrained_edge() {
  MeshData data = shell_mesh({.degree = 6, .height = 0.7});
  data.edges.push_back({{0, 1}, 4});
  return data;
}

MeshData two_regions() {
  MeshData data = kuhn_cube(2, 0, 0);
  // The one inner vertex stays in the plane z = 1/2 between the regions.
  data.points[13] += Point(0.1, -0.15, 0);
  for (MeshData::Tet& tet : data.tets) {
    double z = 0;
    for (const std::uint32_t v : tet.vertices) z += data.points[v].z() / 4;
    tet.label = z < 0.5 ? 1 : 2;
  }
  return data;
}

//            4               Seen from the side. The middle tet 0 1 2 3 has the diagonal 0-2 on its
//         /     \            upper and 1-3 on its lower side; 4 is joined to the two upper faces, 5
//      0           2         to the two lower ones.
//        1       3
//         \     /
//            5
MeshData middle_tet(double lift) {
  MeshData data;
  data.points = {{1, 0, 0.5}, {0, 1, -0.5}, {-1, 0, 0.5}, {0, -1, -0.5}, {0, 0, 1.5}, {0, 0, -1.5}};
  // The sense of each tet is that of a positive lift.
  add_tet(data, {0, 1, 2, 3});
  add_tet(data, {4, 0, 1, 2});
  add_tet(data, {4, 0, 2, 3});
  add_tet(data, {5, 0, 1, 3});
  add_tet(data, {5, 1, 2, 3});
  for (std::uint32_t v = 0; v < 4; ++v) data.points[v].z() = v % 2 == 0 ? lift : -lift;
  return data;
}

//     /\ /\         One vertex in common. A centre lies off the middle so that there is work to do.
//     \/ \/
MeshData touching_at_vertex() {
  MeshData data;
  add_octahedron(data, {0, 0, 0});
  add_octahedron(data, {2, 0, 0});
  data.points[0] = {0.3, 0.1, 0.2};
  return data;
}

MeshData touching_at_edge() {
  MeshData data;
  add_octahedron(data, {0, 0, 0});
  add_octahedron(data, {1, 1, 0});
  data.points[0] = {0.2, 0.1, 0.3};
  return data;
}

MeshData delaunay_ball(unsigned n, std::uint64_t seed) {
  MeshData data;
  Random random(seed);
  for (unsigned i = 0; i < n; ++i) data.points.push_back(random.in_ball(1));
  for (const auto& tet : delaunay(data.points)) data.tets.push_back({tet, 0});
  return data;
}

MeshData tangled_ball(unsigned n, std::uint64_t seed) {
  MeshData data = delaunay_ball(n, seed);
  const std::vector<std::uint32_t> inner = inner_vertices(data);
  const std::uint32_t v = inner.at(inner.size() / 2);
  const auto tet = std::find_if(data.tets.begin(), data.tets.end(), [v](const MeshData::Tet& t) {
    return std::find(t.vertices.begin(), t.vertices.end(), v) != t.vertices.end();
  });
  // Through the face opposite v: that tet turns over.
  Point face_centre = Point::Zero();
  for (const std::uint32_t w : tet->vertices) {
    if (w != v) face_centre += data.points[w] / 3;
  }
  data.points[v] += 1.5 * (face_centre - data.points[v]);
  return data;
}

MeshData kuhn_cube(unsigned cells, double jitter, std::uint64_t seed) {
  MeshData data;
  Random random(seed);
  const unsigned side = cells + 1;
  const double width = 1.0 / cells;
  for (unsigned z = 0; z < side; ++z) {
    for (unsigned y = 0; y < side; ++y) {
      for (unsigned x = 0; x < side; ++x) {
        const bool inner = x % cells != 0 && y % cells != 0 && z % cells != 0;
        Point p(x * width, y * width, z * width);
        if (inner && jitter > 0) p += random.in_ball(jitter * width);
        data.points.push_back(p);
      }
    }
  }
  // Each order of the axes is a path along the cell's edges from its lowest to its highest corner.
  for (unsigned cell = 0; cell < cells * cells * cells; ++cell) {
    std::array<unsigned, 3> axes = {0, 1, 2};
    do {
      std::array<unsigned, 3> corner = {cell % cells, cell / cells % cells, cell / (cells * cells)};
      std::array<std::uint32_t, 4> v{};
      for (unsigned i = 0; i < 4; ++i) {
        v[i] = corner[0] + side * (corner[1] + side * corner[2]);
        if (i < 3) ++corner[axes[i]];
      }
      // Sense by the permutation, not by the volume, which the jitter may have turned over.
      const bool even = (axes[1] + 3 - axes[0]) % 3 == 1;
      if (!even) std::swap(v[2], v[3]);
      data.tets.push_back({v, 0});
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return data;
}

MeshData constrained_ball(std::uint64_t seed) {
  MeshData data = delaunay_ball(70, seed);
  for (std::size_t i = 0; i < data.tets.size(); ++i) {
    double x = 0;
    for (const std::uint32_t v : data.tets[i].vertices) x += data.points[v].x();
    data.tets[i].label = x < 0 ? 1 : 2;
    const auto& v = data.tets[i].vertices;
    if (i % 29 == 3) data.triangles.push_back({{v[0], v[1], v[2]}, 5});
    if (i % 17 == 5) data.edges.push_back({{v[1], v[3]}, 6});
    if (i % 41 == 7) data.required_vertices.push_back(v[2]);
  }
  return data;
}

std::vector<NamedMesh> zoo() {
  std::vector<NamedMesh> all;
  const auto add = [&](std::string name, MeshData data) {
    all.push_back({std::move(name), std::move(data)});
  };
  add("one_tet", one_tet());
  add("two_tets", two_tets());
  add("constrained_face", constrained_face());
  add("middle_tet", middle_tet(0.2));
  add("sliver", middle_tet(0.02));
  add("flat_tet", middle_tet(0));
  add("inverted_tet", middle_tet(-0.1));
  for (unsigned m = 3; m <= 12; ++m) {
    const std::string degree = std::to_string(m);
    add("shell_" + degree, shell_mesh({.degree = m}));
    add("low_shell_" + degree, shell_mesh({.degree = m, .height = 0.25}));
    add("irregular_shell_" + degree,
        shell_mesh({.degree = m, .height = 0.6, .squash = 0.6, .jitter = 0.15, .seed = m}));
    add("sandwich_" + degree, sandwich(m, 0.4));
    add("high_sandwich_" + degree, sandwich(m, 1.5));
  }
  add("open_shell_4", shell_mesh({.degree = 4, .open = true}));
  add("open_shell_7", shell_mesh({.degree = 7, .open = true}));
  add("shell_with_constrained_face", shell_with_constrained_face());
  add("shell_with_constrained_edge", shell_with_constrained_edge());
  add("touching_at_vertex", touching_at_vertex());
  add("touching_at_edge", touching_at_edge());
  add("two_regions", two_regions());
  add("cube_2", kuhn_cube(2, 0.4, 1));
  add("cube_3", kuhn_cube(3, 0.35, 2));
  add("cube_5", kuhn_cube(5, 0.3, 3));
  add("folded_cube_4", kuhn_cube(4, 0.8, 4));
  add("ball_20", delaunay_ball(20, 1));
  add("ball_60", delaunay_ball(60, 2));
  add("ball_200", delaunay_ball(200, 3));
  add("tangled_ball_60", tangled_ball(60, 4));
  return all;
}

MeshData zoo_data(const std::string& name) {
  for (NamedMesh& mesh : zoo()) {
    if (mesh.name == name) return std::move(mesh.data);
  }
  throw Error("the zoo has no mesh '" + name + "'");
}

std::vector<TetHandle> live_tets(const TetMesh& mesh) {
  std::vector<TetHandle> live;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (!mesh.is_deleted(TetHandle(i))) live.push_back(TetHandle(i));
  }
  return live;
}

std::vector<VertexHandle> live_vertices(const TetMesh& mesh) {
  std::vector<VertexHandle> live;
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    if (!mesh.is_deleted(VertexHandle(i))) live.push_back(VertexHandle(i));
  }
  return live;
}

}  // namespace tetmend::contract
