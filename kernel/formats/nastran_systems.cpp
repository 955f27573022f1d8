// SPDX-License-Identifier: MIT
// The coordinate systems of Nastran's bulk data.
#include "kernel/formats/nastran_systems.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace tetmend::formats {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// {sine, cosine} of an angle in degrees; exact at multiples of 90.
std::pair<double, double> sine_and_cosine(double degrees) {
  const double turns = std::fmod(degrees, 360.0);
  const double quarter = std::round(turns / 90);
  const double rest = (turns - 90 * quarter) * kDegree;
  const double s = std::sin(rest);
  const double c = std::cos(rest);
  switch ((static_cast<int>(quarter) + 8) % 4) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

std::int64_t integer_at(const NastranCardText& card, std::size_t field, std::string_view what,
                        std::int64_t low) {
  std::int64_t value = 0;
  const std::string_view text = card.field(field);
  if (!nastran_integer(text, value) || value < low) {
    throw NastranSystems::Failure{
        card.text.data(), fmt::format("{} is not {}: expected {} in field {}", in_quotes(text),
                                      what, what, field % 8 + 2)};
  }
  return value;
}

}  // namespace

Point NastranSystem::to_basic(const Point& coordinates) const {
  Point local = coordinates;
  if (kind == 'C') {
    const auto [s, c] = sine_and_cosine(coordinates[1]);
    local = {coordinates[0] * c, coordinates[0] * s, coordinates[2]};
  } else if (kind == 'S') {
    const auto [s, c] = sine_and_cosine(coordinates[1]);
    const auto [s_around, c_around] = sine_and_cosine(coordinates[2]);
    local = coordinates[0] * Point(s * c_around, s * s_around, c);
  }
  return origin + local[0] * axes[0] + local[1] * axes[1] + local[2] * axes[2];
}

Point NastranSystem::from_basic(const Point& point) const {
  const Point from_origin = point - origin;
  const Point local(from_origin.dot(axes[0]), from_origin.dot(axes[1]), from_origin.dot(axes[2]));
  if (kind == 'R') return local;
  const double around = std::atan2(local[1], local[0]) / kDegree;
  const double distance = std::hypot(local[0], local[1]);
  if (kind == 'C') return {distance, around, local[2]};
  return {local.norm(), std::atan2(distance, local[2]) / kDegree, around};
}

bool NastranSystems::add(const NastranCardText& card) {
  const std::string& name = card.name;
  if (name.size() != 6 || !name.starts_with("CORD")) return false;
  if (name[5] != 'R' && name[5] != 'C' && name[5] != 'S') return false;
  if (name[4] == '1') {
    add_by_points(card, 0);
    if (!card.field(4).empty()) add_by_points(card, 4);
    return true;
  }
  if (name[4] != '2') return false;
  add_by_places(card);
  return true;
}

void NastranSystems::add_by_points(const NastranCardText& card, std::size_t first) {
  Definition made;
  made.kind = card.name[5];
  made.is_by_points = true;
  made.card = card.text.data();
  const std::int64_t number = integer_at(card, first, "the number of a system", 1);
  for (std::size_t i = 0; i < 3; ++i) {
    made.points[i] = integer_at(card, first + 1 + i, "the number of a point", 1);
  }
  insert(number, made);
}

void NastranSystems::add_by_places(const NastranCardText& card) {
  Definition made;
  made.kind = card.name[5];
  made.card = card.text.data();
  const std::int64_t number = integer_at(card, 0, "the number of a system", 1);
  if (!card.field(1).empty()) made.reference = integer_at(card, 1, "the number of a system", 0);
  for (std::size_t i = 0; i < 9; ++i) {
    const std::string_view text = card.field(2 + i);
    double& value = made.places[i / 3][static_cast<int>(i % 3)];
    value = 0;
    if (text.empty() || nastran_real(text, value)) continue;
    throw Failure{made.card,
                  fmt::format("{} is not a finite number: expected a coordinate", in_quotes(text))};
  }
  insert(number, made);
}

/// That a number comes twice matters only where a point needs it.
void NastranSystems::insert(std::int64_t number, const Definition& definition) {
  const auto [at, is_new] = definitions_.try_emplace(number, definition);
  if (is_new) return;
  at->second.is_twice = true;
  at->second.card = definition.card;
}

const NastranSystem& NastranSystems::find(std::int64_t number, const PointOf& point_of) {
  if (number == 0) return basic_;
  const auto found = definitions_.find(number);
  if (found == definitions_.end()) {
    throw Failure{nullptr, fmt::format("'{}' is not the number of a coordinate system: expected "
                                       "one of CORD1R, CORD1C, CORD1S, CORD2R, CORD2C or CORD2S",
                                       number)};
  }
  Definition& definition = found->second;
  if (definition.is_twice) {
    throw Failure{definition.card,
                  fmt::format("the coordinate system '{}' is defined for the second time", number)};
  }
  if (definition.state == Definition::State::open) resolve(number, definition, point_of);
  if (definition.state == Definition::State::in_work) {
    throw Failure{definition.card,
                  fmt::format("the coordinate system '{}' rests on itself", number)};
  }
  return definition.system;
}

void NastranSystems::resolve(std::int64_t number, Definition& definition, const PointOf& point_of) {
  constexpr int kDeepest = 1000;
  if (++depth_ > kDeepest) {
    throw Failure{definition.card, "more than 1,000 coordinate systems rest on each other"};
  }
  definition.state = Definition::State::in_work;
  std::array<Point, 3> places = definition.places;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!definition.is_by_points) {
      places[i] = find(definition.reference, point_of).to_basic(places[i]);
      continue;
    }
    const Point* point = point_of(definition.points[i]);
    if (point == nullptr) {
      throw Failure{definition.card, fmt::format("'{}' is not the number of a point: expected one "
                                                 "of GRID",
                                                 definition.points[i])};
    }
    places[i] = *point;
  }
  const Point z = places[1] - places[0];
  const Point y = z.cross(places[2] - places[0]);
  const Point x = y.cross(z);
  for (const Point& axis : {x, y, z}) {
    if (axis.norm() > 0 && std::isfinite(axis.norm())) continue;
    throw Failure{
        definition.card,
        fmt::format("the three points of the coordinate system '{}' lie on a line", number)};
  }
  definition.system = {
      definition.kind, places[0], {x.normalized(), y.normalized(), z.normalized()}};
  definition.state = Definition::State::done;
  --depth_;
}

}  // namespace tetmend::formats
