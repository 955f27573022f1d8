// SPDX-License-Identifier: MIT
// What MeshData::deck holds of an Abaqus deck.
#include "kernel/formats/inp_deck.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace tetmend::formats {
namespace {

/// Texts of any content, each behind its length.
void put(std::string& out, std::string_view text) {
  out += fmt::format("{}:", text.size());
  out += text;
}
void put(std::string& out, std::int64_t number) {
  out += fmt::format("{}:", number);
}

class Unpacker {
 public:
  explicit Unpacker(std::string_view text) : rest_(text) {}
  std::int64_t number() {
    std::int64_t value = 0;
    const auto result = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    rest_.remove_prefix(
        std::min(rest_.size(), static_cast<std::size_t>(result.ptr - rest_.data()) + 1));
    return value;
  }
  std::string text() {
    const auto length = static_cast<std::size_t>(number());
    std::string found(rest_.substr(0, length));
    rest_.remove_prefix(found.size());
    return found;
  }

 private:
  std::string_view rest_;
};

}  // namespace

std::vector<std::string> pack_deck(const InpDeck& deck) {
  std::string head(kInpDeckName);
  put(head, static_cast<std::int64_t>(deck.numberings.size()));
  for (const InpNumbering& numbering : deck.numberings) {
    put(head, numbering.node_offset);
    put(head, numbering.element_offset);
    put(head, numbering.most_node);
    put(head, numbering.most_element);
  }
  put(head, deck.folder);
  put(head, static_cast<std::int64_t>(deck.block_of_part.size()));
  for (const auto& [part, block] : deck.block_of_part) {
    put(head, part);
    put(head, block);
  }
  std::vector<std::string> packed = {std::move(head)};
  for (const InpPiece& piece : deck.pieces) {
    std::string text(1, static_cast<char>(piece.kind));
    if (piece.kind == InpPieceKind::verbatim) {
      packed.push_back(text + piece.text);
      continue;
    }
    put(text, piece.block);
    put(text, static_cast<std::int64_t>(piece.numbering));
    for (const std::string* part :
         {&piece.type, &piece.suffix, &piece.instance, &piece.text, &piece.more}) {
      put(text, *part);
    }
    put(text, static_cast<std::int64_t>(piece.groups.size()));
    for (const InpGroupName& group : piece.groups) {
      put(text, group.dimension);
      put(text, group.number);
    }
    packed.push_back(std::move(text));
  }
  if (!deck.remarks.empty()) {
    packed.push_back(static_cast<char>(InpPieceKind::remarks) + deck.remarks);
  }
  return packed;
}

bool is_inp_deck(const std::vector<std::string>& deck) {
  return !deck.empty() && deck[0].starts_with(kInpDeckName);
}

InpDeck unpack_deck(const std::vector<std::string>& packed) {
  InpDeck deck;
  const std::string_view first = packed[0];
  Unpacker head(first.substr(kInpDeckName.size()));
  deck.numberings.clear();
  for (std::int64_t left = head.number(); left > 0; --left) {
    InpNumbering& numbering = deck.numberings.emplace_back();
    numbering.node_offset = head.number();
    numbering.element_offset = head.number();
    numbering.most_node = head.number();
    numbering.most_element = head.number();
  }
  deck.folder = head.text();
  for (std::int64_t left = head.number(); left > 0; --left) {
    const auto part = static_cast<Label>(head.number());
    deck.block_of_part.emplace_back(part, static_cast<Label>(head.number()));
  }
  for (std::size_t i = 1; i < packed.size(); ++i) {
    InpPiece piece;
    piece.kind = static_cast<InpPieceKind>(packed[i].at(0));
    const std::string_view rest = std::string_view(packed[i]).substr(1);
    if (piece.kind == InpPieceKind::remarks) {
      deck.remarks = rest;
      continue;
    }
    if (piece.kind == InpPieceKind::verbatim) {
      piece.text = rest;
    } else {
      Unpacker text(rest);
      piece.block = static_cast<Label>(text.number());
      piece.numbering = static_cast<std::size_t>(text.number());
      for (std::string* part :
           {&piece.type, &piece.suffix, &piece.instance, &piece.text, &piece.more}) {
        *part = text.text();
      }
      for (std::int64_t left = text.number(); left > 0; --left) {
        const auto dimension = static_cast<int>(text.number());
        piece.groups.push_back({dimension, static_cast<Label>(text.number())});
      }
    }
    deck.pieces.push_back(std::move(piece));
  }
  return deck;
}

}  // namespace tetmend::formats
