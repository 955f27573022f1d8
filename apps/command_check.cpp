// SPDX-License-Identifier: MIT
// tetmend check: does a mesh keep what a solver, or its input, asks of it?
//
//   of one mesh: thresholds of angles and measures, inverted tets, as asked for or as a preset says
//   of two: the same surface, walls, labels, volumes, groups, and nothing worse; computed from the
//   two files alone
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <tetmend/io.h>
#include <tetmend/measure.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/threads.h"
#include "kernel/curved.h"
#include "kernel/exact_orientation.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/geometry.h"

namespace tetmend::apps {
namespace {

struct Options {
  std::filesystem::path file;
  std::filesystem::path improved;
  double min_dihedral = 0;
  double max_dihedral = 180;
  bool no_inverted = false;
  std::vector<std::string> measures;  ///< NAME=VALUE
  std::string preset;
  bool json = false;
  int threads = 1;
  std::string format;
};

/// What was looked at, and whether it holds.
struct Fact {
  std::string name;  ///< for programs
  bool holds = true;
  std::string text;  ///< for people
  nlohmann::json value;
  nlohmann::json wanted;
};

/// What a solver asks of a mesh of linear tets, and where that is said.
struct Preset {
  std::string_view name;
  std::string_view source;
  std::vector<std::pair<Ruler, double>> rulers;
};

const std::vector<Preset>& presets() {
  static const std::vector<Preset> kPresets = {
      {"calculix", "ccx ends with status 201 at an element whose Jacobian is not positive", {}},
      {"fenicsx", "the Jacobian of an affine cell must not vanish, nor change its sign", {}},
      {"openfoam",
       "limits of checkMesh: non-orthogonality 70, skewness 4, aspect ratio 1000",
       {{Ruler::non_orthogonality, 70}, {Ruler::skewness, 4}, {Ruler::aspect_ratio, 1000}}},
      {"su2", "the dual volumes of a mesh must be positive", {}}};
  return kPresets;
}

const Preset& find_preset(const std::string& name) {
  std::vector<std::string_view> names;
  for (const Preset& preset : presets()) {
    if (preset.name == name) return preset;
    names.push_back(preset.name);
  }
  throw UsageError(
      fmt::format("--for: '{}' is no preset: expected one of {}", name, fmt::join(names, ", ")));
}

const RulerInfo& info(Ruler ruler) {
  return kRulers[static_cast<std::size_t>(ruler)];
}

std::pair<Ruler, double> to_threshold(const std::string& text) {
  const std::size_t equals = text.find('=');
  double value = 0;
  if (equals != std::string::npos) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + equals + 1, end, value);
    if (error == std::errc() && stop == end) {
      for (std::size_t i = 0; i < kRulerCount; ++i) {
        if (kRulers[i].name == text.substr(0, equals)) return {static_cast<Ruler>(i), value};
      }
    }
  }
  std::vector<std::string_view> names;
  for (const RulerInfo& each : kRulers) names.push_back(each.name);
  throw UsageError(
      fmt::format("--measure: '{}' is no threshold such as mean_ratio=0.1: expected one of {}",
                  text, fmt::join(names, ", ")));
}

// ---- One mesh -----------------------------------------------------------------------------------

Fact at_least(std::string name, std::string_view what, double value, double wanted) {
  return {std::move(name), value >= wanted,
          fmt::format("{} {:.6g}, wanted at least {:.6g}", what, value, wanted), value, wanted};
}
Fact at_most(std::string name, std::string_view what, double value, double wanted) {
  return {std::move(name), value <= wanted,
          fmt::format("{} {:.6g}, wanted at most {:.6g}", what, value, wanted), value, wanted};
}

Fact no_inverted(const MeshData& mesh, std::size_t allowed = 0) {
  std::size_t count = 0;
  std::optional<std::size_t> first;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& v = mesh.tets[t].vertices;
    const auto point = [&](std::size_t k) { return mesh.points[v[k]]; };
    if (exact_orientation(point(0), point(1), point(2), point(3)) > 0) continue;
    if (count++ == 0) first = t;
  }
  std::string text = "no inverted or flat tet, in exact arithmetic";
  if (first) {
    text = fmt::format("{} inverted or flat {}, the first is tet {} (from 1)", grouped(count),
                       count == 1 ? "tet" : "tets", *first + 1);
    if (allowed > 0) text += fmt::format("; there were {}", grouped(allowed));
  }
  return {"inverted", count <= allowed, text, count, allowed};
}

