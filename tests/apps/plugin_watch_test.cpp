// SPDX-License-Identifier: MIT
// Plugins that crash or do not come back, and --check-operators, as a user of the command line has
// them.
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <sys/resource.h>

#include "tests/apps/program.h"
#include "tests/support/plugin_file.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

struct Trial {
  std::string plugin;
  std::string op;
  std::vector<std::string> options;
  std::string below = "0.8";  // of the tets that it works on
  bool recorded = false;
};

/// No file with what was in memory is wanted, here and in what is started from here.
class NoCore {
 public:
  NoCore() {
    ::getrlimit(RLIMIT_CORE, &before_);
    const rlimit none{0, before_.rlim_max};
    ::setrlimit(RLIMIT_CORE, &none);
  }
  ~NoCore() { ::setrlimit(RLIMIT_CORE, &before_); }
  NoCore(const NoCore&) = delete;
  NoCore& operator=(const NoCore&) = delete;

 private:
  rlimit before_{};
};

/// Improves a small mesh with one operator, over a file that is there already; checks that nothing
/// else is left in its folder.
struct Ended {
  test::Outcome outcome;
  std::string written;
  test::Outcome trace;  // of looking at what is there of it
};
Ended improve(const Trial& trial) {
  const TempFolder folder;
  const std::string mesh = std::string(TETMEND_SOURCE_DIR) + "/assets/meshes/bracket.meshb";
  const std::string out = (folder / "out.mesh").string();
  const std::string script = (folder / "mine.lua").string();
  write_text(out, "dear to me");
  write_text(script, "apply(\"" + trial.op + "\", {on = {below = " + trial.below + "}})\n");
  std::vector<std::string> arguments = {"improve",    mesh,       "-o",
                                        out,          "--plugin", plugin_file(trial.plugin),
                                        "--schedule", script,     "--quiet"};
  arguments.insert(arguments.end(), trial.options.begin(), trial.options.end());
  const std::string trace = (folder / "run.trace").string();
  if (trial.recorded) arguments.insert(arguments.end(), {"--trace", trace});
  Ended ended{run_program(arguments), {}, {}};
  ended.written = read_text(out);
  CHECK(folder.entries() == (trial.recorded ? 3 : 2));
  if (trial.recorded) ended.trace = run_program({"trace", trace + ".part"});
  return ended;
}

constexpr const char* kOld = "dear to me";

}  // namespace

TEST_CASE("an attempt that does not come back is named, and the time limit ends the run") {
  for (const std::string threads : {"1", "3"}) {
    const Ended ended =
        improve({"hanging",
                 "hangs",
                 {"--attempt-limit", "0.2", "--time-limit", "0.5", "--threads", threads}});
    const test::Outcome& outcome = ended.outcome;
    const std::string& written = ended.written;
    CAPTURE(outcome.err);
    CHECK(outcome.status == 1);
    const std::string who = "operator 'hangs' of " + plugin_file("hanging") + " at vertex ";
    CHECK(outcome.err.starts_with("tetmend: " + who));
    CHECK(contains(outcome.err, " has not come back for 0.2 s\n"));
    CHECK(contains(outcome.err, "and the time limit is over: no mesh was written\n"));
    CHECK(written == kOld);
  }
}

TEST_CASE("an attempt that does not come back is named once, and not at all with a limit of 0") {
  const std::string note = "has not come back for";
  const auto named =
      improve({"hanging", "hangs", {"--attempt-limit", "0.2", "--time-limit", "0.5"}}).outcome.err;
  CHECK(named.find(note) != std::string::npos);
  CHECK(named.find(note) == named.rfind(note));
  const auto silent =
      improve({"hanging", "hangs", {"--attempt-limit", "0", "--time-limit", "0.5"}}).outcome.err;
  CHECK(silent.find(note) == std::string::npos);
}

TEST_CASE("attempts that are slow and come back end in time, with what was reached") {
  const Ended ended = improve({"hanging", "slow", {"--time-limit", "0.5"}});
  const test::Outcome& outcome = ended.outcome;
  const std::string& written = ended.written;
  CHECK(outcome.err.empty());
  CHECK(outcome.status == 0);
  CHECK(written != kOld);
}

TEST_CASE("a crash in an attempt is told with operator, plugin and target before it ends the run") {
  const NoCore none;
  struct Case {
    std::string op;
    int signal;
  };
  for (const auto& trial :
       {Case{"crashes", SIGSEGV}, Case{"recurses", SIGSEGV}, Case{"aborts", SIGABRT}}) {
    const std::string& op = trial.op;
    const int signal = trial.signal;
    for (const std::string threads : {"1", "3"}) {
      CAPTURE(op);
      CAPTURE(threads);
      const Ended ended = improve({"crashing", op, {"--threads", threads}});
      const test::Outcome& outcome = ended.outcome;
      const std::string& written = ended.written;
      CAPTURE(outcome.err);
      CHECK(outcome.status == 128 + signal);
      const std::string line =
          "tetmend: crashed in operator '" + op + "' of " + plugin_file("crashing") + " at vertex ";
      CHECK(outcome.err.starts_with(line));
      CHECK(outcome.err.ends_with("\n"));
      CHECK(written == kOld);
    }
  }
}

