// SPDX-License-Identifier: MIT
#include "viewer/debugger/condition.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "kernel/from_chars.h"
#include "trace/verdict.h"

namespace tetmend::viewer {

namespace {

using Kind = Condition::Kind;
using Term = Condition::Term;

struct Form {
  Kind kind;
  std::string_view words;
  bool has_name;
  std::size_t numbers;
  std::size_t values;
  std::string_view usage;
};
constexpr std::array<Form, 16> kForms = {
    {{Kind::accepted, "accepted", false, 0, 0, "accepted"},
     {Kind::undone, "undone", false, 0, 0, "undone"},
     {Kind::refused, "refused", false, 0, 0, "refused"},
     {Kind::verdict, "verdict", true, 0, 0, "verdict NAME"},
     {Kind::ending, "ending", true, 0, 0, "ending NAME"},
     {Kind::deeper, "deeper", false, 1, 0, "deeper LEVEL"},
     {Kind::level, "level", false, 1, 0, "level LEVEL"},
     {Kind::visit, "visit", false, 1, 0, "visit NUMBER"},
     {Kind::operator_name, "operator", true, 0, 0, "operator NAME"},
     {Kind::edge, "edge", false, 2, 0, "edge A B"},
     {Kind::face, "face", false, 3, 0, "face A B C"},
     {Kind::vertex, "vertex", false, 1, 0, "vertex NUMBER"},
     {Kind::tet, "tet", false, 1, 0, "tet NUMBER"},
     {Kind::worse, "worse than", false, 0, 1, "worse than QUALITY"},
     {Kind::better, "better than", false, 0, 1, "better than QUALITY"},
     {Kind::near, "near", false, 0, 4, "near X Y Z RADIUS"}}};

[[noreturn]] void refuse_part(std::string_view part) {
  throw Error(fmt::format("'{}' is no place to stop at: expected {}", part, condition_usage()));
}

/// As one word: "no_improvement".
std::string joined(std::string_view words) {
  std::string word(words);
  std::replace(word.begin(), word.end(), ' ', '_');
  return word;
}

std::string word_of(Verdict verdict) {
  return joined(to_string(verdict));
}

void check_verdict(const std::string& name) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < kVerdictCount; ++i) {
    words.push_back(word_of(static_cast<Verdict>(i)));
  }
  if (std::find(words.begin(), words.end(), name) != words.end()) return;
  throw Error(fmt::format("'{}' is no verdict: expected {}", name, fmt::join(words, ", ")));
}

void check_ending(const std::string& name) {
  std::vector<std::string> words;
  for (const EndingWords& ending : kEndingWords) words.push_back(joined(ending.name));
  if (std::find(words.begin(), words.end(), name) != words.end()) return;
  throw Error(fmt::format("'{}' is no way to end: expected {}", name, fmt::join(words, ", ")));
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> words;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (text.empty()) return words;
    const std::size_t end = std::min(text.find(' '), text.size());
    words.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

std::uint32_t read_number(const std::string& word, std::string_view part) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) refuse_part(part);
  return number;
}

double read_value(const std::string& word, std::string_view part) {
  double value = 0;
  const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) refuse_part(part);
  return value;
}

Term read_term(std::span<const std::string> words) {
  const std::string part = fmt::format("{}", fmt::join(words, " "));
  for (const Form& form : kForms) {
    const auto keys = split(form.words);
    const std::size_t size = keys.size() + (form.has_name ? 1 : 0) + form.numbers + form.values;
    if (words.size() < keys.size() || !std::equal(keys.begin(), keys.end(), words.begin()))
      continue;
    if (words.size() != size) refuse_part(part);
    Term term{form.kind, {}, {}, {}};
    auto rest = words.subspan(keys.size());
    if (form.has_name) {
      term.name = rest[0];
      rest = rest.subspan(1);
    }
    if (form.kind == Kind::verdict) check_verdict(term.name);
    if (form.kind == Kind::ending) check_ending(term.name);
    for (std::size_t i = 0; i < form.numbers; ++i) {
      term.numbers.push_back(read_number(rest[i], part));
    }
    for (std::size_t i = 0; i < form.values; ++i) term.values.push_back(read_value(rest[i], part));
    return term;
  }
  refuse_part(part);
}

