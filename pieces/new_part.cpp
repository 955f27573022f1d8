// SPDX-License-Identifier: MIT
#include "pieces/new_part.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "face/bodies.h"
#include "pieces/row_source.h"

namespace tetmend::pieces {

std::vector<Questions> NewPart::ask(const Parting& parting, double margin,
                                    bool asks_for_shares) const {
  std::vector<Questions> questions(parting.stretches());
  const std::vector<std::uint32_t> parts = parting.parts_of(std::span(piece_.points));
  if (has(RowKind::point) || has(RowKind::tet)) {
    const std::vector<std::uint32_t> changed = changed_tets();
    const std::vector<Questions::Kin> kin = kin_of(changed);
    ask_for_points(parts, changed, kin, questions);
    ask_for_tets(parting, parts, margin, asks_for_shares, kin, questions);
  }
  for (std::size_t i = 0; has(RowKind::triangle) && i < piece_.triangles.size(); ++i) {
    const auto& element = piece_.triangles[i];
    questions[home(element, parts)].triangles.push_back({numbers(element), i});
  }
  for (std::size_t i = 0; has(RowKind::edge) && i < piece_.edges.size(); ++i) {
    const auto& element = piece_.edges[i];
    questions[home(element, parts)].edges.push_back({numbers(element), i});
  }
  return questions;
}

bool NewPart::is_as_it_was(const PieceTet& tet) const {
  return (tet.origin & ~PieceTet::kProtected) != PieceTet::kNone &&
         std::all_of(tet.vertices.begin(), tet.vertices.end(),
                     [&](std::uint32_t v) { return is_where_it_was(v); });
}

std::vector<std::uint32_t> NewPart::changed_tets() const {
  std::vector<std::uint32_t> changed;
  for (std::uint32_t t = 0; t < piece_.tets.size(); ++t) {
    if (!is_as_it_was(piece_.tets[t])) changed.push_back(t);
  }
  return changed;
}

std::vector<Questions::Kin> NewPart::kin_of(std::span<const std::uint32_t> which) const {
  std::vector<MeshData::Tet> tets;
  for (const std::uint32_t t : which)
    tets.push_back({piece_.tets[t].vertices, piece_.tets[t].label});
  std::vector<std::uint32_t> all(tets.size());
  std::iota(all.begin(), all.end(), 0U);
  std::vector<std::uint32_t> anchors(piece_.ids.size(), face::Bodies::kNone);
  for (std::uint32_t v = 0; v < anchors.size(); ++v) {
    if (is_old(v)) anchors[v] = v;
  }
  face::spread_anchors(
      tets, all, [](std::uint32_t, Label) { return true; }, anchors);
  std::vector<Questions::Kin> kin;
  for (const MeshData::Tet& tet : tets) {
    Questions::Kin& of_tet = kin.emplace_back();
    of_tet.label = tet.label;
    of_tet.is_known = 1;
    const std::uint32_t origin = piece_.tets[which[kin.size() - 1]].origin & ~PieceTet::kProtected;
    if (origin != PieceTet::kNone) of_tet.tet = origin;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t anchor = anchors[tet.vertices[i]];
      if (anchor != face::Bodies::kNone) of_tet.points[i] = number(anchor);
    }
  }
  return kin;
}

void NewPart::ask_for_points(const std::vector<std::uint32_t>& parts,
                             std::span<const std::uint32_t> changed,
                             std::span<const Questions::Kin> kin,
                             std::vector<Questions>& questions) const {
  if (!has(RowKind::point)) return;
  std::vector<std::uint32_t> tet_at(parts.size(), face::Bodies::kNone);  // place in `changed`
  for (std::size_t i = changed.size(); i-- > 0;) {
    for (const std::uint32_t v : piece_.tets[changed[i]].vertices) {
      tet_at[v] = static_cast<std::uint32_t>(i);
    }
  }
  for (std::uint32_t v = 0; v < parts.size(); ++v) {
    Questions& of_part = questions[parts[v]];
    if (is_where_it_was(v)) {
      of_part.old_points.push_back({number(v), v});
      continue;
    }
    const bool is_known = tet_at[v] != face::Bodies::kNone;
    of_part.new_points.push_back({to_array(piece_.points[v]), v, piece_.ids[v],
                                  is_known ? kin[tet_at[v]] : Questions::Kin()});
  }
}

