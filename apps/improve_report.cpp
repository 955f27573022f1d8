// SPDX-License-Identifier: MIT
// What `tetmend improve` tells about a run, as text and as JSON.
#include "apps/improve_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/files.h"
#include "apps/report.h"

namespace tetmend::apps {
namespace {

/// All passes of one name.
struct PassTotal {
  std::string name;
  std::size_t calls = 0;
  std::size_t attempts = 0;
  std::size_t accepted = 0;
  double seconds = 0;
};

/// In the order in which the names appear first.
std::vector<PassTotal> total_by_name(const std::vector<PassRecord>& passes) {
  std::vector<PassTotal> totals;
  for (const PassRecord& pass : passes) {
    auto total = std::find_if(totals.begin(), totals.end(),
                              [&](const PassTotal& t) { return t.name == pass.name; });
    if (total == totals.end())
      total = totals.insert(
          total,
          PassTotal{.name = pass.name, .calls = 0, .attempts = 0, .accepted = 0, .seconds = 0});
    ++total->calls;
    total->attempts += pass.attempts();
    total->accepted += pass.accepted();
    total->seconds += pass.seconds;
  }
  return totals;
}

std::string format_passes(const ImproveReport& report) {
  const std::vector<PassTotal> totals = total_by_name(report.passes);
  if (totals.empty()) return {};
  // The figures of a longer name, as sequences have, stand in a line below it.
  constexpr std::size_t kWidest = 30;
  std::size_t width = std::size("pass") - 1;
  for (const PassTotal& total : totals) {
    if (total.name.size() <= kWidest) width = std::max(width, total.name.size());
  }
  std::string text = fmt::format("{:<{}} {:>6} {:>12} {:>11} {:>9} {:>7}\n", "pass", width, "calls",
                                 "attempts", "accepted", "seconds", "share");
  text += std::string(text.size() - 1, '-') + '\n';
  for (const PassTotal& total : totals) {
    const double share = 100 * total.seconds / std::max(report.seconds.improving, 1e-9);
    const bool fits = total.name.size() <= width;
    if (!fits) text += total.name + "\n";
    text += fmt::format("{:<{}} {:>6} {:>12} {:>11} {:>9.2f} {:>5.1f} %\n", fits ? total.name : "",
                        width, total.calls, grouped(total.attempts), grouped(total.accepted),
                        total.seconds, share);
  }
  return text;
}

std::string format_surface(const ImproveReport& report) {
  if (!report.surface_unchanged()) return "CHANGED";
  return fmt::format("untouched: {} triangles, fingerprint {:016x}",
                     grouped(report.after.statistics.boundary_triangles),
                     report.after.surface_fingerprint);
}

std::string format_orientation(const ImproveReport& report) {
  const std::size_t before = report.before.not_positive;
  const std::size_t after = report.after.not_positive;
  if (before == 0 && after == 0) return "none, checked in exact arithmetic";
  return fmt::format("{} before, {} after, counted in exact arithmetic", grouped(before),
                     grouped(after));
}

std::string format_checks(const ImproveReport& report) {
  const Timing& s = report.seconds;
  std::string text;
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("{:<21}{}\n", name, value);
  };
  line("surface", format_surface(report));
  line("inverted, flat tets", format_orientation(report));
  line("volume", fmt::format("{:.10g}, relative change {:.2g}", report.after.statistics.volume,
                             report.volume_change()));
  if (report.protected_part.asked_for) {
    line("tets protected", fmt::format("{}, {} of them bad", grouped(report.protected_part.tets),
                                       grouped(report.protected_part.bad_tets)));
  }
  line("tets touched", fmt::format("{:.1f} %", 100 * report.touched_share));
  line("time", fmt::format("{:.2f} s: reading {:.2f}, building {:.2f}, measuring {:.2f},",
                           s.total(), s.reading, s.building, s.measuring));
  line("", fmt::format("improving {:.2f}, writing {:.2f}", s.improving, s.writing));
  if (report.out_of_time) line("", "stopped by the time limit");
  line("speed", fmt::format("{} tets a second of improving",
                            grouped(static_cast<std::size_t>(report.tets_per_second()))));
  line("peak memory", fmt::format("{:.0f} MB", static_cast<double>(report.peak_memory) / 1e6));
  return text;
}

nlohmann::json to_json(const PassRecord& pass) {
  nlohmann::json verdicts = nlohmann::json::object();
  for (std::size_t i = 0; i < pass.verdicts.size(); ++i) {
    std::string name(to_string(static_cast<Verdict>(i)));
    std::replace(name.begin(), name.end(), ' ', '_');
    verdicts[name] = pass.verdicts[i];
  }
  return {{"name", pass.name},
          {"round", pass.round},
          {"seconds", pass.seconds},
          {"attempts", pass.attempts()},
          {"accepted", pass.accepted()},
          {"verdicts", verdicts},
          {"items", pass.items},
          {"deferred", pass.deferred},
          {"seconds_in_scans", pass.seconds_in_scans},
          {"seconds_in_blocks", pass.seconds_in_blocks},
          {"q_worst", pass.after.q_worst},
          {"n_bad", pass.after.n_bad},
          {"q_aver", pass.after.q_aver}};
}

nlohmann::json to_json(const Timing& seconds) {
  return {{"total", seconds.total()},       {"reading", seconds.reading},
          {"building", seconds.building},   {"measuring", seconds.measuring},
          {"improving", seconds.improving}, {"writing", seconds.writing}};
}

}  // namespace

