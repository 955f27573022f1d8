// SPDX-License-Identifier: MIT
// tetmend quality: the figures by which a mesh is judged.
#include <algorithm>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tetmend/io.h>
#include <tetmend/measure.h>

#include "apps/bad_tets.h"
#include "apps/commands.h"
#include "apps/files.h"
#include "apps/improve_options.h"
#include "apps/mesh_formats.h"
#include "apps/number_check.h"
#include "apps/report.h"
#include "apps/standard_streams.h"
#include "apps/threads.h"
#include "kernel/formats/degenerate.h"
#include "kernel/formats/harmless_notes.h"

namespace tetmend::apps {
namespace {

constexpr std::string_view kAll = "all";

struct QualityOptions {
  std::vector<std::filesystem::path> files;
  std::filesystem::path file;  // the one that is measured now
  std::vector<std::string> measures;
  Options run;  // its goal alone
  bool limit = false;
  std::size_t list = 0;         // --list
  std::filesystem::path cells;  // --cells
  std::string format;
  bool json = false;
  int threads = 1;
};

/// Each once, in the order of their first mention.
std::vector<std::string> list_measures(const std::vector<std::string>& names) {
  std::vector<std::string> list;
  const auto add = [&list](std::string_view name) {
    if (std::find(list.begin(), list.end(), name) == list.end()) list.emplace_back(name);
  };
  for (const std::string& name : names) {
    if (name != kAll) {
      add(name);
      continue;
    }
    for (const Measure& each : measures()) add(each.name);
  }
  return list;
}

nlohmann::json figures_of(const QualityOptions& options, const Measurement& measured) {
  nlohmann::json result = tetmend::to_json(measured.statistics);
  result["file"] = shown(options.file);
  const Goal& goal = options.run.goal;
  result["goal"] = {{"min_angle", goal.min_angle}, {"max_angle", goal.max_angle}};
  result["build"] = to_json(measured.build);
  result["notes"] = measured.notes;
  if (measured.rulers) result["rulers"] = tetmend::to_json(*measured.rulers);
  if (measured.curved) result["second_order"] = tetmend::to_json(*measured.curved);
  if (measured.limit) result["limit"] = tetmend::to_json(*measured.limit);
  if (options.list > 0) result["bad_tets"] = to_json(measured.bad_tets, options.list);
  for (const MeasureSummary& summary : measured.measures) {
    result["measures"][std::string(summary.name)] = {{"worst", summary.worst},
                                                     {"mean", summary.mean}};
  }
  return result;
}

/// Of several meshes: the figures of a line, and what is the worst of all in each column.
struct Row {
  std::size_t tets = 0;
  std::size_t n_bad = 0;
  double theta_min = 180;
  double theta_max = 0;
  double mean_ratio = 1;

