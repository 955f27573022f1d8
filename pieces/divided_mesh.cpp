// SPDX-License-Identifier: MIT
//   stored piece -> the parts of each tet's vertices -> a message for each part -> gathered piece
#include "pieces/divided_mesh.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "pieces/bytes.h"
#include "pieces/messages.h"

namespace tetmend::pieces {

namespace {

std::string stored_name(std::size_t part) {
  return fmt::format("stored-{}", part);
}

std::string gathered_name(std::size_t part) {
  return fmt::format("gathered-{}", part);
}

/// Of what was not sent, when the parts are stored.
std::string kept_name(std::size_t part) {
  return fmt::format("kept-{}", part);
}

/// The same while the parts are worked on: it is renamed then.
std::string rest_name(std::size_t part) {
  return kept_name(part) + ".next";
}

/// In the order of their sources, whoever brought them.
std::vector<Piece> read_messages(const Shelf& shelf, const std::string& name) {
  std::vector<std::pair<std::uint64_t, Piece>> messages;
  shelf.visit(name, [&](std::string_view bytes) { take_messages(bytes, messages); });
  std::sort(messages.begin(), messages.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Piece> pieces;
  for (auto& message : messages) pieces.push_back(std::move(message.second));
  return pieces;
}

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
  put(state.parting.sends_all, bytes);
  put(std::uint64_t{state.parting.zones.balls().size()}, bytes);
  for (const Ball& ball : state.parting.zones.balls()) {
    put_point(ball.centre);
    put(ball.radius, bytes);
    put(ball.zone, bytes);
    put(ball.cluster, bytes);
    put(ball.rank, bytes);
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
  take(bytes, state.parting.sends_all);
  std::uint64_t count = 0;
  take(bytes, count);
  std::vector<Ball> balls;
  for (std::uint64_t i = 0; i < count; ++i) {
    Ball& ball = balls.emplace_back();
    take_point(ball.centre);
    take(bytes, ball.radius);
    take(bytes, ball.zone);
    take(bytes, ball.cluster);
    take(bytes, ball.rank);
  }
  const std::vector<std::uint64_t>& cuts = state.parting.cuts;
  const auto is_among = [&](std::uint32_t number) { return number < balls.size(); };
  const bool fits = state.low.allFinite() && state.high.allFinite() &&
                    state.parting.low.allFinite() && std::isfinite(state.parting.side) &&
                    state.first_added.size() == state.stored && !cuts.empty() &&
                    std::is_sorted(cuts.begin(), cuts.end()) &&
                    std::all_of(balls.begin(), balls.end(), [&](const Ball& ball) {
                      return ball.centre.allFinite() && std::isfinite(ball.radius) &&
                             is_among(ball.zone) && is_among(ball.cluster) && is_among(ball.rank);
                    });
  if (!fits) throw Error("a division contradicts itself");
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

/// Of what a stored part has, each vertex once.
std::vector<Point> DividedMesh::points_of(std::size_t part) const {
  std::vector<Point> points;
  const auto take_own = [&](const Piece& vertices) {
    for (std::size_t v = 0; v < vertices.ids.size(); ++v) {
      if (is_own(vertices.marks[v])) points.push_back(vertices.points[v]);
    }
  };
  take_own(stored_vertices(part));
  shelf_->visit(kept_name(part), [&](std::string_view rest) {
    while (!rest.empty()) {
      std::uint64_t source = 0;
      const std::string_view message = take_message(rest, source);
      const auto read = [&](auto begin, auto size) {
        return std::string(message.substr(std::min<std::uint64_t>(begin, message.size()), size));
      };
      take_own(read_vertices(read, 0, std::numeric_limits<std::size_t>::max()));
    }
  });
  return points;
}

Parting DividedMesh::cut(std::size_t pieces, unsigned shift) const {
  const double side = state_.side();
  Parting parting{state_.low, side, shift};
  if (pieces == 1) return parting;
  const HilbertCurve curve = shifted_curve(state_.low, side, shift);
  KeyHistogram histogram;
  const auto count_all = [&] {
    side_by_side_.each(own_.size(), [&](std::size_t i) -> SideBySide::Use {
      std::vector<std::uint64_t> keys;
      for (const Point& p : points_of(own_[i])) keys.push_back(curve.key(p));
      return [&histogram, keys = std::move(keys)] {
        for (const std::uint64_t key : keys) histogram.count(key);
      };
    });
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
  side_by_side_.each(own_.size(), [&](std::size_t i) -> SideBySide::Use {
    std::vector<std::int64_t> mine(counts.size(), 0);
    const std::vector<Point> points = points_of(own_[i]);
    zones.count(points, std::span(mine).first(zones.balls().size()));
    mine.back() = static_cast<std::int64_t>(points.size());
    return [&counts, mine = std::move(mine)] {
      for (std::size_t k = 0; k < counts.size(); ++k) counts[k] += mine[k];
    };
  });
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

void DividedMesh::divide(std::size_t pieces, unsigned shift, Shelf* next) {
  send_all(cut(pieces, shift), 0, next);
}

void DividedMesh::divide_near_borders(unsigned shift, unsigned rings, Shelf* next) {
  Parting parting = cut(state_.parting.stretches(), shift);
  parting.sends_all = false;
  send_all(std::move(parting), rings, next);
}

void DividedMesh::divide_zones(ZoneMap zones, Shelf* next) {
  Parting parting = state_.parting;
  parting.zones = std::move(zones);
  parting.sends_all = false;
  send_all(std::move(parting), 0, next);
}

/// All ranks send one piece at a time: so memory holds the messages of few.
void DividedMesh::send_all(Parting parting, unsigned rings, Shelf* next) {
  const auto start = std::chrono::steady_clock::now();
  traffic_.emplace_back();
  state_.parting = std::move(parting);
  Shelf& to = next == nullptr ? *shelf_ : *next;
  const std::vector<std::uint32_t> owners = owners_of(state_.parting, ranks_.count());
  for (std::size_t part = 0; part < parts(); ++part) {
    to.remove(gathered_name(part));
    to.remove(rest_name(part));
  }
  const auto remove = [&](std::size_t part) {
    if (next != nullptr) return;
    shelf_->remove(stored_name(part));
    shelf_->remove(kept_name(part));
  };
  const auto send = [&](SentPart sent) {
    traffic_.back().tets += sent.tets;
    std::vector<std::string> out = send_out(std::move(sent.messages), owners, to);
    remove(sent.part);
    return out;
  };
  if (ranks_.count() == 1) {
    side_by_side_.each(own_.size(), [&](std::size_t i) -> SideBySide::Use {
      return [&, sent = messages_of(own_[i], rings)]() mutable { send(std::move(sent)); };
    });
  }
  const std::size_t rounds = ranks_.count() == 1 ? 0 : most_own();
  for (std::size_t round = 0; round < rounds; ++round) {
    std::vector<std::string> messages(ranks_.count());
    if (round < own_.size()) messages = send(messages_of(own_[round], rings));
    for (const std::string& from : ranks_.exchange(std::move(messages))) {
      traffic_.back().received += from.size();
      keep(from, to);
    }
  }
  shelf_ = &to;
  own_those_of(owners);
  for (const std::size_t part : own_) {
    to.end(gathered_name(part));
    to.end(rest_name(part));
  }
  state_.stored = 0;
  state_.first_added.clear();
  traffic_.back().seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

namespace {

/// To another rank.
struct Address {
  std::uint64_t target = 0;
  std::uint64_t is_rest = 0;
  std::uint64_t size = 0;
};

}  // namespace

/// Other parts may be read at the same time.
DividedMesh::SentPart DividedMesh::messages_of(std::size_t part, unsigned rings) const {
  SentPart sent{part};
  const auto add = [&](std::size_t target, bool is_rest, std::string bytes) {
    if (!bytes.empty()) sent.messages.push_back({target, is_rest, std::move(bytes)});
  };
  const std::size_t stretches = state_.parting.stretches();
  const std::size_t home = part < stretches ? part : (part - stretches) % stretches;
  std::uint64_t source = std::uint64_t{part} << 32;  // and which piece of that part
  for (Piece& piece : all_stored(part)) {
    sent.tets += piece.tets.size();
    Messages messages(std::move(piece), state_.parting, rings);
    for (std::size_t target = 0; target < parts(); ++target) {
      add(target, false, messages.message(source, target));
    }
    add(home, true, messages.rest(source));
    ++source;
  }
  return sent;
}

/// What is for this rank goes to the shelf, the rest is returned, by rank.
std::vector<std::string> DividedMesh::send_out(std::vector<Message> messages,
                                               const std::vector<std::uint32_t>& owners,
                                               Shelf& next) const {
  std::vector<std::string> to(ranks_.count());
  for (Message& message : messages) {
    if (owners[message.target] == ranks_.number()) {
      next.append(message.is_rest ? rest_name(message.target) : gathered_name(message.target),
                  std::move(message.bytes));
      continue;
    }
    std::string& out = to[owners[message.target]];
    put(Address{message.target, message.is_rest ? 1U : 0U, message.bytes.size()}, out);
    out += message.bytes;
    message.bytes = {};
  }
  return to;
}

void DividedMesh::keep(std::string_view messages, Shelf& next) {
  while (!messages.empty()) {
    Address address;
    take(messages, address);
    std::string message(take_front(messages, address.size));
    next.append(address.is_rest != 0 ? rest_name(address.target) : gathered_name(address.target),
                std::move(message));
  }
}

Piece DividedMesh::gathered(std::size_t part) const {
  return merge(read_messages(*shelf_, gathered_name(part)));
}

std::vector<Piece> DividedMesh::rest(std::size_t part) const {
  return read_messages(*shelf_, rest_name(part));
}

void DividedMesh::store(std::size_t part, const Piece& piece) {
  std::string bytes;
  append(piece, bytes);
  shelf_->put(stored_name(part), std::move(bytes));
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
  for (const std::size_t part : own_) shelf_->rename(rest_name(part), kept_name(part));
}

/// Vertices that were added to a stored piece get their numbers when it is read.
void DividedMesh::number(std::size_t part, std::vector<VertexId>& ids) const {
  for (VertexId& id : ids) {
    if (id < TaskResult::kNewVertex) continue;
    id = state_.first_added[part] + (id - TaskResult::kNewVertex);
  }
}

Piece DividedMesh::stored(std::size_t part) const {
  Piece piece;
  shelf_->visit(stored_name(part), [&](std::string_view bytes) { piece = take_piece(bytes); });
  number(part, piece.ids);
  return piece;
}

std::vector<Piece> DividedMesh::all_stored(std::size_t part) const {
  std::vector<Piece> pieces = read_messages(*shelf_, kept_name(part));
  pieces.insert(pieces.begin(), stored(part));
  return pieces;
}

std::vector<Piece> DividedMesh::all_of(std::size_t part) const {
  if (state_.stored > 0) return all_stored(part);
  std::vector<Piece> pieces = rest(part);
  pieces.insert(pieces.begin(), gathered(part));
  return pieces;
}

std::vector<VertexId> DividedMesh::stored_ids(std::size_t part) const {
  const std::string name = stored_name(part);
  const auto read = [&](auto begin, auto size) { return shelf_->read(name, begin, size); };
  std::vector<VertexId> ids;
  shelf_->parse(name, [&] { ids = read_ids(read); });
  number(part, ids);
  return ids;
}

Piece DividedMesh::stored_vertices(std::size_t part, std::size_t begin, std::size_t end) const {
  const std::string name = stored_name(part);
  const auto read = [&](auto from, auto size) { return shelf_->read(name, from, size); };
  Piece piece;
  shelf_->parse(name, [&] { piece = read_vertices(read, begin, end); });
  number(part, piece.ids);
  return piece;
}

namespace {

/// @param even_nothing  who looks for it misses what is not there
void copy(const Shelf& from, const std::string& name, Shelf& to, bool even_nothing) {
  std::string bytes = from.read(name);
  if (even_nothing || !bytes.empty()) to.put(name, std::move(bytes));
}

}  // namespace

void DividedMesh::copy_stored(Shelf& to) const {
  for (const std::size_t part : own_) {
    copy(*shelf_, stored_name(part), to, true);
    copy(*shelf_, kept_name(part), to, true);
  }
}

void DividedMesh::take_from(const SealedShelf& from) {
  for (const std::size_t part : own_) {
    const bool is_stored = state_.stored > 0;
    copy(from, is_stored ? stored_name(part) : gathered_name(part), *shelf_, false);
    copy(from, is_stored ? kept_name(part) : rest_name(part), *shelf_, false);
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
      shelf_->put(stored_name(part), std::string(rest));
    }
  }
  own_those_of(std::vector<std::uint32_t>(state_.stored, 0));
}

}  // namespace tetmend::pieces
