// SPDX-License-Identifier: MIT
// A recorded recursion, or a lesson, as one HTML file that needs nothing else.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "explain/recording.h"

namespace tetmend::explain {

/// Pages are sent and opened on phones.
inline constexpr std::size_t kLargestPage = 1'000'000;

struct Page {
  std::string html;
  /// Calls with more calls around them are left out, as the page would be too large with them.
  std::optional<unsigned> deepest;
};

/// Another page: its file, as seen from this one.
struct PageLink {
  std::string file, title, text;
};

struct PageRequest {
  std::string title;
  RecordingRange range;
  const Lesson* lesson = nullptr;      ///< leads through the trace; may be null
  std::string program;                 ///< name and version of whoever writes the page
  std::size_t largest = kLargestPage;  ///< bytes
  /// Where the page leads to, if it is one of several; `text` is not used.
  std::optional<PageLink> contents = {}, previous = {}, next = {};
};

/// Texts of the trace are shown as they are, and are never markup or script.
/// @throws Error when the page is too large even with the outermost calls alone, or when the trace has
/// no answer to a question of the lesson.
/// Cost: see record().
Page write_page(const TraceFile& file, Replay& replay, const PageRequest& request);

/// "Call 17: recursion edge 0 1". Precondition: there is such a call.
std::string title_of_call(const TraceFile& file, std::uint32_t call);

/// A page with a list of pages.
std::string write_index(const std::string& title, const std::string& text,
                        const std::vector<PageLink>& pages, const std::string& program);

}  // namespace tetmend::explain
