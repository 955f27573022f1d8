// SPDX-License-Identifier: MIT
// Drawings as vector files: SVG 1.1, PDF 1.4, TikZ. Text stays text. The same drawing is the same bytes.
#pragma once

#include <filesystem>
#include <string>

#include "figure/drawing.h"

namespace tetmend::figure {

/// Where Helvetica is missing, texts are stretched to the width that they were laid out for.
std::string svg_of(const Drawing& drawing);
/// One page of the drawing's size, with the standard Helvetica fonts, packed.
/// @throws std::bad_alloc
std::string pdf_of(const Drawing& drawing);

/// A tikzpicture, for a document of LaTeX to read; its fonts are those of the document.
std::string tikz_of(const Drawing& drawing);

/// @throws Error when the name does not end in .svg, .pdf or .tex
void check_drawing_name(const std::filesystem::path& file);

/// The file appears under its name only when it is complete.
/// @throws Error as check_drawing_name(), or when it cannot be written.
void write_drawing(const std::filesystem::path& file, const Drawing& drawing);

}  // namespace tetmend::figure
