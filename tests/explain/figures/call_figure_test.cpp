// SPDX-License-Identifier: MIT
#include "explain/figures/call_figure.h"

#include <algorithm>
#include <map>
#include <set>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "explain/call_facts.h"
#include "explain/call_study.h"
#include "explain/outcome_look.h"
#include "figure/drawing_file.h"
#include "kernel/error.h"
#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::explain;
using figure::Drawing;

namespace {

std::vector<figure::Text> texts_of(const Drawing& drawing) {
  std::vector<figure::Text> texts;
  for (const figure::Shape& shape : drawing.shapes) {
    if (const auto* text = std::get_if<figure::Text>(&shape)) texts.push_back(*text);
  }
  return texts;
}

bool has_text(const Drawing& drawing, const std::string& words) {
  const auto texts = texts_of(drawing);
  return std::any_of(texts.begin(), texts.end(),
                     [&](const figure::Text& text) { return text.text == words; });
}

/// No two words lie on each other, and none sticks out of the page.
void check_words_on_page(const Drawing& drawing) {
  const auto texts = texts_of(drawing);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const figure::Box box = figure::box_of(texts[i]);
    CAPTURE(texts[i].text);
    CHECK(box.left >= 0);
    CHECK(box.top >= 0);
    CHECK(box.right <= drawing.width);
    CHECK(box.bottom <= drawing.height);
    for (std::size_t j = 0; j < i; ++j) {
      CAPTURE(texts[j].text);
      CHECK_FALSE(box.overlaps(figure::box_of(texts[j])));
    }
  }
}

struct Bench {
  test::TracedBall trace;
  TraceFile file{trace.path()};
  Replay replay{file};

  Drawing draw(FigureKind kind, std::optional<std::uint32_t> call,
               const std::optional<Look>& look = {}) {
    return draw_call(file, replay, {kind, call, look});
  }
};

}  // namespace

TEST_CASE("a ring has the numbers of the study of its call, and none on each other") {
  Bench bench;
  unsigned rings = 0;
  unsigned made = 0;
  for (std::uint32_t k = 0; k < bench.file.calls().size() && rings < 60; ++k) {
    const CallStudy study = study_call(bench.file, bench.replay, k);
    if (!study.picture || study.picture->ring.size() < 3) continue;
    ++rings;
    CAPTURE(k);
    const Drawing drawing = bench.draw(FigureKind::ring, k);
    for (const VertexHandle v : study.picture->ring) {
      CHECK(has_text(drawing, fmt::format("{}", v.index())));
    }
    for (const auto& side : study.picture->before.core) {
      CHECK(has_text(drawing, fmt::format("{:.3f}", side.quality)));
    }
    check_words_on_page(drawing);
    if (!study.covering) continue;
    ++made;
    for (const auto& t : study.covering->triangles) {
      CHECK(has_text(drawing, fmt::format("{:.3f}", t.quality)));
    }
  }
  CHECK(rings == 60);
  CHECK(made > 5);
}

TEST_CASE("a ring says once where its polygon is locked, whatever its call was refused for") {
  Bench bench;
  unsigned locked = 0;
  for (std::uint32_t k = 0; k < bench.file.calls().size() && locked < 30; ++k) {
    const CallStudy study = study_call(bench.file, bench.replay, k);
    if (!study.picture || study.picture->ring.size() < 3 || !study.picture->locks.any()) continue;
    ++locked;
    std::string all;
    for (const auto& text : texts_of(bench.draw(FigureKind::ring, k))) all += text.text + ' ';
    const auto first = all.find("Locked");
    CAPTURE(all);
    REQUIRE(first != std::string::npos);
    CHECK(all.find("Locked", first + 1) == std::string::npos);
  }
  CHECK(locked == 30);
}

