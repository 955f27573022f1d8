// SPDX-License-Identifier: MIT
#include "pieces/number_order.h"

#include <algorithm>
#include <bit>

namespace tetmend::pieces {

namespace {

/// Adds up bits of all ranks, of which no two are the same: some at a time.
void add_bits(std::vector<std::uint32_t>& words, Ranks& ranks) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 17;
  for (std::size_t begin = 0; begin < words.size(); begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, words.size());
    std::vector<std::int64_t> sums(words.begin() + static_cast<std::ptrdiff_t>(begin),
                                   words.begin() + static_cast<std::ptrdiff_t>(end));
    ranks.add(sums);
    for (std::size_t i = begin; i < end; ++i) {
      words[i] = static_cast<std::uint32_t>(sums[i - begin]);
    }
  }
}

}  // namespace

std::optional<NumberOrder> NumberOrder::make(std::span<const NumberFacts> chunks, const List& list,
                                             bool are_names, Ranks& ranks) {
  NumberOrder order;
  std::uint64_t rows = 0;
  std::int64_t most = 0;
  for (const NumberFacts& chunk : chunks) {
    if (chunk.rows == 0) continue;
    order.ascends_ = order.ascends_ && chunk.ascend != 0 && (rows == 0 || chunk.least > most);
    order.least_ = rows == 0 ? chunk.least : std::min(order.least_, chunk.least);
    most = rows == 0 ? chunk.most : std::max(most, chunk.most);
    rows += chunk.rows;
  }
  if (rows == 0) return order;
  order.range_ = static_cast<std::uint64_t>(most) - static_cast<std::uint64_t>(order.least_) + 1;
  if (order.ascends_ && (!are_names || order.range_ == rows)) return order;
  constexpr std::uint64_t kSmall = 1 << 20;
  if (order.range_ / 8 > rows + kSmall) return std::nullopt;
  order.words_.assign(order.range_ / kBits + 1, 0);
  std::int64_t twice = 0;
  const ChunkShare share(chunks.size(), ranks);
  for (std::size_t i = share.begin; i < share.end; ++i) {
    list(i, [&](std::int64_t number) {
      const auto at = static_cast<std::uint64_t>(number - order.least_);
      if (at >= order.range_ || order.bit(at)) return void(twice = 1);
      order.words_[at / kBits] |= std::uint32_t{1} << (at % kBits);
    });
  }
  add_bits(order.words_, ranks);
  std::uint64_t found = 0;
  for (std::size_t w = 0; w < order.words_.size(); ++w) {
    if (w % kWords == 0) order.sums_.push_back(found);
    found += static_cast<std::uint64_t>(std::popcount(order.words_[w]));
  }
  // Where two ranks have the same number, a carry has taken one bit of two.
  if (ranks.any(twice != 0) || found != rows) return std::nullopt;
  return order;
}

bool NumberOrder::has(std::int64_t number) const {
  if (number < least_) return false;
  const auto at = static_cast<std::uint64_t>(number - least_);
  return at < range_ && (words_.empty() || bit(at));
}

std::uint64_t NumberOrder::place(std::int64_t number) const {
  const auto at = static_cast<std::uint64_t>(number - least_);
  if (words_.empty()) return at;
  const std::uint64_t word = at / kBits;
  std::uint64_t place = sums_[word / kWords];
  for (std::uint64_t w = word / kWords * kWords; w < word; ++w) {
    place += static_cast<std::uint64_t>(std::popcount(words_[w]));
  }
  const std::uint32_t below = (std::uint32_t{1} << (at % kBits)) - 1;
  return place + static_cast<std::uint64_t>(std::popcount(words_[word] & below));
}

}  // namespace tetmend::pieces
