// SPDX-License-Identifier: MIT
// Four numbers side by side: arithmetic that processors with wide registers do at once.
#pragma once

#include <array>
#include <cstddef>

namespace tetmend {

inline constexpr std::size_t kWideLanes = 4;

/// A vector of the compiler: one register or several, as the processor has them.
using WideVector = double __attribute__((vector_size(sizeof(double) * kWideLanes)));

/// `Fields` rows of numbers, each of which can be read as a WideVector.
template <std::size_t Fields>
struct alignas(sizeof(WideVector)) WideRows {
  std::array<std::array<double, kWideLanes>, Fields> of;

  WideVector* vectors() { return reinterpret_cast<WideVector*>(this); }
  const WideVector* vectors() const { return reinterpret_cast<const WideVector*>(this); }
};

/// Four points or vectors, each in a lane of its own. Must be inlined: into functions of any
/// instruction set.
struct WidePoint {
  WideVector x, y, z;
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // no call is left of these
#define TETMEND_WIDE_INLINE inline __attribute__((always_inline))

TETMEND_WIDE_INLINE WidePoint operator-(const WidePoint& p, const WidePoint& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}
TETMEND_WIDE_INLINE WidePoint cross(const WidePoint& p, const WidePoint& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
TETMEND_WIDE_INLINE WideVector dot(const WidePoint& p, const WidePoint& q) {
  return p.x * q.x + p.y * q.y + p.z * q.z;
}
TETMEND_WIDE_INLINE WideVector smaller(const WideVector& p, const WideVector& q) {
  return p < q ? p : q;
}
TETMEND_WIDE_INLINE WideVector magnitude(const WideVector& p) {
  return p < 0.0 ? -p : p;
}
#pragma GCC diagnostic pop

}  // namespace tetmend

// For functions on WideVectors: a version for processors that have wide registers, chosen at run
// time; the same operations in the same order everywhere.
// Only ELF files can choose; clang 14 cannot pass these vectors in such versions, sanitizers do not
// stand the choice.
#if defined(__x86_64__) && defined(__ELF__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TETMEND_WIDE __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define TETMEND_WIDE
#endif
