// SPDX-License-Identifier: MIT
#include "trace/trace_file.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "kernel/judge.h"
#include "trace/trace_audit.h"

namespace tetmend {

namespace {

char kind_of(const std::vector<std::byte>& frame) {
  return frame.empty() ? '\0' : static_cast<char>(frame.front());
}

/// Of qualities in ascending order.
std::uint32_t count_bad(std::span<const Quality> qualities) {
  return static_cast<std::uint32_t>(
      std::lower_bound(qualities.begin(), qualities.end(), kBadThreshold) - qualities.begin());
}

/// What follows the kind.
ByteReader content_of(const std::vector<std::byte>& frame) {
  if (frame.empty()) throw ByteReader::Damage("an empty frame");
  return ByteReader(std::span(frame).subspan(1));
}

/// Far more than operators and sequences nest.
constexpr std::uint32_t kDeepest = 255;

}  // namespace

TraceFile::TraceFile(const std::filesystem::path& file, TraceCheck check)
    : path_(file), check_(check), frames_(file) {
  read();
}

TraceFile::TraceFile(const std::string& name, std::string_view bytes)
    : path_(name), frames_(formats::InputFile(name, bytes)) {
  read();
}

TraceFile::TraceFile(const std::string& name, std::string_view bytes, SlotMesh start)
    : path_(name),
      frames_(formats::InputFile(name, bytes)),
      has_start_(true),
      mesh_(std::move(start)) {
  read();
}

void TraceFile::read() {
  try {
    read_beginning();
    std::optional<TraceAudit> audit;
    const bool needs_mesh = !has_start_ || standard_.is_own();
    if (check_ == TraceCheck::mesh && needs_mesh) audit.emplace(mesh_);
    read_chunks(audit ? &*audit : nullptr);
    if (audit) last_mesh_ = audit->take_mesh();
  } catch (const ByteReader::Damage& damage) {
    throw Error(fmt::format("{}: byte {}: event {}: {}", path_.string(), frames_.offset(), events_,
                            damage.what()));
  }
  close_all();
  measures_.complete();
  if (last_mesh_) last_mesh_->set_standard(measures_.of(last_mesh_->standard()));
}

/// The content of the next frame, which lies in `frame`.
ByteReader TraceFile::frame_of(char kind, std::vector<std::byte>& frame) {
  if (!frames_.next()) {
    throw Error(fmt::format("{}: ends before its first event", path_.string()));
  }
  frames_.unpack(frames_.offset(), frame);
  if (kind_of(frame) != kind) {
    throw ByteReader::Damage(fmt::format("is no frame of kind '{}'", kind));
  }
  return content_of(frame);
}

/// What lies before the first event.
void TraceFile::read_beginning() {
  std::vector<std::byte> frame;
  try {
    ByteReader header = frame_of('H', frame);
    header_ = TraceHeader::decode(header);
    if (!has_start_) {
      ByteReader mesh = frame_of('M', frame);
      mesh_ = SlotMesh::decode(mesh);
    }
    standard_ = measures_.known(mesh_.standard());
    mesh_.set_standard(standard_);
    note_initial_qualities();
  } catch (const ByteReader::Damage& damage) {
    throw Error(fmt::format("{}: byte {}: damaged before its first event: {}", path_.string(),
                            frames_.offset(), damage.what()));
  }
}

/// Reads up to the end or to the first frame that is not whole. In a whole one all makes sense, or
/// whoever wrote it was no recorder: then nothing of the trace is to be believed.
void TraceFile::read_chunks(TraceAudit* audit) {
  std::vector<std::byte> frame;
  while (!ended_ && frames_.next()) {
    try {
      frames_.unpack(frames_.offset(), frame);
    } catch (const Error& error) {
      damage_ = fmt::format("{}; read up to event {}", error.what(), events_);
      return;
    }
    if (kind_of(frame) == 'Z') {
      read_end(frame);
    } else {
      index_chunk(frame, audit);
    }
  }
  if (!frames_.damage().empty()) {
    damage_ = fmt::format("{}; read up to event {}", frames_.damage(), events_);
  } else if (!ended_) {
    damage_ = fmt::format("{}: has no end, the run was not finished; read up to event {}",
                          path_.string(), events_);
  }
}

void TraceFile::read_end(const std::vector<std::byte>& frame) {
  ByteReader in = content_of(frame);
  const std::uint64_t count = in.get();
  const std::uint64_t end = in.get();
  if (count != events_) {
    throw ByteReader::Damage(fmt::format("the end counts {} events", count));
  }
  if (end > static_cast<std::uint64_t>(TraceEnd::limit_reached) || !in.at_end()) {
    throw ByteReader::Damage("an end of no known kind");
  }
  limit_reached_ = end == static_cast<std::uint64_t>(TraceEnd::limit_reached);
  ended_ = true;
}

void TraceFile::index_chunk(const std::vector<std::byte>& frame, TraceAudit* audit) {
  if (kind_of(frame) != 'E') throw ByteReader::Damage("a frame of no known kind");
  ByteReader in = content_of(frame);
  const std::uint64_t first = in.get();
  const std::size_t count = in.get_count();
  if (first != events_) {
    throw ByteReader::Damage(fmt::format("a chunk that begins with event {}", first));
  }
  if (count == 0) throw ByteReader::Damage("a chunk without events");
  EventDecoder decoder;
  decoder.begin(std::span(frame).last(in.left()), names_);
  chunk_begins_.push_back(events_);
  chunk_offsets_.push_back(frames_.offset());
  if (audit != nullptr) audit->begin_chunk();
  trials_.begin_chunk();
  accepted_.clear();
  TraceEvent event;
  for (std::size_t k = 0; k < count; ++k) {
    decoder.next(event);
    if (audit != nullptr) audit->follow(event);
    index_event(event);
    if (!event.qualities.empty() && check_ == TraceCheck::mesh) {
      if (audit == nullptr) throw ByteReader::Damage("qualities by a measure that was not there");
      note_qualities(event, audit->mesh());
    }
    ++events_;
  }
  if (!decoder.at_end()) throw ByteReader::Damage("a chunk has more events than it counts");
}

void TraceFile::note_quality(const SlotMesh& mesh, const TetVertices& tet, Quality quality) {
  measures_.note(standard_,
                 {mesh.point(tet[0]), mesh.point(tet[1]), mesh.point(tet[2]), mesh.point(tet[3])},
                 quality);
}

void TraceFile::note_initial_qualities() {
  std::size_t k = 0;
  for (std::uint32_t i = 0; i < mesh_.tet_slots() && k < mesh_.noted_qualities().size(); ++i) {
    if (mesh_.is_deleted(TetHandle(i))) continue;
    note_quality(mesh_, mesh_.vertices(TetHandle(i)), mesh_.noted_qualities()[k++]);
  }
  mesh_.forget_noted_qualities();
}

/// Those of an event, which `mesh` has seen.
void TraceFile::note_qualities(const TraceEvent& event, const SlotMesh& mesh) {
  if (!standard_.is_own()) {
    throw ByteReader::Damage("qualities by a measure of a program, and tets are judged by none");
  }
  const auto& qualities = event.qualities;
  if (event.kind == EventKind::standard_changes) {
    if (qualities.size() != mesh.tet_count()) {
      throw ByteReader::Damage(
          fmt::format("{} qualities of {} tets", qualities.size(), mesh.tet_count()));
    }
    std::size_t k = 0;
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      if (mesh.is_deleted(TetHandle(i))) continue;
      note_quality(mesh, mesh.vertices(TetHandle(i)), qualities[k++]);
    }
    return;
  }
  const bool moved = event.kind == EventKind::move_vertex;
  for (std::size_t k = 0; k < qualities.size(); ++k) {
    note_quality(mesh, moved ? mesh.vertices(event.removed[k]) : event.created_vertices[k],
                 qualities[k]);
  }
}