  void include(const Row& other) {
    tets = std::max(tets, other.tets);
    n_bad = std::max(n_bad, other.n_bad);
    theta_min = std::min(theta_min, other.theta_min);
    theta_max = std::max(theta_max, other.theta_max);
    mean_ratio = std::min(mean_ratio, other.mean_ratio);
  }
  std::string text(std::string_view name) const {
    return fmt::format("{:>11} {:>9} {:>9.4g} {:>9.4g} {:>10.4g}  {}\n", grouped(tets),
                       grouped(n_bad), theta_min, theta_max, mean_ratio, name);
  }
};

Row to_row(const Measurement& measured) {
  const MeshStatistics& of = measured.statistics;
  return {of.tets, of.n_bad, of.theta_min, of.theta_max,
          measured.rulers ? (*measured.rulers)[Ruler::mean_ratio].mean : 1};
}

/// @throws UsageError
MeasureOptions to_wanted(const QualityOptions& options) {
  MeasureOptions wanted = {.measure = list_measures(options.measures),
                           .goal = options.run.goal,
                           .limit = options.limit,
                           .bad_tets = options.list > 0 || !options.cells.empty(),
                           .threads = options.threads};
  try {
    check(wanted);
  } catch (const OptionError& error) {
    throw UsageError(fmt::format("--{}", error.what()));
  }
  return wanted;
}

Measurement measure_file(const QualityOptions& options, const MeasureOptions& wanted,
                         const pieces::ArrayFiles* parts) {
  Mesh mesh = load_whole(options.file, options.threads, parts);
  std::vector<std::string> not_measured = mesh.notes();
  std::erase_if(not_measured, [](const auto& note) {
    return !formats::tells_of_dropped(note) && !note.ends_with(formats::kStayWhereTheyAre);
  });
  Measurement measured =
      in_parts(options.file, parts, [&] { return measure(std::move(mesh), wanted); });
  measured.notes.insert(measured.notes.begin(), not_measured.begin(), not_measured.end());
  return measured;
}

void print_text(const QualityOptions& options, const Measurement& measured) {
  std::vector<std::string> blocks = {fmt::format("{}\n", shown(options.file))};
  if (const Goal& goal = options.run.goal; !(goal == Goal{})) {
    blocks.push_back(fmt::format("bad tets: angles below {:g} or above {:g} degrees\n",
                                 goal.min_angle, goal.max_angle));
  }
  std::string notes = format_build(measured.build);
  for (const std::string& note : measured.notes) notes += fmt::format("note: {}\n", note);
  if (!notes.empty()) blocks.push_back(notes);
  blocks.push_back(format_statistics(measured.statistics, measured.measures));
  if (options.list == 0) {  // below more tables nobody would look for it
    blocks.push_back(format_histogram(measured.statistics, nullptr));
    if (measured.rulers) blocks.push_back(format_rulers(*measured.rulers, nullptr));
  }
  if (measured.curved) blocks.push_back(format_curved(*measured.curved, nullptr));
  if (measured.limit) blocks.push_back(format_limit(*measured.limit));
  if (options.list > 0) blocks.push_back(format_bad_tets(measured.bad_tets, options.list));
  say(stdout, fmt::format("{}", fmt::join(blocks, "\n")));
}

/// A line each, and one of the worst. A file that cannot be read is named, and the others follow.
int run_several(QualityOptions& options, const pieces::ArrayFiles* parts) {
  if (options.limit || options.list > 0 || !options.cells.empty()) {
    throw UsageError("--limit, --list and --cells take one mesh");
  }
  if (!options.measures.empty() && !options.json) {
    throw UsageError("--measure takes one mesh, or --json");
  }
  const MeasureOptions wanted = to_wanted(options);
  for (const auto& file : options.files) check_input_format(file, parts);
  if (!options.json) {
    say(stdout, fmt::format("{:>11} {:>9} {:>9} {:>9} {:>10}  {}\n", "tets", "bad tets",
                            "theta_min", "theta_max", "mean ratio", "mesh"));
  }
  Row worst;
  std::size_t measured_files = 0;
  for (const auto& file : options.files) {
    options.file = file;
    try {
      const Measurement measured = measure_file(options, wanted, parts);
      ++measured_files;
      worst.include(to_row(measured));
      if (options.json) {
        say(stdout, printable_for("standard output", figures_of(options, measured)).dump() + '\n');
      } else {
        say(stdout, to_row(measured).text(shown(file)));
      }
    } catch (const Error& error) {
      complain(kFailed, error.what());
    }
  }
  if (measured_files > 1 && !options.json) say(stdout, worst.text("the worst of each"));
  return measured_files == options.files.size() ? kSuccess : kFailed;
}

int run_quality(QualityOptions& options, const pieces::ArrayFiles* parts) {
  if (options.files.size() > 1) return run_several(options, parts);
  options.file = options.files.front();
  name_streams(options.format, options.file, nullptr);
  check_input_format(options.file, parts);
  if (!options.cells.empty()) {
    check_mesh_extension(options.cells);
    const NamedFile input = {"FILE", options.file, NamedFile::Kind::mesh};
    const NamedFile cells = {"--cells", options.cells, NamedFile::Kind::mesh};
    prepare_files({&input, 1}, {&cells, 1}, parts);
  }
  const Measurement measured = measure_file(options, to_wanted(options), parts);
  if (!options.cells.empty()) {
    write_bad_tets(read_whole(options.file, parts), options.cells, measured.bad_tets);
  }
  if (options.json) {
    print_json(figures_of(options, measured));
  } else {
    print_text(options, measured);
  }
  return kSuccess;
}

template <class Infos>
std::string ruler_list(const Infos& rulers) {
  std::string text;
  for (const auto& each : rulers) {
    std::string help = fmt::format("  {:<19}", each.name);
    for (const char c : each.help)
      help += c == '\n' ? "\n" + std::string(21, ' ') : std::string(1, c);
    text += help + '\n';
  }
  return text;
}

std::string measure_list() {
  std::string text;
  for (const Measure& each : measures()) {
    text += fmt::format("  {:<24}{}\n", each.name, each.help);
  }
  return text;
}

}  // namespace

void add_quality(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<QualityOptions>();
  CLI::App* command = app.add_subcommand(
      "quality", "Print the statistics of a mesh, or a line for each of several");
  command->add_option("FILE", options->files, "Mesh; several give a line each and one of the worst")
      ->required()
      ->type_name("");
  command->add_flag("--json", options->json, "Print JSON; of several meshes a line each");
  command
      ->add_option(
          "--measure", options->measures,
          "Add worst and mean of a measure (see below); may\nbe repeated; 'all' adds all of them")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  add_goal_option(*command, options->run);
  command->add_flag("--limit", options->limit,
                    "Add what the surface allows at best, and why each bad\ntet is there");
  command
      ->add_option("--list", options->list,
                   "Name the worst N bad tets, in place of histogram and\nother programs' "
                   "measures: number from 1, region,\ncentre, angles and why they resist")
      ->type_name("N")
      ->check(number_from(std::size_t{1}, std::size_t{1000000000}));
  command
      ->add_option("--cells", options->cells,
                   "Write the bad tets as a mesh of their own, with these\nfigures as arrays")
      ->type_name("FILE");
  add_format_option(*command, options->format);
  add_threads_option(*command, options->threads);
  command->footer(fmt::format(R"(The angles are those between the faces of a tet, in degrees.
  lambda          share of the angles that are <= 30 or >= 150
  lambda_1..5     its parts: angles within 6, 6-12 ... 24-30 degrees of 0 or 180
  q               minimum sine of the angles of a tet; with the usual
                  goal a tet is bad if q < 0.5
  q_worst, q_aver the smallest q, and the mean over the bad tets
In JSON the names are the same; histogram counts the angles by 5 degrees.

Of the measures of other programs: the worst value, the one that 1 % of the tets
(faces, points) do not surpass, and the mean. Two are one number of the mesh.
{}{}
--limit proves what no mesh of this surface can beat: a bad tet is forced if
every mesh with the same surface and constraints has one there. It counts these
and bounds the smallest and largest angle; more may be forced than is found.
--cells writes number (from 1), theta_min, theta_max, quality, free_vertices and
reason: 1 the surface forces it, 2 a constraint holds it, 3 all its vertices are
on the surface, 4 no obstacle is known.

Measures:
{}
Formats, by extension:
{}{}
Examples:
  tetmend quality part.mesh --limit
  tetmend quality part.vtk --measure radius_ratio --measure mean_ratio --json
  tetmend quality part.msh --list 20 --cells bad.vtu
  tetmend quality part.msh --goal 20,160 --limit
  tetmend quality results/*.vtu

Exit status: 0 success, 1 a file cannot be read, 2 wrong usage)",
                              ruler_list(kRulers), ruler_list(kSolverRulers), measure_list(),
                              mesh_format_list(), parts_help()));
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] {
      return run_quality(*options, invocation.array_files);
    };
  });
}

}  // namespace tetmend::apps
