// SPDX-License-Identifier: MIT
// What `tetmend improve` tells about a run, as text and as JSON.
#include "apps/improve_report.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <tetmend/catalogue.h>

#include "apps/bad_tets.h"
#include "apps/files.h"
#include "apps/report.h"
#include "face/identifiers.h"
#include "kernel/printable.h"
#include "kernel/statistics.h"
#include "report/shape.h"

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
std::vector<PassTotal> total_by_name(const std::vector<Pass>& passes) {
  std::vector<PassTotal> totals;
  for (const Pass& pass : passes) {
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
  const std::vector<PassTotal> totals = total_by_name(report.result.passes);
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
    const double share = 100 * total.seconds / std::max(report.result.improving, 1e-9);
    const bool fits = total.name.size() <= width;
    if (!fits) text += total.name + "\n";
    text += fmt::format("{:<{}} {:>6} {:>12} {:>11} {:>9.2f} {:>5.1f} %\n", fits ? total.name : "",
                        width, total.calls, grouped(total.attempts), grouped(total.accepted),
                        total.seconds, share);
  }
  return text;
}

/// What --surface made of it.
std::string format_surface_change(const SurfaceChange& change) {
  if (change.tolerance == 0) {
    return fmt::format("the same shape; {} of {} triangles are others or moved in their plane",
                       grouped(change.touched), grouped(change.triangles_after));
  }
  return fmt::format(
      "moved by {:.3g} at most, which is proven (samples: {:.3g}, allowed: {:.3g}); "
      "{} of {} triangles",
      change.proven, change.sampled, change.tolerance, grouped(change.touched),
      grouped(change.triangles_after));
}

std::string format_surface(const Result& result) {
  if (result.surface_change) return format_surface_change(*result.surface_change);
  return fmt::format("untouched: {} triangles, fingerprint {:016x}",
                     grouped(result.after.boundary_triangles), result.surface_fingerprint);
}

std::string format_orientation(const Result& result) {
  const std::size_t before = result.not_positive_before;
  const std::size_t after = result.not_positive_after;
  if (before == 0 && after == 0) return "none, checked in exact arithmetic";
  return fmt::format("{} before, {} after, counted in exact arithmetic", grouped(before),
                     grouped(after));
}

bool has_regions(const Options& options) {
  return !options.protect.empty() || !options.only.empty();
}

std::string format_worse(const Result& result) {
  const std::vector<std::string> worse = result.worse_than_before();
  return worse.empty() ? "nothing"
                       : fmt::format("{}", fmt::join(worse, ",\n                     "));
}

std::string format_growth(const Result& result) {
  const double before = static_cast<double>(result.before.tets);
  const double added = static_cast<double>(result.after.tets) - before;
  std::string text =
      fmt::format("{:+.0f} tets, {:+.1f} %", added, 100 * added / std::max(before, 1.0));
  if (result.rulers_before && result.rulers_after) {
    text += fmt::format("; shortest edge {:.4g}, was {:.4g}", result.rulers_after->shortest_edge,
                        result.rulers_before->shortest_edge);
  }
  if (!result.size_drift) return text;
  const SizeDrift& drift = *result.size_drift;
  return text +
         fmt::format(",\n{:21}local edge length x {:.2f} (1 %), {:.2f} (median), {:.2f} (99 %)", "",
                     drift.one_percent, drift.median, drift.ninety_nine_percent);
}

std::string share(double part) {
  return fmt::format("{:.2f} %", 100 * part);
}

/// As large as wanted.
std::string tets_that_fill(const SizeStatistics& sizes) {
  return grouped(static_cast<std::size_t>(std::min(sizes.tets_wanted, 1e18)));
}

