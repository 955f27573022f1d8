// SPDX-License-Identifier: MIT
//   const_walks MESH
// Many threads call the const members of one mesh at the same time, and all of them see the same.
// The thread sanitizer looks on.
#include <array>
#include <cstdio>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

#include <tetmend/kernel.h>

using namespace tetmend::kernel;

namespace {

struct Properties {
  TetProperty<int> age;
  VertexProperty<double> heat;
};

std::size_t walk_vertices(const TetMesh& mesh, const Properties& of) {
  std::size_t sum = 0;
  for (const VertexHandle v : mesh.vertices()) {
    sum += mesh.star(v).size() + mesh.link(v).size();
    for (const VertexHandle w : mesh.one_ring(v)) sum += of.heat[w] < mesh.point(w).x() ? 1 : 0;
    sum += mesh.is_boundary(v) || mesh.is_fixed(v) || mesh.is_locked(v) ? 1 : 0;
  }
  return sum + mesh.vertex_count() + mesh.point_view().size();
}

std::size_t walk_edges_and_faces(const TetMesh& mesh) {
  std::size_t sum = 0;
  for (const TetEdge e : mesh.edges()) {
    const Ring ring = mesh.ring(e);
    sum += ring.tets.size() + ring.vertices.size() + (mesh.is_boundary(e) ? 1 : 0);
    sum += mesh.find_edge(ring.a, ring.b) ? 1 : 0;
  }
  for (const HalfFace f : mesh.faces()) {
    const auto [a, b, c] = mesh.vertices(f);
    sum += mesh.find_face(a, b, c) && !mesh.is_constrained(f) ? mesh.twin(f).code() : 1;
  }
  for (const HalfFace f : mesh.boundary()) sum += mesh.is_boundary(f) ? 1 : 0;
  return sum;
}

std::size_t walk_tets(const TetMesh& mesh, const Properties& of) {
  std::size_t sum = 0;
  for (const TetHandle t : mesh.tets()) {
    const TetVertices& v = mesh.vertices(t);
    sum += mesh.find_tet(v[0], v[1], v[2], v[3]) ? mesh.neighbours(t).size() : 0;
    sum += mesh.quality(t) > 0 && mesh.points(t)[0].x() < 1e9 ? 1 : 0;
    sum += static_cast<std::size_t>(of.age[t] + mesh.label(t));
  }
  return sum;
}

/// All at once, and copies.
std::size_t look_at_all(const TetMesh& mesh) {
  const TetMesh copy(mesh);
  return mesh.one_rings().values.size() + mesh.stars().values.size() + mesh.check().size() +
         mesh.to_mesh().tet_count() + copy.tet_count() +
         extract(mesh, [](TetHandle t) { return t.index() % 2 == 0; }).tet_count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    TetMesh made(load(argv[1]));
    const Properties of{made.tet_property<int>("age", 3), made.vertex_property<double>("heat")};
    made.lock(*made.vertices().begin());
    const TetMesh& mesh = made;
    const auto walk = [&] {
      return walk_vertices(mesh, of) + walk_edges_and_faces(mesh) + walk_tets(mesh, of) +
             look_at_all(mesh);
    };
    const std::size_t expected = walk();
    std::array<std::size_t, 8> sums{};
    std::vector<std::thread> threads;
    for (std::size_t& sum : sums) threads.emplace_back([&sum, &walk] { sum = walk(); });
    for (std::thread& thread : threads) thread.join();
    for (const std::size_t sum : sums) {
      if (sum == expected) continue;
      std::fprintf(stderr, "a thread saw %zu, not %zu\n", sum, expected);
      return 1;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
