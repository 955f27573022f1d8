// SPDX-License-Identifier: MIT
// A shared library that has nothing to do with tetmend, whose initialisers must not run.
#include <cstdlib>

namespace {
struct Initialiser {
  Initialiser() { std::abort(); }
};
const Initialiser kInitialiser;
}  // namespace

extern "C" int answer() {
  return 42;
}
