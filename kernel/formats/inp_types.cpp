// SPDX-License-Identifier: MIT
// The element types of Abaqus and CalculiX, and what VTK calls them.
#include "kernel/formats/inp_types.h"

#include <algorithm>
#include <string>

#include "kernel/formats/inp_lines.h"

namespace tetmend::formats {
namespace {

struct Family {
  std::string_view prefix;  ///< before the number of nodes
  int dimension;
};

// Of two that fit the longer one counts; so it comes first.
constexpr std::array<Family, 34> kFamilies = {{
    {"SFM3D", 2}, {"DC1D", 1},  {"DC2D", 2},    {"DC3D", 3},  {"AC2D", 2}, {"AC3D", 3},
    {"CPEG", 2},  {"COH3D", 3}, {"DCC3D", 3},   {"EC3D", 3},  {"FC3D", 3}, {"GK3D", 3},
    {"QC3D", 3},  {"STRI", 2},  {"C3D", 3},     {"F3D", 3},   {"CPS", 2},  {"CPE", 2},
    {"CAX", 2},   {"DCAX", 2},  {"M3D", 2},     {"R3D", 2},   {"T2D", 1},  {"T3D", 1},
    {"R2D", 1},   {"DS", 2},    {"SC", 3},      {"S", 2},     {"B2", 1},   {"B3", 1},
    {"PIPE2", 1}, {"PIPE3", 1}, {"FRAME3D", 1}, {"EMC3D", 3},
}};

struct Cell {
  int dimension;
  std::size_t nodes;
  int vtk_type;
};
constexpr std::array<Cell, 14> kCells = {{{3, 4, kVtkTet},
                                          {3, 5, 14},
                                          {3, 6, 13},
                                          {3, 8, 12},
                                          {3, 10, kVtkTet10},
                                          {3, 13, 27},
                                          {3, 15, 26},
                                          {3, 20, 25},
                                          {2, 3, kVtkTriangle},
                                          {2, 4, 9},
                                          {2, 6, kVtkTriangle6},
                                          {2, 8, 23},
                                          {1, 2, kVtkEdge},
                                          {1, 3, 21}}};

/// Digits behind the prefix; beams count their order, not their nodes: B31 has two.
std::size_t node_count(const Family& family, std::string_view digits) {
  std::size_t count = 0;
  std::size_t used = 0;
  while (used < digits.size() && used < 2 && digits[used] >= '0' && digits[used] <= '9') {
    count = 10 * count + static_cast<std::size_t>(digits[used++] - '0');
  }
  const bool is_beam = family.prefix.ends_with('2') || family.prefix.ends_with('3');
  if (family.prefix == "STRI") return count == 65 ? 6 : count;  // 5 degrees of freedom, not nodes
  if (is_beam) return count == 1 || count == 3 ? 2 : count == 2 ? 3 : 0;
  // S8R5 has an R between; S55 would be nothing.
  return count;
}

}  // namespace

InpType inp_type(std::string_view name) {
  const std::string key = inp_key(name);
  if (key == "C3D15V" || key == "C3D15VH") return {InpType::Kind::refused, 0, 18, 3};
  const Family* best = nullptr;
  for (const Family& family : kFamilies) {
    const bool fits = key.starts_with(family.prefix) && key.size() > family.prefix.size() &&
                      key[family.prefix.size()] >= '0' && key[family.prefix.size()] <= '9';
    if (fits && (best == nullptr || family.prefix.size() > best->prefix.size())) best = &family;
  }
  if (best == nullptr) return {};
  const std::size_t nodes = node_count(*best, std::string_view(key).substr(best->prefix.size()));
  for (const Cell& cell : kCells) {
    if (cell.dimension == best->dimension && cell.nodes == nodes) {
      return {InpType::Kind::mesh, cell.vtk_type, nodes, cell.dimension};
    }
  }
  if (best->dimension == 3) return {InpType::Kind::refused, 0, nodes, 3};
  return {};
}

std::string_view inp_type_name(int vtk_type) {
  switch (vtk_type) {
    case kVtkEdge:
      return "T3D2";
    case 21:
      return "T3D3";
    case kVtkTriangle:
      return "S3";
    case kVtkTriangle6:
      return "S6";
    case 9:
      return "S4";
    case 23:
      return "S8";
    case kVtkTet:
      return "C3D4";
    case kVtkTet10:
      return "C3D10";
    case 12:
      return "C3D8";
    case 25:
      return "C3D20";
    case 13:
      return "C3D6";
    case 26:
      return "C3D15";
    case 14:
      return "C3D5";
    default:
      return {};
  }
}

}  // namespace tetmend::formats
