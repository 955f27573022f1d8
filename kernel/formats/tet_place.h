// SPDX-License-Identifier: MIT
// How a reader is asked where in the file a tet stands.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Question and answer: a reader that is handed one fills in `place` when it reads that tet.
struct TetPlace {
  std::size_t tet = 0;  ///< number in MeshData::tets
  std::string place;    ///< "FILE:LINE" or "FILE: byte N"
};

/// What a reader is asked for besides the mesh.
struct ReadRequest {
  TetPlace* question = nullptr;
  std::string label_array = {};  ///< the array of cells that holds the labels; empty: by its name
};

/// True if `element`, an entry of `elements`, is the tet that is asked for. `question` may be null.
template <class Element>
bool is_asked_for(const TetPlace* question, const std::vector<Element>& elements,
                  const Element& element) {
  if constexpr (std::is_same_v<Element, MeshData::Tet>) {
    return question != nullptr &&
           static_cast<std::size_t>(&element - elements.data()) == question->tet;
  } else {
    return false;
  }
}

}  // namespace tetmend::formats
