// SPDX-License-Identifier: MIT
// Finds the old tet at a place, and what an array has for it.
#include "face/array_values.h"

#include <numeric>
#include <variant>

#include "face/bodies.h"
#include "face/tet_locator.h"

namespace tetmend::face {

struct ArrayValues::Places {
  explicit Places(const MeshData& data) : bodies(data), locator(data, bodies, all(data)) {}

  static std::vector<std::uint32_t> all(const MeshData& data) {
    std::vector<std::uint32_t> tets(data.tets.size());
    std::iota(tets.begin(), tets.end(), 0U);
    return tets;
  }

  Bodies bodies;
  TetLocator locator;
};

ArrayValues::ArrayValues(const MeshData& data) : data_(data) {}
ArrayValues::~ArrayValues() = default;

TetValues::Of ArrayValues::find(std::string_view name) const {
  for (const DataArray& array : data_.tet_data) {
    if (array.name != name || array.components != 1 || data_.tets.empty()) continue;
    std::call_once(has_places_, [&] { places_ = std::make_shared<const Places>(data_); });
    return [&array, places = places_](const TetMesh& mesh, TetHandle t) {
      const auto& [a, b, c, d] = mesh.vertices(t);
      const Point middle = (mesh.point(a) + mesh.point(b) + mesh.point(c) + mesh.point(d)) / 4;
      const std::uint32_t tet = places->locator.find_tet(middle, {});
      return std::visit([tet](const auto& values) { return static_cast<double>(values[tet]); },
                        array.values);
    };
  }
  return {};
}

std::vector<std::string> ArrayValues::names() const {
  std::vector<std::string> names;
  for (const DataArray& array : data_.tet_data) {
    if (array.components == 1) names.push_back(array.name);
  }
  return names;
}

}  // namespace tetmend::face
