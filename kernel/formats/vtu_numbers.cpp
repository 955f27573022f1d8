// SPDX-License-Identifier: MIT
#include "kernel/formats/vtu_numbers.h"

#include <algorithm>
#include <type_traits>
#include <vector>

#include "kernel/formats/byte_reader.h"

namespace tetmend::formats {

namespace {

using Kind = VtuType::Kind;

constexpr std::array<VtuType, 10> kVtuTypes = {{{"Int8", 1, Kind::signed_integer},
                                                {"UInt8", 1, Kind::unsigned_integer},
                                                {"Int16", 2, Kind::signed_integer},
                                                {"UInt16", 2, Kind::unsigned_integer},
                                                {"Int32", 4, Kind::signed_integer},
                                                {"UInt32", 4, Kind::unsigned_integer},
                                                {"Int64", 8, Kind::signed_integer},
                                                {"UInt64", 8, Kind::unsigned_integer},
                                                {"Float32", 4, Kind::real},
                                                {"Float64", 8, Kind::real}}};

/// Above 2^63 it becomes negative, which is refused where a number of that size makes no sense.
std::int64_t load_integer(const VtuType& type, const char* at, bool swap) {
  const bool is_signed = type.kind == Kind::signed_integer;
  switch (type.size) {
    case 1:
      return is_signed ? load<std::int8_t>(at, false) : load<std::uint8_t>(at, false);
    case 2:
      return is_signed ? load<std::int16_t>(at, swap) : load<std::uint16_t>(at, swap);
    case 4:
      return is_signed ? load<std::int32_t>(at, swap) : std::int64_t{load<std::uint32_t>(at, swap)};
    default:
      return load<std::int64_t>(at, swap);
  }
}

}  // namespace

const VtuType* find_vtu_type(std::string_view name) {
  const auto* found = std::find_if(kVtuTypes.begin(), kVtuTypes.end(),
                                   [&](const VtuType& type) { return type.name == name; });
  return found == kVtuTypes.end() ? nullptr : found;
}

DataArray::Values decode_vtu(std::string_view bytes, const VtuType& type, std::size_t size,
                             bool swap) {
  const auto load_all = [&]<class Value>(std::vector<Value> values) {
    const char* at = bytes.data();
    for (Value& value : values) {
      if constexpr (std::is_integral_v<Value>) {
        value = static_cast<Value>(load_integer(type, at, swap));
      } else {
        value = load<Value>(at, swap);
      }
      at += type.size;
    }
    return values;
  };
  if (type.kind == Kind::real && type.size == 4) return load_all(std::vector<float>(size));
  if (type.kind == Kind::real) return load_all(std::vector<double>(size));
  if (type.is_narrow()) return load_all(std::vector<std::int32_t>(size));
  return load_all(std::vector<std::int64_t>(size));
}

}  // namespace tetmend::formats
