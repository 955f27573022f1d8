// SPDX-License-Identifier: MIT
// Traces of strangers: whatever they say, an Error or a trace whose mesh is one after every event.
#include <array>
#include <csignal>
#include <functional>
#include <limits>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/kernel/formats/fixtures.h"
#include "tests/support/forged_trace.h"
#include "tests/support/trace_use.h"
#include "tests/support/traced_run.h"
#include "trace/traced_standard.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Frames `H` and `M` of a trace of two tets, 0 to 4 being their vertices.
std::vector<FrameContent> sound_beginning(const TempFolder& folder) {
  const TetMesh mesh(two_tets());
  TraceRecorder recorder(folder / "sound", mesh, {});
  recorder.finish();
  std::vector<FrameContent> frames = frames_of(folder / "sound");
  frames.pop_back();
  return frames;
}

std::string use_error(const std::filesystem::path& path) {
  try {
    use_trace(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// In a process of its own, with 64 MB more than it has and two seconds: 0 if it ends with an Error.
int use_within_bounds(const std::filesystem::path& path) {
  const pid_t child = ::fork();
  if (child == 0) {
#if !defined(__SANITIZE_ADDRESS__)
    long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
      if (std::fscanf(file, "%ld", &pages) != 1) ::_exit(9);
      std::fclose(file);
    }
    const rlim_t most = static_cast<rlim_t>(pages) * 4096 + (rlim_t{64} << 20);
    const rlimit limit{most, most};
    ::setrlimit(RLIMIT_AS, &limit);
#endif
    const rlimit seconds{2, 2};
    ::setrlimit(RLIMIT_CPU, &seconds);
    try {
      ledger_of_events(path);
      use_trace(path);
    } catch (const Error&) {
      ::_exit(0);
    } catch (...) {
      ::_exit(2);
    }
    ::_exit(1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

struct Hostile {
  std::string_view reason;  ///< part of the message
  std::function<void(ForgedEvents&)> write;
};

constexpr auto kReplace = EventKind::replace_cavity;
constexpr auto kAtSurface = static_cast<EventKind>(13);
constexpr std::uint64_t kNoted = 15;

const std::vector<Hostile> kHostileEvents = {
    {"a tet of vertex 2147483392, which is none",
     [](auto& e) {
       e.kind(kReplace).put(1).put(1).steps({0, 0, 1, 2, 0x7fffff00});
     }},
    {"a tet of vertex 4294967295, which is none",
     [](auto& e) {
       e.kind(kReplace).put(1).put(1).steps({0, 0, 1, 2, 0xffffffff});
     }},
    {"a tet with vertex 1 twice",
     [](auto& e) {
       e.kind(kReplace).put(1).put(1).steps({0, 0, 1, 2, 1});
     }},
    {"slot 1073741823 for something new",
     [](auto& e) {
       e.kind(kReplace).put(1).put(2).steps({0, 0, 1, 2, 3, 0x3fffffff, 0, 0, 0, 0});
     }},
    {"slot 1 for something new; it is in use",
     [](auto& e) {
       e.kind(kReplace).put(1).put(2).steps({0, 0, 1, 2, 3, 1, 0, 0, 0, 0});
     }},
    {"a tet in slot 7, where there is none",
     [](auto& e) {
       e.kind(kReplace).put(1).put(1).steps({7, 0, 1, 2, 3});
     }},
    {"a cavity with tet 0 twice",
     [](auto& e) {
       e.kind(kReplace).put(2).put(1).steps({0, 0, 0, 1, 2, 3});
     }},
    {"do not fill the cavity",
     [](auto& e) {
       e.kind(kReplace).put(1).put(1).steps({0, 0, 1, 2, 4});
     }},
    {"do not fill the cavity",
     [](auto& e) {
       e.kind(kReplace).put(1).put(1).steps({0, 1, 0, 2, 3});
     }},
    {"lies on the same side",
     [](auto& e) {
       e.kind(kReplace).put(1).put(2).steps({0, 0, 1, 2, 3, 2, 0, 0, 0, 0});
     }},
    {"a cavity without tets", [](auto& e) { e.kind(kReplace).put(0).put(0); }},
    {"a cavity without tets", [](auto& e) { e.kind(kReplace).put(1).put(0).steps({0}); }},
    {"counts more than its bytes can hold", [](auto& e) { e.kind(kReplace).put(1u << 30).put(1); }},
    {"counts more than its bytes can hold", [](auto& e) { e.kind(kReplace).put(1).put(1u << 30); }},
    {"counts more than its bytes can hold",
     [](auto& e) { e.kind(EventKind::attempt_begins).put(0).put(0).put(std::uint64_t{1} << 62); }},
    {"a step leads out of 32 bits",
     [](auto& e) {
       e.kind(kReplace).put(1).put(1).steps({-1, 0, 0, 0, 0});
     }},
    {"a step leads out of 32 bits",
     [](auto& e) {
       e.kind(kReplace).put(1).put(1).steps({std::numeric_limits<std::int64_t>::max(), 0, 0, 0, 0});
     }},
    {"slot 1073741808 for something new",
     [](auto& e) { e.kind(EventKind::add_vertex).put(0x3ffffff0).point(0, 0, 0); }},
    {"slot 4294967295 for something new",
     [](auto& e) { e.kind(EventKind::add_vertex).put(0xffffffff).point(0, 0, 0); }},
    {"slot 2 for something new; it is in use",
     [](auto& e) { e.kind(EventKind::add_vertex).put(2).point(0, 0, 0); }},
    {"no finite number",
     [](auto& e) { e.kind(EventKind::add_vertex).put(5).point(0, std::nan(""), 0); }},
    {"no finite number",
     [](auto& e) {
       e.kind(EventKind::move_vertex).put(0).point(0, std::numeric_limits<double>::infinity(), 0);
     }},
    {"vertex 5, which is none",
     [](auto& e) { e.kind(EventKind::move_vertex).put(5).point(0, 0, 0).put(0); }},
    {"a tet in slot 9, where there is none",
     [](auto& e) { e.kind(EventKind::move_vertex).put(0).point(0, 0, 0).put(1).steps({9}); }},
    {"vertex 5, which is none", [](auto& e) { e.kind(EventKind::remove_vertex).put(5); }},
    {"vertex 0 goes, and", [](auto& e) { e.kind(EventKind::remove_vertex).put(0); }},
    {"nothing to undo", [](auto& e) { e.kind(EventKind::undo); }},
    {"event 2: an undo, and there is nothing",
     [](auto& e) {
       e.kind(EventKind::add_vertex).put(5).point(0, 0, 0);
       e.kind(EventKind::undo).kind(EventKind::undo);
     }},
    {"a target of 5 vertices",
     [](auto& e) {
       e.attempt({1, 1, 1, 1, 0});
     }},
    {"a target of 0 vertices", [](auto& e) { e.attempt({}); }},
    {"a target with vertex 4294967295", [](auto& e) { e.attempt({0xffffffff}); }},
    {"a target with vertex 5", [](auto& e) { e.attempt({5}); }},
    {"of level 65536", [](auto& e) { e.attempt({0}, 65536); }},
    {"a call inside 256 others",
     [](auto& e) {
       e.attempt({0});
       for (int k = 0; k < 2000; ++k) {
         e.kind(EventKind::attempt_begins).put(0).put(0).put(1).steps({0}).put(0).put(1);
       }
     }},
    {"an attempt ends that never began",
     [](auto& e) { e.kind(EventKind::attempt_ends).put(0).put(0).text("accepted").put(0).put(0); }},
    {"an attempt ends without a verdict",
     [](auto& e) { e.attempt({0}).kind(EventKind::attempt_ends).put(0).put(0).put(0).put(0); }},
    {"a candidate without an attempt", [](auto& e) { e.kind(EventKind::candidate_found); }},
    {"a pass ends that never began",
     [](auto& e) { e.kind(EventKind::pass_ends).put(0).point(0, 0, 0); }},
    {"a visit ends that never began", [](auto& e) { e.kind(EventKind::visit_ends).put(0); }},
    {"a visit of something that is no tet",
     [](auto& e) {
       e.kind(EventKind::visit_begins).put(0).put(1).steps({0}).put(0).put(0).put(0).put(0);
     }},
    {"a name that was not given yet",
     [](auto& e) { e.kind(EventKind::pass_begins).put(0).put(3).put(0); }},
    {"a time that is none",
     [](auto& e) { e.kind(EventKind::visit_ends).put(std::numeric_limits<std::uint64_t>::max()); }},
    {"its goal or standard is none",
     [](auto& e) { e.kind(EventKind::standard_changes).put(0).point(-1, 0, 0).put(0); }},
    {"16 is no kind of event", [](auto& e) { e.kind(static_cast<EventKind>(16)); }},
    {"15 is no kind of event",
     [](auto& e) { e.put(kNoted).put(0).kind(static_cast<EventKind>(15)); }},
    {"qualities, and not of the tets of their event",
     [](auto& e) {
       e.put(kNoted).put(6).point(0, 0, 0).kind(kReplace).put(1).put(1).steps({0, 0, 1, 2, 3});
     }},
    {"qualities, and not of the tets of their event",
     [](auto& e) { e.put(kNoted).put(6).point(0, 0, 0).kind(EventKind::candidate_found); }},
    {"a quality is no finite number",
     [](auto& e) { e.put(kNoted).put(6).point(0, std::nan(""), 0).kind(kReplace); }},
    {"and tets are judged by none",
     [](auto& e) {
       e.put(kNoted).put(1).put(0).put(0).put(0).put(0);  // 0 in four bytes
       e.kind(kReplace).put(1).put(1).steps({0, 0, 1, 2, 3});
     }},
    {"counts more than its bytes can hold",
     [](auto& e) { e.put(kNoted).put(1u << 30).kind(kReplace); }},
    {"a cavity with more or fewer labels than tets",
     [](auto& e) {
       e.kind(kAtSurface).put(0).put(1).put(1).steps({0, 0, 1, 2, 3});
     }},
    {"a label has more than 32 bits",
     [](auto& e) {
       e.kind(kAtSurface)
           .put(1)
           .steps({std::int64_t{1} << 40})
           .put(1)
           .put(1)
           .steps({0, 0, 1, 2, 3});
     }},
    {"lies on the same side",
     [](auto& e) {
       e.kind(kAtSurface).put(2).steps({0, 0}).put(1).put(2).steps({0, 0, 1, 2, 3, 2, 0, 0, 0, 0});
     }},
};

/// A frame `M` of five vertices and these tets.
FrameContent forged_mesh(std::initializer_list<std::int64_t> steps, std::uint64_t tets,
                         double coordinate = 1, char live = 1, int scale = 0) {
  ByteWriter out;
  out.put_raw('M');
  put_standard(out, Standard(Goal{}));
  out.put(5);
  for (int i = 0; i < 5; ++i) out.put_raw(live);
  for (int i = 0; i < 15; ++i) out.put_raw(i == 7 ? coordinate : 0.5 * i * i);
  out.put(tets);
  for (const std::int64_t step : steps) out.put_signed(step);
  for (std::uint64_t t = 0; t < tets && t < 8; ++t) out.put_signed(0);
  for (int list = 0; list < 4; ++list) out.put(0);
  if (scale != 0) out.put_signed(scale);
  return {out.bytes().begin(), out.bytes().end()};
}

void write_forged(const TempFolder& folder, const std::vector<FrameContent>& beginning,
                  const FrameContent& chunk) {
  std::vector<FrameContent> frames = beginning;
  frames.push_back(chunk);
  write_frames(folder / "forged", frames);
}

/// Errors are allowed; a mesh that is none is not. True if the trace opened.
bool is_error_or_sound(const std::filesystem::path& path) {
  ledger_of_events(path);
  try {
    const std::string findings = findings_in_trace(path);
    REQUIRE_MESSAGE(findings.empty(), findings);
    use_trace(path);
    return true;
  } catch (const ByteReader::Damage& damage) {
    FAIL("replay found what opening did not: " << damage.what());
  } catch (const Error& error) {
    CHECK(std::string_view(error.what()).starts_with(path.string() + ":"));
  }
  return false;
}

std::filesystem::path lesson_trace(const std::string& name) {
  return std::filesystem::path(TETMEND_SOURCE_DIR) / "assets/lessons" / name;
}

}  // namespace

TEST_CASE("an event that does not fit the mesh is refused with byte, event and reason") {
  const TempFolder folder;
  const auto beginning = sound_beginning(folder);
  for (const Hostile& hostile : kHostileEvents) {
    CAPTURE(hostile.reason);
    ForgedEvents events;
    hostile.write(events);
    write_forged(folder, beginning, events.chunk());
    REQUIRE(use_within_bounds(folder / "forged") == 0);
    const std::string message = use_error(folder / "forged");
    CHECK_MESSAGE(message.find(hostile.reason) != std::string::npos, message);
    CHECK(message.starts_with((folder / "forged").string() + ": byte "));
    const bool is_undo = hostile.reason.find("nothing") != std::string_view::npos;
    if (is_undo) CHECK(ledger_of_events(folder / "forged").empty());
  }
}

TEST_CASE("a place that the scale takes out of the doubles is refused, in a mesh and in an event") {
  const TempFolder folder;
  const auto beginning = sound_beginning(folder);
  const std::string reason = "a coordinate and the scale do not go together";
  write_frames(folder / "forged", {beginning[0], forged_mesh({0, 1, 2, 3}, 1, 1e300, 1, 500)});
  CHECK(use_error(folder / "forged").find(reason) != std::string::npos);
  for (const double x : {1e10, 1e300}) {
    ForgedEvents event;
    event.kind(EventKind::add_vertex).put(5).point(x, 0, 0);
    write_frames(folder / "forged", {beginning[0], forged_mesh({0, 1, 2, 3}, 1, 1, 1, 500),
                                     event.chunk(), end_frame(1)});
    CHECK((use_error(folder / "forged").find(reason) != std::string::npos) == (x > 1e100));
  }
}

TEST_CASE("qualities by a measure of a program are refused unless there is one for each tet") {
  const TempFolder folder;
  TetMesh mesh(two_tets());
  mesh.set_standard(Standard::of({"flatness", 1, [](auto&&...) { return 0.5; }}));
  TraceRecorder(folder / "sound", mesh, {}).finish();
  std::vector<FrameContent> frames = frames_of(folder / "sound");
  CHECK(TraceFile(folder / "sound").initial_mesh().quality(TetHandle(1)) == 0.5F);
  FrameContent& last = frames[1];  // ends with 2, and two numbers of four bytes
  last.resize(last.size() - 4);
  last[last.size() - 5] = std::byte{1};
  write_frames(folder / "forged", frames);
  CHECK(use_error(folder / "forged").find("1 qualities of 2 tets") != std::string::npos);
}

TEST_CASE("chunks and ends that count wrong are refused") {
  const TempFolder folder;
  const auto beginning = sound_beginning(folder);
  ForgedEvents vertex;
  vertex.kind(EventKind::add_vertex).put(5).point(0, 0, 0);
  const std::vector<std::pair<std::string, FrameContent>> wrong = {
      {"a chunk without events", vertex.chunk(0, 0)},
      {"more events than it counts", ForgedEvents(vertex).kind(EventKind::undo).chunk(0, 1)},
      {"a number is cut off", vertex.chunk(0, 2)},
      {"counts more than its bytes can hold", vertex.chunk(0, std::uint64_t{1} << 60)},
      {"begins with event 3", vertex.chunk(3, 1)},
      {"a frame of no known kind", FrameContent(3, std::byte{'Q'})},
      {"a frame of no known kind", FrameContent()},
      {"the end counts 4 events", end_frame(4)},
      {"an end of no known kind", end_frame(0, 2)}};
  for (const auto& [expected, frame] : wrong) {
    const std::string reason = expected;
    CAPTURE(reason);
    write_forged(folder, beginning, frame);
    REQUIRE(use_within_bounds(folder / "forged") == 0);
    CHECK(use_error(folder / "forged").find(reason) != std::string::npos);
  }
}

TEST_CASE("a mesh that is none is refused before the first event") {
  const TempFolder folder;
  const auto beginning = sound_beginning(folder);
  const std::vector<std::pair<std::string, FrameContent>> wrong = {
      {"a tet of vertex 5, which is none", forged_mesh({0, 1, 2, 5}, 1)},
      {"a tet of vertex 4294967295", forged_mesh({0, 1, 2, 0xffffffff}, 1)},
      {"a tet of vertex 0, which is none", forged_mesh({0, 1, 2, 3}, 1, 1, 0)},
      {"a tet with vertex 0 twice", forged_mesh({0, 1, 2, 0}, 1)},
      {"lies on the same side of a face", forged_mesh({0, 1, 2, 3, 0, 0, 0, 1}, 2)},
      {"vertex 2 has no finite coordinates", forged_mesh({0, 1, 2, 3}, 1, std::nan(""))},
      {"vertex 0 is not told to live", forged_mesh({0, 1, 2, 3}, 1, 1, 2)},
      {"counts more than its bytes can hold", forged_mesh({0, 1, 2, 3}, 1u << 30)}};
  for (const auto& [expected, mesh] : wrong) {
    const std::string reason = expected;
    CAPTURE(reason);
    write_frames(folder / "forged", {beginning[0], mesh});
    REQUIRE(use_within_bounds(folder / "forged") == 0);
    const std::string message = use_error(folder / "forged");
    CHECK_MESSAGE(message.find(reason) != std::string::npos, message);
  }
}

TEST_CASE("a frame that claims more than its bytes can hold takes no memory") {
  const TempFolder folder;
  sound_beginning(folder);
  const std::string head = read_text(folder / "sound").substr(0, kTraceMagicSize);
  const auto raw = [](std::uint64_t number) {
    return std::string(reinterpret_cast<const char*>(&number), sizeof number);
  };
  const std::string magic = "\x28\xb5\x2f\xfd\xe0";
  const auto check = [&](std::uint64_t claim, const std::string& blocks) {
    const std::string frame = magic + raw(claim) + blocks;
    write_text(folder / "claim", head + raw(claim) + raw(frame.size()) + frame);
    CHECK(use_within_bounds(folder / "claim") == 0);
    CHECK(use_error(folder / "claim").find("bytes cannot hold") != std::string::npos);
  };
  const std::string empty_block("\x01\0\0", 3);
  check(std::uint64_t{1} << 27, empty_block);
  check(std::uint64_t{8} << 30, empty_block);
  check(std::numeric_limits<std::uint64_t>::max() - 7, empty_block);
  // Blocks of four bytes that stand for 2^17 zeros each.
  std::string zeros;
  for (int block = 0; block < 1024; ++block) {
    zeros += std::string(block < 1023 ? "\x02\0\x10\0" : "\x03\0\x10\0", 4);
  }
  check(std::uint64_t{1} << 27, zeros);
}

TEST_CASE("a trace with any byte of its content changed is refused or has a mesh at every event") {
  const TempFolder folder;
  for (const char* name : {"2-two-shells.trace", "3-refusals.trace"}) {
    const std::vector<FrameContent> sound = frames_of(lesson_trace(name));
    std::size_t opened = 0;
    for (std::size_t f = 0; f < sound.size(); ++f) {
      for (std::size_t at = 0; at < sound[f].size(); ++at) {
        const unsigned change = std::array{0x01u, 0x80u, 0xffu}[at % 3];
        CAPTURE(f);
        CAPTURE(at);
        CAPTURE(change);
        std::vector<FrameContent> frames = sound;
        frames[f][at] ^= static_cast<std::byte>(change);
        write_frames(folder / "changed", frames);
        opened += is_error_or_sound(folder / "changed") ? 1 : 0;
      }
    }
    CHECK(opened > 100);  // a coordinate may well be another
  }
}

TEST_CASE("a trace whose frames are cut anywhere, with sound checksums, is refused or sound") {
  const TempFolder folder;
  const std::vector<FrameContent> sound = frames_of(lesson_trace("2-two-shells.trace"));
  for (std::size_t f = 0; f < sound.size(); ++f) {
    for (std::size_t size = 0; size < sound[f].size(); ++size) {
      CAPTURE(f);
      CAPTURE(size);
      std::vector<FrameContent> frames = sound;
      frames[f].resize(size);
      write_frames(folder / "cut", frames);
      is_error_or_sound(folder / "cut");
    }
  }
}

TEST_CASE("a trace with any byte of its file changed or cut is refused or sound") {
  const TempFolder folder;
  const std::string sound = read_text(lesson_trace("1-core.trace"));
  for (std::size_t at = 0; at < sound.size(); ++at) {
    CAPTURE(at);
    std::string changed = sound;
    changed[at] = static_cast<char>(changed[at] ^ 0x55);
    write_text(folder / "changed", changed);
    is_error_or_sound(folder / "changed");
    write_text(folder / "changed", sound.substr(0, at));
    is_error_or_sound(folder / "changed");
  }
}
