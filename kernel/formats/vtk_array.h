// SPDX-License-Identifier: MIT
// The arrays of a legacy VTK file: numbers of a named type, as text or as big-endian bytes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/formats/byte_reader.h"
#include "kernel/formats/text_reader.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Binary files are big-endian.
inline constexpr bool kVtkSwaps = std::endian::native == std::endian::little;

/// A data type of the format.
struct VtkType {
  enum class Kind { bit, signed_integer, unsigned_integer, real, text };
  std::string_view name;  // in lower case
  Kind kind;
  std::size_t size;  // bytes of one value in a binary file; 0 for bit and text
};

/// The type that `word` names, in any case. @throws Error (through `text`) with the offending word
const VtkType& find_vtk_type(TextReader& text, std::string_view word);

/// Passes over `count` values.
void skip_vtk_values(TextReader& text, bool binary, const VtkType& type, std::size_t count);

/// Reads `count` numbers of an array, NaN and infinite ones too. Integers of 32 bits or fewer become
/// int32, others int64. Precondition: the type is neither bit nor text.
DataArray::Values read_vtk_values(TextReader& text, bool binary, const VtkType& type,
                                  std::size_t count);

/// Refuses `rows` * `columns` values that the rest of the file cannot hold, and gives the product.
std::size_t checked_vtk_count(TextReader& text, bool binary, const VtkType& type, std::size_t rows,
                              std::size_t columns);

/// Integers of a file: decoded when they are looked at if the file is binary, parsed into memory if
/// it is text. Lives no longer than the file.
class VtkIntegers {
 public:
  VtkIntegers() = default;
  VtkIntegers(TextReader& text, bool binary, const VtkType& type, std::size_t count,
              std::string_view what);

  /// Values that were decoded elsewhere, all of them at `place`.
  VtkIntegers(std::vector<std::int64_t> values, const char* place)
      : size_(values.size()), begin_(place), parsed_wide_(std::move(values)) {}

  std::size_t size() const { return size_; }
  std::int64_t operator[](std::size_t i) const {
    if (width_ == 0) return i < parsed_.size() ? parsed_[i] : parsed_wide_[i - parsed_.size()];
    const char* from = begin_ + i * width_;
    if (width_ == 4 && is_signed_) return load<std::int32_t>(from, kVtkSwaps);  // nearly all files
    return load_other(from);
  }
  /// Where value `i` stands in the file, for an error message.
  const char* locate(TextReader& text, std::size_t i) const;

 private:
  std::int64_t load_other(const char* from) const;

  std::size_t size_ = 0;
  const VtkType* type_ = nullptr;
  const char* begin_ = nullptr;
  std::size_t width_ = 0;  // bytes of a value; 0 for text
  bool is_signed_ = true;
  std::vector<std::int32_t> parsed_;       // of text; most files need no more bits
  std::vector<std::int64_t> parsed_wide_;  // from the first value on that does not fit
};

/// One real number of a binary array of any numeric type but bit.
double load_vtk_real(const VtkType& type, const char* from);

/// Where number `i` of an array that begins at `begin` stands, for an error message.
const char* locate_vtk_value(TextReader& text, bool binary, const VtkType& type, const char* begin,
                             std::size_t i);

}  // namespace tetmend::formats
