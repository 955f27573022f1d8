// SPDX-License-Identifier: MIT
#include "figure/drawing_file.h"

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/output_file.h"

namespace tetmend::figure {

void check_drawing_name(const std::filesystem::path& file) {
  if (file.extension() == ".svg" || file.extension() == ".pdf") return;
  throw Error(fmt::format("{}: figures are written as .svg or .pdf", file.string()));
}

void write_drawing(const std::filesystem::path& file, const Drawing& drawing) {
  check_drawing_name(file);
  OutputFile out(file);
  out.put(file.extension() == ".svg" ? svg_of(drawing) : pdf_of(drawing));
  out.commit();
}

}  // namespace tetmend::figure
