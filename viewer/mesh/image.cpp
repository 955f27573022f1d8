// SPDX-License-Identifier: MIT
#include "viewer/mesh/image.h"

#include <algorithm>

#include <fmt/format.h>
#include <stb_image_write.h>

#include "kernel/error.h"
#include "kernel/formats/output_file.h"

namespace tetmend::viewer {

std::size_t count_red(const Image& image) {
  return count_red(image, image.width / 2, image.height / 2, std::max(image.width, image.height));
}

std::size_t count_red(const Image& image, int x, int y, int radius) {
  std::size_t count = 0;
  const int bottom = std::min(y + radius, image.height - 1);
  const int right = std::min(x + radius, image.width - 1);
  for (int row = std::max(y - radius, 0); row <= bottom; ++row) {
    for (int column = std::max(x - radius, 0); column <= right; ++column) {
      const Colour& c = image.at(column, row);
      const int rest = std::max(c.green, c.blue);
      if (c.red >= 90 && c.red >= rest + 60 && 5 * c.red >= 8 * rest) ++count;
    }
  }
  return count;
}

void write_png(const std::filesystem::path& file, const Image& image) {
  if (file.extension() != ".png") {
    throw Error(fmt::format(
        "{}: pictures are written as .png, figures of a call, by figure{{}}, as .svg, .pdf or .tex",
        file.string()));
  }
  OutputFile out(file);
  const auto put = [](void* target, void* bytes, int size) {
    static_cast<OutputFile*>(target)->put(
        {static_cast<const char*>(bytes), static_cast<std::size_t>(size)});
  };
  if (stbi_write_png_to_func(put, &out, image.width, image.height, 4, image.pixels.data(),
                             4 * image.width) == 0) {
    throw Error(fmt::format("{}: no memory for the picture", file.string()));
  }
  out.commit();
}

}  // namespace tetmend::viewer