std::vector<Fact> check_one(const Options& options) {
  const Mesh mesh = load(options.file, options.threads);
  std::vector<std::pair<Ruler, double>> thresholds;
  if (!options.preset.empty()) thresholds = find_preset(options.preset).rulers;
  for (const std::string& text : options.measures) thresholds.push_back(to_threshold(text));
  std::vector<Fact> facts;
  if (options.no_inverted || !options.preset.empty()) {
    facts.push_back(no_inverted(read_mesh(options.file)));
  }
  const Measurement measured = measure(mesh, {.threads = options.threads});
  if (measured.curved && (options.no_inverted || !options.preset.empty())) {
    facts.push_back(at_most("turned_over", "curved tets turned over",
                            static_cast<double>(measured.curved->turned_over), 0));
  }
  if (options.min_dihedral > 0) {
    facts.push_back(at_least("theta_min", "smallest dihedral angle", measured.statistics.theta_min,
                             options.min_dihedral));
  }
  if (options.max_dihedral < 180) {
    facts.push_back(at_most("theta_max", "largest dihedral angle", measured.statistics.theta_max,
                            options.max_dihedral));
  }
  for (const auto& [ruler, wanted] : thresholds) {
    const RulerInfo& of = info(ruler);
    const std::string what = fmt::format("worst {}", of.title);
    const double worst = (*measured.rulers)[ruler].worst;
    facts.push_back(of.large_is_good ? at_least(std::string(of.name), what, worst, wanted)
                                     : at_most(std::string(of.name), what, worst, wanted));
  }
  return facts;
}

// ---- Two meshes ---------------------------------------------------------------------------------

using Bits = std::array<std::uint64_t, 3>;

/// A triangle by the bits of its corners, whatever the numbers of its vertices, and what is on its
/// two sides.
struct Wall {
  std::array<Bits, 3> corners{};
  std::array<Label, 2> labels{};
  bool is_boundary = true;
  friend auto operator<=>(const Wall&, const Wall&) = default;
};

Bits bits_of(const Point& p) {
  return {std::bit_cast<std::uint64_t>(p.x()), std::bit_cast<std::uint64_t>(p.y()),
          std::bit_cast<std::uint64_t>(p.z())};
}

std::array<Bits, 3> corners_of(const MeshData& mesh, const std::array<std::uint32_t, 3>& vertices) {
  std::array<Bits, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) corners[k] = bits_of(mesh.points[vertices[k]]);
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Faces with one tet, or with two of different labels.
std::vector<Wall> walls_of(const MeshData& mesh) {
  struct Face {
    std::array<std::uint32_t, 3> vertices;
    Label label;
  };
  std::vector<Face> faces;
  faces.reserve(4 * mesh.tets.size());
  for (const MeshData::Tet& tet : mesh.tets) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      Face face{{}, tet.label};
      for (std::size_t k = 0; k < 3; ++k) face.vertices[k] = tet.vertices[k < left_out ? k : k + 1];
      std::sort(face.vertices.begin(), face.vertices.end());
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return std::pair(a.vertices, a.label) < std::pair(b.vertices, b.label);
  });
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < faces.size();) {
    const bool is_pair = i + 1 < faces.size() && faces[i + 1].vertices == faces[i].vertices;
    const Label other = faces[is_pair ? i + 1 : i].label;
    if (!is_pair || other != faces[i].label) {
      walls.push_back({corners_of(mesh, faces[i].vertices), {faces[i].label, other}, !is_pair});
    }
    i += is_pair ? 2 : 1;
  }
  std::sort(walls.begin(), walls.end());
  return walls;
}

std::vector<std::pair<std::array<Bits, 3>, Label>> named_triangles(const MeshData& mesh) {
  std::vector<std::pair<std::array<Bits, 3>, Label>> triangles;
  for (const MeshData::Triangle& triangle : mesh.triangles) {
    triangles.emplace_back(corners_of(mesh, triangle.vertices), triangle.label);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

template <class T>
std::size_t count_differences(const std::vector<T>& a, const std::vector<T>& b) {
  std::vector<T> differing;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(),
                                std::back_inserter(differing));
  return differing.size();
}

template <class T>
Fact same(std::string name, std::string_view what, const std::vector<T>& before,
          const std::vector<T>& after) {
  const std::size_t differing = count_differences(before, after);
  const std::string text =
      differing == 0
          ? fmt::format("{}: the same {}, bit for bit", what, grouped(before.size()))
          : fmt::format("{}: {} and {}, {} of them in one mesh only", what, grouped(before.size()),
                        grouped(after.size()), grouped(differing));
  return {std::move(name), differing == 0, text, differing, 0};
}

std::map<Label, double> volumes_of(const MeshData& mesh) {
  std::map<Label, double> volumes;
  for (const MeshData::Tet& tet : mesh.tets) {
    const auto& v = tet.vertices;
    volumes[tet.label] +=
        volume6(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]) / 6;
  }
  return volumes;
}