/// Edges by their lengths over those wanted.
std::string format_sizes(const SizeStatistics& before, const SizeStatistics& after) {
  const auto percent = [](const SizeStatistics& sizes, std::size_t count) {
    return 100 * static_cast<double>(count) /
           static_cast<double>(std::max<std::size_t>(sizes.edges, 1));
  };
  const auto& bounds = SizeStatistics::kBounds;
  std::string text =
      fmt::format("{:<24} {:>12} {:>12}\n{:-<50}\n", "length over wanted", "before", "after", "");
  for (std::size_t i = 0; i <= bounds.size(); ++i) {
    const std::string bin = i == 0 ? fmt::format("below {:.2f}", bounds[0])
                            : i == bounds.size()
                                ? fmt::format("from {:.2f}", bounds.back())
                                : fmt::format("{:.2f} to {:.2f}", bounds[i - 1], bounds[i]);
    text += fmt::format("{:<24} {:>10.2f} % {:>10.2f} %\n", bin,
                        percent(before, before.histogram[i]), percent(after, after.histogram[i]));
  }
  const auto row = [&](std::string_view name, const auto& value) {
    text += fmt::format("{:<24} {:>12} {:>12}\n", name, value(before), value(after));
  };
  row("from 0.71 to 1.41", [](const SizeStatistics& s) { return share(s.in_range); });
  row("from 0.5 to 2", [](const SizeStatistics& s) { return share(s.within_two); });
  row("shortest", [](const SizeStatistics& s) { return fmt::format("{:.3g}", s.shortest); });
  row("longest", [](const SizeStatistics& s) { return fmt::format("{:.3g}", s.longest); });
  row("edges", [](const SizeStatistics& s) { return grouped(s.edges); });
  row("off, on the surface", [](const SizeStatistics& s) { return grouped(s.on_surface); });
  row("off, between walls", [](const SizeStatistics& s) { return grouped(s.between_walls); });
  row("tets that would fill it", tets_that_fill);
  return text;
}

nlohmann::json to_json(const SizeStatistics& sizes) {
  return {{"edges", sizes.edges},
          {"bounds", SizeStatistics::kBounds},
          {"histogram", sizes.histogram},
          {"in_range", sizes.in_range},
          {"within_two", sizes.within_two},
          {"shortest", sizes.shortest},
          {"longest", sizes.longest},
          {"off_on_surface", sizes.on_surface},
          {"off_between_walls", sizes.between_walls},
          {"tets_wanted", sizes.tets_wanted}};
}

std::string format_checks(const ImproveReport& report) {
  const Result& result = report.result;
  std::string text;
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("{:<21}{}\n", name, value);
  };
  line("goal", fmt::format("angles from {:g} to {:g} degrees", result.goal.min_angle,
                           result.goal.max_angle));
  if (!result.sizes_after) line("worse than before", format_worse(result));
  line("growth", format_growth(result));
  line("surface", format_surface(result));
  line("inverted, flat tets", format_orientation(result));
  line("volume", fmt::format("{}, relative change {:.2g}", volume_text(result.after, 10),
                             result.volume_change()));
  if (has_regions(report.options.run)) {
    line("tets protected", fmt::format("{}, {} of them bad", grouped(result.protected_tets),
                                       grouped(result.protected_bad_tets)));
  }
  line("tets touched", fmt::format("{:.1f} %", 100 * report.touched_share()));
  line("time",
       fmt::format("{:.2f} s: reading {:.2f}, building {:.2f}, measuring {:.2f},",
                   report.total_seconds(), report.reading, result.building, result.measuring));
  line("", fmt::format("improving {:.2f}, carrying {:.2f}, writing {:.2f}", result.improving,
                       result.carrying, report.writing));
  if (result.ending == Ending::time_limit) line("", "stopped by the time limit");
  line("speed", fmt::format("{} tets a second of improving",
                            grouped(static_cast<std::size_t>(report.tets_per_second()))));
  line("peak memory", fmt::format("{:.0f} MB", static_cast<double>(report.peak_memory) / 1e6));
  if (report.costs.ranks > 1) {
    line("traffic", fmt::format("{:.1f} bytes a tet and division, {} processes",
                                report.costs.bytes_a_tet(), report.costs.ranks));
  }
  return text;
}

nlohmann::json to_json(const Pass& pass) {
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
          {"n_needles", pass.after.n_needles},
          {"q_aver", pass.after.q_aver}};
}

nlohmann::json to_json(const MeshStatistics& statistics, const std::optional<MeshRulers>& rulers,
                       const std::optional<CurvedStatistics>& curved) {
  nlohmann::json json = tetmend::to_json(statistics);
  if (curved) json["second_order"] = tetmend::to_json(*curved);
  if (rulers) json["rulers"] = tetmend::to_json(*rulers);
  return json;
}

nlohmann::json to_json(const std::optional<SizeDrift>& drift) {
  if (!drift) return nullptr;
  return {{"one_percent", drift->one_percent},
          {"median", drift->median},
          {"ninety_nine_percent", drift->ninety_nine_percent}};
}

