// SPDX-License-Identifier: MIT
#include "viewer/ui/wrapped_text.h"

#include <algorithm>
#include <string>

#include <imgui.h>

namespace tetmend::viewer::ui {

void wrapped_text(std::string_view text) {
  const float width = ImGui::GetContentRegionAvail().x;
  std::string lines;
  std::size_t line = 0;  // where it begins in `lines`
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    const std::size_t before = lines.size();
    if (before > line) lines += ' ';
    lines += word;
    if (before == line || ImGui::CalcTextSize(lines.c_str() + line).x <= width) continue;
    lines[before] = '\n';
    line = before + 1;
  }
  ImGui::TextUnformatted(lines.c_str());
}

}  // namespace tetmend::viewer::ui
