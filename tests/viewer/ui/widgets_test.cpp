// SPDX-License-Identifier: MIT
// Rows, lines and sliders of panels, laid out without a display.
#include <algorithm>
#include <string>

#include <doctest/doctest.h>
#include <imgui.h>

#include "viewer/ui/call_row.h"
#include "viewer/ui/slider.h"
#include "viewer/ui/wrapped_text.h"

using namespace tetmend::viewer::ui;

namespace {

/// A panel of that width, for one frame.
class Panel {
 public:
  explicit Panel(float width) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {2000, 2000};
    unsigned char* pixels = nullptr;
    int wide = 0, high = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &wide, &high);
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({width, 1000});
    ImGui::Begin("panel");
  }
  ~Panel() {
    ImGui::End();
    ImGui::EndFrame();
    ImGui::DestroyContext();
  }
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;
};

float width_of(const std::string& text) {
  return ImGui::CalcTextSize(text.c_str()).x;
}

}  // namespace

TEST_CASE(
    "a line of an algorithm that is too long goes on further to the right, and loses nothing") {
  const Panel panel(300);
  const std::string line =
      "    recursion: remove the supporting face f_i at its link edge, level + 1";
  const CodeLine whole = code_line(line, 2000);
  CHECK(whole.rows() == 1);
  CHECK(whole.indent == doctest::Approx(width_of("    ")));
  const CodeLine broken = code_line(line, 200);
  CHECK(broken.rows() > 2);
  CHECK(width_of(broken.text) + broken.indent < 200);
  std::string joined = broken.text;
  std::replace(joined.begin(), joined.end(), '\n', ' ');
  CHECK("    " + joined == line);
  // One row below the other, as many as it says, the first of them the least to the right.
  const float top = ImGui::GetCursorPosY();
  show_code_line(broken);
  const float height = ImGui::GetCursorPosY() - top;
  CHECK(height == doctest::Approx(static_cast<float>(broken.rows()) * ImGui::GetTextLineHeight()));
  CHECK(ImGui::GetItemRectMin().x > ImGui::GetWindowPos().x + broken.indent + ImGui::GetFontSize());
}

TEST_CASE("a row of a list has as many lines as its text needs") {
  const Panel panel(200);
  const std::string text =
      "edge 31415 92653, on the surface: 12 calls, 3 accepted for good, 4 undone";
  wrapped_row(text, false);
  const ImVec2 size = ImGui::GetItemRectSize();
  CHECK(size.y > 3 * ImGui::GetTextLineHeight());
  wrapped_row("edge 3 17", false);
  CHECK(ImGui::GetItemRectSize().y < 2 * ImGui::GetTextLineHeight());
}

TEST_CASE("the number of a slider stands right of it, and both are as wide as an item") {
  const Panel panel(260);
  double value = 0.4;
  const double low = 0, high = 2;
  const float left = ImGui::GetCursorScreenPos().x;
  ImGui::SetNextItemWidth(200);
  slider("##value", ImGuiDataType_Double, &value, &low, &high, "after %.2f");
  CHECK(ImGui::GetItemRectMax().x + width_of("after 0.40") <= left + 200);
  ImGui::SetNextItemWidth(200);
  slider("##other", ImGuiDataType_Double, &value, &low, &high, "%.2f", 0, "as fast as it can");
  CHECK(ImGui::GetItemRectMax().x + width_of("as fast as it can") <= left + 200);
}

TEST_CASE("a column of numbers has room for the longest of them, and ends where they do") {
  const Panel panel(240);
  const std::string longest = "0.7099 -> 0.6813";
  REQUIRE(ImGui::BeginTable("##table", 2));
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
  number_column("worst", longest);
  headers_row(1);
  for (const std::string& number : {longest, std::string("1.5")}) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TableNextColumn();
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    CHECK(ImGui::GetContentRegionAvail().x >= width_of(longest));
    right_aligned(number);
    CHECK(ImGui::GetItemRectMax().x == doctest::Approx(right));
  }
  ImGui::EndTable();
}
