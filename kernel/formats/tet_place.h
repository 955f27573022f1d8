// SPDX-License-Identifier: MIT
// How a reader is asked where in the file a tet, a triangle or an edge stands.
#pragma once

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Question and answer: a reader that is handed one fills in `place` when it reads that tet, or
/// element of a lower dimension.
struct TetPlace {
  std::size_t tet = 0;  ///< number in MeshData::tets, or in the list of its dimension
  std::string place;    ///< "FILE:LINE" or "FILE: byte N"
  int dimension = 3;    ///< 2: one of MeshData::triangles, 1: of MeshData::edges
};

/// What a reader is asked for besides the mesh.
struct ReadRequest {
  TetPlace* question = nullptr;
  std::string label_array = {};  ///< the array of cells that holds the labels; empty: by its name
};

/// True if `element`, an entry of `elements`, is the one that is asked for. `question` may be null.
template <class Element>
bool is_asked_for(const TetPlace* question, const std::vector<Element>& elements,
                  const Element& element) {
  constexpr int kDimension = static_cast<int>(std::tuple_size_v<decltype(Element::vertices)>) - 1;
  return question != nullptr && question->dimension == kDimension &&
         static_cast<std::size_t>(&element - elements.data()) == question->tet;
}

}  // namespace tetmend::formats
