// SPDX-License-Identifier: MIT
#include "viewer/mesh/view_history.h"

namespace tetmend::viewer {

void ViewHistory::keep(const ViewSettings& view) {
  if (next_ > 0 && views_[next_ - 1] == view) return;
  views_.resize(next_);
  views_.push_back(view);
  if (views_.size() > kMostKept) views_.erase(views_.begin());
  next_ = views_.size();
}

std::optional<ViewSettings> ViewHistory::undo(const ViewSettings& view) {
  keep(view);
  if (next_ < 2) return std::nullopt;
  --next_;
  return views_[next_ - 1];
}

std::optional<ViewSettings> ViewHistory::redo(const ViewSettings& view) {
  keep(view);
  if (next_ == views_.size()) return std::nullopt;
  ++next_;
  return views_[next_ - 1];
}

}  // namespace tetmend::viewer
