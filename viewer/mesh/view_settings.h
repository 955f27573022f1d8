// SPDX-License-Identifier: MIT
// Everything that decides what a picture of a mesh shows, as plain data and as JSON.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "kernel/mesh_data.h"
#include "viewer/mesh/camera.h"
#include "viewer/mesh/histogram.h"

namespace tetmend::viewer {

/// Hides what lies in front of a plane: the side that its normal points to.
struct CutPlane {
  bool on = false;
  bool exact = false;          ///< cuts through tets; otherwise a tet is hidden when its centre is
  glm::dvec3 normal{1, 0, 0};  ///< any length but 0
  double position = 0;  ///< from the centre of the mesh along the normal, in units of its radius
  friend bool operator==(const CutPlane&, const CutPlane&) = default;
};

/// Colours of the faces of the surface by how far they lie from another surface.
inline constexpr const char* kDistance = "distance";

/// What is drawn of the mesh and in which colours; the camera and the looks of the window apart.
struct SceneSettings {
  std::string colour = "region";  ///< or the name of a TetValue, or kDistance
  std::string map = "ember";
  std::string measure = "quality";  ///< of the histogram, the filter and the list of the worst
  bool bad = true;                  ///< bad tets in red, seen through the rest
  bool bad_beyond_cuts = false;     ///< also those that cuts and peeling hide
  double bad_below = 1;             ///< tets whose angles are of less quality; 1: the goal
  bool filtered = false;            ///< show only tets whose value lies in `range`
  Range range;
  bool outside = false;  ///< show those outside of `range` instead
  std::array<CutPlane, 3> cuts = {CutPlane{.normal = {1, 0, 0}}, CutPlane{.normal = {0, 1, 0}},
                                  CutPlane{.normal = {0, 0, 1}}};
  int peel = 0;            ///< layers of tets taken off the boundary
  double shrink = 0;       ///< of each tet towards its centre, 0 to 0.9
  double ghosts = 0;       ///< opacity of the boundary of hidden tets, 0 to 1
  bool outline = true;     ///< of the mesh, faint, where a filter or isolation leaves parts of it
  double reference = 0;    ///< opacity of the surface that this one is compared with, 0 to 1
  bool both_ways = false;  ///< kDistance: also how far the other surface lies from this one
  bool constraints = false;
  bool isolate = false;  ///< only the tets of the call at hand, or of the selection
  std::vector<Label> hidden_regions;
  friend bool operator==(const SceneSettings&, const SceneSettings&) = default;
};

/// Behind the mesh. Transparent: PNG files have an alpha channel; a window shows white.
enum class Background : unsigned char { gradient, white, transparent };

struct ViewSettings {
  Camera camera;
  SceneSettings scene;
  bool edges = true;
  bool numbers = true;          ///< of the vertices of the call at hand or of the selection
  bool all_numbers = false;     ///< of the vertices that are seen, as far as there is room
  bool legend = true;           ///< of a trace: what the colours in the picture mean
  bool blended = false;         ///< of a trace: the shell before and after in one picture
  double blend = 0.5;           ///< share of the shell after the call in it
  std::string theme = "light";  ///< or "dark"
  Background background = Background::gradient;
  bool colour_bar = false;  ///< of the measure, with numbers; of regions, their colours
  bool scale_bar = false;
  std::string title;  ///< over the mesh; empty: none

  /// Colours by distance, their bar, and the reference as a ghost.
  void show_reference(bool on);
  friend bool operator==(const ViewSettings&, const ViewSettings&) = default;
};

nlohmann::json to_json(const ViewSettings& view);

/// Changes what `patch` names and leaves the rest. Nothing changes when it throws.
/// @throws Error for an unknown key, a value of the wrong type or out of range, with what is valid.
void apply_json(ViewSettings& view, const nlohmann::json& patch);

/// The same for a text, as it comes from a file or the clipboard.
void apply_json_text(ViewSettings& view, const std::string& text);

}  // namespace tetmend::viewer
