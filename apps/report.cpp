// SPDX-License-Identifier: MIT
// Mesh statistics as text and as JSON.
#include "apps/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/files.h"
#include "kernel/statistics.h"

namespace tetmend {

namespace {

constexpr std::size_t kWidth = 80;

using Values = std::vector<std::string>;

/// Rows of a name and one value for each mesh.
class Table {
 public:
  explicit Table(std::vector<const MeshStatistics*> meshes) : meshes_(std::move(meshes)) {}

  template <class Format>
  void add(std::string name, Format format) {
    Values values;
    for (const MeshStatistics* mesh : meshes_) values.push_back(format(*mesh));
    add_row(std::move(name), std::move(values));
  }
  void add_row(std::string name, Values values) {
    rows_.push_back({std::move(name), std::move(values)});
  }

  /// That all figures refer to.
  Goal goal() const { return meshes_.front()->goal; }

  bool any(std::size_t MeshStatistics::*count) const {
    return std::any_of(meshes_.begin(), meshes_.end(),
                       [&](const MeshStatistics* mesh) { return mesh->*count > 0; });
  }

  /// Names to the left, values to the right, a rule below the heading if there is one.
  std::string str(const std::string& name_heading, const Values& headings) const {
    std::size_t name_width = name_heading.size();
    std::size_t value_width = 0;
    for (const std::string& heading : headings) value_width = std::max(value_width, heading.size());
    for (const Row& row : rows_) {
      name_width = std::max(name_width, row.name.size());
      for (const std::string& value : row.values) value_width = std::max(value_width, value.size());
    }
    std::string text;
    const auto line = [&](const std::string& name, const Values& values) {
      text += fmt::format("{:<{}}", name, name_width);
      for (const std::string& value : values) text += fmt::format("  {:>{}}", value, value_width);
      text += '\n';
    };
    if (!headings.empty()) {
      line(name_heading, headings);
      text += std::string(name_width + headings.size() * (2 + value_width), '-') + '\n';
    }
    for (const Row& row : rows_) line(row.name, row.values);
    return text;
  }

 private:
  struct Row {
    std::string name;
    Values values;
  };
  std::vector<const MeshStatistics*> meshes_;
  std::vector<Row> rows_;
};

void add_rows(Table& table) {
  using S = MeshStatistics;
  table.add("tets", [](const S& s) { return grouped(s.tets); });
  table.add("points", [](const S& s) { return grouped(s.vertices); });
  table.add("boundary triangles", [](const S& s) { return grouped(s.boundary_triangles); });
  if (table.any(&S::inverted)) {
    table.add("inverted tets", [](const S& s) { return grouped(s.inverted); });
  }
  if (table.any(&S::flat)) table.add("flat tets", [](const S& s) { return grouped(s.flat); });
  table.add("theta_min, degrees", [](const S& s) { return decimal(s.theta_min, 4); });
  table.add("theta_max, degrees", [](const S& s) { return decimal(s.theta_max, 4); });
  const auto [low, high] = table.goal();
  table.add(fmt::format("lambda %  (<= {:g} or >= {:g})", low, high),
            [](const S& s) { return decimal(s.lambda, 4); });
  for (std::size_t i = 0; i < 5; ++i) {
    const double a = low / 5;  // widths of the bands
    const double b = (180 - high) / 5;
    const double n = static_cast<double>(i);
    table.add(fmt::format("lambda_{} %  ({:g}-{:g}, {:g}-{:g})", i + 1, a * n, a * (n + 1),
                          180 - b * (n + 1), 180 - b * n),
              [i](const S& s) { return decimal(s.lambda_bands[i], 4); });
  }
  table.add("bad tets  (miss the goal)", [](const S& s) { return grouped(s.n_bad); });
  table.add("q_worst  (min sine)", [](const S& s) { return decimal(s.q_worst, 5); });
  table.add("q_aver  (bad tets)", [](const S& s) { return decimal(s.q_aver, 5); });
  table.add("q_mean  (all tets)", [](const S& s) { return decimal(s.q_mean, 5); });
  table.add("volume", [](const S& s) { return volume_text(s, 12); });
}

using Bins = std::array<std::size_t, 18>;

Bins ten_degree_bins(const MeshStatistics& statistics) {
  Bins bins{};
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i] = statistics.histogram[2 * i] + statistics.histogram[2 * i + 1];
  }
  return bins;
}

/// One '#' for a count of 1, `width` for the largest; nothing for 0.
std::string bar(std::size_t count, std::size_t largest, std::size_t width) {
  if (count == 0) return "";
  if (largest == 1) return "#";
  const double part = std::log(static_cast<double>(count)) / std::log(static_cast<double>(largest));
  return std::string(
      1 + static_cast<std::size_t>(std::lround(part * static_cast<double>(width - 1))), '#');
}

