// SPDX-License-Identifier: MIT
#include "trace/traced_standard.h"

#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"

namespace tetmend {

void put_standard(ByteWriter& out, const Standard& standard) {
  out.put_raw(standard.goal().min_angle);
  out.put_raw(standard.goal().max_angle);
  out.put(static_cast<std::uint64_t>(standard.terms()));
  out.put_raw(standard.price());
  if (const OwnMeasure* own = standard.own()) {
    out.put_text(own->name);
    out.put_raw(own->good);
  }
}

Standard get_standard(ByteReader& in) {
  Goal goal;
  goal.min_angle = in.get_raw<double>();
  goal.max_angle = in.get_raw<double>();
  const std::uint64_t terms = in.get();
  const auto price = in.get_raw<double>();
  if (!is_sound(goal) || terms > static_cast<std::uint64_t>(Standard::Terms::own) ||
      !(price >= 0)) {
    throw ByteReader::Damage("its goal or standard is none");
  }
  if (static_cast<Standard::Terms>(terms) != Standard::Terms::own) {
    return Standard(goal, static_cast<Standard::Terms>(terms), price);
  }
  OwnMeasure measure;
  measure.name = in.get_line();
  measure.good = in.get_raw<double>();
  try {
    return Standard::of(std::move(measure), goal, price);
  } catch (const Error& error) {
    throw ByteReader::Damage(error.what());
  }
}

std::string describe(const Standard& standard) {
  return fmt::format("{} to {} degrees, by {}, price {}", standard.goal().min_angle,
                     standard.goal().max_angle, standard.measure_name(), standard.price());
}

}  // namespace tetmend
