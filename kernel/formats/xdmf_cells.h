// SPDX-License-Identifier: MIT
// The cells of a grid of an XDMF file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <pugixml.hpp>

#include "kernel/formats/xdmf_items.h"

namespace tetmend::formats {

/// Cells of a grid, one after the other.
struct XdmfCells {
  std::vector<std::int64_t> types, vertices, ends;

  void add(int vtk_type) {
    types.push_back(vtk_type);
    ends.push_back(static_cast<std::int64_t>(vertices.size()));
  }
  std::span<const std::int64_t> of(std::size_t i) const {
    const auto begin = static_cast<std::size_t>(i == 0 ? 0 : ends[i - 1]);
    return std::span(vertices).subspan(begin, static_cast<std::size_t>(ends[i]) - begin);
  }
  std::vector<std::int64_t> sorted(std::size_t i) const {
    std::vector<std::int64_t> all(of(i).begin(), of(i).end());
    std::sort(all.begin(), all.end());
    return all;
  }
};

/// Of an element Topology. Numbers of points are not checked. @throws Error
XdmfCells read_xdmf_cells(XdmfItems& items, const pugi::xml_node& topology);

}  // namespace tetmend::formats