/// At most 8 characters, with as many digits as that leaves, four at most.
std::string short_number(double value) {
  if (std::isnan(value)) return "nan";
  for (int digits = 4; digits > 1; --digits) {
    std::string text = fmt::format("{:.{}g}", value, digits);
    if (text.size() <= 8) return text;
  }
  return fmt::format("{:.1g}", value);
}

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

void strip_trailing_spaces(std::string& line) {
  line.erase(line.find_last_not_of(' ') + 1);
}

}  // namespace

std::string format_comparison(const MeshStatistics& before, const MeshStatistics& after) {
  Table table({&before, &after});
  add_rows(table);
  return table.str("measure", {"before", "after"});
}

std::string format_statistics(const MeshStatistics& statistics,
                              std::span<const MeasureSummary> extra) {
  Table table({&statistics});
  add_rows(table);
  for (const MeasureSummary& summary : extra) {
    table.add_row(fmt::format("{}, worst", summary.name), {decimal(summary.worst, 5)});
    table.add_row(fmt::format("{}, mean", summary.name), {decimal(summary.mean, 5)});
  }
  return table.str("", {});
}

std::string format_rulers(const MeshRulers& before, const MeshRulers* after) {
  constexpr std::size_t kNameWidth = 26;
  std::vector<const MeshRulers*> meshes = {&before};
  if (after != nullptr) meshes.push_back(after);
  std::string text;
  const auto line = [&](std::string_view name, auto&& cell) {
    std::string row = fmt::format("{:<{}}", name, kNameWidth);
    for (std::size_t figure = 0; figure < 3; ++figure) {
      for (std::size_t m = 0; m < meshes.size(); ++m) row += fmt::format(" {:>8}", cell(figure, m));
    }
    strip_trailing_spaces(row);
    text += row + '\n';
  };
  constexpr std::array<std::string_view, 3> kFigures = {"worst", "1 %", "mean"};
  line("measures of other programs", [&](std::size_t figure, std::size_t m) {
    return m == 0 ? kFigures[figure] : std::string_view();
  });
  if (after != nullptr) {
    line("", [](std::size_t, std::size_t m) { return m == 0 ? "before" : "after"; });
  }
  text += std::string(kNameWidth + 3 * 9 * meshes.size(), '-') + '\n';
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    line(kRulers[r].title, [&](std::size_t figure, std::size_t m) {
      const RulerFigures& of = meshes[m]->figures[r];
      return short_number(figure == 0 ? of.worst : figure == 1 ? of.one_percent : of.mean);
    });
    if (static_cast<Ruler>(r) != Ruler::non_orthogonality) continue;
    line("  faces above 70 degrees", [&](std::size_t figure, std::size_t m) {
      return figure == 0 ? fmt::format("{}", meshes[m]->faces_above_70) : std::string();
    });
  }
  for (const SolverRulerInfo& ruler : kSolverRulers) {
    if (std::isnan(before.*ruler.value)) continue;  // of a mesh that was never there as a whole
    line(ruler.title, [&](std::size_t figure, std::size_t m) {
      return figure == 0 ? short_number(meshes[m]->*ruler.value) : std::string();
    });
  }
  return text;
}

std::string format_curved(const CurvedStatistics& before, const CurvedStatistics* after) {
  const auto both = [&](auto&& cell) {
    return cell(before) + (after == nullptr ? std::string() : " -> " + cell(*after));
  };
  const auto tets = both([](const CurvedStatistics& of) { return grouped(of.curved); });
  const auto over = both([](const CurvedStatistics& of) { return grouped(of.turned_over); });
  const auto ratio =
      both([](const CurvedStatistics& of) { return short_number(of.worst.at_nodes); });
  const auto bound = both([](const CurvedStatistics& of) { return short_number(of.worst.bound); });
  return fmt::format(
      "second order: {} curved tets, {} turned over\n"
      "  worst Jacobian ratio {} at the nodes, {} by its bound\n",
      tets, over, ratio, bound);
}

std::string format_histogram(const MeshStatistics& before, const MeshStatistics* after) {
  std::vector<Bins> columns = {ten_degree_bins(before)};
  if (after != nullptr) columns.push_back(ten_degree_bins(*after));
  std::size_t largest = 1;
  for (const Bins& bins : columns) {
    largest = std::max(largest, *std::max_element(bins.begin(), bins.end()));
  }
  constexpr std::size_t kLabelWidth = 7;  // "170-180"
  constexpr std::size_t kLongestBar = 40;
  const std::size_t count_width = std::max<std::size_t>(6, grouped(largest).size());
  const std::size_t column_width = (kWidth - kLabelWidth) / columns.size();
  const std::size_t bar_width = std::min(kLongestBar, column_width - count_width - 3);

  std::string text = "dihedral angles by 10 degrees; bars on a logarithmic scale\n";
  const auto line = [&](const std::string& label, auto&& cell) {
    std::string row = fmt::format("{:>{}}", label, kLabelWidth);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto [count, drawing] = cell(c);
      row += fmt::format("  {:>{}} {:<{}}", count, count_width, drawing, bar_width);
    }
    strip_trailing_spaces(row);
    text += row + '\n';
  };
  if (after != nullptr) {
    line("degrees", [&](std::size_t c) {
      return std::pair<std::string, std::string>(c == 0 ? "before" : "after", "");
    });
  } else {
    line("degrees", [](std::size_t) { return std::pair<std::string, std::string>("angles", ""); });
  }
  for (std::size_t i = 0; i < Bins{}.size(); ++i) {
    line(fmt::format("{}-{}", 10 * i, 10 * (i + 1)), [&](std::size_t c) {
      return std::pair(grouped(columns[c][i]), bar(columns[c][i], largest, bar_width));
    });
  }
  return text;
}

