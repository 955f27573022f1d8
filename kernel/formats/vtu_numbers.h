// SPDX-License-Identifier: MIT
// Types of numbers in VTK's XML files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

struct VtuType {
  std::string_view name;
  std::size_t size;
  enum class Kind { signed_integer, unsigned_integer, real } kind;

  /// Kept in 32 bits.
  bool is_narrow() const { return size < 4 || (size == 4 && kind == Kind::signed_integer); }
};

/// Null for a name that is none of them.
const VtuType* find_vtu_type(std::string_view name);

/// `size` numbers of a type. Unsigned ones above 2^63 become negative.
DataArray::Values decode_vtu(std::string_view bytes, const VtuType& type, std::size_t size,
                             bool swap);

}  // namespace tetmend::formats
