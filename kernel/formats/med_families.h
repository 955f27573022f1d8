// SPDX-License-Identifier: MIT
// Families of MED: which points or elements have which groups in common.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "kernel/formats/med.h"
#include "kernel/formats/set_chains.h"
#include "kernel/formats/unique_names.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// What elements have in common.
struct MedFamilyKey {
  int dimension = 0;
  bool has_part = false;
  Label part = 0;
  Label label = 0;
  std::uint32_t chain = 0;
  friend auto operator<=>(const MedFamilyKey&, const MedFamilyKey&) = default;
};

/// Which points or elements have which groups in common, and what these are called.
class MedFamilies {
 public:
  /// `data` may be null.
  MedFamilies(const MeshData* data, const MedRemarks& remarks);

  /// In which groups that name their members these points or elements are.
  std::vector<std::uint32_t> chains(int dimension, std::size_t count);

  /// The place of a family, which gets its number in the end.
  std::uint32_t place_of(const MedFamilyKey& key);

  /// Numbers and names of all; those of points are above 0, those of elements below.
  struct Family {
    std::int32_t number = 0;
    std::vector<std::string> groups;
  };
  std::vector<Family> finish();

 private:
  std::vector<std::string> groups_of(const MedFamilyKey& key);

  const MeshData* data_;
  const MedRemarks& remarks_;
  bool is_med_;
  SetChains chains_;
  std::vector<MedFamilyKey> keys_;
  std::map<MedFamilyKey, std::uint32_t> place_;
  MedFamilyKey last_;
  std::uint32_t last_place_ = 0;
  std::vector<std::string> names_;  // of groups, which fit; no two of one dimension are the same
};

}  // namespace tetmend::formats
