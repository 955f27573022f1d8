// SPDX-License-Identifier: MIT
// What a stranger may type: the goal, regions, bounds of size, parameters of a schedule. A line for
// each option: "protect label:1".
#include <cstdlib>
#include <string>

#include <tetmend/error.h>
#include <tetmend/improve.h>

#include "fuzz/judge.h"
#include "fuzz/target.h"

using namespace tetmend;
using namespace tetmend::fuzz;

namespace {

void set(Options& options, std::string_view name, const std::string& value) {
  if (name == "protect") options.protect.push_back(value);
  if (name == "only") options.only.push_back(value);
  if (name == "tets") options.tets = value;
  if (name == "conserve") options.conserve.push_back(value);
  if (name == "measure") options.measure = value;
  if (name == "schedule") options.schedule = value.ends_with(".lua") ? "shell" : value;
  if (name == "min") options.goal.min_angle = std::strtod(value.c_str(), nullptr);
  if (name == "max") options.goal.max_angle = std::strtod(value.c_str(), nullptr);
  if (name == "keep_size") options.keep_size = true;
  if (name == "ignore_interior") options.ignore_interior = true;
  if (name == "threads")
    options.threads = static_cast<int>(std::strtol(value.c_str(), nullptr, 10) % 4);
  if (name == "trace_piece") options.trace_piece = value;
  if (name == "trace_around") options.trace_around = value;
  if (name == "trace_operator") options.trace_operator.push_back(value);
  if (name == "trace_depth")
    options.trace_depth = static_cast<int>(std::strtol(value.c_str(), nullptr, 10));
  if (name == "trace_limit") options.trace_limit = std::strtoull(value.c_str(), nullptr, 10);
  const std::size_t equals = value.find('=');
  if (name == "set" && equals != value.npos) {
    options.set.emplace_back(value.substr(0, equals), value.substr(equals + 1));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const RamFolder folder;
  Options options;
  options.time_limit = 0.5;
  for (Bytes bytes(data, size); !bytes.empty();) {
    const std::string_view line = bytes.line();
    const std::size_t blank = line.find(' ');
    set(options, line.substr(0, blank),
        blank == line.npos ? "" : std::string(line.substr(blank + 1)));
  }
  if (!options.trace_around.empty() || !options.trace_operator.empty() ||
      !options.trace_piece.empty())
    options.trace = folder / "run.trace";
  const MeshArrays before = small_mesh();
  Mesh mesh(before);
  try {
    check(options);
    const Result result = improve(mesh, options);
    require(result.worse().empty(), "no figure is worse");
    require_promises(before, mesh.arrays(), result.goal);
  } catch (const Error& error) {
    require_one_line(error.what());
    require(mesh.tet_count() == before.tets.size(), "the mesh is there after a mistake");
  }
  return 0;
}
