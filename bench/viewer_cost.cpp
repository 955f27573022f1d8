// SPDX-License-Identifier: MIT
// What the viewer costs without a window: to open a file, to cut, and a step through a trace.
//
//   viewer_cost FILE [STEPS]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "platform/platform.h"
#include "viewer/document.h"

namespace {

using namespace tetmend;
using namespace tetmend::viewer;

/// Seconds of the processor so far, of all threads.
double cpu() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// All that a frame asks of the document.
void look(Document& document) {
  static_cast<void>(document.scene_revision());
  static_cast<void>(document.highlighted());
  static_cast<void>(document.histogram());
  static_cast<void>(document.worst());
  static_cast<void>(document.statistics());
}

template <class Work>
double cost(const Work& work) {
  const double begin = cpu();
  work();
  return cpu() - begin;
}

void tell(const std::string& what, std::vector<double> costs) {
  std::sort(costs.begin(), costs.end());
  double sum = 0;
  for (const double c : costs) sum += c;
  const auto n = costs.size();
  fmt::print("{:<34} {:8.2f} ms median {:8.2f} mean {:8.2f} most\n", what, 1e3 * costs[n / 2],
             1e3 * sum / static_cast<double>(n), 1e3 * costs.back());
}

void steps(Document& document, int count) {
  Debugger& debugger = *document.debugger();
  const auto walk = [&](const char* name, const auto& move) {
    std::vector<double> costs;
    for (int i = 0; i < count; ++i) {
      costs.push_back(cost([&] {
        move();
        document.show_trace();
        look(document);
      }));
    }
    tell(name, costs);
  };
  const Condition accepted = parse_condition("accepted");
  for (const bool isolated : {true, false}) {
    document.view.scene.isolate = isolated;
    fmt::print("{}\n", isolated ? "the call alone" : "the whole mesh");
    debugger.seek(debugger.end() / 2);
    document.show_trace();
    look(document);
    debugger.step(Step::into, Direction::forward);
    document.show_trace();
    look(document);
    walk("  into", [&] { debugger.step(Step::into, Direction::forward); });
    walk("  into, back", [&] { debugger.step(Step::into, Direction::back); });
    walk("  over", [&] { debugger.step(Step::over, Direction::forward); });
    walk("  over, back", [&] { debugger.step(Step::over, Direction::back); });
    walk("  to the next accepted call", [&] { debugger.run_to(accepted, Direction::forward); });
    walk("  to the accepted call before", [&] { debugger.run_to(accepted, Direction::back); });
  }
}

void cuts(Document& document) {
  look(document);
  std::vector<double> whole, exact;
  for (int i = 0; i < 5; ++i) {
    CutPlane& cut = document.view.scene.cuts[0];
    cut.on = true;
    cut.position = -0.4 + 0.2 * i;
    cut.exact = false;
    whole.push_back(cost([&] { look(document); }));
    cut.exact = true;
    exact.push_back(cost([&] { look(document); }));
  }
  tell("cut at whole tets", whole);
  tell("exact cut", exact);
}

void run(const std::string& file, int count) {
  Document document;
  document.resize({1280, 720});
  fmt::print("{:<34} {:8.2f} s\n", "open", cost([&] { document.open(file); }));
  fmt::print("{:<34} {:8.2f} s\n", "first picture, lists, figures", cost([&] { look(document); }));
  if (document.debugger() != nullptr) {
    steps(document, count);
  } else {
    cuts(document);
  }
  fmt::print("{:<34} {:8.2f} GB for {} tets\n", "memory at most",
             static_cast<double>(platform::peak_memory()) / (1 << 30), document.mesh().tet_count());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("viewer_cost FILE [STEPS]\n", stderr);
    return 2;
  }
  try {
    run(argv[1], argc > 2 ? std::max(1, std::atoi(argv[2])) : 200);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "viewer_cost: %s\n", error.what());
    return 1;
  }
}
