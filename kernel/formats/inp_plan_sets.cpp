// SPDX-License-Identifier: MIT
// The sets of an Abaqus deck: what they list, and those that the deck did not have.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_plan.h"

namespace tetmend::formats {
namespace {

/// The name of a block made here is known last; until then its line has no end.
bool is_unfinished(const InpPiece& piece) {
  return piece.kind == InpPieceKind::elements && piece.text.back() != '\n';
}

}  // namespace

/// Makes pieces for groups that the deck does not list.
class InpPlan::SetMaker {
 public:
  explicit SetMaker(InpPlan& plan) : plan_(plan) {
    for (const InpPiece& piece : plan.deck.pieces) {
      if (is_unfinished(piece)) continue;
      for (const InpGroupName& name : piece.groups) {
        listed_[name] = true;
        const std::size_t g = plan.find_group(name);
        if (g == SIZE_MAX) continue;
        (name.dimension == 0 ? node_sets_ : element_sets_).take(plan.groups[g].name);
      }
    }
    with_elements_.resize(plan.groups.size());
    with_faces_.resize(plan.groups.size());
    for (const InpClass& each : plan.classes) {
      for (const std::size_t g : each.groups)
        (each.block != 0 ? with_elements_ : with_faces_)[g] = 1;
    }
  }

  void add_required() {
    add(InpPieceKind::node_set, "*NSET, NSET=", inp_name("RequiredVertices", node_sets_), {-1, 0});
  }

  /// A surface comes with the set of its nodes, for boundary conditions are on nodes.
  void add_group(std::size_t g) {
    InpOutGroup& group = plan_.groups[g];
    const InpGroupName name{group.dimension, group.number};
    if (listed_.contains(name)) return;
    const int dimension = name.dimension % 10;
    if (dimension == 0) {
      return add(InpPieceKind::node_set, "*NSET, NSET=", inp_name(group.name, node_sets_), name);
    }
    const std::string given = group.name;
    if (with_elements_[g] != 0) {
      group.name = inp_name(given, element_sets_);
      add(InpPieceKind::element_set, "*ELSET, ELSET=", group.name, name);
    }
    if (with_faces_[g] == 0) return;
    if (dimension == 2) {
      add(InpPieceKind::surface, "*SURFACE, TYPE=ELEMENT, NAME=", inp_name(given, surfaces_), name);
    }
    const bool is_named = group.group != nullptr && !group.group->name.empty();
    if (!is_named && dimension != 1) return;
    const std::string set = is_named ? given : fmt::format("Edges_{}", name.number);
    add(InpPieceKind::node_set, "*NSET, NSET=", inp_name(set, node_sets_), name);
  }

  std::vector<InpPiece> take() { return std::move(made_); }

 private:
  void add(InpPieceKind kind, const char* card, const std::string& name, InpGroupName group) {
    InpPiece& piece = made_.emplace_back();
    piece.kind = kind;
    piece.text = fmt::format("{}{}\n", card, name);
    piece.groups = {group};
  }

