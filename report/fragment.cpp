// SPDX-License-Identifier: MIT
#include "report/fragment.h"

#include <fmt/format.h>

#include "report/figures.h"
#include "report/measure_table.h"
#include "report/page_parts.h"
#include "report/progress_chart.h"
#include "report/verdict.h"

namespace tetmend::report {

namespace {

// The colours of the page in light; a notebook in the dark has a lighter ground for it.
constexpr std::string_view kColours =
    "--ink: #1b2230; --quiet: #566072; --line: #d5dae2; --soft: #eef2f7; --bad: #d3202a; "
    "--before: #b9c1cc; --after: #0b5cad; --worst: #1f7a44; --good: #1f7a44; "
    "background: #fff; color: var(--ink); padding: 0.5em; max-width: 62em;";

}  // namespace

std::string write_fragment(const nlohmann::json& report) {
  const Figures figures(report);
  return fmt::format(
      "<div class=\"tetmend-report\" data-scale=\"log\"><style>.tetmend-report {{ {} "
      "figure, svg.progress {{ max-width: 30em; }} .pair {{ display: flex; flex-wrap: wrap; gap: "
      "1em; }} "
      "{} &[data-scale=\"log\"] .scale-even {{ display: none; }} }}</style>\n"
      "<p><b>{}</b></p>\n<div class=\"pair\">{}<div>{}</div></div>\n{}</div>\n",
      kColours, charts_style(), verdict_of(figures).sentence, histograms(figures),
      progress_chart(figures), pass_table(figures));
}

}  // namespace tetmend::report
