// SPDX-License-Identifier: MIT
// Without arguments the tests, else one trial for each of many numbers:
//   fault_tests FIRST LAST STEP SCHEDULE MESH [FORM...]
// The status is 0 when nothing was found wrong, 1 for findings, 3 when a run ended the process.
#define DOCTEST_CONFIG_IMPLEMENT
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/faults/fault_trial.h"

namespace {

using namespace tetmend::test;

// For the handler of std::terminate, which is given nothing.
std::string at_work;
long number_at_work = 0;

[[noreturn]] void report_end_of_process() {
  std::fprintf(stderr, "%s: n = %ld: the run ended the process\n", at_work.c_str(), number_at_work);
  std::_Exit(3);
}

/// True if nothing was found. A run that gets by with fewer allocations ends the series.
bool try_all(long first, long last, long step, const std::string& schedule, const std::string& mesh,
             Form form) {
  constexpr std::size_t kMostShown = 10;
  at_work = fmt::format("{} {} {}", schedule, mesh, kFormNames[static_cast<std::size_t>(form)]);
  FaultTrial trial(fault_mesh(mesh), schedule, form);
  long tried = 0;
  long reached = 0;
  long on_two_threads = 0;
  std::size_t found = 0;
  for (long n = first; n <= last; n += step) {
    number_at_work = n;
    const FaultOutcome outcome = trial.run(n);
    ++tried;
    on_two_threads += outcome.on_two_threads ? 1 : 0;
    for (const std::string& finding : outcome.findings) {
      if (++found <= kMostShown) fmt::print("{}: n = {}: {}\n", at_work, n, finding);
    }
    if (!outcome.failed) break;
    reached = n;
  }
  fmt::print(
      "{}: {} runs, {} with two threads; {} attempts kept in a whole one; the last allocation that "
      "failed was number {}; {} findings\n",
      at_work, tried, on_two_threads, trial.kept(), reached, found);
  std::fflush(stdout);
  return found == 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 6 || arguments[1][0] == '-') return doctest::Context(count, arguments).run();
  std::set_terminate(report_end_of_process);
  const std::vector<std::string> forms(arguments + 6, arguments + count);
  bool good = true;
  for (std::size_t i = 0; i < kFormNames.size(); ++i) {
    const bool wanted =
        forms.empty() || std::find(forms.begin(), forms.end(), kFormNames[i]) != forms.end();
    if (!wanted) continue;
    good = try_all(std::atol(arguments[1]), std::atol(arguments[2]), std::atol(arguments[3]),
                   arguments[4], arguments[5], static_cast<Form>(i)) &&
           good;
  }
  return good ? 0 : 1;
}
