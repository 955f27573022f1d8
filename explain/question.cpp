// SPDX-License-Identifier: MIT
#include "explain/question.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "explain/call_facts.h"
#include "explain/call_study.h"
#include "explain/paper_lines.h"
#include "explain/stepper.h"
#include "kernel/error.h"

namespace tetmend::explain {

namespace {

/// The call that a question at a position is about.
std::uint32_t call_asked_about(const TraceFile& file, std::uint64_t at) {
  const auto stack = call_stack(file, at);
  if (!stack.empty() && at < file.calls()[stack.back()].events.end) return stack.back();
  const auto calls = file.calls();
  const auto next = std::lower_bound(
      calls.begin(), calls.end(), at,
      [](const Call& call, std::uint64_t position) { return call.events.begin < position; });
  return next == calls.end() ? kNoCall : static_cast<std::uint32_t>(next - calls.begin());
}

std::uint32_t need_call(const TraceFile& file, std::uint64_t at) {
  const std::uint32_t call = call_asked_about(file, at);
  if (call == kNoCall) throw Error("no call is there, and none comes");
  return call;
}

/// "Algorithm 4" of "Algorithm 4: remove edge e, or face f at e".
std::string_view algorithm_name(const Pseudocode& code) {
  return code.title.substr(0, code.title.find(':'));
}

/// Where a call, or the pass, is at a position: the frame at hand is given by its place in the stack.
CodePlace place_in_frame(const TraceFile& file, std::size_t depth, std::uint64_t position) {
  const auto stack = call_stack(file, position);
  if (depth == 0) return pass_place(file, stack, position);
  if (depth > stack.size()) return {};
  return code_place(file, stack, depth - 1, position);
}

void answer_line(const TraceFile& file, std::uint64_t at, Question& question) {
  const auto stack = call_stack(file, at);
  const std::size_t depth = stack.size();  // 0: of the pass
  const CodePlace here = place_in_frame(file, depth, at);
  if (here.code == nullptr) throw Error("no algorithm is at hand");
  const std::uint64_t end = depth > 0 ? file.calls()[stack.back()].events.end : file.event_count();
  for (std::uint64_t position = at + 1; position <= end; ++position) {
    const CodePlace next = place_in_frame(file, depth, position);
    if (next.code != here.code) break;
    if (next.line == here.line || next.line == 0) continue;
    std::string_view text = next.code->lines[next.line - 1];
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    question.line = next.line;
    question.why =
        fmt::format("Line {} of {} comes next: {}.", next.line, algorithm_name(*next.code), text);
    if (depth > 0) question.call = stack.back();
    return;
  }
  throw Error("no other line comes");
}

void answer_accepted(const TraceFile& file, Replay& replay, Question& question) {
  const Call& call = file.calls()[question.call];
  if (!call.verdict) throw Error("the trace ends before the call does");
  question.accepted = call.accepted();
  question.why = fmt::format("It ends: {}. {}", call.verdict_in_words(),
                             explain_end(file, study_call(file, replay, question.call)));
}

ShellPicture shell_of_call(const CallStudy& study) {
  if (!study.picture || study.picture->ring.size() < 3) throw Error("the call has no ring");
  return *study.picture;
}

void answer_chord(const TraceFile& file, Replay& replay, Question& question) {
  const CallStudy study = study_call(file, replay, question.call);
  const ShellPicture shell = shell_of_call(study);
  const FlatCovering& covering = study.covering ? *study.covering : shell.full;
  const auto m = static_cast<unsigned>(shell.ring.size());
  const auto add = [&](unsigned i, unsigned j) {
    if ((i + 1) % m == j || (j + 1) % m == i) return;  // a side of the ring
    const std::array<std::uint32_t, 2> chord = {shell.ring[std::min(i, j)].index(),
                                                shell.ring[std::max(i, j)].index()};
    auto& chords = question.chords;
    if (std::find(chords.begin(), chords.end(), chord) == chords.end()) {
      chords.push_back(chord);
    }
  };
  for (const auto& t : covering.triangles) {
    for (unsigned n = 0; n < 3; ++n) add(t.corners[n], t.corners[(n + 1) % 3]);
  }
  if (question.chords.empty()) throw Error("the covering has no chord");
  std::vector<std::string> names;
  for (const auto& [from, to] : question.chords) names.push_back(fmt::format("{} - {}", from, to));
  question.why = fmt::format("{}: {}.", names.size() == 1 ? "Its chord" : "Its chords",
                             fmt::join(names, ", "));
}

/// Of a ring of m corners: the Catalan number of m - 2.
double triangulations_of(std::size_t m) {
  double count = 1;
  for (std::size_t k = 1; k + 2 <= m; ++k) {
    count = count * static_cast<double>(2 * (2 * k - 1)) / static_cast<double>(k + 1);
  }
  return count;
}

/// What the first change in a call did.
Cavity first_change_in(const TraceFile& file, Replay& replay, const Call& call) {
  const std::uint64_t home = replay.position();
  Cavity cavity;
  EventCursor cursor(file);
  cursor.move_to(call.events.begin);
  while (cursor.position() < call.events.end && cavity.created.empty() && cavity.removed.empty()) {
    if (!changes_mesh(cursor.next().kind)) continue;
    replay.seek(cursor.position());
    cavity = replay.cavity();
  }
  replay.seek(home);
  if (cavity.created.empty() && cavity.removed.empty()) throw Error("the call changes nothing");
  return cavity;
}

double table_entry(const ShellPicture& shell, const std::string& of) {
  std::istringstream words(of);
  std::string table;
  std::array<std::uint32_t, 2> vertices{};
  if (!(words >> table >> vertices[0] >> vertices[1]) || !(words >> std::ws).eof()) {
    throw Error("expected M_q or M_k and two vertices of the ring");
  }
  std::array<std::size_t, 2> places{};
  for (std::size_t n = 0; n < 2; ++n) {
    const auto found = std::find(shell.ring.begin(), shell.ring.end(), VertexHandle(vertices[n]));
    if (found == shell.ring.end()) throw Error(fmt::format("{} is not in the ring", vertices[n]));
    places[n] = static_cast<std::size_t>(found - shell.ring.begin());
  }
  const PocketTables& tables = shell.tables;
  const bool is_side = (places[0] + 1) % shell.ring.size() == places[1];
  if (tables.size == 0 || places[0] == places[1] || is_side ||
      tables.k(places[0], places[1]) >= shell.ring.size()) {
    throw Error("the tables have nothing there");
  }
  if (table == "M_q") return tables.q(places[0], places[1]);
  return shell.ring[tables.k(places[0], places[1])].index();
}

double count_bad_tets(Replay& replay, std::uint64_t at) {
  const std::uint64_t home = replay.position();
  replay.seek(at);
  const SlotMesh& mesh = replay.mesh();
  std::size_t bad = 0;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (!mesh.is_deleted(TetHandle(i)) && mesh.quality(TetHandle(i)) < 1) ++bad;
  }
  replay.seek(home);
  return static_cast<double>(bad);
}

double deepest_level(const TraceFile& file, std::uint32_t call) {
  unsigned level = 0;
  for (std::uint32_t k = call; k < file.calls()[call].subtree_end; ++k) {
    level = std::max<unsigned>(level, file.calls()[k].level);
  }
  return level;
}

double number_asked_for(const TraceFile& file, Replay& replay, std::uint64_t at,
                        std::uint32_t number, const std::string& of) {
  if (of == "bad tets") return count_bad_tets(replay, at);
  if (number == kNoCall) throw Error("no call is there, and none comes");
  const Call& call = file.calls()[number];
  if (of == "calls") return call.subtree_end - number - 1;
  if (of == "deepest level") return deepest_level(file, number);
  if (of.starts_with("degree")) {
    FactTable table;
    const CallFacts facts = table.facts(file, replay, number);
    if (of == "degree" && facts.degree_before > 0) return facts.degree_before;
    if (of == "degree after" && facts.degree_after > 0) return facts.degree_after;
  }
  if (of.starts_with("worst ")) {
    if (!call.has_qualities()) throw Error("the call compares nothing");
    if (of == "worst before") return call.worst_before;
    if (of == "worst after") return call.worst_after;
  }
  if (of == "tets removed" || of == "tets made") {
    const Cavity change = first_change_in(file, replay, call);
    return static_cast<double>(of == "tets made" ? change.created.size() : change.removed.size());
  }
  if (of == "triangulations" || of.starts_with("M_q ") || of.starts_with("M_k ")) {
    const ShellPicture shell = shell_of_call(study_call(file, replay, number));
    return of == "triangulations" ? triangulations_of(shell.ring.size()) : table_entry(shell, of);
  }
  throw Error(of.starts_with("degree") ? "the target is not there"
                                       : fmt::format("there is no number '{}'", of));
}

/// Counts are whole, qualities have four digits.
std::string number_text(double number) {
  return number == std::round(number) ? fmt::format("{:.0f}", number)
                                      : fmt::format("{:.4f}", number);
}

}  // namespace