bool has_target(const ConditionCall& call, std::span<const std::uint32_t> numbers) {
  return call.target.size() == numbers.size() &&
         std::all_of(numbers.begin(), numbers.end(), [&](std::uint32_t number) {
           return std::find(call.target.begin(), call.target.end(), VertexHandle(number)) !=
                  call.target.end();
         });
}

bool is_near(const ConditionCall& call, const std::vector<double>& values,
             const PlaceOf& place_of) {
  const Point middle(values[0], values[1], values[2]);
  return std::any_of(call.target.begin(), call.target.end(), [&](VertexHandle v) {
    const auto place = place_of(v);
    return place && (*place - middle).norm() <= values[3];
  });
}

bool touches(const TraceEvent& event, const Term& term) {
  if (!changes_mesh(event.kind) || event.kind == EventKind::undo) return false;
  if (term.kind == Kind::vertex) {
    return event.kind != EventKind::replace_cavity &&
           event.vertices.front() == VertexHandle(term.numbers[0]);
  }
  const TetHandle tet(term.numbers[0]);
  const auto has = [&](const std::vector<TetHandle>& tets) {
    return std::find(tets.begin(), tets.end(), tet) != tets.end();
  };
  if (event.kind == EventKind::replace_cavity) return has(event.removed) || has(event.created);
  return event.kind == EventKind::move_vertex && has(event.removed);
}

/// Looks for the places of one condition in a trace.
class Search {
 public:
  Search(const ConditionSource& source, const Condition& condition)
      : file_(source.file), replay_(source.replay), condition_(condition) {
    for (const Term& term : condition.terms) at_end_ = at_end_ || is_about_end(term);
  }

  std::optional<std::uint64_t> find(std::uint64_t from, Direction direction) {
    const bool forward = direction == Direction::forward;
    auto nearest = forward ? call_after(from) : call_before(from);
    if (const auto begin = begin_of_visit(from, forward)) {
      if (forward || !nearest) nearest = begin;
    }
    const auto& terms = condition_.terms;
    if (std::none_of(terms.begin(), terms.end(), is_about_edit)) return nearest;
    const auto edit = forward ? edit_after(from, nearest) : edit_before(from, nearest);
    return edit ? edit : nearest;
  }

  std::vector<std::uint32_t> all() {
    std::vector<std::uint32_t> found;
    const auto calls = file_.calls();
    for (std::uint32_t k = 0; k < calls.size(); ++k) {
      if (stop_of(k)) found.push_back(k);
    }
    std::stable_sort(found.begin(), found.end(), [&](std::uint32_t a, std::uint32_t b) {
      return calls[a].missing() < calls[b].missing();
    });
    return found;
  }

 private:
  /// Where the call makes the condition hold.
  std::optional<std::uint64_t> stop_of(std::uint32_t number) {
    const Call& call = file_.calls()[number];
    if (at_end_ && !call.verdict) return std::nullopt;
    if (!holds_of(number, false)) return std::nullopt;
    return at_end_ ? call.events.end : call.events.begin + 1;
  }

  /// `with_edit`: the terms about edits hold otherwise.
  bool holds_of(std::uint32_t number, bool with_edit) {
    const Call& call = file_.calls()[number];
    ConditionCall asked{
        file_.name(call.operator_name), call.level,         call.target(),   call.verdict,
        worst_before(number),           file_.ending(call), visit_of(number)};
    const PlaceOf place_of = [&](VertexHandle v) -> std::optional<Point> {
      replay_.seek(call.events.begin);
      if (replay_.mesh().is_deleted(v)) return std::nullopt;
      return replay_.mesh().scale().to_file(replay_.mesh().point(v));
    };
    for (const Term& term : condition_.terms) {
      if (with_edit && is_about_edit(term)) continue;
      if (!holds(term, asked, place_of)) return false;
    }
    if (!condition_.for_good || with_edit) return true;
    return !file_.is_undone(at_end_ ? call.events.end - 1 : call.events.begin);
  }

  std::optional<std::uint32_t> visit_of(std::uint32_t number) const {
    const auto visits = file_.visits();
    const auto after =
        std::upper_bound(visits.begin(), visits.end(), number,
                         [](std::uint32_t n, const Visit& visit) { return n < visit.first_call; });
    if (after == visits.begin() || number >= (after - 1)->last_call) return std::nullopt;
    return static_cast<std::uint32_t>(after - visits.begin() - 1);
  }

