// SPDX-License-Identifier: MIT
// The arrays of a legacy VTK file: numbers of a named type, as text or as big-endian bytes.
#include "kernel/formats/vtk_array.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <string>
#include <type_traits>

#include <fmt/format.h>

#include "kernel/formats/byte_reader.h"
#include "kernel/from_chars.h"

namespace tetmend::formats {
namespace {

using VtkKind = VtkType::Kind;

// Sizes are those of VTK on 64-bit Linux; its writer stores vtkIdType as int.
constexpr std::array<VtkType, 25> kVtkTypes = {{{"bit", VtkKind::bit, 0},
                                                {"char", VtkKind::signed_integer, 1},
                                                {"signed_char", VtkKind::signed_integer, 1},
                                                {"unsigned_char", VtkKind::unsigned_integer, 1},
                                                {"short", VtkKind::signed_integer, 2},
                                                {"unsigned_short", VtkKind::unsigned_integer, 2},
                                                {"int", VtkKind::signed_integer, 4},
                                                {"unsigned_int", VtkKind::unsigned_integer, 4},
                                                {"vtkidtype", VtkKind::signed_integer, 4},
                                                {"long", VtkKind::signed_integer, 8},
                                                {"unsigned_long", VtkKind::unsigned_integer, 8},
                                                {"float", VtkKind::real, 4},
                                                {"double", VtkKind::real, 8},
                                                {"vtktypeint8", VtkKind::signed_integer, 1},
                                                {"vtktypeuint8", VtkKind::unsigned_integer, 1},
                                                {"vtktypeint16", VtkKind::signed_integer, 2},
                                                {"vtktypeuint16", VtkKind::unsigned_integer, 2},
                                                {"vtktypeint32", VtkKind::signed_integer, 4},
                                                {"vtktypeuint32", VtkKind::unsigned_integer, 4},
                                                {"vtktypeint64", VtkKind::signed_integer, 8},
                                                {"vtktypeuint64", VtkKind::unsigned_integer, 8},
                                                {"vtktypefloat32", VtkKind::real, 4},
                                                {"vtktypefloat64", VtkKind::real, 8},
                                                {"string", VtkKind::text, 0},
                                                {"utf8_string", VtkKind::text, 0}}};

/// VTK puts the length before each binary string; the two highest bits of its first byte tell how
/// many bytes it takes.
void skip_binary_string(TextReader& text) {
  const char* at = text.bytes(1, "the length of a string");
  const auto first = static_cast<unsigned char>(*at);
  const std::size_t more = std::array<std::size_t, 4>{7, 3, 1, 0}[first >> 6];
  std::uint64_t length = first & 0x3f;
  const char* rest = text.bytes(more, "the length of a string");
  for (std::size_t i = 0; i < more; ++i) {
    length = length << 8 | static_cast<unsigned char>(rest[i]);
  }
  text.bytes(length, "the characters of a string");
}

template <class Value>
std::vector<Value> load_values(const char* at, const VtkType& type, std::size_t count) {
  std::vector<Value> values(count);
  for (Value& value : values) {
    if constexpr (std::is_integral_v<Value>) {
      value = static_cast<Value>(
          load_integer(at, type.size, type.kind == VtkKind::signed_integer, kVtkSwaps));
    } else {
      value = load<Value>(at, kVtkSwaps);
    }
    at += type.size;
  }
  return values;
}

/// "nan" and "inf" are numbers here.
double parse_real(TextReader& text) {
  constexpr std::string_view kWhat = "a value of an array";
  const char* before = text.position();
  const std::string_view word = text.expect_word(kWhat);
  double value = 0;
  const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc{} && end == word.data() + word.size()) return value;
  text.seek(before);
  return text.real(kWhat);
}

template <class Value>
std::vector<Value> parse_values(TextReader& text, std::size_t count) {
  std::vector<Value> values(count);
  for (Value& value : values) {
    if constexpr (std::is_integral_v<Value>) {
      using Limits = std::numeric_limits<Value>;
      value = static_cast<Value>(text.integer("a value of an array", Limits::min(), Limits::max()));
    } else {
      value = static_cast<Value>(parse_real(text));
    }
  }
  return values;
}

}  // namespace

const VtkType& find_vtk_type(TextReader& text, std::string_view word) {
  std::string lower(word.substr(0, 20));
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const VtkType& type : kVtkTypes) {
    if (type.name == lower) return type;
  }
  text.fail(
      fmt::format("{} is not a data type that can be read: expected float, double, int or another "
                  "numeric type of VTK",
                  in_quotes(word)));
}

