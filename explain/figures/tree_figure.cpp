// SPDX-License-Identifier: MIT
// A call and all calls in it, a row each.
#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "explain/call_facts.h"
#include "explain/figures/figure_parts.h"
#include "explain/figures/figures.h"
#include "explain/outcome_look.h"
#include "kernel/error.h"

namespace tetmend::explain {

using figure::Anchor;
using figure::Drawing;
using figure::Font;
using figure::Pen;
using figure::Place;
using figure::Text;

namespace {

constexpr double kRow = 12.5;
constexpr double kIndent = 12;
constexpr double kGap = 16;
constexpr double kMark = 7.5;

struct TreeRow {
  std::uint32_t call = 0;
  unsigned indent = 0;
  Outcome outcome = {};
  /// Number, what it does, level, degree, quality, verdict.
  std::array<std::string, 6> cells;
};

constexpr std::array<const char*, 6> kHeadings = {"call",   "operator and target", "level",
                                                  "degree", "worst quality",       "verdict"};
constexpr std::array<Anchor, 6> kAnchors = {Anchor::end, Anchor::start, Anchor::end,
                                            Anchor::end, Anchor::start, Anchor::start};

std::vector<TreeRow> rows_of(const TraceFile& file, Replay& replay, std::uint32_t root) {
  FactTable facts;
  std::vector<TreeRow> rows;
  const auto& calls = file.calls();
  for (std::uint32_t k = root; k < calls[root].subtree_end; ++k) {
    const Call& call = calls[k];
    const CallFacts& fact = facts.facts(file, replay, k);
    rows.push_back(
        {k,
         static_cast<unsigned>(call.depth - calls[root].depth),
         outcome_of(call),
         {fmt::format("{}", k), fmt::format("{} {}", short_name(file, call), format_target(call)),
          fmt::format("{}", call.level), degree_text(fact), quality_text(call, fact),
          call.verdict_in_words()}});
  }
  return rows;
}

/// Left and right edge of each column.
struct Columns {
  std::array<double, 6> left{}, right{};
};

Columns columns_of(const std::vector<TreeRow>& rows) {
  Columns columns;
  double x = kMargin;
  for (std::size_t c = 0; c < kHeadings.size(); ++c) {
    double widest = figure::text_width(kHeadings[c], kTextSize, Font::bold);
    for (const TreeRow& row : rows) {
      const double indent = c == 1 ? kIndent * (row.indent + 1) : 0;
      widest = std::max(widest, indent + figure::text_width(row.cells[c], kTextSize));
    }
    columns.left[c] = x;
    columns.right[c] = x + widest;
    x += widest + kGap;
  }
  return columns;
}

class TreeDrawer {
 public:
  TreeDrawer(Drawing& drawing, const std::vector<TreeRow>& rows, double top)
      : drawing_(drawing), rows_(rows), columns_(columns_of(rows)), top_(top) {}

  double width() const { return columns_.right.back() + kMargin; }

  void draw() {
    for (std::size_t c = 0; c < kHeadings.size(); ++c) {
      cell(c, 0, kHeadings[c], top_, Font::bold);
    }
    const double under = top_ + kRow + 1;
    drawing_.line({kMargin, under}, {columns_.right.back(), under}, Pen{figure::kBlack, 0.5});
    for (std::size_t i = 0; i < rows_.size(); ++i) branch(i);
    for (std::size_t i = 0; i < rows_.size(); ++i) row(i);
  }
  double bottom() const { return y(rows_.size()); }

 private:
  double y(std::size_t i) const { return top_ + kRow + 4 + kRow * static_cast<double>(i); }
  Place dot(std::size_t i) const {
    return {columns_.left[1] + kIndent * rows_[i].indent + kMark / 2, y(i) + kRow / 2};
  }

  void cell(std::size_t column, double indent, const std::string& text, double top, Font font) {
    Text cell = figure::centred({0, top + kRow / 2}, text, kTextSize, font);
    cell.anchor = kAnchors[column];
    cell.at.x =
        cell.anchor == Anchor::end ? columns_.right[column] : columns_.left[column] + indent;
    drawing_.add(std::move(cell));
  }

  /// From the call around it.
  void branch(std::size_t i) {
    std::size_t parent = i;
    while (parent > 0 && rows_[parent].indent >= rows_[i].indent) --parent;
    if (rows_[i].indent == 0) return;
    const Place from = dot(parent);
    const Place to = dot(i);
    drawing_.add(figure::Stroke{{from, {from.x, to.y}, to}, Pen{{150, 154, 160, 255}, 0.6}});
  }

  void row(std::size_t i) {
    const TreeRow& row = rows_[i];
    // Paper behind the mark, where branches begin and end.
    const Place at = dot(i);
    const double half = kMark / 2;
    drawing_.rectangle({at.x - half, at.y - half}, kMark, kMark, figure::kWhite);
    add_mark(drawing_, row.outcome, {at.x - half, at.y - half}, kMark);
    for (std::size_t c = 0; c < row.cells.size(); ++c) {
      cell(c, c == 1 ? kIndent * (row.indent + 1) : 0, row.cells[c], y(i), Font::regular);
    }
  }

  Drawing& drawing_;
  const std::vector<TreeRow>& rows_;
  Columns columns_;
  double top_;
};

}  // namespace

Drawing draw_tree(const TraceFile& file, Replay& replay, std::uint32_t call) {
  const std::size_t count = file.calls()[call].subtree_end - call;
  if (count > kMostTreeRows) {
    throw Error(
        fmt::format("call {} has {} calls in it, too many for a figure, which has {} at "
                    "most: choose one of those in it",
                    call, count - 1, kMostTreeRows - 1));
  }
  const std::vector<TreeRow> rows = rows_of(file, replay, call);
  Drawing drawing;
  drawing.title = figure_title(file, call);
  const double title_width = figure::text_width(drawing.title, kTitleSize, Font::bold);
  double y = add_paragraph(drawing, {kMargin, kMargin}, title_width + 1, drawing.title, kTitleSize,
                           Font::bold);
  TreeDrawer tree(drawing, rows, y + 3);
  tree.draw();
  drawing.width = std::max(tree.width(), title_width + 2 * kMargin);
  std::set<Outcome> seen;
  for (const TreeRow& row : rows) seen.insert(row.outcome);
  std::vector<LegendEntry> legend;
  for (const Outcome outcome : seen) {
    legend.push_back({outcome, std::string(outcome_name(outcome))});
  }
  y = add_legend(drawing, {kMargin, tree.bottom() + 8}, drawing.width - 2 * kMargin, legend);
  drawing.height = y + kMargin;
  return drawing;
}

}  // namespace tetmend::explain
