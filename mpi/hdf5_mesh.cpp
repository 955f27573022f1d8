// SPDX-License-Identifier: MIT
#include "mpi/hdf5_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/output_file.h"
#include "kernel/formats/vtu_array.h"
#include "mpi/hdf5_arrays.h"
#include "mpi/hdf5_file.h"
#include "mpi/mpi_ranks.h"

namespace tetmend::mpi {

namespace {

template <std::size_t N>
using Elements = std::vector<pieces::RankShare::Element<N>>;

template <std::size_t N>
void read_elements(const Hdf5File& file, const char* name, const char* labels,
                   Elements<N>& elements) {
  if (!file.has(name)) return;
  const auto numbers = file.read<std::int64_t>(name, N);
  std::vector<std::int32_t> label;
  if (file.has(labels)) label = file.read<std::int32_t>(labels, 1);
  elements.resize(numbers.size() / N);
  if (!label.empty() && label.size() != elements.size()) {
    file.fail(fmt::format("/{} and /{} do not have the same length", name, labels));
  }
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (std::size_t k = 0; k < N; ++k) {
      elements[i].vertices[k] = static_cast<std::uint64_t>(numbers[N * i + k]);
    }
    if (!label.empty()) elements[i].label = label[i];
  }
}

/// Writes the arrays of one rank where they belong among those of all.
class Writer {
 public:
  Writer(const Hdf5File& file, MPI_Comm ranks) : file_(file), ranks_(ranks) {}

  template <class Number>
  void write(const char* name, const std::vector<Number>& numbers, std::size_t width) {
    std::string mine(sizeof(std::uint64_t), '\0');
    const std::uint64_t rows = numbers.size() / width;
    std::memcpy(mine.data(), &rows, sizeof(rows));
    std::uint64_t begin = 0;
    std::uint64_t total = 0;
    const std::vector<std::string> all = ranks_.gather(mine);
    for (std::size_t r = 0; r < all.size(); ++r) {
      std::uint64_t theirs = 0;
      std::memcpy(&theirs, all[r].data(), sizeof(theirs));
      if (r < ranks_.number()) begin += theirs;
      total += theirs;
    }
    file_.write(name, numbers, begin, total, width);
  }

  template <std::size_t N>
  void write(const char* name, const char* labels, const Elements<N>& elements) {
    std::vector<std::int64_t> numbers;
    std::vector<std::int32_t> label;
    for (const auto& element : elements) {
      for (const std::uint64_t v : element.vertices) {
        numbers.push_back(static_cast<std::int64_t>(v));
      }
      label.push_back(element.label);
    }
    write(name, numbers, N);
    write(labels, label, 1);
  }

 private:
  const Hdf5File& file_;
  MpiRanks ranks_;
};

Hdf5Counts by_kind(const pieces::ArrayCounts& counts) {
  Hdf5Counts all;
  all[pieces::RowKind::point] = counts.points;
  all[pieces::RowKind::tet] = counts.tets;
  all[pieces::RowKind::triangle] = counts.triangles;
  all[pieces::RowKind::edge] = counts.edges;
  return all;
}

void write_arrays(const std::filesystem::path& name, const pieces::RankShare& arrays,
                  const pieces::ArrayCounts& counts, bool has_labels, MPI_Comm ranks) {
  const Hdf5File file(name, Hdf5File::Access::write, ranks);
  Writer writer(file, ranks);
  std::vector<double> coordinates;
  for (const Point& p : arrays.points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  writer.write("geometry", coordinates, 3);
  coordinates = {};
  writer.write("connect", "group", arrays.tets);
  if (counts.triangles > 0) writer.write("triangles", "triangle_labels", arrays.triangles);
  if (counts.edges > 0) writer.write("edges", "edge_labels", arrays.edges);
  if (counts.required_vertices > 0) {
    const std::vector<std::int64_t> required(arrays.required_vertices.begin(),
                                             arrays.required_vertices.end());
    writer.write("required_vertices", required, 1);
  }
  if (has_labels) {
    std::vector<std::int32_t> labels(arrays.point_labels.begin(), arrays.point_labels.end());
    labels.resize(arrays.points.size(), 0);
    writer.write("vertex_labels", labels, 1);
  }
  MpiRanks all(ranks);
  write_hdf5_arrays(file, arrays.arrays, by_kind(counts), all);
}

/// What ParaView needs to know of the arrays of points or tets.
std::string describe_arrays(const std::string& file, const std::vector<DataArray>& arrays,
                            pieces::RowKind kind, std::uint64_t rows) {
  if (rows == 0) return {};
  const std::vector<std::string> tables = hdf5_table_names(arrays);
  std::string text;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const DataArray& array = arrays[i];
    const bool is_real = array.values.index() >= 2;
    const bool is_long = array.values.index() % 2 == 1;
    const std::string_view form = array.components == 1   ? "Scalar"
                                  : array.components == 3 ? "Vector"
                                                          : "Matrix";
    text += fmt::format(
        R"(   <Attribute Name="{}" AttributeType="{}" Center="{}">
    <DataItem NumberType="{}" Precision="{}" Format="HDF" Dimensions="{}{}">{}:/{}/{}</DataItem>
   </Attribute>
)",
        formats::xml_escaped(array.name), form, kind == pieces::RowKind::point ? "Node" : "Cell",
        is_real ? "Float" : "Int", is_long ? 8 : 4, rows,
        array.components == 1 ? "" : fmt::format(" {}", array.components),
        formats::xml_escaped(file), hdf5_group_of(kind), formats::xml_escaped(tables[i]));
  }
  return text;
}

