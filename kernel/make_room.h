// SPDX-License-Identifier: MIT
// Memory for what is written later, when nothing may fail any more.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tetmend {

/// Makes room for so many more values, in steps that grow with the size.
template <class T>
void make_room_for(std::size_t count, std::vector<T>& values) {
  const std::size_t size = values.size() + count;
  if (size > values.capacity()) values.reserve(std::max(size, 2 * values.capacity()));
}

}  // namespace tetmend
