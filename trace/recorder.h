// SPDX-License-Identifier: MIT
// Writes the trace of a run into a file while it runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trace/trace_event.h"
#include "trace/trace_frame.h"
#include "trace/trace_sink.h"

namespace tetmend {

/// What a trace says about the run as a whole.
struct TraceHeader {
  std::string program;  ///< name and version
  std::string input;    ///< file of the mesh
  std::string schedule;
  std::string schedule_text;
  std::vector<std::pair<std::string, std::string>> settings;  ///< of the schedule
  std::string filter;  ///< what is left out, in words; empty: nothing

  void encode(ByteWriter& out) const;
  /// @throws ByteReader::Damage
  static TraceHeader decode(ByteReader& in);
};

/// A place in the mesh.
struct TraceBall {
  Point centre = Point::Zero();
  double radius = 0;
};

/// Which attempts are written. Those that are not leave no event, except for what they changed
/// for good: replay is exact all the same.
struct TraceFilter {
  using Ball = TraceBall;
  std::optional<Ball> around = {};          ///< a vertex of the outermost target lies in it
  std::vector<std::string> operators = {};  ///< of these, with all that they call; empty: any
  /// Attempts nested deeper are left out; 0: only the outermost are written.
  unsigned depth = std::numeric_limits<unsigned>::max();
  /// The trace ends before the file grows beyond so many bytes; header and mesh are always there.
  std::size_t most_bytes = std::numeric_limits<std::size_t>::max();

  std::string describe() const;
};

/// Where the times of events come from.
enum class TraceClock : std::uint8_t {
  real,
  steps  ///< about a microsecond for each event: equal runs give equal traces
};

/// Whether a trace in memory has the mesh that its events begin with.
enum class TraceBeginning : std::uint8_t {
  with_mesh,
  without_mesh  ///< who reads it has that already, see TraceFile
};

/// How a trace ended.
enum class TraceEnd : std::uint8_t { complete, limit_reached };

/// A file that is being written is FILE.part, and can be read up to the last chunk; finish() gives
/// it its name, and a crash leaves it. Trouble with the file, or too little memory, ends the trace,
/// not the run: finish() reports it. Cost: linear in the mesh at the beginning, about 100 bytes in
/// memory and 10 in the file for each attempt.
class TraceRecorder final : public TraceSink {
 public:
  /// @throws Error when the file cannot be written.
  /// Precondition: `mesh` is the one of the run, outlives the recorder, and no transaction is open.
  TraceRecorder(const std::filesystem::path& file, const TetMesh& mesh, TraceHeader header,
                TraceFilter filter = {}, TraceClock clock = TraceClock::real);
  /// A trace in memory, for who looks at it with so_far(). Precondition: `memory` outlives this, too.
  TraceRecorder(std::string& memory, const TetMesh& mesh, TraceHeader header,
                TraceClock clock = TraceClock::real,
                TraceBeginning beginning = TraceBeginning::with_mesh);
  /// Without finish() nothing stays.
  ~TraceRecorder() override;
  TraceRecorder(const TraceRecorder&) = delete;
  TraceRecorder& operator=(const TraceRecorder&) = delete;

  /// Events so far.
  std::uint64_t event_count() const { return events_; }
  /// False once the limit is reached or the file made trouble.
  bool is_active() const { return active_; }
  /// Writes what is left. No event may follow; the mesh is not looked at any more.
  /// @throws Error when the file could not be written, now or earlier.
  void finish();
  /// The same, but the file gets its name later, by commit_all() or finish(). Precondition: there is
  /// a file.
  formats::PendingFile& complete();
  /// A whole trace of what there is so far, also in the middle of an attempt; more events may
  /// follow. Precondition: it is in memory. @throws Error when memory ran out earlier
  std::string so_far();

  void pass_begins(std::string_view name, unsigned round) override;
  void pass_ends(const QualityIndicators& now) override;
  void visit_begins(const TetVertices& tet, Quality quality) override;
  void visit_ends() override;
  void standard_changed(const Standard& standard) override;
  /// Between two passes a user has given an operator another value, in words.
  void parameter_changed(std::string_view text);
  void attempt_begins(const AttemptEvent& event) override;
  void candidate_found() override;
  void attempt_ends(Verdict verdict, std::span<const Quality> before,
                    std::span<const Quality> now) override;
  void edit_made(const TetMesh& mesh, const Journal& journal) noexcept override;
  void edit_undone() noexcept override;

 private:
  struct Open {
    bool near;     // the outermost target is where the filter looks
    bool inside;   // of what the filters choose
    bool written;  // and not too deep
  };
  struct Visit {
    TetVertices tet;
    Quality quality;
    bool written;
  };

  template <class Write>
  void record(const Write& write) noexcept;
  std::uint64_t ticks() const;
  bool is_near(const AttemptEvent& event) const;
  bool is_wanted(std::string_view operator_name) const;
  bool is_written() const { return !open_.empty() && open_.back().written; }
  void wrote_event();
  void begin_attempt(const AttemptEvent& event);
  void take_back_edit();
  void begin(TraceHeader header);
  void end();
  std::span<const std::byte> chunk();
  std::span<const std::byte> end_frame(TraceEnd end);
  void write_chunk();
  void write_frame(char kind, std::span<const std::byte> content);

  const TetMesh& mesh_;
  TraceFilter filter_;
  TraceClock clock_;
  TraceBeginning beginning_ = TraceBeginning::with_mesh;
  std::string* memory_ = nullptr;  // null: there is a file
  FrameWriter file_;
  std::string trouble_;
  bool active_ = true;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  EventEncoder encoder_;
  ByteWriter content_;
  std::uint64_t events_ = 0;
  std::uint64_t chunk_begin_ = 0;  // number of its first event
  std::optional<Visit> visit_;
  std::vector<Open> open_;          // attempts
  std::vector<std::size_t> edits_;  // of the outermost attempt, not undone: where they begin
  std::size_t fence_ = 0;           // what was written before this must stay
};

}  // namespace tetmend
