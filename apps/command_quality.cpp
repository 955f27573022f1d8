// SPDX-License-Identifier: MIT
// tetmend quality: the figures by which a mesh is judged.
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/report.h"
#include "apps/threads.h"
#include "kernel/formats/tet_mesh_io.h"

namespace tetmend::apps {
namespace {

constexpr std::string_view kAll = "all";

struct Options {
  std::filesystem::path file;
  std::vector<std::string> measures;
  bool limit = false;
  bool json = false;
  int threads = 1;
};

std::vector<const QualityMeasure*> find_measures(const std::vector<std::string>& names) {
  std::vector<const QualityMeasure*> measures;
  const auto add = [&measures](const QualityMeasure& measure) {
    if (std::find(measures.begin(), measures.end(), &measure) == measures.end()) {
      measures.push_back(&measure);
    }
  };
  for (const std::string& name : names) {
    if (name == kAll) {
      for (const QualityMeasure& measure : quality_measures()) add(measure);
      continue;
    }
    try {
      add(find_quality_measure(name));
    } catch (const Error& error) {
      throw UsageError(fmt::format("--measure: {}", error.what()));
    }
  }
  return measures;
}

void print_json(const std::filesystem::path& file, const MeshStatistics& statistics,
                const std::vector<MeasureSummary>& extra, const std::optional<SurfaceLimit>& limit,
                const BuildReport& build) {
  nlohmann::json result = tetmend::to_json(statistics);
  result["file"] = file.string();
  result["build"] = to_json(build);
  if (limit) result["limit"] = tetmend::to_json(*limit);
  for (const MeasureSummary& summary : extra) {
    result["measures"][std::string(summary.measure->name)] = {{"worst", summary.worst},
                                                              {"mean", summary.mean}};
  }
  fmt::print("{}\n", result.dump(2));
}

int run_quality(const Options& options) {
  check_mesh_extension(options.file);
  const ThreadLimit limit(options.threads);
  const auto measures = find_measures(options.measures);
  BuildReport build;
  const TetMesh mesh = read_tet_mesh(options.file, MeshOrder::of_file, &build);
  const MeshStatistics statistics = compute_statistics(mesh);
  std::vector<MeasureSummary> extra;
  for (const QualityMeasure* measure : measures) extra.push_back(summarize(mesh, *measure));
  std::optional<SurfaceLimit> surface_limit;
  if (options.limit) surface_limit = compute_surface_limit(mesh);
  if (options.json) {
    print_json(options.file, statistics, extra, surface_limit, build);
    return 0;
  }
  fmt::print("{}\n\n", options.file.string());
  if (const std::string notes = format_build(build); !notes.empty()) fmt::print("{}\n", notes);
  fmt::print("{}\n{}", format_statistics(statistics, extra), format_histogram(statistics, nullptr));
  if (surface_limit) fmt::print("\n{}", format_limit(*surface_limit));
  return 0;
}

std::string measure_list() {
  std::string text;
  for (const QualityMeasure& measure : quality_measures()) {
    text += fmt::format("  {:<24}{}\n", measure.name, measure.help);
  }
  return text;
}

}  // namespace

void add_quality(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("quality", "Print the statistics of a mesh");
  command->add_option("FILE", options->file, "Mesh")->required()->type_name("");
  command->add_flag("--json", options->json, "Print JSON");
  command
      ->add_option(
          "--measure", options->measures,
          "Add worst and mean of a measure (see below); may\nbe repeated; 'all' adds all of them")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  command->add_flag("--limit", options->limit,
                    "Add what the surface allows at best, and why each bad\ntet is there");
  add_threads_option(*command, options->threads);
  command->footer(fmt::format(R"(The angles are those between the faces of a tet, in degrees.
  lambda          share of the angles that are <= 30 or >= 150
  lambda_1..5     its parts: angles within 6, 6-12, ... 24-30 degrees of 0 or 180
  q               minimum sine of the angles of a tet; a tet is bad if q < 0.5
  q_worst, q_aver the smallest q, and the mean over the bad tets
In JSON the names are the same; histogram counts the angles by 5 degrees.

--limit proves what no mesh of this surface can beat: a bad tet is forced if
every mesh with the same surface and constraints has one there. It counts these
and bounds the smallest and largest angle; more may be forced than is found.

Measures:
{}
Formats, by extension:
{}
Examples:
  tetmend quality part.mesh --limit
  tetmend quality part.vtk --measure radius_ratio --measure mean_ratio --json

Exit status: 0 success, 1 the file cannot be read, 2 wrong usage)",
                              measure_list(), mesh_format_list()));
  command->callback(
      [options, &invocation] { invocation.action = [options] { return run_quality(*options); }; });
}

}  // namespace tetmend::apps
