// SPDX-License-Identifier: MIT
// What a trace knows of one tet, face, edge or vertex: where it came from, who aimed at it, with what
// answer, and what was missing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trace/replay.h"

namespace tetmend {

/// Whom a trace is asked about: 1 vertex, 2 of an edge, 3 of a face, 4 of a tet; ascending.
using HistorySubject = std::vector<VertexHandle>;

/// "vertex", "edge", "face" or "tet".
std::string_view kind_of(std::span<const VertexHandle> part);
/// "edge 3 17".
std::string in_words(std::span<const VertexHandle> part);
/// "edge:3,17", as find_subject() reads it.
std::string as_question(std::span<const VertexHandle> part);

/// A call that aimed at the subject or at a part of it.
struct HistoryCall {
  std::uint32_t call = kNoCall;
  bool in_trial = false;  ///< it worked on a mesh that was undone afterwards
};

/// The subject, or a part of it: an edge, a face or a vertex.
struct PartHistory {
  HistorySubject part;
  bool on_surface = false;
  std::uint32_t calls = 0;     ///< that aimed at it, those in trials left out
  std::uint32_t accepted = 0;  ///< of these, for good
  std::uint32_t undone = 0;    ///< of these, accepted and undone with a caller
  std::uint32_t in_trials = 0;
  /// Of `calls`, the refused one that came nearest to what was needed; else the last one.
  std::uint32_t nearest = kNoCall;
};

struct History {
  HistorySubject subject;
  /// Events that made it and took it away, edits that were undone left out: it was there from one
  /// up to before the other. From the beginning: 0; to the end of the trace: nothing.
  std::uint64_t made = 0;
  std::optional<std::uint64_t> removed;
  bool from_beginning = false;
  std::uint32_t made_by = kNoCall, removed_by = kNoCall;  ///< the innermost calls
  std::uint32_t moves = 0;                                ///< of its vertices while it was there
  std::vector<std::uint32_t> visits;  ///< of a tet, by passes that wanted to get rid of it
  std::vector<HistoryCall> calls;
  std::vector<PartHistory> parts;  ///< with the subject itself, the largest first
  Quality quality = 0;             ///< of a tet, when it was there last
  std::array<double, 6> angles{};  ///< likewise, in degrees
};

/// The history of what was there last.
/// @throws Error when nothing of the kind was there for good.
/// Cost: one reading of the trace, and of what is gone a replay to when it was there last. Leaves the
/// replay somewhere. Precondition: `replay` is of `file`.
History history_of(const TraceFile& file, Replay& replay, const HistorySubject& subject);

/// What people write: "tet:17", "tet:worst", "tet:3,5,8,9" (its vertices), "edge:3,5", "face:3,5,8",
/// "vertex:3". Numbers are those of the trace at its end; with "@FILE" behind, those of a mesh file,
/// counted from 1, which is what the run wrote or read.
/// @throws Error when it is written in another way, or not found, with the reason.
HistorySubject find_subject(const TraceFile& file, Replay& replay, std::string_view text);

/// The mesh file that such a text names; empty: none. @throws Error when it is written in another way.
std::filesystem::path file_of_question(std::string_view text);

/// A paragraph that answers why it is there or gone.
std::string history_paragraph(const TraceFile& file, const History& history);
/// A line for each part and each call, then the paragraph, which is what a terminal shows last.
/// `most_calls`: of more calls, those that came nearest, and a line that counts the others.
std::string history_text(const TraceFile& file, const History& history,
                         std::size_t most_calls = std::numeric_limits<std::size_t>::max());

}  // namespace tetmend
