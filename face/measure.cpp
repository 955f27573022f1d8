// SPDX-License-Identifier: MIT
// The figures of a mesh.
#include <tetmend/measure.h>

#include "face/arena.h"
#include "face/mesh_access.h"
#include "kernel/curved.h"
#include "kernel/rulers.h"
#include "kernel/statistics.h"
#include "schedule/limit/surface_limit.h"

namespace tetmend {

namespace {

std::vector<const QualityMeasure*> find_measures(const std::vector<std::string>& names) {
  std::vector<const QualityMeasure*> measures;
  for (const std::string& name : names) {
    try {
      measures.push_back(&find_quality_measure(name));
    } catch (const Error& error) {
      throw OptionError("measure", fmt::format("measure: {}", error.what()));
    }
  }
  return measures;
}

}  // namespace

void check(const MeasureOptions& options) {
  face::check_threads(options.threads);
  find_measures(options.measure);
}

Measurement measure(Mesh mesh, const MeasureOptions& options) {
  const auto measures = find_measures(options.measure);
  return face::on_threads(options.threads, [&] {
    Measurement result;
    const std::filesystem::path file = mesh.file();
    MeshData data = MeshAccess::take(mesh);
    const MeshData second_order = data.mid_nodes.empty() ? MeshData() : data;
    const TetMesh built =
        face::build_located(file, data, {.sorted = false, .report = &result.build});
    if (!second_order.mid_nodes.empty()) result.curved = curved_statistics(second_order, built);
    result.statistics = compute_statistics(built);
    if (options.rulers) result.rulers = measure_rulers(built);
    for (const QualityMeasure* each : measures) result.measures.push_back(summarize(built, *each));
    if (options.limit) result.limit = compute_surface_limit(built);
    return result;
  });
}

std::vector<Measure> measures() {
  std::vector<Measure> all;
  for (const QualityMeasure& each : quality_measures()) all.push_back({each.name, each.help});
  return all;
}

}  // namespace tetmend
