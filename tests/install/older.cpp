// SPDX-License-Identifier: MIT
// <tetmend/tetmend.hpp>, for programs in C++17: what a program does with it, and what it refuses. Status 0: all of it holds.
#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <tetmend/tetmend.hpp>

using tetmend::cpp17::Error;
using tetmend::cpp17::Mesh;

namespace {

int wrong = 0;

void expect(bool holds, const char* what) {
  if (holds) return;
  ++wrong;
  std::printf("does not hold: %s\n", what);
}

template <class Call>
std::string refused(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

int main() {
  static_assert(
      !std::is_copy_constructible<Mesh>::value && std::is_nothrow_move_constructible<Mesh>::value,
      "a handle has one owner");
  // A file, as the command line does it.
  Mesh mesh = Mesh::load("part.mesh");
  const auto old_count = mesh.count(TETMEND_POINTS);
  mesh.set("schedule", "thorough").set("time-limit", "60");
  int calls = 0;
  mesh.on_progress([&calls](const tetmend_progress&) { return ++calls > 0; });
  const tetmend_result result = mesh.improve();
  expect(result.ending == TETMEND_FINISHED && calls > 0, "a run ends, and tells how far it is");
  const auto figures = mesh.statistics();
  expect(figures.second.n_bad < figures.first.n_bad, "fewer bad tets than before");
  expect(mesh.measure().tets == figures.second.tets, "the mesh is the improved one");
  expect(mesh.vertex_map(old_count).size() == old_count, "each old point has an entry");
  Mesh moved = std::move(mesh);
  moved.save("older.mesh");

  // Arrays: five points, two tets of two labels.
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  const std::array<std::int32_t, 8> tets = {0, 1, 2, 3, 1, 2, 3, 4};
  Mesh two = Mesh::of(points, tets, std::vector<std::int32_t>{3, 7});
  two.set_data(TETMEND_POINTS, "x", std::vector<double>{0, 1, 0, 0, 1});
  two.set_required(std::vector<std::int32_t>{4});
  expect(two.improve().ending == TETMEND_FINISHED, "arrays are improved");
  expect(two.points().size() % 3 == 0 && two.tets().size() % 4 == 0, "arrays come out");
  for (const std::int32_t label : two.labels()) expect(label == 3 || label == 7, "labels stay");
  const std::vector<double> x = two.data(TETMEND_POINTS, "x");
  expect(x.size() == two.count(TETMEND_POINTS) && x[1] == 1, "data come over");

  // Mistakes are exceptions of one line.
  expect(refused([] { Mesh::load("none.mesh"); }).find("none.mesh") == 0, "a file that is missing");
  expect(refused([&] { two.set("schedul", "x"); }).find("schedul") != std::string::npos,
         "an unknown option");
  expect(!refused([&] {
            Mesh::of(points, std::vector<std::int32_t>{0, 1, 2});
          }).empty(),
         "three points of a tet");
  expect(!refused([&] { Mesh::of(points, tets, std::vector<std::int32_t>{1}); }).empty(),
         "too few labels");
  expect(!refused([&] { two.data(TETMEND_POINTS, "y"); }).empty(), "data that are not there");
  expect(!refused([&] {
            two.set_data(TETMEND_POINTS, "z", std::vector<double>{1, 2, 3});
          }).empty(),
         "too few data");

  // What the progress function throws comes out, and the mesh is sound.
  Mesh again = Mesh::load("part.mesh");
  again.on_progress([](const tetmend_progress&) -> bool { throw std::out_of_range("mine"); });
  std::string thrown;
  try {
    again.improve();
  } catch (const std::out_of_range& error) {
    thrown = error.what();
  }
  expect(thrown == "mine", "what the progress function throws comes out");
  again.on_progress(nullptr);
  expect(again.improve().ending == TETMEND_FINISHED, "the mesh goes on without it");
  return wrong == 0 ? 0 : 1;
}
