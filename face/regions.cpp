// SPDX-License-Identifier: MIT
// The part of a mesh that a run must leave as it is.
#include "face/regions.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/boundary_layers.h"
#include "kernel/from_chars.h"

namespace tetmend::face {

namespace {

constexpr std::string_view kLabel = "label:";
constexpr std::string_view kBox = "box:";

using Corners = std::array<Point, 4>;

/// Some labels, or a box.
struct Region {
  std::string option;  ///< whose value it is
  std::string spec;    ///< as the user wrote it, for messages
  std::vector<Label> labels;
  Eigen::AlignedBox3d box;  ///< empty when the region is one of labels

  bool is_box() const { return labels.empty(); }
  OptionError error(std::string_view reason) const {
    return {option, fmt::format("{} {}: {}", option, spec, reason)};
  }
  bool contains(Label label, const Corners& corners) const {
    if (!is_box()) return std::find(labels.begin(), labels.end(), label) != labels.end();
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Point& p) { return box.contains(p); });
  }
};

/// Numbers with commas between them; nothing when a part is no number.
template <class Number>
std::optional<std::vector<Number>> parse_list(std::string_view text) {
  std::vector<Number> numbers;
  for (;;) {
    const std::string_view word = text.substr(0, text.find(','));
    Number number{};
    const auto [end, error] = from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    numbers.push_back(number);
    if (word.size() == text.size()) return numbers;
    text.remove_prefix(word.size() + 1);
  }
}

Region parse(std::string_view option, std::string_view spec) {
  Region region{std::string(option), std::string(spec), {}, {}};
  const auto fail = [&](std::string_view reason) {
    return region.error(
        fmt::format("{}: expected label:L, label:L1,L2,... or box:x0,y0,z0,x1,y1,z1", reason));
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

bool contain(std::span<const Region> regions, const TetMesh& mesh, TetHandle t) {
  const TetVertices& v = mesh.vertices(t);
  const Corners corners = {mesh.point_in_file(v[0]), mesh.point_in_file(v[1]),
                           mesh.point_in_file(v[2]), mesh.point_in_file(v[3])};
  return std::any_of(regions.begin(), regions.end(),
                     [&](const Region& region) { return region.contains(mesh.label(t), corners); });
}

}  // namespace

struct Regions::Lists {
  std::vector<Region> protect, only;

  /// Those of `protect` first.
  template <class Visit>
  void for_each(const Visit& visit) const {
    std::size_t i = 0;
    for (const Region& region : protect) visit(i++, region);
    for (const Region& region : only) visit(i++, region);
  }
};

Regions::Regions(const Options& options) : lists_(std::make_unique<Lists>()) {
  lists_->protect = parse_all("protect", options.protect);
  lists_->only = parse_all("only", options.only);
}

Regions::~Regions() = default;

bool Regions::are_there() const {
  return !lists_->protect.empty() || !lists_->only.empty();
}

void Regions::Seen::merge(const Seen& other) {
  std::vector<Label> all;
  std::set_union(labels.begin(), labels.end(), other.labels.begin(), other.labels.end(),
                 std::back_inserter(all));
  labels = std::move(all);
  box[0] = box[0].cwiseMin(other.box[0]).eval();
  box[1] = box[1].cwiseMax(other.box[1]).eval();
  found.resize(std::max(found.size(), other.found.size()), 0);
  for (std::size_t i = 0; i < other.found.size(); ++i) {
    if (other.found[i] != 0) found[i] = 1;
  }
}

void Regions::see(Label label, const Corners& corners, Seen& seen) const {
  const auto place = std::lower_bound(seen.labels.begin(), seen.labels.end(), label);
  if (place == seen.labels.end() || *place != label) seen.labels.insert(place, label);
  for (const Point& p : corners) {
    seen.box[0] = seen.box[0].cwiseMin(p).eval();
    seen.box[1] = seen.box[1].cwiseMax(p).eval();
  }
  seen.found.resize(lists_->protect.size() + lists_->only.size(), 0);
  lists_->for_each([&](std::size_t i, const Region& region) {
    if (region.is_box() && seen.found[i] == 0 && region.contains(label, corners)) seen.found[i] = 1;
  });
}

bool Regions::protect(Label label, const Corners& corners) const {
  const auto contain = [&](const std::vector<Region>& regions) {
    return std::any_of(regions.begin(), regions.end(),
                       [&](const Region& region) { return region.contains(label, corners); });
  };
  return contain(lists_->protect) || (!lists_->only.empty() && !contain(lists_->only));
}

/// Every label of each region has a tet, every box holds one.
void Regions::check(const Seen& seen) const {
  const std::vector<Label>& labels = seen.labels;
  lists_->for_each([&](std::size_t i, const Region& region) {
    for (const Label label : region.labels) {
      if (std::binary_search(labels.begin(), labels.end(), label)) continue;
      constexpr std::size_t kMostListed = 20;
      const std::size_t count = std::min(kMostListed, labels.size());
      throw region.error(fmt::format(
          "no tet has label {}: the mesh has {}{}", label,
          fmt::join(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(count), ", "),
          count < labels.size() ? ", ..." : ""));
    }
    if (!region.is_box() || (i < seen.found.size() && seen.found[i] != 0)) return;
    const auto& [low, high] = seen.box;
    throw region.error(fmt::format("no tet lies in the box: the mesh fills {},{},{},{},{},{}",
                                   low.x(), low.y(), low.z(), high.x(), high.y(), high.z()));
  });
}

void check_regions(const Options& options) {
  const Regions regions(options);
}

void find_regions(const MeshData& data, const Options& options) {
  const Regions regions(options);
  if (!regions.are_there()) return;
  Regions::Seen seen;
  for (const MeshData::Tet& tet : data.tets) {
    const auto& v = tet.vertices;
    regions.see(tet.label,
                {data.points[v[0]], data.points[v[1]], data.points[v[2]], data.points[v[3]]}, seen);
  }
  regions.check(seen);
}

ProtectedPart protect(TetMesh& mesh, const Options& options) {
  ProtectedPart part;
  const std::vector<Region> protect = parse_all("protect", options.protect);
  const std::vector<Region> only = parse_all("only", options.only);
  BoundaryLayers layers;
  if (options.layers == Layers::keep) layers = find_boundary_layers(mesh);
  if (protect.empty() && only.empty() && layers.tets.empty()) return part;

  const auto is_bad = [&](TetHandle t) { return mesh.quality(t) < kBadThreshold; };
  part.layer_tets = layers.tets.size();
  std::vector<char> in_layer(mesh.tet_slots(), 0);
  for (const TetHandle t : layers.tets) {
    in_layer[t.index()] = 1;
    part.layer_bad_tets += is_bad(t) ? 1 : 0;
  }
  mesh.freeze([&](TetHandle t) {
    if (!contain(protect, mesh, t) && (only.empty() || contain(only, mesh, t))) {
      return in_layer[t.index()] != 0;
    }
    ++part.tets;
    part.bad_tets += is_bad(t) ? 1 : 0;
    return true;
  });
  return part;
}

}  // namespace tetmend::face
