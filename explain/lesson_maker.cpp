// SPDX-License-Identifier: MIT
#include "explain/lesson_maker.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "explain/call_facts.h"
#include "explain/call_study.h"
#include "explain/page.h"
#include "explain/paper_lines.h"
#include "explain/question.h"
#include "kernel/error.h"

namespace tetmend::explain {

namespace {

constexpr std::size_t kMostSteps = 12;

using enum Focus;

class LessonProposal {
 public:
  LessonProposal(const TraceFile& file, Replay& replay, std::uint32_t call)
      : file_(file), replay_(replay), number_(call), call_(file.calls()[call]) {}

  std::vector<LessonStep> make() {
    introduce();
    tell_of_calls();
    LessonStep last{call_.events.end, told_end(number_), {picture, tree}};
    std::stable_sort(story_.begin(), story_.end(),
                     [](const LessonStep& a, const LessonStep& b) { return a.at < b.at; });
    for (LessonStep& step : story_) {
      if (step.at >= call_.events.end || steps_.size() + 1 >= kMostSteps) break;
      if (step.at > steps_.back().at) steps_.push_back(std::move(step));
    }
    steps_.push_back(std::move(last));
    return std::move(steps_);
  }

 private:
  std::uint64_t begin() const { return call_.events.begin + 1; }

  std::string told_end(std::uint32_t call) {
    const Call& c = file_.calls()[call];
    return fmt::format("Call {}, {} at {}, ends: {}. {}", call, short_name(file_, c),
                       format_target(c), c.verdict_in_words(),
                       explain_end(file_, study_call(file_, replay_, call)));
  }

  /// One more step where the call begins, with a question; none where the trace has no answer.
  void ask(std::string text, std::vector<Focus> focus, Ask question) {
    if (questions_ == kProposedQuestions || !try_answer(file_, replay_, begin(), question)) return;
    steps_.push_back({begin(), std::move(text), std::move(focus), std::move(question)});
    ++questions_;
  }

  void introduce() {
    const CallFacts facts = facts_.facts(file_, replay_, number_);
    std::string about = fmt::format("Call {} of a run on {}: {} at {}, on level {}.", number_,
                                    file_.header().input.empty() ? "a mesh" : file_.header().input,
                                    short_name(file_, call_), format_target(call_), call_.level);
    if (facts.degree_before > 0) {
      about += fmt::format(" {} tets are around its target, and the worst has quality {:.4f}.",
                           facts.degree_before, facts.quality_before);
    }
    ask(std::move(about), {picture}, {Ask::Kind::accepted, "Will it be accepted?"});
    if (const Pseudocode* code = code_of(file_, call_)) {
      ask(fmt::format("It follows {}.", code->title), {algorithm},
          {Ask::Kind::line, "Which line comes next?"});
    }
    const std::string ring_text =
        "The ring around its edge: each triangle of a covering makes two tets.";
    if (study_call(file_, replay_, number_).covering) {  // else no chord of its ring is better
      ask(ring_text, {ring}, {Ask::Kind::chord, "Pick a chord of the covering that it finds."});
    }
    ask(ring_text, {ring},
        {Ask::Kind::number, "How many triangulations has the ring?", "triangulations"});
    ask("Its first change puts new tets in the place of old ones.", {picture},
        {Ask::Kind::number, "How many tets will be made?", "tets made"});
    ask("An operator may call others, and these may, too.", {picture},
        {Ask::Kind::number, "How many calls will there be in it?", "calls"});
    ask("Levels count how often a procedure has called itself.", {picture},
        {Ask::Kind::number, "Which is the deepest level it will reach?", "deepest level"});
  }

  /// Into each level, and the first refusal of each kind and the first change.
  void tell_of_calls() {
    std::set<unsigned> levels = {call_.level};
    std::set<std::string_view> reasons;
    bool has_changed = false;
    for (std::uint32_t k = number_; k < call_.subtree_end; ++k) {
      const Call& c = file_.calls()[k];
      if (k > number_ && levels.insert(c.level).second) {
        story_.push_back(
            {c.events.begin + 1,
             fmt::format("On level {}: {} at {}.", c.level, short_name(file_, c), format_target(c)),
             {picture, tree}});
      }
      if (k > number_ && !c.accepted() && reasons.insert(file_.reason(c)).second) {
        story_.push_back({c.events.end, told_end(k), focus_of(k)});
      }
      if (!has_changed && c.edits > 0) has_changed = tell_of_change(k);
    }
  }

  /// The ring, of a call that has one.
  std::vector<Focus> focus_of(std::uint32_t call) {
    const CallStudy study = study_call(file_, replay_, call);
    if (study.picture && study.picture->ring.size() >= 3) return {picture, ring};
    return {picture};
  }

  bool tell_of_change(std::uint32_t call) {
    const Call& c = file_.calls()[call];
    EventCursor cursor(file_);
    cursor.move_to(c.events.begin);
    while (cursor.position() < c.events.end) {
      if (!changes_mesh(cursor.next().kind)) continue;
      const std::uint64_t home = replay_.position();
      replay_.seek(cursor.position());
      const Cavity cavity = replay_.cavity();
      replay_.seek(home);
      story_.push_back(
          {cursor.position(),
           fmt::format("{} tets give way to {}.", cavity.removed.size(), cavity.created.size()),
           {picture, ring}});
      return true;
    }
    return false;
  }

  const TraceFile& file_;
  Replay& replay_;
  std::uint32_t number_;
  const Call& call_;
  FactTable facts_;
  std::size_t questions_ = 0;
  std::vector<LessonStep> steps_;  // those of the beginning, then all
  std::vector<LessonStep> story_;  // those of calls in it
};

}  // namespace

Lesson propose_lesson(const TraceFile& file, Replay& replay, std::uint32_t call,
                      const std::string& title) {
  if (!file.calls()[call].verdict) {
    throw Error(fmt::format("{}: the trace ends before call {} does", file.path().string(), call));
  }
  Lesson lesson;
  lesson.title = title.empty() ? title_of_call(file, call) : title;
  lesson.trace = file.path();
  lesson.call = call;
  lesson.steps = LessonProposal(file, replay, call).make();
  return lesson;
}

}  // namespace tetmend::explain
