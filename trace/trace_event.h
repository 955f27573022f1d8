// SPDX-License-Identifier: MIT
// The events of a run, as a trace file holds them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernel/edit.h"
#include "kernel/statistics.h"
#include "kernel/tet_mesh.h"
#include "trace/algorithm.h"
#include "trace/byte_stream.h"
#include "trace/name_table.h"
#include "trace/trace_sink.h"

namespace tetmend {

enum class EventKind : std::uint8_t {
  pass_begins,
  pass_ends,
  visit_begins,  ///< a pass turns to a tet that it wants to get rid of
  visit_ends,
  attempt_begins,
  candidate_found,
  attempt_ends,
  replace_cavity,
  move_vertex,
  add_vertex,
  remove_vertex,
  undo,              ///< of the last edit that was not undone
  standard_changes,  ///< between two passes: tets are judged by another one
  parameter_changes  ///< likewise: a user has given an operator another value
};
inline constexpr std::size_t kEventKinds = 14;

constexpr std::string_view to_string(EventKind kind) {
  constexpr std::array<std::string_view, kEventKinds> kNames = {
      "pass begins",    "pass ends",    "visit begins",    "visit ends",       "attempt begins",
      "candidate",      "attempt ends", "cavity replaced", "vertex moved",     "vertex added",
      "vertex removed", "undo",         "goal changes",    "parameter changes"};
  return kNames[static_cast<std::size_t>(kind)];
}
/// True if the mesh is another after the event.
constexpr bool changes_mesh(EventKind kind) {
  return kind >= EventKind::replace_cavity && kind <= EventKind::undo;
}

/// Edits and candidates take their time from what is around them.
constexpr bool has_time(EventKind kind) {
  return kind != EventKind::candidate_found && !changes_mesh(kind);
}

/// One event. Which members mean something depends on the kind; the others are left as they were.
struct TraceEvent {
  EventKind kind{};
  std::uint32_t name = 0;      ///< of pass or operator, or what changes: see TraceFile::name()
  Algorithm algorithm{};       ///< of an attempt
  Verdict verdict{};           ///< likewise
  std::uint32_t settings = 0;  ///< of the operator; likewise
  std::uint32_t number = 0;    ///< round of a pass, level of an attempt
  double seconds = 0;          ///< since the trace began; not of edits and candidates
  std::vector<VertexHandle> vertices;  ///< of the target, of the visited tet, or of a vertex edit
  Quality quality = 0;                 ///< of the visited tet
  QualityIndicators now;               ///< after a pass
  Standard standard;                   ///< from now on
  std::vector<Quality> before, after;  ///< quality vectors that were compared, ascending
  Point point = Point::Zero();         ///< of an added or moved vertex, after
  /// Slots that a cavity takes away; of a move, the star of the vertex.
  std::vector<TetHandle> removed;
  std::vector<TetHandle> created;
  std::vector<TetVertices> created_vertices;  ///< one for each of `created`
  /// Of a cavity at the surface, whose hull may change there, one for each of `created`. Empty for
  /// a cavity inside: there they are those of `removed`.
  std::vector<Label> created_labels;
  /// By a measure of a program, which readers of the trace do not have: of an edit, the qualities
  /// of `created`, or of the star; of a change of the standard, those of all tets, by slot. Empty
  /// where tetmend knows the measure.
  std::vector<Quality> qualities;
};

/// Writes events into the content of a chunk. Each chunk can be read by itself.
class EventEncoder {
 public:
  std::size_t size() const { return out_.size(); }
  std::span<const std::byte> bytes() const { return out_.bytes(); }
  void clear();
  /// Takes back what was written beyond `size`; may be done for edits only.
  void cut(std::size_t size) { out_.cut(size); }

  // `ticks` is the time since the trace began in units of 64 nanoseconds.
  static constexpr unsigned kTickNanoseconds = 64;
  void pass_begins(std::string_view name, unsigned round, std::uint64_t ticks);
  void pass_ends(const QualityIndicators& now, std::uint64_t ticks);
  void visit_begins(const TetVertices& tet, Quality quality, std::uint64_t ticks);
  void visit_ends(std::uint64_t ticks);
  void attempt_begins(const AttemptEvent& event, std::uint64_t ticks);
  void candidate_found();
  void attempt_ends(Verdict verdict, std::span<const Quality> before, std::span<const Quality> now,
                    std::uint64_t ticks);
  /// Of `mesh`, which has it.
  void standard_changes(const TetMesh& mesh, std::uint64_t ticks);
  /// "smoothing: cycles = 3"
  void parameter_changes(std::string_view text, std::uint64_t ticks);
  /// The last edit of the journal.
  void edit(const TetMesh& mesh, const Journal& journal);
  void undo();

 private:
  void put_kind(EventKind kind);
  void put_time(std::uint64_t ticks);
  void put_name(std::string_view name);
  void put_vertices(std::span<const VertexHandle> vertices);
  void put_qualities(std::span<const Quality> qualities);
  void note_qualities(const TetMesh& mesh, const Journal& journal);
  void replace_cavity(const TetMesh& mesh, const Journal& journal, const Edit& edit);
  void put_labels(const TetMesh& mesh, const Journal& journal, const Edit& edit);

  ByteWriter out_;
  std::uint64_t last_ticks_ = 0;
  std::vector<std::string> names_;           // of this chunk
  std::array<std::uint8_t, 256> guesses_{};  // numbers of names, by the place of their text
  std::vector<Quality> qualities_;
};

/// Reads the events of a chunk.
class EventDecoder {
 public:
  /// Begins a chunk. `names` are those of the file: new ones are added.
  void begin(std::span<const std::byte> content, NameTable& names);
  /// What the event says is in its own bounds; whether it fits the mesh is for others to see.
  /// @throws ByteReader::Damage
  void next(TraceEvent& event);
  bool at_end() const { return in_.at_end(); }

 private:
  /// A name of this chunk, and what it is the name of.
  struct Name {
    std::uint32_t number;  ///< in the list of the file
    Algorithm algorithm;
    std::optional<Verdict> verdict;
  };

  void get_time(TraceEvent& event);
  const Name& get_name();
  void get_vertices(TraceEvent& event);
  void get_point(TraceEvent& event);
  void get_qualities(std::vector<Quality>& qualities);
  void get_cavity(TraceEvent& event);
  void get_labels(TraceEvent& event);
  void get_star(TraceEvent& event);
  void get_noted(TraceEvent& event);

  ByteReader in_{{}};
  std::uint64_t ticks_ = 0;
  NameTable* names_ = nullptr;
  std::vector<Name> chunk_names_;
};

}  // namespace tetmend
