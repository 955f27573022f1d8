// SPDX-License-Identifier: MIT
// From what people write to the vertices of a trace.
#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "trace/history.h"

namespace tetmend {

namespace {

struct Form {
  std::string_view word;
  std::size_t vertices;
};
constexpr std::array<Form, 4> kForms = {{{"vertex", 1}, {"edge", 2}, {"face", 3}, {"tet", 4}}};

struct Question {
  Form form;
  bool worst = false;
  std::vector<std::uint32_t> numbers;
  std::filesystem::path file;  // empty: numbers of the trace
};

[[noreturn]] void fail(std::string_view text) {
  throw Error(
      fmt::format("'{}' names nothing in a trace: expected tet:N, tet:worst, tet:A,B,C,D, "
                  "face:A,B,C, edge:A,B or vertex:N, with @FILE for the numbers of a file",
                  text));
}

std::vector<std::uint32_t> read_numbers(std::string_view list, std::string_view text) {
  std::vector<std::uint32_t> numbers;
  while (true) {
    const std::string_view word = list.substr(0, list.find(','));
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size()) fail(text);
    numbers.push_back(number);
    if (word.size() == list.size()) return numbers;
    list.remove_prefix(word.size() + 1);
  }
}

Question parse(std::string_view text) {
  Question question;
  const std::size_t at = text.find('@');
  const std::string_view subject = text.substr(0, at);
  if (at != text.npos) {
    question.file = text.substr(at + 1);
    if (question.file.empty()) fail(text);
  }
  const std::size_t colon = subject.find(':');
  const auto form = std::find_if(kForms.begin(), kForms.end(), [&](const Form& f) {
    return colon != subject.npos && f.word == subject.substr(0, colon);
  });
  if (form == kForms.end()) fail(text);
  question.form = *form;
  question.worst = subject.substr(colon + 1) == "worst" && form->vertices == 4;
  if (question.worst && !question.file.empty()) fail(text);
  if (question.worst) return question;
  question.numbers = read_numbers(subject.substr(colon + 1), text);
  const bool is_tet_number = form->vertices == 4 && question.numbers.size() == 1;
  if (question.numbers.size() != form->vertices && !is_tet_number) fail(text);
  auto sorted = question.numbers;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) fail(text);
  return question;
}

HistorySubject sorted(HistorySubject vertices) {
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

HistorySubject worst_tet(const SlotMesh& mesh) {
  HistorySubject worst;
  Quality least = std::numeric_limits<Quality>::infinity();
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t) || !(mesh.quality(t) < least)) continue;
    least = mesh.quality(t);
    worst.assign(mesh.vertices(t).begin(), mesh.vertices(t).end());
  }
  if (worst.empty()) throw Error("the mesh has no tets");
  return sorted(worst);
}

/// The vertices of a mesh at these places, as a file has them; empty unless all are found.
HistorySubject vertices_at(const SlotMesh& mesh, const std::vector<Point>& places) {
  HistorySubject found(places.size(), VertexHandle());
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (mesh.is_deleted(v)) continue;
    const auto at = std::find(places.begin(), places.end(), mesh.scale().to_file(mesh.point(v)));
    if (at != places.end()) found[static_cast<std::size_t>(at - places.begin())] = v;
  }
  const bool all =
      std::all_of(found.begin(), found.end(), [](VertexHandle v) { return v.is_valid(); });
  return all ? sorted(found) : HistorySubject();
}

HistorySubject find_by_file(const TraceFile& file, Replay& replay, const Question& question,
                            std::string_view text) {
  const MeshData mesh = read_mesh(question.file);
  const bool by_tet = question.numbers.size() == 1 && question.form.vertices == 4;
  const std::size_t count = by_tet ? mesh.tets.size() : mesh.points.size();
  for (const std::uint32_t number : question.numbers) {
    if (number > 0 && number <= count) continue;
    throw Error(fmt::format("{} has no {} {}: it has {}, counted from 1", question.file.string(),
                            by_tet ? "tet" : "vertex", number, count));
  }
  std::vector<Point> places;
  if (by_tet) {
    for (const std::uint32_t v : mesh.tets[question.numbers[0] - 1].vertices) {
      places.push_back(mesh.points[v]);
    }
  } else {
    for (const std::uint32_t v : question.numbers) places.push_back(mesh.points[v - 1]);
  }
  for (const std::uint64_t position : {file.event_count(), std::uint64_t{0}}) {
    const HistorySubject found = vertices_at(replay.mesh_at(position), places);
    if (!found.empty()) return found;
  }
  throw Error(
      fmt::format("'{}': the mesh of the trace has no vertices at these places, at its end "
                  "or at its beginning",
                  text));
}

}  // namespace

std::filesystem::path file_of_question(std::string_view text) {
  return parse(text).file;
}

HistorySubject find_subject(const TraceFile& file, Replay& replay, std::string_view text) {
  const Question question = parse(text);
  if (!question.file.empty()) return find_by_file(file, replay, question, text);
  const SlotMesh& mesh = replay.mesh_at(file.event_count());
  if (question.worst) return worst_tet(mesh);
  if (question.numbers.size() == 1 && question.form.vertices == 4) {
    const TetHandle t(question.numbers[0]);
    if (mesh.is_deleted(t)) {
      throw Error(
          fmt::format("there is no tet {} when the trace ends; tet:A,B,C,D, its vertices, "
                      "asks for one that is gone",
                      question.numbers[0]));
    }
    return sorted({mesh.vertices(t).begin(), mesh.vertices(t).end()});
  }
  HistorySubject vertices;
  for (const std::uint32_t number : question.numbers) vertices.emplace_back(number);
  return sorted(vertices);
}

}  // namespace tetmend
