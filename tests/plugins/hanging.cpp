// SPDX-License-Identifier: MIT
// Operators that do not come back for a while, or never.
#include <chrono>
#include <thread>

#include "tests/plugins/vertex_mover.h"

namespace tetmend::test {
namespace {

/// A minute: longer than anyone waits, and no process is left over for ever.
struct Hangs final : VertexMover {
  Hangs() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext&, Target, State&) const override {
    std::this_thread::sleep_for(std::chrono::minutes(1));
    return Verdict::no_improvement;
  }
  inline static const OperatorInfo kInfo = {"hangs", TargetKind::vertex, "help", {}, make<Hangs>};
};

/// Each attempt comes back, all together take a minute and more.
struct Slow final : VertexMover {
  Slow() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext&, Target, State&) const override {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    return Verdict::no_improvement;
  }
  inline static const OperatorInfo kInfo = {"slow", TargetKind::vertex, "help", {}, make<Slow>};
};

}  // namespace
}  // namespace tetmend::test

TETMEND_PLUGIN(registry) {
  registry.add(tetmend::test::Hangs::kInfo);
  registry.add(tetmend::test::Slow::kInfo);
}
