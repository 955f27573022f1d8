// SPDX-License-Identifier: MIT
#include "kernel/formats/hdf5_calls.h"

#include <string>

#include <fmt/format.h>

#include "kernel/error.h"
#include "platform/platform.h"

namespace tetmend::formats {

void* find_in_hdf5(const char* name) {
  static const platform::SharedLibrary library = [] {
    platform::SharedLibrary opened(TETMEND_LOADS_HDF5);
    if (!opened.is_open()) {
      throw Error(fmt::format("files of HDF5 need its library: {}", platform::loading_error()));
    }
    opened.pin();  // it has work to do when the program ends
    return opened;
  }();
  void* found = library.find(name);
  if (found == nullptr) {
    throw Error(fmt::format("{} has no {}: it is of another version", TETMEND_LOADS_HDF5, name));
  }
  return found;
}

}  // namespace tetmend::formats