TEST_CASE("a tree has a row for each call, with its facts") {
  Bench bench;
  constexpr std::uint32_t kMostRows = 400;
  std::uint32_t largest = 0;
  const auto& calls = bench.file.calls();
  const auto count = [&](std::uint32_t k) { return calls[k].subtree_end - k; };
  for (std::uint32_t k = 1; k < calls.size(); ++k) {
    if (count(k) > count(largest) && count(k) <= kMostRows) largest = k;
    if (count(k) <= kMostRows) continue;
    CHECK_THROWS_WITH_AS(bench.draw(FigureKind::tree, k), doctest::Contains("too many"), Error);
  }
  REQUIRE(count(largest) > 5);
  const Drawing drawing = bench.draw(FigureKind::tree, largest);
  check_words_on_page(drawing);
  FactTable facts;
  for (std::uint32_t k = largest; k < calls[largest].subtree_end; ++k) {
    CHECK(has_text(drawing, fmt::format("{}", k)));
    CHECK(has_text(
        drawing, fmt::format("{} {}", short_name(bench.file, calls[k]), format_target(calls[k]))));
    const CallFacts& fact = facts.facts(bench.file, bench.replay, k);
    CHECK(has_text(drawing, quality_text(calls[k], fact)));
    CHECK(has_text(drawing, degree_text(fact)));
  }
  // A mark for each, as many as there are calls that ended in its way, and one in the legend.
  std::map<Outcome, std::size_t> wanted;
  for (std::uint32_t k = largest; k < calls[largest].subtree_end; ++k) {
    ++wanted[outcome_of(calls[k])];
  }
  REQUIRE(wanted.size() > 1);
  for (const auto& [outcome, ended] : wanted) {
    const figure::Colour colour = outcome_colour(outcome);
    const auto strokes = std::count_if(drawing.shapes.begin(), drawing.shapes.end(),
                                       [&](const figure::Shape& shape) {
                                         const auto* stroke = std::get_if<figure::Stroke>(&shape);
                                         return stroke != nullptr && stroke->pen.colour == colour;
                                       });
    CHECK(strokes == static_cast<std::ptrdiff_t>((ended + 1) * outcome_mark(outcome).size()));
    CHECK(has_text(drawing, std::string(outcome_name(outcome))));
  }
}

TEST_CASE("a timeline has the curves of the run, and leaves the replay where it was") {
  Bench bench;
  bench.replay.seek(100);
  const Drawing all = bench.draw(FigureKind::timeline, {});
  CHECK(bench.replay.position() == 100);
  CHECK(all.title == fmt::format("Run of {} events and {} calls", bench.file.event_count(),
                                 bench.file.calls().size()));
  check_words_on_page(all);
  const auto has_curve = [](const Drawing& drawing, const figure::Colour& colour) {
    return std::any_of(drawing.shapes.begin(), drawing.shapes.end(), [&](const auto& shape) {
      const auto* stroke = std::get_if<figure::Stroke>(&shape);
      return stroke != nullptr && stroke->pen.colour == colour && stroke->places.size() > 10;
    });
  };
  CHECK(has_curve(all, figure::kBadColour));
  CHECK(has_curve(all, figure::kWorstColour));
  const Drawing of_call = bench.draw(FigureKind::timeline, 0);
  CHECK(of_call.title.starts_with("Call 0: "));
}

TEST_CASE("a shell has a, b and p_1 to p_m with their vertices, from every side") {
  Bench bench;
  unsigned shells = 0;
  for (std::uint32_t k = 0; k < bench.file.calls().size() && shells < 15; ++k) {
    const CallStudy study = study_call(bench.file, bench.replay, k);
    if (!study.picture || study.before.size() > 12) continue;
    ++shells;
    CAPTURE(k);
    const Drawing drawing = bench.draw(FigureKind::shell, k);
    for (const char* name : {"a", "b", "p"}) CHECK(has_text(drawing, name));
    for (std::size_t i = 0; i < study.picture->ring.size(); ++i) {
      CHECK(has_text(drawing, fmt::format("{}", i + 1)));
      CHECK(has_text(drawing, fmt::format("{}", study.picture->ring[i].index())));
    }
    CHECK(figure::svg_of(drawing) !=
          figure::svg_of(bench.draw(FigureKind::shell, k, Look{10, 80})));
  }
  CHECK(shells == 15);
}

TEST_CASE("what cannot be drawn is said with the call") {
  Bench bench;
  const auto says = [&](FigureKind kind, std::optional<std::uint32_t> call, const char* words) {
    CHECK_THROWS_WITH_AS(bench.draw(kind, call), doctest::Contains(words), Error);
  };
  says(FigureKind::ring, {}, "a ring is that of a call");
  says(FigureKind::shell, 99999999, "there is no call 99999999");
  const auto& calls = bench.file.calls();
  const auto vertex = std::find_if(calls.begin(), calls.end(),
                                   [](const Call& call) { return call.target_size == 1; });
  REQUIRE(vertex != calls.end());
  says(FigureKind::ring, static_cast<std::uint32_t>(vertex - calls.begin()), "has no ring to draw");
  CHECK_THROWS_WITH_AS(find_figure_kind("pie"),
                       doctest::Contains("'pie': expected one of ring, tree, timeline, shell"),
                       Error);
  for (const char* name : {"ring", "tree", "timeline", "shell"}) {
    CHECK(to_string(find_figure_kind(name)) == name);
  }
}
