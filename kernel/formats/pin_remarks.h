// SPDX-License-Identifier: MIT
// What is told of the lines of a deck that keep points of the mesh where they are.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/input_file.h"

namespace tetmend::formats {

/// Lines of a deck that say one thing, and the points that they keep.
struct PinRemark {
  const InputFile* file = nullptr;  ///< with the first of them
  const char* place = nullptr;      ///< of that
  std::size_t lines = 1;
  std::string who;         ///< "*CLOAD"
  std::size_t points = 0;  ///< at least 1
};

/// A line for each, "FILE:LINE and 2 more: WHO keep 17 points where they are", in this order; of very many
/// the first ones, and how many more.
/// @param what  they are: "lines"
std::string pin_remarks_text(const std::vector<PinRemark>& remarks, std::string_view what);

}  // namespace tetmend::formats
