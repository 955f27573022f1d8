// SPDX-License-Identifier: MIT
// Whether a program and the library that it found when it started are of one version.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tetmend/api.h>

#include "kernel/edit.h"
#include "kernel/transaction.h"

namespace tetmend::kernel {

/// What a program was compiled with.
struct TETMEND_API Layout {
  const char* version;
  std::uint32_t sizes;
};

/// Checksum of the sizes of all that program and library share.
constexpr std::uint32_t sum_of_sizes() {
  std::uint32_t sum = 2166136261u;
  for (const std::size_t size :
       {sizeof(void*), sizeof(std::string), sizeof(std::vector<int>), sizeof(Point), alignof(Point),
        sizeof(tetmend::TetMesh), sizeof(tetmend::Transaction), sizeof(Journal), sizeof(Edit)}) {
    sum = (sum ^ static_cast<std::uint32_t>(size)) * 16777619u;
  }
  return sum;
}

/// @throws Error that names both versions when the library is another one than the headers.
TETMEND_API void check_layout(const Layout& of_program);

}  // namespace tetmend::kernel
