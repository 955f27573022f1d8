// SPDX-License-Identifier: MIT
// A shape is unpacked here as a page unpacks it.
#include "report/shape.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/formats/base64.h"
#include "kernel/formats/compression.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::report;

namespace {

struct Unpacked {
  std::vector<Point> places;  ///< in lengths of the mesh
  std::vector<std::array<std::int64_t, 3>> triangles;
  std::vector<std::array<std::int64_t, 1>> labels;  ///< of triangles: places in about.labels
  std::vector<std::array<std::int64_t, 3>> walls;
  std::vector<std::array<std::int64_t, 2>> wall_labels;
  std::vector<std::array<std::int64_t, 2>> edges;
  std::vector<std::array<std::int64_t, 4>> before, after;
};

class Reader {
 public:
  explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}
  std::int64_t next() {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes_.at(at_++));
      value |= static_cast<std::uint64_t>(byte & 127u) << shift;
      if (byte < 128) break;
    }
    const auto half = static_cast<std::int64_t>(value >> 1);
    return (value & 1) != 0 ? -half - 1 : half;
  }
  template <std::size_t N>
  void rows(std::size_t count, std::vector<std::array<std::int64_t, N>>& rows) {
    rows.resize(count);
    for (std::size_t column = 0; column < N; ++column) {
      std::int64_t last = 0;
      for (auto& row : rows) {
        if (column > 0) last = row[column - 1];
        row[column] = last += next();
      }
    }
  }
  bool is_at_end() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

std::size_t count_in(const Shape& shape, const char* name) {
  return shape.about.at(name).get<std::size_t>();
}

Unpacked unpack(const Shape& shape) {
  std::string packed;
  std::string_view text = shape.data;
  formats::decode_base64(text, shape.data.size(), packed);
  std::string bytes(count_in(shape, "bytes"), '\0');
  REQUIRE(formats::inflate_block(packed, bytes.data(), bytes.size()));
  Unpacked made;
  Reader reader(bytes);
  made.places.resize(count_in(shape, "vertices"));
  const auto origin = shape.about.at("origin").get<std::array<double, 3>>();
  const double step = shape.about.at("step").get<double>();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::int64_t last = 0;
    for (Point& place : made.places) {
      last += reader.next();
      place[axis] = origin[static_cast<std::size_t>(axis)] + step * static_cast<double>(last);
    }
  }
  reader.rows(count_in(shape, "triangles"), made.triangles);
  if (shape.about.at("labels").size() > 1) {
    reader.rows(count_in(shape, "triangles"), made.labels);
  }
  reader.rows(count_in(shape, "walls"), made.walls);
  reader.rows(count_in(shape, "walls"), made.wall_labels);
  reader.rows(count_in(shape, "edges"), made.edges);
  reader.rows(count_in(shape, "bad_before"), made.before);
  reader.rows(count_in(shape, "bad_after"), made.after);
  CHECK(reader.is_at_end());
  return made;
}

face::Portrait portrait_of(const MeshData& data) {
  const TetMesh mesh = test::make_mesh(data);
  face::Portrait portrait;
  portrait.draw_before(mesh, std::nullopt);
  portrait.draw_after(mesh, {}, std::nullopt);
  return portrait;
}

}  // namespace

TEST_CASE("what a page unpacks is the surface and the bad tets, to a 65,535th of their extent") {
  const face::Portrait portrait = portrait_of(contract::kuhn_cube(6, 0.45, 4));
  REQUIRE(portrait.bad_before.size() > 10);
  const Shape shape = pack_shape(portrait);
  const Unpacked made = unpack(shape);
  const double most = shape.about.at("step").get<double>() * 1.01;
  CHECK(most < 1.0 / 64000);
  REQUIRE(made.triangles.size() == portrait.triangles.size());
  // Each triangle is there once, in the same sense.
  const auto name = [](const std::array<Point, 3>& corners) {
    std::array<std::array<long, 3>, 3> rounded;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        rounded[i][axis] = std::lround(1000 * corners[i][static_cast<Eigen::Index>(axis)]);
      }
    }
    std::rotate(rounded.begin(), std::min_element(rounded.begin(), rounded.end()), rounded.end());
    return rounded;
  };
  std::multiset<std::array<std::array<long, 3>, 3>> there, shown;
  for (const auto& [a, b, c] : portrait.triangles) {
    there.insert(name({portrait.points[a], portrait.points[b], portrait.points[c]}));
  }
  for (const auto& triangle : made.triangles) {
    std::array<Point, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = made.places.at(static_cast<std::size_t>(triangle[i]));
    }
    shown.insert(name(corners));
  }
  CHECK(shown == there);
  REQUIRE(made.before.size() == portrait.bad_before.size());
  // The tets are the same: their centres, in any order.
  std::vector<double> sums, shown_sums;
  for (const face::DrawnTet& tet : portrait.bad_before) {
    double sum = 0;
    for (const Point& p : tet.corners) sum += p.sum();
    sums.push_back(sum);
  }
  for (const auto& tet : made.before) {
    double sum = 0;
    for (const std::int64_t v : tet) sum += made.places.at(static_cast<std::size_t>(v)).sum();
    shown_sums.push_back(sum);
  }
  std::sort(sums.begin(), sums.end());
  std::sort(shown_sums.begin(), shown_sums.end());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    CHECK(shown_sums[i] == doctest::Approx(sums[i]).epsilon(12 * most));
  }
}

