// SPDX-License-Identifier: MIT
// write_tree FROM TO: converts a mesh, with files of HDF5 as the text that is fuzzed.
#include <cstdio>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"

int main(int count, char** arguments) {
  if (count != 3) return 2;
  try {
    tetmend::write_mesh(arguments[2], tetmend::read_mesh(arguments[1]));
  } catch (const tetmend::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