nlohmann::json costs_to_json(const ImproveReport& report) {
  const pieces::RunCosts& costs = report.costs;
  nlohmann::json divisions = nlohmann::json::array();
  for (const pieces::Traffic& each : costs.divisions) {
    divisions.push_back({{"tets", each.tets}, {"bytes", each.received}, {"seconds", each.seconds}});
  }
  nlohmann::json parts = nlohmann::json::array();
  for (const pieces::PartTime& each : costs.parts) {
    parts.push_back(
        {{"step", each.step}, {"part", each.part}, {"tets", each.tets}, {"seconds", each.seconds}});
  }
  return {{"count", costs.ranks},
          {"peak_memory_bytes", report.peaks_of_ranks},
          {"bytes_a_tet_and_division", costs.bytes_a_tet()},
          {"divisions", divisions},
          {"parts", parts}};
}

nlohmann::json seconds_to_json(const ImproveReport& report) {
  const Result& result = report.result;
  return {{"total", report.total_seconds()}, {"reading", report.reading},
          {"building", result.building},     {"measuring", result.measuring},
          {"improving", result.improving},   {"carrying", result.carrying},
          {"writing", report.writing}};
}

}  // namespace

double ImproveReport::total_seconds() const {
  return reading + result.building + result.measuring + result.improving + result.carrying +
         writing;
}

double ImproveReport::touched_share() const {
  return static_cast<double>(result.touched_tets) / static_cast<double>(result.after.tets);
}

double ImproveReport::tets_per_second() const {
  return static_cast<double>(result.before.tets) / std::max(result.improving, 1e-9);
}

namespace {

std::string format_carried(const std::vector<CarriedArray>& carried) {
  std::string text;
  for (const CarriedArray& array : carried) {
    text += fmt::format("data of {} '{}': {}", array.on, array.name, array.rule);
    if (array.rule != face::kIdentifierRule) {
      text += fmt::format("; its integral changed by {:.2g}", array.integral_error);
    }
    text += '\n';
  }
  return text.empty() ? text : text + '\n';
}

nlohmann::json to_json(const CarriedArray& array) {
  return {{"name", array.name},
          {"on", array.on},
          {"rule", array.rule},
          {"integral_error", array.integral_error}};
}

}  // namespace

namespace {

/// How the values of each ruler are spread, before and after.
nlohmann::json histograms_to_json(const face::Portrait& portrait) {
  if (!portrait.rulers_before || !portrait.rulers_after) return nullptr;
  nlohmann::json all = nlohmann::json::object();
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    const RulerHistogram& before = (*portrait.rulers_before)[r];
    all[std::string(kRulers[r].name)] = {{"edges", before.bins.edges()},
                                         {"before", before.counts},
                                         {"after", (*portrait.rulers_after)[r].counts}};
  }
  return all;
}

nlohmann::json to_json(const face::DrawnTet& tet, bool is_reason_known) {
  nlohmann::json json = apps::to_json(std::span(&tet.facts, 1), 1).front();
  if (tet.facts.number <= 0) json["tet"] = nullptr;  // gets its number when it is written
  if (!is_reason_known) {
    json["hindrance"] = nullptr;
    json["reason"] = "it was not looked for: the run was stopped, or had no more than pieces";
  }
  json["corners"] = nlohmann::json::array();
  for (const Point& corner : tet.corners) {
    json["corners"].push_back({corner.x(), corner.y(), corner.z()});
  }
  json["may_move"] = tet.is_free;
  return json;
}

nlohmann::json worst_tets_to_json(const face::Portrait& portrait) {
  nlohmann::json list = nlohmann::json::array();
  for (const face::DrawnTet& tet : portrait.bad_after) {
    if (list.size() == report::kMostWorst) break;
    list.push_back(to_json(tet, portrait.are_reasons_known));
  }
  return list;
}

}  // namespace

namespace {

/// The few figures that most look for.
std::string format_main_figures(const Result& result) {
  std::string text;
  const auto row = [&text](std::string_view name, const std::string& before,
                           const std::string& after) {
    text += fmt::format("{:<28} {:>14} {:>14}\n", name, before, after);
  };
  const MeshStatistics& before = result.before;
  const MeshStatistics& after = result.after;
  row("", "before", "after");
  row("tets", grouped(before.tets), grouped(after.tets));
  row("theta_min, degrees", decimal(before.theta_min, 4), decimal(after.theta_min, 4));
  row("theta_max, degrees", decimal(before.theta_max, 4), decimal(after.theta_max, 4));
  row("bad tets  (miss the goal)", grouped(before.n_bad), grouped(after.n_bad));
  if (result.sizes_before && result.sizes_after) {
    row("edges of the wanted length", share(result.sizes_before->in_range),
        share(result.sizes_after->in_range));
  }
  return text;
}

/// Notes, those that are too many for a screen counted.
std::string format_first_notes(const std::vector<std::string>& notes) {
  constexpr std::size_t kMost = 4;
  const std::size_t shown = notes.size() > kMost + 1 ? kMost : notes.size();
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) text += printable(notes[i]) + '\n';
  if (shown < notes.size()) {
    text += fmt::format("and {} lines more, see -v\n", notes.size() - shown);
  }
  return text;
}

