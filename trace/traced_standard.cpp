// SPDX-License-Identifier: MIT
#include "trace/traced_standard.h"

#include <fmt/format.h>

namespace tetmend {

void put_standard(ByteWriter& out, const Standard& standard) {
  out.put_raw(standard.goal().min_angle);
  out.put_raw(standard.goal().max_angle);
  out.put(static_cast<std::uint64_t>(standard.terms()));
  out.put_raw(standard.price());
}

Standard get_standard(ByteReader& in) {
  Goal goal;
  goal.min_angle = in.get_raw<double>();
  goal.max_angle = in.get_raw<double>();
  const std::uint64_t terms = in.get();
  const auto price = in.get_raw<double>();
  if (!is_sound(goal) || terms > static_cast<std::uint64_t>(Standard::Terms::sine_and_length) ||
      !(price >= 0)) {
    throw ByteReader::Damage("its goal or standard is none");
  }
  return Standard(goal, static_cast<Standard::Terms>(terms), price);
}

std::string describe(const Standard& standard) {
  return fmt::format("{} to {} degrees, by {}, price {}", standard.goal().min_angle,
                     standard.goal().max_angle, to_string(standard.terms()), standard.price());
}

}  // namespace tetmend
