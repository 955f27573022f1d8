// SPDX-License-Identifier: MIT
// What the viewer costs without a window: to open a file, to turn and cut it, and a step through a
// trace.
//
//   viewer_cost [--json] FILE [STEPS]
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "platform/platform.h"
#include "viewer/document.h"
#include "viewer/ui/headless.h"

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

/// Of the same work again and again, in seconds.
struct Figure {
  std::string what;
  double median = 0, mean = 0, most = 0;
};

class Figures {
 public:
  void tell(const std::string& what, std::vector<double> costs) {
    std::sort(costs.begin(), costs.end());
    double sum = 0;
    for (const double c : costs) sum += c;
    const auto n = costs.size();
    list_.push_back({what, costs[n / 2], sum / static_cast<double>(n), costs.back()});
  }
  void print() const {
    for (const Figure& f : list_) {
      fmt::print("{:<52} {:9.2f} ms median {:9.2f} mean {:9.2f} most\n", f.what, 1e3 * f.median,
                 1e3 * f.mean, 1e3 * f.most);
    }
  }
  nlohmann::json to_json() const {
    nlohmann::json list = nlohmann::json::array();
    for (const Figure& f : list_) {
      list.push_back({{"what", f.what}, {"median", f.median}, {"mean", f.mean}, {"most", f.most}});
    }
    return list;
  }

 private:
  std::vector<Figure> list_;
};

void steps(Document& document, int count, Figures& figures) {
  Debugger& debugger = *document.debugger();
  const auto walk = [&](const std::string& name, const auto& move) {
    std::vector<double> costs;
    for (int i = 0; i < count; ++i) {
      costs.push_back(cost([&] {
        move();
        document.show_trace();
        look(document);
      }));
    }
    figures.tell(name, costs);
  };
  const Condition accepted = parse_condition("accepted");
  for (const bool isolated : {true, false}) {
    document.view.scene.isolate = isolated;
    const std::string seen = isolated ? "the call alone: " : "the whole mesh: ";
    debugger.seek(debugger.end() / 2);
    document.show_trace();
    look(document);
    debugger.step(Step::into, Direction::forward);
    document.show_trace();
    look(document);
    walk(seen + "into", [&] { debugger.step(Step::into, Direction::forward); });
    walk(seen + "into, back", [&] { debugger.step(Step::into, Direction::back); });
    walk(seen + "over", [&] { debugger.step(Step::over, Direction::forward); });
    walk(seen + "over, back", [&] { debugger.step(Step::over, Direction::back); });
    walk(seen + "to the next accepted call",
         [&] { debugger.run_to(accepted, Direction::forward); });
    walk(seen + "to the accepted call before", [&] { debugger.run_to(accepted, Direction::back); });
  }
}

/// Whole pictures, drawn without a window.
void pictures(Document& document, Host& host, Figures& figures) {
  document.show_panels = false;
  figures.tell("first picture", {cost([&] { static_cast<void>(host.render(document)); })});
  std::vector<double> costs;
  for (int i = 0; i < 10; ++i) {
    document.view.camera.orbit(10, 3);
    costs.push_back(cost([&] { static_cast<void>(host.render(document)); }));
  }
  figures.tell("picture, turned", costs);
}

void cuts(Document& document, Figures& figures) {
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
  figures.tell("cut at whole tets", whole);
  figures.tell("exact cut", exact);
}

void run(const std::string& file, int count, bool as_json) {
  Figures figures;
  const auto host = make_headless_host(1);
  Document document;
  document.resize({1280, 720});
  figures.tell("open", {cost([&] { document.open(file); })});
  figures.tell("what is seen first, lists, figures", {cost([&] { look(document); })});
  const bool is_trace = document.debugger() != nullptr;
  if (is_trace) {
    steps(document, count, figures);
  } else {
    pictures(document, *host, figures);
    cuts(document, figures);
  }
  const std::size_t memory = platform::peak_memory();
  if (as_json) {
    const nlohmann::json told = {{"tets", document.mesh().tet_count()},
                                 {"events", is_trace ? document.debugger()->end() : 0},
                                 {"peak_memory", memory},
                                 {"figures", figures.to_json()}};
    fmt::print("{}\n", told.dump());
    return;
  }
  figures.print();
  fmt::print("{:<52} {:9.2f} GB for {} tets\n", "memory at most",
             static_cast<double>(memory) / (1 << 30), document.mesh().tet_count());
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool as_json = !arguments.empty() && arguments.front() == "--json";
  if (as_json) arguments.erase(arguments.begin());
  if (arguments.empty()) {
    std::fputs("viewer_cost [--json] FILE [STEPS]\n", stderr);
    return 2;
  }
  try {
    run(arguments[0], arguments.size() > 1 ? std::max(1, std::atoi(arguments[1].c_str())) : 200,
        as_json);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "viewer_cost: %s\n", error.what());
    return 1;
  }
}
