// SPDX-License-Identifier: MIT
#include "face/identifiers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <tetmend/improve.h>

#include "kernel/formats/cell_arrays.h"
#include "kernel/printable.h"

namespace tetmend::face {

namespace {

/// Up to here a double has all whole numbers, or a float.
constexpr std::int64_t kMostOfDouble = std::int64_t{1} << 53;
constexpr std::int64_t kMostOfFloat = std::int64_t{1} << 24;

bool ends_with_word(std::string_view name, std::string_view word) {
  if (name.size() < word.size()) return false;
  const std::size_t first = name.size() - word.size();
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (lower(name[first + i]) != word[i]) return false;
  }
  // "NodeID", "node_id", but not "fluid".
  return first == 0 || std::islower(static_cast<unsigned char>(name[first])) == 0 ||
         std::isalpha(static_cast<unsigned char>(name[first - 1])) == 0;
}

bool is_name_of_identifiers(std::string_view name) {
  constexpr std::array<std::string_view, 7> kWords = {"id",      "ids",   "number", "numbers",
                                                      "indices", "index", "num"};
  return std::any_of(kWords.begin(), kWords.end(),
                     [&](std::string_view word) { return ends_with_word(name, word); });
}

/// False for a number that is not whole.
template <class Value>
bool to_identifier(Value value, std::int64_t& number) {
  if constexpr (std::is_floating_point_v<Value>) {
    constexpr std::int64_t kMost = std::is_same_v<Value, float> ? kMostOfFloat : kMostOfDouble;
    if (!(std::abs(value) <= static_cast<Value>(kMost)) || value != std::floor(value)) {
      return false;
    }
  }
  number = static_cast<std::int64_t>(value);
  return true;
}

template <class Value>
bool are_whole_and_different(std::span<const Value> values) {
  std::vector<std::int64_t> numbers(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!to_identifier(values[i], numbers[i])) return false;
  }
  std::sort(numbers.begin(), numbers.end());
  return std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end();
}

std::vector<std::int64_t> identifiers_in(const DataArray& array) {
  std::vector<std::int64_t> numbers;
  std::visit(
      [&](const auto& values) {
        for (const auto value : values) {
          std::int64_t number = 0;
          if (to_identifier(value, number)) numbers.push_back(number);
        }
      },
      array.values);
  return numbers;
}

std::int64_t largest_of(const std::vector<const DataArray*>& arrays) {
  std::int64_t most = 0;
  for (const DataArray* array : arrays) {
    for (const std::int64_t number : identifiers_in(*array)) most = std::max(most, number);
  }
  return most;
}

/// The greatest number that all of the arrays can hold.
std::int64_t limit_of(const std::vector<const DataArray*>& arrays) {
  constexpr std::array<std::int64_t, 4> kLimits = {INT32_MAX, INT64_MAX, kMostOfFloat,
                                                   kMostOfDouble};
  std::int64_t limit = INT64_MAX;
  for (const DataArray* array : arrays) limit = std::min(limit, kLimits[array->values.index()]);
  return limit;
}

}  // namespace

bool are_identifiers(const DataArray& array) {
  if (array.components != 1 || formats::is_few_labels(array.size(), array.size())) return false;
  return std::visit(
      [&](const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if (!std::is_integral_v<Value> && !is_name_of_identifiers(array.name)) return false;
        const std::span<const Value> all(values);
        constexpr std::size_t kFirst = 256;  // of a field, some of these are alike
        return are_whole_and_different(all.first(std::min(kFirst, all.size()))) &&
               are_whole_and_different(all);
      },
      array.values);
}

NewIdentifiers::NewIdentifiers(std::vector<const DataArray*> arrays)
    : arrays_(std::move(arrays)),
      numbers_(largest_of(arrays_), std::array{limit_of(arrays_)}, [this] {
        std::vector<NumberRange> taken;
        for (const DataArray* array : arrays_) {
          for (const std::int64_t number : identifiers_in(*array))
            taken.emplace_back(number, number);
        }
        return taken;
      }) {}

DataArray NewIdentifiers::carried(const DataArray& old, std::span<const std::uint32_t> same) {
  DataArray made{old.name, old.components, {}};
  std::visit(
      [&](const auto& values) {
        std::decay_t<decltype(values)> now(same.size());
        for (std::size_t i = 0; i < same.size(); ++i) {
          using Value = typename std::decay_t<decltype(values)>::value_type;
          now[i] = same[i] != kGone ? values[same[i]] : static_cast<Value>(numbers_.next());
        }
        made.values = std::move(now);
      },
      old.values);
  return made;
}

std::string identifier_note(const DataArray& old, const DataArray& made, std::string_view of,
                            std::span<const std::uint32_t> same) {
  const auto is_new = [](std::uint32_t row) { return row == kGone; };
  const auto fresh = static_cast<std::size_t>(std::count_if(same.begin(), same.end(), is_new));
  const std::size_t gone = old.size() - (same.size() - fresh);
  if (fresh == 0 && gone == 0) return {};
  std::string from;
  if (fresh > 0) {
    const auto first =
        static_cast<std::size_t>(std::find_if(same.begin(), same.end(), is_new) - same.begin());
    std::visit(
        [&](const auto& values) {
          from = fmt::format(", from {} on", static_cast<std::int64_t>(values[first]));
        },
        made.values);
  }
  return fmt::format(
      "'{}' numbers {}: {} of {} numbers are gone, {} are new{}; files beside the mesh that refer "
      "to "
      "them, such as those of faces, have the old ones",
      printable(old.name), of, gone, old.size(), fresh, from);
}

}  // namespace tetmend::face
