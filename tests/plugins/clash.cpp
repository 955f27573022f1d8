// SPDX-License-Identifier: MIT
// A new operator, then one by the name of a built-in one.
#include "tests/plugins/vertex_mover.h"

namespace tetmend::test {
namespace {

struct Mover final : VertexMover {
  Mover() : VertexMover(kNew) {}
  inline static const OperatorInfo kNew = {"new_one", TargetKind::vertex, "help", {}, make<Mover>};
  inline static const OperatorInfo kOld = {
      "smoothing", TargetKind::vertex, "help", {}, make<Mover>};
};

}  // namespace
}  // namespace tetmend::test

TETMEND_PLUGIN(registry) {
  registry.add(tetmend::test::Mover::kNew);
  registry.add(tetmend::test::Mover::kOld);
}
