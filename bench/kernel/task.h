// SPDX-License-Identifier: MIT
// What script/bench --kernel asks of every mesh kernel: the same walks and the same edits on the same mesh. A
// kernel is a class made of the arrays, with a function for each task that it can do.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include <malloc.h>
#include <tetmend/io.h>
#include <tetmend/mesh.h>

namespace tetmend::bench {

struct Arrays {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint32_t, 4>> tets;
};

/// Edges by the numbers of their ends, of which no two are near each other.
struct Edits {
  std::vector<std::array<std::uint32_t, 2>> flips;         ///< three tets each, two after a flip
  std::vector<std::array<std::uint32_t, 2>> contractions;  ///< the first end goes
};

inline Arrays read_arrays(const char* file) {
  const Mesh mesh = load(file);
  return {{mesh.points().begin(), mesh.points().end()}, {mesh.tets().begin(), mesh.tets().end()}};
}

/// Lines "flip A B" and "contract A B".
inline Edits read_edits(const char* file) {
  Edits edits;
  std::ifstream in(file);
  std::string word;
  std::array<std::uint32_t, 2> edge{};
  while (in >> word >> edge[0] >> edge[1]) {
    (word == "flip" ? edits.flips : edits.contractions).push_back(edge);
  }
  return edits;
}

/// Bytes that the program holds on the heap.
inline std::size_t held() {
  const struct mallinfo2 now = mallinfo2();
  return now.uordblks + now.hblkhd;
}

/// Seconds of the processor.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// "NAME FIGURE COUNT": nanoseconds for each of what was done, and a count that all kernels agree on.
inline void tell(const char* name, double figure, std::size_t count) {
  std::printf("%s %.6g %zu\n", name, figure, count);
}

/// Does the work and tells its time. @param work returns what it counted
template <class Work>
void time(const char* name, std::size_t times, const Work& work) {
  const double start = cpu_seconds();
  const std::size_t count = work();
  tell(name, 1e9 * (cpu_seconds() - start) / static_cast<double>(std::max<std::size_t>(times, 1)),
       count);
}

/// An edit list on kernels of their own, so that each begins with the mesh as it was: the least of several,
/// for lists are short.
template <class Kernel, class Work>
void time_edits(const char* name, const Arrays& arrays, std::size_t edits, const Work& work,
                bool has_property = false) {
  constexpr int kRounds = 5;
  double least = 0;
  std::size_t made = 0;
  for (int round = 0; round < kRounds; ++round) {
    Kernel kernel(arrays);
    if constexpr (requires { kernel.add_property(); }) {
      if (has_property) kernel.add_property();
    }
    const double start = cpu_seconds();
    made = work(kernel);
    const double seconds = cpu_seconds() - start;
    least = round == 0 ? seconds : std::min(least, seconds);
  }
  tell(name, 1e9 * least / static_cast<double>(std::max<std::size_t>(edits, 1)), made);
}

template <class Kernel>
void measure(const Arrays& arrays, const Edits& edits) {
  const std::size_t tets = arrays.tets.size();
  const std::size_t before = held();
  const double start = cpu_seconds();
  Kernel kernel(arrays);
  tell("build", 1e9 * (cpu_seconds() - start) / static_cast<double>(tets), tets);
  tell("bytes", static_cast<double>(held() - before) / static_cast<double>(tets), tets);
  double volume = 0;
  time("volume", tets, [&] { return volume = kernel.volume(), tets; });
  std::fprintf(stderr, "volume %.12g\n", volume);
  time("neighbours", tets, [&] { return kernel.neighbours(); });
  time("star", arrays.points.size(), [&] { return kernel.stars(); });
  time("one_ring", arrays.points.size(), [&] { return kernel.one_rings(); });
  const std::size_t edges = kernel.edges();
  time("edges", edges, [&] { return kernel.edges(); });
  time("ring", edges, [&] { return kernel.rings(); });
  time_edits<Kernel>("flip", arrays, edits.flips.size(),
                     [&](Kernel& k) { return k.flip(edits.flips); });
  if constexpr (requires { kernel.flip_and_undo(edits.flips); }) {
    time_edits<Kernel>("flip_undone", arrays, edits.flips.size(),
                       [&](Kernel& k) { return k.flip_and_undo(edits.flips); });
  }
  if constexpr (requires { kernel.add_property(); }) {
    time_edits<Kernel>(
        "flip_property", arrays, edits.flips.size(), [&](Kernel& k) { return k.flip(edits.flips); },
        true);
  }
  if constexpr (requires { kernel.contract(edits.contractions); }) {
    time_edits<Kernel>("contract", arrays, edits.contractions.size(),
                       [&](Kernel& k) { return k.contract(edits.contractions); });
  }
  if constexpr (requires { kernel.contract_and_undo(edits.contractions); }) {
    time_edits<Kernel>("contract_undone", arrays, edits.contractions.size(),
                       [&](Kernel& k) { return k.contract_and_undo(edits.contractions); });
  }
}

/// PROGRAM MESH EDITS
template <class Kernel>
int run(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s MESH EDITS\n", argv[0]);
    return 2;
  }
  try {
    measure<Kernel>(read_arrays(argv[1]), read_edits(argv[2]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace tetmend::bench
