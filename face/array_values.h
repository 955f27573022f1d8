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

/// Those with one number for each tet. A place has the number of the tet that held it before the run, as
/// the arrays of the improved mesh will.
class ArrayValues final : public PlacedValues {
 public:
  /// @param data what the run began with, in lengths that are worked with; must outlive this
  explicit ArrayValues(const MeshData& data);
  ~ArrayValues() override;

  /// Cost: linear for the first name that is there.
  At find(std::string_view name) const override;
  std::vector<std::string> names() const override;

 private:
  struct Places;

  const MeshData& data_;
  mutable std::once_flag has_places_;
  mutable std::shared_ptr<const Places> places_;
};

}  // namespace tetmend::face
