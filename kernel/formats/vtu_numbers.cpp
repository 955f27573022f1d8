// SPDX-License-Identifier: MIT
#include "kernel/formats/vtu_numbers.h"

#include <algorithm>
#include <type_traits>
#include <vector>

#include "kernel/formats/byte_reader.h"

namespace tetmend::formats {

namespace {

using VtuKind = VtuType::Kind;

constexpr std::array<VtuType, 10> kVtuTypes = {{{"Int8", 1, VtuKind::signed_integer},
                                                {"UInt8", 1, VtuKind::unsigned_integer},
                                                {"Int16", 2, VtuKind::signed_integer},
                                                {"UInt16", 2, VtuKind::unsigned_integer},
                                                {"Int32", 4, VtuKind::signed_integer},
                                                {"UInt32", 4, VtuKind::unsigned_integer},
                                                {"Int64", 8, VtuKind::signed_integer},
                                                {"UInt64", 8, VtuKind::unsigned_integer},
                                                {"Float32", 4, VtuKind::real},
                                                {"Float64", 8, VtuKind::real}}};

}  // namespace

const VtuType* find_vtu_type(std::string_view name) {
  const auto* found = std::find_if(kVtuTypes.begin(), kVtuTypes.end(),
                                   [&](const VtuType& type) { return type.name == name; });
  return found == kVtuTypes.end() ? nullptr : found;
}

DataArray::Values decode_vtu(std::string_view bytes, const VtuType& type, std::size_t size,
                             bool swap) {
  const bool is_signed = type.kind == VtuKind::signed_integer;
  const auto load_all = [&]<class Value>(std::vector<Value> values) {
    const char* at = bytes.data();
    for (Value& value : values) {
      if constexpr (std::is_integral_v<Value>) {
        value = static_cast<Value>(load_integer(at, type.size, is_signed, swap));
      } else {
        value = load<Value>(at, swap);
      }
      at += type.size;
    }
    return values;
  };
  if (type.kind == VtuKind::real && type.size == 4) return load_all(std::vector<float>(size));
  if (type.kind == VtuKind::real) return load_all(std::vector<double>(size));
  if (type.is_narrow()) return load_all(std::vector<std::int32_t>(size));
  return load_all(std::vector<std::int64_t>(size));
}

}  // namespace tetmend::formats