  InpPlan& plan_;
  std::map<InpGroupName, bool> listed_;
  UniqueNames node_sets_{inp_key}, element_sets_{inp_key}, surfaces_{inp_key};
  std::vector<char> with_elements_, with_faces_;
  std::vector<InpPiece> made_;
};

void InpPlan::add_missing_sets() {
  for (std::uint32_t i = 0; i < mesh_.point_count(); ++i) {
    if (mesh_.point_label(i) == 0) continue;
    label_group(0, mesh_.point_label(i));
    points_of_label_[mesh_.point_label(i)].push_back(i);
  }
  index_classes();
  SetMaker maker(*this);
  if (!mesh_.required_vertices().empty() && !has_deck_) maker.add_required();
  for (std::size_t g = 0; g < groups.size(); ++g) maker.add_group(g);
  for (InpPiece& piece : deck.pieces) {
    if (!is_unfinished(piece)) continue;
    if (!piece.groups.empty()) piece.text += ", ELSET=" + groups[find_group(piece.groups[0])].name;
    piece.text += '\n';
  }
  place_new(maker.take());
}

void InpPlan::index_classes() {
  classes_of_group_.resize(groups.size());
  for (std::size_t c = 0; c < classes.size(); ++c) {
    for (const std::size_t g : classes[c].groups) classes_of_group_[g].push_back(c);
    classes_of_block_[classes[c].block].push_back(c);
  }
}

std::size_t InpPlan::find_group(const InpGroupName& name) const {
  const auto found = group_of_name_.find(name);
  return found == group_of_name_.end() ? SIZE_MAX : found->second;
}

bool InpPlan::is_home(Label block, std::size_t group) const {
  const auto found = home_of_block_.find(block);
  if (found == home_of_block_.end()) return false;
  const InpGroupName name{groups[group].dimension, groups[group].number};
  return std::find(found->second.begin(), found->second.end(), name) != found->second.end();
}

std::vector<std::int64_t> InpPlan::elements_of(const std::vector<InpGroupName>& names) const {
  std::vector<std::int64_t> numbers;
  for (const InpGroupName& name : names) {
    const std::size_t g = find_group(name);
    if (g == SIZE_MAX) continue;
    for (const std::size_t c : classes_of_group_[g]) {
      if (classes[c].block == 0 || is_home(classes[c].block, g)) continue;
      const InpKind& kind = kinds[classes[c].kind];
      for (const std::uint32_t i : kind.by_class.group(static_cast<std::uint32_t>(c))) {
        numbers.push_back(kind.numbers[i]);
      }
    }
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::vector<std::int64_t> InpPlan::numbers_of_points(std::vector<std::uint32_t> points) const {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<std::int64_t> numbers;
  for (const std::uint32_t point : points) numbers.push_back(point_numbers[point]);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::vector<std::int64_t> InpPlan::nodes_of(const InpGroupName& name) const {
  if (name.dimension < 0) {
    const auto& required = mesh_.required_vertices();
    return numbers_of_points({required.begin(), required.end()});
  }
  const std::size_t g = find_group(name);
  if (g == SIZE_MAX) return {};
  std::vector<std::uint32_t> points;
  if (name.dimension % 10 == 0) {
    const Group* group = groups[g].group;
    if (group != nullptr) points = group->members;
    const bool by_label = group == nullptr || (group->members.empty() && group->parts.empty());
    const auto found = points_of_label_.find(name.number);
    if (by_label && found != points_of_label_.end()) points = found->second;
    return numbers_of_points(std::move(points));
  }
  for (const std::size_t c : classes_of_group_[g]) {
    const InpKind& kind = kinds[classes[c].kind];
    for (const std::uint32_t i : kind.by_class.group(static_cast<std::uint32_t>(c))) {
      points.insert(points.end(), kind.of(i), kind.of(i) + kind.width);
    }
  }
  return numbers_of_points(std::move(points));
}

std::vector<std::pair<std::int64_t, int>> InpPlan::faces_of(const InpGroupName& name) const {
  std::vector<std::pair<std::int64_t, int>> faces;
  const std::size_t g = find_group(name);
  if (g == SIZE_MAX) return faces;
  for (const std::size_t c : classes_of_group_[g]) {
    const std::size_t k = classes[c].kind;
    if (!owners_.contains(k)) continue;
    for (const std::uint32_t i : kinds[k].by_class.group(static_cast<std::uint32_t>(c))) {
      const Owner& owner = owners(k)[i];
      if (owner.face != 0) faces.emplace_back(kinds[owner.kind].numbers[owner.element], owner.face);
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

std::vector<InpPlan::Row> InpPlan::rows_of(Label block) const {
  std::vector<Row> rows;
  const auto found = classes_of_block_.find(block);
  if (found == classes_of_block_.end() || block == 0) return rows;
  for (const std::size_t c : found->second) {
    const auto kind = static_cast<std::uint32_t>(classes[c].kind);
    for (const std::uint32_t i : kinds[kind].by_class.group(static_cast<std::uint32_t>(c))) {
      rows.push_back({kind, i});
    }
  }
  const auto less = [](const Row& a, const Row& b) {
    return std::pair(a.kind, a.element) < std::pair(b.kind, b.element);
  };
  if (!std::is_sorted(rows.begin(), rows.end(), less)) std::sort(rows.begin(), rows.end(), less);
  return rows;
}

}  // namespace tetmend::formats
