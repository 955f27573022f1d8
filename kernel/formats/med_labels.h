// SPDX-License-Identifier: MIT
// Which labels and groups the families of a MED file are.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernel/formats/hdf5_file.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

class MedLabels {
 public:
  /// The families below a path of the file, which need not be there.
  void read_families(const Hdf5Reader& file, const std::string& path);
  /// Families that elements of a dimension have.
  void use(int dimension, std::span<const std::int64_t> families) {
    for (const std::int64_t family : families)
      used_[static_cast<std::size_t>(dimension)].insert(static_cast<Label>(family));
  }
  /// Adds groups of the families that elements have, by dimension, each with a number. That is the
  /// number of its first family, if it is free. Precondition: all families are read and used.
  void number_groups(MeshData& mesh);

  /// Of an element. Precondition: the groups have numbers.
  Label label_of(int dimension, Label family) const;
  bool has_groups(bool of_nodes, Label family) const;
  const std::vector<std::string>& groups_of_points(Label family) const {
    return groups_of_[1].at(family);
  }

 private:
  /// No group gets the number of a label that has no group.
  void take_labels(std::size_t dimension);
  void add_family(std::size_t dimension, Label family, MeshData& mesh);
  Label free_number(std::size_t dimension, Label family);

  std::array<std::map<Label, std::vector<std::string>>, 2> groups_of_;  // by family; [1]: of nodes
  // By dimension of elements:
  std::array<std::set<Label>, 4> used_;  // families
  std::array<std::map<Label, Label>, 4> label_of_;
  std::set<Label> bare_families_;           // without groups
  std::array<std::set<Label>, 4> numbers_;  // of groups
  std::map<std::pair<std::size_t, std::string>, std::size_t> group_at_;
};

}  // namespace tetmend::formats
