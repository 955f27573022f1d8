// SPDX-License-Identifier: MIT
// A lesson: a recorded trace with a text that leads through it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tetmend {

/// What a step speaks of and is to be seen whole; without any, the picture.
enum class Focus : std::uint8_t { picture, ring, tables, algorithm, tree };
inline constexpr std::array<std::string_view, 5> kFocusNames = {"picture", "ring", "tables",
                                                                "algorithm", "tree"};

/// A question at a step. The trace answers it: see explain/question.h.
struct Ask {
  enum class Kind : std::uint8_t {
    line,      ///< of the algorithm: which comes next
    accepted,  ///< or refused: how the call will end
    chord,     ///< of the ring: one that the covering will have
    number     ///< a count or a quality
  };
  static constexpr std::array<std::string_view, 4> kKindNames = {"line", "accepted", "chord",
                                                                 "number"};
  Kind kind = Kind::accepted;
  std::string text = {};  ///< the question, without markup
  std::string of = {};    ///< which number, in the words of explain/question.h
  double within = 0;      ///< how far from the number an answer may be
};

struct LessonStep {
  std::uint64_t at = 0;  ///< the mesh after so many events: see Replay::seek()
  std::string text;      ///< one paragraph, without markup
  std::vector<Focus> focus = {};
  std::optional<Ask> ask = {};
};

struct Lesson {
  std::string title;
  std::filesystem::path mesh;              ///< as it is before the first event; may be empty
  std::filesystem::path trace;             ///< of a run on it
  std::vector<LessonStep> steps;           ///< at least one; `at` never goes back
  std::optional<std::uint32_t> call = {};  ///< all that it is about, of a large trace
};

/// Reads a JSON file: {"title": "", "mesh": "FILE", "trace": "FILE", "call": 17, "steps": [{"at": 0,
/// "text": "", "focus": ["ring"], "ask": {"kind": "line", "text": ""}}]}. Files lie in its folder or
/// below, and are not opened. mesh, call, focus and ask may be left out.
/// @throws Error when it cannot be read or is no lesson, with the reason.
Lesson read_lesson(const std::filesystem::path& file);

/// The lesson as such a file in a folder. Precondition: its files lie there or below.
std::string lesson_text(const Lesson& lesson, const std::filesystem::path& folder);

/// It is JSON that has a title and steps. False also where it cannot be read.
bool is_lesson(const std::filesystem::path& file);

/// The lessons of a folder: its files *.json, by the number that their name begins with, then by
/// name. Empty when there is no such folder.
std::vector<std::filesystem::path> list_lessons(const std::filesystem::path& folder);

}  // namespace tetmend
