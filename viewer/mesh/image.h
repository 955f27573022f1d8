// SPDX-License-Identifier: MIT
// A picture in memory, and as a PNG file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "viewer/mesh/colour_map.h"

namespace tetmend::viewer {

/// Rows from the top, pixels from the left.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Colour> pixels;

  const Colour& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// Pixels in which red outweighs green and blue by far, as nothing but bad tets does while the mesh
/// is coloured by region. Within `radius` of a pixel, or everywhere.
std::size_t count_red(const Image& image);
std::size_t count_red(const Image& image, int x, int y, int radius);

/// The file appears under its name only when it is complete.
/// @throws Error when it cannot be written or its name does not end in .png.
void write_png(const std::filesystem::path& file, const Image& image);

}  // namespace tetmend::viewer
