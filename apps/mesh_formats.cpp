// SPDX-License-Identifier: MIT
#include "apps/mesh_formats.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tetmend/io.h>

#include "apps/commands.h"
#include "face/mesh_access.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/tet_mesh_io.h"
#include "trace/no_mesh.h"

namespace tetmend::apps {

namespace {

bool is_in_parts(const std::filesystem::path& file, const pieces::ArrayFiles* known) {
  return known != nullptr && known->is_one(file);
}

template <std::size_t N, class Element>
void take_elements(const std::vector<pieces::RankShare::Element<N>>& from,
                   std::vector<Element>& to) {
  to.reserve(from.size());
  for (const auto& each : from) {
    Element& element = to.emplace_back();
    element.label = each.label;
    std::transform(each.vertices.begin(), each.vertices.end(), element.vertices.begin(),
                   [](std::uint64_t v) { return static_cast<std::uint32_t>(v); });
  }
}

}  // namespace

void check_formats(const std::filesystem::path& input, const std::filesystem::path& output,
                   const CarryOptions& carry, const pieces::ArrayFiles* known) {
  check_input_format(input, known);
  if (!is_in_parts(output, known)) {
    check_mesh_extension(output);
    return check_variant(output, carry);
  }
  if (!carry.variant.empty()) {
    throw UsageError(fmt::format("--variant: '{}' is none of {}: there is only one", carry.variant,
                                 output.string()));
  }
  known->check_output(output);
}

void check_input_format(const std::filesystem::path& input, const pieces::ArrayFiles* known) {
  if (is_in_parts(input, known)) return;
  refuse_what_is_no_mesh(input);
  check_mesh_extension(input);
}

std::string parts_help() {
  return "A mesh in parts is named by its .pvtu file, or as part_%d.msh for part_1.msh,\n"
         "part_2.msh and so on of Gmsh. Its tets are numbered through, part after part.\n";
}

MeshData read_whole(const std::filesystem::path& file, const pieces::ArrayFiles* known) {
  if (!is_in_parts(file, known)) return read_mesh(file);
  pieces::RankShare arrays = known->read(file, {});
  if (arrays.points.size() > UINT32_MAX) {
    throw Error(fmt::format("{}: {} points are too many for one mesh", file.string(),
                            arrays.points.size()));
  }
  MeshData data;
  data.points = arrays.points;
  data.point_labels = arrays.point_labels;
  take_elements(arrays.tets, data.tets);
  take_elements(arrays.triangles, data.triangles);
  take_elements(arrays.edges, data.edges);
  data.point_data = std::move(arrays.arrays[pieces::RowKind::point]);
  data.tet_data = std::move(arrays.arrays[pieces::RowKind::tet]);
  data.triangle_data = std::move(arrays.arrays[pieces::RowKind::triangle]);
  data.edge_data = std::move(arrays.arrays[pieces::RowKind::edge]);
  data.notes = arrays.notes;
  std::sort(data.notes.begin(), data.notes.end());
  data.notes.erase(std::unique(data.notes.begin(), data.notes.end()), data.notes.end());
  return data;
}

Mesh load_whole(const std::filesystem::path& file, int threads, const pieces::ArrayFiles* known) {
  if (!is_in_parts(file, known)) return load(file, threads);
  return MeshAccess::make(read_whole(file, known));
}

TetMesh build_whole(const std::filesystem::path& file, MeshData data, BuildReport* report,
                    const pieces::ArrayFiles* known) {
  if (!is_in_parts(file, known)) {
    return build_tet_mesh(file, std::move(data), MeshOrder::of_file, report);
  }
  return in_parts(file, known, [&] { return face::build_located({}, data, {.report = report}); });
}

}  // namespace tetmend::apps
