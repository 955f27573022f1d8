// SPDX-License-Identifier: MIT
// A shared library that has nothing to do with tetmend.
extern "C" int answer() {
  return 42;
}
