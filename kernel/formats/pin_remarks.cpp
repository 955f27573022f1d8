// SPDX-License-Identifier: MIT
#include "kernel/formats/pin_remarks.h"

#include <algorithm>

#include <fmt/format.h>

#include "kernel/grouped.h"

namespace tetmend::formats {

std::string pin_remarks_text(const std::vector<PinRemark>& remarks, std::string_view what) {
  constexpr std::size_t kMost = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(remarks.size(), kMost); ++i) {
    const auto& [file, place, lines, who, points] = remarks[i];
    text += fmt::format("{}{}: {} {} {} {} where {}\n", file->line_place(place),
                        lines == 1 ? "" : fmt::format(" and {} more", lines - 1), who,
                        lines == 1 ? "keeps" : "keep", grouped(points),
                        points == 1 ? "point" : "points", points == 1 ? "it is" : "they are");
  }
  if (remarks.size() > kMost) {
    text += fmt::format("{} more {} keep points where they are\n", remarks.size() - kMost, what);
  }
  return text;
}

}  // namespace tetmend::formats