EventRange TraceFile::begin_of(const TraceEvent& event) const {
  return {events_, 0, event.seconds, 0};
}

void TraceFile::close(EventRange& range, double seconds) const {
  range.end = events_ + 1;
  range.end_seconds = seconds;
}

void TraceFile::begin_visit(const TraceEvent& event) {
  if (event.vertices.size() != 4) throw ByteReader::Damage("a visit of something that is no tet");
  if (visit_open_) throw ByteReader::Damage("a visit inside a visit");
  Visit& visit = visits_.emplace_back();
  visit.events = begin_of(event);
  visit.quality = event.quality;
  visit.first_call = static_cast<std::uint32_t>(calls_.size());
  std::copy_n(event.vertices.begin(), 4, visit.tet.begin());
  visit_open_ = true;
}

void TraceFile::begin_call(const TraceEvent& event) {
  if (event.vertices.empty() || event.vertices.size() > 4) {
    throw ByteReader::Damage(fmt::format("a target of {} vertices", event.vertices.size()));
  }
  if (event.number > kDeepest || open_.size() > kDeepest) {
    throw ByteReader::Damage(fmt::format("a call inside {} others, of level {}; {} is the most",
                                         open_.size(), event.number, kDeepest));
  }
  const auto number = static_cast<std::uint32_t>(calls_.size());
  Call& call = calls_.emplace_back();
  call.events = begin_of(event);
  call.operator_name = event.name;
  call.algorithm = event.algorithm;
  call.settings = event.settings;
  call.parent = open_.empty() ? kNoCall : open_.back();
  call.level = static_cast<std::uint16_t>(event.number);
  call.depth = static_cast<std::uint16_t>(open_.size());
  call.target_size = static_cast<std::uint8_t>(event.vertices.size());
  std::copy(event.vertices.begin(), event.vertices.end(), call.target_vertices.begin());
  open_.push_back(number);
}

