// SPDX-License-Identifier: MIT
// What a deck of Nastran loses of a mesh, and what readers make of its form.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/included_path.h"
#include "kernel/formats/nastran.h"
#include "kernel/formats/nastran_numbers.h"
#include "kernel/grouped.h"

namespace tetmend::formats {

std::size_t nastran_pieces_to_miss(const MeshData& mesh) {
  std::size_t pieces = 0;
  for (std::size_t i = 0; i < mesh.deck.size() && i < nastran_folder; ++i) {
    const bool is_own = (i == nastran_front && mesh.deck[i] == "BEGIN BULK\n") ||
                        (i == nastran_end && mesh.deck[i] == "ENDDATA\n");
    pieces += is_own || mesh.deck[i].empty() ? 0 : 1;
  }
  return pieces;
}

std::vector<std::string> not_in_nastran(const std::filesystem::path& file, const MeshData& mesh) {
  if (mesh.variant != kNastran || mesh.deck.size() < nastran_pieces) return {};
  return included_files_stay(file, mesh.deck[nastran_folder], "INCLUDE");
}

FormNotes nastran_form(const MeshData& mesh, std::string_view form) {
  if (form.empty() && mesh.variant == kNastran) return {};
  std::size_t coordinates = 0;  // without room in a long field
  std::size_t long_points = 0;  // with such a coordinate
  std::size_t points = 0;       // with one that has no room in a short field
  for (const Point& point : mesh.points) {
    std::size_t here = 0;
    bool is_short = true;
    for (int axis = 0; axis < 3; ++axis) {
      here += nastran_real_field(point[axis], kNastranRoom).empty() ? 1 : 0;
      is_short = is_short && nastran_digits(point[axis]).size() <= kNastranShortRoom;
    }
    coordinates += here;
    long_points += here > 0 ? 1 : 0;
    points += is_short ? 0 : 1;
  }
  FormNotes said;
  if (form == kNastranRounded) {
    if (coordinates > 0) {
      said.lost.push_back(
          fmt::format("{} coordinates are rounded to {} characters, which is what solvers read",
                      grouped(coordinates), kNastranRoom));
    }
  } else if (!form.empty()) {
    const std::size_t free_points = form == kNastranFree ? points : long_points;
    if (free_points > 0) {
      said.remarks.push_back(fmt::format(
          "{} points need more than {} characters for a coordinate: solvers round free fields to "
          "as many, variant '{}' keeps {}",
          grouped(free_points), kNastranShortRoom, kNastranRounded, kNastranRoom));
    }
  } else if (long_points > 0) {
    said.remarks.push_back(fmt::format(
        "{} points need more than {} characters for a coordinate: of such files meshio reads "
        "variant '{}', which has all digits, and '{}'",
        grouped(long_points), kNastranRoom, kNastranFree, kNastranRounded));
  }
  return said;
}

}  // namespace tetmend::formats
