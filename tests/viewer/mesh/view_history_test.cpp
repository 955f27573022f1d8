// SPDX-License-Identifier: MIT
#include "viewer/mesh/view_history.h"

#include <doctest/doctest.h>

using namespace tetmend::viewer;

namespace {

ViewSettings peeled(int layers) {
  ViewSettings view;
  view.scene.peel = layers;
  return view;
}

}  // namespace

TEST_CASE("views are undone and redone in turn, and a new one ends what could be redone") {
  ViewHistory history;
  CHECK_FALSE(history.undo(peeled(0)));
  history.keep(peeled(1));
  history.keep(peeled(1));  // the same
  CHECK(history.undo(peeled(2)) == peeled(1));
  CHECK(history.undo(peeled(1)) == peeled(0));
  CHECK_FALSE(history.undo(peeled(0)));
  CHECK(history.redo(peeled(0)) == peeled(1));
  CHECK(history.undo(peeled(7)) == peeled(1));
  CHECK(history.redo(peeled(1)) == peeled(7));
  CHECK_FALSE(history.redo(peeled(7)));
}

TEST_CASE("only so many views are kept") {
  ViewHistory history;
  const auto most = static_cast<int>(ViewHistory::kMostKept);
  for (int i = 0; i <= 2 * most; ++i) history.keep(peeled(i));
  int undone = 0;
  auto view = history.undo(peeled(2 * most));
  for (; view; view = history.undo(*view)) ++undone;
  CHECK(undone == most - 1);
}
