// SPDX-License-Identifier: MIT
// What a mesh holds besides its elements: named numbers and named sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <tetmend/api.h>
#include <tetmend/language.h>

namespace tetmend {

/// Named numbers for each point, or for each element of one kind: `components` of them for the
/// first, then for the second, and so on. A number that is missing is NaN.
struct TETMEND_API DataArray {
  using Values = std::variant<std::vector<std::int32_t>, std::vector<std::int64_t>,
                              std::vector<float>, std::vector<double>>;  ///< one of four types
  std::string name = {};                                                 ///< as a file has it
  std::size_t components = 1;  ///< numbers of one point or element
  Values values = {};          ///< of all of them

  /// Numbers in all.
  std::size_t size() const;
  friend bool operator==(const DataArray&, const DataArray&) = default;  ///< NaN equals none
};

/// A named or numbered set of points or elements. One of them may be in several.
struct TETMEND_API Group {
  int dimension = 3;                        ///< 0: points, 1: edges, 2: triangles, 3: tets
  std::int32_t number = 0;                  ///< no other group of this dimension has it; 0: none
  std::string name = {};                    ///< may be empty
  std::vector<std::int32_t> parts = {};     ///< all elements of these parts, see MeshArrays; or
  std::vector<std::uint32_t> members = {};  ///< these points or elements; or, if both are empty,
                                            ///< all elements with the label `number`
  friend bool operator==(const Group&, const Group&) = default;  ///< all of it
};

}  // namespace tetmend