bool ImproveReport::surface_unchanged() const {
  return before.surface_fingerprint == after.surface_fingerprint &&
         before.statistics.boundary_triangles == after.statistics.boundary_triangles;
}

double ImproveReport::volume_change() const {
  const double difference = std::abs(after.statistics.volume - before.statistics.volume);
  return difference == 0 ? 0 : difference / std::abs(before.statistics.volume);
}

double ImproveReport::tets_per_second() const {
  return static_cast<double>(before.statistics.tets) / std::max(seconds.improving, 1e-9);
}

std::string format_report(const ImproveReport& report) {
  std::string text = format_build(report.build);
  if (!text.empty()) text += '\n';
  text += format_comparison(report.before.statistics, report.after.statistics) + '\n';
  text += format_histogram(report.before.statistics, &report.after.statistics) + '\n';
  for (const std::string& note : report.notes) text += note + '\n';
  if (!report.notes.empty()) text += '\n';
  const std::string passes = format_passes(report);
  if (!passes.empty()) text += passes + '\n';
  if (report.limit.n_bad > 0) text += format_limit(report.limit) + '\n';
  return text + format_checks(report);
}

nlohmann::json to_json(const ImproveReport& report) {
  const auto hex = [](std::uint64_t value) { return fmt::format("{:016x}", value); };
  nlohmann::json passes = nlohmann::json::array();
  for (const PassRecord& pass : report.passes) passes.push_back(to_json(pass));
  nlohmann::json settings = nlohmann::json::object();
  for (const auto& [name, value] : report.settings) settings[name] = value;
  return {{"tetmend", TETMEND_VERSION},
          {"arguments", report.arguments},
          {"input", report.input.string()},
          {"output", report.output.string()},
          {"schedule", report.schedule},
          {"settings", settings},
          {"threads", report.threads},
          {"interrupted", report.interrupted},
          {"out_of_time", report.out_of_time},
          {"notes", report.notes},
          {"build", to_json(report.build)},
          {"protected", to_json(report.protected_part)},
          {"before", tetmend::to_json(report.before.statistics)},
          {"after", tetmend::to_json(report.after.statistics)},
          {"limit", tetmend::to_json(report.limit)},
          {"surface",
           {{"unchanged", report.surface_unchanged()},
            {"fingerprint_before", hex(report.before.surface_fingerprint)},
            {"fingerprint_after", hex(report.after.surface_fingerprint)}}},
          {"not_positive_tets",
           {{"before", report.before.not_positive}, {"after", report.after.not_positive}}},
          {"volume_change", report.volume_change()},
          {"touched_share", report.touched_share},
          {"seconds", to_json(report.seconds)},
          {"tets_per_second", report.tets_per_second()},
          {"peak_memory_bytes", report.peak_memory},
          {"passes", passes}};
}

}  // namespace tetmend::apps
