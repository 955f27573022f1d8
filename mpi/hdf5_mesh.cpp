// SPDX-License-Identifier: MIT
// Each array is one data set without chunks. So that the bytes do not depend on time or on what was on
// the disk, times are not kept and nothing is filled.
#include "mpi/hdf5_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <hdf5.h>

#include "kernel/error.h"
#include "kernel/formats/output_file.h"
#include "mpi/mpi_ranks.h"

namespace tetmend::mpi {

namespace {

/// An object of HDF5, which is closed by its own function.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool is_open() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// A file that all ranks have open.
class File {
 public:
  enum class Access { read, write };

  File(std::filesystem::path name, Access access, MPI_Comm ranks)
      : name_(std::move(name)),
        ranks_(ranks),
        transfer_(H5Pcreate(H5P_DATASET_XFER), H5Pclose),
        file_(open(access), H5Fclose) {
    H5Pset_dxpl_mpio(transfer_, H5FD_MPIO_COLLECTIVE);
    if (!file_.is_open())
      fail(access == Access::read ? "is no HDF5 file that can be read" : "cannot be written");
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw Error(fmt::format("{}: {}", name_.string(), what));
  }

  bool has(const char* name) const { return H5Lexists(file_, name, H5P_DEFAULT) > 0; }

  /// An equal share of the rows; `width` numbers each.
  template <class Number>
  std::vector<Number> read(const char* name, std::size_t width, hid_t type) const {
    const Handle set(H5Dopen2(file_, name, H5P_DEFAULT), H5Dclose);
    if (!set.is_open()) fail(fmt::format("has no array /{}", name));
    const Handle space(H5Dget_space(set), H5Sclose);
    std::array<hsize_t, 2> size = {0, 1};
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 1 || rank > 2) fail(fmt::format("/{} has another form than a table", name));
    H5Sget_simple_extent_dims(space, size.data(), nullptr);
    if (size[1] != width) {
      fail(fmt::format("/{} has {} columns: expected {}", name, size[1], width));
    }
    const MpiRanks all(ranks_);
    const hsize_t begin = size[0] * all.number() / all.count();
    const hsize_t end = size[0] * (all.number() + 1) / all.count();
    std::vector<Number> numbers((end - begin) * width);
    const herr_t done = transfer(rank, begin, end - begin, width, space, [&](hid_t memory) {
      return H5Dread(set, type, memory, space, transfer_, numbers.data());
    });
    if (done < 0) fail(fmt::format("/{} cannot be read", name));
    return numbers;
  }

  /// The rows of this rank, from `begin` on, of `total`; `width` 1: a list without columns.
  template <class Number>
  void write(const char* name, const std::vector<Number>& numbers, std::uint64_t begin,
             std::uint64_t total, std::size_t width, hid_t type) const {
    const int rank = width == 1 ? 1 : 2;
    const std::array<hsize_t, 2> size = {total, width};
    const Handle space(H5Screate_simple(rank, size.data(), nullptr), H5Sclose);
    const Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(made, false);
    H5Pset_fill_time(made, H5D_FILL_TIME_NEVER);
    const Handle set(H5Dcreate2(file_, name, type, space, H5P_DEFAULT, made, H5P_DEFAULT),
                     H5Dclose);
    if (!set.is_open()) fail("cannot be written");
    const herr_t done =
        transfer(rank, begin, numbers.size() / width, width, space, [&](hid_t memory) {
          return H5Dwrite(set, type, memory, space, transfer_, numbers.data());
        });
    if (done < 0) fail("cannot be written: is the disk full?");
  }

