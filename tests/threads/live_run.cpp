// SPDX-License-Identifier: MIT
// live_run MESH SCHEDULE
// One thread looks at a run that another makes: holds it, takes its mesh and its last calls, changes a
// parameter, goes on. The thread sanitizer looks on.
#include "viewer/live/live_run.h"

#include <cstdio>
#include <exception>
#include <string>

#include "kernel/formats/mesh_io.h"

using namespace tetmend;
using namespace tetmend::viewer;

namespace {

constexpr double kPatience = 600;  // seconds until a run rests

/// What a window does with a run that it has held.
std::size_t look_at(LiveRun& run, std::size_t turn) {
  std::size_t seen = run.last_calls().size();
  if (const auto data = run.whole_data()) seen += data->tets.size();
  if (turn % 2 == 0) {
    run.hold_parameter({.operator_name = "recursive_shell_transformation",
                        .parameter = "max_level",
                        .value = turn % 4 == 0 ? 1.0 : 3.0});
  }
  return seen;
}

/// @return how often the run rested
std::size_t follow(LiveRun& run) {
  constexpr Demand kSteps[] = {Demand::to_next_call, Demand::to_next_accepted, Demand::to_next_pass,
                               Demand::pause};
  std::size_t rests = 0;
  for (std::size_t turn = 0; run.is_active(); ++turn) {
    run.wait(0.01);
    run.progress();
    run.take_snapshot();
    if (turn % 8 != 0) continue;
    run.ask(kSteps[turn / 8 % std::size(kSteps)]);
    if (run.wait(kPatience) != LiveState::paused) continue;
    ++rests;
    if (look_at(run, turn / 8) == 0) std::fprintf(stderr, "nothing to see in turn %zu\n", turn);
    run.set_speed(turn % 16 == 0 ? 1000 : 0);
    run.ask(Demand::go_on);
  }
  return rests;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    LiveRun run;
    run.choose_schedule(argv[2]);
    TetMesh mesh(read_mesh(argv[1]));
    const MeshStatistics statistics = compute_statistics(mesh);
    run.start({std::move(mesh), statistics}, LiveRun::From::file, argv[1]);
    const std::size_t rests = follow(run);
    if (run.state() == LiveState::finished && rests > 0) return 0;
    std::fprintf(stderr, "rested %zu times, then: %s %s\n", rests,
                 std::string(to_string(run.state())).c_str(), run.progress().error.c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return 1;
}
