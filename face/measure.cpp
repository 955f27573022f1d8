// SPDX-License-Identifier: MIT
// The figures of a mesh.
#include <algorithm>
#include <utility>

#include <tetmend/measure.h>

#include "envelope/unjoined.h"
#include "face/arena.h"
#include "face/bad_tets.h"
#include "face/mesh_access.h"
#include "face/plan.h"
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

std::vector<BadTet> describe(const TetMesh& mesh,
                             const std::vector<std::pair<TetHandle, Hindrance>>& bad,
                             const std::vector<std::uint32_t>& numbers,
                             const std::vector<std::int64_t>& names) {
  std::vector<BadTet> tets;
  for (const auto& [t, hindrance] : bad) {
    tets.push_back(face::describe(mesh, t, hindrance));
    BadTet& tet = tets.back();
    tet.tet = numbers[t.index()];
    tet.number = names.empty() ? static_cast<std::int64_t>(tet.tet) + 1 : names[tet.tet];
  }
  std::sort(tets.begin(), tets.end(), [](const BadTet& a, const BadTet& b) {
    return std::pair(a.quality, a.tet) < std::pair(b.quality, b.tet);
  });
  return tets;
}

}  // namespace

void check(const MeasureOptions& options) {
  face::check_threads(options.threads);
  face::check_goal(options.goal);
  find_measures(options.measure);
}

Measurement measure(Mesh mesh, const MeasureOptions& options) {
  const auto measures = find_measures(options.measure);
  face::check_goal(options.goal);
  return face::on_threads(options.threads, [&] {
    Measurement result;
    const std::filesystem::path file = mesh.file();
    MeshData data = MeshAccess::take(mesh);
    const std::vector<std::int64_t> names = data.tet_numbers;
    MeshData second_order = data.mid_nodes.empty() ? MeshData() : data;
    std::vector<std::uint32_t> numbers;
    TetMesh built = face::build_located(file, data,
                                        {.sorted = false,
                                         .report = &result.build,
                                         .tet_numbers = options.bad_tets ? &numbers : nullptr});
    if (!(options.goal == Goal{})) built.set_standard(built.standard().with_goal(options.goal));
    if (!second_order.mid_nodes.empty()) {
      built.scale().to_work(second_order.points);
      result.curved = curved_statistics(second_order, built);
    }
    result.statistics = compute_statistics(built, options.goal);
    result.notes = describe(find_unjoined(built), built.vertex_count());
    if (options.rulers) result.rulers = measure_rulers(built);
    for (const QualityMeasure* each : measures) result.measures.push_back(summarize(built, *each));
    std::vector<std::pair<TetHandle, Hindrance>> bad;
    if (options.limit || options.bad_tets) result.limit = compute_surface_limit(built, &bad);
    if (!options.limit) result.limit.reset();
    if (options.bad_tets) result.bad_tets = describe(built, bad, numbers, names);
    return result;
  });
}

std::vector<Measure> measures() {
  std::vector<Measure> all;
  for (const QualityMeasure& each : quality_measures()) all.push_back({each.name, each.help});
  return all;
}

}  // namespace tetmend
