// SPDX-License-Identifier: MIT
#include "viewer/mesh/tet_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "kernel/spaced.h"

namespace tetmend::viewer {

namespace {

template <class Visit>
void for_each_tet(const TetMesh& mesh, Visit visit) {
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (!mesh.is_deleted(TetHandle(i))) visit(TetHandle(i));
  }
}

}  // namespace

std::span<const TetValue> tet_values() {
  static const std::vector<TetValue> kValues = [] {
    std::vector<TetValue> all = {
        {"quality", "relative to the goal: below 1 the tet is bad", nullptr, {0, 2}}};
    for (const QualityMeasure& m : quality_measures()) {
      all.push_back({m.name, m.help, &m, {0, m.best}, m.name == "min_angle" ? "degrees" : ""});
    }
    return all;
  }();
  return kValues;
}

std::string TetValue::title() const {
  const std::string text = spaced(name);
  return unit.empty() ? text : fmt::format("{}, {}", text, unit);
}

const TetValue& find_tet_value(std::string_view name) {
  std::vector<std::string_view> names;
  for (const TetValue& value : tet_values()) {
    if (value.name == name) return value;
    names.push_back(value.name);
  }
  throw Error(fmt::format("unknown quality measure '{}'; valid: {}", name, fmt::join(names, ", ")));
}

float evaluate_tet(const TetMesh& mesh, const TetValue& value, TetHandle t) {
  if (mesh.is_deleted(t)) return std::numeric_limits<float>::quiet_NaN();
  if (value.measure == nullptr) return mesh.quality(t);
  const TetVertices& v = mesh.vertices(t);
  return static_cast<float>(value.measure->evaluate(mesh.point(v[0]), mesh.point(v[1]),
                                                    mesh.point(v[2]), mesh.point(v[3])));
}

std::vector<float> evaluate_tets(const TetMesh& mesh, const TetValue& value) {
  std::vector<float> values(mesh.tet_slots());
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    values[i] = evaluate_tet(mesh, value, TetHandle(i));
  }
  return values;
}

std::vector<std::uint32_t> distances_from_boundary(const TetMesh& mesh) {
  constexpr std::uint32_t kUnreached = 0xFFFFFFFFu;
  std::vector<std::uint32_t> layer(mesh.tet_slots(), kUnreached);
  std::vector<TetHandle> queue;
  queue.reserve(mesh.tet_count());
  for_each_tet(mesh, [&](TetHandle t) {
    const auto& n = mesh.neighbours(t);
    if (std::none_of(n.begin(), n.end(), [](HalfFace f) { return f.is_outside(); })) return;
    layer[t.index()] = 0;
    queue.push_back(t);
  });
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const TetHandle t = queue[next];
    for (const HalfFace n : mesh.neighbours(t)) {
      if (n.is_outside() || layer[n.tet().index()] != kUnreached) continue;
      layer[n.tet().index()] = layer[t.index()] + 1;
      queue.push_back(n.tet());
    }
  }
  return layer;
}

std::vector<TetHandle> worst_tets(std::span<const float> values, std::size_t count) {
  std::vector<TetHandle> tets;
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) tets.emplace_back(i);
  }
  const auto is_worse = [&](TetHandle a, TetHandle b) {
    const float x = values[a.index()];
    const float y = values[b.index()];
    return x < y || (x == y && a < b);
  };
  const auto end = tets.begin() + static_cast<std::ptrdiff_t>(std::min(count, tets.size()));
  std::nth_element(tets.begin(), end, tets.end(), is_worse);
  tets.erase(end, tets.end());
  std::sort(tets.begin(), tets.end(), is_worse);
  return tets;
}

std::vector<Label> region_labels(const TetMesh& mesh) {
  std::set<Label> labels;
  Label last = 0;
  for_each_tet(mesh, [&](TetHandle t) {
    if (labels.empty() || mesh.label(t) != last) labels.insert(mesh.label(t));
    last = mesh.label(t);
  });
  return {labels.begin(), labels.end()};
}

}  // namespace tetmend::viewer
