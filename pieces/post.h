// SPDX-License-Identifier: MIT
// Messages between ranks for numbered addresses, each of which one rank has.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "pieces/ranks.h"
#include "pieces/shelf.h"

namespace tetmend::pieces {

/// What has come lies on the shelf of the rank that has the address, until it is taken.
class Post {
 public:
  /// @param owners  by address, the rank that has it
  /// @param name  of what lies on the shelf
  Post(Shelf& shelf, Ranks& ranks, std::vector<std::uint32_t> owners, std::string name);

  /// @param source  no two messages for an address have the same
  void send(std::uint64_t source, std::size_t address, std::string_view message);
  /// All ranks: brings what was sent since the last time.
  void deliver();
  /// All ranks: calls send_for(address) for each address of this rank in another post, and delivers after
  /// each.
  void send_by_address(const Post& other, const std::function<void(std::size_t address)>& send_for);
  /// What has come for an address of this rank, by source, whoever brought it. It is gone then.
  std::vector<std::pair<std::uint64_t, std::string>> take(std::size_t address);

  std::size_t addresses() const { return owners_.size(); }
  bool has(std::size_t address) const { return owners_[address] == ranks_.number(); }

 private:
  std::string name_of(std::size_t address) const;

  Shelf& shelf_;
  Ranks& ranks_;
  std::vector<std::uint32_t> owners_;
  std::string name_;
  std::vector<std::string> to_;  // by rank
};

}  // namespace tetmend::pieces
