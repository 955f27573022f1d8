// SPDX-License-Identifier: MIT
#include "report/measure_table.h"

#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <tetmend/rulers.h>

#include "explain/page_text.h"
#include "report/histogram_chart.h"

namespace tetmend::report {

namespace {

using explain::escaped;

class Table {
 public:
  explicit Table(const Figures& figures) : figures_(figures) {}

  void add_count(std::string_view name, std::string_view path) {
    add(name, figures_.shown_count(fmt::format("before.{}", path)),
        figures_.shown_count(fmt::format("after.{}", path)));
  }
  void add(std::string_view name, std::string_view path, int decimals) {
    add(name, figures_.shown(fmt::format("before.{}", path), decimals),
        figures_.shown(fmt::format("after.{}", path), decimals));
  }
  std::string str() const {
    return fmt::format(
        "<table class=\"measures\"><thead><tr><th>measure</th><th>before</th><th>after</th></tr>"
        "</thead><tbody>\n{}</tbody></table>\n",
        rows_);
  }

 private:
  void add(std::string_view name, const std::string& before, const std::string& after) {
    rows_ += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n",
                         escaped(name), before, after);
  }

  const Figures& figures_;
  std::string rows_;
};

std::string mesh_table(const Figures& figures) {
  const auto any = [&](std::string_view name) {
    return figures.count(fmt::format("before.{}", name)) +
               figures.count(fmt::format("after.{}", name)) >
           0;
  };
  const double low = figures.number("goal.min_angle");
  const double high = figures.number("goal.max_angle");
  Table table(figures);
  table.add_count("tets", "tets");
  table.add_count("points", "vertices");
  table.add_count("boundary triangles", "boundary_triangles");
  if (any("inverted")) table.add_count("inverted tets", "inverted");
  if (any("flat")) table.add_count("flat tets", "flat");
  table.add_count("bad tets (miss the goal)", "n_bad");
  table.add("theta_min, degrees", "theta_min", 4);
  table.add("theta_max, degrees", "theta_max", 4);
  table.add(fmt::format("lambda %: angles up to {:g} or from {:g} degrees", low, high), "lambda",
            4);
  for (int i = 0; i < 5; ++i) {
    const double a = low / 5;
    const double b = (180 - high) / 5;
    table.add(fmt::format("lambda_{} %: {:g}-{:g}, {:g}-{:g}", i + 1, a * i, a * (i + 1),
                          180 - b * (i + 1), 180 - b * i),
              fmt::format("lambda_bands.{}", i), 4);
  }
  table.add("q_worst: least sine of an angle", "q_worst", 5);
  table.add("q_aver: the same, mean of the bad tets", "q_aver", 5);
  table.add("q_mean: the same, mean of all tets", "q_mean", 5);
  if (figures.has("before.second_order")) {
    table.add_count("mid-side nodes", "second_order.mid_nodes");
    table.add_count("curved tets", "second_order.curved");
    table.add_count("turned over", "second_order.turned_over");
    table.add("worst Jacobian ratio", "second_order.worst_jacobian_ratio", 4);
  }
  return table.str();
}

std::string ruler_table(const Figures& figures) {
  if (!figures.has("before.rulers") || !figures.has("after.rulers")) return {};
  std::string rows;
  for (const RulerInfo& ruler : kRulers) {
    rows += fmt::format("<tr><th scope=\"row\" title=\"{}\">{}</th>", escaped(ruler.help),
                        escaped(ruler.title));
    for (const std::string_view figure : {"worst", "one_percent", "mean"}) {
      for (const std::string_view when : {"before", "after"}) {
        rows += fmt::format(
            "<td>{}</td>",
            figures.shown_digits(fmt::format("{}.rulers.{}.{}", when, ruler.name, figure), 4));
      }
    }
    rows += "</tr>\n";
  }
  for (const SolverRulerInfo& ruler : kSolverRulers) {
    rows += fmt::format(
        "<tr><th scope=\"row\" title=\"{}\">{}</th><td>{}</td><td>{}</td>"
        "<td colspan=\"4\"></td></tr>\n",
        escaped(ruler.help), escaped(ruler.title),
        figures.shown_digits(fmt::format("before.rulers.{}", ruler.name), 4),
        figures.shown_digits(fmt::format("after.rulers.{}", ruler.name), 4));
  }
  return fmt::format(
      "<table class=\"rulers\"><thead><tr><th rowspan=\"2\">measure</th><th "
      "colspan=\"2\">worst</th>"
      "<th colspan=\"2\">1 % are as bad</th><th colspan=\"2\">mean</th></tr>"
      "<tr><th>before</th><th>after</th><th>before</th><th>after</th><th>before</th><th>after</th>"
      "</tr></thead><tbody>\n{}</tbody></table>\n",
      rows);
}

std::vector<std::size_t> counts_at(const Figures& figures, std::string_view path) {
  const nlohmann::json& counts = figures.at(path);
  return counts.is_array() ? counts.get<std::vector<std::size_t>>() : std::vector<std::size_t>();
}

HistogramContent angle_histogram(const Figures& figures) {
  HistogramContent content;
  content.name = "angles";
  content.title = "dihedral angles";
  content.help = "in degrees; bad beyond the goal; the regular tet has 70.53";
  content.unit = "angles";
  content.is_open = false;
  content.before = counts_at(figures, "before.histogram");
  content.after = counts_at(figures, "after.histogram");
  content.bad_below = figures.number("goal.min_angle");
  content.bad_above = figures.number("goal.max_angle");
  const auto bins = static_cast<double>(content.before.size());
  for (double edge = 0; edge <= bins; ++edge) content.edges.push_back(180 * edge / bins);
  return content;
}

}  // namespace

std::string measure_tables(const Figures& figures) {
  return mesh_table(figures) + ruler_table(figures);
}

std::string histograms(const Figures& figures) {
  std::string text = histogram_chart(angle_histogram(figures));
  for (const RulerInfo& ruler : kRulers) {
    const std::string path = fmt::format("histograms.{}", ruler.name);
    if (!figures.has(path)) continue;
    HistogramContent content;
    content.name = ruler.name;
    content.title = ruler.title;
    content.help = ruler.help;
    content.unit = ruler.of_faces ? "faces" : ruler.of_vertices ? "points" : "tets";
    content.edges = figures.at(path).at("edges").get<std::vector<double>>();
    content.before = counts_at(figures, path + ".before");
    content.after = counts_at(figures, path + ".after");
    content.better =
        ruler.large_is_good ? HistogramContent::Better::right : HistogramContent::Better::left;
    text += histogram_chart(content);
  }
  return text;
}

}  // namespace tetmend::report
