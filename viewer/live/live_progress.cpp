// SPDX-License-Identifier: MIT
#include "viewer/live/live_progress.h"

#include <array>

namespace tetmend::viewer {

using nlohmann::json;

std::string_view to_string(LiveState state) {
  constexpr std::array<std::string_view, 7> kNames = {"idle",    "running",  "paused", "stopping",
                                                      "stopped", "finished", "failed"};
  return kNames[static_cast<std::size_t>(state)];
}

namespace {

json to_json(const LivePass& pass) {
  return {{"name", pass.name},
          {"round", pass.round},
          {"attempts", pass.attempts},
          {"accepted", pass.accepted},
          {"seconds", pass.seconds},
          {"n_bad", pass.after.n_bad},
          {"n_needles", pass.after.n_needles},
          {"q_worst", pass.after.q_worst},
          {"q_aver", pass.after.q_aver}};
}

json to_json(const LiveCall& call) {
  return {{"operator", call.operator_name},
          {"place", {call.place.x(), call.place.y(), call.place.z()}},
          {"before", call.before},
          {"after", call.after},
          {"verdict", call.is_under_way ? "under way" : to_string(call.verdict)},
          {"level", call.level},
          {"number", call.number}};
}

}  // namespace

json to_json(const LiveProgress& progress) {
  json passes = json::array();
  for (const LivePass& pass : progress.passes) passes.push_back(to_json(pass));
  return {
      {"state", to_string(progress.state)},
      {"error", progress.error},
      {"phase", progress.phase},
      {"round", progress.round},
      {"share", progress.share},
      {"seconds", progress.seconds},
      {"attempts", progress.attempts},
      {"accepted", progress.accepted},
      {"passes", passes},
      {"notes", progress.notes},
      {"last_accepted", progress.last_accepted ? to_json(*progress.last_accepted) : json(nullptr)},
      {"last", progress.last ? to_json(*progress.last) : json(nullptr)},
      {"breakpoint", progress.breakpoint},
      {"trace", progress.trace},
      {"held_parameters", progress.held_parameters}};
}

}  // namespace tetmend::viewer
