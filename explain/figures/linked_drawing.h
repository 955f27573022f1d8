// SPDX-License-Identifier: MIT
// A drawing whose shapes stand for parts of a mesh: on paper it is a drawing like any other, in a
// window the mouse can ask it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "figure/drawing.h"
#include "kernel/handles.h"

namespace tetmend::explain {

/// What a shape stands for.
struct Meaning {
  std::vector<VertexHandle> vertices;  ///< of the vertex, edge, face or tet, or none
  std::string tip;                     ///< to be told beside the mouse; may be empty
  bool is_nothing() const { return vertices.empty() && tip.empty(); }
};

struct LinkedDrawing {
  figure::Drawing drawing;
  std::vector<Meaning> meanings;  ///< of each shape

  void add(figure::Shape shape, Meaning meaning = {});
};

/// What lies at a place: a word within `reach` of its middle, else a line, else the last area; null
/// where nothing has a meaning. Ends of lines belong to the words there.
const Meaning* meaning_at(const LinkedDrawing& drawing, const figure::Place& place, double reach);

}  // namespace tetmend::explain
