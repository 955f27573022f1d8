// SPDX-License-Identifier: MIT
// Reads XDMF files.
//
//   <Xdmf> <Domain> <Grid Name GridType>
//     <Topology TopologyType NumberOfElements> DataItem
//     <Geometry GeometryType>                  DataItem
//     <Attribute Name Center AttributeType>    DataItem
//
// A DataItem holds its numbers, or names a table of a file of HDF5. Grids of tags take the geometry of another
// by xi:include.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/text_reader.h"
#include "kernel/formats/vtk_cells.h"
#include "kernel/formats/xdmf.h"
#include "kernel/formats/xdmf_cells.h"
#include "kernel/formats/xdmf_items.h"

namespace tetmend::formats {
namespace {

class XdmfReader {
 public:
  XdmfReader(const InputFile& file, const std::filesystem::path& path, const ReadRequest& request)
      : file_(file),
        text_(file, TextReader::kNoComments),
        items_(file, path.parent_path()),
        request_(request) {}

  MeshData read() {
    parse();
    collect(document_.child("Xdmf").child("Domain"));
    find_mesh();
    read_points();
    cells_ = read_xdmf_cells(items_, mesh_grid_.child("Topology"));
    mesh_cells_ = cells_.types.size();
    for (const pugi::xml_node grid : grids_) read_attributes(grid);
    adopt();
    mesh_.variant = kXdmf;
    return std::move(mesh_);
  }

 private:
  // ---- The XML ------------------------------------------------------------------------------------

  [[noreturn]] void fail(const pugi::xml_node& node, std::string_view reason) const {
    items_.fail(node, reason);
  }

  void parse() {
    if (file_.size() == 0) file_.fail_at_line(file_.begin(), "the file is empty: expected Xdmf");
    const pugi::xml_parse_result result = document_.load_buffer(file_.begin(), file_.size());
    if (!result) {
      const auto at =
          std::clamp<std::ptrdiff_t>(result.offset, 0, static_cast<std::ptrdiff_t>(file_.size()));
      file_.fail_at_line(file_.begin() + at,
                         fmt::format("the XML is broken: {}", result.description()));
    }
    if (!document_.child("Xdmf")) file_.fail_at_line(file_.begin(), "expected the element Xdmf");
  }

  /// All grids without further ones; of steps those of the first.
  void collect(const pugi::xml_node& parent, int depth = 0) {
    constexpr int kDeepest = 100;
    if (depth > kDeepest) fail(parent, "more than 100 grids lie in each other");
    std::size_t steps = 0;
    for (const pugi::xml_node grid : parent.children("Grid")) {
      const std::string kind = xdmf_lower_case(grid.attribute("GridType").as_string("uniform"));
      const bool is_step =
          xdmf_lower_case(parent.attribute("CollectionType").as_string()) == "temporal";
      if (is_step && ++steps > 1) continue;
      if (kind == "uniform") {
        grids_.push_back(grid);
      } else {
        collect(grid, depth + 1);
      }
    }
    if (steps > 1) {
      mesh_.notes.push_back(fmt::format("of the {} steps of {} only the first is kept", steps,
                                        in_quotes(parent.attribute("Name").as_string())));
    }
  }

  void find_mesh() {
    for (const pugi::xml_node grid : grids_) {
      const pugi::xml_node topology = grid.child("Topology");
      if (!topology || (!grid.child("Geometry") && grids_.size() > 1)) continue;
      const std::string type = xdmf_lower_case(
          topology.attribute("TopologyType").as_string(topology.attribute("Type").as_string()));
      if (mesh_grid_ && !(type.starts_with("tet") || type == "mixed")) continue;
      const bool is_better = !mesh_grid_ || !has_volumes_;
      if (!is_better) continue;
      mesh_grid_ = grid;
      has_volumes_ = type.starts_with("tet") || type == "mixed";
    }
    if (!mesh_grid_) fail(document_.child("Xdmf"), "no grid with topology and geometry is here");
    mesh_.deck.push_back(std::string("mesh") + '\0' +
                         mesh_grid_.attribute("Name").as_string("mesh"));
  }

  // ---- Points and cells ---------------------------------------------------------------------------

  void read_points() {
    const pugi::xml_node geometry = mesh_grid_.child("Geometry");
    const std::string type =
        geometry.attribute("GeometryType").as_string(geometry.attribute("Type").as_string("XYZ"));
    const bool is_by_axis = xdmf_lower_case(type) == "x_y_z";
    if (!is_by_axis && xdmf_lower_case(type) != "xyz") {
      fail(geometry,
           fmt::format("the geometry {} cannot be read: expected XYZ or X_Y_Z", in_quotes(type)));
    }
    const pugi::xml_node item = items_.item_of(geometry);
    const std::vector<double> all = is_by_axis ? axes_of(item) : items_.reals(item);
    if (all.size() % 3 != 0 || all.size() / 3 > kMostVertices)
      fail(item, fmt::format("{} numbers are not three for each point", all.size()));
    mesh_.points.resize(all.size() / 3);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!std::isfinite(all[i]))
        fail(item, fmt::format("a coordinate of point {} is not finite", i / 3 + 1));
      mesh_.points[i / 3][static_cast<Eigen::Index>(i % 3)] = all[i];
    }
  }

