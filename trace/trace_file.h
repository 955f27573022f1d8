// SPDX-License-Identifier: MIT
// A trace file, opened: its events, and the calls, visits and passes that they make up.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trace/call_ending.h"
#include "trace/recorded_measures.h"
#include "trace/recorder.h"
#include "trace/slot_mesh.h"
#include "trace/trace_event.h"
#include "trace/trace_frame.h"
#include "trace/trials.h"

namespace tetmend {

class TraceAudit;

inline constexpr std::uint32_t kNoCall = std::numeric_limits<std::uint32_t>::max();

/// Why it is not known how near a call came to being accepted.
inline constexpr std::string_view kNothingCompared = "nothing was compared";

/// From the event that begins something to the one after the event that ends it. Of something that
/// a cut-off trace does not see end, the end is that of the trace.
struct EventRange {
  std::uint64_t begin = 0, end = 0;
  double begin_seconds = 0, end_seconds = 0;  ///< since the trace began
  double seconds() const { return end_seconds - begin_seconds; }
};

/// One attempt of an operator or of a sequence. Calls are numbered in the order in which they begin.
/// So those that a call makes, directly or not, have the numbers from its own + 1 up to subtree_end.
struct Call {
  EventRange events;
  std::uint32_t operator_name = 0;  ///< see TraceFile::name()
  std::uint32_t settings = 0;       ///< likewise; see AttemptEvent
  std::uint32_t parent = kNoCall;
  std::uint32_t subtree_end = 0;
  std::uint32_t edits = 0;       ///< made by itself, not by calls in it; also those undone
  std::uint16_t level = 0;       ///< of recursion, as the operator counts it
  std::uint16_t depth = 0;       ///< number of calls around it
  std::uint8_t target_size = 0;  ///< 1 vertex, 2 of an edge, 3 of a face, 4 of a tet
  bool candidate_found = false;  ///< it knew what to do
  bool vector_improved = false;  ///< the vector of what was tried is the better one
  bool undone = false;           ///< it was accepted, and what it found or made was undone later
  Algorithm algorithm = Algorithm::other;
  std::optional<Verdict> verdict;  ///< its own; nothing if the trace ends before
  /// Of one that was undone, the call that undid it, which is around it; see `undone`.
  std::uint32_t undone_with = kNoCall;
  std::array<VertexHandle, 4> target_vertices;
  Quality worst_before = 0, worst_after = 0;    ///< of the vectors; refused: of what was tried
  std::uint32_t bad_before = 0, bad_after = 0;  ///< tets, likewise

  /// By its own verdict; of all edits that are made in a run, most are undone with a caller later.
  bool accepted() const { return verdict == Verdict::accepted; }
  /// What it did has lasted.
  bool accepted_for_good() const { return accepted() && !undone; }
  /// "accepted" for good, "undone with a caller", "no improvement", ...; "cut off" if the trace
  /// ends before: calls with one text ended alike.
  std::string_view verdict_text() const;
  /// The same, and with which call: "undone with call 17".
  std::string verdict_in_words() const;
  /// It has looked for something better: its target is there, and one that it works on.
  bool has_searched() const;
  /// Something was compared: worst_before and worst_after are known.
  bool has_qualities() const { return worst_before != 0 || worst_after != 0; }
  /// How much quality the worst tet of a refused call lacked; negative where that was good enough
  /// and others were not, infinite where nothing was compared.
  double missing() const;
  /// "0.0123", "others" where the worst tet was good enough, or why there is no number; empty for one
  /// that was accepted.
  std::string missing_in_words() const;
  std::span<const VertexHandle> target() const { return {target_vertices.data(), target_size}; }
};

/// A tet that a pass wanted to get rid of, and what was tried.
struct Visit {
  EventRange events;
  TetVertices tet;
  Quality quality = 0;
  std::uint32_t first_call = 0, last_call = 0;  ///< the calls from one up to before the other
};

struct TracedPass {
  EventRange events;
  std::uint32_t name = 0;
  unsigned round = 0;
  Standard standard;                            ///< by which tets were judged
  QualityIndicators now;                        ///< when it ended
  std::uint32_t first_call = 0, last_call = 0;  ///< the calls from one up to before the other
};

/// A user has given an operator another value, which holds from the next pass on.
struct ParameterChange {
  std::uint64_t event = 0;
  std::uint32_t text = 0;  ///< "smoothing: cycles = 3"; see TraceFile::name()
};

/// What is looked at when a trace is opened.
enum class TraceCheck {
  mesh,    ///< the mesh is followed through all events: the trace may be played
  events,  ///< events are read alone, in a third of the time: there is no last mesh, and whether all
           ///< before it are meshes stays open
};

/// Holds the compressed events and an index of them in memory: about 100 bytes a call.
class TraceFile {
 public:
  /// Reads all events once and follows the mesh with them, so that whoever opened a trace may play
  /// it. A trace that is cut off or damaged is opened up to there. Takes no more memory than a few
  /// hundred times the size of the file, and a few MB, whatever that says.
  /// @throws Error when the file cannot be read, is no trace, is of an unknown version, is damaged
  /// before the first event, or when an event makes no sense or no mesh: with byte, event and reason.
  /// Cost: linear; about 0.3 s for a million events.
  explicit TraceFile(const std::filesystem::path& file, TraceCheck check = TraceCheck::mesh);
  /// The same, of bytes that TraceRecorder::so_far() gave. @param name what errors call it
  TraceFile(const std::string& name, std::string_view bytes);
  /// The same, of what a recorder of this program wrote without_mesh; `start` is the mesh that its
  /// events begin with. They are not checked against it. Cost: that of the events.
  TraceFile(const std::string& name, std::string_view bytes, SlotMesh start);