/// What ParaView needs to know; see xdmf.org.
std::string description(const std::string& name, const pieces::ArrayCounts& counts,
                        const pieces::KindArrays& arrays) {
  return fmt::format(
      R"(<?xml version="1.0" ?>
<Xdmf Version="2.0">
 <Domain>
  <Grid Name="mesh" GridType="Uniform">
   <Topology TopologyType="Tetrahedron" NumberOfElements="{1}">
    <DataItem NumberType="Int" Precision="8" Format="HDF" Dimensions="{1} 4">{0}:/connect</DataItem>
   </Topology>
   <Geometry GeometryType="XYZ">
    <DataItem NumberType="Float" Precision="8" Format="HDF" Dimensions="{2} 3">{0}:/geometry</DataItem>
   </Geometry>
   <Attribute Name="group" Center="Cell">
    <DataItem NumberType="Int" Precision="4" Format="HDF" Dimensions="{1}">{0}:/group</DataItem>
   </Attribute>
{3}{4}  </Grid>
 </Domain>
</Xdmf>
)",
      formats::xml_escaped(name), counts.tets, counts.points,
      describe_arrays(name, arrays[pieces::RowKind::point], pieces::RowKind::point, counts.points),
      describe_arrays(name, arrays[pieces::RowKind::tet], pieces::RowKind::tet, counts.tets));
}

/// What is in the root besides.
void note_unknown(const Hdf5File& file, std::vector<std::string>& notes) {
  constexpr std::array<std::string_view, 13> kKnown = {
      "geometry",          "vertex_labels",   "connect",   "group",
      "triangles",         "triangle_labels", "edges",     "edge_labels",
      "required_vertices", "point_data",      "cell_data", "triangle_data",
      "edge_data"};
  for (const std::string& name : hdf5_names_in(file, "/")) {
    if (std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end()) continue;
    notes.push_back(fmt::format("/{} is not kept: it has no name of an array of a mesh", name));
  }
}

std::filesystem::path part_of(const std::filesystem::path& file) {
  std::filesystem::path part = file;
  part += ".part";
  return part;
}

std::filesystem::path xdmf_beside(std::filesystem::path file) {
  return file.replace_extension(".xdmf");
}

}  // namespace

std::vector<std::filesystem::path> files_of_hdf5(const std::filesystem::path& file) {
  return {file, part_of(file), xdmf_beside(file)};
}

pieces::RankShare read_hdf5(const std::filesystem::path& name, MPI_Comm ranks) {
  const Hdf5File file(name, Hdf5File::Access::read, ranks);
  pieces::RankShare arrays;
  const auto coordinates = file.read<double>("geometry", 3);
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    arrays.points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  }
  if (!file.has("connect")) file.fail("has no array /connect");
  read_elements(file, "connect", "group", arrays.tets);
  read_elements(file, "triangles", "triangle_labels", arrays.triangles);
  read_elements(file, "edges", "edge_labels", arrays.edges);
  if (file.has("vertex_labels")) {
    const auto labels = file.read<std::int32_t>("vertex_labels", 1);
    if (labels.size() != arrays.points.size()) {
      file.fail("/geometry and /vertex_labels do not have the same length");
    }
    arrays.point_labels.assign(labels.begin(), labels.end());
  }
  if (file.has("required_vertices")) {
    for (const std::int64_t v : file.read<std::int64_t>("required_vertices", 1)) {
      arrays.required_vertices.push_back(static_cast<std::uint64_t>(v));
    }
  }
  note_unknown(file, arrays.notes);
  MpiRanks all(ranks);
  arrays.arrays = read_hdf5_arrays(file, by_kind(count_all(arrays, all)), arrays.notes);
  return arrays;
}

void write_hdf5(const std::filesystem::path& file, const pieces::RankShare& arrays,
                MPI_Comm communicator) {
  MpiRanks ranks(communicator);
  const pieces::ArrayCounts counts = count_all(arrays, ranks);
  const bool has_labels = ranks.any(!arrays.point_labels.empty());
  const std::filesystem::path part = part_of(file);
  write_arrays(part, arrays, counts, has_labels, communicator);
  ranks.meet();
  if (ranks.is_first()) {
    std::filesystem::rename(part, file);
    OutputFile out(xdmf_beside(file));
    out.put(description(file.filename().string(), counts, arrays.arrays));
    out.commit();
  }
  ranks.meet();
}

}  // namespace tetmend::mpi
