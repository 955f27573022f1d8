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
    if (result.build.mirrored) {  // as promised where most tets are negative
      for (auto& tet : before.tets) std::swap(tet[2], tet[3]);
    }
    require_promises(before, mesh.arrays(), result.goal);
  } catch (const Error& error) {
    require_one_line(error.what());
  }
  return 0;
}
