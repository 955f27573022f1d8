// SPDX-License-Identifier: MIT
// The standard of a run, in a trace and in words.
#pragma once

#include <string>

#include "kernel/quality.h"
#include "trace/byte_stream.h"

namespace tetmend {

void put_standard(ByteWriter& out, const Standard& standard);
/// @throws ByteReader::Damage
Standard get_standard(ByteReader& in);

/// "30 to 150 degrees, by sine_and_length, price 0.1": the goal, the measure, and what a new bad tet
/// costs.
std::string describe(const Standard& standard);

}  // namespace tetmend
