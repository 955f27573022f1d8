// SPDX-License-Identifier: MIT
#include "report/shape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "figure/colour.h"
#include "kernel/formats/base64.h"
#include "kernel/formats/compression.h"
#include "kernel/hilbert.h"

namespace tetmend::report {

namespace {

using face::DrawnTet;
using face::Portrait;
using Index = std::uint32_t;

/// An edge between faces that meet at an angle.
struct SharpEdge {
  std::array<Index, 2> ends{};
  double cosine = 1;  ///< of the angle between the normals; -1: not two triangles
};

Point normal_of(const Portrait& portrait, std::size_t triangle) {
  const auto& [a, b, c] = portrait.triangles[triangle];
  const Point& p = portrait.points[a];
  return (portrait.points[b] - p).cross(portrait.points[c] - p).normalized();
}

/// The sharpest first.
std::vector<SharpEdge> find_sharp_edges(const Portrait& portrait) {
  const double smooth = std::cos(35 * std::numbers::pi / 180);
  struct Side {
    std::array<Index, 2> ends;
    Index triangle;
  };
  std::vector<Side> sides;
  sides.reserve(3 * portrait.triangles.size());
  for (std::size_t t = 0; t < portrait.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = portrait.triangles[t][i];
      const Index b = portrait.triangles[t][(i + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<Index>(t)});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::pair(a.ends, a.triangle) < std::pair(b.ends, b.triangle);
  });
  std::vector<SharpEdge> edges;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end].ends == sides[i].ends) ++end;
    const double cosine = end - i != 2 ? -1
                                       : normal_of(portrait, sides[i].triangle)
                                             .dot(normal_of(portrait, sides[i + 1].triangle));
    if (cosine < smooth) edges.push_back({sides[i].ends, cosine});
    i = end;
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const SharpEdge& a, const SharpEdge& b) { return a.cosine < b.cosine; });
  return edges;
}

/// What is to be packed. All numbers are those of `points`.
struct Content {
  std::vector<Point> points;
  std::vector<std::array<Index, 3>> triangles;
  std::vector<std::array<Label, 1>> labels;
  std::vector<std::array<Index, 3>> walls;
  std::vector<std::array<Label, 2>> wall_labels;
  std::vector<std::array<Index, 2>> edges;
  std::vector<std::array<Index, 4>> before, after;
};

/// Places on a grid, each once.
class Places {
 public:
  /// @param box points of the whole surface, of which all others lie inside
  Places(const Content& content, std::span<const Point> box) {
    low_ = box.empty() ? Point(Point::Zero()) : box.front();
    Point high = low_;
    for (const Point& p : box) {
      low_ = low_.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double size = (high / 2 - low_ / 2).maxCoeff();  // of half the box: cannot overflow
    step_ = size > 0 && std::isfinite(size) ? size / kHalf : 1;
    if (!(step_ > 0)) step_ = 1;
    put_in_order(content);
  }

  Index number(Index point) const { return number_[point]; }
  const std::vector<std::array<std::int32_t, 3>>& grid() const { return grid_; }
  const Point& low() const { return low_; }
  double step() const { return step_; }
  Point on_grid(const Point& p) const { return (p - low_) / step_; }

 private:
  static constexpr double kHalf = 32767.5;

  void put_in_order(const Content& content) {
    std::vector<Index> order(content.points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
    sort_along_curve(content.points, order);
    number_.resize(order.size());
    std::unordered_map<std::uint64_t, Index> known;
    known.reserve(order.size());
    for (const Index point : order) {
      std::array<std::int32_t, 3> place{};
      std::uint64_t key = 0;
      const Point at = on_grid(content.points[point]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double rounded = std::round(at[static_cast<Eigen::Index>(axis)]);
        place[axis] = static_cast<std::int32_t>(std::clamp(rounded, 0.0, 2 * kHalf));
        key = key << 16 | static_cast<std::uint64_t>(place[axis]);
      }
      const auto [entry, is_new] = known.try_emplace(key, static_cast<Index>(grid_.size()));
      if (is_new) grid_.push_back(place);
      number_[point] = entry->second;
    }
  }

  Point low_;
  double step_ = 1;
  std::vector<std::array<std::int32_t, 3>> grid_;
  std::vector<Index> number_;  // by point
};

class Bytes {
 public:
  /// Small numbers of either sign in one byte.
  void put(std::int64_t value) {
    auto rest = static_cast<std::uint64_t>(value < 0 ? ~(value * 2) : value * 2);
    for (; rest >= 128; rest >>= 7) bytes_ += static_cast<char>(rest | 128);
    bytes_ += static_cast<char>(rest);
  }
  /// Column by column: of the first the difference to the row before, of the others that to the
  /// column before.
  template <std::size_t N>
  void put_rows(const std::vector<std::array<Index, N>>& rows) {
    for (std::size_t column = 0; column < N; ++column) {
      std::int64_t last = 0;
      for (const std::array<Index, N>& row : rows) {
        if (column > 0) last = row[column - 1];
        put(std::int64_t{row[column]} - last);
        last = row[column];
      }
    }
  }
  void put_places(const std::vector<std::array<std::int32_t, 3>>& places) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::int32_t last = 0;
      for (const auto& place : places) {
        put(place[axis] - last);
        last = place[axis];
      }
    }
  }
  const std::string& str() const { return bytes_; }

