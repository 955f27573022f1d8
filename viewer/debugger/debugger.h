// SPDX-License-Identifier: MIT
// A trace that is being looked at: the place in it, and all that leads from place to place.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "explain/call_facts.h"
#include "explain/call_study.h"
#include "explain/event_text.h"
#include "explain/figures/call_figure.h"
#include "explain/lesson_guide.h"
#include "explain/question.h"
#include "explain/stepper.h"
#include "explain/table_filling.h"
#include "explain/timeline.h"
#include "kernel/tet_mesh.h"
#include "trace/history.h"
#include "trace/replay.h"
#include "viewer/debugger/call_list.h"
#include "viewer/debugger/condition.h"
#include "viewer/debugger/explained.h"
#include "viewer/debugger/other_run.h"
#include "viewer/debugger/trace_mesh.h"

namespace tetmend::viewer {

/// Calls of which a condition holds, as a list to go through.
struct FoundCalls {
  Condition condition;
  std::vector<std::uint32_t> calls;  ///< see find_all()
};

/// A question of a lesson, and what was answered. The first answer counts.
struct LessonQuestion {
  explain::Question question;
  std::string typed;                  ///< what the user is about to answer
  std::optional<bool> is_right = {};  ///< of the answer; none yet
  /// What is asked and, once it is answered, whether it is right, and why.
  std::string text(bool is_answered) const;
};

/// Moves that lead nowhere leave the position as it is.
class Debugger {
 public:
  /// @throws Error as TraceFile does, or for a damaged lesson. Cost: plays the trace twice.
  explicit Debugger(const std::filesystem::path& file);
  /// Of bytes that are in no file, see TraceRecorder::so_far(). @param name what errors call it
  Debugger(const std::string& name, std::string_view bytes);
  /// Of events that begin with `start`, which was recorded without its mesh. Cost: as TraceFile, a
  /// copy of the slots and a look at the quality of each tet.
  Debugger(const std::string& name, std::string_view bytes, const TetMesh& start);

  const TraceFile& file() const { return file_; }
  std::uint64_t position() const { return replay_.position(); }
  std::uint64_t end() const { return file_.event_count(); }
  /// What happened last, in words; at the beginning of the trace says so.
  std::string last_event() const { return event_text(file_, position()); }
  /// The call that the last event belongs to, and those around it, outermost first.
  const std::vector<std::uint32_t>& stack() const { return stack_; }
  /// The innermost of them, or kNoCall.
  std::uint32_t call() const { return stack_.empty() ? kNoCall : stack_.back(); }
  /// The visit of a tet that the last event belongs to.
  std::optional<std::uint32_t> visit() const { return visit_at(file_, position()); }

  /// Precondition: at most end(). Cost: see Replay.
  void seek(std::uint64_t position);
  /// Where tables are filled, into goes cell by cell, and over from a cell to the next diagonal.
  void step(Step step, Direction direction);
  /// To the beginning of a call, just after its first event. Precondition: there is such a call.
  void enter(std::uint32_t call) { seek(file_.calls()[call].events.begin + 1); }
  /// False if there is no such place.
  bool run_to(const Condition& condition, Direction direction);
  /// To the nearest place at which a breakpoint holds, or to the end of the trace (back: the
  /// beginning). Gives the breakpoint.
  std::optional<Condition> run(Direction direction);
  /// Call in the deepest nesting, or kNoCall.
  std::uint32_t deepest_call() const;

  std::vector<Breakpoint> breakpoints;
  std::map<std::uint64_t, std::string> bookmarks;  ///< by position
  CallWindow zoom;  ///< what the strip shows of its window; of no events: all of it
  std::string typed_condition = "accepted for good";  ///< what the user is about to run to

  // Play: as many events a second as `speed` says.
  bool playing = false;
  double speed = 4;
  /// Plays for a while; stops at breakpoints and at the end. False if nothing moved.
  bool advance(double seconds);

