// SPDX-License-Identifier: MIT
// Operators that end the program.
#include <cstdlib>

#include "tests/plugins/vertex_mover.h"

// A sanitizer would end the program before the signal does.
#ifdef __clang__
#define TETMEND_UNWATCHED [[clang::no_sanitize("address", "undefined")]]
#else
#define TETMEND_UNWATCHED
#endif

namespace tetmend::test {
namespace {

struct Crashes final : VertexMover {
  Crashes() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext&, Target, State&) const override {
    crash();
    return Verdict::no_improvement;
  }
  TETMEND_UNWATCHED static void crash() {
    static int* volatile nowhere = nullptr;
    *nowhere = 1;
  }
  inline static const OperatorInfo kInfo = {
      "crashes", TargetKind::vertex, "help", {}, make<Crashes>};
};

struct Aborts final : VertexMover {
  Aborts() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext&, Target, State&) const override { std::abort(); }
  inline static const OperatorInfo kInfo = {"aborts", TargetKind::vertex, "help", {}, make<Aborts>};
};

/// Until the stack is used up.
struct Recurses final : VertexMover {
  Recurses() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext&, Target, State&) const override {
    return deeper(nullptr) > 0 ? Verdict::no_improvement : Verdict::deferred;
  }
  static int deeper(volatile const char* above) {
    volatile char room[4096];
    room[0] = above == nullptr ? char{1} : above[0];
    return room[0] == 0 ? 0 : deeper(room) + room[0];
  }
  inline static const OperatorInfo kInfo = {
      "recurses", TargetKind::vertex, "help", {}, make<Recurses>};
};

}  // namespace
}  // namespace tetmend::test

TETMEND_PLUGIN(registry) {
  registry.add(tetmend::test::Crashes::kInfo);
  registry.add(tetmend::test::Aborts::kInfo);
  registry.add(tetmend::test::Recurses::kInfo);
}
