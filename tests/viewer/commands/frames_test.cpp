// SPDX-License-Identifier: MIT
#include "viewer/commands/frames.h"

#include <doctest/doctest.h>

#include "figure/drawing_file.h"
#include "kernel/error.h"
#include "tests/support/example_traces.h"
#include "tests/viewer/session.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TraceSession;

TEST_CASE("frames have all events that were asked for, and no others") {
  const FrameRange range = frame_range({10, 50, 20}, 100);
  CHECK(range.count() == 3);
  CHECK(frame_range({}, 100).count() == 101);
  CHECK(frame_range({5, 5, {}}, 100).count() == 1);
  CHECK(frame_range({}, 200'000).count() <= kUsualFrames);
  CHECK(frame_range({}, 0).count() == 1);
  const auto says = [](const FrameRequest& request, const char* words) {
    CHECK_THROWS_WITH_AS(frame_range(request, 1'000'000), doctest::Contains(words), Error);
  };
  says({50, 10, 1}, "the first is after the last");
  says({0, 1'000'001, 1}, "the trace has 1000000 events");
  says({0, 10, 0}, "every 0 events");
  says({0, 500'000, 1}, "too many");
}

TEST_CASE("the name of a frame has one place for its number") {
  CHECK(frame_name("f-%04d.png", 7) == "f-0007.png");
  CHECK(frame_name("f-%04d.png", 12345) == "f-12345.png");
  CHECK(frame_name("a/%d.png", 3) == "a/3.png");
  for (const char* wrong : {"f.png", "f-%04d.gif", "%d-%d.png", "%s.png", "%4d.png", "%00d.png",
                            "%0d.png", "%.png", "%", "%%d.png", "%d%.png", "%04d"}) {
    CAPTURE(wrong);
    CHECK_THROWS_WITH_AS(frame_name(wrong, 1), doctest::Contains("one %d or %04d"), Error);
  }
}

TEST_CASE("frames are pictures in a row, and the place in the trace stays") {
  const test::TracedBall trace;
  TraceSession s(trace.path());
  s.document.resize({32, 24});
  s.run("seek", {17});
  const test::TempFolder folder;
  const auto count =
      s.run("frames",
            {{{"from", 0}, {"to", 20}, {"every", 5}, {"file", (folder / "f-%02d.png").string()}}});
  CHECK(count == 5);
  CHECK(folder.entries() == 5);
  CHECK(std::filesystem::exists(folder / "f-00.png"));
  CHECK(std::filesystem::exists(folder / "f-04.png"));
  CHECK(s.document.debugger()->position() == 17);
  CHECK_THROWS_WITH_AS(s.run("frames", {{{"file", "x.jpg"}}}), doctest::Contains("f-%04d.png"),
                       Error);
  CHECK_THROWS_WITH_AS(s.run("frames", {{{"fil", "x.png"}}}), doctest::Contains("fil"), Error);
  CHECK_THROWS_WITH_AS(s.run("frames", {{{"from", -1}, {"file", "f%d.png"}}}),
                       doctest::Contains("a whole number"), Error);
}

TEST_CASE("a figure by command is that of the call, byte for byte") {
  const test::TracedBall trace;
  TraceSession s(trace.path());
  s.run("run_to", {"operator shell_transformation"});
  const std::uint32_t call = s.document.debugger()->call();
  const test::TempFolder folder;
  const TraceFile file(trace.path());
  Replay replay(file);
  for (const char* what : {"ring", "tree", "timeline", "shell"}) {
    const std::filesystem::path out = folder / (std::string(what) + ".svg");
    s.run("figure", {{{"what", what}, {"file", out.string()}}});
    CHECK(test::read_text(out) ==
          figure::svg_of(draw_call(file, replay, {find_figure_kind(what), call, {}})));
  }
  const std::filesystem::path first = folder / "first.pdf";
  s.run("figure", {{{"what", "tree"}, {"call", 0}, {"file", first.string()}}});
  CHECK(test::read_text(first) ==
        figure::pdf_of(draw_call(file, replay, {FigureKind::tree, 0, {}})));
  CHECK_THROWS_WITH_AS(s.run("figure", {{{"what", "pie"}, {"file", "x.svg"}}}),
                       doctest::Contains("ring, tree"), Error);
  CHECK_THROWS_WITH_AS(s.run("figure", {{{"what", "ring"}, {"file", "x.png"}}}),
                       doctest::Contains(".svg, .pdf or .tex"), Error);
  CHECK_THROWS_WITH_AS(s.run("figure", {{{"what", "ring"}}}), doctest::Contains("file must be"),
                       Error);
}
