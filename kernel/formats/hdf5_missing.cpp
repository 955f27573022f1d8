// SPDX-License-Identifier: MIT
// Stands for hdf5_file.cpp in a build without HDF5.
#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/hdf5_file.h"

namespace tetmend::formats {
namespace {

[[noreturn]] void fail_without_hdf5(const std::string& name, std::string_view format) {
  throw Error(fmt::format("{}: this build has no {}: it was made without HDF5", name, format));
}

}  // namespace

bool has_hdf5() {
  return false;
}

std::unique_ptr<Hdf5Reader> open_hdf5(const InputFile& file, std::string_view format) {
  fail_without_hdf5(file.name(), format);
}

std::unique_ptr<Hdf5Writer> make_hdf5(std::string name, std::string_view format) {
  fail_without_hdf5(name, format);
}

}  // namespace tetmend::formats
