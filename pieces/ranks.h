// SPDX-License-Identifier: MIT
// Who works on a mesh together: processes that each hold some of its pieces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tetmend::pieces {

/// All ranks of a run call the same functions in the same order; each call ends when all have made it.
/// Sums are of whole numbers alone: in which order they are added cannot show.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual std::size_t count() const = 0;
  virtual std::size_t number() const = 0;  ///< of this one, from 0
  /// What each rank gives, by rank; all get the same.
  virtual std::vector<std::string> gather(std::string_view mine) = 0;
  /// In place, element by element, over all ranks.
  virtual void add(std::span<std::int64_t> sums) = 0;
  /// `to[r]` goes to rank r; what came from each rank.
  virtual std::vector<std::string> exchange(std::vector<std::string> to) = 0;

  bool is_first() const { return number() == 0; }
  /// Ends when all have come here.
  void meet() { gather({}); }
  /// Whether it is true on any rank.
  bool any(bool here) {
    std::int64_t count = here ? 1 : 0;
    add({&count, 1});
    return count > 0;
  }
};

/// A process on its own.
class OneRank final : public Ranks {
 public:
  std::size_t count() const override { return 1; }
  std::size_t number() const override { return 0; }
  std::vector<std::string> gather(std::string_view mine) override { return {std::string(mine)}; }
  void add(std::span<std::int64_t>) override {}
  std::vector<std::string> exchange(std::vector<std::string> to) override { return to; }
};

}  // namespace tetmend::pieces
