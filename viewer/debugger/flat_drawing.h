// SPDX-License-Identifier: MIT
// Drawings without depth: a skirt polygon with its covering, and small heaps of tets. Plain shapes;
// whoever shows them chooses place and size.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "explain/call_study.h"
#include "viewer/debugger/explained.h"
#include "viewer/mesh/camera.h"
#include "viewer/mesh/colour_map.h"

namespace tetmend::viewer {

/// In the square from -1 to 1, y upwards; to be drawn in this order.
struct FlatDrawing {
  struct Area {
    std::vector<glm::dvec2> corners;  ///< convex
    Colour colour;
    std::vector<VertexHandle> vertices;  ///< of the tet or triangle that it stands for, or none
  };
  struct Stroke {
    glm::dvec2 from, to;
    Colour colour;
    double width = 1;  ///< pixels at scale 1
    bool dashed = false;
    std::string tip;                     ///< told when the mouse is on it
    std::vector<VertexHandle> vertices;  ///< of the edge that it stands for, or none
  };
  struct Label {
    glm::dvec2 at;  ///< its middle
    std::string text;
    bool strong = false;                 ///< a name; otherwise a number
    std::vector<VertexHandle> vertices;  ///< that it names, or none
  };
  std::vector<Area> areas;
  std::vector<Stroke> strokes;
  std::vector<Label> labels;
  std::string caption;
};

/// The skirt polygon as it is at a place in the trace. Before the edit of the call it has the old
/// tets and the chords that the search may use, after it the covering that was made or tried. After
/// a refusal without a candidate it has the best complete triangulation, dashed.
/// Precondition: the study has a picture.
FlatDrawing draw_polygon(const CallStudy& study, std::uint64_t position, bool refused,
                         const ColourMap& map);

/// Tets, drawn apart a little, as the camera sees them; the ball fills the square. Bad ones red,
/// the others by quality. `opacity` from 0 to 1.
FlatDrawing draw_tets(std::span<const LocalTet> tets, const Camera& camera, const Ball& ball,
                      const ColourMap& map, double opacity);

/// Ball around the corners of the tets; nothing without tets.
std::optional<Ball> ball_around(const CallStudy& study);

}  // namespace tetmend::viewer
