// SPDX-License-Identifier: MIT
// Writes XDMF files and the tables of HDF5 beside them.
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/output_file.h"
#include "kernel/formats/unique_names.h"
#include "kernel/formats/vtu_array.h"
#include "kernel/formats/xdmf.h"
#include "kernel/printable.h"

namespace tetmend::formats {
namespace {

constexpr std::size_t kCellsOfPolygon = 2;  // types up to this say how many points a cell has

std::filesystem::path tables_beside(const std::filesystem::path& file) {
  return std::filesystem::path(file).replace_extension(".h5");
}

const XdmfType& xdmf_type(const ElementKind& kind) {
  return *std::find_if(kXdmfTypes.begin(), kXdmfTypes.end(),
                       [&](const XdmfType& type) { return type.vtk_type == kind.vtk_type; });
}

class XdmfWriter {
 public:
  XdmfWriter(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file),
        tables_out_(tables_beside(file)),
        tables_(make_hdf5(tables_beside(file).string(), "XDMF")),
        tables_name_(tables_beside(file).filename().string()),
        mesh_(mesh),
        lists_(mesh) {}

  void write() {
    mesh_name_ = name_of("mesh", "mesh");
    out_.put(
        "<?xml version=\"1.0\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
        "<Xdmf Version=\"3.0\" xmlns:xi=\"https://www.w3.org/2001/XInclude\">\n  <Domain>\n");
    write_mesh();
    constexpr std::array<const char*, 4> kNames = {"", "edge_tags", "facet_tags", "cell_tags"};
    for (int dimension = 3; dimension > 0; --dimension) {
      const std::string key = fmt::format("tags {}", dimension);
      write_tags(dimension, name_of(key, kNames[static_cast<std::size_t>(dimension)]));
    }
    out_.put("  </Domain>\n</Xdmf>\n");
    tables_out_.put(tables_->bytes());
    const std::array<OutputFile*, 2> both = {&tables_out_, &out_};
    OutputFile::commit_all(both, mesh_.companions());
  }

 private:
  /// As the file had it that the mesh was read from.
  std::string name_of(std::string_view what, std::string_view otherwise) const {
    const MeshData* data = mesh_.data();
    const std::string begin = std::string(what) + '\0';
    for (std::size_t i = 0; data != nullptr && i < data->deck.size(); ++i) {
      if (data->variant == kXdmf && data->deck[i].starts_with(begin)) {
        return data->deck[i].substr(begin.size());
      }
    }
    return std::string(otherwise);
  }

  /// A table, and the element that names it.
  std::string item(const std::string& path, const DataArray::Values& values, std::size_t columns) {
    constexpr std::array<const char*, 4> kTypes = {
        "NumberType=\"Int\" Precision=\"4\"", "NumberType=\"Int\" Precision=\"8\"",
        "NumberType=\"Float\" Precision=\"4\"", "NumberType=\"Float\" Precision=\"8\""};
    const std::size_t size = std::visit([](const auto& numbers) { return numbers.size(); }, values);
    tables_->write(path, values, columns);
    return fmt::format("<DataItem Dimensions=\"{}{}\" {} Format=\"HDF\">{}:/{}</DataItem>",
                       size / std::max<std::size_t>(columns, 1),
                       columns == 0 ? "" : fmt::format(" {}", columns), kTypes[values.index()],
                       xml_escaped(tables_name_), xml_escaped(path));
  }

