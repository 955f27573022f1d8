// SPDX-License-Identifier: MIT
// Numbers of a binary file in either byte order; errors carry the file and the byte.
#include "kernel/formats/byte_reader.h"

#include <fmt/format.h>

namespace tetmend::formats {

void ByteReader::fail_at_end(std::string_view what) const {
  fail_at(position_, fmt::format("the file ends where {} is expected", what));
}

}  // namespace tetmend::formats