/// Volumes of inverted tets count as they are, so the sum over a region depends on its walls alone.
std::vector<Fact> same_volumes(const MeshData& before, const MeshData& after) {
  constexpr double kRounding = 1e-9;
  const std::map<Label, double> then = volumes_of(before);
  const std::map<Label, double> now = volumes_of(after);
  std::vector<Fact> facts;
  for (const auto& [label, volume] : then) {
    const auto found = now.find(label);
    const double other = found == now.end() ? 0 : found->second;
    const double change = std::abs(other - volume) / std::max(std::abs(volume), 1e-300);
    facts.push_back({"volume", change <= kRounding,
                     fmt::format("volume of label {}: {:.9g}, was {:.9g}", label, other, volume),
                     other, volume});
  }
  for (const auto& [label, volume] : now) {
    if (then.contains(label)) continue;
    facts.push_back({"volume", false, fmt::format("label {} is new", label), volume, nullptr});
  }
  return facts;
}

/// Of edges that had to stay.
std::vector<Bits> fixed_mid_nodes(const MeshData& mesh) {
  const std::vector<bool> is_fixed = find_fixed_mid_nodes(mesh, true).is_fixed;
  std::vector<Bits> nodes;
  for (std::size_t i = 0; i < is_fixed.size(); ++i) {
    if (is_fixed[i]) nodes.push_back(bits_of(mesh.points[mesh.mid_nodes[i][2]]));
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

void add_second_order(const CurvedStatistics& was, const CurvedStatistics& is,
                      std::vector<Fact>& facts) {
  facts.push_back(at_most("turned_over", "curved tets turned over",
                          static_cast<double>(is.turned_over),
                          static_cast<double>(was.turned_over)));
  facts.push_back(at_least("jacobian_ratio", "worst Jacobian ratio at the nodes", is.worst.at_nodes,
                           was.worst.at_nodes));
  facts.push_back(at_least("jacobian_bound", "worst bound of a Jacobian ratio", is.worst.bound,
                           was.worst.bound));
}

std::vector<std::string> group_names(const MeshData& mesh) {
  std::vector<std::string> names;
  for (const Group& group : mesh.groups) {
    names.push_back(fmt::format("{} {} '{}'", group.dimension, group.number, group.name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<Fact> check_two(const Options& options) {
  const MeshData before = read_mesh(options.file);
  const MeshData after = read_mesh(options.improved);
  std::vector<Wall> then = walls_of(before);
  std::vector<Wall> now = walls_of(after);
  const auto split = [](std::vector<Wall>& walls) {
    const auto middle = std::stable_partition(walls.begin(), walls.end(),
                                              [](const Wall& wall) { return wall.is_boundary; });
    std::vector<Wall> inner(middle, walls.end());
    walls.erase(middle, walls.end());
    return inner;
  };
  const std::vector<Wall> inner_then = split(then);
  const std::vector<Wall> inner_now = split(now);
  std::vector<Fact> facts;
  facts.push_back(same("surface", "triangles of the surface", then, now));
  facts.push_back(same("walls", "faces between two labels", inner_then, inner_now));
  facts.push_back(same("triangles", "named triangles with labels", named_triangles(before),
                       named_triangles(after)));
  facts.push_back(same("groups", "groups", group_names(before), group_names(after)));
  for (Fact& fact : same_volumes(before, after)) facts.push_back(std::move(fact));
  facts.push_back(no_inverted(after, no_inverted(before).value.get<std::size_t>()));
  if (!before.mid_nodes.empty() || !after.mid_nodes.empty()) {
    facts.push_back(same("mid_nodes", "mid-side nodes of edges that stay", fixed_mid_nodes(before),
                         fixed_mid_nodes(after)));
  }
  const MeasureOptions wanted = {.threads = options.threads};
  const Measurement first = measure(load(options.file, options.threads), wanted);
  const Measurement second = measure(load(options.improved, options.threads), wanted);
  if (first.curved && second.curved) add_second_order(*first.curved, *second.curved, facts);
  const MeshStatistics& was = first.statistics;
  const MeshStatistics& is = second.statistics;
  facts.push_back(at_least("theta_min", "smallest dihedral angle", is.theta_min, was.theta_min));
  facts.push_back(at_most("theta_max", "largest dihedral angle", is.theta_max,
                          std::max(was.theta_max, Goal().max_angle)));
  facts.push_back(
      at_most("n_bad", "bad tets", static_cast<double>(is.n_bad), static_cast<double>(was.n_bad)));
  return facts;
}

// -------------------------------------------------------------------------------------------------

void print(const Options& options, const std::vector<Fact>& facts, bool holds) {
  if (!options.json) {
    for (const Fact& fact : facts) fmt::print("{}  {}\n", fact.holds ? "ok  " : "FAIL", fact.text);
    return;
  }
  nlohmann::json list = nlohmann::json::array();
  for (const Fact& fact : facts) {
    list.push_back({{"name", fact.name},
                    {"holds", fact.holds},
                    {"text", fact.text},
                    {"value", fact.value},
                    {"wanted", fact.wanted}});
  }
  nlohmann::json result = {
      {"schema", 1}, {"file", options.file.string()}, {"holds", holds}, {"facts", list}};
  if (!options.improved.empty()) result["improved"] = options.improved.string();
  fmt::print("{}\n", result.dump(2));
}

int run_check(Options& options) {
  name_streams(options.format, options.file, nullptr);
  check_mesh_extension(options.file);
  if (!options.improved.empty()) check_mesh_extension(options.improved);
  const bool asks = options.min_dihedral > 0 || options.max_dihedral < 180 || options.no_inverted ||
                    !options.measures.empty() || !options.preset.empty();
  if (!asks && options.improved.empty()) {
    throw UsageError(
        "nothing to check: give a threshold, --for PRESET or a second mesh (see tetmend check "
        "--help)");
  }
  std::vector<Fact> facts;
  if (!options.improved.empty()) facts = check_two(options);
  if (asks) {
    Options one = options;
    if (!options.improved.empty()) one.file = options.improved;
    for (Fact& fact : check_one(one)) facts.push_back(std::move(fact));
  }
  const bool holds =
      std::all_of(facts.begin(), facts.end(), [](const Fact& fact) { return fact.holds; });
  print(options, facts, holds);
  return holds ? kSuccess : kGoalMissed;
}

std::string preset_help() {
  std::string text;
  for (const Preset& preset : presets())
    text += fmt::format("  {:<9} {}\n", preset.name, preset.source);
  return text;
}

}  // namespace

void add_check(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("check", "Prove what a mesh, or a result, promises");
  command->add_option("FILE", options->file, "Mesh")->required()->type_name("");
  command->add_option("OUT", options->improved, "What became of it: compared with FILE")
      ->type_name("");
  command->add_option("--min-dihedral", options->min_dihedral, "No smaller dihedral angle")
      ->type_name("DEGREES")
      ->check(CLI::Range(0.0, 71.0));
  command->add_option("--max-dihedral", options->max_dihedral, "No larger dihedral angle")
      ->type_name("DEGREES")
      ->check(CLI::Range(70.0, 180.0));
  command->add_flag(
      "--no-inverted", options->no_inverted,
      "No inverted or flat tet, in exact arithmetic, as the\nfile lists its vertices");
  command
      ->add_option("--measure", options->measures,
                   "Worst value of a ruler of tetmend quality, such as\nmean_ratio=0.1; repeatable")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->take_all();
  command->add_option("--for", options->preset, "What a solver asks, see below")
      ->type_name("PRESET");
  command->add_flag("--json", options->json, "Print JSON (docs/check.schema.json)");
  add_format_option(*command, options->format);
  add_threads_option(*command, options->threads);
  command->footer(fmt::format(
      R"(Prints a line for each fact. With two meshes, from the files alone: the same
surface, bit for bit, the same faces between labels, named triangles and groups,
the same volume of each label, no inverted tet, no smaller theta_min, no larger
theta_max unless the goal allows it, not more bad tets. Thresholds are then
asked of OUT.

Presets; all of them ask for no inverted tet:
{}
Examples:
  tetmend check part.mesh --min-dihedral 15 --max-dihedral 165 --no-inverted
  tetmend check part.vtu --for openfoam --json
  tetmend check part.mesh better.mesh

Exit status: 0 all of it holds, 3 something does not, 1 a file cannot be read,
2 wrong usage)",
      preset_help()));
  command->callback(
      [options, &invocation] { invocation.action = [options] { return run_check(*options); }; });
}

}  // namespace tetmend::apps
