// SPDX-License-Identifier: MIT
#include "mpi/hdf5_file.h"

#include <fmt/format.h>

#include "kernel/error.h"
#include "mpi/mpi_ranks.h"

namespace tetmend::mpi {

namespace {

/// Chooses rows from `begin` on; the same number of rows in memory.
Hdf5Handle choose_rows(hid_t space, hsize_t begin, hsize_t count, hsize_t width) {
  const int rank = H5Sget_simple_extent_ndims(space);
  const std::array<hsize_t, 2> from = {begin, 0};
  const std::array<hsize_t, 2> size = {count, width};
  const hid_t memory = H5Screate_simple(rank, size.data(), nullptr);
  if (count == 0) {
    H5Sselect_none(space);
    H5Sselect_none(memory);
  } else {
    H5Sselect_hyperslab(space, H5S_SELECT_SET, from.data(), nullptr, size.data(), nullptr);
  }
  return {memory, H5Sclose};
}

}  // namespace

Hdf5File::Hdf5File(std::filesystem::path name, Access access, MPI_Comm ranks)
    : name_(std::move(name)),
      ranks_(ranks),
      transfer_(H5Pcreate(H5P_DATASET_XFER), H5Pclose),
      file_(open(access), H5Fclose) {
  H5Pset_dxpl_mpio(transfer_, H5FD_MPIO_COLLECTIVE);
  if (!file_.is_open())
    fail(access == Access::read ? "is no HDF5 file that can be read" : "cannot be written");
}

void Hdf5File::fail(std::string_view what) const {
  throw Error(fmt::format("{}: {}", name_.string(), what));
}

hid_t Hdf5File::open(Access access) const {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // what goes wrong is told by us
  const Hdf5Handle all(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_mpio(all, ranks_, MPI_INFO_NULL);
  if (access == Access::read) return H5Fopen(name_.c_str(), H5F_ACC_RDONLY, all);
  const Hdf5Handle made(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(made, false);
  return H5Fcreate(name_.c_str(), H5F_ACC_TRUNC, made, all);
}

Hdf5File::Rows Hdf5File::rows_of(const std::string& name, const Hdf5Handle& set,
                                 std::size_t width) const {
  if (!set.is_open()) fail(fmt::format("has no array /{}", name));
  const Hdf5Handle space(H5Dget_space(set), H5Sclose);
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
  return {begin, end - begin, size[0], width};
}

void Hdf5File::transfer_rows(hid_t set, const std::string& name, const Rows& rows, hid_t type,
                             void* to) const {
  const Hdf5Handle space(H5Dget_space(set), H5Sclose);
  const Hdf5Handle memory = choose_rows(space, rows.begin, rows.count, rows.width);
  if (H5Dread(set, type, memory, space, transfer_, to) < 0) {
    fail(fmt::format("/{} cannot be read", name));
  }
}

void Hdf5File::write(const std::string& name, const void* numbers, const Rows& rows,
                     hid_t type) const {
  const int rank = rows.width == 1 ? 1 : 2;
  const std::array<hsize_t, 2> size = {rows.total, rows.width};
  const Hdf5Handle space(H5Screate_simple(rank, size.data(), nullptr), H5Sclose);
  const Hdf5Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(made, false);
  H5Pset_fill_time(made, H5D_FILL_TIME_NEVER);
  const Hdf5Handle set(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, made, H5P_DEFAULT),
                       H5Dclose);
  if (!set.is_open()) fail("cannot be written");
  const Hdf5Handle memory = choose_rows(space, rows.begin, rows.count, rows.width);
  if (H5Dwrite(set, type, memory, space, transfer_, numbers) < 0) {
    fail("cannot be written: is the disk full?");
  }
}

}  // namespace tetmend::mpi
