// SPDX-License-Identifier: MIT
// tetmend adapt: a mesh goes in, one with edges as long as wanted comes out.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/command_improve.h"
#include "apps/improve_options.h"
#include "apps/mesh_formats.h"

namespace tetmend::apps {

void add_adapt(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<ImproveOptions>();
  CLI::App* command = app.add_subcommand("adapt", "Make edges as long as a field of sizes asks");
  add_adapt_options(*command, *options);
  if (invocation.ranks == nullptr) {
    add_dry_run_option(*command, *options);
    add_folder_option(*command);
  }
  command->footer(fmt::format(
      R"(Splits edges that are longer than 1.41 of the wanted length, contracts those
shorter than 0.71, and improves what came of it without undoing that. Prints
the lengths of edges over those wanted, before and after, and what the surface
holds; the rest of the report is that of 'tetmend improve'.

A SIZE is one of
  0.5              this length
  0.5x             half of what edges are there, on average at each vertex
  array:h          an array of the points of IN
  h.sol, h.solb    a file of MEDIT with one length for each vertex of IN
  coarse.vtu:h     an array of the points of another mesh, linear in its tets
  h.lua            what the function size(x, y, z) of this script returns
or one of these for a region, as label:1,4=0.5. Regions without a size keep
theirs. Where several regions meet, the least counts. Between vertices lengths
are linear in the tets of IN; those of another mesh, if they stand alone, in
its own. A function that stands alone is asked at each place, ungraded.

The surface stays as it is, bit for bit, and so do its edges: lengths hold
inside. With --surface flat, 1% or a length its edges are split and contracted
as far as that allows. Labels, groups, arrays, feature lines, constraints and
layers come over as by 'tetmend improve'. What --tets allows is a bound. The
figures of IN are no bounds here, for another mesh was asked for.

Examples:
  tetmend adapt part.mesh --size 0.5 -o fine.mesh
  tetmend adapt part.vtu --size array:h --gradation 1.2 -o adapted.vtu
  tetmend adapt part.mesh --size h.sol --surface flat -o adapted.mesh
  tetmend adapt part.msh --size 1x --size label:3=0.25x -o finer_there.msh

Formats, by extension:
{}
Exit status: 0 success, 1 the work failed and OUT is as it was, 2 wrong usage,
3 written, but tets miss the goal that --goal asked for, 4 written, but
interrupted)",
      mesh_format_list()));
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] { return run_improve(*options, invocation); };
  });
}

}  // namespace tetmend::apps
