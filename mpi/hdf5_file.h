// SPDX-License-Identifier: MIT
// A file of HDF5 that all ranks have open, and its tables. Each is one data set without chunks. So
// that the bytes do not depend on time or on what was on the disk, times are not kept and nothing
// is filled.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <hdf5.h>
#include <mpi.h>

#include "kernel/formats/hdf5_handle.h"

namespace tetmend::mpi {

using formats::hdf5_type;
using formats::Hdf5Handle;

/// All ranks call the same functions. Names of tables are paths from the root, without the first
/// '/'.
class Hdf5File {
 public:
  enum class Access { read, write };

  /// @throws Error when it cannot be opened
  Hdf5File(std::filesystem::path name, Access access, MPI_Comm ranks);

  hid_t id() const { return file_; }
  [[noreturn]] void fail(std::string_view what) const;
  bool has(const std::string& name) const {
    return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
  }

  /// An equal share of the rows; `width` numbers each. @throws Error for a table of another form
  template <class Number>
  std::vector<Number> read(const std::string& name, std::size_t width) const {
    std::vector<Number> numbers;
    read(name, width, hdf5_type<Number>(), [&](std::size_t size) {
      numbers.resize(size);
      return numbers.data();
    });
    return numbers;
  }

  /// The rows of this rank, from `begin` on, of `total`; `width` 1: a list without columns.
  template <class Number>
  void write(const std::string& name, const std::vector<Number>& numbers, std::uint64_t begin,
             std::uint64_t total, std::size_t width) const {
    write(name, numbers.data(), {begin, numbers.size() / width, total, width}, hdf5_type<Number>());
  }

 private:
  struct Rows {
    hsize_t begin, count, total, width;
  };

  hid_t open(Access access) const;
  template <class MakeRoom>
  void read(const std::string& name, std::size_t width, hid_t type, const MakeRoom& room) const {
    const Hdf5Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Rows rows = rows_of(name, set, width);
    void* const to = room(static_cast<std::size_t>(rows.count * rows.width));
    transfer_rows(set, name, rows, type, to);
  }
  Rows rows_of(const std::string& name, const Hdf5Handle& set, std::size_t width) const;
  void transfer_rows(hid_t set, const std::string& name, const Rows& rows, hid_t type,
                     void* to) const;
  void write(const std::string& name, const void* numbers, const Rows& rows, hid_t type) const;

  std::filesystem::path name_;
  MPI_Comm ranks_;
  Hdf5Handle transfer_;
  Hdf5Handle file_;
};

}  // namespace tetmend::mpi
