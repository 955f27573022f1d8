// SPDX-License-Identifier: MIT
// Nodes and sides of the elements of Exodus II.
#include <algorithm>
#include <cctype>
#include <string>

#include "kernel/formats/exodus.h"

namespace tetmend::formats {
namespace {

constexpr std::array<FaceCorners, 4> kTetSides = {
    {{0, 1, 3, kNoCorner}, {1, 2, 3, kNoCorner}, {0, 3, 2, kNoCorner}, {0, 2, 1, kNoCorner}}};
constexpr std::array<FaceCorners, 6> kHexahedronSides = {
    {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {0, 4, 7, 3}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
constexpr std::array<FaceCorners, 5> kPrismSides = {
    {{0, 1, 4, 3}, {1, 2, 5, 4}, {0, 3, 5, 2}, {0, 2, 1, kNoCorner}, {3, 4, 5, kNoCorner}}};
constexpr std::array<FaceCorners, 5> kPyramidSides = {{{0, 1, 4, kNoCorner},
                                                       {1, 2, 4, kNoCorner},
                                                       {2, 3, 4, kNoCorner},
                                                       {0, 4, 3, kNoCorner},
                                                       {0, 3, 2, 1}}};
constexpr std::array<FaceCorners, 2> kTriangleSides = {
    {{0, 1, 2, kNoCorner}, {0, 2, 1, kNoCorner}}};
constexpr std::array<FaceCorners, 2> kQuadSides = {{{0, 1, 2, 3}, {0, 3, 2, 1}}};

/// In upper case, without what follows the letters.
std::string letters_of(std::string_view name) {
  std::string letters(name.substr(0, name.find_last_not_of("0123456789 ") + 1));
  std::transform(letters.begin(), letters.end(), letters.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return letters;
}

}  // namespace

const ElementKind* exodus_kind(std::string_view name, std::uint64_t width) {
  const std::string letters = letters_of(name);
  for (const ExodusType& type : kExodusTypes) {
    const ElementKind* kind = element_kind(type.vtk_type);
    if (letters == type.begin && kind->width == width) return kind;
  }
  return nullptr;
}

bool is_exodus_volume(std::string_view name) {
  const std::string letters = letters_of(name);
  for (const char* volume : {"TET", "HEX", "WEDGE", "PYR", "NFACED"}) {
    if (letters.starts_with(volume)) return true;
  }
  return false;
}

std::span<const FaceCorners> exodus_sides(const ElementKind& kind) {
  if (kind.dimension == 2) {
    if (kind.corners == 3) return kTriangleSides;
    return kQuadSides;
  }
  if (kind.dimension < 3) return {};
  switch (kind.corners) {
    case 4:
      return kTetSides;
    case 5:
      return kPyramidSides;
    case 6:
      return kPrismSides;
    default:
      return kHexahedronSides;
  }
}

bool is_exodus_name(std::string_view name) {
  return fits(name, kExodusNames);
}

std::size_t exodus_pieces_to_miss(const MeshData& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.deck.begin(), mesh.deck.end(),
                    [](const std::string& piece) { return piece.starts_with("info"); }));
}

std::size_t exodus_numbers_to_miss(const MeshData& mesh) {
  const auto is_missed = [](const std::string& piece) {
    const std::string_view whole = piece;
    const std::string_view what = whole.substr(0, whole.find('\0'));
    if (what != kShellNumbers && what != kElementSetNumbers) return false;
    const std::string_view numbers = whole.substr(what.size() + 1);
    const std::size_t space = numbers.find(' ');
    return numbers.substr(0, space) != numbers.substr(space + 1);
  };
  return static_cast<std::size_t>(std::count_if(mesh.deck.begin(), mesh.deck.end(), is_missed));
}

}  // namespace tetmend::formats
