// SPDX-License-Identifier: MIT
// Files of netCDF: tables by their names. Those of netCDF-4 are files of HDF5, all others have a form of
// their own, which any program reads and writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/output_file.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// The tables of a file of either form are read by the same calls, those of the first group: "/" is the
/// path of the file's own attributes. Dimensions have no names here. The bytes of `file` must stay.
/// @param format what messages call the format: "Exodus"
/// @throws Error where they are no netCDF, or HDF5 and this program has none
std::unique_ptr<Hdf5Reader> open_netcdf(const InputFile& file, std::string_view format);

/// Makes a file of netCDF with offsets of 64 bits, or of CDF-5 where a table is too large for it.
class NetcdfWriter {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  /// A dimension that tables name. Of length 0: the dimension of steps, of which there is one.
  void dimension(const std::string& name, std::size_t length);
  void attribute(const std::string& name, DataArray::Values value);
  void attribute(const std::string& name, std::string text);
  /// Integers of 64 bits become doubles. Precondition: the dimensions are there, and give the size.
  void add(const std::string& name, std::vector<std::string> dimensions, DataArray::Values values,
           Attributes attributes = {});
  /// Each cut at, or filled up with zeros to, the length of the last dimension.
  void add_texts(const std::string& name, std::vector<std::string> dimensions,
                 const std::vector<std::string>& texts);
  /// All of it; the last call.
  void write(OutputFile& out) const;

 private:
  struct Attribute {
    std::string name;
    DataArray::Values numbers;
    std::string text;
    bool is_text = false;
  };
  struct Variable {
    std::string name;
    std::vector<std::size_t> dimensions;
    DataArray::Values numbers;
    std::string text;
    bool is_text = false;
    std::vector<Attribute> attributes;
  };
  struct Layout;

  std::size_t dimension_number(const std::string& name) const;
  std::string header(const Layout& layout) const;
  bool is_step(const Variable& variable) const;

  std::vector<std::pair<std::string, std::size_t>> dimensions_;
  std::vector<Attribute> attributes_;
  std::vector<Variable> variables_;
};

}  // namespace tetmend::formats
