// SPDX-License-Identifier: MIT
// The menu of a right click: on the mesh, or on whatever stands for a part of it in a panel.
#pragma once

#include "viewer/commands/commands.h"

namespace tetmend::viewer::ui {

class Choices {
 public:
  /// After the panels, which tell what the mouse is on.
  void draw(Session& session);

 private:
  void offer(Session& session) const;

  Pointed subject_;  // of the menu that is open
};

}  // namespace tetmend::viewer::ui