TEST_CASE("after a crash, and after an attempt that did not come back, the trace can be opened") {
  const NoCore none;
  for (const Trial& trial : {Trial{"crashing", "crashes", {}, "0.8", true},
                             Trial{"hanging", "hangs", {"--time-limit", "0.5"}, "0.8", true}}) {
    const Ended ended = improve(trial);
    CAPTURE(ended.trace.err);
    CHECK(ended.outcome.status != 0);
    CHECK(ended.trace.status == 0);
    CHECK(contains(ended.trace.err, "has no end, the run was not finished"));
  }
}

TEST_CASE("check-plugin names an attempt that does not come back, and gives up") {
  const test::Outcome outcome =
      run_program({"check-plugin", plugin_file("hanging"), "--attempt-limit", "0.1"});
  CAPTURE(outcome.err);
  CHECK(outcome.status == 1);
  const std::string who = "tetmend: operator 'hangs' of " + plugin_file("hanging") + " at vertex ";
  CHECK(outcome.err.starts_with(who));
  CHECK(contains(outcome.err, " has not come back for 0.1 s\n" + who));
  CHECK(contains(outcome.err, " has not come back for 0.6 s: given up\n"));
  const test::Outcome wrong =
      run_program({"check-plugin", plugin_file("hanging"), "--attempt-limit", "nan"});
  CHECK(wrong.status == 2);
  CHECK(contains(wrong.err, "--attempt-limit: 'nan' is not a number of seconds"));
}

TEST_CASE("one Ctrl-C ends a run whose attempt does not come back") {
  const TempFolder folder;
  const std::string out = (folder / "out.mesh").string();
  const std::string script = (folder / "mine.lua").string();
  write_text(out, kOld);
  write_text(script, "apply(\"hangs\", {on = {below = 0.8}})\n");
  const int err = ::open((folder / "err").c_str(), O_WRONLY | O_CREAT, 0666);
  const auto begin = std::chrono::steady_clock::now();
  Program program({"improve", std::string(TETMEND_SOURCE_DIR) + "/assets/meshes/bracket.meshb",
                   "-o", out, "--plugin", plugin_file("hanging"), "--schedule", script, "--quiet",
                   "--attempt-limit", "0.1"},
                  (folder / "said").string(), err);
  const auto said = [&] { return read_text(folder / "err"); };
  for (int i = 0; i < 600 && !contains(said(), "has not come back"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  REQUIRE(contains(said(), "has not come back"));
  program.send(SIGINT);
  CHECK(program.wait() == 1);
  ::close(err);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  CHECK(passed.count() < 40);  // by itself it comes back after a minute
  CHECK(contains(said(), " has not come back: interrupted, no mesh was written\n"));
  CHECK(read_text(out) == kOld);
}

TEST_CASE("check-plugin names the operator that crashes") {
  const NoCore none;
  const test::Outcome outcome = run_program({"check-plugin", plugin_file("crashing")});
  CHECK(outcome.status == 128 + SIGSEGV);
  CHECK(contains(outcome.err, "tetmend: crashed in operator 'crashes' of "));
}

TEST_CASE("improve --check-operators ends at the first breach, and no output is touched") {
  const Ended ended = improve({"sly", "moves_another", {"--check-operators"}});
  const test::Outcome& outcome = ended.outcome;
  const std::string& written = ended.written;
  CAPTURE(outcome.err);
  CHECK(outcome.status == 1);
  CHECK(outcome.err.starts_with("tetmend: "));
  CHECK(contains(outcome.err, "operator 'moves_another' of " + plugin_file("sly") +
                                  " breaks the contract at vertex "));
  CHECK(contains(outcome.err, "something changed that the judge did not see"));
  CHECK(written == kOld);
  CHECK(improve({"sly", "moves_another", {}}).outcome.status == 0);  // nobody looks
}

TEST_CASE("improve --check-operators in pieces names the piece that has the breach") {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--pieces", "3"}, {"--pieces", "3", "--memory", "1G"}}) {
    std::vector<std::string> options = {"--check-operators", "--threads", "2"};
    options.insert(options.end(), more.begin(), more.end());
    const Ended ended = improve({"sly", "moves_another", options});
    CAPTURE(ended.outcome.err);
    CHECK(ended.outcome.status == 1);
    CHECK(contains(ended.outcome.err, "round 1, piece "));
    CHECK(contains(ended.outcome.err, ": operator 'moves_another' of " + plugin_file("sly") +
                                          " breaks the contract at vertex "));
    CHECK(ended.written == kOld);
  }
  const auto plain = improve({"sound", "sound", {"--pieces", "3"}, "0.1"});
  const auto checked = improve({"sound", "sound", {"--pieces", "3", "--check-operators"}, "0.1"});
  CHECK(checked.outcome.status == 0);
  CHECK(plain.written == checked.written);
}

TEST_CASE(
    "improve --check-operators writes the same mesh as without, for operators that are sound") {
  const auto plain = improve({"sound", "sound", {"--threads", "2"}, "0.1"});
  const auto checked = improve({"sound", "sound", {"--threads", "2", "--check-operators"}, "0.1"});
  CHECK(plain.outcome.status == 0);
  CHECK(checked.outcome.status == 0);
  CHECK(checked.outcome.err.empty());
  CHECK(plain.written != kOld);
  CHECK(plain.written == checked.written);
}
