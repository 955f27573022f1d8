// SPDX-License-Identifier: MIT
#include "report/page.h"

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "explain/page_text.h"
#include "face/identifiers.h"
#include "kernel/grouped.h"
#include "report/figures.h"
#include "report/measure_table.h"
#include "report/page_parts.h"
#include "report/progress_chart.h"
#include "report/repeat.h"
#include "report/verdict.h"
#include "report/worst_tets.h"

namespace tetmend::report {

namespace {

using explain::escaped;

std::string_view to_class(Outcome outcome) {
  switch (outcome) {
    case Outcome::reached:
      return "reached";
    case Outcome::missed:
      return "missed";
    case Outcome::interrupted:
      break;
  }
  return "interrupted";
}

/// What of the shape is not in the page.
std::string left_out(const nlohmann::json& about) {
  const auto count = [&](const std::string& name) { return about.at(name).get<std::size_t>(); };
  std::vector<std::string> texts;
  const std::size_t all = count("all_triangles");
  if (count("triangles") < all) {
    texts.push_back(fmt::format(
        "The surface has {} triangles, too many for a page: only {} of its sharp edges are drawn.",
        grouped(all), grouped(count("edges"))));
  } else if (count("walls") < count("all_walls")) {
    texts.push_back(fmt::format("The {} triangles between regions are not drawn.",
                                grouped(count("all_walls"))));
  } else if (count("edges") < count("all_edges")) {
    texts.push_back(fmt::format("Of {} sharp edges {} are drawn.", grouped(count("all_edges")),
                                grouped(count("edges"))));
  }
  for (const std::string_view when : {"before", "after"}) {
    const std::size_t drawn = count(fmt::format("bad_{}", when));
    const std::size_t there = count(fmt::format("all_bad_{}", when));
    if (drawn == there) continue;
    texts.push_back(fmt::format("Of {} bad tets {} the worst {} are drawn.", grouped(there), when,
                                grouped(drawn)));
  }
  std::string html;
  for (const std::string& text : texts) html += escaped(text) + " ";
  return html;
}

std::string notes_of(const Figures& figures) {
  std::string items;
  for (const nlohmann::json& note : figures.at("notes")) {
    items += fmt::format("<li>{}</li>\n", escaped(note.get<std::string>()));
  }
  for (const nlohmann::json& array : figures.at("data")) {
    const Figures of(array);
    items += fmt::format("<li>data of {} '{}': {}", escaped(of.text("on")),
                         escaped(of.text("name")), escaped(of.text("rule")));
    if (of.text("rule") != face::kIdentifierRule) {
      items += fmt::format("; its integral changed by {:.2g}", of.number("integral_error"));
    }
    items += "</li>\n";
  }
  return items.empty()
             ? items
             : "<section class=\"card\"><h2>Notes</h2><ul>\n" + items + "</ul></section>\n";
}

}  // namespace

std::string write_page(const nlohmann::json& report, const face::Portrait& portrait,
                       const ShapeLimits& limits) {
  const Figures figures(report);
  const Shape shape = pack_shape(portrait, limits);
  const Verdict verdict = verdict_of(figures);
  const std::string program = "tetmend " + figures.text("tetmend");
  const std::string title =
      fmt::format("{} \u2192 {}", figures.text("input"), figures.text("output"));
  const std::string chart = progress_chart(figures);
  return explain::fill_in(page_form(), {{"@TITLE@", escaped(title)},
                                        {"@PROGRAM@", escaped(program)},
                                        {"@STYLE@", std::string(page_style())},
                                        {"@SCRIPT@", std::string(page_script())},
                                        {"@OUTCOME@", std::string(to_class(verdict.outcome))},
                                        {"@VERDICT@", verdict.sentence},
                                        {"@PROMISES@", promise_table(figures)},
                                        {"@LEFT_OUT@", left_out(shape.about)},
                                        {"@HISTOGRAMS@", histograms(figures)},
                                        {"@MEASURES@", measure_tables(figures)},
                                        {"@PROGRESS@", chart},
                                        {"@PASSES@", pass_table(figures)},
                                        {"@REASONS@", reasons(figures)},
                                        {"@WORST@", worst_tets(figures)},
                                        {"@NOTES@", notes_of(figures)},
                                        {"@REPEAT@", repeat_section(figures)},
                                        {"@SHAPE_ABOUT@", explain::in_script(shape.about)},
                                        {"@SHAPE@", shape.data}});
}

}  // namespace tetmend::report
