// SPDX-License-Identifier: MIT
#include "pieces/old_part.h"

#include <algorithm>
#include <string_view>

#include "face/overlap.h"
#include "pieces/bytes.h"

namespace tetmend::pieces {

std::string to_message(const RowSlice& slice, const Extract& what,
                       const ByKind<RowLayout>& layouts) {
  std::string bytes;
  append(extract(slice.piece, what), bytes);
  const auto put_rows = [&](RowKind kind, const std::vector<std::uint32_t>& chosen) {
    std::string rows;
    const std::size_t size = layouts[kind].size();
    if (size > 0) {
      rows.reserve(chosen.size() * size);
      for (const std::uint32_t i : chosen) rows.append(slice.rows[kind], i * size, size);
    }
    put(rows, bytes);
  };
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < what.wanted.size(); ++v) {
    if (what.wanted[v] != 0) vertices.push_back(v);
  }
  put_rows(RowKind::point, vertices);
  put_rows(RowKind::tet, what.tets);
  put_rows(RowKind::triangle, what.triangles);
  put_rows(RowKind::edge, what.edges);
  return bytes;
}

OldPart::OldPart(const std::vector<std::pair<std::uint64_t, std::string>>& messages,
                 const ByKind<RowLayout>& layouts, const Parting& parting, std::uint32_t number)
    : layouts_(layouts) {
  merge(messages);
  sum_up(parting, number);
}

void OldPart::merge(const std::vector<std::pair<std::uint64_t, std::string>>& messages) {
  for (const auto& message : messages) {
    std::string_view rest = message.second;
    const Piece piece = take_piece(rest);
    ids_.insert(ids_.end(), piece.ids.begin(), piece.ids.end());
  }
  std::sort(ids_.begin(), ids_.end());
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  data_.points.resize(ids_.size());
  const std::size_t size = layouts_[RowKind::point].size();
  rows_[RowKind::point].resize(ids_.size() * size);
  std::vector<MeshData::Triangle> triangles;
  std::vector<MeshData::Edge> edges;
  for (const auto& message : messages) {
    std::string_view rest = message.second;
    const Piece piece = take_piece(rest);
    std::string rows;
    take(rest, rows);
    std::vector<std::uint32_t> places(piece.ids.size());
    std::size_t at = 0;
    for (std::size_t v = 0; v < places.size(); ++v) {
      while (ids_[at] != piece.ids[v]) ++at;
      places[v] = static_cast<std::uint32_t>(at);
      data_.points[at] = piece.points[v];
      std::copy_n(rows.data() + v * size, size, rows_[RowKind::point].data() + at * size);
    }
    const auto add_all = [&](RowKind kind, auto from, auto& to) {
      for (auto element : from) {
        for (std::uint32_t& v : element.vertices) v = places[v];
        to.push_back(element);
      }
      take(rest, rows);
      rows_[kind] += rows;
    };
    std::vector<MeshData::Tet> tets;
    for (const PieceTet& tet : piece.tets) {
      tets.push_back({tet.vertices, tet.label});
      origins_.push_back(tet.origin & ~PieceTet::kProtected);
    }
    add_all(RowKind::tet, tets, data_.tets);
    add_all(RowKind::triangle, piece.triangles, triangles);
    add_all(RowKind::edge, piece.edges, edges);
  }
  sort_tets();
  name(triangles, triangles_);
  name(edges, edges_);
}

void OldPart::sort_tets() {
  std::vector<std::uint32_t> order(origins_.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return origins_[a] < origins_[b]; });
  std::vector<MeshData::Tet> tets;
  std::vector<std::uint32_t> origins;
  std::string rows;
  const std::size_t size = layouts_[RowKind::tet].size();
  for (const std::uint32_t i : order) {
    tets.push_back(data_.tets[i]);
    origins.push_back(origins_[i]);
    if (size > 0) rows.append(rows_[RowKind::tet], i * size, size);
  }
  data_.tets = std::move(tets);
  origins_ = std::move(origins);
  rows_[RowKind::tet] = std::move(rows);
  is_kept_.assign(origins_.size(), 0);
}

template <class Element>
void OldPart::name(
    const std::vector<Element>& elements,
    std::vector<Named<std::tuple_size_v<decltype(Element::vertices)>>>& named) const {
  for (std::uint32_t i = 0; i < elements.size(); ++i) {
    named.push_back({sorted_ids(ids_, elements[i].vertices), i});
  }
  std::stable_sort(named.begin(), named.end(),
                   [](const auto& a, const auto& b) { return a.ids < b.ids; });
}

/// Each tet counts in one part: that of its first vertex.
void OldPart::sum_up(const Parting& parting, std::uint32_t number) {
  Integrals sums(layouts_);
  const std::vector<std::uint32_t> parts = parting.parts_of(data_.points);
  for (std::size_t t = 0; t < data_.tets.size(); ++t) {
    const auto& vertices = data_.tets[t].vertices;
    if (parts[*std::min_element(vertices.begin(), vertices.end())] != number) continue;
    sums.add(corners_of(data_.points, vertices), rows_of_points(t), row(RowKind::tet, t));
  }
  integrals_ = sums.sums();
}

std::uint32_t OldPart::tet_of(std::uint64_t number) const {
  const auto found = std::lower_bound(origins_.begin(), origins_.end(), number);
  if (found == origins_.end() || *found != number) fail_to_fit();
  return static_cast<std::uint32_t>(found - origins_.begin());
}