void skip_vtk_values(TextReader& text, bool binary, const VtkType& type, std::size_t count) {
  if (!binary) {
    for (std::size_t i = 0; i < count; ++i) {
      if (type.kind == VtkKind::text) {
        if (text.at_end()) text.fail("the file ends where a string is expected");
        text.skip_line();
      } else {
        text.expect_word("a value of an array");
      }
    }
  } else if (type.kind == VtkKind::text) {
    for (std::size_t i = 0; i < count; ++i) skip_binary_string(text);
  } else {
    text.bytes(type.kind == VtkKind::bit ? (count + 7) / 8 : count * type.size,
               "the values of an array");
  }
}

DataArray::Values read_vtk_values(TextReader& text, bool binary, const VtkType& type,
                                  std::size_t count) {
  const char* at = binary ? text.bytes(count * type.size, "the values of an array") : nullptr;
  const bool is_real = type.kind == VtkKind::real;
  if (is_real && type.size == 4) {
    if (binary) return load_values<float>(at, type, count);
    return parse_values<float>(text, count);
  }
  if (is_real) {
    if (binary) return load_values<double>(at, type, count);
    return parse_values<double>(text, count);
  }
  const bool fits = type.size < 4 || (type.size == 4 && type.kind == VtkKind::signed_integer);
  if (fits && binary) return load_values<std::int32_t>(at, type, count);
  // The text of an int may be out of its range.
  std::vector<std::int64_t> values =
      binary ? load_values<std::int64_t>(at, type, count) : parse_values<std::int64_t>(text, count);
  const bool narrow = fits && std::all_of(values.begin(), values.end(), [](std::int64_t value) {
                        return value >= INT32_MIN && value <= INT32_MAX;
                      });
  if (!narrow) return values;
  return std::vector<std::int32_t>(values.begin(), values.end());
}

std::size_t checked_vtk_count(TextReader& text, bool binary, const VtkType& type, std::size_t rows,
                              std::size_t columns) {
  if (rows == 0 || columns == 0) return 0;
  std::size_t most = type.kind == VtkKind::text ? text.bytes_left() : (text.bytes_left() + 1) / 2;
  if (binary) {
    most = text.bytes_left();
    most = type.kind == VtkKind::bit ? 8 * most : most / std::max<std::size_t>(type.size, 1);
  }
  if (rows > most || columns > most / rows) {
    text.fail(fmt::format(
        "{} times {} values cannot fit into the {} bytes that are left: the count is wrong "
        "or the file is truncated",
        rows, columns, text.bytes_left()));
  }
  return rows * columns;
}

VtkIntegers::VtkIntegers(TextReader& text, bool binary, const VtkType& type, std::size_t count,
                         std::string_view what)
    : size_(count), type_(&type) {
  if (type.kind != VtkKind::signed_integer && type.kind != VtkKind::unsigned_integer) {
    text.fail(fmt::format("{} cannot be of type {}: expected an integer type", what, type.name));
  }
  checked_vtk_count(text, binary, type, count, 1);
  if (binary) {
    width_ = type.size;
    is_signed_ = type.kind == VtkKind::signed_integer;
    begin_ = text.bytes(count * width_, what);
    return;
  }
  begin_ = text.position();
  parsed_.reserve(count);
  while (parsed_.size() + parsed_wide_.size() < count) {
    const std::int64_t value = text.integer(what, INT64_MIN, INT64_MAX);
    const bool fits = parsed_wide_.empty() && value >= INT32_MIN && value <= INT32_MAX;
    fits ? parsed_.push_back(static_cast<std::int32_t>(value)) : parsed_wide_.push_back(value);
  }
}

std::int64_t VtkIntegers::load_other(const char* from) const {
  return load_integer(from, width_, is_signed_, kVtkSwaps);
}

const char* VtkIntegers::locate(TextReader& text, std::size_t i) const {
  if (type_ == nullptr) return begin_;
  return locate_vtk_value(text, width_ != 0, *type_, begin_, i);
}

const char* locate_vtk_value(TextReader& text, bool binary, const VtkType& type, const char* begin,
                             std::size_t i) {
  if (binary) return begin + i * type.size;
  text.seek(begin);
  for (std::size_t k = 0; k <= i; ++k) text.word();
  return text.last_word();
}

double load_vtk_real(const VtkType& type, const char* from) {
  if (type.kind == VtkKind::real) {
    return type.size == 4 ? load<float>(from, kVtkSwaps) : load<double>(from, kVtkSwaps);
  }
  return static_cast<double>(
      load_integer(from, type.size, type.kind == VtkKind::signed_integer, kVtkSwaps));
}

}  // namespace tetmend::formats
