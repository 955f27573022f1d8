// SPDX-License-Identifier: MIT
// Meshes from files and to files.
#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <tetmend/io.h>

#include "face/arena.h"
#include "face/mesh_access.h"
#include "face/recorded.h"
#include "kernel/formats/mesh_io.h"

namespace tetmend {

Mesh load(const std::filesystem::path& file, int threads, const std::string& label_array) {
  return face::on_threads(threads,
                          [&] { return MeshAccess::make(read_mesh(file, label_array), file); });
}

std::vector<std::string> not_saved(const std::filesystem::path& file, const Mesh& mesh,
                                   const std::string& variant) {
  return not_written(file, MeshAccess::data(mesh), variant);
}

std::vector<std::string> remarks_on_saving(const std::filesystem::path& file, const Mesh& mesh,
                                           const std::string& variant) {
  return remarks_on_writing(file, MeshAccess::data(mesh), variant);
}

void save(const std::filesystem::path& file, const Mesh& mesh, int threads,
          const std::string& variant) {
  face::save(file, mesh, threads, variant, {});
}

void face::save(const std::filesystem::path& file, const Mesh& mesh, int threads,
                const std::string& variant, MeshView::Companions companions) {
  const auto known = mesh_variants(file);
  if (!variant.empty() && std::find(known.begin(), known.end(), variant) == known.end()) {
    throw Error(fmt::format("{}: the format has no variant '{}'", file.string(), variant));
  }
  MeshView view(MeshAccess::data(mesh));
  view.set_variant(variant);
  view.set_companions(std::move(companions));
  face::on_threads(threads, [&] { write_mesh(file, view); });
}

std::vector<std::string_view> file_variants(const std::filesystem::path& file) {
  const auto known = mesh_variants(file);
  return {known.begin(), known.end()};
}

std::vector<FileFormat> file_formats() {
  std::vector<FileFormat> formats;
  for (const MeshFormat& format : mesh_formats()) {
    formats.push_back({format.name, format.extension});
  }
  return formats;
}

}  // namespace tetmend
