// SPDX-License-Identifier: MIT
#include "pieces/rows.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>
#include <variant>

#include "pieces/bytes.h"

namespace tetmend::pieces {

namespace {

/// Calls act with a value of the type that the array has.
template <class Act>
auto with_type(const DataArray& array, const Act& act) {
  return std::visit(
      [&](const auto& values) {
        return act(typename std::decay_t<decltype(values)>::value_type{});
      },
      array.values);
}

template <class Value>
void save(Value value, char* at) {
  std::memcpy(at, &value, sizeof(value));
}

/// An empty array of the type that has this place among the types of values.
template <std::size_t I = 0>
DataArray::Values values_of_type(std::size_t type) {
  if constexpr (I + 1 < std::variant_size_v<DataArray::Values>) {
    if (type != I) return values_of_type<I + 1>(type);
  }
  return DataArray::Values(std::in_place_index<I>);
}

}  // namespace

DataArray nothing_of(const DataArray& array) {
  return {array.name, array.components, values_of_type(array.values.index())};
}

std::vector<DataArray> nothing_of(const std::vector<DataArray>& arrays) {
  std::vector<DataArray> all;
  for (const DataArray& array : arrays) all.push_back(nothing_of(array));
  return all;
}

OutlineKey outline_key(const DataArray& array) {
  return {array.name, array.components, array.values.index()};
}

std::string_view bytes_of_values(const DataArray& array) {
  return std::visit(
      [](const auto& values) {
        return std::string_view(reinterpret_cast<const char*>(values.data()),
                                values.size() * sizeof(values[0]));
      },
      array.values);
}

void append_values(std::string_view bytes, DataArray& array) {
  if (bytes.empty()) return;
  std::visit(
      [&](auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        const std::size_t before = values.size();
        values.resize(before + bytes.size() / sizeof(Value));
        std::memcpy(values.data() + before, bytes.data(), bytes.size());
      },
      array.values);
}

void append_nothing(std::size_t numbers, DataArray& array) {
  std::visit(
      [&](auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        values.resize(values.size() + numbers, std::numeric_limits<Value>::quiet_NaN());
      },
      array.values);
}

void append_outline(const DataArray& array, std::string& bytes) {
  put(array.name, bytes);
  put(std::uint64_t{array.components}, bytes);
  put(std::uint64_t{array.values.index()}, bytes);
}

DataArray take_outline(std::string_view& bytes) {
  DataArray array;
  std::uint64_t components = 0;
  std::uint64_t type = 0;
  take(bytes, array.name);
  take(bytes, components);
  take(bytes, type);
  array.components = components;
  array.values = values_of_type(type);
  return array;
}

RowLayout::RowLayout(std::vector<DataArray> arrays) : arrays_(std::move(arrays)) {
  for (std::size_t i = 0; i < arrays_.size(); ++i) {
    std::visit([](auto& values) { values.clear(); }, arrays_[i].values);
    places_.push_back(size_);
    size_ += width(i);
  }
}

std::size_t RowLayout::width(std::size_t array) const {
  const std::size_t size = with_type(arrays_[array], [](auto value) { return sizeof(value); });
  return size * arrays_[array].components;
}

void RowLayout::set(std::size_t array, const DataArray::Values& values, std::size_t from,
                    char* row) const {
  const std::size_t components = arrays_[array].components;
  std::visit(
      [&](const auto& numbers) {
        std::memcpy(row + places_[array], numbers.data() + from * components, width(array));
      },
      values);
}

double RowLayout::number(std::size_t array, std::size_t component, const char* row) const {
  return with_type(arrays_[array], [&](auto type) {
    using Value = decltype(type);
    return static_cast<double>(value_at<Value>(row + places_[array] + component * sizeof(Value)));
  });
}

void RowLayout::interpolate(const std::array<const char*, 4>& rows,
                            const std::array<double, 4>& weights, char* to) const {
  const auto most =
      static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  for (std::size_t i = 0; i < arrays_.size(); ++i) {
    with_type(arrays_[i], [&](auto type) {
      using Value = decltype(type);
      for (std::size_t k = 0; k < arrays_[i].components; ++k) {
        const std::size_t at = places_[i] + k * sizeof(Value);
        if constexpr (std::is_integral_v<Value>) {
          save(value_at<Value>(rows[most] + at), to + at);
        } else {
          // From the first vertex on, so that a constant stays what it is.
          const auto first = static_cast<double>(value_at<Value>(rows[0] + at));
          double sum = first;
          for (std::size_t c = 1; c < 4; ++c) {
            sum += weights[c] * (static_cast<double>(value_at<Value>(rows[c] + at)) - first);
          }
          save(static_cast<Value>(sum), to + at);
        }
      }
    });
  }
}

void RowLayout::average(std::size_t array, const std::vector<std::pair<const char*, double>>& rows,
                        char* to) const {
  with_type(arrays_[array], [&](auto type) {
    using Value = decltype(type);
    for (std::size_t k = 0; k < arrays_[array].components; ++k) {
      double mean = 0;
      for (const auto& [row, weight] : rows) mean += weight * number(array, k, row);
      save(static_cast<Value>(mean), to + places_[array] + k * sizeof(Value));
    }
  });
}

void RowLayout::append_rows(const std::vector<DataArray>& from, std::size_t begin, std::size_t end,
                            std::string& rows) const {
  const std::size_t before = rows.size();
  rows.resize(before + (end - begin) * size_);
  for (std::size_t i = 0; i < arrays_.size(); ++i) {
    char* row = rows.data() + before;
    for (std::size_t k = begin; k < end; ++k, row += size_) set(i, from[i].values, k, row);
  }
}

void RowLayout::take_rows(std::string_view rows, std::vector<DataArray>& to) const {
  for (std::size_t i = 0; i < arrays_.size(); ++i) {
    std::string column;
    append_column(i, rows, column);
    append_values(column, to[i]);
  }
}

void RowLayout::append_column(std::size_t array, std::string_view rows, std::string& bytes) const {
  const std::size_t size = width(array);
  for (std::size_t at = 0; at < rows.size(); at += size_) {
    bytes.append(rows.substr(at + places_[array], size));
  }
}

}  // namespace tetmend::pieces
