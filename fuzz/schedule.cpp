// SPDX-License-Identifier: MIT
// A script of a stranger: an Error of one line, or a run that keeps all promises. Either way it ends
// soon after its time limit.
#include <atomic>
#include <string>

#include <tetmend/error.h>
#include <tetmend/improve.h>

#include "fuzz/judge.h"
#include "fuzz/target.h"

using namespace tetmend;
using namespace tetmend::fuzz;

namespace {

MeshArrays bent_mesh() {
  MeshArrays arrays = small_mesh();
  arrays.points[13] = {0.3, 0.35, 1.6};  // the only vertex inside
  return arrays;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MeshArrays before = bent_mesh();
  Options options;
  options.script = std::string(reinterpret_cast<const char*>(data), size);
  if (options.script.empty()) return 0;
  options.time_limit = 0.2;
  options.note = [](std::string_view note) { require_one_line(note); };
  Mesh mesh(before);
  try {
    const Result result = improve(mesh, options);
    require(result.worse().empty(), "no figure is worse");
    for (const std::string& note : result.notes) require_one_line(note);
    require_promises(before, mesh.arrays(), result.goal);
  } catch (const Error& error) {
    require(*error.what() != 0, "an error says something");
    require(mesh.tet_count() > 0, "the mesh is there after a mistake");
    require_same_space(before, mesh.arrays());
  }
  return 0;
}
