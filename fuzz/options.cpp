// SPDX-License-Identifier: MIT
// What a stranger may type: the goal, regions, bounds of size, parameters of a schedule. A line for
// each option: "protect label:1".
#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include <tetmend/error.h>
#include <tetmend/improve.h>
#include <tetmend/option_text.h>

#include "fuzz/judge.h"
#include "fuzz/target.h"

using namespace tetmend;
using namespace tetmend::fuzz;

namespace {

/// What would read or write a file, load code, or give up a promise that is required below, is not
/// tried.
bool is_tried(std::string_view name, const std::string& value) {
  constexpr std::array kNot = {"plugin", "trace", "script", "size", "surface", "purpose"};
  if (name == "schedule" && value.ends_with(".lua")) return false;
  return std::find(kNot.begin(), kNot.end(), name) == kNot.end();
}

/// The options of the library, each by its row; MIN and MAX of the goal alone as well.
void set(Options& options, std::string_view name, const std::string& value) {
  if (name == "min") options.goal.min_angle = std::strtod(value.c_str(), nullptr);
  if (name == "max") options.goal.max_angle = std::strtod(value.c_str(), nullptr);
  std::string row(name);
  std::replace(row.begin(), row.end(), '_', '-');
  for (const OptionForm& form : option_forms()) {
    if (form.name != row || !is_tried(row, value)) continue;
    try {
      set_option(options, row, value);
    } catch (const Error& error) {
      require_one_line(error.what());
    }
  }
  options.threads = std::min(options.threads, 4);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const RamFolder folder;
  Options options;
  for (Bytes bytes(data, size); !bytes.empty();) {
    const std::string_view line = bytes.line();
    const std::size_t blank = line.find(' ');
    set(options, line.substr(0, blank),
        blank == line.npos ? "" : std::string(line.substr(blank + 1)));
  }
  options.time_limit = 0.5;
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
