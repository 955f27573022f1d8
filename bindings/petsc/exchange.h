// SPDX-License-Identifier: MIT
// What ranks send each other, as arrays of one kind of value.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <petscsys.h>
#include <tetmend/distributed.h>
#include <tetmend/error.h>

namespace tetmend::petsc {

/// @throws Error with PETSc's words for the code
inline void check(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw Error(std::string("PETSc: ") + (text != nullptr ? text : "an error without a name"));
}

template <class Value>
std::string bytes_of(const std::vector<Value>& values) {
  static_assert(std::is_trivially_copyable_v<Value>);
  std::string bytes(values.size() * sizeof(Value), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

template <class Value>
std::vector<Value> values_of(std::string_view bytes) {
  std::vector<Value> values(bytes.size() / sizeof(Value));
  if (!values.empty()) {
    std::memcpy(static_cast<void*>(values.data()), bytes.data(), values.size() * sizeof(Value));
  }
  return values;
}

/// All ranks: `to[r]` goes to rank r; what came from each rank.
template <class Value>
std::vector<std::vector<Value>> exchange_values(Ranks& ranks,
                                                const std::vector<std::vector<Value>>& to) {
  std::vector<std::string> sent(to.size());
  std::transform(to.begin(), to.end(), sent.begin(), bytes_of<Value>);
  std::vector<std::vector<Value>> came;
  for (const std::string& from : ranks.exchange(std::move(sent))) {
    came.push_back(values_of<Value>(from));
  }
  return came;
}

/// The same, one after another.
template <class Value>
std::vector<Value> exchange_all(Ranks& ranks, const std::vector<std::vector<Value>>& to) {
  std::vector<Value> all;
  for (const auto& from : exchange_values(ranks, to))
    all.insert(all.end(), from.begin(), from.end());
  return all;
}

/// All ranks: what each gives, one after another.
template <class Value>
std::vector<Value> gather(Ranks& ranks, const std::vector<Value>& mine) {
  std::vector<Value> all;
  for (const std::string& from : ranks.gather(bytes_of(mine))) {
    const std::vector<Value> values = values_of<Value>(from);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

/// All ranks: none goes on when one of them has something to complain about.
/// @throws Error with the complaint of the first of these, on all ranks
inline void agree(Ranks& ranks, const std::string& complaint) {
  for (const std::string& each : ranks.gather(complaint)) {
    if (!each.empty()) throw Error(each);
  }
}

/// Who has which numbers, where they are given out rank by rank.
class Ranges {
 public:
  /// All ranks. @param mine how many this one has
  Ranges(Ranks& ranks, std::uint64_t mine) : number_(ranks.number()) {
    for (const std::uint64_t count : gather(ranks, std::vector<std::uint64_t>{mine})) {
      begins_.push_back(begins_.back() + count);
    }
  }
  std::uint64_t begin() const { return begins_[number_]; }  ///< of this rank
  std::uint64_t total() const { return begins_.back(); }
  std::size_t rank_of(std::uint64_t number) const {
    const auto after = std::upper_bound(begins_.begin(), begins_.end(), number);
    return static_cast<std::size_t>(after - begins_.begin()) - 1;
  }

 private:
  std::vector<std::uint64_t> begins_{0};
  std::size_t number_;
};

}  // namespace tetmend::petsc