void TraceFile::end_call(const TraceEvent& event) {
  if (open_.empty()) throw ByteReader::Damage("an attempt ends that never began");
  const std::uint32_t number = open_.back();
  Call& call = calls_[number];
  open_.pop_back();
  close(call.events, event.seconds);
  call.subtree_end = static_cast<std::uint32_t>(calls_.size());
  call.verdict = event.verdict;
  if (!event.before.empty()) call.worst_before = event.before.front();
  if (!event.after.empty()) call.worst_after = event.after.front();
  call.vector_improved = improves(event.after, event.before);
  call.bad_before = count_bad(event.before);
  call.bad_after = count_bad(event.after);
  if (call.accepted()) accepted_.push_back({number, trials_.standing()});
}

/// Of the last edit that stands. Whoever was accepted while it stood goes with it.
void TraceFile::undo() {
  if (trials_.standing() == 0) throw ByteReader::Damage("an undo, and there is nothing to undo");
  trials_.undo(events_);
  for (; !accepted_.empty() && accepted_.back().edits > trials_.standing(); accepted_.pop_back()) {
    Call& call = calls_[accepted_.back().call];
    call.undone = true;
    if (!open_.empty()) call.undone_with = open_.back();
  }
}

void TraceFile::index_event(const TraceEvent& event) {
  const auto calls = static_cast<std::uint32_t>(calls_.size());
  switch (event.kind) {
    case EventKind::pass_begins:
      if (pass_open_) throw ByteReader::Damage("a pass inside a pass");
      passes_.push_back({begin_of(event), event.name, event.number, standard_, {}, calls, 0});
      pass_open_ = true;
      break;
    case EventKind::pass_ends:
      if (!pass_open_) throw ByteReader::Damage("a pass ends that never began");
      close(passes_.back().events, event.seconds);
      passes_.back().now = event.now;
      passes_.back().last_call = calls;
      pass_open_ = false;
      break;
    case EventKind::visit_begins:
      begin_visit(event);
      break;
    case EventKind::visit_ends:
      if (!visit_open_) throw ByteReader::Damage("a visit ends that never began");
      close(visits_.back().events, event.seconds);
      visits_.back().last_call = calls;
      visit_open_ = false;
      break;
    case EventKind::attempt_begins:
      begin_call(event);
      break;
    case EventKind::attempt_ends:
      end_call(event);
      break;
    case EventKind::candidate_found:
      if (open_.empty()) throw ByteReader::Damage("a candidate without an attempt");
      calls_[open_.back()].candidate_found = true;
      return;
    case EventKind::replace_cavity:
    case EventKind::move_vertex:
    case EventKind::add_vertex:
    case EventKind::remove_vertex:
      if (!open_.empty()) ++calls_[open_.back()].edits;
      trials_.edit(events_);
      return;
    case EventKind::undo:
      undo();
      return;
    case EventKind::parameter_changes:
      if (pass_open_) throw ByteReader::Damage("a parameter changes inside a pass");
      parameter_changes_.push_back({events_, event.name});
      break;
    case EventKind::standard_changes:
      standard_ = measures_.known(event.standard);
      break;
  }
  seconds_ = event.seconds;
}

/// What the trace does not see end ends with it.
void TraceFile::close_all() {
  const auto end = [&](EventRange& range) {
    range.end = events_;
    range.end_seconds = seconds_;
  };
  const auto calls = static_cast<std::uint32_t>(calls_.size());
  for (const std::uint32_t call : open_) {
    end(calls_[call].events);
    calls_[call].subtree_end = calls;
  }
  open_.clear();
  if (visit_open_) {
    end(visits_.back().events);
    visits_.back().last_call = calls;
  }
  if (pass_open_) {
    end(passes_.back().events);
    passes_.back().last_call = calls;
  }
}

