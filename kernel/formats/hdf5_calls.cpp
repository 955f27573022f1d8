// SPDX-License-Identifier: MIT
#include "kernel/formats/hdf5_calls.h"

#include <fmt/format.h>

#include "kernel/error.h"
#include "platform/platform.h"

namespace tetmend::formats {
namespace {

const platform::SharedLibrary& hdf5_library() {
  static const platform::SharedLibrary kLibrary = [] {
    platform::SharedLibrary opened(TETMEND_LOADS_HDF5);
    if (!opened.is_open()) throw Error(platform::loading_error());
    opened.pin();  // it has work to do when the program ends
    return opened;
  }();
  return kLibrary;
}

}  // namespace

void load_hdf5(const std::string& file) {
  try {
    hdf5_library();
  } catch (const Error& error) {
    throw Error(fmt::format("{}: files of its kind need HDF5: {}", file, error.what()));
  }
}

void* find_in_hdf5(const char* name) {
  void* found = hdf5_library().find(name);
  if (found == nullptr) {
    throw Error(fmt::format("{} has no {}: it is of another version", TETMEND_LOADS_HDF5, name));
  }
  return found;
}

}  // namespace tetmend::formats
