// SPDX-License-Identifier: MIT
// A recorded run: what Options::trace wrote, opened for reading.
//
//   tetmend::Trace trace("run.trace");
//   for (std::uint32_t c = 0; c < trace.call_count(); c = trace.call(c).subtree_end) {
//     std::puts(std::string(trace.call(c).verdict).c_str());
//   }
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tetmend/mesh.h>
#include <tetmend/statistics.h>

namespace tetmend {

/// Holds the compressed events and an index of them in memory: about 90 bytes a call. Events, calls
/// and vertices are numbered from 0; vertices as the run numbered them. Reading from several threads
/// at once is safe.
class TETMEND_API Trace {
 public:
  /// From the event that begins something to the one after the event that ends it.
  struct Range {
    std::uint64_t begin = 0;   ///< its number
    std::uint64_t end = 0;     ///< likewise
    double begin_seconds = 0;  ///< since the trace began
    double end_seconds = 0;    ///< likewise
  };

  /// A pass of the schedule.
  struct Pass {
    std::string_view name;         ///< as in the report
    unsigned round = 0;            ///< of the schedule; 0 before its main loop
    Range events;                  ///< all of it
    std::uint32_t first_call = 0;  ///< its calls begin with this
    std::uint32_t last_call = 0;   ///< and end before this
    QualityIndicators after;       ///< of the mesh
  };

  /// A tet that a pass wanted to get rid of.
  struct Visit {
    Range events;                    ///< all of it
    std::vector<std::uint32_t> tet;  ///< its four vertices
    double quality = 0;              ///< of the tet, when the visit began
    std::uint32_t first_call = 0;    ///< as of a pass
    std::uint32_t last_call = 0;     ///< likewise
  };

  /// One attempt of an operator. Those that it makes, directly or not, have the numbers from its own
  /// + 1 up to before subtree_end.
  struct Call {
    std::string_view operator_name;       ///< "smoothing"
    std::string_view settings;            ///< its parameters where they differ from the defaults
    Range events;                         ///< all of it
    std::optional<std::uint32_t> parent;  ///< the call that made it
    std::uint32_t subtree_end = 0;        ///< the next call that it has not made
    unsigned level = 0;                   ///< of recursion, as the operator counts it
    unsigned depth = 0;                   ///< number of calls around it
    unsigned edits = 0;                   ///< made by itself; also those undone
    std::vector<std::uint32_t>
        target;  ///< a vertex, two of an edge, three of a face, four of a tet
    /// "accepted" for good, "undone with a caller", "no improvement", ...; "cut off" if the trace
    /// ends before
    std::string_view verdict;
    std::string_view reason;  ///< in a sentence
    bool accepted = false;    ///< by its own verdict; whether that lasted, for_good says
    bool for_good = false;    ///< accepted, and what it did was not undone later
    std::optional<std::uint32_t> undone_with;  ///< the call around it that undid what it did
    double worst_before = 0;                   ///< quality of the worst tet that it changed
    double worst_after = 0;                    ///< likewise; refused: of what was tried
    /// How much quality the worst tet of a refused call lacked, negative where others were the reason;
    /// nothing where nothing was compared
    std::optional<double> missing;
  };

  /// Calls of one operator on one level of recursion that ended alike.
  struct Entry {
    std::string_view operator_name;  ///< "smoothing"
    unsigned level = 0;              ///< of recursion
    /// "accepted for good", "undone with a caller", "nothing better", "vector not better", ...
    std::string_view ending;
    std::string_view reason;             ///< of it, in a sentence
    bool is_refusal = false;             ///< neither accepted nor cut off
    std::size_t calls = 0;               ///< their number
    double share = 0;                    ///< of all calls of the operator on the level
    double seconds = 0;                  ///< of these calls, without calls in them
    std::optional<double> nearest = {};  ///< of refused calls: the least of Call::missing
  };

  /// A place where one run left a bad tet and another a good one.
  struct TetPair {
    std::vector<std::uint32_t> bad;  ///< its four vertices, as the one run numbered them
    double bad_quality = 0;          ///< below 1
    std::vector<std::uint32_t>
        good;                 ///< of the tet that has the centroid of the bad one, in the other
    double good_quality = 0;  ///< at least 1
  };

