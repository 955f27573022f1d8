// SPDX-License-Identifier: MIT
// Preloaded into a program: its allocation number TETMEND_FAIL_AT, from 0, finds no memory.
#include <cerrno>
#include <cstddef>
#include <cstdlib>

// The functions of the C library, under the names that it keeps for such as this.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}
// NOLINTEND(readability-identifier-naming)

namespace {

long allocations_left() {
  const char* at = std::getenv("TETMEND_FAIL_AT");
  return at == nullptr ? -1 : std::strtol(at, nullptr, 10);
}

bool fails() {
  static bool known = false;
  static long left = -1;
  if (!known) {
    known = true;
    left = allocations_left();
  }
  if (left < 0 || __atomic_sub_fetch(&left, 1, __ATOMIC_RELAXED) != -1) return false;
  errno = ENOMEM;
  return true;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept {
  return fails() ? nullptr : __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  return fails() ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) noexcept {
  return fails() ? nullptr : __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return fails() ? nullptr : __libc_memalign(alignment, size);
}
}