void NewPart::ask_for_tets(const Parting& parting, const std::vector<std::uint32_t>& parts,
                           double margin, bool asks_for_shares, std::span<const Questions::Kin> kin,
                           std::vector<Questions>& questions) const {
  std::vector<Point> centroids;
  std::vector<std::uint64_t> changed;
  for (std::size_t t = 0; t < piece_.tets.size(); ++t) {
    const PieceTet& tet = piece_.tets[t];
    const std::array<Point, 4> corners = corners_of(piece_.points, tet.vertices);
    if (is_as_it_was(tet)) {
      const std::uint32_t origin = tet.origin & ~PieceTet::kProtected;
      questions[home(tet, parts)].old_tets.push_back({origin, t});
      for (const std::uint32_t part : parting.stretches_of(box_of(corners, margin))) {
        questions[part].kept.push_back(origin);
      }
      continue;
    }
    centroids.push_back((Point(Point::Zero()) + corners[0] + corners[1] + corners[2] + corners[3]) /
                        4);
    changed.push_back(t);
    if (!asks_for_shares) continue;
    Questions::OfTet asked{{}, t, kin[changed.size() - 1]};
    for (std::size_t i = 0; i < 4; ++i) asked.corners[i] = to_array(corners[i]);
    for (const std::uint32_t part : parting.stretches_of(box_of(corners, margin))) {
      questions[part].shares.push_back(asked);
    }
  }
  const std::vector<std::uint32_t> places = parting.parts_of(std::span(centroids));
  for (std::size_t i = 0; i < changed.size(); ++i) {
    questions[places[i]].new_tets.push_back({to_array(centroids[i]), changed[i], 0, kin[i]});
  }
}

std::vector<std::vector<Questions::OfNumber>> NewPart::ask_for_vertices(
    std::uint64_t slices) const {
  std::vector<std::vector<Questions::OfNumber>> questions(slices);
  const std::uint64_t vertices = mesh_.state().in_file;
  std::uint64_t slice = 0;  // numbers ascend
  for (std::uint32_t v = 0; v < piece_.ids.size(); ++v) {
    if (!is_old(v)) break;
    while (!FileRange::of_slice(vertices, slice, slices).has(number(v))) ++slice;
    questions[slice].push_back({number(v), v});
  }
  return questions;
}

void NewPart::make_room(const std::string& row_of_new_vertex) {
  for (const RowKind kind : kAllRowKinds) rows_[kind].resize(count(kind) * layouts_[kind].size());
  if (!has(RowKind::vertex)) return;
  for (std::size_t v = 0; v < piece_.ids.size(); ++v) {
    if (is_old(v)) continue;
    rows_[RowKind::vertex].replace(v * row_of_new_vertex.size(), row_of_new_vertex.size(),
                                   row_of_new_vertex);
    ++filled_[RowKind::vertex];
  }
}

void NewPart::take(const Answers& answers) {
  for (const RowKind kind : kAllRowKinds) {
    const std::size_t size = layouts_[kind].size();
    for (std::size_t i = 0; i < answers.places[kind].size(); ++i) {
      std::copy_n(answers.rows[kind].data() + i * size, size,
                  rows_[kind].data() + answers.places[kind][i] * size);
      ++filled_[kind];
    }
  }
  const std::size_t size = layouts_[RowKind::tet].size();
  for (const Answers::Share& share : answers.shares) {
    shares_.push_back({share.place, share.old_tet, share.volume, shares_.size()});
  }
  share_rows_ += answers.share_rows;
  if (share_rows_.size() != shares_.size() * size) fail_to_fit();
}

void NewPart::check() const {
  for (const RowKind kind : kAllRowKinds) {
    if (has(kind) && filled_[kind] != count(kind)) fail_to_fit();
  }
}

/// Old tets come from each part that has them, with the same volume.
void NewPart::average(const std::vector<std::size_t>& arrays) {
  const RowLayout& layout = layouts_[RowKind::tet];
  const auto key = [](const Share& share) { return std::pair(share.place, share.old_tet); };
  std::sort(shares_.begin(), shares_.end(),
            [&](const Share& a, const Share& b) { return key(a) < key(b); });
  shares_.erase(std::unique(shares_.begin(), shares_.end(),
                            [&](const Share& a, const Share& b) { return key(a) == key(b); }),
                shares_.end());
  for (std::size_t i = 0; i < shares_.size();) {
    const std::uint64_t place = shares_[i].place;
    std::vector<std::pair<const char*, double>> rows;
    double sum = 0;
    for (; i < shares_.size() && shares_[i].place == place; ++i) {
      rows.emplace_back(share_rows_.data() + shares_[i].row * layout.size(), shares_[i].volume);
      sum += shares_[i].volume;
    }
    for (auto& row : rows) row.second /= sum;
    for (const std::size_t array : arrays) {
      layout.average(array, rows, rows_[RowKind::tet].data() + place * layout.size());
    }
  }
}

std::vector<double> NewPart::integrals() const {
  Integrals sums(layouts_);
  const auto row = [&](RowKind kind, std::size_t i) {
    return rows_[kind].data() + i * layouts_[kind].size();
  };
  for (std::size_t t = 0; t < piece_.tets.size(); ++t) {
    const auto& vertices = piece_.tets[t].vertices;
    std::array<const char*, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) rows[i] = row(RowKind::point, vertices[i]);
    sums.add(corners_of(piece_.points, vertices), rows, row(RowKind::tet, t));
  }
  return sums.sums();
}

}  // namespace tetmend::pieces
