// SPDX-License-Identifier: MIT
// What a file holds in arrays, as rows of bytes: a row has all numbers of one point or element.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::pieces {

/// What has rows. Of a vertex: what goes where it goes; of a point: what belongs to its place.
enum class RowKind : std::size_t { point, tet, triangle, edge, vertex };
inline constexpr std::array<RowKind, 5> kAllRowKinds = {
    RowKind::point, RowKind::tet, RowKind::triangle, RowKind::edge, RowKind::vertex};
/// What files have arrays of.
inline constexpr std::array<RowKind, 4> kRowKinds = {RowKind::point, RowKind::tet,
                                                     RowKind::triangle, RowKind::edge};
/// Something for each kind.
template <class Value>
class ByKind {
 public:
  Value& operator[](RowKind kind) { return values_[static_cast<std::size_t>(kind)]; }
  const Value& operator[](RowKind kind) const { return values_[static_cast<std::size_t>(kind)]; }

 private:
  std::array<Value, kAllRowKinds.size()> values_{};
};

/// For each kind arrays of all that has rows, in the same order.
using KindArrays = ByKind<std::vector<DataArray>>;

/// Name, components and type, without values.
DataArray nothing_of(const DataArray& array);
std::vector<DataArray> nothing_of(const std::vector<DataArray>& arrays);
/// Name, components and type: equal for arrays that differ in their values alone.
using OutlineKey = std::tuple<std::string, std::size_t, std::size_t>;
OutlineKey outline_key(const DataArray& array);
/// Its numbers, as they are in memory.
std::string_view bytes_of_values(const DataArray& array);
/// Appends such numbers.
void append_values(std::string_view bytes, DataArray& array);
/// Appends what says "none" for so many numbers: 0 for integers, NaN.
void append_nothing(std::size_t numbers, DataArray& array);

/// What nothing_of() leaves, as bytes. @throws Error when they end too early
void append_outline(const DataArray& array, std::string& bytes);
DataArray take_outline(std::string_view& bytes);

/// Where in a row the numbers of each array stand.
class RowLayout {
 public:
  RowLayout() = default;
  /// @param arrays  their values do not count
  explicit RowLayout(std::vector<DataArray> arrays);

  const std::vector<DataArray>& arrays() const { return arrays_; }
  std::size_t size() const { return size_; }  ///< bytes of a row
  std::size_t place(std::size_t array) const { return places_[array]; }
  /// Bytes of an array in a row.
  std::size_t width(std::size_t array) const;

  /// Copies what an array has for its row `from` into a row. Precondition: values of its type.
  void set(std::size_t array, const DataArray::Values& values, std::size_t from, char* row) const;
  /// A number of a row.
  double number(std::size_t array, std::size_t component, const char* row) const;
  /// Real numbers by the weights; integers from the row with the greatest.
  void interpolate(const std::array<const char*, 4>& rows, const std::array<double, 4>& weights,
                   char* to) const;
  /// Of an array of real numbers, the mean of rows by their weights, which sum to 1.
  void average(std::size_t array, const std::vector<std::pair<const char*, double>>& rows,
               char* to) const;
  /// Appends what `rows` have of an array.
  void append_column(std::size_t array, std::string_view rows, std::string& bytes) const;
  /// Appends the rows of things from `begin` to `end`. Precondition: arrays like these, with
  /// values.
  void append_rows(const std::vector<DataArray>& from, std::size_t begin, std::size_t end,
                   std::string& rows) const;
  /// The other way. Precondition: arrays like these.
  void take_rows(std::string_view rows, std::vector<DataArray>& to) const;

 private:
  std::vector<DataArray> arrays_;
  std::vector<std::size_t> places_;
  std::size_t size_ = 0;
};

}  // namespace tetmend::pieces
