// SPDX-License-Identifier: MIT
#include "pieces/messages.h"

#include <algorithm>

#include "kernel/error.h"
#include "pieces/bytes.h"

namespace tetmend::pieces {

namespace {

template <class Element>
void want(const std::vector<Element>& elements, const std::vector<std::uint32_t>& chosen,
          std::vector<char>& wanted) {
  for (const std::uint32_t i : chosen) {
    for (const std::uint32_t v : elements[i].vertices) wanted[v] = 1;
  }
}

}  // namespace

Messages::Messages(Piece piece, const Parting& parting, unsigned rings)
    : piece_(std::move(piece)), shares_(parting.parts()) {
  choose(parting, rings);
  if (!sends_some_) return;
  share_out(piece_.tets, &Share::tets);
  share_out(piece_.triangles, &Share::triangles);
  share_out(piece_.edges, &Share::edges);
  share_out(piece_.surface, &Share::surface);
  share_out(piece_.lines, &Share::lines);
  for (std::uint32_t v = 0; v < parts_.size(); ++v) {
    if (!is_own(piece_.marks[v])) continue;
    const std::uint32_t part = parts_[v];
    (part == Parting::kNoPart ? rest_ : shares_[part]).vertices.push_back(v);
  }
}

void Messages::choose(const Parting& parting, unsigned rings) {
  if (parting.sends_all) {
    parts_ = parting.parts_of(std::span(piece_.points));
    return;
  }
  std::vector<char> sent;
  if (parting.zones.count() > 0) {
    for (const Point& p : piece_.points) sent.push_back(parting.zones.find(p) >= 0 ? 1 : 0);
  } else {
    sent = near_marked(piece_, kBorder, rings);
  }
  sends_some_ = false;
  for (std::size_t v = 0; v < sent.size(); ++v) {
    const bool is_seam = parting.zones.count() == 0 && (piece_.marks[v] & kSeam) != 0;
    const bool is_sent = sent[v] != 0 || is_seam;
    sends_some_ = sends_some_ || is_sent;
    const unsigned others = piece_.marks[v] & ~unsigned{kSent | kSeam};
    piece_.marks[v] = static_cast<std::uint8_t>(others | (is_sent ? kSent : 0U));
  }
  if (!sends_some_) return;
  parts_ = parting.parts_of(piece_);
  mark_seams();
}

void Messages::mark_seams() {
  for (const PieceTet& tet : piece_.tets) {
    const auto is_sent = [&](std::uint32_t v) { return parts_[v] != Parting::kNoPart; };
    const auto& t = tet.vertices;
    if (std::none_of(t.begin(), t.end(), is_sent)) continue;
    for (const std::uint32_t v : t) {
      if (!is_sent(v)) piece_.marks[v] = static_cast<std::uint8_t>(piece_.marks[v] | kSeam);
    }
  }
}

template <class Element>
void Messages::share_out(const std::vector<Element>& elements,
                         std::vector<std::uint32_t> Share::*list) {
  for (std::uint32_t i = 0; i < elements.size(); ++i) {
    const auto& v = elements[i].vertices;
    bool stays = true;
    for (std::size_t k = 0; k < v.size(); ++k) {
      const std::uint32_t part = parts_[v[k]];
      if (part == Parting::kNoPart) continue;
      stays = false;
      const auto is_same = [&](std::uint32_t w) { return parts_[w] == part; };
      if (std::any_of(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(k), is_same)) continue;
      (shares_[part].*list).push_back(i);
    }
    if (stays) (rest_.*list).push_back(i);
  }
}

bool Messages::Share::is_empty() const {
  return vertices.empty() && tets.empty() && triangles.empty() && edges.empty() &&
         surface.empty() && lines.empty();
}

std::string Messages::message(std::uint64_t source, std::size_t part) {
  return take(source, shares_[part]);
}

std::string Messages::rest(std::uint64_t source) {
  if (sends_some_) return take(source, rest_);
  return piece_.ids.empty() ? std::string() : to_message(source, piece_);
}

std::string Messages::take(std::uint64_t source, Share& share) const {
  if (share.is_empty()) return {};
  Extract what;
  what.wanted.assign(piece_.ids.size(), 0);
  for (const std::uint32_t v : share.vertices) what.wanted[v] = 1;
  want(piece_.tets, share.tets, what.wanted);
  want(piece_.triangles, share.triangles, what.wanted);
  want(piece_.edges, share.edges, what.wanted);
  want(piece_.surface, share.surface, what.wanted);
  want(piece_.lines, share.lines, what.wanted);
  what.tets = std::move(share.tets);
  what.triangles = std::move(share.triangles);
  what.edges = std::move(share.edges);
  what.surface = std::move(share.surface);
  what.lines = std::move(share.lines);
  share = {};
  return to_message(source, extract(piece_, what));
}

std::string to_message(std::uint64_t source, const Piece& piece) {
  const std::uint64_t size = byte_count(piece);
  std::string bytes;
  bytes.reserve(2 * sizeof(std::uint64_t) + size);
  put(source, bytes);
  put(size, bytes);
  append(piece, bytes);
  return bytes;
}

std::string_view take_message(std::string_view& bytes, std::uint64_t& source) {
  std::uint64_t size = 0;
  pieces::take(bytes, source);
  pieces::take(bytes, size);
  return take_front(bytes, size);
}

void take_messages(std::string_view bytes, std::vector<std::pair<std::uint64_t, Piece>>& messages) {
  while (!bytes.empty()) {
    std::uint64_t source = 0;
    std::string_view message = take_message(bytes, source);
    messages.emplace_back(source, take_piece(message));
  }
}

}  // namespace tetmend::pieces
