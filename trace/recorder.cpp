// SPDX-License-Identifier: MIT
// A chunk ends only between two outermost attempts, so that no edit in it refers to another chunk.
#include "trace/recorder.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "trace/slot_mesh.h"

namespace tetmend {

namespace {

/// Before compression: a few thousand events.
constexpr std::size_t kChunkBytes = std::size_t{1} << 17;

}  // namespace

void TraceHeader::encode(ByteWriter& out) const {
  for (const std::string* text : {&program, &input, &schedule, &schedule_text, &filter}) {
    out.put_text(*text);
  }
  out.put(settings.size());
  for (const auto& [name, value] : settings) {
    out.put_text(name);
    out.put_text(value);
  }
}

TraceHeader TraceHeader::decode(ByteReader& in) {
  TraceHeader header;
  for (std::string* text : {&header.program, &header.input, &header.schedule}) {
    *text = in.get_line();
  }
  header.schedule_text = in.get_text();
  header.filter = in.get_line();
  for (std::size_t left = in.get_count(2); left > 0; --left) {
    auto& [name, value] = header.settings.emplace_back();
    name = in.get_line();
    value = in.get_line();
  }
  return header;
}

std::string TraceFilter::describe() const {
  std::vector<std::string> parts;
  if (around) {
    parts.push_back(fmt::format("around {},{},{} within {}", around->centre.x(), around->centre.y(),
                                around->centre.z(), around->radius));
  }
  if (!operators.empty()) parts.push_back(fmt::format("operators {}", fmt::join(operators, " ")));
  if (depth != TraceFilter().depth) parts.push_back(fmt::format("depth at most {}", depth));
  if (most_bytes != TraceFilter().most_bytes) {
    parts.push_back(fmt::format("at most {} bytes", most_bytes));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

TraceRecorder::TraceRecorder(const std::filesystem::path& file, const TetMesh& mesh,
                             TraceHeader header, TraceFilter filter, TraceClock clock)
    : mesh_(mesh), filter_(std::move(filter)), clock_(clock), file_(file) {
  begin(std::move(header));
}

TraceRecorder::TraceRecorder(std::string& memory, const TetMesh& mesh, TraceHeader header,
                             TraceClock clock, TraceBeginning beginning)
    : mesh_(mesh), clock_(clock), beginning_(beginning), memory_(&memory), file_(memory) {
  begin(std::move(header));
}

void TraceRecorder::begin(TraceHeader header) {
  header.filter = filter_.describe();
  if (filter_.around) {
    filter_.around->centre = mesh_.scale().to_work(filter_.around->centre);
    filter_.around->radius = mesh_.scale().to_work(filter_.around->radius);
  }
  ByteWriter content;
  header.encode(content);
  write_frame('H', content.bytes());
  if (beginning_ == TraceBeginning::without_mesh) return;
  content.cut(0);
  SlotMesh(mesh_).encode(content);
  write_frame('M', content.bytes());
}

TraceRecorder::~TraceRecorder() = default;

std::uint64_t TraceRecorder::ticks() const {
  constexpr std::uint64_t kTicksPerStep = 16;
  if (clock_ == TraceClock::steps) return kTicksPerStep * events_;
  const std::chrono::nanoseconds now = std::chrono::steady_clock::now() - start_;
  return static_cast<std::uint64_t>(now.count()) / EventEncoder::kTickNanoseconds;
}

void TraceRecorder::write_frame(char kind, std::span<const std::byte> content) {
  ByteWriter whole;
  whole.put_raw(kind);
  whole.put_bytes(content.data(), content.size());
  file_.write(file_.pack(whole.bytes()));
}

/// The last frame, packed.
std::span<const std::byte> TraceRecorder::end_frame(TraceEnd end) {
  ByteWriter content;
  content.put_raw('Z');
  content.put(events_);
  content.put(static_cast<std::uint64_t>(end));
  return file_.pack(content.bytes());
}

/// What is in the encoder, packed.
std::span<const std::byte> TraceRecorder::chunk() {
  content_.cut(0);
  content_.put_raw('E');
  content_.put(chunk_begin_);
  content_.put(events_ - chunk_begin_);
  content_.put_bytes(encoder_.bytes().data(), encoder_.size());
  return file_.pack(content_.bytes());
}

void TraceRecorder::write_chunk() {
  if (encoder_.size() == 0) return;
  try {
    constexpr std::size_t kEndBytes = 64;
    const auto packed = chunk();
    if (file_.written() + packed.size() + kEndBytes > filter_.most_bytes) {
      active_ = false;
      events_ = chunk_begin_;
      file_.write(end_frame(TraceEnd::limit_reached));
    } else {
      file_.write(packed);
    }
  } catch (const Error& error) {
    active_ = false;
    trouble_ = error.what();
  }
  encoder_.clear();
  chunk_begin_ = events_;
  fence_ = 0;
}

void TraceRecorder::finish() {
  if (file_.is_in_memory()) return end();
  complete().commit();
}

void TraceRecorder::end() {
  if (active_) {
    write_chunk();
    if (active_) file_.write(end_frame(TraceEnd::complete));
  }
  active_ = false;
  if (!trouble_.empty()) throw Error(trouble_);
}

formats::PendingFile& TraceRecorder::complete() {
  end();
  file_.file().finish();
  return file_.file();
}

std::string TraceRecorder::so_far() {
  assert(file_.is_in_memory());
  if (!trouble_.empty()) throw Error(trouble_);
  std::string bytes = *memory_;
  if (!active_) return bytes;
  const auto append = [&](std::span<const std::byte> packed) {
    bytes.append(reinterpret_cast<const char*>(packed.data()), packed.size());
  };
  if (encoder_.size() > 0) append(chunk());
  append(end_frame(TraceEnd::complete));
  return bytes;
}

/// What is half written when memory runs out is never read.
template <class Write>
void TraceRecorder::record(const Write& write) noexcept {
  if (!active_) return;
  try {
    write();
  } catch (...) {
    active_ = false;
    trouble_ = "out of memory";  // short enough to need none
  }
}

/// An event that stays, other than an edit.
void TraceRecorder::wrote_event() {
  ++events_;
  fence_ = encoder_.size();
}

void TraceRecorder::pass_begins(std::string_view name, unsigned round) {
  record([&] {
    encoder_.pass_begins(name, round, ticks());
    wrote_event();
  });
}

void TraceRecorder::pass_ends(const QualityIndicators& now) {
  record([&] {
    encoder_.pass_ends(now, ticks());
    wrote_event();
  });
}

/// Written when the first attempt in it is.
void TraceRecorder::visit_begins(const TetVertices& tet, Quality quality) {
  visit_ = Visit{tet, quality, false};
}

void TraceRecorder::visit_ends() {
  record([&] {
    if (!visit_ || !visit_->written) return;
    encoder_.visit_ends(ticks());
    wrote_event();
  });
  visit_.reset();
}

void TraceRecorder::standard_changed(const Standard& /*standard*/) {
  record([&] {
    encoder_.standard_changes(mesh_, ticks());
    wrote_event();
  });
}

void TraceRecorder::parameter_changed(std::string_view text) {
  record([&] {
    encoder_.parameter_changes(text, ticks());
    wrote_event();
  });
}

bool TraceRecorder::is_near(const AttemptEvent& event) const {
  if (!open_.empty()) return open_.back().near;
  return !filter_.around ||
         std::any_of(event.target.begin(), event.target.end(), [&](VertexHandle v) {
           return (mesh_.point(v) - filter_.around->centre).norm() <= filter_.around->radius;
         });
}

bool TraceRecorder::is_wanted(std::string_view operator_name) const {
  const auto& wanted = filter_.operators;
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), operator_name) != wanted.end();
}

void TraceRecorder::attempt_begins(const AttemptEvent& event) {
  record([&] { begin_attempt(event); });
}

void TraceRecorder::begin_attempt(const AttemptEvent& event) {
  const bool near = is_near(event);
  const bool inside =
      (!open_.empty() && open_.back().inside) || (near && is_wanted(event.operator_name));
  const bool written = inside && open_.size() <= filter_.depth;
  if (written) {
    const std::uint64_t now = ticks();
    if (visit_ && !visit_->written) {
      encoder_.visit_begins(visit_->tet, visit_->quality, now);
      wrote_event();
      visit_->written = true;
    }
    encoder_.attempt_begins(event, now);
    wrote_event();
  }
  open_.push_back({near, inside, written});
}

void TraceRecorder::candidate_found() {
  record([&] {
    if (!is_written()) return;
    encoder_.candidate_found();
    wrote_event();
  });
}

void TraceRecorder::attempt_ends(Verdict verdict, std::span<const Quality> before,
                                 std::span<const Quality> now) {
  record([&] {
    if (is_written()) {
      encoder_.attempt_ends(verdict, before, now, ticks());
      wrote_event();
    }
    open_.pop_back();
    if (!open_.empty()) return;
    edits_.clear();
    if (encoder_.size() >= kChunkBytes) write_chunk();
  });
}

void TraceRecorder::edit_made(const TetMesh& mesh, const Journal& journal) noexcept {
  record([&] {
    edits_.push_back(encoder_.size());
    encoder_.edit(mesh, journal);
    ++events_;
  });
}

void TraceRecorder::edit_undone() noexcept {
  record([&] { take_back_edit(); });
}

/// In an attempt that is not written nothing is known of edits that were undone.
void TraceRecorder::take_back_edit() {
  assert(!edits_.empty());  // an edit is undone in the outermost attempt that it was made in
  const std::size_t begin = edits_.back();
  edits_.pop_back();
  if (begin >= fence_ && !is_written()) {
    encoder_.cut(begin);
    --events_;
    return;
  }
  encoder_.undo();
  wrote_event();
}

}  // namespace tetmend
