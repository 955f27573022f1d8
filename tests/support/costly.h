// SPDX-License-Identifier: MIT
// A value whose copies need memory that may run out.
#pragma once

#include <new>

namespace tetmend::test {

struct Costly {
  static constexpr int kPlenty = 1'000'000;
  inline static int copies_left = kPlenty;  ///< memory is there for so many

  int value = 0;

  explicit Costly(int number = 0) : value(number) {}
  Costly(const Costly& other) : value(other.value) { take_memory(); }
  Costly(Costly&&) noexcept = default;
  Costly& operator=(const Costly& other) {
    take_memory();
    value = other.value;
    return *this;
  }
  Costly& operator=(Costly&&) noexcept = default;
  ~Costly() = default;

 private:
  static void take_memory() {
    if (copies_left-- == 0) throw std::bad_alloc();
  }
};

}  // namespace tetmend::test
