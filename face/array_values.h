// SPDX-License-Identifier: MIT
// Arrays of the tets of a mesh, asked for by place while a run changes the mesh.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"
#include "schedule/selection.h"

namespace tetmend::face {

/// Those with one number for each tet. A tet has the number of the one that held its centroid before the
/// run, as in the arrays of the improved mesh.
class ArrayValues final : public TetValues {
 public:
  /// @param data what the run began with, in lengths that are worked with; must outlive this
  explicit ArrayValues(const MeshData& data);
  ~ArrayValues() override;

  /// Cost: linear for the first name that is there.
  Of find(std::string_view name) const override;
  std::vector<std::string> names() const override;

 private:
  struct Places;

  const MeshData& data_;
  mutable std::once_flag has_places_;
  mutable std::shared_ptr<const Places> places_;
};

}  // namespace tetmend::face
