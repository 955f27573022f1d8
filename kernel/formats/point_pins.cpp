// SPDX-License-Identifier: MIT
#include "kernel/formats/point_pins.h"

#include <algorithm>

#include "kernel/formats/deck_files.h"
#include "kernel/formats/pin_remarks.h"

namespace tetmend::formats {

std::vector<std::pair<std::size_t, std::size_t>> merged_ranges(
    std::vector<std::pair<std::size_t, std::size_t>> ranges) {
  std::sort(ranges.begin(), ranges.end());
  std::vector<std::pair<std::size_t, std::size_t>> all;
  for (const auto& range : ranges) {
    if (range.first >= range.second) continue;
    if (all.empty() || range.first > all.back().second) {
      all.push_back(range);
    } else {
      all.back().second = std::max(all.back().second, range.second);
    }
  }
  return all;
}

std::string PointPins::require_points(std::span<const InputFile* const> files,
                                      const NumberIndex& nodes, std::string_view what,
                                      MeshData& mesh) const {
  std::vector<bool> is_required(mesh.points.size(), false);
  std::vector<PinRemark> remarks;
  for (const auto& [who, pins] : pins_) {
    std::size_t count = 0;
    for (const auto& [begin, end] : merged_ranges(pins.ranges)) {
      count += end - begin;
      for (std::size_t i = begin; i < end; ++i) is_required[nodes.ascending()[i]] = true;
    }
    if (count == 0) continue;
    remarks.push_back({&file_of_place(files, pins.first), pins.first, pins.lines, who, count});
  }
  for (std::uint32_t i = 0; i < is_required.size(); ++i) {
    if (is_required[i]) mesh.required_vertices.push_back(i);
  }
  std::sort(remarks.begin(), remarks.end(), [&](const PinRemark& a, const PinRemark& b) {
    const auto place = [&](const PinRemark& remark) {
      const auto file = std::find(files.begin(), files.end(), remark.file);
      return std::pair(file - files.begin(), remark.place - remark.file->begin());
    };
    return place(a) < place(b);
  });
  return pin_remarks_text(remarks, what);
}

}  // namespace tetmend::formats
