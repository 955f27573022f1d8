// SPDX-License-Identifier: MIT
#include "viewer/debugger/debugger.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "kernel/error.h"

namespace tetmend::viewer {

Debugger::Debugger(TraceFile file, const TetMesh* start)
    : file_(std::move(file)), replay_(file_), timeline_(make_timeline(file_, replay_, start)) {}

Debugger::Debugger(const std::filesystem::path& file) : Debugger(TraceFile(file)) {
  lesson_ = lesson_of(file, file_.event_count());
  if (!lesson_) return;
  for (const LessonStep& step : lesson_->steps) {
    std::optional<LessonQuestion>& asked_there = questions_.emplace_back();
    if (!step.ask) continue;
    if (auto question = explain::try_answer(file_, replay_, step.at, *step.ask)) {
      asked_there = LessonQuestion{std::move(*question), {}};
    }
  }
}

Debugger::Debugger(const std::string& name, std::string_view bytes)
    : Debugger(TraceFile(name, bytes)) {}

Debugger::Debugger(const std::string& name, std::string_view bytes, const TetMesh& start)
    : Debugger(TraceFile(name, bytes, SlotMesh(start)), &start) {
  replay_.lend(start);
}

void Debugger::seek(std::uint64_t position) {
  const std::uint32_t before = call();
  replay_.seek(position);
  stack_ = call_stack(file_, position);
  cell_ = 0;
  if (call() != before) study_.reset();
}

void Debugger::step(Step step, Direction direction) {
  if (step_in_tables(step, direction)) return;
  seek(step_from(file_, position(), step, direction));
  // Backwards, a table is full before it is emptied.
  const bool is_back_into = step == Step::into && direction == Direction::back;
  if (is_back_into && fills_by_steps()) cell_ = tables().cells.size();
}

bool Debugger::step_in_tables(Step step, Direction direction) {
  if (step == Step::out || !fills_by_steps()) return false;
  const TableFilling filling = tables();
  const bool is_over = step == Step::over;
  if (direction == Direction::back) {
    if (cell_ == 0) return false;
    cell_ = is_over ? 0 : cell_ - 1;
    return true;
  }
  if (is_over && cell_ == 0) return false;  // over all of them
  const auto diagonal = after_diagonal(filling);
  if (cell_ == filling.cells.size() || (is_over && !diagonal)) return false;
  cell_ = is_over ? *diagonal : cell_ + 1;
  return true;
}

std::string LessonQuestion::text(bool is_answered) const {
  if (!is_answered) return question.ask.text;
  const char* verdict = is_right == true ? "Right." : "Not so.";
  return fmt::format("{} {} {}", question.ask.text, verdict, question.why);
}

LessonQuestion* Debugger::open_question() {
  for (std::size_t step = 0; step < questions_.size(); ++step) {
    if (lesson_->steps[step].at != position()) continue;
    if (questions_[step] && !questions_[step]->is_right) return &*questions_[step];
  }
  return nullptr;
}

const LessonQuestion& Debugger::answer(std::string_view words) {
  LessonQuestion* open = open_question();
  if (open == nullptr) throw Error("no question is open here");
  open->is_right = explain::is_right(open->question, words);
  return *open;
}

std::array<std::size_t, 2> Debugger::score() const {
  std::array<std::size_t, 2> score{};
  for (const auto& question : questions_) {
    if (!question || !question->is_right) continue;
    ++score[0];
    score[1] += *question->is_right ? 1 : 0;
  }
  return score;
}

bool Debugger::fills_by_steps() const {
  if (call() == kNoCall || !fills_tables(file_.calls()[call()], position())) return false;
  if (shows_tables) return true;
  if (!lesson_) return false;
  return std::any_of(lesson_->steps.begin(), lesson_->steps.end(), [&](const LessonStep& step) {
    const auto& focus = step.focus;
    return step.at == position() &&
           std::find(focus.begin(), focus.end(), Focus::tables) != focus.end();
  });
}

TableFilling Debugger::tables() {
  const CallStudy* here = study();
  if (here == nullptr || !here->picture || here->picture->tables.size == 0) return {};
  if (!fills_by_steps()) {
    return full_tables(polygon().shell->tables);
  }
  TableFilling filling{cells_of(here->picture->tables)};
  filling.filled = cell_;
  filling.is_under_way = true;
  return filling;
}

bool Debugger::run_to(const Condition& condition, Direction direction) {
  const std::uint64_t home = position();
  const auto stop = find_stop(source(), condition, home, direction);
  seek(stop.value_or(home));
  if (!stop) need_known_operators(file_, condition);
  return stop.has_value();
}

std::optional<std::uint64_t> Debugger::nearest_breakpoint(Direction direction, Condition* which) {
  const std::uint64_t home = position();
  std::optional<std::uint64_t> nearest;
  for (const Breakpoint& breakpoint : breakpoints) {
    if (!breakpoint.on) continue;
    const auto stop = find_stop(source(), breakpoint.condition, home, direction);
    if (!stop) continue;
    const bool is_nearer =
        !nearest || (direction == Direction::forward ? *stop < *nearest : *stop > *nearest);
    if (!is_nearer) continue;
    nearest = stop;
    *which = breakpoint.condition;
  }
  replay_.seek(home);
  return nearest;
}

std::optional<Condition> Debugger::run(Direction direction) {
  Condition which;
  const auto stop = nearest_breakpoint(direction, &which);
  seek(stop.value_or(direction == Direction::forward ? end() : 0));
  if (!stop) return std::nullopt;
  return which;
}

std::uint32_t Debugger::deepest_call() const {
  const auto calls = file_.calls();
  if (calls.empty()) return kNoCall;
  const auto deepest = std::max_element(
      calls.begin(), calls.end(), [](const Call& x, const Call& y) { return x.depth < y.depth; });
  return static_cast<std::uint32_t>(deepest - calls.begin());
}

bool Debugger::advance(double seconds) {
  if (!playing) return false;
  unplayed_ += seconds * speed;
  const double whole = std::floor(unplayed_);
  if (whole < 1) return false;
  unplayed_ -= whole;
  if (step_in_tables(Step::into, Direction::forward)) return true;
  const std::uint64_t before = position();
  const auto left = static_cast<double>(end() - before);
  std::uint64_t to = before + static_cast<std::uint64_t>(std::min(whole, left));
  Condition which;
  const auto stop = nearest_breakpoint(Direction::forward, &which);
  if (stop && *stop <= to) {
    to = *stop;
    playing = false;
  }
  seek(to);
  if (to == end()) playing = false;
  return to != before;
}

TetMesh Debugger::mesh() {
  return trace_mesh_.begin(replay_);
}

const CallStudy* Debugger::study() {
  if (call() == kNoCall) return nullptr;
  if (!study_) study_ = study_call(file_, replay_, call());
  return &*study_;
}

PolygonView Debugger::polygon() {
  const CallStudy& here = *study();
  const Call& made = file_.calls()[here.call];
  const bool is_in_vain = !made.accepted() && made.has_searched();
  PolygonView view = polygon_at(here, position(), is_in_vain && position() >= made.events.end);
  if (fills_by_steps()) view.cell = tables().here();
  return view;
}

HistorySubject Debugger::subject_of(std::string_view text) {
  const std::uint64_t home = position();
  try {
    HistorySubject subject = find_subject(file_, replay_, text);
    replay_.seek(home);
    return subject;
  } catch (const Error&) {
    replay_.seek(home);
    throw;
  }
}

template <class Look>
void Debugger::stay(const Look& look) {
  const std::uint64_t home = position();
  try {
    look();
  } catch (const Error&) {
    replay_.seek(home);
    throw;
  }
  replay_.seek(home);
}

void Debugger::ask_history(const HistorySubject& subject) {
  stay([&] { history_ = history_of(file_, replay_, subject); });
  news = News::history;
}

const Ledger& Debugger::ledger() {
  if (!ledger_) ledger_ = make_ledger(file_);
  return *ledger_;
}

void Debugger::list_calls(const Condition& condition) {
  const std::uint64_t home = position();
  std::vector<std::uint32_t> calls = find_all(source(), condition);
  replay_.seek(home);
  if (calls.empty()) need_known_operators(file_, condition);
  found_ = {condition, std::move(calls)};
  news = News::found;
}

void Debugger::compare_with(const std::filesystem::path& file) {
  other_ = std::make_unique<OtherRun>(file_, file);
}

void Debugger::look_at_pair(std::size_t number) {
  if (other_ == nullptr) throw Error("no other run is beside this one");
  stay([&] { other_->look_at(number, replay_.mesh_at(end())); });
  const HistorySubject bad = other_->pair()->bad;
  ask_history(bad);
  asked = as_question(bad);
  news = News::pair;
}

}  // namespace tetmend::viewer
