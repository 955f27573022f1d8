// SPDX-License-Identifier: MIT
// What five steps of a session cost beside one whole run: sessions MESH [run | WAY...]. A WAY is how far points move in
// a step, as a share of the width of the mesh. With one of them alone, a profiler counts that.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <tetmend/improve.h>

namespace {

using namespace tetmend;

constexpr int kSteps = 5;
constexpr std::array<const char*, 4> kUsual = {"run", "0.001", "0.01", "0.05"};

struct Cost {
  std::size_t attempts = 0;
  std::size_t bad_before = 0;
  std::size_t bad = 0;
};

Cost run(Mesh mesh) {
  const Result result = improve(mesh);
  Cost cost{.bad_before = result.before.n_bad, .bad = result.after.n_bad};
  for (const Pass& pass : result.passes) cost.attempts += pass.attempts();
  return cost;
}

/// A wave along y that bends the mesh to and fro.
Cost follow(Mesh mesh, double way) {
  Improver session(std::move(mesh));
  Cost cost;
  for (int step = 0; step < kSteps; ++step) {
    const auto now = session.mesh().points();
    std::vector<std::array<double, 3>> points(now.begin(), now.end());
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    for (const auto& p : points) low = std::min(low, p[1]), high = std::max(high, p[1]);
    const double width = high - low;
    for (auto& [x, y, z] : points) {
      x += way * width * std::sin(std::numbers::pi * (y - low) / width + step);
    }
    if (!session.move(points)) throw Error("a tet would turn over");
    const ImproverStep done = session.improve();
    cost.attempts += done.attempts;
    cost.bad = done.after.n_bad;
    if (step == 0) cost.bad_before = done.before.n_bad;
  }
  return cost;
}

void tell(const Mesh& mesh, const std::string& what) {
  const std::clock_t start = std::clock();
  const Cost cost = what == "run" ? run(mesh) : follow(mesh, std::stod(what));
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const std::string name = what == "run" ? "whole run" : "5 steps, way " + what;
  std::printf("%-18s %9zu attempts %8.3f s, bad tets %zu, then %zu\n", name.c_str(), cost.attempts,
              seconds, cost.bad_before, cost.bad);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: sessions MESH [run | WAY...]\n");
    return 1;
  }
  try {
    const Mesh mesh = load(argv[1]);
    std::vector<std::string> which(argv + 2, argv + argc);
    if (which.empty()) which.assign(kUsual.begin(), kUsual.end());
    for (const std::string& what : which) tell(mesh, what);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
