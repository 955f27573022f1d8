// SPDX-License-Identifier: MIT
// The numbers of an XDMF file: in it, in a binary file, or in tables of a file of HDF5 that it names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/input_file.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

std::string xdmf_lower_case(std::string text);

/// All functions throw Error "FILE:LINE: reason", or that of the file of HDF5. The file must stay.
class XdmfItems {
 public:
  /// @param folder  of the file, where those of HDF5 are looked for
  XdmfItems(const InputFile& file, std::filesystem::path folder)
      : file_(file), folder_(std::move(folder)) {}

  [[noreturn]] void fail(const pugi::xml_node& node, std::string_view reason) const;
  /// The DataItem below.
  pugi::xml_node item_of(const pugi::xml_node& parent) const;
  std::vector<std::size_t> dimensions(const pugi::xml_node& item) const;
  DataArray::Values values(const pugi::xml_node& item);
  std::vector<std::int64_t> integers(const pugi::xml_node& item);
  std::vector<double> reals(const pugi::xml_node& item);

 private:
  /// @throws Error for a name with a line break or the like
  std::string file_in(const pugi::xml_node& item, std::string name) const;
  void open(const std::string& name);
  DataArray::Values inline_values(const pugi::xml_node& item) const;
  DataArray::Values binary_values(const pugi::xml_node& item) const;

  const InputFile& file_;
  std::filesystem::path folder_;
  std::optional<InputFile> input_;
  std::unique_ptr<Hdf5Reader> tables_;  // of `input_`
  std::string open_name_;
};

}  // namespace tetmend::formats
