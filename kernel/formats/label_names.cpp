// SPDX-License-Identifier: MIT
// Names of labels: what a format can keep of groups where a set of elements has one number.
#include "kernel/formats/label_names.h"

#include <algorithm>
#include <optional>
#include <set>

#include "kernel/formats/element_kinds.h"

namespace tetmend::formats {
namespace {

/// Labels of the members of a group, with how many there are of each.
template <class Element>
std::map<Label, std::size_t> label_counts(const std::vector<Element>& elements,
                                          const std::vector<std::uint32_t>& members) {
  std::map<Label, std::size_t> counts;
  for (const std::uint32_t i : members) ++counts[elements[i].label];
  return counts;
}

}  // namespace

LabelNames::LabelNames(const MeshData& mesh) : mesh_(mesh) {
  const auto count = [&](int dimension, std::size_t size, const auto& label_at, const auto& parts) {
    auto& counts = counts_[static_cast<std::size_t>(dimension)];
    std::size_t* last = nullptr;
    std::pair<Label, Label> key;
    for (std::size_t i = 0; i < size; ++i) {
      const std::pair<Label, Label> now{label_at(i), parts.empty() ? 0 : parts[i]};
      if (last == nullptr || now != key) last = &counts[now.first][now.second];
      key = now;
      ++*last;
    }
  };
  const auto of = [](const auto& elements) {
    return [&elements](std::size_t i) { return elements[i].label; };
  };
  count(3, mesh.tets.size(), of(mesh.tets), mesh.tet_parts);
  count(2, mesh.triangles.size(), of(mesh.triangles), mesh.triangle_parts);
  count(1, mesh.edges.size(), of(mesh.edges), mesh.edge_parts);
  for (const OtherElements& others : mesh.other_elements) {
    const ElementKind* kind = element_kind(others.vtk_type);
    if (kind == nullptr) continue;
    count(
        kind->dimension, others.labels.size(), [&](std::size_t i) { return others.labels[i]; },
        others.parts);
  }
  for (std::size_t d = 0; d < counts_.size(); ++d) {
    for (const auto& [label, parts] : counts_[d]) {
      for (const auto& [part, size] : parts) {
        totals_[d][label] += size;
        labels_of_part_[d][part].push_back(label);
      }
    }
  }
}

NamedLabel LabelNames::label_of(const Group& group) const {
  if (group.dimension < 1 || group.dimension > 3) return {};
  const auto& counts = counts_[static_cast<std::size_t>(group.dimension)];
  if (group.parts.empty() && group.members.empty()) return {true, group.number};
  if (!group.members.empty()) {
    const auto labels = group.dimension == 3   ? label_counts(mesh_.tets, group.members)
                        : group.dimension == 2 ? label_counts(mesh_.triangles, group.members)
                                               : label_counts(mesh_.edges, group.members);
    if (labels.size() != 1) return {};
    const auto [label, count] = *labels.begin();
    return {totals_[static_cast<std::size_t>(group.dimension)].at(label) == count, label};
  }
  // All parts must have the same label, and only these.
  const auto& labels_of_part = labels_of_part_[static_cast<std::size_t>(group.dimension)];
  std::optional<Label> label;
  std::size_t inside = 0;
  for (const Label part : std::set<Label>(group.parts.begin(), group.parts.end())) {
    const auto labels = labels_of_part.find(part);
    if (labels == labels_of_part.end()) continue;
    if (labels->second.size() > 1 || (label && *label != labels->second[0])) return {};
    label = labels->second[0];
    ++inside;
  }
  return {label && inside == counts.at(*label).size(), label.value_or(0)};
}

std::map<Label, const Group*> LabelNames::named(int dimension) const {
  std::map<Label, const Group*> names;
  for (const Group& group : mesh_.groups) {
    if (group.dimension != dimension || group.name.empty()) continue;
    const NamedLabel found = label_of(group);
    if (found.found) names.try_emplace(found.label, &group);
  }
  return names;
}

}  // namespace tetmend::formats
