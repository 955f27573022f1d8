// SPDX-License-Identifier: MIT
#include "kernel/formats/xdmf_cells.h"

#include <string>

#include <fmt/format.h>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/xdmf.h"

namespace tetmend::formats {
namespace {

const XdmfType* xdmf_type_of(const XdmfItems& items, const pugi::xml_node& topology,
                             const std::string& name, std::int64_t number) {
  const auto found = std::find_if(kXdmfTypes.begin(), kXdmfTypes.end(), [&](const auto& type) {
    return name.empty() ? type.number == number : type.name == name || type.other == name;
  });
  if (found != kXdmfTypes.end()) return &*found;
  items.fail(topology, fmt::format("cells of type {} cannot be read",
                                   name.empty() ? fmt::format("{}", number) : in_quotes(name)));
}

}  // namespace

XdmfCells read_xdmf_cells(XdmfItems& items, const pugi::xml_node& topology) {
  const std::string name = xdmf_lower_case(
      topology.attribute("TopologyType").as_string(topology.attribute("Type").as_string()));
  const pugi::xml_node item = items.item_of(topology);
  const std::vector<std::int64_t> all = items.integers(item);
  XdmfCells cells;
  if (topology.attribute("BaseOffset").as_llong(0) != 0)
    items.fail(topology, "points that do not count from 0 cannot be read: expected no BaseOffset");
  const XdmfType* type = name == "mixed" ? nullptr : xdmf_type_of(items, topology, name, 0);
  for (std::size_t at = 0; at < all.size();) {
    const XdmfType* of_cell = type != nullptr ? type : xdmf_type_of(items, topology, {}, all[at++]);
    const std::size_t width = element_kind(of_cell->vtk_type)->width;
    if (type == nullptr && of_cell->number <= 2) {  // how many points a line has
      if (at < all.size() && all[at] != static_cast<std::int64_t>(width))
        items.fail(item,
                   fmt::format("lines of {} points cannot be read: expected {}", all[at], width));
      ++at;
    }
    if (at > all.size() || width > all.size() - at)
      items.fail(item, "the numbers end within a cell");
    for (std::size_t k = 0; k < width; ++k) cells.vertices.push_back(all[at++]);
    cells.add(of_cell->vtk_type);
  }
  const pugi::xml_attribute width = topology.attribute("NodesPerElement");
  if (type != nullptr && width && width.as_ullong() != element_kind(type->vtk_type)->width) {
    items.fail(topology, fmt::format("cells of {} points cannot be read: expected {}",
                                     width.as_ullong(), element_kind(type->vtk_type)->width));
  }
  const pugi::xml_attribute count = topology.attribute("NumberOfElements");
  if (count && count.as_ullong() != cells.types.size()) {
    items.fail(topology, fmt::format("{} cells are here: expected {}", cells.types.size(),
                                     count.as_ullong()));
  }
  return cells;
}

}  // namespace tetmend::formats
