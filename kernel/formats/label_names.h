// SPDX-License-Identifier: MIT
// Names of labels: what a format can keep of groups where a set of elements has one number.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Which label a group stands for: it has all elements of its dimension with this label and no
/// others. `found` is false if there is none.
struct NamedLabel {
  bool found = false;
  Label label = 0;
};

/// The (label, part) pairs of each dimension, to ask for many groups.
class LabelNames {
 public:
  explicit LabelNames(const MeshData& mesh);

  /// Takes time with the number of members, if the group has these.
  NamedLabel label_of(const Group& group) const;
  /// The group that names each label of this dimension, if one does: the first such group.
  std::map<Label, const Group*> named(int dimension) const;

 private:
  const MeshData& mesh_;
  /// By dimension: how many elements have this label and this part.
  std::array<std::map<Label, std::map<Label, std::size_t>>, 4> counts_;
  std::array<std::map<Label, std::size_t>, 4> totals_;  // of each label
  std::array<std::map<Label, std::vector<Label>>, 4> labels_of_part_;
};

}  // namespace tetmend::formats
