// SPDX-License-Identifier: MIT
// Points that the rest of a deck names by their numbers, and so keeps where they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/formats/input_file.h"
#include "kernel/formats/number_index.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Ranges [begin, end) that overlap or touch become one.
std::vector<std::pair<std::size_t, std::size_t>> merged_ranges(
    std::vector<std::pair<std::size_t, std::size_t>> ranges);

class PointPins {
 public:
  /// What one keyword names.
  struct Pins {
    const char* first = nullptr;  ///< in the file
    std::size_t lines = 0;
    std::vector<std::pair<std::size_t, std::size_t>> ranges;  ///< of NumberIndex::ascending()
  };

  /// Counts one more line of `who`, as messages call it: "*CLOAD". What is returned stays valid.
  Pins& line_of(const std::string& who, const char* place) {
    Pins& pins = pins_[who];
    if (pins.first == nullptr) pins.first = place;
    ++pins.lines;
    return pins;
  }

  /// Adds the points to `mesh` as required vertices. The places are in these files. @return remarks, see pin_remarks_text()
  std::string require_points(std::span<const InputFile* const> files, const NumberIndex& nodes,
                             std::string_view what, MeshData& mesh) const;

 private:
  std::map<std::string, Pins> pins_;
};

}  // namespace tetmend::formats