std::string_view Call::verdict_text() const {
  if (!verdict) return "cut off";
  return undone ? "undone with a caller" : to_string(*verdict);
}

bool Call::has_searched() const {
  if (candidate_found || undone) return true;
  return verdict && *verdict != Verdict::not_applicable && *verdict != Verdict::constrained &&
         *verdict != Verdict::deferred;
}

std::string Call::verdict_in_words() const {
  if (!undone || undone_with == kNoCall) return std::string(verdict_text());
  return fmt::format("undone with call {}", undone_with);
}

double Call::missing() const {
  if (!verdict || !has_qualities()) return std::numeric_limits<double>::infinity();
  return double{worst_before} - double{worst_after};
}

std::string Call::missing_in_words() const {
  if (accepted()) return {};
  if (!verdict) return "-: the trace ends before";
  if (!has_qualities()) return fmt::format("-: {}", kNothingCompared);
  return missing() <= 0 ? "others" : fmt::format("{:.4f}", missing());
}

std::uint32_t TraceFile::call_at(std::uint64_t event) const {
  const auto after = std::upper_bound(
      calls_.begin(), calls_.end(), event,
      [](std::uint64_t number, const Call& call) { return number < call.events.begin; });
  if (after == calls_.begin()) return kNoCall;
  auto call = static_cast<std::uint32_t>(after - calls_.begin() - 1);
  while (call != kNoCall && calls_[call].events.end <= event) call = calls_[call].parent;
  return call;
}

CallEnding TraceFile::ending(const Call& call) const {
  if (!call.verdict) return CallEnding::cut_off;
  const bool tried = call.candidate_found;
  const auto number = static_cast<std::uint32_t>(&call - calls_.data());
  const bool calls_others = call.subtree_end > number + 1;
  switch (*call.verdict) {
    case Verdict::accepted:
      return call.undone ? CallEnding::undone : CallEnding::for_good;
    case Verdict::not_applicable:
      return tried ? CallEnding::does_not_fit : CallEnding::not_applicable;
    case Verdict::constrained:
      if (calls_others) return CallEnding::rest_constrained;
      return tried ? CallEnding::candidate_constrained : CallEnding::target_constrained;
    case Verdict::no_improvement:
      if (calls_others) return CallEnding::calls_not_enough;
      if (!tried) return CallEnding::nothing_better;
      if (!call.vector_improved) return CallEnding::vector_not_better;
      return call.bad_after > call.bad_before ? CallEnding::more_bad_tets
                                              : CallEnding::judge_not_content;
    case Verdict::inverted:
      return CallEnding::inverted;
    case Verdict::depth_spent:
      return CallEnding::depth_spent;
    case Verdict::budget_spent:
      return CallEnding::budget_spent;
    case Verdict::deferred:
      return CallEnding::deferred;
  }
  return CallEnding::cut_off;
}

std::string_view TraceFile::reason(const Call& call) const {
  const CallEnding end = ending(call);
  const bool compared = call.worst_after > 0 || call.worst_before != 0;
  if (end == CallEnding::for_good && !compared) return "what the call was for is done";
  return kEndingWords[static_cast<std::size_t>(end)].reason;
}

// --- one event after the other -------------------------------------------------------------------

void EventCursor::open_chunk(std::size_t chunk) {
  const std::span<const std::uint64_t> begins = file_.chunk_begins();
  file_.frames_.unpack(file_.chunk_offsets_[chunk], content_);
  ByteReader in = content_of(content_);
  in.get();  // number of the first event
  in.get();  // number of events
  decoder_.begin(std::span<const std::byte>(content_).last(in.left()), names_);
  chunk_ = chunk;
  position_ = begins[chunk];
  chunk_end_ = chunk + 1 < begins.size() ? begins[chunk + 1] : file_.event_count();
}

void EventCursor::move_to(std::uint64_t event) {
  const std::span<const std::uint64_t> begins = file_.chunk_begins();
  if (event == position_ || begins.empty()) return;
  const auto after = std::upper_bound(begins.begin(), begins.end(), event);
  const auto chunk = static_cast<std::size_t>(after - begins.begin()) - 1;
  if (chunk != chunk_ || event < position_) open_chunk(chunk);
  while (position_ < event) next();
}

const TraceEvent& EventCursor::next() {
  const std::size_t following = chunk_ + 1;  // the first, when none is open
  if (position_ == chunk_end_) open_chunk(following);
  decoder_.next(event_);
  if (event_.kind == EventKind::standard_changes)
    event_.standard = file_.measures_.of(event_.standard);
  ++position_;
  return event_;
}

}  // namespace tetmend
