// SPDX-License-Identifier: MIT
// A plugin with nothing wrong.
#include "tests/plugins/vertex_mover.h"

namespace tetmend::test {
namespace {

struct Sound final : VertexMover {
  Sound() : VertexMover(kInfo) {}
  inline static const OperatorInfo kInfo = {
      "sound", TargetKind::vertex, "to the middle", {}, make<Sound>};
};

}  // namespace
}  // namespace tetmend::test

TETMEND_PLUGIN(registry) {
  registry.add(tetmend::test::Sound::kInfo);
}
