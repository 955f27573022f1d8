// SPDX-License-Identifier: MIT
// The views that there have been, to go back to.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "viewer/mesh/view_settings.h"

namespace tetmend::viewer {

class ViewHistory {
 public:
  static constexpr std::size_t kMostKept = 200;

  /// Keeps a view, unless it is the one that was kept last. What was undone is forgotten then.
  void keep(const ViewSettings& view);
  /// The view before that one, or nothing. A view that was not kept is kept first.
  std::optional<ViewSettings> undo(const ViewSettings& view);
  /// What the last undo has left, or nothing.
  std::optional<ViewSettings> redo(const ViewSettings& view);

 private:
  std::vector<ViewSettings> views_;
  std::size_t next_ = 0;  // behind the one that is shown
};

}  // namespace tetmend::viewer