 private:
  std::string bytes_;
};

/// A triangle seen from outside as before, its smallest number first.
std::array<Index, 3> turned(std::array<Index, 3> row, const Places& places) {
  for (Index& entry : row) entry = places.number(entry);
  std::rotate(row.begin(), std::min_element(row.begin(), row.end()), row.end());
  return row;
}

/// Triangles, and the places of their labels in a list, in the order of the triangles.
template <std::size_t N>
struct Labelled {
  std::vector<std::array<Index, 3>> rows;
  std::vector<std::array<Index, N>> places;
};
template <std::size_t N>
Labelled<N> in_order(const std::vector<std::array<Index, 3>>& triangles,
                     const std::vector<std::array<Label, N>>& labels,
                     const std::vector<Label>& list, const Places& places) {
  std::vector<std::pair<std::array<Index, 3>, std::array<Index, N>>> both;
  both.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    auto& [row, numbers] = both.emplace_back(turned(triangles[i], places), std::array<Index, N>{});
    for (std::size_t k = 0; k < N; ++k) {
      numbers[k] = static_cast<Index>(std::lower_bound(list.begin(), list.end(), labels[i][k]) -
                                      list.begin());
    }
  }
  std::sort(both.begin(), both.end());
  Labelled<N> made;
  for (const auto& [row, numbers] : both) {
    made.rows.push_back(row);
    made.places.push_back(numbers);
  }
  return made;
}

std::vector<Label> labels_of(const Content& content) {
  std::vector<Label> labels;
  for (const auto& label : content.labels) labels.push_back(label[0]);
  for (const auto& pair : content.wall_labels)
    labels.insert(labels.end(), pair.begin(), pair.end());
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

nlohmann::json with_colours(const std::vector<Label>& labels) {
  const auto colours = figure::region_colours();
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const figure::Colour& c = colours[i % colours.size()];
    list.push_back({{"label", labels[i]}, {"colour", {c.red, c.green, c.blue}}});
  }
  return list;
}

