// SPDX-License-Identifier: MIT
// Cards of Nastran in each of the three forms, and numbers in the room that they have.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "kernel/formats/output_file.h"

namespace tetmend::formats {

/// How a deck may be asked for: points and elements in short fields, points in long ones, both free.
/// What has no room in fields of 8 has those of 16, and what has none there is free: no digit is
/// lost. In the last, points have long fields whatever that costs.
inline constexpr std::string_view kNastranShort = "short";
inline constexpr std::string_view kNastranLong = "long";
inline constexpr std::string_view kNastranFree = "free";
inline constexpr std::string_view kNastranRounded = "rounded";
inline constexpr std::array kNastranForms = {kNastranShort, kNastranLong, kNastranFree,
                                             kNastranRounded};

/// Characters of a short field; kNastranRoom are those of a long one.
inline constexpr std::size_t kNastranShortRoom = 8;

/// The shortest digits from which the same number is read, with a point.
std::string nastran_digits(double value);
/// The same number as ".125" or "1.25-1", as short as possible; empty if it needs more room.
std::string nastran_short_form(double value, std::size_t room);
/// One of these two; empty if neither has room.
std::string nastran_real_field(double value, std::size_t room);
/// The nearest number that has room in a long field. Solvers read no more characters.
std::string nastran_rounded(double value);

/// @param form  one of kNastranForms
void put_nastran_card(OutputBuffer& buffer, std::string_view name,
                      std::span<const std::string> fields, std::string_view form);

}  // namespace tetmend::formats