std::string format_limit(const SurfaceLimit& limit) {
  constexpr std::size_t kNameWidth = 21;
  std::string text;
  const auto line = [&](std::string_view name, const std::string& value) {
    text += fmt::format("{:<{}}{}\n", name, kNameWidth, value);
  };
  if (limit.n_forced == 0) {
    line("limit", "no bad tet is known to be forced by the surface");
  } else {
    line("limit", fmt::format("at least {} of the {} bad tets are forced by the surface",
                              grouped(limit.n_forced), grouped(limit.n_bad)));
  }
  // Rounded outward: two digits must not promise more than is known.
  std::string bounds;
  if (limit.theta_min) {
    bounds = fmt::format("theta_min is {:.2f} at most", std::ceil(100 * *limit.theta_min) / 100);
  }
  if (limit.theta_max) {
    bounds += fmt::format("{}theta_max is {:.2f} at least", bounds.empty() ? "" : ", ",
                          std::floor(100 * *limit.theta_max) / 100);
  }
  if (!bounds.empty()) line("", bounds);
  constexpr std::array<std::string_view, kHindranceCount> kHelp = {
      "protected", "where the surface forces one", "held by a constraint", "without a free vertex",
      "that nothing is known to hold"};
  std::string heading = "bad tets";
  for (std::size_t i = 0; i < kHindranceCount; ++i) {
    if (limit.bad[i] == 0) continue;
    line(heading, fmt::format("{} {}", grouped(limit.bad[i]), kHelp[i]));
    heading.clear();
  }
  return text;
}

nlohmann::json to_json(const MeshRulers& rulers) {
  nlohmann::json result = {{"shortest_edge", number(rulers.shortest_edge)},
                           {"inner_faces", rulers.inner_faces},
                           {"faces_above_70", rulers.faces_above_70}};
  for (const SolverRulerInfo& ruler : kSolverRulers) {
    result[std::string(ruler.name)] = number(rulers.*ruler.value);
  }
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    const RulerFigures& of = rulers.figures[r];
    result[std::string(kRulers[r].name)] = {{"worst", number(of.worst)},
                                            {"one_percent", number(of.one_percent)},
                                            {"mean", number(of.mean)}};
  }
  return result;
}

nlohmann::json to_json(const CurvedStatistics& curved) {
  return {{"mid_nodes", curved.mid_nodes},
          {"curved", curved.curved},
          {"turned_over", curved.turned_over},
          {"worst_jacobian_ratio", curved.worst.at_nodes},
          {"bound_of_jacobian_ratio", curved.worst.bound}};
}

nlohmann::json to_json(const SurfaceLimit& limit) {
  const auto bound = [](const std::optional<double>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
  };
  nlohmann::json bad = nlohmann::json::object();
  for (std::size_t i = 0; i < kHindranceCount; ++i) {
    bad[std::string(to_string(static_cast<Hindrance>(i)))] = limit.bad[i];
  }
  return {{"n_forced", limit.n_forced},          {"n_bad", limit.n_bad},
          {"q_worst", bound(limit.q_worst)},     {"theta_min", bound(limit.theta_min)},
          {"theta_max", bound(limit.theta_max)}, {"bad", bad}};
}

nlohmann::json to_json(const MeshStatistics& s) {
  nlohmann::json bands = nlohmann::json::array();
  for (const double share : s.lambda_bands) bands.push_back(number(share));
  nlohmann::json result = {
      {"tets", s.tets},
      {"vertices", s.vertices},
      {"boundary_triangles", s.boundary_triangles},
      {"inverted", s.inverted},
      {"flat", s.flat},
      {"volume", number(s.volume)},
      {"theta_min", number(s.theta_min)},
      {"theta_max", number(s.theta_max)},
      {"lambda", number(s.lambda)},
      {"lambda_bands", bands},
      {"q_worst", number(s.q_worst)},
      {"q_mean", number(s.q_mean)},
      {"n_bad", s.n_bad},
      {"q_aver", number(s.q_aver)},
      {"histogram", s.histogram},
  };
  if (s.scaled_volume != 0 && !std::isnormal(s.volume)) {  // no double holds it
    result["volume"] = nullptr;
    result["volume_text"] = volume_text(s, 17);
  }
  return result;
}

}  // namespace tetmend
