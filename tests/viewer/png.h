// SPDX-License-Identifier: MIT
// Reads a picture that the program has written.
#pragma once

#include <filesystem>
#include <stdexcept>

#include <stb_image.h>

#include "viewer/mesh/image.h"

namespace tetmend::test {

inline viewer::Image read_png(const std::filesystem::path& file) {
  viewer::Image image;
  int channels = 0;
  stbi_uc* bytes = stbi_load(file.c_str(), &image.width, &image.height, &channels, 4);
  if (bytes == nullptr) throw std::runtime_error("no picture: " + file.string());
  for (int i = 0; i < image.width * image.height; ++i) {
    image.pixels.push_back({bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]});
  }
  stbi_image_free(bytes);
  return image;
}

}  // namespace tetmend::test
