// SPDX-License-Identifier: MIT
#include "pieces/numbering.h"

#include "kernel/error.h"

namespace tetmend::pieces {

namespace {

std::uint64_t mask(VertexId id) {
  return std::uint64_t{1} << (id % 64);
}

std::uint64_t count_bits(std::uint64_t bits) {
  return static_cast<std::uint64_t>(__builtin_popcountll(bits));
}

}  // namespace

Numbering::Numbering(const DividedMesh& mesh)
    : first_(mesh.state().first_id),
      is_there_((mesh.state().next_id - first_ + 63) / 64, 0),
      before_(is_there_.size(), 0) {
  for (const std::size_t part : mesh.own()) {
    const Piece piece = mesh.stored_vertices(part);
    for (std::size_t v = 0; v < piece.ids.size(); ++v) {
      if ((piece.marks[v] & kOwn) == 0) continue;
      const VertexId id = piece.ids[v] - first_;
      std::int64_t& bits = is_there_[id / 64];
      bits = static_cast<std::int64_t>(static_cast<std::uint64_t>(bits) | mask(id));
    }
  }
  mesh.ranks().add(is_there_);  // each bit is of one rank alone, so this is "or"
  for (std::size_t i = 0; i < is_there_.size(); ++i) {
    before_[i] = count_;
    count_ += count_bits(static_cast<std::uint64_t>(is_there_[i]));
  }
}

std::uint64_t Numbering::number(VertexId vertex) const {
  const VertexId id = vertex - first_;
  const auto bits = static_cast<std::uint64_t>(is_there_[id / 64]);
  if ((bits & mask(id)) == 0) throw Error("pieces do not fit: a vertex belongs to none");
  return before_[id / 64] + count_bits(bits & (mask(id) - 1));
}

}  // namespace tetmend::pieces
