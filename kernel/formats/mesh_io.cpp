// SPDX-License-Identifier: MIT
// Reading and writing of tetrahedral mesh files; the format follows from the extension.
#include "kernel/formats/mesh_io.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <new>
#include <string>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/medit_ascii.h"
#include "kernel/formats/medit_binary.h"
#include "kernel/formats/tetgen.h"
#include "kernel/formats/vtk_legacy.h"

namespace tetmend {
namespace {

struct Codec {
  MeshData (*read)(const std::filesystem::path&, formats::TetPlace* question);
  void (*write)(const std::filesystem::path&, const MeshView&);
};

constexpr std::array<MeshFormat, 5> kFormatsTable = {{{"MEDIT ASCII", ".mesh"},
                                                      {"MEDIT binary", ".meshb"},
                                                      {"TetGen", ".node"},
                                                      {"TetGen", ".ele"},
                                                      {"legacy VTK", ".vtk"}}};

// In the order of formats_table.
constexpr std::array<Codec, 5> kCodecs = {
    {{formats::read_medit_ascii, formats::write_medit_ascii},
     {formats::read_medit_binary, formats::write_medit_binary},
     {formats::read_tetgen, formats::write_tetgen},
     {formats::read_tetgen, formats::write_tetgen},
     {formats::read_vtk_legacy, formats::write_vtk_legacy}}};

const Codec& find_codec(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string valid;
  for (std::size_t i = 0; i < kFormatsTable.size(); ++i) {
    if (kFormatsTable[i].extension == extension) return kCodecs[i];
    valid += valid.empty() ? "" : ", ";
    valid += kFormatsTable[i].extension;
  }
  throw Error(fmt::format("{}: the extension '{}' is not that of a mesh format: expected one of {}",
                          file.string(), file.extension().string(), valid));
}

}  // namespace

std::span<const MeshFormat> mesh_formats() {
  return kFormatsTable;
}

MeshData read_mesh(const std::filesystem::path& file) {
  try {
    return find_codec(file).read(file, nullptr);
  } catch (const std::bad_alloc&) {
    throw Error(fmt::format("{}: cannot be read: not enough memory", file.string()));
  }
}

std::string locate_tet(const std::filesystem::path& file, std::size_t tet) {
  formats::TetPlace question{tet, file.string()};
  find_codec(file).read(file, &question);
  return question.place;
}

void write_mesh(const std::filesystem::path& file, const MeshData& mesh) {
  assert(mesh.point_labels.empty() || mesh.point_labels.size() == mesh.points.size());
  write_mesh(file, MeshView(mesh));
}

void write_mesh(const std::filesystem::path& file, const MeshView& mesh) {
  find_codec(file).write(file, mesh);
}

}  // namespace tetmend
