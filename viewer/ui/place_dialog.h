// SPDX-License-Identifier: MIT
// A small dialog that asks where to go: a tet, an edge or a vertex.
#pragma once

#include <string>

#include "viewer/commands/commands.h"

namespace tetmend::viewer::ui {

/// Appears when the document asks for a place.
class PlaceDialog {
 public:
  /// Between begin and end of a frame.
  void draw(Session& session);

 private:
  std::string typed_;
  std::string trouble_;
  bool wants_focus_ = false;
};

}  // namespace tetmend::viewer::ui