  /// Of the tets that it compared, or else the tet that the pass turned to.
  double worst_before(std::uint32_t number) const {
    const Call& call = file_.calls()[number];
    if (call.has_qualities()) return call.worst_before;
    const auto visit = visit_of(number);
    return visit ? file_.visits()[*visit].quality : 1e30;
  }

  /// The beginning of the visit, which is before its calls.
  std::optional<std::uint64_t> begin_of_visit(std::uint64_t from, bool forward) const {
    if (condition_.terms.size() != 1 || condition_.terms[0].kind != Kind::visit) return {};
    const std::uint32_t number = condition_.terms[0].numbers[0];
    if (number >= file_.visits().size()) return {};
    const std::uint64_t stop = file_.visits()[number].events.begin + 1;
    if (forward ? stop <= from : stop >= from) return {};
    return stop;
  }

  /// The first call that begins at `event` or later.
  std::uint32_t first_call(std::uint64_t event) const {
    const auto calls = file_.calls();
    return static_cast<std::uint32_t>(
        std::lower_bound(calls.begin(), calls.end(), event,
                         [](const Call& c, std::uint64_t e) { return c.events.begin < e; }) -
        calls.begin());
  }

  std::optional<std::uint64_t> call_after(std::uint64_t from) {
    std::optional<std::uint64_t> nearest;
    const auto take = [&](std::uint32_t number) {
      const auto stop = stop_of(number);
      if (stop && *stop > from && (!nearest || *stop < *nearest)) nearest = stop;
    };
    for (const std::uint32_t open : call_stack(file_, from)) take(open);
    for (std::uint32_t k = first_call(from); k < file_.calls().size(); ++k) {
      if (nearest && file_.calls()[k].events.begin + 1 > *nearest) break;
      take(k);
    }
    return nearest;
  }

  /// Calls that begin earlier end earlier, but for those around.
  std::optional<std::uint64_t> call_before(std::uint64_t from) {
    for (std::uint32_t k = first_call(from); k-- > 0;) {
      auto nearest = stop_of(k);
      if (!nearest || *nearest >= from) continue;
      for (std::uint32_t p = file_.calls()[k].parent; p != kNoCall; p = file_.calls()[p].parent) {
        const auto stop = stop_of(p);
        if (stop && *stop < from) nearest = std::max(nearest, stop);
      }
      return nearest;
    }
    return std::nullopt;
  }

  bool edit_holds(std::uint64_t number, const TraceEvent& event) {
    for (const Term& term : condition_.terms) {
      if (is_about_edit(term) && !touches(event, term)) return false;
    }
    if (condition_.for_good && file_.is_undone(number)) return false;
    const auto& terms = condition_.terms;
    if (std::all_of(terms.begin(), terms.end(), is_about_edit)) return true;
    const std::uint32_t call = file_.call_at(number);
    return call != kNoCall && holds_of(call, true);
  }

  std::optional<std::uint64_t> search(EventCursor& cursor, std::uint64_t begin, std::uint64_t end,
                                      bool first) {
    std::optional<std::uint64_t> found;
    cursor.move_to(begin);
    for (std::uint64_t event = begin; event < end && !(first && found); ++event) {
      const TraceEvent& read = cursor.next();
      if (changes_mesh(read.kind) && edit_holds(event, read)) found = event + 1;
    }
    return found;
  }

  std::optional<std::uint64_t> edit_after(std::uint64_t from, std::optional<std::uint64_t> limit) {
    EventCursor cursor(file_);
    return search(cursor, from, limit ? *limit - 1 : file_.event_count(), true);
  }

  std::optional<std::uint64_t> edit_before(std::uint64_t from, std::optional<std::uint64_t> limit) {
    EventCursor cursor(file_);
    // A position of `from` itself does not count: its event is number from - 1.
    std::uint64_t end = from == 0 ? 0 : from - 1;
    const std::uint64_t least = limit.value_or(0);
    const auto begins = file_.chunk_begins();
    while (end > least) {
      const auto after = std::lower_bound(begins.begin(), begins.end(), end);
      const std::uint64_t begin = std::max(*(after - 1), least);
      if (const auto found = search(cursor, begin, end, false)) return found;
      end = begin;
    }
    return std::nullopt;
  }

  const TraceFile& file_;
  Replay& replay_;
  const Condition& condition_;
  bool at_end_ = false;
};

}  // namespace

std::string word_of(CallEnding ending) {
  return joined(name_of(ending));
}

