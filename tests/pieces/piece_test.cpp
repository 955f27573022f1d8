// SPDX-License-Identifier: MIT
#include "pieces/piece.h"

#include <doctest/doctest.h>

#include "kernel/error.h"

using namespace tetmend;
using namespace tetmend::pieces;

namespace {

Piece small_piece() {
  Piece piece;
  piece.ids = {3, 5, 7, 11, 13};
  for (std::size_t i = 0; i < 5; ++i) piece.points.emplace_back(double(i), 0.5, -0.0);
  piece.labels = {0, 1, 0, 2, 0};
  piece.marks = {kOwn, kRequired, 0, kOwn | kRequired, 0};
  piece.tets = {{{0, 1, 2, 3}, 7, 42}, {{1, 2, 3, 4}, -8, PieceTet::kNone | PieceTet::kProtected}};
  piece.triangles = {{{1, 2, 3}, 9}};
  piece.edges = {{{0, 4}, 10}};
  return piece;
}

bool equal(const Piece& a, const Piece& b) {
  return a.ids == b.ids && a.points == b.points && a.labels == b.labels && a.marks == b.marks &&
         a.tets == b.tets && a.triangles == b.triangles && a.edges == b.edges;
}

}  // namespace

TEST_CASE("a piece comes back from bytes as it went in, and pieces follow each other") {
  std::string bytes;
  append(small_piece(), bytes);
  append(Piece(), bytes);
  append(small_piece(), bytes);
  std::string_view rest = bytes;
  CHECK(equal(take_piece(rest), small_piece()));
  CHECK(equal(take_piece(rest), Piece()));
  CHECK(equal(take_piece(rest), small_piece()));
  CHECK(rest.empty());
}

TEST_CASE("bytes that end too early, or name vertices that are not there, are errors") {
  std::string bytes;
  append(small_piece(), bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    std::string_view part(bytes.data(), size);
    CHECK_THROWS_AS(take_piece(part), Error);
  }
  Piece broken = small_piece();
  broken.tets[1].vertices[2] = 5;
  std::string wrong;
  append(broken, wrong);
  std::string_view rest = wrong;
  CHECK_THROWS_WITH_AS(take_piece(rest), "a piece contradicts itself", Error);
}

TEST_CASE("what is extracted from a piece and merged again is that piece") {
  const Piece whole = small_piece();
  const Piece first = extract(whole, {{1, 1, 1, 1, 0}, {0}, {0}, {}});
  const Piece second = extract(whole, {{1, 1, 1, 1, 1}, {1}, {}, {0}});
  CHECK(first.ids == std::vector<VertexId>{3, 5, 7, 11});
  Piece merged = merge({first, second});
  CHECK(merged.marks == std::vector<std::uint8_t>{0, kRequired, 0, kRequired, 0});
  merged.marks = whole.marks;  // whose it is depends on the division
  CHECK(equal(merged, whole));
}

TEST_CASE("parts that have a vertex at two places do not fit") {
  Piece moved = small_piece();
  moved.points[2].x() += 1e-15;
  CHECK_THROWS_WITH_AS(merge({small_piece(), moved}),
                       "pieces do not fit: vertex 7 lies at two places", Error);
  moved = small_piece();
  moved.points[2].z() = 0.0;  // it was -0.0
  CHECK_THROWS_AS(merge({small_piece(), moved}), Error);
}