Question answer(const TraceFile& file, Replay& replay, std::uint64_t at, const Ask& ask) {
  try {
    if (at > file.event_count()) throw Error("the trace ends before");
    Question question{.ask = ask};
    switch (ask.kind) {
      case Ask::Kind::line:
        answer_line(file, at, question);
        break;
      case Ask::Kind::accepted:
        question.call = need_call(file, at);
        answer_accepted(file, replay, question);
        break;
      case Ask::Kind::chord:
        question.call = need_call(file, at);
        answer_chord(file, replay, question);
        break;
      case Ask::Kind::number:
        question.call = call_asked_about(file, at);
        question.number = number_asked_for(file, replay, at, question.call, ask.of);
        question.why = fmt::format("It is {}.", number_text(question.number));
        break;
    }
    return question;
  } catch (const Error& error) {
    throw Error(
        fmt::format("the trace does not answer '{}' at {}: {}", ask.text, at, error.what()));
  }
}

std::optional<Question> try_answer(const TraceFile& file, Replay& replay, std::uint64_t at,
                                   const Ask& ask) {
  try {
    return answer(file, replay, at, ask);
  } catch (const Error&) {
    return std::nullopt;
  }
}

bool is_right(const Question& question, std::string_view words) {
  std::string plain(words);
  const bool is_chord = question.ask.kind == Ask::Kind::chord;
  if (is_chord) std::replace(plain.begin(), plain.end(), '-', ' ');  // "2 - 7"
  std::replace(plain.begin(), plain.end(), ',', is_chord ? ' ' : '.');
  std::istringstream in(plain);
  const auto need = [&](bool is_read, const char* expected) {
    if (!is_read || !(in >> std::ws).eof()) {
      throw Error(fmt::format("expected {}, not '{}'", expected, words));
    }
  };
  switch (question.ask.kind) {
    case Ask::Kind::line: {
      unsigned line = 0;
      need(static_cast<bool>(in >> line), "the number of a line");
      return line == question.line;
    }
    case Ask::Kind::accepted: {
      std::string word;
      in >> word;
      need(word == "accepted" || word == "refused", "accepted or refused");
      return (word == "accepted") == question.accepted;
    }
    case Ask::Kind::chord: {
      std::array<std::uint32_t, 2> ends{};
      need(static_cast<bool>(in >> ends[0] >> ends[1]), "two vertices, as in 2 7");
      const auto is_it = [&](const auto& chord) {
        return std::is_permutation(chord.begin(), chord.end(), ends.begin());
      };
      return std::any_of(question.chords.begin(), question.chords.end(), is_it);
    }
    case Ask::Kind::number: {
      double number = 0;
      need(static_cast<bool>(in >> number), "a number");
      constexpr double kRounding = 1e-9;
      return std::abs(number - question.number) <= question.ask.within + kRounding;
    }
  }
  return false;
}

nlohmann::ordered_json to_json(const Question& question) {
  const auto kind = static_cast<std::size_t>(question.ask.kind);
  nlohmann::ordered_json json = {{"kind", Ask::kKindNames[kind]}, {"text", question.ask.text}};
  switch (question.ask.kind) {
    case Ask::Kind::line:
      json["answer"] = question.line;
      break;
    case Ask::Kind::accepted:
      json["answer"] = question.accepted;
      break;
    case Ask::Kind::chord:
      json["answer"] = question.chords;
      break;
    case Ask::Kind::number:
      json["answer"] = question.number;
      json["within"] = question.ask.within;
      break;
  }
  json["why"] = question.why;
  return json;
}

}  // namespace tetmend::explain