 private:
  hid_t open(Access access) const {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // what goes wrong is told by us
    const Handle all(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_mpio(all, ranks_, MPI_INFO_NULL);
    if (access == Access::read) return H5Fopen(name_.c_str(), H5F_ACC_RDONLY, all);
    const Handle made(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_obj_track_times(made, false);
    return H5Fcreate(name_.c_str(), H5F_ACC_TRUNC, made, all);
  }

  template <class Transfer>
  herr_t transfer(int rank, hsize_t begin, hsize_t count, hsize_t width, hid_t space,
                  const Transfer& work) const {
    const std::array<hsize_t, 2> from = {begin, 0};
    const std::array<hsize_t, 2> size = {count, width};
    const Handle memory(H5Screate_simple(rank, size.data(), nullptr), H5Sclose);
    if (count == 0) {
      H5Sselect_none(space);
      H5Sselect_none(memory);
    } else {
      H5Sselect_hyperslab(space, H5S_SELECT_SET, from.data(), nullptr, size.data(), nullptr);
    }
    return work(memory);
  }

  std::filesystem::path name_;
  MPI_Comm ranks_;
  Handle transfer_;
  Handle file_;
};

template <std::size_t N>
using Elements = std::vector<pieces::RankShare::Element<N>>;

template <std::size_t N>
void read_elements(const File& file, const char* name, const char* labels, Elements<N>& elements) {
  if (!file.has(name)) return;
  const auto numbers = file.read<std::int64_t>(name, N, H5T_NATIVE_INT64);
  std::vector<std::int32_t> label;
  if (file.has(labels)) label = file.read<std::int32_t>(labels, 1, H5T_NATIVE_INT32);
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
  Writer(const File& file, MPI_Comm ranks) : file_(file), ranks_(ranks) {}

  template <class Number>
  void write(const char* name, const std::vector<Number>& numbers, std::size_t width, hid_t type) {
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
    file_.write(name, numbers, begin, total, width, type);
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
    write(name, numbers, N, H5T_NATIVE_INT64);
    write(labels, label, 1, H5T_NATIVE_INT32);
  }

 private:
  const File& file_;
  MpiRanks ranks_;
};

void write_arrays(const std::filesystem::path& name, const pieces::RankShare& arrays,
                  const pieces::ArrayCounts& counts, bool has_labels, MPI_Comm ranks) {
  const File file(name, File::Access::write, ranks);
  Writer writer(file, ranks);
  std::vector<double> coordinates;
  for (const Point& p : arrays.points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  writer.write("geometry", coordinates, 3, H5T_NATIVE_DOUBLE);
  coordinates = {};
  writer.write("connect", "group", arrays.tets);
  if (counts.triangles > 0) writer.write("triangles", "triangle_labels", arrays.triangles);
  if (counts.edges > 0) writer.write("edges", "edge_labels", arrays.edges);
  if (counts.required_vertices > 0) {
    const std::vector<std::int64_t> required(arrays.required_vertices.begin(),
                                             arrays.required_vertices.end());
    writer.write("required_vertices", required, 1, H5T_NATIVE_INT64);
  }
  if (has_labels) {
    std::vector<std::int32_t> labels(arrays.point_labels.begin(), arrays.point_labels.end());
    labels.resize(arrays.points.size(), 0);
    writer.write("vertex_labels", labels, 1, H5T_NATIVE_INT32);
  }
}

/// What ParaView needs to know; see xdmf.org.
std::string description(const std::string& name, const pieces::ArrayCounts& counts) {
  return fmt::format(R"(<?xml version="1.0" ?>
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
  </Grid>
 </Domain>
</Xdmf>
)",
                     name, counts.tets, counts.points);
}

}  // namespace

pieces::RankShare read_hdf5(const std::filesystem::path& name, MPI_Comm ranks) {
  const File file(name, File::Access::read, ranks);
  pieces::RankShare arrays;
  const auto coordinates = file.read<double>("geometry", 3, H5T_NATIVE_DOUBLE);
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    arrays.points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  }
  if (!file.has("connect")) file.fail("has no array /connect");
  read_elements(file, "connect", "group", arrays.tets);
  read_elements(file, "triangles", "triangle_labels", arrays.triangles);
  read_elements(file, "edges", "edge_labels", arrays.edges);
  if (file.has("vertex_labels")) {
    const auto labels = file.read<std::int32_t>("vertex_labels", 1, H5T_NATIVE_INT32);
    if (labels.size() != arrays.points.size()) {
      file.fail("/geometry and /vertex_labels do not have the same length");
    }
    arrays.point_labels.assign(labels.begin(), labels.end());
  }
  if (file.has("required_vertices")) {
    for (const std::int64_t v : file.read<std::int64_t>("required_vertices", 1, H5T_NATIVE_INT64)) {
      arrays.required_vertices.push_back(static_cast<std::uint64_t>(v));
    }
  }
  return arrays;
}

void write_hdf5(const std::filesystem::path& file, const pieces::RankShare& arrays,
                MPI_Comm communicator) {
  MpiRanks ranks(communicator);
  const pieces::ArrayCounts counts = count_all(arrays, ranks);
  const bool has_labels = ranks.any(!arrays.point_labels.empty());
  std::filesystem::path part = file;
  part += ".part";
  write_arrays(part, arrays, counts, has_labels, communicator);
  ranks.meet();
  if (ranks.is_first()) {
    std::filesystem::rename(part, file);
    std::filesystem::path beside = file;
    OutputFile out(beside.replace_extension(".xdmf"));
    out.put(description(file.filename().string(), counts));
    out.commit();
  }
  ranks.meet();
}

}  // namespace tetmend::mpi
