// SPDX-License-Identifier: MIT
// Asks before work is lost: save it, let it go, or stay.
#pragma once

#include "viewer/commands/commands.h"

namespace tetmend::viewer::ui {

class UnsavedDialog {
 public:
  /// Appears while a command of the document waits. After the dialog for files.
  void draw(Session& session);
};

}  // namespace tetmend::viewer::ui
