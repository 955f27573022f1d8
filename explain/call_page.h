// SPDX-License-Identifier: MIT
// The page of one call of a trace, for whoever has no more than the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tetmend::explain {

/// The lesson that is proposed for a call (explain/lesson_maker.h) as a page of HTML.
/// @param program name and version of whoever writes the page
/// @throws Error when the trace cannot be read, has no such call or ends before the call does.
/// Cost: reads and plays the trace.
std::string page_of_call(const std::filesystem::path& trace, std::uint32_t call,
                         const std::string& program);

/// What there is to draw of a call, as pictures of SVG: its ring, and its tree unless that is too
/// large.
/// @param trace the bytes of a trace
/// @throws Error and cost: as above
std::vector<std::string> drawings_of_call(std::string_view trace, std::uint32_t call);

}  // namespace tetmend::explain