void OldPart::find_changed() {
  std::vector<std::uint32_t> changed;
  for (std::uint32_t t = 0; t < is_kept_.size(); ++t) {
    if (is_kept_[t] == 0) changed.push_back(t);
  }
  bodies_.emplace(data_, changed);
  changed_.emplace(data_, *bodies_, std::move(changed));
}

void OldPart::learn(const Questions& questions) {
  if (bodies_->count() <= 1) return;
  for (const Questions::AtPoint& asked : questions.new_points) {
    if (asked.kin.is_known != 0) kin_.try_emplace(asked.id, asked.kin);
  }
}

/// As far as that is in this part of space.
face::Origin OldPart::origin_of(const Questions::Kin& kin) const {
  face::Origin origin;
  if (kin.is_known == 0) return origin;
  const auto tet = std::lower_bound(origins_.begin(), origins_.end(), kin.tet);
  if (tet != origins_.end() && *tet == kin.tet) {
    origin.tet = static_cast<std::uint32_t>(tet - origins_.begin());
  }
  for (const VertexId id : kin.points) {
    const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
    if (found == ids_.end() || *found != id) continue;
    origin.points.push_back(static_cast<std::uint32_t>(found - ids_.begin()));
  }
  if (bodies_->count() > 1) bodies_->common(origin.points, kin.label, origin.bodies);
  return origin;
}

/// A body that hangs together elsewhere is several here: where those that are known do not hold the
/// place, others of the label are asked, too.
face::TetPlace OldPart::find(const Questions::AtPoint& asked) const {
  constexpr double kRounding = 1e-9;
  const auto least = [](const face::TetPlace& place) {
    return *std::min_element(place.weights.begin(), place.weights.end());
  };
  const Point point = to_point(asked.point);
  const auto known = asked.kin.is_known != 0 ? kin_.end() : kin_.find(asked.id);
  const Questions::Kin& kin = known == kin_.end() ? asked.kin : known->second;
  const face::Origin origin = origin_of(kin);
  const face::TetPlace place = changed_->find(point, origin);
  if (origin.bodies.empty() || least(place) >= -kRounding) return place;
  face::Origin wider;
  bodies_->common({}, kin.label, wider.bodies);
  const face::TetPlace other = changed_->find(point, wider);
  return least(other) >= 0 ? other : place;
}

void OldPart::answer(const Questions& questions, Answers& answers) {
  for (const Questions::OfNumber& asked : questions.old_points) {
    const auto found = std::lower_bound(ids_.begin(), ids_.end(), asked.number);
    if (found == ids_.end() || *found != asked.number) fail_to_fit();
    add(RowKind::point, asked.place, row(RowKind::point, found - ids_.begin()), answers);
  }
  for (const Questions::OfNumber& asked : questions.old_tets) {
    add(RowKind::tet, asked.place, row(RowKind::tet, tet_of(asked.number)), answers);
  }
  const bool must_find = !questions.new_points.empty() || !questions.new_tets.empty();
  if (must_find && changed_->is_empty()) fail_to_fit();
  std::string made(layouts_[RowKind::point].size(), '\0');
  for (const Questions::AtPoint& asked : questions.new_points) {
    const face::TetPlace place = find(asked);
    layouts_[RowKind::point].interpolate(rows_of_points(place.tet), place.weights, made.data());
    add(RowKind::point, asked.place, made.data(), answers);
  }
  for (const Questions::AtPoint& asked : questions.new_tets) {
    add(RowKind::tet, asked.place, row(RowKind::tet, find(asked).tet), answers);
  }
  answer_named(RowKind::triangle, questions.triangles, triangles_, answers);
  answer_named(RowKind::edge, questions.edges, edges_, answers);
  answer_shares(questions.shares, answers);
}

/// An element that the file names twice is asked for twice.
template <std::size_t N>
void OldPart::answer_named(RowKind kind, const std::vector<Questions::OfIds<N>>& asked,
                           std::vector<Named<N>>& named, Answers& answers) const {
  for (const auto& [ids, place] : asked) {
    auto found = std::lower_bound(named.begin(), named.end(), ids,
                                  [](const Named<N>& a, const auto& b) { return a.ids < b; });
    while (found != named.end() && found->ids == ids && found->is_taken) ++found;
    if (found == named.end() || found->ids != ids) fail_to_fit();
    found->is_taken = true;
    add(kind, place, row(kind, found->row), answers);
  }
}

void OldPart::answer_shares(const std::vector<Questions::OfTet>& asked, Answers& answers) const {
  for (const auto& [corners, place, kin] : asked) {
    std::array<Point, 4> tet;
    for (std::size_t i = 0; i < 4; ++i) tet[i] = to_point(corners[i]);
    for (const std::uint32_t old : changed_->near(tet, origin_of(kin).bodies)) {
      const double volume = face::overlap(tet, corners_of(data_.points, data_.tets[old].vertices));
      if (!(volume > 0)) continue;  // their boxes meet, no more
      answers.shares.push_back({place, origins_[old], volume});
      answers.share_rows.append(row(RowKind::tet, old), layouts_[RowKind::tet].size());
    }
  }
}

}  // namespace tetmend::pieces
