// SPDX-License-Identifier: MIT
// The part of a mesh that a command works on.
#include "apps/regions.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <span>
#include <string_view>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "apps/commands.h"

namespace tetmend::apps {
namespace {

constexpr std::string_view kLabel = "label:";
constexpr std::string_view kBox = "box:";

/// Some labels, or a box.
struct Region {
  std::string option;  ///< as the user wrote it, for messages
  std::vector<Label> labels;
  Eigen::AlignedBox3d box;  ///< empty when the region is one of labels

  bool is_box() const { return labels.empty(); }
  bool contains(const TetMesh& mesh, TetHandle t) const {
    if (!is_box()) return std::find(labels.begin(), labels.end(), mesh.label(t)) != labels.end();
    const TetVertices& v = mesh.vertices(t);
    return std::all_of(v.begin(), v.end(),
                       [&](VertexHandle w) { return box.contains(mesh.point(w)); });
  }
};

/// Numbers with commas between them; nothing when a part is no number.
template <class Number>
std::optional<std::vector<Number>> parse_list(std::string_view text) {
  std::vector<Number> numbers;
  for (;;) {
    const std::string_view word = text.substr(0, text.find(','));
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    numbers.push_back(number);
    if (word.size() == text.size()) return numbers;
    text.remove_prefix(word.size() + 1);
  }
}

Region parse(std::string_view option, std::string_view spec) {
  Region region{fmt::format("{} {}", option, spec), {}, {}};
  const auto fail = [&](std::string_view reason) {
    return UsageError(
        fmt::format("{}: {}: expected label:L, label:L1,L2,... or box:x0,y0,z0,x1,y1,z1",
                    region.option, reason));
  };
  if (spec.starts_with(kLabel)) {
    const auto labels = parse_list<Label>(spec.substr(kLabel.size()));
    if (!labels) throw fail("a label is not a whole number");
    region.labels = *labels;
    return region;
  }
  if (!spec.starts_with(kBox)) throw fail("there is no such region");
  const auto numbers = parse_list<double>(spec.substr(kBox.size()));
  if (!numbers) throw fail("a coordinate is not a number");
  if (numbers->size() != 6) throw fail(fmt::format("{} coordinates, not 6", numbers->size()));
  const std::vector<double>& x = *numbers;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(x[i] <= x[i + 3])) throw fail("the first corner is not below the second");
  }
  region.box = {Point(x[0], x[1], x[2]), Point(x[3], x[4], x[5])};
  return region;
}

std::vector<Region> parse_all(std::string_view option, const std::vector<std::string>& specs) {
  std::vector<Region> regions;
  for (const std::string& spec : specs) regions.push_back(parse(option, spec));
  return regions;
}

template <class Visit>
void for_each_tet(const TetMesh& mesh, Visit&& visit) {
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (!mesh.is_deleted(TetHandle(i))) visit(TetHandle(i));
  }
}

/// Every label of each region has a tet, every box holds one.
void check_not_empty(const TetMesh& mesh, std::span<const Region> regions) {
  if (regions.empty()) return;
  std::set<Label> labels;
  Eigen::AlignedBox3d bounds;
  std::vector<char> found(regions.size(), 0);
  for_each_tet(mesh, [&](TetHandle t) {
    labels.insert(mesh.label(t));
    for (const VertexHandle v : mesh.vertices(t)) bounds.extend(mesh.point(v));
    for (std::size_t i = 0; i < regions.size(); ++i) {
      if (regions[i].is_box() && !found[i]) found[i] = regions[i].contains(mesh, t);
    }
  });
  for (std::size_t i = 0; i < regions.size(); ++i) {
    for (const Label label : regions[i].labels) {
      if (labels.contains(label)) continue;
      constexpr std::size_t kMostListed = 20;
      const auto listed = std::vector<Label>(labels.begin(), labels.end());
      const std::size_t count = std::min(kMostListed, listed.size());
      throw Error(fmt::format("{}: no tet has label {}: the mesh has {}{}", regions[i].option,
                              label, fmt::join(listed.begin(), listed.begin() + count, ", "),
                              count < listed.size() ? ", ..." : ""));
    }
    if (!regions[i].is_box() || found[i]) continue;
    const Point& low = bounds.min();
    const Point& high = bounds.max();
    throw Error(fmt::format("{}: no tet lies in the box: the mesh fills {},{},{},{},{},{}",
                            regions[i].option, low.x(), low.y(), low.z(), high.x(), high.y(),
                            high.z()));
  }
}

bool contain(std::span<const Region> regions, const TetMesh& mesh, TetHandle t) {
  return std::any_of(regions.begin(), regions.end(),
                     [&](const Region& region) { return region.contains(mesh, t); });
}

}  // namespace

void add_region_options(CLI::App& command, RegionOptions& options) {
  // One SPEC for each mention of the option, so that IN may follow.
  command.add_option("--protect", options.protect, "Leave these tets as they are; repeatable")
      ->type_name("SPEC")
      ->allow_extra_args(false);
  command.add_option("--only", options.only, "Leave all other tets as they are; repeatable")
      ->type_name("SPEC")
      ->allow_extra_args(false);
  command.add_flag("--ignore-interior", options.ignore_interior,
                   "Drop the triangles, edges and required\n"
                   "vertices that the file names inside a region");
}

std::string region_help() {
  return R"(A SPEC is one of
  label:1,4                the tets with label 1 or 4
  box:x0,y0,z0,x1,y1,z1    the tets with all four vertices in the box, its
                           surface included; inf and -inf are allowed
--protect prevails over --only. Protected tets keep their vertices, bit for bit.

What the file names inside a region - triangles with tets of the same label on
both sides, edges and required vertices - is respected, unless
--ignore-interior drops it; what was dropped is not written to OUT. The surface
and the faces between different labels are respected always.)";
}

void check_regions(const RegionOptions& options) {
  parse_all("--protect", options.protect);
  parse_all("--only", options.only);
}

ProtectedPart protect_regions(TetMesh& mesh, const RegionOptions& options) {
  ProtectedPart part;
  part.asked_for = !options.protect.empty() || !options.only.empty();
  if (!part.asked_for) return part;
  const std::vector<Region> protect = parse_all("--protect", options.protect);
  const std::vector<Region> only = parse_all("--only", options.only);
  check_not_empty(mesh, protect);
  check_not_empty(mesh, only);
  part.tets = mesh.freeze([&](TetHandle t) {
    return contain(protect, mesh, t) || (!only.empty() && !contain(only, mesh, t));
  });
  for_each_tet(mesh, [&](TetHandle t) {
    if (mesh.is_frozen(t) && mesh.quality(t) < kBadThreshold) ++part.bad_tets;
  });
  return part;
}

nlohmann::json to_json(const ProtectedPart& part) {
  return {{"tets", part.tets}, {"bad_tets", part.bad_tets}};
}

}  // namespace tetmend::apps