  /// Three lists, as one of points.
  std::vector<double> axes_of(pugi::xml_node item) {
    std::vector<double> all;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<double> of_axis = items_.reals(item);
      if (axis == 0) all.resize(3 * of_axis.size());
      if (3 * of_axis.size() != all.size()) fail(item, "the axes have different lengths");
      for (std::size_t i = 0; i < of_axis.size(); ++i) all[3 * i + axis] = of_axis[i];
      const pugi::xml_node next = item.next_sibling("DataItem");
      if (axis < 2 && !next) fail(item, "three lists of coordinates were expected");
      item = next;
    }
    return all;
  }

  // ---- Attributes ---------------------------------------------------------------------------------

  /// Of the mesh, or of a grid of some of its cells, faces and edges.
  void read_attributes(const pugi::xml_node& grid) {
    std::vector<std::uint32_t> rows;  // of the cells of the mesh and of what was added
    const bool has_cells = grid != mesh_grid_ && grid.child("Topology");
    const bool has_points = grid != mesh_grid_ && grid.child("Geometry");
    if (has_points && !same_geometry(grid)) {
      mesh_.notes.push_back(fmt::format("the grid {} is not kept: it has points of its own",
                                        in_quotes(grid.attribute("Name").as_string())));
      return;
    }
    if (has_cells) {
      const XdmfCells cells = read_xdmf_cells(items_, grid.child("Topology"));
      const std::size_t before = cells_.types.size();
      for (std::size_t i = 0; i < cells.types.size(); ++i) rows.push_back(find(cells, i, before));
      if (!cells.types.empty()) remember(grid, static_cast<int>(cells.types[0]));
    } else {
      for (std::uint32_t i = 0; i < mesh_cells_; ++i) rows.push_back(i);
    }
    for (const pugi::xml_node attribute : grid.children("Attribute"))
      read_attribute(attribute, rows, has_cells);
  }

  bool same_geometry(const pugi::xml_node& grid) const {
    const auto text = [](const pugi::xml_node& of) {
      return std::string(of.child("Geometry").child("DataItem").text().as_string());
    };
    return text(grid) == text(mesh_grid_);
  }

  /// Tags are written under the name of their grid.
  void remember(const pugi::xml_node& grid, int vtk_type) {
    const std::string name = grid.attribute("Name").as_string();
    if (!name.empty()) {
      mesh_.deck.push_back(
          fmt::format("tags {}{}{}", element_kind(vtk_type)->dimension, '\0', name));
    }
  }

  /// The row of a cell in all arrays; one that no grid before had goes to the end.
  /// @param before  how many cells these grids have
  std::uint32_t find(const XdmfCells& cells, std::size_t i, std::size_t before) {
    const auto vertices = cells.of(i);
    // Most tags are those of all cells in their order.
    if (i < before && cells_.types[i] == cells.types[i] &&
        std::equal(vertices.begin(), vertices.end(), cells_.of(i).begin())) {
      return static_cast<std::uint32_t>(i);
    }
    Known& known = known_[cells.types[i]];
    for (; known.end < before; ++known.end) {
      if (cells_.types[known.end] == cells.types[i])
        known.number_of.emplace(cells_.sorted(known.end), known.end);
    }
    const auto found = known.number_of.find(cells.sorted(i));
    if (found != known.number_of.end()) return static_cast<std::uint32_t>(found->second);
    cells_.vertices.insert(cells_.vertices.end(), vertices.begin(), vertices.end());
    cells_.add(static_cast<int>(cells.types[i]));
    return static_cast<std::uint32_t>(cells_.types.size() - 1);
  }

  void read_attribute(const pugi::xml_node& attribute, const std::vector<std::uint32_t>& rows,
                      bool are_tags) {
    const std::string center = xdmf_lower_case(attribute.attribute("Center").as_string("node"));
    const std::string name = attribute.attribute("Name").as_string();
    const pugi::xml_node item = items_.item_of(attribute);
    const std::size_t count = center == "cell" ? rows.size() : mesh_.points.size();
    DataArray array{name, 1, items_.values(item)};
    if ((center != "cell" && center != "node") || count == 0 || array.size() % count != 0 ||
        array.size() == 0 || items_.dimensions(item)[0] != count) {
      mesh_.notes.push_back(
          fmt::format("the attribute {} is not kept: it has not one value for each {}",
                      in_quotes(name), center == "cell" ? "cell" : "point"));
      return;
    }
    array.components = array.size() / count;
    if (center == "node") {
      point_arrays_.push_back(std::move(array));
    } else {
      (are_tags && array.components == 1 ? tags_ : arrays_).push_back({std::move(array), rows});
    }
  }

  struct Part {
    DataArray array;
    std::vector<std::uint32_t> rows;
  };

  /// Spread over all cells: 0 where there is none.
  DataArray spread(const Part& part) const {
    DataArray whole{part.array.name, part.array.components, {}};
    std::visit(
        [&](const auto& from) {
          std::decay_t<decltype(from)> all(cells_.types.size() * whole.components);
          for (std::size_t i = 0; i < part.rows.size(); ++i) {
            std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(i * whole.components),
                        whole.components,
                        all.begin() + static_cast<std::ptrdiff_t>(part.rows[i] * whole.components));
          }
          whole.values = std::move(all);
        },
        part.array.values);
    return whole;
  }

  /// The first tags of each dimension are labels, the others arrays like those of the mesh.
  void adopt() {
    std::vector<DataArray> all;
    std::string labels = request_.label_array;
    std::set<int> tagged;
    for (const Part& part : tags_) {
      const std::int64_t type = part.rows.empty() ? 0 : cells_.types[part.rows[0]];
      const ElementKind* kind = element_kind(type);
      const bool is_first = kind != nullptr && tagged.insert(kind->dimension).second;
      DataArray whole = spread(part);
      if (!is_first || all.empty() || whole.values.index() != all[0].values.index()) {
        all.push_back(std::move(whole));
      } else {
        add(all[0], whole);
      }
    }
    if (labels.empty() && !all.empty()) labels = all[0].name;
    for (const Part& part : arrays_) all.push_back(spread(part));
    std::map<std::string, std::set<std::int64_t>> types_of;  // that an array has values of
    for (const auto* parts : {&tags_, &arrays_}) {
      for (const Part& part : *parts) {
        for (const std::uint32_t row : part.rows)
          types_of[part.array.name].insert(cells_.types[row]);
      }
    }
    VtkCells cells;
    cells.count = cells_.types.size();
    cells.has_offsets = true;
    cells_.ends.insert(cells_.ends.begin(), 0);
    cells.offsets = VtkIntegers(std::move(cells_.ends), file_.begin());
    cells.connectivity = VtkIntegers(std::move(cells_.vertices), file_.begin());
    cells.types = VtkIntegers(std::move(cells_.types), file_.begin());
    const CellNumbers numbers = cells.append_to(mesh_, text_, request_.question);
    const auto failure = [this](std::size_t, std::size_t i, std::string_view reason) {
      file_.fail_at_line(file_.begin(), fmt::format("value {} of an attribute: {}", i, reason));
    };
    adopt_cell_arrays(mesh_, std::move(all), numbers, {labels, failure});
    adopt_point_arrays(mesh_, std::move(point_arrays_), failure);
    drop_without_values(types_of);
  }

  /// Arrays of kinds of cells that no grid has values for.
  void drop_without_values(const std::map<std::string, std::set<std::int64_t>>& types_of) {
    const auto drop = [&](std::vector<DataArray>& of, int type) {
      std::erase_if(of, [&](const DataArray& array) {
        const auto found = types_of.find(array.name);
        return found != types_of.end() && !found->second.contains(type);
      });
    };
    drop(mesh_.tet_data, vtk_tet);
    drop(mesh_.triangle_data, vtk_triangle);
    drop(mesh_.edge_data, vtk_edge);
    for (OtherElements& others : mesh_.other_elements) drop(others.data, others.vtk_type);
  }

  /// Where one has a value, the other has none.
  static void add(DataArray& to, const DataArray& from) {
    std::visit(
        [&](auto& values) {
          const auto& more = std::get<std::decay_t<decltype(values)>>(from.values);
          for (std::size_t i = 0; i < values.size(); ++i) {
            if (more[i] != 0) values[i] = more[i];
          }
        },
        to.values);
  }

  const InputFile& file_;
  TextReader text_;
  XdmfItems items_;
  const ReadRequest& request_;
  pugi::xml_document document_;
  std::vector<pugi::xml_node> grids_;
  pugi::xml_node mesh_grid_;
  bool has_volumes_ = false;
  MeshData mesh_;
  XdmfCells cells_;
  std::size_t mesh_cells_ = 0;  // of these: of the grid of the mesh
  /// The numbers of cells of one type, up to `end`.
  struct Known {
    std::map<std::vector<std::int64_t>, std::size_t> number_of;
    std::size_t end = 0;
  };
  std::map<std::int64_t, Known> known_;  // by type
  std::vector<Part> tags_, arrays_;
  std::vector<DataArray> point_arrays_;
};

}  // namespace

MeshData read_xdmf(const std::filesystem::path& path, const ReadRequest& request) {
  const InputFile file(path);
  return XdmfReader(file, path, request).read();
}

}  // namespace tetmend::formats
