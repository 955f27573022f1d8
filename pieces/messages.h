// SPDX-License-Identifier: MIT
// What a stored piece sends to the parts of a division, and what of it stays where it is.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pieces/parting.h"
#include "pieces/piece.h"

namespace tetmend::pieces {

/// An element goes to the parts of its vertices that are sent; where none is, it stays. What is sent:
/// all, or vertices in zones, or those within so many edges of a border of the last division. A
/// vertex that several pieces have is sent by all of them or by none, so each can tell by itself.
class Messages {
 public:
  /// @param parting  must outlive it
  /// @param rings  without meaning where all is sent, or zones
  Messages(Piece piece, const Parting& parting, unsigned rings);

  /// For that part. Empty: none.
  std::string message(std::uint64_t source, std::size_t part);
  /// Likewise, of what stays.
  std::string rest(std::uint64_t source);

 private:
  struct Share {
    std::vector<std::uint32_t> vertices, tets, triangles, edges, surface, lines;
    bool is_empty() const;
  };

  void choose(const Parting& parting, unsigned rings);
  void mark_seams();
  template <class Element>
  void share_out(const std::vector<Element>& elements, std::vector<std::uint32_t> Share::*list);
  std::string take(std::uint64_t source, Share& share) const;

  Piece piece_;
  bool sends_some_ = true;
  std::vector<std::uint32_t> parts_;  // by vertex
  std::vector<Share> shares_;
  Share rest_;
};

/// A message: a head that names its source, and a piece.
std::string to_message(std::uint64_t source, const Piece& piece);
/// Appends all of these messages with their sources.
void take_messages(std::string_view bytes, std::vector<std::pair<std::uint64_t, Piece>>& messages);
/// Takes the head off the front of `bytes`. @returns the piece as it was appended
std::string_view take_message(std::string_view& bytes, std::uint64_t& source);

}  // namespace tetmend::pieces