  /// With the handle numbers of the run. Cost: linear, about half a second for a million tets.
  TetMesh mesh();
  /// Instead of mesh(), for who has the mesh of now with the handle numbers of the run.
  void know_mesh() { trace_mesh_.know(replay_); }
  /// The mesh that the events begin with has moved there. Precondition: it was given when this was
  /// made.
  void lend(const TetMesh& start) { replay_.lend(start); }
  /// Makes the mesh that mesh() gave last the one of now. Cost: that of what changed meanwhile.
  MeshStep follow(TetMesh& mesh) { return trace_mesh_.follow(replay_, mesh); }
  /// Tets that contain all of these vertices, by slot.
  std::vector<TetHandle> tets_around(std::span<const VertexHandle> vertices) {
    return replay_.tets_around(vertices);
  }
  /// Equal numbers: equal meshes.
  std::size_t mesh_number() const { return timeline_.changes_before(position()); }
  const Timeline& timeline() const { return timeline_; }
  const CallFacts& facts(std::uint32_t call) { return facts_.facts(file_, replay_, call); }
  /// Of call(); null outside of all calls. Computed once for each stay in a call.
  const CallStudy* study();
  /// As it is here. Precondition: the study has a picture.
  PolygonView polygon();
  /// The tables of the call at hand: filled by steps where it fills them, while they are looked at.
  /// Without cells where it has none.
  TableFilling tables();
  /// Somebody looks at them, without a lesson that does.
  bool shows_tables = false;
  /// @throws Error as draw_call()
  figure::Drawing draw(const FigureRequest& request) { return draw_call(file_, replay_, request); }
  /// Whom a question is about, as find_subject() reads it. @throws Error as that.
  HistorySubject subject_of(std::string_view text);
  /// Asks what the trace knows of something, and keeps the answer. Stays where it is.
  /// @throws Error as history_of(), and the last answer stays. Cost: replay of the whole trace.
  void ask_history(const HistorySubject& subject);
  /// The last answer.
  const std::optional<History>& history() const { return history_; }
  std::string asked;  ///< what the user is about to ask
  /// The whole of the run. Made once, see make_ledger().
  const Ledger& ledger();
  /// Lists the calls of a condition, and keeps the list. Stays where it is.
  /// @throws Error as find_all()
  void list_calls(const Condition& condition);
  const std::optional<FoundCalls>& found() const { return found_; }
  void forget_found() { found_.reset(); }
  /// What was asked for last, until a window has shown it.
  enum class News { none, history, found, pair };
  News news = News::none;
  /// @throws Error as TraceFile does. Cost: see compare_runs().
  void compare_with(const std::filesystem::path& file);
  /// Null without one.
  const OtherRun* other() const { return other_.get(); }
  /// Looks at the place of one of the tets that are bad here and good there; asks about the tet.
  /// @throws Error if there is no such number. Cost: a history in each run
  void look_at_pair(std::size_t number);
  const std::optional<Lesson>& lesson() const { return lesson_; }
  /// Of a step of the lesson; null where it asks nothing, or what the trace does not answer.
  /// Precondition: there is a lesson with so many steps.
  const LessonQuestion* question_of(std::size_t step) const {
    return questions_[step] ? &*questions_[step] : nullptr;
  }
  /// The first question at this place that has no answer; null without one.
  LessonQuestion* open_question();
  /// Answers it. @throws Error where there is none, and as explain::is_right() does
  const LessonQuestion& answer(std::string_view words);
  /// How many questions have an answer, and how many of these a right one.
  std::array<std::size_t, 2> score() const;
  /// The tree of the calls of the pass at hand, as far as it is unfolded. Valid until the next
  /// call.
  const std::vector<CallRow>& rows() {
    return list_.rows(file_, pass_around(file_, position()), stack_);
  }
  void fold(std::uint32_t call) { list_.toggle(call); }

 private:
  explicit Debugger(TraceFile file, const TetMesh* start = nullptr);
  /// What looks at other places of the trace, and comes back.
  template <class Look>
  void stay(const Look& look);
  std::optional<std::uint64_t> nearest_breakpoint(Direction direction, Condition* which);
  bool step_in_tables(Step step, Direction direction);
  /// The call at hand fills its tables here, and somebody looks at that.
  bool fills_by_steps() const;
  ConditionSource source() { return {file_, replay_}; }

  TraceFile file_;
  Replay replay_;
  Timeline timeline_;
  TraceMesh trace_mesh_;
  FactTable facts_;
  CallList list_;
  std::vector<std::uint32_t> stack_;
  std::optional<CallStudy> study_;
  std::size_t cell_ = 0;  // of tables that are being filled: how many are
  std::optional<History> history_;
  std::optional<Ledger> ledger_;
  std::optional<FoundCalls> found_;
  std::unique_ptr<OtherRun> other_;
  std::optional<Lesson> lesson_;
  std::vector<std::optional<LessonQuestion>> questions_;  // of its steps
  double unplayed_ = 0;                                   // share of an event
};

}  // namespace tetmend::viewer