std::string format_summary(const ImproveReport& report) {
  const Result& result = report.result;
  std::string text = format_build(result.build) + format_main_figures(result);
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("{:<21}{}\n", name, value);
  };
  line("surface", format_surface(result));
  line("inverted, flat tets", format_orientation(result));
  if (has_regions(report.options.run)) line("tets protected", grouped(result.protected_tets));
  if (!result.sizes_after && !result.worse_than_before().empty()) {
    line("worse than before", format_worse(result));
  }
  if (result.after.n_bad > 0 && result.limit && result.limit->n_forced > 0) {
    line("bad tets left", fmt::format("at least {} of them are forced by the surface",
                                      grouped(result.limit->n_forced)));
  }
  text += format_first_notes(result.notes);
  if (result.ending == Ending::time_limit) line("time", "stopped by the time limit");
  line("time",
       fmt::format("{:.2f} s; more with -v, all with --report FILE.html", report.total_seconds()));
  return text;
}

}  // namespace

std::string format_outcome(const ImproveReport& report) {
  const ImproveOptions& options = report.options;
  return fmt::format("tetmend {}: {} -> {}\n{}", version(), options.input.string(),
                     options.output.string(),
                     options.verbose ? "\n" + format_report(report) : format_summary(report));
}

std::string format_prospect(const ImproveReport& report) {
  const Result& result = report.result;
  const Options& run = report.options.run;
  const MeshStatistics& found = result.before;
  std::string text = format_build(result.build);
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("{:<21}{}\n", name, value);
  };
  line("tets", fmt::format("{}, {} of them bad", grouped(found.tets), grouped(found.n_bad)));
  line("angles",
       fmt::format("{} to {} degrees; goal: {:g} to {:g}", decimal(found.theta_min, 4),
                   decimal(found.theta_max, 4), result.goal.min_angle, result.goal.max_angle));
  line("inverted, flat tets", grouped(result.not_positive_before));
  line("regions", report.regions);
  const bool moves = !run.surface.empty() && run.surface != "fixed";
  line("surface", fmt::format("{} triangles, {}", grouped(found.boundary_triangles),
                              moves ? "which may move: " + run.surface : "which stay bit for bit"));
  if (result.layer_tets > 0) {
    line("boundary layers",
         fmt::format("{} tets are kept, {} of them bad", grouped(result.layer_tets),
                     grouped(result.layer_bad_tets)));
  }
  if (has_regions(run)) {
    line("tets protected", fmt::format("{}, {} of them bad", grouped(result.protected_tets),
                                       grouped(result.protected_bad_tets)));
  }
  if (const auto& sizes = result.sizes_before) {
    line("edges as wanted",
         fmt::format("{} of {}; about {} tets would fill the mesh", share(sizes->in_range),
                     grouped(sizes->edges), tets_that_fill(*sizes)));
  }
  for (const CarriedArray& array : result.carried) {
    line("data", fmt::format("'{}' of {}", printable(array.name), array.on));
  }
  if (result.limit) text += format_limit(*result.limit);
  text += format_first_notes(result.notes);
  line("not kept", report.file_notes.empty()
                       ? "nothing of the file"
                       : fmt::format("{}: see above", report.file_notes.size()));
  return text;
}

std::string format_report(const ImproveReport& report) {
  const Result& result = report.result;
  std::string text = format_build(result.build);
  if (!text.empty()) text += '\n';
  text += format_comparison(result.before, result.after) + '\n';
  text += format_histogram(result.before, &result.after) + '\n';
  if (result.rulers_before && result.rulers_after) {
    text += format_rulers(*result.rulers_before, &*result.rulers_after) + '\n';
  }
  if (result.curved_before && result.curved_after) {
    text += format_curved(*result.curved_before, &*result.curved_after) + '\n';
  }
  if (result.sizes_before && result.sizes_after) {
    text += format_sizes(*result.sizes_before, *result.sizes_after) + '\n';
  }
  for (const std::string& note : result.notes) text += printable(note) + '\n';
  if (!result.notes.empty()) text += '\n';
  text += format_carried(result.carried);
  const std::string passes = format_passes(report);
  if (!passes.empty()) text += passes + '\n';
  if (result.limit && result.limit->n_bad > 0) text += format_limit(*result.limit) + '\n';
  return text + format_checks(report);
}

