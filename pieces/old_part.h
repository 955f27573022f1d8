// SPDX-License-Identifier: MIT
// The old mesh in a part of space, with its rows.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "face/bodies.h"
#include "face/tet_locator.h"
#include "kernel/mesh_data.h"
#include "pieces/parting.h"
#include "pieces/row_messages.h"
#include "pieces/row_source.h"

namespace tetmend::pieces {

/// Old tets that meet a part of space, with the rows that there are.
class OldPart {
 public:
  OldPart(const std::vector<std::pair<std::uint64_t, std::string>>& messages,
          const ByKind<RowLayout>& layouts, const Parting& parting, std::uint32_t number);

  void keep(std::uint64_t tet) { is_kept_[tet_of(tet)] = 1; }
  /// Precondition: all that are kept are known.
  void find_changed();
  /// From what one piece says of its points others may have answers, too. Precondition: find_changed().
  void learn(const Questions& questions);
  void answer(const Questions& questions, Answers& answers);
  const std::vector<double>& integrals() const { return integrals_; }

 private:
  template <std::size_t N>
  struct Named {
    std::array<VertexId, N> ids;
    std::uint32_t row;
    bool is_taken = false;
  };

  void merge(const std::vector<std::pair<std::uint64_t, std::string>>& messages);
  void sort_tets();
  template <class Element>
  void name(const std::vector<Element>& elements,
            std::vector<Named<std::tuple_size_v<decltype(Element::vertices)>>>& named) const;
  void sum_up(const Parting& parting, std::uint32_t number);
  std::uint32_t tet_of(std::uint64_t number) const;
  const char* row(RowKind kind, std::size_t i) const {
    return rows_[kind].data() + i * layouts_[kind].size();
  }
  std::array<const char*, 4> rows_of_points(std::size_t tet) const {
    std::array<const char*, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) rows[i] = row(RowKind::point, data_.tets[tet].vertices[i]);
    return rows;
  }
  void add(RowKind kind, std::uint64_t place, const char* from, Answers& answers) const {
    answers.places[kind].push_back(place);
    answers.rows[kind].append(from, layouts_[kind].size());
  }
  template <std::size_t N>
  void answer_named(RowKind kind, const std::vector<Questions::OfIds<N>>& asked,
                    std::vector<Named<N>>& named, Answers& answers) const;
  void answer_shares(const std::vector<Questions::OfTet>& asked, Answers& answers) const;
  face::TetPlace find(const Questions::AtPoint& asked) const;
  face::Origin origin_of(const Questions::Kin& kin) const;

  const ByKind<RowLayout>& layouts_;
  std::vector<VertexId> ids_;
  MeshData data_;                       // points and tets, by number in the file
  std::vector<std::uint32_t> origins_;  // of the tets: their numbers
  ByKind<std::string> rows_;
  std::vector<Named<3>> triangles_;
  std::vector<Named<2>> edges_;
  std::vector<char> is_kept_;
  std::optional<face::Bodies> bodies_;
  std::optional<face::TetLocator> changed_;
  std::map<VertexId, Questions::Kin> kin_;  // of new points; empty where there is one body
  std::vector<double> integrals_;
};

/// A slice's share for a part.
std::string to_message(const RowSlice& slice, const Extract& what,
                       const ByKind<RowLayout>& layouts);

}  // namespace tetmend::pieces
