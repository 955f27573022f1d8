// SPDX-License-Identifier: MIT
//   stored piece -> the parts of each tet's vertices -> a message for each part -> gathered piece
#include "pieces/divided_mesh.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace tetmend::pieces {

namespace {

std::string stored_name(std::size_t part) {
  return fmt::format("stored-{}", part);
}

std::string gathered_name(std::size_t part) {
  return fmt::format("gathered-{}", part);
}

bool is_own(std::uint8_t marks) {
  return (marks & kOwn) != 0;
}

/// What each part gets of a piece.
class Messages {
 public:
  Messages(const Piece& piece, const Parting& parting)
      : piece_(piece), parts_(parting.parts_of(piece.points)), shares_(parting.parts()) {
    share_out(piece.tets, &Share::tets);
    share_out(piece.triangles, &Share::triangles);
    share_out(piece.edges, &Share::edges);
    for (std::uint32_t v = 0; v < parts_.size(); ++v) {
      if (is_own(piece.marks[v])) shares_[parts_[v]].vertices.push_back(v);
    }
  }

  /// Empty: none.
  std::string message(std::size_t part) {
    Share& share = shares_[part];
    if (share.tets.empty() && share.vertices.empty() && share.triangles.empty() &&
        share.edges.empty()) {
      return {};
    }
    Extract what;
    what.wanted.assign(piece_.ids.size(), 0);
    for (const std::uint32_t v : share.vertices) what.wanted[v] = 1;
    mark(piece_.tets, share.tets, what.wanted);
    mark(piece_.triangles, share.triangles, what.wanted);
    mark(piece_.edges, share.edges, what.wanted);
    what.tets = std::move(share.tets);
    what.triangles = std::move(share.triangles);
    what.edges = std::move(share.edges);
    std::string bytes;
    append(extract(piece_, what), bytes);
    return bytes;
  }

 private:
  struct Share {
    std::vector<std::uint32_t> vertices, tets, triangles, edges;
  };

  template <class Element>
  void share_out(const std::vector<Element>& elements, std::vector<std::uint32_t> Share::*list) {
    for (std::uint32_t i = 0; i < elements.size(); ++i) {
      const auto& v = elements[i].vertices;
      for (std::size_t k = 0; k < v.size(); ++k) {
        const std::uint32_t part = parts_[v[k]];
        const auto is_same = [&](std::uint32_t w) { return parts_[w] == part; };
        if (std::any_of(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(k), is_same)) continue;
        (shares_[part].*list).push_back(i);
      }
    }
  }
  template <class Element>
  static void mark(const std::vector<Element>& elements, const std::vector<std::uint32_t>& chosen,
                   std::vector<char>& wanted) {
    for (const std::uint32_t i : chosen) {
      for (const std::uint32_t v : elements[i].vertices) wanted[v] = 1;
    }
  }

  const Piece& piece_;
  const std::vector<std::uint32_t> parts_;
  std::vector<Share> shares_;
};

}  // namespace

void DividedMesh::add_slice(const Piece& slice) {
  if (state_.stored == 0 && !slice.points.empty()) state_.low = state_.high = slice.points[0];
  for (const Point& p : slice.points) {
    state_.low = state_.low.cwiseMin(p).eval();
    state_.high = state_.high.cwiseMax(p).eval();
  }
  const std::size_t number = state_.stored;
  store(number, slice);
  ++state_.stored;
  state_.first_added.push_back(state_.next_id);
}

Parting DividedMesh::make_parting(std::size_t pieces, unsigned shift, ZoneMap zones) const {
  const double side = (state_.high - state_.low).maxCoeff();
  Parting parting{state_.low, side, shift, {0}, std::move(zones)};
  if (pieces == 1) return parting;
  const HilbertCurve curve = shifted_curve(state_.low, side, shift);
  KeyHistogram histogram;
  for (std::size_t part = 0; part < state_.stored; ++part) {
    const Piece piece = stored(part);
    for (std::size_t v = 0; v < piece.ids.size(); ++v) {
      if (is_own(piece.marks[v])) histogram.count(curve.key(piece.points[v]));
    }
  }
  parting.cuts = histogram.cuts(pieces);
  return parting;
}

void DividedMesh::divide(std::size_t pieces, unsigned shift, ZoneMap zones) {
  state_.parting = make_parting(pieces, shift, std::move(zones));
  for (std::size_t part = 0; part < parts(); ++part) shelf_.remove(gathered_name(part));
  for (std::size_t part = 0; part < state_.stored; ++part) {
    send(stored(part));
    shelf_.remove(stored_name(part));
  }
  state_.stored = 0;
  state_.first_added.clear();
}

void DividedMesh::send(const Piece& piece) {
  Messages messages(piece, state_.parting);
  for (std::size_t part = 0; part < parts(); ++part) {
    const std::string bytes = messages.message(part);
    if (!bytes.empty()) shelf_.append(gathered_name(part), bytes);
  }
}

Piece DividedMesh::gathered(std::size_t part) const {
  std::vector<Piece> messages;
  {
    const std::string bytes = shelf_.read(gathered_name(part));
    for (std::string_view rest = bytes; !rest.empty();) messages.push_back(take_piece(rest));
  }
  return merge(std::move(messages));
}

void DividedMesh::store(std::size_t part, const Piece& piece) {
  shelf_.remove(gathered_name(part));
  shelf_.remove(stored_name(part));
  std::string bytes;
  append(piece, bytes);
  shelf_.append(stored_name(part), bytes);
}

void DividedMesh::number_added(const std::vector<std::uint64_t>& added) {
  state_.first_added.clear();
  for (const std::uint64_t count : added) {
    state_.first_added.push_back(state_.next_id);
    state_.next_id += count;
  }
  state_.stored = added.size();
}

Piece DividedMesh::stored(std::size_t part) const {
  const std::string bytes = shelf_.read(stored_name(part));
  std::string_view rest = bytes;
  Piece piece = take_piece(rest);
  for (VertexId& id : piece.ids) {
    if (id < TaskResult::kNewVertex) continue;
    id = state_.first_added[part] + (id - TaskResult::kNewVertex);
  }
  return piece;
}

}  // namespace tetmend::pieces
