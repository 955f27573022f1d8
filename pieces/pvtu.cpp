// SPDX-License-Identifier: MIT
#include "pieces/pvtu.h"

#include <algorithm>
#include <cstddef>
#include <fstream>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "kernel/error.h"
#include "kernel/formats/output_file.h"
#include "kernel/formats/vtu_array.h"

namespace tetmend::pieces {

namespace {

/// Counted from 1.
std::size_t line_of(const std::filesystem::path& file, std::ptrdiff_t offset) {
  std::ifstream in(file, std::ios::binary);
  std::string before(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)), '\0');
  in.read(before.data(), static_cast<std::streamsize>(before.size()));
  before.resize(static_cast<std::size_t>(in.gcount()));
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

}  // namespace

std::vector<std::filesystem::path> read_pvtu(const std::filesystem::path& file) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_file(file.c_str());
  const auto fail = [&](std::string_view reason) {
    return Error(fmt::format("{}: {}", file.string(), reason));
  };
  if (parsed.status == pugi::status_file_not_found) throw fail("there is no such file");
  if (parsed.status == pugi::status_io_error) throw fail("cannot be read");
  if (!parsed) {
    throw Error(fmt::format("{}:{}: the XML is broken: {}", file.string(),
                            line_of(file, parsed.offset), parsed.description()));
  }
  const pugi::xml_node grid = document.child("VTKFile").child("PUnstructuredGrid");
  if (!grid) throw fail("expected a VTKFile with a PUnstructuredGrid");
  std::vector<std::filesystem::path> pieces;
  for (const pugi::xml_node piece : grid.children("Piece")) {
    const std::string source = piece.attribute("Source").value();
    if (source.empty()) throw fail(fmt::format("Piece {} has no Source", pieces.size()));
    pieces.push_back(file.parent_path() / std::filesystem::path(source));
  }
  if (pieces.empty()) throw fail("no Piece is here: expected one");
  return pieces;
}

void write_pvtu(const std::filesystem::path& file, std::span<const std::string> pieces,
                std::span<const PvtuArray> of_points, std::span<const PvtuArray> of_cells) {
  OutputFile out(file);
  out.put(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PUnstructuredGrid GhostLevel=\"0\">\n");
  const auto put_arrays = [&](std::string_view name, std::span<const PvtuArray> arrays) {
    out.put(fmt::format("<{}>\n", name));
    for (const PvtuArray& array : arrays) {
      out.put(fmt::format("<PDataArray type=\"{}\" Name=\"{}\"{}/>\n", array.type,
                          formats::xml_escaped(array.name),
                          formats::vtu_components(array.components)));
    }
    out.put(fmt::format("</{}>\n", name));
  };
  put_arrays("PPointData", of_points);
  put_arrays("PCellData", of_cells);
  out.put(
      "<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n"
      "</PPoints>\n");
  for (const std::string& piece : pieces) {
    out.put(fmt::format("<Piece Source=\"{}\"/>\n", formats::xml_escaped(piece)));
  }
  out.put("</PUnstructuredGrid>\n</VTKFile>\n");
  out.commit();
}

}  // namespace tetmend::pieces