  void write_mesh() {
    out_.put(fmt::format("    <Grid Name=\"{}\" GridType=\"Uniform\">\n", xml_escaped(mesh_name_)));
    std::vector<const ElementList*> cells = lists_.of_dimension(3);
    if (cells.empty()) cells = lists_.of_dimension(2);
    write_topology(cells, "Mesh/" + path_of(mesh_name_) + "/topology");
    std::vector<double> points;
    points.reserve(3 * mesh_.point_count());
    for (std::size_t i = 0; i < mesh_.point_count(); ++i) {
      for (int axis = 0; axis < 3; ++axis) points.push_back(mesh_.point(i)[axis]);
    }
    out_.put(fmt::format("      <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                         item("Mesh/" + path_of(mesh_name_) + "/geometry", points, 3)));
    if (mesh_.data() != nullptr) write_arrays(cells);
    out_.put("    </Grid>\n");
  }

  /// Of paths in HDF5, which stand in XML: as text, without blanks at the ends.
  static std::string path_of(const std::string& name) {
    return fit_name(printable(name), {.slash = '_'});
  }

  void write_topology(const std::vector<const ElementList*>& cells, const std::string& path) {
    std::size_t count = 0;
    std::vector<std::int64_t> nodes;
    for (const ElementList* list : cells) {
      count += list->count;
      const XdmfType& type = xdmf_type(list->kind);
      for (std::size_t i = 0; i < list->count; ++i) {
        if (cells.size() > 1) {
          nodes.push_back(type.number);
          if (static_cast<std::size_t>(type.number) <= kCellsOfPolygon)
            nodes.push_back(static_cast<std::int64_t>(list->kind.width));
        }
        for (const std::uint32_t v : list->vertices(i)) nodes.push_back(v);
      }
    }
    const bool is_one = cells.size() == 1;
    std::string name = is_one ? std::string(xdmf_type(cells[0]->kind).name) : "mixed";
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
    if (name == "Polyline") name = "PolyLine";
    const std::size_t width = is_one ? cells[0]->kind.width : 0;
    out_.put(
        fmt::format("      <Topology TopologyType=\"{}\" NumberOfElements=\"{}\"{}>{}</Topology>\n",
                    name, count, is_one ? fmt::format(" NodesPerElement=\"{}\"", width) : "",
                    item(path, std::move(nodes), width)));
  }

  void write_arrays(const std::vector<const ElementList*>& cells) {
    UniqueNames names;
    for (const DataArray& array : mesh_.data()->point_data)
      write_attribute(array.name, "Node", array.components, array.values,
                      "Data/points/" + names.make(path_of(array.name)));
    if (cells.size() != 1 || cells[0]->data == nullptr) return;  // see not_in_xdmf()
    for (const DataArray& array : *cells[0]->data)
      write_attribute(array.name, "Cell", array.components, array.values,
                      "Data/cells/" + names.make(path_of(array.name)));
  }

  void write_attribute(const std::string& name, std::string_view center, std::size_t components,
                       const DataArray::Values& values, const std::string& path) {
    const std::string_view type = components == 1   ? "Scalar"
                                  : components == 3 ? "Vector"
                                  : components == 9 ? "Tensor"
                                                    : "Matrix";
    out_.put(fmt::format(
        "      <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
        xml_escaped(name), type, center, item(path, values, components)));
  }

  /// All elements of a dimension, if any has a label or they are not those of the mesh.
  void write_tags(int dimension, const std::string& name) {
    const std::vector<const ElementList*> cells = lists_.of_dimension(dimension);
    std::vector<std::int32_t> labels;
    for (const ElementList* list : cells) {
      for (std::size_t i = 0; i < list->count; ++i) labels.push_back(list->label(i));
    }
    const bool is_bare =
        std::all_of(labels.begin(), labels.end(), [](Label label) { return label == 0; });
    if (cells.empty() || (dimension == 3 && is_bare)) return;
    const std::string path = "MeshTags/" + paths_.make(path_of(name));
    out_.put(fmt::format(
        "    <Grid Name=\"{}\" GridType=\"Uniform\">\n"
        "      <xi:include xpointer=\"xpointer(/Xdmf/Domain/Grid[@Name='{}']/Geometry)\" />\n",
        xml_escaped(name), xml_escaped(mesh_name_)));
    write_topology(cells, path + "/topology");
    write_attribute(name, "Cell", 1, std::move(labels), path + "/Values");
    out_.put("    </Grid>\n");
  }

  OutputFile out_, tables_out_;
  std::unique_ptr<Hdf5Writer> tables_;
  std::string tables_name_;
  const MeshView& mesh_;
  ElementLists lists_;
  std::string mesh_name_;
  UniqueNames paths_;
};

}  // namespace

std::vector<std::filesystem::path> xdmf_files(const std::filesystem::path& file) {
  return {file, tables_beside(file)};
}

std::vector<std::string> not_in_xdmf(const std::filesystem::path&, const MeshData& mesh) {
  std::vector<std::string> notes;
  const auto lose = [&](const std::vector<DataArray>& arrays, std::string_view of) {
    for (const DataArray& array : arrays) {
      notes.push_back(
          fmt::format("the array '{}' of {} is not kept: .xdmf has arrays of one kind of cells",
                      printable(array.name), of));
    }
  };
  const MeshView view(mesh);
  const ElementLists lists(view);
  for (const ElementList& list : lists.all()) {
    const bool is_only = list.kind.dimension == 3 && lists.of_dimension(3).size() == 1;
    if (list.data != nullptr && !is_only && list.kind.dimension == 3)
      lose(*list.data, list.kind.name);
  }
  return notes;
}

void write_xdmf(const std::filesystem::path& file, const MeshView& mesh) {
  XdmfWriter(file, mesh).write();
}

}  // namespace tetmend::formats