namespace {

/// Of a fixed surface the fingerprints alone.
nlohmann::json surface_to_json(const Result& result) {
  const auto text = [](std::uint64_t fingerprint) { return fmt::format("{:016x}", fingerprint); };
  nlohmann::json json = {
      {"unchanged", result.surface_fingerprint == result.surface_fingerprint_before},
      {"fingerprint_before", text(result.surface_fingerprint_before)},
      {"fingerprint_after", text(result.surface_fingerprint)}};
  if (!result.surface_change) return json;
  const SurfaceChange& change = *result.surface_change;
  nlohmann::json regions = nlohmann::json::array();
  for (const SurfaceChange::Region& region : change.regions) {
    regions.push_back({{"label", region.label},
                       {"area_before", region.area_before},
                       {"area_after", region.area_after},
                       {"volume_before", region.volume_before},
                       {"volume_after", region.volume_after}});
  }
  json["tolerance"] = change.tolerance;
  json["proven_distance"] = change.proven;
  json["sampled_distance"] = change.sampled;
  json["triangles_before"] = change.triangles_before;
  json["triangles_after"] = change.triangles_after;
  json["triangles_touched"] = change.touched;
  json["regions"] = regions;
  return json;
}

}  // namespace

nlohmann::json to_json(const ImproveReport& report) {
  const Result& result = report.result;
  const Options& options = report.options.run;
  nlohmann::json passes = nlohmann::json::array();
  for (const Pass& pass : result.passes) passes.push_back(to_json(pass));
  nlohmann::json data = nlohmann::json::array();
  for (const CarriedArray& array : result.carried) data.push_back(to_json(array));
  std::vector<std::string> notes = report.file_notes;
  notes.insert(notes.end(), result.notes.begin(), result.notes.end());
  nlohmann::json settings = nlohmann::json::object();
  for (const auto& [name, value] : options.set) settings[name] = value;
  nlohmann::json json = {
      {"tetmend", version()},
      {"arguments", report.arguments},
      {"input", report.options.input.string()},
      {"output", report.options.output.string()},
      {"schedule", options.schedule},
      {"settings", settings},
      {"goal", {{"min_angle", result.goal.min_angle}, {"max_angle", result.goal.max_angle}}},
      {"measure", options.measure},
      {"worse_than_before", result.worse_than_before()},
      {"missed_aims", result.missed_aims()},
      {"size_drift", to_json(result.size_drift)},
      {"threads", options.threads},
      {"interrupted", result.ending == Ending::cancelled},
      {"out_of_time", result.ending == Ending::time_limit},
      {"notes", notes},
      {"data", data},
      {"build", to_json(result.build)},
      {"protected", {{"tets", result.protected_tets}, {"bad_tets", result.protected_bad_tets}}},
      {"layers", {{"tets", result.layer_tets}, {"bad_tets", result.layer_bad_tets}}},
      {"before", to_json(result.before, result.rulers_before, result.curved_before)},
      {"after", to_json(result.after, result.rulers_after, result.curved_after)},
      {"limit", tetmend::to_json(result.limit.value_or(SurfaceLimit()))},
      {"curved_edges", result.curved_edges},
      {"straightened_edges", result.straightened_edges},
      {"surface", surface_to_json(result)},
      {"not_positive_tets",
       {{"before", result.not_positive_before}, {"after", result.not_positive_after}}},
      {"volume_change", result.volume_change()},
      {"touched_share", report.touched_share()},
      {"seconds", seconds_to_json(report)},
      {"tets_per_second", report.tets_per_second()},
      {"peak_memory_bytes", report.peak_memory},
      {"histograms", histograms_to_json(report.portrait)},
      {"worst_tets", worst_tets_to_json(report.portrait)},
      {"passes", passes}};
  if (result.sizes_after) {
    json["sizes"] = {{"before", to_json(*result.sizes_before)},
                     {"after", to_json(*result.sizes_after)}};
  }
  json["ranks"] = report.costs.ranks > 0 ? costs_to_json(report) : nlohmann::json();
  return json;
}

}  // namespace tetmend::apps