/// Rows with the numbers of places, in order. The smallest number of a row comes first.
template <std::size_t N>
std::vector<std::array<Index, N>> in_order(std::vector<std::array<Index, N>> rows,
                                           const Places& places) {
  for (std::array<Index, N>& row : rows) {
    for (Index& entry : row) entry = places.number(entry);
    std::sort(row.begin(), row.end());
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

std::vector<std::array<Index, 4>> add_tets(const std::vector<DrawnTet>& tets, std::size_t most,
                                           std::vector<Point>& points) {
  std::vector<std::array<Index, 4>> rows;
  for (std::size_t i = 0; i < std::min(most, tets.size()); ++i) {
    std::array<Index, 4>& row = rows.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) {
      row[c] = static_cast<Index>(points.size());
      points.push_back(tets[i].corners[c]);
    }
  }
  return rows;
}

Content choose(const Portrait& portrait, const std::vector<SharpEdge>& sharp,
               const ShapeLimits& limits) {
  Content content;
  if (portrait.triangles.size() <= limits.triangles) {
    content.points = portrait.points;
    content.triangles = portrait.triangles;
    for (const Label label : portrait.labels) content.labels.push_back({label});
    if (portrait.triangles.size() + portrait.walls.size() <= limits.triangles) {
      content.walls = portrait.walls;
      content.wall_labels = portrait.wall_labels;
    }
  }
  const std::size_t edges = std::min(limits.edges, sharp.size());
  if (content.points.empty()) {  // those of the edges alone, and so large as the surface is
    for (std::size_t i = 0; i < edges; ++i) {
      const auto first = static_cast<Index>(content.points.size());
      for (const Index end : sharp[i].ends) content.points.push_back(portrait.points[end]);
      content.edges.push_back({first, first + 1});
    }
  } else {
    for (std::size_t i = 0; i < edges; ++i) content.edges.push_back(sharp[i].ends);
  }
  content.before = add_tets(portrait.bad_before, limits.tets, content.points);
  content.after = add_tets(portrait.bad_after, limits.tets, content.points);
  return content;
}

/// Centre and radius on the grid of each of the worst tets that are left.
nlohmann::json balls_of(const std::vector<DrawnTet>& tets, std::size_t most, const Places& places) {
  nlohmann::json balls = nlohmann::json::array();
  for (std::size_t i = 0; i < std::min(most, tets.size()); ++i) {
    Point centre = Point::Zero();
    for (const Point& corner : tets[i].corners) centre += places.on_grid(corner) / 4;
    double radius = 0;
    for (const Point& corner : tets[i].corners) {
      radius = std::max(radius, (places.on_grid(corner) - centre).norm());
    }
    balls.push_back({centre.x(), centre.y(), centre.z(), radius});
  }
  return balls;
}

Shape pack(const Content& content, const Portrait& portrait) {
  const Places places(content, portrait.points);
  Bytes bytes;
  bytes.put_places(places.grid());
  const std::vector<Label> labels = labels_of(content);
  const Labelled<1> triangles = in_order(content.triangles, content.labels, labels, places);
  bytes.put_rows(triangles.rows);
  if (labels.size() > 1) bytes.put_rows(triangles.places);
  const Labelled<2> walls = in_order(content.walls, content.wall_labels, labels, places);
  bytes.put_rows(walls.rows);
  bytes.put_rows(walls.places);
  bytes.put_rows(in_order(content.edges, places));
  bytes.put_rows(in_order(content.before, places));
  bytes.put_rows(in_order(content.after, places));
  Shape shape;
  shape.data = formats::encode_base64(formats::deflate_block(bytes.str()));
  shape.about = {{"origin", {places.low().x(), places.low().y(), places.low().z()}},
                 {"step", places.step()},
                 {"bytes", bytes.str().size()},
                 {"vertices", places.grid().size()},
                 {"triangles", content.triangles.size()},
                 {"walls", content.walls.size()},
                 {"labels", with_colours(labels)},
                 {"edges", content.edges.size()},
                 {"bad_before", content.before.size()},
                 {"bad_after", content.after.size()},
                 {"worst", balls_of(portrait.bad_after, kMostWorst, places)}};
  return shape;
}

}  // namespace

Shape pack_shape(const Portrait& portrait, const ShapeLimits& limits) {
  const std::vector<SharpEdge> sharp = find_sharp_edges(portrait);
  ShapeLimits within = limits;
  constexpr std::size_t kFewest = 500;
  Shape shape = pack(choose(portrait, sharp, within), portrait);
  while (shape.data.size() > limits.bytes && (within.tets > kFewest || within.edges > kFewest)) {
    if (within.tets > kFewest) {
      within.tets /= 2;
    } else {
      within.edges /= 2;
      within.triangles = 0;
    }
    shape = pack(choose(portrait, sharp, within), portrait);
  }
  shape.about["all_triangles"] = portrait.triangles.size();
  shape.about["all_walls"] = portrait.walls.size();
  shape.about["all_edges"] = sharp.size();
  shape.about["all_bad_before"] = portrait.bad_before.size();
  shape.about["all_bad_after"] = portrait.bad_after.size();
  return shape;
}

}  // namespace tetmend::report
