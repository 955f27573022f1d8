// SPDX-License-Identifier: MIT
// Memory of lists: for what is written later, when nothing may fail any more, and given back.
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

/// Empties the lists and gives their memory back. Assigning an empty list would keep it.
template <class... T>
void release(std::vector<T>&... values) {
  (std::vector<T>().swap(values), ...);
}

}  // namespace tetmend
