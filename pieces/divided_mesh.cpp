// SPDX-License-Identifier: MIT
//   stored piece -> the parts of each tet's vertices -> a message for each part -> gathered piece
#include "pieces/divided_mesh.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "pieces/bytes.h"

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
    share_out(piece.surface, &Share::surface);
    share_out(piece.lines, &Share::lines);
    for (std::uint32_t v = 0; v < parts_.size(); ++v) {
      if (is_own(piece.marks[v])) shares_[parts_[v]].vertices.push_back(v);
    }
  }

  /// Empty: none.
  std::string message(std::size_t part) {
    Share& share = shares_[part];
    if (share.tets.empty() && share.vertices.empty() && share.triangles.empty() &&
        share.edges.empty() && share.surface.empty() && share.lines.empty()) {
      return {};
    }
    Extract what;
    what.wanted.assign(piece_.ids.size(), 0);
    for (const std::uint32_t v : share.vertices) what.wanted[v] = 1;
    mark(piece_.tets, share.tets, what.wanted);
    mark(piece_.triangles, share.triangles, what.wanted);
    mark(piece_.edges, share.edges, what.wanted);
    mark(piece_.surface, share.surface, what.wanted);
    mark(piece_.lines, share.lines, what.wanted);
    what.tets = std::move(share.tets);
    what.triangles = std::move(share.triangles);
    what.edges = std::move(share.edges);
    what.surface = std::move(share.surface);
    what.lines = std::move(share.lines);
    std::string bytes;
    append(extract(piece_, what), bytes);
    return bytes;
  }

 private:
  struct Share {
    std::vector<std::uint32_t> vertices, tets, triangles, edges, surface, lines;
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

void append(const DivisionState& state, std::string& bytes) {
  const auto put_point = [&](const Point& p) {
    for (const double x : p) put(x, bytes);
  };
  put_point(state.low);
  put_point(state.high);
  put(state.first_id, bytes);
  put(state.in_file, bytes);
  put(state.next_id, bytes);
  put(state.stored, bytes);
  put(state.first_added, bytes);
  put_point(state.parting.low);
  put(state.parting.side, bytes);
  put(state.parting.shift, bytes);
  put(state.parting.cuts, bytes);
  put(std::uint64_t{state.parting.zones.balls().size()}, bytes);
  for (const Ball& ball : state.parting.zones.balls()) {
    put_point(ball.centre);
    put(ball.radius, bytes);
    put(ball.zone, bytes);
    put(ball.cluster, bytes);
    put(ball.is_worst, bytes);
  }
}

DivisionState take_state(std::string_view& bytes) {
  DivisionState state;
  const auto take_point = [&](Point& p) {
    for (double& x : p) take(bytes, x);
  };
  take_point(state.low);
  take_point(state.high);
  take(bytes, state.first_id);
  take(bytes, state.in_file);
  take(bytes, state.next_id);
  take(bytes, state.stored);
  take(bytes, state.first_added);
  take_point(state.parting.low);
  take(bytes, state.parting.side);
  take(bytes, state.parting.shift);
  take(bytes, state.parting.cuts);
  std::uint64_t count = 0;
  take(bytes, count);
  std::vector<Ball> balls;
  for (std::uint64_t i = 0; i < count; ++i) {
    Ball& ball = balls.emplace_back();
    take_point(ball.centre);
    take(bytes, ball.radius);
    take(bytes, ball.zone);
    take(bytes, ball.cluster);
    take(bytes, ball.is_worst);
  }
  state.parting.zones = ZoneMap(std::move(balls));
  return state;
}

std::vector<std::uint32_t> owners_of(const Parting& parting, std::size_t ranks) {
  const std::size_t stretches = parting.stretches();
  std::vector<std::uint32_t> owners(parting.parts());
  std::vector<std::size_t> load(ranks, 0);
  for (std::size_t part = 0; part < stretches; ++part) {
    owners[part] = static_cast<std::uint32_t>(part * ranks / stretches);
  }
  std::vector<std::size_t> balls(parting.zones.count(), 0);
  for (const Ball& ball : parting.zones.balls()) ++balls[ball.zone];
  std::vector<std::size_t> largest_first(balls.size());
  std::iota(largest_first.begin(), largest_first.end(), std::size_t{0});
  std::stable_sort(largest_first.begin(), largest_first.end(),
                   [&](std::size_t a, std::size_t b) { return balls[a] > balls[b]; });
  for (const std::size_t zone : largest_first) {
    const auto least = std::min_element(load.begin(), load.end());
    *least += balls[zone];
    owners[stretches + zone] = static_cast<std::uint32_t>(least - load.begin());
  }
  return owners;
}

DividedMesh::DividedMesh(Shelf& shelf, Ranks& ranks, DivisionState state)
    : shelf_(&shelf), ranks_(ranks), state_(std::move(state)) {
  if (state_.stored == 0) {
    own_those_of(owners_of(state_.parting, ranks.count()));
    return;
  }
  std::vector<std::uint32_t> owners(state_.stored);
  for (std::size_t part = 0; part < owners.size(); ++part) {
    owners[part] = static_cast<std::uint32_t>(part * ranks.count() / owners.size());
  }
  own_those_of(owners);
}

void DividedMesh::own_those_of(const std::vector<std::uint32_t>& owners) {
  own_.clear();
  for (std::size_t part = 0; part < owners.size(); ++part) {
    if (owners[part] == ranks_.number()) own_.push_back(part);
  }
}

void DividedMesh::add_slice(std::size_t number, Piece slice) {
  if (marker_) marker_(slice);
  for (const Point& p : slice.points) {
    if (!std::exchange(has_box_, true)) state_.low = state_.high = p;
    state_.low = state_.low.cwiseMin(p).eval();
    state_.high = state_.high.cwiseMax(p).eval();
  }
  for (VertexId& id : slice.ids) id += state_.first_id;
  store(number, slice);
  own_.push_back(number);
}

void DividedMesh::end_slices() {
  struct Slices {
    std::uint64_t count;
    std::uint64_t has_box;
    std::array<double, 6> box;
  };
  Slices mine{own_.size(), has_box_ ? 1U : 0U, {}};
  for (Eigen::Index k = 0; k < 3; ++k) {
    mine.box[static_cast<std::size_t>(k)] = state_.low[k];
    mine.box[static_cast<std::size_t>(k) + 3] = state_.high[k];
  }
  std::string bytes;
  put(mine, bytes);
  state_.stored = 0;
  has_box_ = false;
  for (const std::string& from : ranks_.gather(bytes)) {
    std::string_view rest = from;
    Slices other{};
    take(rest, other);
    state_.stored += other.count;
    if (other.has_box == 0) continue;
    const Point low(other.box[0], other.box[1], other.box[2]);
    const Point high(other.box[3], other.box[4], other.box[5]);
    const bool is_first = !std::exchange(has_box_, true);
    state_.low = is_first ? low : state_.low.cwiseMin(low).eval();
    state_.high = is_first ? high : state_.high.cwiseMax(high).eval();
  }
  state_.first_added.assign(state_.stored, state_.next_id);
}

Parting DividedMesh::make_parting(std::size_t pieces, unsigned shift, ZoneMap zones) const {
  const double side = (state_.high - state_.low).maxCoeff();
  Parting parting{state_.low, side, shift, {0}, std::move(zones)};
  if (pieces == 1) return parting;
  const HilbertCurve curve = shifted_curve(state_.low, side, shift);
  KeyHistogram histogram;
  const auto count_all = [&] {
    for (const std::size_t part : own_) {
      const Piece piece = stored_vertices(part);
      for (std::size_t v = 0; v < piece.ids.size(); ++v) {
        if (is_own(piece.marks[v])) histogram.count(curve.key(piece.points[v]));
      }
    }
    ranks_.add(histogram.counts());
  };
  count_all();
  histogram.refine(pieces);
  count_all();
  parting.cuts = histogram.cuts();
  return parting;
}

std::vector<std::int64_t> DividedMesh::count_vertices(const ZoneMap& zones) const {
  std::vector<std::int64_t> counts(zones.balls().size() + 1, 0);
  for (const std::size_t part : own_) {
    const Piece piece = stored_vertices(part);
    std::vector<Point> points;
    for (std::size_t v = 0; v < piece.ids.size(); ++v) {
      if (is_own(piece.marks[v])) points.push_back(piece.points[v]);
    }
    zones.count(points, std::span(counts).first(zones.balls().size()));
    counts.back() += static_cast<std::int64_t>(points.size());
  }
  ranks_.add(counts);
  return counts;
}

/// Of all ranks: how many pieces one has at most.
std::size_t DividedMesh::most_own() const {
  std::string mine;
  put(std::uint64_t{own_.size()}, mine);
  std::uint64_t most = 0;
  for (const std::string& from : ranks_.gather(mine)) {
    std::string_view rest = from;
    std::uint64_t count = 0;
    take(rest, count);
    most = std::max(most, count);
  }
  return most;
}

/// All ranks send one piece at a time: so memory holds the messages of few.
void DividedMesh::divide(std::size_t pieces, unsigned shift, ZoneMap zones, Shelf* next) {
  const auto start = std::chrono::steady_clock::now();
  traffic_.emplace_back();
  state_.parting = make_parting(pieces, shift, std::move(zones));
  Shelf& to = next == nullptr ? *shelf_ : *next;
  const std::vector<std::uint32_t> owners = owners_of(state_.parting, ranks_.count());
  for (std::size_t part = 0; part < parts(); ++part) to.remove(gathered_name(part));
  const std::size_t rounds = most_own();
  for (std::size_t round = 0; round < rounds; ++round) {
    std::vector<std::string> messages(ranks_.count());
    if (round < own_.size()) {
      messages = send(own_[round], owners, to);
      if (next == nullptr) shelf_->remove(stored_name(own_[round]));
    }
    if (ranks_.count() == 1) continue;
    for (const std::string& from : ranks_.exchange(std::move(messages))) {
      traffic_.back().received += from.size();
      keep(from, to);
    }
  }
  shelf_ = &to;
  own_those_of(owners);
  state_.stored = 0;
  state_.first_added.clear();
  traffic_.back().seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// What is for this rank goes to the shelf, the rest is returned, by rank.
std::vector<std::string> DividedMesh::send(std::size_t part,
                                           const std::vector<std::uint32_t>& owners, Shelf& next) {
  std::vector<std::string> to(ranks_.count());
  const Piece piece = stored(part);
  traffic_.back().tets += piece.tets.size();
  Messages messages(piece, state_.parting);
  for (std::size_t target = 0; target < parts(); ++target) {
    const std::string bytes = messages.message(target);
    if (bytes.empty()) continue;
    std::string head;
    put(std::uint64_t{part}, head);
    put(std::uint64_t{bytes.size()}, head);
    if (owners[target] == ranks_.number()) {
      next.append(gathered_name(target), head + bytes);
      continue;
    }
    std::string& out = to[owners[target]];
    put(std::uint64_t{target}, out);
    out += head;
    out += bytes;
  }
  return to;
}

void DividedMesh::keep(std::string_view messages, Shelf& next) {
  while (!messages.empty()) {
    std::uint64_t target = 0;
    std::uint64_t source = 0;
    std::uint64_t size = 0;
    take(messages, target);
    const char* begin = messages.data();
    take(messages, source);
    take(messages, size);
    take_front(messages, size);
    const auto length = static_cast<std::size_t>(messages.data() - begin);
    next.append(gathered_name(target), std::string_view(begin, length));
  }
}

/// Messages come in any order; they are taken in that of the pieces that they are of.
Piece DividedMesh::gathered(std::size_t part) const {
  std::vector<std::pair<std::uint64_t, Piece>> messages;
  {
    const std::string bytes = shelf_->read(gathered_name(part));
    for (std::string_view rest = bytes; !rest.empty();) {
      std::uint64_t source = 0;
      std::uint64_t size = 0;
      take(rest, source);
      take(rest, size);
      std::string_view message = take_front(rest, size);
      messages.emplace_back(source, take_piece(message));
    }
  }
  std::sort(messages.begin(), messages.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Piece> pieces;
  for (auto& message : messages) pieces.push_back(std::move(message.second));
  return merge(std::move(pieces));
}

void DividedMesh::store(std::size_t part, const Piece& piece) {
  std::string bytes;
  append(piece, bytes);
  shelf_->put(stored_name(part), bytes);
}

void DividedMesh::remove_gathered(std::size_t part) {
  shelf_->remove(gathered_name(part));
}

void DividedMesh::number_added(const std::vector<std::uint64_t>& added) {
  state_.first_added.clear();
  for (const std::uint64_t count : added) {
    state_.first_added.push_back(state_.next_id);
    state_.next_id += count;
  }
  state_.stored = added.size();
}

/// Vertices that were added to a stored piece get their numbers when it is read.
void DividedMesh::number(std::size_t part, std::vector<VertexId>& ids) const {
  for (VertexId& id : ids) {
    if (id < TaskResult::kNewVertex) continue;
    id = state_.first_added[part] + (id - TaskResult::kNewVertex);
  }
}

Piece DividedMesh::stored(std::size_t part) const {
  const std::string bytes = shelf_->read(stored_name(part));
  std::string_view rest = bytes;
  Piece piece = take_piece(rest);
  number(part, piece.ids);
  return piece;
}

std::vector<VertexId> DividedMesh::stored_ids(std::size_t part) const {
  std::vector<VertexId> ids =
      read_ids([&](auto begin, auto size) { return shelf_->read(stored_name(part), begin, size); });
  number(part, ids);
  return ids;
}

Piece DividedMesh::stored_vertices(std::size_t part, std::size_t begin, std::size_t end) const {
  const std::string name = stored_name(part);
  const auto read = [&](auto from, auto size) { return shelf_->read(name, from, size); };
  Piece piece = read_vertices(read, begin, end);
  number(part, piece.ids);
  return piece;
}

void DividedMesh::copy_stored(Shelf& to) const {
  for (const std::size_t part : own_) to.put(stored_name(part), shelf_->read(stored_name(part)));
}

void DividedMesh::take_from(const Shelf& from) {
  for (const std::size_t part : own_) {
    const std::string name = state_.stored > 0 ? stored_name(part) : gathered_name(part);
    const std::string bytes = from.read(name);
    if (bytes.empty() && state_.stored > 0) throw Error(fmt::format("there is no {}", name));
    shelf_->put(name, bytes);
  }
}

void DividedMesh::bring_to_first() {
  if (ranks_.count() == 1) return;
  const std::size_t rounds = most_own();
  for (std::size_t round = 0; round < rounds; ++round) {
    std::vector<std::string> to(ranks_.count());
    if (round < own_.size() && !ranks_.is_first()) {
      const std::string name = stored_name(own_[round]);
      put(std::uint64_t{own_[round]}, to[0]);
      to[0] += shelf_->read(name);
      shelf_->remove(name);
    }
    for (const std::string& from : ranks_.exchange(std::move(to))) {
      if (from.empty()) continue;
      std::string_view rest = from;
      std::uint64_t part = 0;
      take(rest, part);
      shelf_->put(stored_name(part), rest);
    }
  }
  own_those_of(std::vector<std::uint32_t>(state_.stored, 0));
}

}  // namespace tetmend::pieces