TEST_CASE("each triangle has the label of the tet behind it; one label alone takes no room") {
  MeshData data = contract::kuhn_cube(4, 0, 1);
  for (auto& tet : data.tets) tet.label = 7;
  CHECK(pack_shape(portrait_of(data)).about.at("labels").size() == 1);
  // The lower half is another region.
  for (auto& tet : data.tets) {
    double height = 0;
    for (const auto v : tet.vertices) height += data.points[v].z() / 4;
    if (height < 0.5) tet.label = -3;
  }
  const Shape shape = pack_shape(portrait_of(data));
  REQUIRE(shape.about.at("labels").size() == 2);
  CHECK(shape.about.at("labels")[0].at("label") == -3);
  CHECK(shape.about.at("labels")[1].at("label") == 7);
  CHECK(shape.about.at("labels")[0].at("colour") != shape.about.at("labels")[1].at("colour"));
  const Unpacked made = unpack(shape);
  REQUIRE(made.labels.size() == made.triangles.size());
  for (std::size_t i = 0; i < made.triangles.size(); ++i) {
    double height = 0;
    for (const auto v : made.triangles[i])
      height += made.places.at(static_cast<std::size_t>(v)).z() / 3;
    CHECK(made.labels[i][0] == (height < 0.5 ? 0 : 1));
  }
  // Between them lies a wall of 4 x 4 squares, which is seen from the region in front.
  REQUIRE(made.walls.size() == 32);
  for (std::size_t i = 0; i < made.walls.size(); ++i) {
    std::array<Point, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = made.places.at(static_cast<std::size_t>(made.walls[i][k]));
    const double up = (p[1] - p[0]).cross(p[2] - p[0]).z();
    CHECK(p[0].z() == doctest::Approx(0.5).epsilon(1e-4));
    const std::array<std::int64_t, 2> expected = {up > 0 ? 0 : 1, up > 0 ? 1 : 0};
    CHECK(made.wall_labels[i] == expected);
  }
}

TEST_CASE("the sharp edges of a cube are its twelve sides") {
  constexpr unsigned kCells = 5;
  const Unpacked made = unpack(pack_shape(portrait_of(contract::kuhn_cube(kCells, 0, 1))));
  CHECK(made.edges.size() == 12 * kCells);
  for (const auto& edge : made.edges) {
    int at_border = 0;
    const Point middle = (made.places.at(static_cast<std::size_t>(edge[0])) +
                          made.places.at(static_cast<std::size_t>(edge[1]))) /
                         2;
    for (const double x : middle) at_border += x < 1e-4 || x > 1 - 1e-4;
    CHECK(at_border >= 2);
  }
}

TEST_CASE("of a surface that is too large the sharp edges are left, and that is said") {
  const face::Portrait portrait = portrait_of(contract::kuhn_cube(6, 0.45, 4));
  const Shape shape = pack_shape(portrait, {.triangles = portrait.triangles.size() - 1});
  CHECK(count_in(shape, "triangles") == 0);
  CHECK(count_in(shape, "all_triangles") == portrait.triangles.size());
  CHECK(count_in(shape, "edges") == 12 * 6);
  CHECK(count_in(shape, "bad_before") == portrait.bad_before.size());
  const Shape whole = pack_shape(portrait, {.triangles = portrait.triangles.size()});
  CHECK(count_in(whole, "triangles") == portrait.triangles.size());
  CHECK(whole.about.at("step") == shape.about.at("step"));
  CHECK(whole.about.at("worst") == shape.about.at("worst"));
}

TEST_CASE("a shape keeps to its size: the worst tets stay") {
  const face::Portrait portrait = portrait_of(contract::kuhn_cube(14, 0.48, 4));
  REQUIRE(portrait.bad_before.size() > 2000);
  const std::size_t whole = pack_shape(portrait).data.size();
  const ShapeLimits limits{.tets = 4000, .bytes = whole / 2};
  const Shape shape = pack_shape(portrait, limits);
  CHECK(shape.data.size() <= limits.bytes);
  CHECK(count_in(shape, "bad_before") < portrait.bad_before.size());
  CHECK(count_in(shape, "all_bad_before") == portrait.bad_before.size());
  unpack(shape);
}

TEST_CASE("the worst tets have a ball around them") {
  const face::Portrait portrait = portrait_of(contract::kuhn_cube(6, 0.45, 4));
  const Shape shape = pack_shape(portrait);
  const auto balls = shape.about.at("worst").get<std::vector<std::array<double, 4>>>();
  REQUIRE(balls.size() == kMostWorst);
  const double step = shape.about.at("step").get<double>();
  const auto origin = shape.about.at("origin").get<std::array<double, 3>>();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Point centre(origin[0] + step * balls[i][0], origin[1] + step * balls[i][1],
                       origin[2] + step * balls[i][2]);
    for (const Point& corner : portrait.bad_after[i].corners) {
      CHECK((corner - centre).norm() <= step * balls[i][3] * (1 + 1e-9));
    }
  }
}

TEST_CASE("a mesh of extreme size, of one tet or of none can be packed") {
  for (const double size : {1e-150, 1.0, 1e150}) {
    MeshData data = contract::two_tets();
    for (Point& p : data.points) p *= size;
    const Unpacked made = unpack(pack_shape(portrait_of(data)));
    CHECK(made.triangles.size() == 6);
  }
  CHECK(unpack(pack_shape(face::Portrait())).triangles.empty());
}
