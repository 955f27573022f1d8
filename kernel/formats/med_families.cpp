// SPDX-License-Identifier: MIT
// Families of MED: which points or elements have which groups in common.
#include "kernel/formats/med_families.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "kernel/formats/inp_sets.h"

namespace tetmend::formats {

MedFamilies::MedFamilies(const MeshData* data, const MedRemarks& remarks)
    : data_(data), remarks_(remarks), is_med_(data != nullptr && data->variant == kMed) {
  if (data == nullptr) return;
  std::array<UniqueNames, 4> taken;  // by dimension
  taken.fill(UniqueNames(kMedGroupNames));
  for (const Group& group : data->groups) {
    UniqueNames& of_dimension = taken[static_cast<std::size_t>(group.dimension)];
    std::string& name = names_.emplace_back();
    if (group.name.empty()) name = label_name(group.number);
    if (!is_med_name(group.name) || of_dimension.has(group.name)) continue;
    name = group.name;
    of_dimension.take(name);
  }
  for (std::size_t g = 0; g < names_.size(); ++g) {
    const Group& group = data->groups[g];
    if (names_[g].empty())
      names_[g] = taken[static_cast<std::size_t>(group.dimension)].make_fit(group.name);
  }
}

std::vector<std::uint32_t> MedFamilies::chains(int dimension, std::size_t count) {
  std::vector<std::uint32_t> chain_of;
  const std::uint32_t none = chains_.begin();
  for (std::uint32_t g = 0; data_ != nullptr && g < data_->groups.size(); ++g) {
    const Group& group = data_->groups[g];
    if (group.dimension != dimension || group.members.empty()) continue;
    chain_of.resize(count, none);
    for (const std::uint32_t member : group.members) {
      std::uint32_t& chain = chain_of[member];
      if (chain == none || chains_.last(chain) != g) chain = chains_.with(chain, g);
    }
  }
  if (chain_of.empty()) chain_of.resize(count, none);
  return chain_of;
}

std::uint32_t MedFamilies::place_of(const MedFamilyKey& key) {
  if (keys_.empty() || last_ != key) {
    const auto [at, is_new] = place_.try_emplace(key, static_cast<std::uint32_t>(keys_.size()));
    if (is_new) keys_.push_back(key);
    last_ = key;
    last_place_ = at->second;
  }
  return last_place_;
}

std::vector<MedFamilies::Family> MedFamilies::finish() {
  std::vector<Family> families(keys_.size());
  std::map<std::int32_t, std::vector<std::string>> taken;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const MedFamilyKey& key = keys_[i];
    families[i].groups = groups_of(key);
    if (!is_med_ || !key.has_part || key.part >= 0) continue;
    const auto [at, is_new] = taken.try_emplace(key.part, families[i].groups);
    if (at->second == families[i].groups) families[i].number = key.part;
  }
  std::int32_t below = -1;
  std::int32_t above = 1;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const bool is_nothing = families[i].groups.empty() && keys_[i].label == 0;
    if (families[i].number != 0 || is_nothing) continue;
    while (taken.contains(below)) --below;
    families[i].number = keys_[i].dimension == 0 ? above++ : below--;
  }
  return families;
}

std::vector<std::string> MedFamilies::groups_of(const MedFamilyKey& key) {
  std::vector<std::string> names;
  bool is_named = false;
  for (std::uint32_t g = 0; data_ != nullptr && g < data_->groups.size(); ++g) {
    const Group& group = data_->groups[g];
    if (group.dimension != key.dimension) continue;
    const bool is_label = key.label != 0 && group.number == key.label;
    const bool has_part = key.has_part && std::find(group.parts.begin(), group.parts.end(),
                                                    key.part) != group.parts.end();
    const bool is_all = is_label && group.parts.empty() && group.members.empty();
    if (has_part || is_all || (!group.members.empty() && chains_.has(key.chain, g))) {
      names.push_back(names_[g]);
    }
    is_named = is_named || is_label;
  }
  const bool is_bare =
      is_med_ && key.has_part &&
      remarks_.contains(med_remark_key("bare family", fmt::format("{}", key.part)));
  if (key.label != 0 && !(is_named && key.dimension > 0) && !is_bare)
    names.push_back(label_name(key.label));
  return names;
}

}  // namespace tetmend::formats
