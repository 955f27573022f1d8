// SPDX-License-Identifier: MIT
#include "kernel/formats/med_labels.h"

#include <algorithm>

#include <fmt/format.h>

#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_sets.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/med.h"

namespace tetmend::formats {

void MedLabels::read_families(const Hdf5Reader& file, const std::string& path) {
  if (!file.has(path)) return;
  for (const bool of_nodes : {true, false}) {
    const std::string all = path + (of_nodes ? "/NOEUD" : "/ELEME");
    if (!file.has(all)) continue;
    for (const std::string& name : file.names(all)) {
      const std::string family = all + "/" + name;
      const std::int64_t number = file.integer(family, "NUM");
      if (number <= INT32_MIN || number > INT32_MAX)
        file.fail(family, "the number of the family has more than 32 bits");
      std::vector<std::string>& groups = groups_of_[of_nodes][static_cast<Label>(number)];
      if (!file.has(family + "/GRO/NOM")) continue;
      for (std::string& group : file.texts(family + "/GRO/NOM")) {
        const bool is_new = std::find(groups.begin(), groups.end(), group) == groups.end();
        if (is_new && !group.empty()) groups.push_back(std::move(group));
      }
    }
  }
}

void MedLabels::number_groups(MeshData& mesh) {
  for (std::size_t dimension = 1; dimension < used_.size(); ++dimension) {
    take_labels(dimension);
    for (auto family = used_[dimension].rbegin(); family != used_[dimension].rend(); ++family) {
      add_family(dimension, *family, mesh);
    }
  }
  for (const Label family : bare_families_)
    mesh.deck.push_back(med_remark_key("bare family", fmt::format("{}", family)) + '\0' + "yes");
  if (!used_[0].empty() && std::any_of(used_[0].begin(), used_[0].end(),
                                       [&](Label family) { return has_groups(false, family); })) {
    mesh.notes.emplace_back("groups of elements that are points are not kept");
  }
  std::set<Label> known;
  for (const std::set<Label>& used : used_) known.insert(used.begin(), used.end());
  std::set<std::string> empty;
  for (const auto& [family, names] : groups_of_[false]) {
    if (!known.contains(family)) empty.insert(names.begin(), names.end());
  }
  for (const Group& group : mesh.groups) empty.erase(group.name);
  if (!empty.empty())
    mesh.notes.push_back(fmt::format("{} groups without elements are not kept, the first is {}",
                                     empty.size(), in_quotes(*empty.begin())));
}

bool MedLabels::has_groups(bool of_nodes, Label family) const {
  const auto found = groups_of_[of_nodes].find(family);
  return found != groups_of_[of_nodes].end() && !found->second.empty();
}

void MedLabels::take_labels(std::size_t dimension) {
  for (const Label family : used_[dimension]) {
    if (!has_groups(false, family)) {
      numbers_[dimension].insert(-family);
      continue;
    }
    for (const std::string& name : groups_of_[false].at(family)) {
      if (Label label = 0; to_label(inp_key(name), label)) numbers_[dimension].insert(label);
    }
  }
}

void MedLabels::add_family(std::size_t dimension, Label family, MeshData& mesh) {
  std::map<Label, Label>& labels = label_of_[dimension];
  if (!has_groups(false, family)) {
    labels[family] = -family;
    if (family != 0) bare_families_.insert(family);
    return;
  }
  for (const std::string& name : groups_of_[false].at(family)) {
    Label label = 0;
    if (to_label(inp_key(name), label)) {
      labels[family] = label;
      continue;
    }
    const auto [at, is_new] = group_at_.try_emplace({dimension, name}, mesh.groups.size());
    if (is_new) mesh.groups.push_back({static_cast<int>(dimension), 0, name, {}, {}});
    Group& group = mesh.groups[at->second];
    if (is_new) group.number = free_number(dimension, family);
    group.parts.push_back(family);
    labels.try_emplace(family, group.number);
  }
}

Label MedLabels::free_number(std::size_t dimension, Label family) {
  std::set<Label>& taken = numbers_[dimension];
  Label number = std::max(-family, 1);
  while (!taken.insert(number).second) number = number == INT32_MAX ? 1 : number + 1;
  return number;
}

Label MedLabels::label_of(int dimension, Label family) const {
  const std::map<Label, Label>& labels = label_of_[static_cast<std::size_t>(dimension)];
  const auto found = labels.find(family);
  return found == labels.end() ? -family : found->second;
}

}  // namespace tetmend::formats
