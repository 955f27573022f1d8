// SPDX-License-Identifier: MIT
#include "trace/call_script.h"

#include <string>

#include <doctest/doctest.h>

#include "tests/kernel/formats/fixtures.h"
#include "tests/support/forged_trace.h"
#include "tests/support/traced_run.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("settings are names with plain values, tables and compositions; nothing that runs") {
  for (const char* plain :
       {"", "max_level = 5", "most_edges = 7, order = \"longest\", fair = true", "a = -1.5e-07",
        "theta_max = inf",
        R"({"edge_split"}, all_of{{"smoothing", x = 1}, {"b"}}, desperate = 0.9)",
        "sequence{first_of{{\"a\"}}}"}) {
    CAPTURE(plain);
    CHECK(is_plain_settings(plain));
  }
  for (const char* other : {"x = os.exit()",
                            "x = f{1}",
                            "x = f\"a\"",
                            "x = (1)",
                            "1}) improve{} --",
                            "x = 1 -- all",
                            "x = [[a]]",
                            "x = \"a\\\"\"",
                            "x = \"a",
                            "{",
                            "}",
                            "x =",
                            "x = 1,",
                            "x = print",
                            "f{1}",
                            "x = 1 y = 2",
                            "x = 1; y = 2",
                            "x = 1\nimprove{}",
                            "x = 0x10",
                            "while true do end"}) {
    CAPTURE(other);
    CHECK_FALSE(is_plain_settings(other));
  }
  CHECK_FALSE(is_plain_settings(std::string(100'000, '{')));
  CHECK_FALSE(is_plain_settings(std::string(100'000, '{') + std::string(100'000, '}')));
}

TEST_CASE("a call becomes a script only with settings and a name that are such") {
  const TempFolder folder;
  const TetMesh mesh(two_tets());
  TraceRecorder(folder / "sound", mesh, {}).finish();
  std::vector<FrameContent> frames = frames_of(folder / "sound");
  const auto script = [&](const std::string& name, const std::string& settings) -> std::string {
    ForgedEvents events;
    events.kind(EventKind::attempt_begins).put(0).put(0).text(name).put(1).steps({0}).put(0);
    events.put(1).text(settings);
    frames.back() = events.chunk();
    write_frames(folder / "trace", frames);
    const TraceFile file(folder / "trace");
    try {
      return script_of_call(file, file.calls()[0]);
    } catch (const Error& error) {
      return error.what();
    }
  };
  CHECK(script("edge_split", "x = 1") == R"({"edge_split", x = 1})");
  CHECK(script("sequence", R"({"a"}, {"b"})") == R"(sequence{{"a"}, {"b"}})");
  CHECK(script("a", "x = 1}, {}) improve{}").find("trace: event 0: settings that are") !=
        std::string::npos);
  CHECK(script("a\"}) improve{} --", "x = 1").find("an operator of a name") != std::string::npos);
  CHECK(script("untangling", "").find("no attempt of an operator; --at 0") != std::string::npos);
  // A line of a comment ends with it.
  CHECK(script("a\nb", "x = 1") == R"({"a?b", x = 1})");
}
