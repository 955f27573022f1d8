// SPDX-License-Identifier: MIT
#include "viewer/debugger/condition.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"

namespace tetmend::viewer {

namespace {

using Kind = Condition::Kind;

struct Form {
  Kind kind;
  std::string_view word;
  std::size_t numbers;
  std::string_view usage;
};
constexpr std::array<Form, 8> kForms = {{{Kind::accepted, "accepted", 0, "accepted"},
                                         {Kind::refused, "refused", 0, "refused"},
                                         {Kind::deeper, "deeper", 1, "deeper LEVEL"},
                                         {Kind::operator_name, "operator", 0, "operator NAME"},
                                         {Kind::edge, "edge", 2, "edge A B"},
                                         {Kind::face, "face", 3, "face A B C"},
                                         {Kind::vertex, "vertex", 1, "vertex NUMBER"},
                                         {Kind::tet, "tet", 1, "tet NUMBER"}}};

[[noreturn]] void fail(std::string_view text) {
  std::vector<std::string_view> usages;
  for (const Form& form : kForms) usages.push_back(form.usage);
  throw Error(
      fmt::format("'{}' is no place to stop at: expected {}", text, fmt::join(usages, ", ")));
}

std::uint32_t read_number(const std::string& word, std::string_view text) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) fail(text);
  return number;
}

bool has_target(const Call& call, std::span<const std::uint32_t> numbers) {
  const auto target = call.target();
  return target.size() == numbers.size() &&
         std::all_of(numbers.begin(), numbers.end(), [&](std::uint32_t number) {
           return std::find(target.begin(), target.end(), VertexHandle(number)) != target.end();
         });
}

/// Where the call makes the condition hold.
std::optional<std::uint64_t> stop_at(const TraceFile& file, const Condition& c, const Call& call) {
  bool holds = false;
  switch (c.kind) {
    case Kind::accepted:
      if (call.accepted()) return call.events.end;
      return std::nullopt;
    case Kind::refused:
      if (call.verdict && !call.accepted()) return call.events.end;
      return std::nullopt;
    case Kind::deeper:
      holds = call.level > c.numbers[0];
      break;
    case Kind::operator_name:
      holds = file.name(call.operator_name) == c.name;
      break;
    case Kind::edge:
    case Kind::face:
      holds = has_target(call, c.numbers);
      break;
    case Kind::vertex: {
      const auto target = call.target();
      holds = std::find(target.begin(), target.end(), VertexHandle(c.numbers[0])) != target.end();
      break;
    }
    case Kind::tet:
      break;
  }
  if (!holds) return std::nullopt;
  return call.events.begin + 1;
}

bool touches(const TraceEvent& event, const Condition& c) {
  if (!changes_mesh(event.kind) || event.kind == EventKind::undo) return false;
  if (c.kind == Kind::vertex) {
    return event.kind != EventKind::replace_cavity &&
           event.vertices.front() == VertexHandle(c.numbers[0]);
  }
  const TetHandle tet(c.numbers[0]);
  const auto has = [&](const std::vector<TetHandle>& tets) {
    return std::find(tets.begin(), tets.end(), tet) != tets.end();
  };
  if (event.kind == EventKind::replace_cavity) return has(event.removed) || has(event.created);
  return event.kind == EventKind::move_vertex && has(event.removed);
}

/// The nearest edit that concerns the vertex or tet.
std::optional<std::uint64_t> find_edit(const TraceFile& file, const Condition& condition,
                                       std::uint64_t from, Direction direction) {
  EventCursor cursor(file);
  const auto search = [&](std::uint64_t begin, std::uint64_t end, bool first) {
    std::optional<std::uint64_t> found;
    cursor.move_to(begin);
    for (std::uint64_t event = begin; event < end && !(first && found); ++event) {
      if (touches(cursor.next(), condition)) found = event + 1;
    }
    return found;
  };
  if (direction == Direction::forward) return search(from, file.event_count(), true);
  // A position of `from` itself does not count: its event is number from - 1.
  std::uint64_t end = from == 0 ? 0 : from - 1;
  const auto begins = file.chunk_begins();
  while (end > 0) {
    const auto after = std::lower_bound(begins.begin(), begins.end(), end);
    const std::uint64_t begin = *(after - 1);
    if (const auto found = search(begin, end, false)) return found;
    end = begin;
  }
  return std::nullopt;
}

}  // namespace

Condition parse_condition(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::string word;
  in >> word;
  for (const Form& form : kForms) {
    if (form.word != word) continue;
    Condition condition{.kind = form.kind, .name = {}, .numbers = {}};
    if (form.kind == Kind::operator_name && !(in >> condition.name)) fail(text);
    while (in >> word) condition.numbers.push_back(read_number(word, text));
    if (condition.numbers.size() != form.numbers) fail(text);
    return condition;
  }
  fail(text);
}

std::string to_text(const Condition& condition) {
  const auto& form = *std::find_if(kForms.begin(), kForms.end(),
                                   [&](const Form& f) { return f.kind == condition.kind; });
  std::string text(form.word);
  if (!condition.name.empty()) text += " " + condition.name;
  for (const std::uint32_t number : condition.numbers) text += fmt::format(" {}", number);
  return text;
}

std::optional<std::uint64_t> find_stop(const TraceFile& file, const Condition& condition,
                                       std::uint64_t from, Direction direction) {
  const bool forward = direction == Direction::forward;
  std::optional<std::uint64_t> nearest;
  const auto take = [&](std::optional<std::uint64_t> stop) {
    if (!stop || (forward ? *stop <= from : *stop >= from)) return;
    if (!nearest || (forward ? *stop < *nearest : *stop > *nearest)) nearest = stop;
  };
  for (const Call& call : file.calls()) take(stop_at(file, condition, call));
  if (condition.kind == Kind::vertex || condition.kind == Kind::tet) {
    take(find_edit(file, condition, from, direction));
  }
  return nearest;
}

}  // namespace tetmend::viewer
