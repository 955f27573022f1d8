// SPDX-License-Identifier: MIT
#include "pieces/carried_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "face/carry.h"
#include "face/overlap.h"
#include "face/tet_locator.h"
#include "kernel/error.h"
#include "kernel/geometry.h"
#include "pieces/bytes.h"
#include "pieces/post.h"

namespace tetmend::pieces {

namespace {

[[noreturn]] void fail_to_fit() {
  throw Error("pieces do not fit: the file has no row for one of their elements");
}

std::string rows_name(RowKind kind, std::size_t part) {
  return fmt::format("rows-{}-{}", static_cast<int>(kind), part);
}

template <std::size_t N>
std::array<VertexId, N> sorted_ids(const std::vector<VertexId>& ids,
                                   const std::array<std::uint32_t, N>& vertices) {
  std::array<VertexId, N> sorted;
  for (std::size_t i = 0; i < N; ++i) sorted[i] = ids[vertices[i]];
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::array<Point, 4> corners_of(const std::vector<Point>& points,
                                const std::array<std::uint32_t, 4>& vertices) {
  std::array<Point, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = points[vertices[i]];
  return corners;
}

Eigen::AlignedBox3d box_of(const std::array<Point, 4>& corners, double margin) {
  Eigen::AlignedBox3d box;
  for (const Point& corner : corners) box.extend(corner);
  const Point around = Point::Constant(margin);
  return {box.min() - around, box.max() + around};
}

/// Who has a piece.
std::vector<std::uint32_t> owners_of(const DividedMesh& mesh) {
  std::string mine;
  put(std::vector<std::uint64_t>(mesh.own().begin(), mesh.own().end()), mine);
  std::vector<std::uint32_t> owners(mesh.state().stored, 0);
  std::uint32_t rank = 0;
  for (const std::string& from : mesh.ranks().gather(mine)) {
    std::string_view rest = from;
    std::vector<std::uint64_t> own;
    take(rest, own);
    for (const std::uint64_t part : own) owners[part] = rank;
    ++rank;
  }
  return owners;
}

/// What a piece wants to know of a part of space. Places are those in its lists.
struct Questions {
  struct OfNumber {
    std::uint64_t number;
    std::uint64_t place;
  };
  struct AtPoint {
    std::array<double, 3> point;
    std::uint64_t place;
  };
  struct OfTet {
    std::array<std::array<double, 3>, 4> corners;
    std::uint64_t place;
  };
  template <std::size_t N>
  struct OfIds {
    std::array<VertexId, N> ids;
    std::uint64_t place;
  };

  std::vector<OfNumber> old_points, old_tets;  ///< that are as they were
  std::vector<AtPoint> new_points, new_tets;
  std::vector<OfIds<3>> triangles;
  std::vector<OfIds<2>> edges;
  std::vector<std::uint64_t> kept;  ///< old tets that are as they were
  std::vector<OfTet> shares;        ///< what old tets have in common with these

  bool is_empty() const {
    return old_points.empty() && old_tets.empty() && new_points.empty() && new_tets.empty() &&
           triangles.empty() && edges.empty() && kept.empty() && shares.empty();
  }
  std::string bytes() const {
    std::string all;
    put(old_points, all);
    put(old_tets, all);
    put(new_points, all);
    put(new_tets, all);
    put(triangles, all);
    put(edges, all);
    put(kept, all);
    put(shares, all);
    return all;
  }
  explicit Questions(std::string_view all = {}) {
    if (all.empty()) return;
    take(all, old_points);
    take(all, old_tets);
    take(all, new_points);
    take(all, new_tets);
    take(all, triangles);
    take(all, edges);
    take(all, kept);
    take(all, shares);
  }
};

Point to_point(const std::array<double, 3>& p) {
  return {p[0], p[1], p[2]};
}

std::array<double, 3> to_array(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

/// Rows, and where they go.
struct Answers {
  struct Share {
    std::uint64_t place;
    std::uint64_t old_tet;
    double volume;
  };
  ByKind<std::vector<std::uint64_t>> places;
  ByKind<std::string> rows;
  std::vector<Share> shares;
  std::string share_rows;

  bool is_empty() const {
    return shares.empty() && std::all_of(kAllRowKinds.begin(), kAllRowKinds.end(),
                                         [&](RowKind kind) { return places[kind].empty(); });
  }
  std::string bytes() const {
    std::string all;
    for (const RowKind kind : kAllRowKinds) {
      put(places[kind], all);
      put(rows[kind], all);
    }
    put(shares, all);
    put(share_rows, all);
    return all;
  }
  Answers() = default;
  explicit Answers(std::string_view all) {
    for (const RowKind kind : kAllRowKinds) {
      take(all, places[kind]);
      take(all, rows[kind]);
    }
    take(all, shares);
    take(all, share_rows);
  }
};

/// Sums over tets, for each component of each array: of the values, and of their absolute values.
class Integrals {
 public:
  explicit Integrals(const ByKind<RowLayout>& layouts) : layouts_(layouts) {
    for (const RowKind kind : {RowKind::point, RowKind::tet}) {
      for (const DataArray& array : layouts[kind].arrays())
        sums_.resize(sums_.size() + 2 * array.components, 0);
    }
  }

  void add(const std::array<Point, 4>& p, const std::array<const char*, 4>& of_points,
           const char* of_tet) {
    const double volume = std::abs(volume6(p[0], p[1], p[2], p[3])) / 6;
    std::size_t at = 0;
    const auto add_mean = [&](double mean) {
      sums_[at++] += volume * mean;
      sums_[at++] += volume * std::abs(mean);
    };
    for_components([&](RowKind kind, std::size_t array, std::size_t component) {
      if (kind == RowKind::tet) {
        add_mean(layouts_[kind].number(array, component, of_tet));
        return;
      }
      double mean = 0;
      for (const char* const row : of_points) {
        mean += layouts_[kind].number(array, component, row) / 4;
      }
      add_mean(mean);
    });
  }

  const std::vector<double>& sums() const { return sums_; }

  /// Adds up what the parts have, in their order.
  static std::vector<double> add_up(const std::map<std::uint64_t, std::vector<double>>& mine,
                                    std::size_t count, Ranks& ranks) {
    std::string bytes;
    for (const auto& [part, sums] : mine) {
      put(part, bytes);
      put(sums, bytes);
    }
    std::map<std::uint64_t, std::vector<double>> all;
    for (const std::string& from : ranks.gather(bytes)) {
      for (std::string_view rest = from; !rest.empty();) {
        std::uint64_t part = 0;
        take(rest, part);
        take(rest, all[part]);
      }
    }
    std::vector<double> total(count, 0);
    for (const auto& [part, sums] : all) {
      for (std::size_t i = 0; i < count; ++i) total[i] += sums[i];
    }
    return total;
  }

 private:
  template <class Use>
  void for_components(const Use& use) const {
    for (const RowKind kind : {RowKind::point, RowKind::tet}) {
      const std::vector<DataArray>& arrays = layouts_[kind].arrays();
      for (std::size_t i = 0; i < arrays.size(); ++i) {
        for (std::size_t k = 0; k < arrays[i].components; ++k) use(kind, i, k);
      }
    }
  }

  const ByKind<RowLayout>& layouts_;
  std::vector<double> sums_;
};

/// Old tets that meet a part of space, with the rows that there are.
class OldPart {
 public:
  OldPart(const std::vector<std::pair<std::uint64_t, std::string>>& messages,
          const ByKind<RowLayout>& layouts, const Parting& parting, std::uint32_t number);

  void keep(std::uint64_t tet) { is_kept_[tet_of(tet)] = 1; }
  /// Precondition: all that are kept are known.
  void find_changed();
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

  const ByKind<RowLayout>& layouts_;
  std::vector<VertexId> ids_;
  MeshData data_;                       // points and tets, by number in the file
  std::vector<std::uint32_t> origins_;  // of the tets: their numbers
  ByKind<std::string> rows_;
  std::vector<Named<3>> triangles_;
  std::vector<Named<2>> edges_;
  std::vector<char> is_kept_;
  std::optional<face::TetLocator> changed_;
  std::vector<double> integrals_;
};

/// A slice's share for a part.
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
      tets.push_back({tet.vertices, 0});
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
  changed_.emplace(data_, std::move(changed));
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
    const face::TetPlace place = changed_->find(to_point(asked.point));
    layouts_[RowKind::point].interpolate(rows_of_points(place.tet), place.weights, made.data());
    add(RowKind::point, asked.place, made.data(), answers);
  }
  for (const Questions::AtPoint& asked : questions.new_tets) {
    add(RowKind::tet, asked.place, row(RowKind::tet, changed_->find(to_point(asked.point)).tet),
        answers);
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
  for (const auto& [corners, place] : asked) {
    std::array<Point, 4> tet;
    for (std::size_t i = 0; i < 4; ++i) tet[i] = to_point(corners[i]);
    for (const std::uint32_t old : changed_->near(tet)) {
      const double volume = face::overlap(tet, corners_of(data_.points, data_.tets[old].vertices));
      answers.shares.push_back({place, origins_[old], volume});
      answers.share_rows.append(row(RowKind::tet, old), layouts_[RowKind::tet].size());
    }
  }
}

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
  void ask_for_tets(const Parting& parting, const std::vector<std::uint32_t>& parts, double margin,
                    bool asks_for_shares, std::vector<Questions>& questions) const;

  const DividedMesh& mesh_;
  const ByKind<RowLayout>& layouts_;
  const Piece piece_;
  ByKind<std::string> rows_;
  ByKind<std::size_t> filled_{};
  std::vector<Share> shares_;
  std::string share_rows_;
};

std::vector<Questions> NewPart::ask(const Parting& parting, double margin,
                                    bool asks_for_shares) const {
  std::vector<Questions> questions(parting.stretches());
  const std::vector<std::uint32_t> parts = parting.parts_of(std::span(piece_.points));
  for (std::uint32_t v = 0; has(RowKind::point) && v < parts.size(); ++v) {
    Questions& of_part = questions[parts[v]];
    if (is_where_it_was(v)) {
      of_part.old_points.push_back({number(v), v});
    } else {
      of_part.new_points.push_back({to_array(piece_.points[v]), v});
    }
  }
  if (has(RowKind::point) || has(RowKind::tet)) {
    ask_for_tets(parting, parts, margin, asks_for_shares, questions);
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

void NewPart::ask_for_tets(const Parting& parting, const std::vector<std::uint32_t>& parts,
                           double margin, bool asks_for_shares,
                           std::vector<Questions>& questions) const {
  std::vector<Point> centroids;
  std::vector<std::uint64_t> changed;
  for (std::size_t t = 0; t < piece_.tets.size(); ++t) {
    const PieceTet& tet = piece_.tets[t];
    const std::array<Point, 4> corners = corners_of(piece_.points, tet.vertices);
    const std::uint32_t origin = tet.origin & ~PieceTet::kProtected;
    const bool is_old = origin != PieceTet::kNone &&
                        std::all_of(tet.vertices.begin(), tet.vertices.end(),
                                    [&](std::uint32_t v) { return is_where_it_was(v); });
    if (is_old) {
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
    Questions::OfTet asked{{}, t};
    for (std::size_t i = 0; i < 4; ++i) asked.corners[i] = to_array(corners[i]);
    for (const std::uint32_t part : parting.stretches_of(box_of(corners, margin))) {
      questions[part].shares.push_back(asked);
    }
  }
  const std::vector<std::uint32_t> places = parting.parts_of(std::span(centroids));
  for (std::size_t i = 0; i < changed.size(); ++i) {
    questions[places[i]].new_tets.push_back({to_array(centroids[i]), changed[i]});
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
      if (!(shares_[i].volume > 0)) continue;
      rows.emplace_back(share_rows_.data() + shares_[i].row * layout.size(), shares_[i].volume);
      sum += shares_[i].volume;
    }
    for (auto& row : rows) row.second /= sum;
    if (rows.empty()) continue;
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

/// One call of CarriedRows().
class RowCarrier {
 public:
  RowCarrier(const RowSource& source, const DividedMesh& mesh, std::size_t tets_of_slice,
             std::size_t parts, Shelf& shelf, std::span<const std::string> conserve)
      : source_(source),
        mesh_(mesh),
        ranks_(mesh.ranks()),
        shelf_(shelf),
        layouts_(source.row_layouts()),
        parting_(mesh.cut(parts, 0)),
        margin_(kMargin * parting_.side),
        tets_of_slice_(tets_of_slice),
        slices_(source.slice_count(tets_of_slice, ranks_)),
        old_(shelf, ranks_, pieces::owners_of(parting_, ranks_.count()), "old"),
        questions_(shelf, ranks_, pieces::owners_of(parting_, ranks_.count()), "questions"),
        names_(shelf, ranks_, owners_of_slices(slices_, ranks_.count()), "names"),
        answers_(shelf, ranks_, owners_of(mesh), "answers") {
    const std::vector<DataArray>& arrays = layouts_[RowKind::tet].arrays();
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      if (std::find(conserve.begin(), conserve.end(), arrays[i].name) != conserve.end()) {
        conserved_.push_back(i);
      }
    }
  }

  void run() {
    send_old();
    ask();
    answer_for_parts();
    answer_for_vertices();
    receive();
  }
  std::vector<CarriedArray> report();

 private:
  /// By rounding a place may lie outside of the tets: so little, by the side of the mesh.
  static constexpr double kMargin = 1e-9;

  /// Each has a range.
  static std::vector<std::uint32_t> owners_of_slices(std::uint64_t slices, std::uint64_t ranks) {
    std::vector<std::uint32_t> owners;
    for (std::uint64_t rank = 0; rank < ranks; ++rank) {
      const std::uint64_t size = FileRange::of_slice(slices, rank, ranks).size();
      owners.insert(owners.end(), size, static_cast<std::uint32_t>(rank));
    }
    return owners;
  }
  bool has(RowKind kind) const { return layouts_[kind].size() > 0; }
  /// Places are looked up in old tets.
  bool needs_tets() const { return has(RowKind::point) || has(RowKind::tet); }
  /// Rows of something besides vertices.
  bool needs_parts() const { return needs_tets() || has(RowKind::triangle) || has(RowKind::edge); }
  static std::string name_of_slice(std::uint64_t number) {
    return fmt::format("vertices-{}", number);
  }

  void send_old();
  void send_slice(std::uint64_t number, const RowSlice& slice);
  void keep_vertices(std::uint64_t number, const RowSlice& slice);
  void ask();
  void answer_for_parts();
  void answer_for_vertices();
  void receive();

  const RowSource& source_;
  const DividedMesh& mesh_;
  Ranks& ranks_;
  Shelf& shelf_;
  const ByKind<RowLayout> layouts_;
  const Parting parting_;
  const double margin_;
  const std::size_t tets_of_slice_;
  const std::uint64_t slices_;
  std::vector<std::size_t> conserved_;
  Post old_, questions_;                                         // by part of space
  Post names_;                                                   // by slice
  Post answers_;                                                 // by stored piece
  std::map<std::uint64_t, std::vector<double>> before_, after_;  // integrals by part
};

void RowCarrier::send_old() {
  // A slice at a time on each rank, as far as it has one.
  const std::uint64_t most = (slices_ + ranks_.count() - 1) / ranks_.count();
  std::uint64_t sent = 0;
  source_.for_row_slices(tets_of_slice_, ranks_, [&](std::uint64_t number, const RowSlice& slice) {
    if (needs_parts()) send_slice(number, slice);
    if (has(RowKind::vertex)) keep_vertices(number, slice);
    old_.deliver();
    ++sent;
  });
  for (; sent < most; ++sent) old_.deliver();
}

void RowCarrier::keep_vertices(std::uint64_t number, const RowSlice& slice) {
  const std::size_t size = layouts_[RowKind::vertex].size();
  std::string rows;
  for (std::size_t v = 0; v < slice.piece.ids.size(); ++v) {
    if (is_own(slice.piece.marks[v])) rows.append(slice.rows[RowKind::vertex], v * size, size);
  }
  shelf_.put(name_of_slice(number), std::move(rows));
}

/// A tet goes to all parts that its box meets, all else to one.
void RowCarrier::send_slice(std::uint64_t number, const RowSlice& slice) {
  const Piece& piece = slice.piece;
  const std::vector<std::uint32_t> parts = parting_.parts_of(std::span(piece.points));
  std::vector<Extract> shares(parting_.stretches());
  const auto wanted = [&](std::uint32_t part) -> std::vector<char>& {
    std::vector<char>& marks = shares[part].wanted;
    if (marks.empty()) marks.assign(piece.ids.size(), 0);
    return marks;
  };
  const auto add = [&](std::uint32_t part, std::uint32_t i, const auto& element, auto list) {
    std::vector<char>& vertices = wanted(part);
    for (const std::uint32_t v : element.vertices) vertices[v] = 1;
    (shares[part].*list).push_back(i);
  };
  const auto home = [&](const auto& element) {
    return parts[*std::min_element(element.vertices.begin(), element.vertices.end())];
  };
  for (std::size_t v = 0; v < piece.ids.size(); ++v) {
    if (is_own(piece.marks[v])) wanted(parts[v])[v] = 1;
  }
  for (std::uint32_t t = 0; needs_tets() && t < piece.tets.size(); ++t) {
    const PieceTet& tet = piece.tets[t];
    const std::array<Point, 4> corners = corners_of(piece.points, tet.vertices);
    for (const std::uint32_t part : parting_.stretches_of(box_of(corners, margin_))) {
      add(part, t, tet, &Extract::tets);
    }
  }
  for (std::uint32_t i = 0; i < piece.triangles.size(); ++i) {
    add(home(piece.triangles[i]), i, piece.triangles[i], &Extract::triangles);
  }
  for (std::uint32_t i = 0; i < piece.edges.size(); ++i) {
    add(home(piece.edges[i]), i, piece.edges[i], &Extract::edges);
  }
  for (std::uint32_t part = 0; part < shares.size(); ++part) {
    if (!shares[part].wanted.empty()) {
      old_.send(number, part, to_message(slice, shares[part], layouts_));
    }
  }
}

void RowCarrier::ask() {
  std::size_t next = 0;
  const auto ask_one = [&](std::size_t part) {
    const NewPart piece(mesh_, part, layouts_);
    if (needs_parts()) {
      const std::vector<Questions> all = piece.ask(parting_, margin_, !conserved_.empty());
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!all[i].is_empty()) questions_.send(part, i, all[i].bytes());
      }
    }
    if (!has(RowKind::vertex)) return;
    const auto names = piece.ask_for_vertices(slices_);
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::string bytes;
      put(names[i], bytes);
      if (!names[i].empty()) names_.send(part, i, bytes);
    }
  };
  do {
    if (next < mesh_.own().size()) ask_one(mesh_.own()[next++]);
    questions_.deliver();
    names_.deliver();
  } while (ranks_.any(next < mesh_.own().size()));
}

void RowCarrier::answer_for_parts() {
  if (!needs_parts()) return;
  answers_.send_by_address(questions_, [&](std::size_t part) {
    const auto number = static_cast<std::uint32_t>(part);
    OldPart old(old_.take(part), layouts_, parting_, number);
    before_[part] = old.integrals();
    const auto messages = questions_.take(part);
    for (const auto& message : messages) {
      for (const std::uint64_t tet : Questions(message.second).kept) old.keep(tet);
    }
    if (needs_tets()) old.find_changed();
    for (const auto& message : messages) {
      Answers answers;
      old.answer(Questions(message.second), answers);
      if (!answers.is_empty()) answers_.send(part, message.first, answers.bytes());
    }
  });
}

void RowCarrier::answer_for_vertices() {
  if (!has(RowKind::vertex)) return;
  const std::size_t size = layouts_[RowKind::vertex].size();
  const std::uint64_t vertices = mesh_.state().in_file;
  answers_.send_by_address(names_, [&](std::size_t slice) {
    const std::uint64_t first = FileRange::of_slice(vertices, slice, slices_).begin;
    const std::string rows = shelf_.read(name_of_slice(slice));
    shelf_.remove(name_of_slice(slice));
    for (const auto& [part, message] : names_.take(slice)) {
      std::string_view rest = message;
      std::vector<Questions::OfNumber> asked;
      take(rest, asked);
      Answers answers;
      for (const Questions::OfNumber& each : asked) {
        if ((each.number - first + 1) * size > rows.size()) fail_to_fit();
        answers.places[RowKind::vertex].push_back(each.place);
        answers.rows[RowKind::vertex].append(rows, (each.number - first) * size, size);
      }
      answers_.send(questions_.addresses() + slice, part, answers.bytes());
    }
  });
}

void RowCarrier::receive() {
  for (const std::size_t part : mesh_.own()) {
    NewPart made(mesh_, part, layouts_);
    made.make_room(source_.row_of_new_vertex());
    for (const auto& message : answers_.take(part)) made.take(Answers(message.second));
    made.check();
    made.average(conserved_);
    after_[part] = made.integrals();
    for (const RowKind kind : kAllRowKinds) shelf_.put(rows_name(kind, part), made.rows(kind));
  }
}

std::vector<CarriedArray> RowCarrier::report() {
  const std::size_t count = Integrals(layouts_).sums().size();
  const std::vector<double> before = Integrals::add_up(before_, count, ranks_);
  const std::vector<double> after = Integrals::add_up(after_, count, ranks_);
  std::vector<CarriedArray> report;
  std::size_t at = 0;
  for (const RowKind kind : {RowKind::point, RowKind::tet}) {
    const std::vector<DataArray>& arrays = layouts_[kind].arrays();
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      const bool is_conserved =
          kind == RowKind::tet &&
          std::find(conserved_.begin(), conserved_.end(), i) != conserved_.end();
      std::vector<face::ComponentIntegral> integrals;
      for (std::size_t k = 0; k < arrays[i].components; ++k, at += 2) {
        integrals.push_back({before[at], before[at + 1], after[at]});
      }
      report.push_back(
          face::carried_array(arrays[i], kind == RowKind::point, is_conserved, integrals));
    }
  }
  return report;
}

}  // namespace

CarriedRows::CarriedRows(const RowSource& source, const DividedMesh& mesh,
                         std::size_t tets_of_slice, std::size_t parts,
                         std::span<const std::string> conserve, Shelf& shelf)
    : layouts_(source.row_layouts()), shelf_(shelf) {
  RowCarrier carrier(source, mesh, tets_of_slice, parts, shelf, conserve);
  carrier.run();
  report_ = carrier.report();
}

std::string CarriedRows::column(RowKind kind, std::size_t part, std::size_t array,
                                std::size_t begin, std::size_t end) const {
  const RowLayout& layout = layouts_[kind];
  const std::string rows =
      shelf_.read(rows_name(kind, part), begin * layout.size(), (end - begin) * layout.size());
  std::string bytes;
  bytes.reserve((end - begin) * layout.width(array));
  layout.append_column(array, rows, bytes);
  return bytes;
}

}  // namespace tetmend::pieces
