// SPDX-License-Identifier: MIT
// The whole improver on small meshes that nobody would make: points moved anywhere, labels, lost
// tets, named triangles. An Error of one line, or a run that keeps all promises.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tetmend/catalogue.h>
#include <tetmend/error.h>
#include <tetmend/improve.h>

#include "fuzz/judge.h"
#include "fuzz/target.h"
#include "kernel/tet_mesh.h"

using namespace tetmend;
using namespace tetmend::fuzz;

namespace {

Options options_from(Bytes& bytes) {
  static const std::vector<ScheduleInfo> names = schedules();
  Options options;
  options.schedule = names[bytes.below(static_cast<unsigned>(names.size()))].name;
  options.goal = Goal::symmetric(std::array{30.0, 20.0, 35.0, 5.0}[bytes.below(4)]);
  options.measure = bytes.below(2) == 0 ? "sine_and_length" : "sine";
  options.threads = 1 + static_cast<int>(bytes.below(2));
  options.keep_size = bytes.below(8) == 0;
  options.ignore_interior = bytes.below(8) == 0;
  options.straighten = bytes.below(8) == 0;
  options.time_limit = 2;
  return options;
}

/// One change of the mesh for each few bytes.
void change(MeshArrays& mesh, Bytes& bytes) {
  const auto vertex = [&] { return bytes.below(static_cast<unsigned>(mesh.points.size())); };
  const auto tet = [&] { return bytes.below(static_cast<unsigned>(mesh.tets.size())); };
  switch (bytes.below(6)) {
    case 0:  // a little
      mesh.points[vertex()][bytes.below(3)] += bytes.take<std::int8_t>() / 100.0;
      break;
    case 1:  // anywhere
      mesh.points[vertex()][bytes.below(3)] = bytes.take<double>();
      break;
    case 2:  // flat or nearly so
      mesh.points[vertex()][bytes.below(3)] = std::ldexp(1.0, bytes.take<std::int8_t>() / 2);
      break;
    case 3:
      mesh.tet_labels[tet()] = static_cast<std::int32_t>(bytes.below(3));
      break;
    case 4:
      if (mesh.tets.size() > 1) {
        const unsigned gone = tet();
        mesh.tets.erase(mesh.tets.begin() + gone);
        mesh.tet_labels.erase(mesh.tet_labels.begin() + gone);
      }
      break;
    default: {
      const auto& corners = mesh.tets[tet()];
      const unsigned away = bytes.below(4);
      mesh.triangles.push_back(
          {corners[(away + 1) % 4], corners[(away + 2) % 4], corners[(away + 3) % 4]});
      mesh.triangle_labels.push_back(static_cast<std::int32_t>(bytes.below(3)));
    }
  }
}

/// Lists the vertices of all tets as they are listed before any work.
void put_right(MeshArrays& mesh) {
  MeshData data;
  for (const auto& p : mesh.points) data.points.emplace_back(p[0], p[1], p[2]);
  for (const auto& tet : mesh.tets) data.tets.push_back({tet, 0});
  const TetMesh built = TetMesh::build(data, {.sorted = false});
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    for (unsigned k = 0; k < 4; ++k) {
      mesh.tets[t][k] = built.origin(built.vertices(TetHandle(t))[k]);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, std::min<std::size_t>(size, 512));
  const Options options = options_from(bytes);
  MeshArrays before = small_mesh();
  while (!bytes.empty()) change(before, bytes);
  try {
    Mesh mesh(before);
    const Result result = improve(mesh, options);
    require(result.worse().empty(), "no figure is worse");
    if (result.build.mirrored || result.build.reordered_tets > 0) put_right(before);
    require_promises(before, mesh.arrays(), result.goal);
  } catch (const Error& error) {
    require_one_line(error.what());
  }
  return 0;
}