  /// One event.
  struct Event {
    std::string_view kind;          ///< "pass begins", "cavity replaced", ...
    std::string name;               ///< of the pass or operator, where one begins
    std::optional<double> seconds;  ///< since the trace began; not of edits and candidates
    std::vector<std::uint32_t>
        vertices;              ///< of the target or visited tet, or the one vertex edited
    std::string_view verdict;  ///< where an attempt ends
    std::size_t removed = 0;   ///< tets, where a cavity is replaced
    std::size_t created = 0;   ///< likewise
  };

  /// Reads all events once. A trace that is cut off or damaged is opened up to there: see damage().
  /// @throws Error when the file cannot be read, is no trace, is of an unknown version, or when an
  /// event makes no sense: with byte, event and reason. Cost: about 0.3 s for a million events.
  explicit Trace(const std::filesystem::path& file);
  ~Trace();
  Trace(Trace&& other) noexcept;             ///< what was moved from can only be assigned to
  Trace& operator=(Trace&& other) noexcept;  ///< likewise

  const std::string& program() const;                                        ///< "tetmend 0.1.0"
  const std::string& input() const;                                          ///< file of the mesh
  const std::string& schedule() const;                                       ///< its name
  const std::vector<std::pair<std::string, std::string>>& settings() const;  ///< of the schedule
  const std::string& filter() const;  ///< what was left out, in words; empty: nothing
  const std::string& damage() const;  ///< how far it can be read and why; empty: it is complete
  bool limit_reached() const;         ///< the trace ends before the run, for its size

  std::uint64_t event_count() const;  ///< of all kinds
  std::uint32_t call_count() const;   ///< attempts of operators
  std::size_t visit_count() const;    ///< of bad tets
  std::size_t pass_count() const;     ///< of the schedule
  /// @throws Error unless the number is less than the count; also the next two.
  Call call(std::uint32_t number) const;
  Visit visit(std::size_t number) const;  ///< by its number
  Pass pass(std::size_t number) const;    ///< by its number
  /// The events from one up to before the other. @throws Error when there are not so many.
  /// Cost: the events, and up to a millisecond.
  std::vector<Event> events(std::uint64_t first, std::uint64_t last) const;

  /// The mesh after the first n events, 0 to event_count(). @throws Error when there are not so
  /// many. Cost: a microsecond for each of them.
  Mesh mesh_at(std::uint64_t n) const;
  /// Of each tet of mesh_at(n), in its order, the quality that the run had for it: below 1 it was
  /// bad, and inverted below 0. Also by a measure of a program. @throws Error and cost: as
  /// mesh_at()
  std::vector<float> quality_at(std::uint64_t n) const;
  /// What tets were judged by when the run began: "sine_and_length", "sine", or the name of a
  /// measure of a program or of a plugin.
  std::string_view measure() const;

  /// The whole of the run, by operator, level and ending: each call is in one entry, and none is
  /// empty. Cost: a tenth of a microsecond a call.
  std::vector<Entry> ledger() const;
  /// Numbers of the calls of an entry, those nearest to being accepted first: by how much quality
  /// their worst tet lacked. Cost: likewise.
  std::vector<std::uint32_t> calls_of(const Entry& entry) const;

  /// Where this run left a bad tet and the other a good one at its end, the worst first. Cost: replay
  /// of both, and a pass over their tets.
  std::vector<TetPair> worse_than(const Trace& other) const;

  // What `tetmend trace` prints.

  std::string summary() const;  ///< in numbers
  /// Two runs side by side, as `--against`: this one is a. Cost: that of worse_than(), and histories.
  std::string against(const Trace& other) const;
  /// Why a tet, face, edge or vertex is there or gone: "tet:worst", "tet:3,5,8,9", "edge:3,5", in
  /// the numbers of the trace. @throws Error when it is written in another way or was never there.
  /// Cost: replay of the trace.
  std::string history(std::string_view what) const;
  std::string tree(std::uint32_t call) const;  ///< a call and all in it
  std::string dot(std::uint32_t call) const;   ///< the same for Graphviz
  /// All of it as JSON for Perfetto and chrome://tracing, handed over piece by piece.
  void write_slices(const std::function<void(std::string_view)>& write) const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace tetmend
