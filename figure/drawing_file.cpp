// SPDX-License-Identifier: MIT
#include "figure/drawing_file.h"

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/output_file.h"

namespace tetmend::figure {

void check_drawing_name(const std::filesystem::path& file) {
  const auto extension = file.extension();
  if (extension == ".svg" || extension == ".pdf" || extension == ".tex") return;
  throw Error(fmt::format("{}: figures are written as .svg, .pdf or .tex", file.string()));
}

void write_drawing(const std::filesystem::path& file, const Drawing& drawing) {
  check_drawing_name(file);
  OutputFile out(file);
  out.put(file.extension() == ".svg"   ? svg_of(drawing)
          : file.extension() == ".tex" ? tikz_of(drawing)
                                       : pdf_of(drawing));
  out.commit();
}

}  // namespace tetmend::figure
