// SPDX-License-Identifier: MIT
#include "tests/faults/failing_memory.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

/// Allocations up to the one that fails; 0 or less: none does.
std::atomic<long> allocations_left = 0;
std::atomic<bool> failed = false;

bool must_fail() {
  if (allocations_left.load(std::memory_order_relaxed) <= 0) return false;
  if (allocations_left.fetch_sub(1) != 1) return false;
  failed = true;
  return true;
}

void* allocate(std::size_t size) {
  return must_fail() ? nullptr : std::malloc(size == 0 ? 1 : size);
}

void* allocate(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return must_fail() ? nullptr : std::aligned_alloc(step, (size + step - 1) / step * step);
}

template <class... Alignment>
void* allocate_or_throw(std::size_t size, Alignment... alignment) {
  void* memory = allocate(size, alignment...);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored \
    "-Wmismatched-new-delete"  // gcc sees free() where all of these are inlined
#endif
// Arrays and the other forms of delete come here, too.
void* operator new(std::size_t size) {
  return allocate_or_throw(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, alignment);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return allocate(size, alignment);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace tetmend::test {

FailingMemory::FailingMemory(long n) {
  failed = false;
  allocations_left = n;
}

FailingMemory::~FailingMemory() {
  allocations_left = 0;
}

bool FailingMemory::has_failed() const {
  return failed;
}

}  // namespace tetmend::test
