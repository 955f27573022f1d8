// SPDX-License-Identifier: MIT
// The page of F1: gestures and keys by the menu that they are in, with a field to search.
#pragma once

#include <string>

#include "viewer/commands/commands.h"

namespace tetmend::viewer::ui {

class KeysPage {
 public:
  /// While the document shows it.
  void draw(Session& session, float scale);

 private:
  std::string typed_;
};

}  // namespace tetmend::viewer::ui
