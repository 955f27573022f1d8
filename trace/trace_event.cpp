// SPDX-License-Identifier: MIT
// docs/trace.md describes the bytes.
#include "trace/trace_event.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

#include "trace/slot_mesh.h"
#include "trace/traced_standard.h"

namespace tetmend {

namespace {

/// Stands for EventKind::replace_cavity at the surface: labels precede the tets. The kinds from that
/// number on have one more in the file.
constexpr std::uint64_t kAtSurface = 13;
/// No kind: precedes an event that has `qualities`, and these.
constexpr std::uint64_t kNoted = kEventKinds + 1;

bool has_labels(const Journal& journal, const Edit& edit) {
  const auto begin = journal.removed.begin() + edit.removed_begin;
  return std::any_of(begin, journal.removed.begin() + edit.removed_end,
                     [&](const Journal::RemovedTet& tet) { return tet.label != begin->label; });
}

}  // namespace

// --- writing -------------------------------------------------------------------------------------

void EventEncoder::clear() {
  out_.cut(0);
  last_ticks_ = 0;
  names_.clear();
}

void EventEncoder::put_kind(EventKind kind) {
  const auto number = static_cast<std::uint64_t>(kind);
  out_.put(number < kAtSurface ? number : number + 1);
}

void EventEncoder::put_time(std::uint64_t ticks) {
  out_.put(ticks - last_ticks_);
  last_ticks_ = ticks;
}

/// The number of the name in this chunk; a new one is followed by its text. The same name mostly
/// lies where it lay before, which saves the search.
void EventEncoder::put_name(std::string_view name) {
  constexpr std::uint64_t kScatter = 0x9E3779B97F4A7C15u;
  std::uint8_t& guess = guesses_[std::bit_cast<std::uintptr_t>(name.data()) * kScatter >> 56];
  if (guess < names_.size() && names_[guess] == name) return out_.put(guess);
  std::size_t number = 0;
  while (number < names_.size() && names_[number] != name) ++number;
  guess = static_cast<std::uint8_t>(number);
  out_.put(number);
  if (number < names_.size()) return;
  names_.emplace_back(name);
  out_.put_text(name);
}

void EventEncoder::put_vertices(std::span<const VertexHandle> vertices) {
  out_.put(vertices.size());
  std::uint32_t last = 0;
  for (const VertexHandle v : vertices) out_.put_step(v.index(), last);
}

void EventEncoder::put_qualities(std::span<const Quality> qualities) {
  out_.put(qualities.size());
  out_.put_bytes(qualities.data(), qualities.size_bytes());
}

void EventEncoder::pass_begins(std::string_view name, unsigned round, std::uint64_t ticks) {
  put_kind(EventKind::pass_begins);
  put_time(ticks);
  put_name(name);
  out_.put(round);
}

void EventEncoder::pass_ends(const QualityIndicators& now, std::uint64_t ticks) {
  put_kind(EventKind::pass_ends);
  put_time(ticks);
  out_.put_raw(now.q_worst);
  out_.put(now.n_bad);
  out_.put_raw(now.q_aver);
  out_.put(now.n_needles);
}

void EventEncoder::visit_begins(const TetVertices& tet, Quality quality, std::uint64_t ticks) {
  put_kind(EventKind::visit_begins);
  put_time(ticks);
  put_vertices(tet);
  out_.put_raw(quality);
}

void EventEncoder::visit_ends(std::uint64_t ticks) {
  put_kind(EventKind::visit_ends);
  put_time(ticks);
}

void EventEncoder::attempt_begins(const AttemptEvent& event, std::uint64_t ticks) {
  put_kind(EventKind::attempt_begins);
  put_time(ticks);
  put_name(event.operator_name);
  put_vertices(event.target);
  out_.put(event.level);
  put_name(event.settings);
}

void EventEncoder::candidate_found() {
  put_kind(EventKind::candidate_found);
}

void EventEncoder::attempt_ends(Verdict verdict, std::span<const Quality> before,
                                std::span<const Quality> now, std::uint64_t ticks) {
  put_kind(EventKind::attempt_ends);
  put_time(ticks);
  put_name(to_string(verdict));
  put_qualities(before);
  put_qualities(now);
}

void EventEncoder::standard_changes(const TetMesh& mesh, std::uint64_t ticks) {
  if (mesh.standard().is_own()) {
    out_.put(kNoted);
    put_qualities(qualities_of_tets(mesh));
  }
  put_kind(EventKind::standard_changes);
  put_time(ticks);
  put_standard(out_, mesh.standard());
}

void EventEncoder::parameter_changes(std::string_view text, std::uint64_t ticks) {
  put_kind(EventKind::parameter_changes);
  put_time(ticks);
  put_name(text);
}

/// Of the tets that the last edit made or changed.
void EventEncoder::note_qualities(const TetMesh& mesh, const Journal& journal) {
  const Edit& edit = journal.edits.back();
  qualities_.clear();
  for (std::uint32_t k = edit.created_begin; k < edit.created_end; ++k) {
    qualities_.push_back(mesh.quality(journal.created[k]));
  }
  for (std::uint32_t k = edit.qualities_begin; k < edit.qualities_end; ++k) {
    qualities_.push_back(mesh.quality(journal.qualities[k].tet));
  }
  if (qualities_.empty()) return;
  out_.put(kNoted);
  put_qualities(qualities_);
}

void EventEncoder::edit(const TetMesh& mesh, const Journal& journal) {
  const Edit& edit = journal.edits.back();
  if (mesh.standard().is_own()) note_qualities(mesh, journal);
  switch (edit.kind) {
    case Edit::Kind::replace_cavity:
      return replace_cavity(mesh, journal, edit);
    case Edit::Kind::move_vertex: {
      put_kind(EventKind::move_vertex);
      out_.put(edit.vertex.index());
      out_.put_bytes(mesh.point(edit.vertex).data(), 3 * sizeof(double));
      out_.put(edit.qualities_end - edit.qualities_begin);
      std::uint32_t last = 0;
      for (std::uint32_t k = edit.qualities_begin; k < edit.qualities_end; ++k) {
        out_.put_step(journal.qualities[k].tet.index(), last);
      }
      return;
    }
    case Edit::Kind::add_vertex:
      put_kind(EventKind::add_vertex);
      out_.put(edit.vertex.index());
      out_.put_bytes(mesh.point(edit.vertex).data(), 3 * sizeof(double));
      return;
    case Edit::Kind::remove_vertex:
      put_kind(EventKind::remove_vertex);
      out_.put(edit.vertex.index());
      return;
  }
}

void EventEncoder::replace_cavity(const TetMesh& mesh, const Journal& journal, const Edit& edit) {
  const bool at_surface = edit.surface || has_labels(journal, edit);
  if (at_surface) {
    out_.put(kAtSurface);
    put_labels(mesh, journal, edit);
  } else {
    put_kind(EventKind::replace_cavity);
  }
  const std::uint32_t removed = edit.removed_end - edit.removed_begin;
  const std::uint32_t created = edit.created_end - edit.created_begin;
  out_.put(removed);
  out_.put(created);
  std::uint32_t last = 0;
  for (std::uint32_t k = 0; k < removed; ++k) {
    out_.put_step(journal.removed[edit.removed_begin + k].tet.index(), last);
  }
  TetVertices corner{VertexHandle(0), VertexHandle(0), VertexHandle(0), VertexHandle(0)};
  for (std::uint32_t k = 0; k < created; ++k) {
    const TetHandle t = journal.created[edit.created_begin + k];
    // The first take the slots of the removed ones, in order.
    assert(k >= removed || t == journal.removed[edit.removed_begin + k].tet);
    if (k >= removed) out_.put_step(t.index(), last);
    const TetVertices& vertices = mesh.vertices(t);
    for (unsigned i = 0; i < 4; ++i) {
      std::uint32_t from = corner[i].index();
      out_.put_step(vertices[i].index(), from);
    }
    corner = vertices;
  }
}

/// Of the tets created.
void EventEncoder::put_labels(const TetMesh& mesh, const Journal& journal, const Edit& edit) {
  out_.put(edit.created_end - edit.created_begin);
  for (std::uint32_t k = edit.created_begin; k < edit.created_end; ++k) {
    out_.put_signed(mesh.label(journal.created[k]));
  }
}

void EventEncoder::undo() {
  put_kind(EventKind::undo);
}

// --- reading -------------------------------------------------------------------------------------

void EventDecoder::begin(std::span<const std::byte> content, NameTable& names) {
  in_ = ByteReader(content);
  ticks_ = 0;
  names_ = &names;
  chunk_names_.clear();
}

void EventDecoder::get_time(TraceEvent& event) {
  constexpr std::uint64_t kMostTicks = std::uint64_t{1} << 56;
  const std::uint64_t step = in_.get();
  if (step > kMostTicks - ticks_) throw ByteReader::Damage("a time that is none");
  ticks_ += step;
  event.seconds = static_cast<double>(ticks_ * EventEncoder::kTickNanoseconds) * 1e-9;
}

auto EventDecoder::get_name() -> const Name& {
  const std::uint64_t number = in_.get();
  if (number < chunk_names_.size()) return chunk_names_[number];
  if (number > chunk_names_.size()) throw ByteReader::Damage("a name that was not given yet");
  const std::string text = in_.get_line();
  chunk_names_.push_back({names_->number_of(text), algorithm_of(text), verdict_of(text)});
  return chunk_names_.back();
}

/// Finite: the rest of the program computes with it unseen.
void EventDecoder::get_point(TraceEvent& event) {
  in_.get_bytes(event.point.data(), 3 * sizeof(double));
  if (!event.point.allFinite()) throw ByteReader::Damage("a coordinate is no finite number");
}

void EventDecoder::get_vertices(TraceEvent& event) {
  event.vertices.resize(in_.get_count());
  std::uint32_t last = 0;
  for (VertexHandle& v : event.vertices) v = VertexHandle(in_.get_step(last));
}

void EventDecoder::get_qualities(std::vector<Quality>& qualities) {
  qualities.resize(in_.get_count(sizeof(Quality)));
  in_.get_bytes(qualities.data(), qualities.size() * sizeof(Quality));
}

void EventDecoder::get_cavity(TraceEvent& event) {
  event.removed.resize(in_.get_count());
  event.created.resize(in_.get_count(4));
  event.created_vertices.resize(event.created.size());
  std::uint32_t last = 0;
  for (TetHandle& t : event.removed) t = TetHandle(in_.get_step(last));
  TetVertices corner{VertexHandle(0), VertexHandle(0), VertexHandle(0), VertexHandle(0)};
  for (std::size_t k = 0; k < event.created.size(); ++k) {
    event.created[k] = k < event.removed.size() ? event.removed[k] : TetHandle(in_.get_step(last));
    for (unsigned i = 0; i < 4; ++i) {
      std::uint32_t from = corner[i].index();
      corner[i] = VertexHandle(in_.get_step(from));
    }
    event.created_vertices[k] = corner;
  }
}

void EventDecoder::get_labels(TraceEvent& event) {
  event.created_labels.resize(in_.get_count());
  for (Label& label : event.created_labels) {
    const std::int64_t value = in_.get_signed();
    label = static_cast<Label>(value);
    if (label != value) throw ByteReader::Damage("a label has more than 32 bits");
  }
}

void EventDecoder::get_star(TraceEvent& event) {
  event.removed.resize(in_.get_count());
  std::uint32_t last = 0;
  for (TetHandle& t : event.removed) t = TetHandle(in_.get_step(last));
}

/// What precedes an event.
void EventDecoder::get_noted(TraceEvent& event) {
  get_qualities(event.qualities);
  for (const Quality q : event.qualities) {
    if (!std::isfinite(q)) throw ByteReader::Damage("a quality is no finite number");
  }
}

namespace {

/// A change of the standard is for those to check who know how many tets there are.
void check_qualities(const TraceEvent& event) {
  const bool fits = event.kind == EventKind::standard_changes
                        ? event.standard.is_own()
                        : event.qualities.size() == (event.kind == EventKind::replace_cavity
                                                         ? event.created.size()
                                                         : event.removed.size());
  const bool may_have = event.kind == EventKind::standard_changes ||
                        event.kind == EventKind::replace_cavity ||
                        event.kind == EventKind::move_vertex;
  if (!may_have || !fits) {
    throw ByteReader::Damage("qualities, and not of the tets of their event");
  }
}

void check_labels(const TraceEvent& event) {
  if (event.created_labels.size() == event.created.size()) return;
  throw ByteReader::Damage("a cavity with more or fewer labels than tets");
}

QualityIndicators get_indicators(ByteReader& in) {
  QualityIndicators now;
  now.q_worst = in.get_raw<double>();
  now.n_bad = in.get();
  now.q_aver = in.get_raw<double>();
  now.n_needles = in.get();
  return now;
}

}  // namespace

void EventDecoder::next(TraceEvent& event) {
  std::uint64_t kind = in_.get();
  event.qualities.clear();
  const bool noted = kind == kNoted;
  if (noted) {
    get_noted(event);
    kind = in_.get();
  }
  if (kind > kEventKinds) throw ByteReader::Damage(fmt::format("{} is no kind of event", kind));
  event.kind = kind == kAtSurface ? EventKind::replace_cavity
                                  : static_cast<EventKind>(kind < kAtSurface ? kind : kind - 1);
  event.created_labels.clear();
  if (kind == kAtSurface) get_labels(event);
  if (has_time(event.kind)) get_time(event);
  switch (event.kind) {
    case EventKind::pass_begins:
      event.name = get_name().number;
      event.number = in_.get32();
      break;
    case EventKind::pass_ends:
      event.now = get_indicators(in_);
      break;
    case EventKind::visit_begins:
      get_vertices(event);
      event.quality = in_.get_raw<Quality>();
      break;
    case EventKind::attempt_begins: {
      const Name& name = get_name();
      event.name = name.number;
      event.algorithm = name.algorithm;
      get_vertices(event);
      event.number = in_.get32();
      event.settings = get_name().number;
      break;
    }
    case EventKind::attempt_ends: {
      const std::optional<Verdict> verdict = get_name().verdict;
      if (!verdict) throw ByteReader::Damage("an attempt ends without a verdict");
      event.verdict = *verdict;
      get_qualities(event.before);
      get_qualities(event.after);
      break;
    }
    case EventKind::replace_cavity:
      get_cavity(event);
      if (kind == kAtSurface) check_labels(event);
      break;
    case EventKind::move_vertex:
    case EventKind::add_vertex:
    case EventKind::remove_vertex:
      event.vertices.assign(1, VertexHandle(in_.get32()));
      if (event.kind == EventKind::remove_vertex) break;
      get_point(event);
      if (event.kind == EventKind::move_vertex) get_star(event);
      break;
    case EventKind::parameter_changes:
      event.name = get_name().number;
      break;
    case EventKind::standard_changes:
      event.standard = get_standard(in_);
      break;
    case EventKind::visit_ends:
    case EventKind::candidate_found:
    case EventKind::undo:
      break;
  }
  if (noted) check_qualities(event);
}

}  // namespace tetmend
