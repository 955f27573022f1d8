// SPDX-License-Identifier: MIT
// A stored piece of the new mesh, while it gets its rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pieces/divided_mesh.h"
#include "pieces/row_messages.h"

namespace tetmend::pieces {

/// Of a stored piece.
class NewPart {
 public:
  NewPart(const DividedMesh& mesh, std::size_t part, const ByKind<RowLayout>& layouts)
      : mesh_(mesh), layouts_(layouts), piece_(mesh.stored(part)) {}

  /// What it asks each part of space.
  std::vector<Questions> ask(const Parting& parting, double margin, bool asks_for_shares) const;
  void take(const Answers& answers);
  /// When all answers are there.
  void average(const std::vector<std::size_t>& arrays);
  std::vector<double> integrals() const;
  const std::string& rows(RowKind kind) const { return rows_[kind]; }
  /// Of its vertices that the file has, by the slices that have their rows.
  std::vector<std::vector<Questions::OfNumber>> ask_for_vertices(std::uint64_t slices) const;
  void make_room(const std::string& row_of_new_vertex);
  void check() const;

 private:
  struct Share {
    std::uint64_t place;
    std::uint64_t old_tet;
    double volume;
    std::size_t row;
  };

  std::size_t count(RowKind kind) const {
    return kind == RowKind::vertex     ? piece_.ids.size()
           : kind == RowKind::point    ? piece_.ids.size()
           : kind == RowKind::tet      ? piece_.tets.size()
           : kind == RowKind::triangle ? piece_.triangles.size()
                                       : piece_.edges.size();
  }
  bool has(RowKind kind) const { return layouts_[kind].size() > 0; }
  bool is_old(std::size_t v) const { return piece_.ids[v] < mesh_.first_added(); }
  bool is_where_it_was(std::uint32_t v) const {
    return is_old(v) && (piece_.marks[v] & kMoved) == 0;
  }
  VertexId number(std::uint32_t v) const { return piece_.ids[v] - mesh_.state().first_id; }
  template <class Element>
  auto numbers(const Element& element) const {
    auto ids = sorted_ids(piece_.ids, element.vertices);
    for (VertexId& id : ids) id -= mesh_.state().first_id;
    return ids;
  }
  /// That of its vertex with the lowest number, which is its part of old elements, too.
  template <class Element>
  static std::uint32_t home(const Element& element, const std::vector<std::uint32_t>& parts) {
    return parts[*std::min_element(element.vertices.begin(), element.vertices.end())];
  }
  /// By tet that has changed, in the order of `which`.
  std::vector<Questions::Kin> kin_of(std::span<const std::uint32_t> which) const;
  std::vector<std::uint32_t> changed_tets() const;
  bool is_as_it_was(const PieceTet& tet) const;
  void ask_for_points(const std::vector<std::uint32_t>& parts,
                      std::span<const std::uint32_t> changed, std::span<const Questions::Kin> kin,
                      std::vector<Questions>& questions) const;
  void ask_for_tets(const Parting& parting, const std::vector<std::uint32_t>& parts, double margin,
                    bool asks_for_shares, std::span<const Questions::Kin> kin,
                    std::vector<Questions>& questions) const;

  const DividedMesh& mesh_;
  const ByKind<RowLayout>& layouts_;
  const Piece piece_;
  ByKind<std::string> rows_;
  ByKind<std::size_t> filled_{};
  std::vector<Share> shares_;
  std::string share_rows_;
};

}  // namespace tetmend::pieces