std::string condition_usage() {
  std::vector<std::string_view> usages;
  for (const Form& form : kForms) usages.push_back(form.usage);
  return fmt::format("{}; several with 'and' between, and 'for good' at the end",
                     fmt::join(usages, ", "));
}

Condition parse_condition(std::string_view text) {
  std::vector<std::string> words = split(text);
  Condition condition;
  if (words.size() >= 2 && words[words.size() - 2] == "for" && words.back() == "good") {
    condition.for_good = true;
    words.resize(words.size() - 2);
  }
  if (words.empty()) refuse_part(text);
  for (std::size_t begin = 0; begin <= words.size();) {
    const auto end = static_cast<std::size_t>(
        std::find(words.begin() + static_cast<std::ptrdiff_t>(begin), words.end(), "and") -
        words.begin());
    if (end == begin) refuse_part(text);
    condition.terms.push_back(read_term(std::span(words).subspan(begin, end - begin)));
    begin = end + 1;
  }
  return condition;
}

std::string to_text(const Condition& condition) {
  std::vector<std::string> parts;
  for (const Term& term : condition.terms) {
    const auto& form = *std::find_if(kForms.begin(), kForms.end(),
                                     [&](const Form& f) { return f.kind == term.kind; });
    std::string text(form.words);
    if (!term.name.empty()) text += " " + term.name;
    for (const std::uint32_t number : term.numbers) text += fmt::format(" {}", number);
    for (const double value : term.values) text += fmt::format(" {}", value);
    parts.push_back(std::move(text));
  }
  return fmt::format("{}{}", fmt::join(parts, " and "), condition.for_good ? " for good" : "");
}

bool is_about_end(const Term& term) {
  return term.kind == Kind::accepted || term.kind == Kind::refused || term.kind == Kind::verdict ||
         term.kind == Kind::undone || term.kind == Kind::ending;
}

bool is_about_record(const Term& term) {
  return term.kind == Kind::undone || term.kind == Kind::ending || term.kind == Kind::visit;
}

bool is_about_edit(const Term& term) {
  return term.kind == Kind::tet || term.kind == Kind::vertex;
}

bool holds(const Term& term, const ConditionCall& call, const PlaceOf& place_of) {
  switch (term.kind) {
    case Kind::accepted:
      return call.verdict == Verdict::accepted;
    case Kind::undone:
      return call.ending == CallEnding::undone;
    case Kind::ending:
      return call.ending && word_of(*call.ending) == term.name;
    case Kind::refused:
      return call.verdict && call.verdict != Verdict::accepted;
    case Kind::verdict:
      return call.verdict && word_of(*call.verdict) == term.name;
    case Kind::deeper:
      return call.level > term.numbers[0];
    case Kind::level:
      return call.level == term.numbers[0];
    case Kind::visit:
      return call.visit == term.numbers[0];
    case Kind::operator_name:
      return call.operator_name == term.name;
    case Kind::edge:
    case Kind::face:
      return has_target(call, term.numbers);
    case Kind::vertex:
      return std::find(call.target.begin(), call.target.end(), VertexHandle(term.numbers[0])) !=
             call.target.end();
    case Kind::worse:
      return call.worst < term.values[0];
    case Kind::better:
      return call.worst >= term.values[0] && call.worst < 1e30;
    case Kind::near:
      return is_near(call, term.values, place_of);
    case Kind::tet:
      break;
  }
  return false;
}

std::optional<std::uint64_t> find_stop(const ConditionSource& source, const Condition& condition,
                                       std::uint64_t from, Direction direction) {
  return Search(source, condition).find(from, direction);
}

void need_known_operators(const TraceFile& file, const Condition& condition) {
  for (const Term& term : condition.terms) {
    if (term.kind != Kind::operator_name) continue;
    std::set<std::string_view> known;
    for (const Call& call : file.calls()) known.insert(file.name(call.operator_name));
    if (known.contains(term.name)) continue;
    throw Error(fmt::format("no call of this trace is of operator '{}'; they are of {}", term.name,
                            fmt::join(known, ", ")));
  }
}

std::vector<std::uint32_t> find_all(const ConditionSource& source, const Condition& condition) {
  for (const Term& term : condition.terms) {
    if (term.kind != Kind::tet) continue;
    throw Error(fmt::format("'{}' is about edits, and no list of calls", to_text(condition)));
  }
  return Search(source, condition).all();
}

}  // namespace tetmend::viewer