  const std::filesystem::path& path() const { return path_; }
  const TraceHeader& header() const { return header_; }
  /// Before the first event.
  const SlotMesh& initial_mesh() const { return mesh_; }
  /// After the last event. Null: events were not followed, as the mesh was given or none was asked for.
  const SlotMesh* last_mesh() const { return last_mesh_ ? &*last_mesh_ : nullptr; }
  std::uint64_t event_count() const { return events_; }
  std::size_t file_size() const { return frames_.file_size(); }
  /// One line for the user: what is damaged or missing, and how far the trace can be read; empty
  /// for a complete trace.
  const std::string& damage() const { return damage_; }
  /// The trace ends before the run did, because it would have become too large.
  bool limit_reached() const { return limit_reached_; }

  std::span<const TracedPass> passes() const { return passes_; }
  std::span<const Visit> visits() const { return visits_; }
  std::span<const Call> calls() const { return calls_; }
  std::span<const ParameterChange> parameter_changes() const { return parameter_changes_; }
  /// Name of a pass or an operator, settings, or a change of them.
  std::string_view name(std::uint32_t name) const { return names_[name]; }
  /// The innermost call that `event` belongs to, its first and last event included; kNoCall.
  std::uint32_t call_at(std::uint64_t event) const;
  /// How a call ended. Precondition: `call` is one of calls().
  CallEnding ending(const Call& call) const;
  /// Why a call ended as it did, in a sentence. Precondition: `call` is one of calls().
  std::string_view reason(const Call& call) const;
  /// What was edited, and how many of these edits were undone.
  std::size_t edit_count() const { return trials_.edits(); }
  std::size_t undo_count() const { return trials_.undos(); }
  /// The event changed a mesh, or looked at one, that an undo took back later. Cost: logarithmic.
  bool is_undone(std::uint64_t event) const { return trials_.is_undone(event); }

  /// First events of the chunks that the file is made of; see EventCursor.
  std::span<const std::uint64_t> chunk_begins() const { return chunk_begins_; }

 private:
  friend class EventCursor;

  ByteReader frame_of(char kind, std::vector<std::byte>& frame);
  void read();
  void read_beginning();
  void read_chunks(TraceAudit* audit);
  void read_end(const std::vector<std::byte>& frame);
  void index_chunk(const std::vector<std::byte>& frame, TraceAudit* audit);
  void index_event(const TraceEvent& event);
  void begin_visit(const TraceEvent& event);
  void begin_call(const TraceEvent& event);
  void end_call(const TraceEvent& event);
  void undo();
  EventRange begin_of(const TraceEvent& event) const;
  void close(EventRange& range, double seconds) const;
  void close_all();
  void note_initial_qualities();
  void note_qualities(const TraceEvent& event, const SlotMesh& mesh);
  void note_quality(const SlotMesh& mesh, const TetVertices& tet, Quality quality);

  std::filesystem::path path_;
  TraceCheck check_ = TraceCheck::mesh;
  FrameReader frames_;
  TraceHeader header_;
  bool has_start_ = false;  // mesh_ was given, by who made the events
  SlotMesh mesh_;
  std::optional<SlotMesh> last_mesh_;
  std::uint64_t events_ = 0;
  std::string damage_;
  bool ended_ = false;
  bool limit_reached_ = false;
  NameTable names_;
  std::vector<std::uint64_t> chunk_begins_;
  std::vector<std::size_t> chunk_offsets_;
  std::vector<TracedPass> passes_;
  std::vector<Visit> visits_;
  std::vector<Call> calls_;
  std::vector<ParameterChange> parameter_changes_;
  Trials trials_;
  std::vector<std::uint32_t> open_;  // calls, while events are read
  struct Standing {
    std::uint32_t call;
    std::size_t edits;  // that stood when it ended
  };
  std::vector<Standing> accepted_;  // and not undone so far in this chunk; `edits` never falls
  bool visit_open_ = false;
  bool pass_open_ = false;
  Standard standard_;  // at the event read last
  RecordedMeasures measures_;
  double seconds_ = 0;  // of the event read last
};

/// Reads events one after the other, from any on.
class EventCursor {
 public:
  /// Precondition: `file` outlives the cursor.
  explicit EventCursor(const TraceFile& file) : file_(file), names_(file.names_) {}

  /// Number of the event that next() reads. Precondition: at most event_count().
  std::uint64_t position() const { return position_; }
  /// Cost: up to one chunk, less than a millisecond.
  void move_to(std::uint64_t event);
  /// Precondition: position() < event_count(). The event is valid until the next call.
  const TraceEvent& next();

 private:
  void open_chunk(std::size_t chunk);

  const TraceFile& file_;
  std::uint64_t position_ = 0;
  std::size_t chunk_ = static_cast<std::size_t>(-1);
  std::uint64_t chunk_end_ = 0;
  std::vector<std::byte> content_;
  NameTable names_;
  EventDecoder decoder_;
  TraceEvent event_;
};

}  // namespace tetmend
