// SPDX-License-Identifier: MIT
// The coordinate systems of Nastran's bulk data: CORD1R, CORD2C and their like.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "kernel/formats/nastran_card.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Rectangular: x, y, z. Cylindrical: radius, angle, z. Spherical: radius, angle from the z axis, angle
/// around it. Angles are in degrees.
struct NastranSystem {
  char kind = 'R';  ///< 'R', 'C' or 'S'
  Point origin = Point::Zero();
  std::array<Point, 3> axes = {Point::UnitX(), Point::UnitY(), Point::UnitZ()};

  /// From coordinates of this system to those of the basic one.
  Point to_basic(const Point& coordinates) const;
  Point from_basic(const Point& point) const;
};

class NastranSystems {
 public:
  /// Where a point is in the basic system; null: there is none with this number.
  using PointOf = std::function<const Point*(std::int64_t number)>;

  /// What is wrong with a system.
  struct Failure {
    const char* place;  ///< of its card; null: it has none
    std::string reason;
  };

  /// Takes what a card defines. False if it is none of these. @throws Failure
  bool add(const NastranCardText& card);
  bool is_empty() const { return definitions_.empty(); }

  /// 0 is the basic system. @throws Failure
  const NastranSystem& find(std::int64_t number, const PointOf& point_of);

 private:
  struct Definition {
    char kind = 'R';
    bool is_by_points = false;
    bool is_twice = false;  ///< another card has the same number
    std::int64_t reference = 0;
    std::array<std::int64_t, 3> points{};
    std::array<Point, 3> places{};  ///< the origin, one on the z axis, one in the xz plane
    const char* card = nullptr;
    enum class State { open, in_work, done } state = State::open;
    NastranSystem system;
  };

  void add_by_points(const NastranCardText& card, std::size_t first);
  void add_by_places(const NastranCardText& card);
  void insert(std::int64_t number, const Definition& definition);
  void resolve(std::int64_t number, Definition& definition, const PointOf& point_of);

  std::map<std::int64_t, Definition> definitions_;
  NastranSystem basic_;
  int depth_ = 0;
};

}  // namespace tetmend::formats
