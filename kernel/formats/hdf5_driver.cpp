// SPDX-License-Identifier: MIT
// Which HDF5 a program has, if any.
#include <string_view>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/hdf5_file.h"
#include "kernel/printable.h"

namespace tetmend::formats {
namespace {

constinit const Hdf5Driver* driver = nullptr;

const Hdf5Driver& driver_for(const std::string& name, std::string_view format) {
  if (driver != nullptr) return *driver;
  throw Error(fmt::format("{}: this program has no {}: it was made without HDF5", name, format));
}

}  // namespace

void Hdf5Reader::fail(const std::string& path, std::string_view reason) const {
  throw Error(
      fmt::format("{}: '{}': {}", name_, printable(path == "/" ? path : "/" + path, 200), reason));
}

std::vector<std::string> text_rows(std::string_view characters, std::size_t width) {
  std::vector<std::string> rows;
  for (std::size_t at = 0; width > 0 && at < characters.size(); at += width) {
    std::string_view row = characters.substr(at, width);
    row = row.substr(0, row.find('\0'));
    rows.emplace_back(row.substr(0, row.find_last_not_of(' ') + 1));
  }
  return rows;
}

void provide_hdf5(const Hdf5Driver& of_program) {
  driver = &of_program;
}

bool has_hdf5() {
  return driver != nullptr;
}

std::unique_ptr<Hdf5Reader> open_hdf5(const InputFile& file, std::string_view format) {
  return driver_for(file.name(), format).open(file, format);
}

std::unique_ptr<Hdf5Writer> make_hdf5(std::string name, std::string_view format) {
  return driver_for(name, format).make(std::move(name));
}

}  // namespace tetmend::formats
