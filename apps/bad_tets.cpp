// SPDX-License-Identifier: MIT
#include "apps/bad_tets.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "kernel/formats/mesh_io.h"
#include "kernel/grouped.h"
#include "kernel/second_order.h"

namespace tetmend::apps {

std::string reason_of(const BadTet& tet) {
  switch (tet.hindrance) {
    case Hindrance::frozen:
      return "protected";
    case Hindrance::surface:
      return "the surface forces a bad tet here";
    case Hindrance::constraint:
      return "a constraint holds it";
    case Hindrance::no_free_vertex:
      return "all its vertices are on the surface";
    case Hindrance::search:
      break;
  }
  return fmt::format("no obstacle is known; {} of its vertices may move", tet.free_vertices);
}

std::string format_bad_tets(std::span<const BadTet> tets, std::size_t most) {
  const std::size_t count = std::min(most, tets.size());
  std::string text = fmt::format("bad tets: {}{}\n", tetmend::grouped(tets.size()),
                                 count < tets.size() ? fmt::format(", the worst {}", count) : "");
  if (count == 0) return text;
  text += fmt::format("{:>10} {:>7} {:>9} {:>9}  {:<34} reason\n", "tet", "region", "theta_min",
                      "theta_max", "centre");
  for (const BadTet& tet : tets.first(count)) {
    const std::string centre =
        fmt::format("{:.5g} {:.5g} {:.5g}", tet.centre[0], tet.centre[1], tet.centre[2]);
    text += fmt::format("{:>10} {:>7} {:>9.3f} {:>9.3f}  {:<34} {}{}\n", tet.number, tet.label,
                        tet.theta_min, tet.theta_max, centre, tet.quality < 0 ? "inverted; " : "",
                        reason_of(tet));
  }
  return text;
}

nlohmann::json to_json(std::span<const BadTet> tets, std::size_t most) {
  nlohmann::json list = nlohmann::json::array();
  for (const BadTet& tet : tets.first(std::min(most, tets.size()))) {
    list.push_back({{"tet", tet.number},
                    {"region", tet.label},
                    {"centre", tet.centre},
                    {"theta_min", tet.theta_min},
                    {"theta_max", tet.theta_max},
                    {"quality", tet.quality},
                    {"free_vertices", tet.free_vertices},
                    {"hindrance", to_string(tet.hindrance)},
                    {"reason", reason_of(tet)}});
  }
  return list;
}

void write_bad_tets(const MeshData& all, const std::filesystem::path& output,
                    std::span<const BadTet> tets) {
  MeshData bad;
  bad.points = all.points;
  std::vector<std::int64_t> number;
  std::vector<double> theta_min, theta_max, quality;
  std::vector<std::int32_t> free_vertices, reason;
  for (const BadTet& tet : tets) {
    bad.tets.push_back(all.tets[tet.tet]);
    number.push_back(tet.number);
    theta_min.push_back(tet.theta_min);
    theta_max.push_back(tet.theta_max);
    quality.push_back(tet.quality);
    free_vertices.push_back(tet.free_vertices);
    reason.push_back(static_cast<std::int32_t>(tet.hindrance));
  }
  bad.tet_data = {{"number", 1, number},       {"theta_min", 1, theta_min},
                  {"theta_max", 1, theta_max}, {"quality", 1, quality},
                  {"reason", 1, reason},       {"free_vertices", 1, free_vertices}};
  std::vector<std::uint32_t> number_of(all.points.size(), kNoMidNode);
  for (const MeshData::Tet& tet : bad.tets) {
    for (const std::uint32_t v : tet.vertices) number_of[v] = 0;
  }
  std::uint32_t count = 0;
  for (std::uint32_t& place : number_of) {
    if (place != kNoMidNode) place = count++;
  }
  renumber_points(bad, number_of, count);
  write_mesh(output, bad);
}

}  // namespace tetmend::apps
