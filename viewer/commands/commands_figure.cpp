// SPDX-License-Identifier: MIT
// Commands that make figures for papers: vector files of a call, frames, and what pictures have
// besides the mesh.
#include <algorithm>
#include <array>
#include <filesystem>
#include <initializer_list>

#include "figure/drawing_file.h"
#include "viewer/commands/command_group.h"
#include "viewer/commands/frames.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

/// The one argument, a table with some of these fields.
class Fields {
 public:
  Fields(std::string_view command, const json& a, std::initializer_list<std::string_view> names)
      : arguments_(command, a), fields_(a.empty() ? json::object() : a[0]) {
    if (!fields_.is_object()) arguments_.fail_field("the argument", "a table", fields_);
    for (const auto& field : fields_.items()) {
      if (std::find(names.begin(), names.end(), field.key()) != names.end()) continue;
      arguments_.fail_field(field.key(), "none of its fields", field.value());
    }
  }

  std::string text(const char* name) const {
    const json value = fields_.value(name, json());
    if (!value.is_string()) arguments_.fail_field(name, "a text", value);
    return value.get<std::string>();
  }
  std::optional<std::uint64_t> whole(const char* name) const {
    constexpr double kMost = 1e15;
    if (!fields_.contains(name)) return std::nullopt;
    const double n = number(name);
    if (n != std::floor(n) || n < 0 || n > kMost) {
      arguments_.fail_field(name, "a whole number from 0 on", fields_[name]);
    }
    return static_cast<std::uint64_t>(n);
  }
  std::optional<Look> look(const char* name) const {
    if (!fields_.contains(name)) return std::nullopt;
    const json& value = fields_[name];
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
      arguments_.fail_field(name, "two numbers, yaw and pitch", value);
    }
    return Look{value[0].get<double>(), value[1].get<double>()};
  }

 private:
  double number(const char* name) const {
    if (!fields_[name].is_number()) arguments_.fail_field(name, "a number", fields_[name]);
    return fields_[name].get<double>();
  }

  Arguments arguments_;
  json fields_;
};

/// "tetmend-ring.svg", or with a number if that is taken.
std::string new_figure(FigureKind kind) {
  std::string name = fmt::format("tetmend-{}.svg", to_string(kind));
  for (unsigned i = 2; std::filesystem::exists(name); ++i) {
    name = fmt::format("tetmend-{}-{}.svg", to_string(kind), i);
  }
  return name;
}

/// Of the menu: what the call at hand has.
json write_all_figures(Session& s) {
  Debugger& debugger = need_trace(s.document);
  std::string names;
  for (const FigureKind kind :
       {FigureKind::ring, FigureKind::tree, FigureKind::timeline, FigureKind::shell}) {
    FigureRequest request{kind, {}, {}};
    if (debugger.call() != kNoCall) request.call = debugger.call();
    try {
      const figure::Drawing drawing = debugger.draw(request);
      const std::string name = new_figure(kind);
      figure::write_drawing(name, drawing);
      names += (names.empty() ? "" : ", ") + name;
    } catch (const Error&) {
      if (kind == FigureKind::timeline) throw;  // there is always one: it could not be written
    }
  }
  s.document.message = {"wrote " + names, false};
  return nullptr;
}

json figure(Session& s, const json& a) {
  if (a.empty()) return write_all_figures(s);
  Debugger& debugger = need_trace(s.document);
  const Fields fields("figure", a, {"what", "file", "call", "look"});
  FigureRequest request{find_figure_kind(fields.text("what")), {}, fields.look("look")};
  const std::string file = fields.text("file");
  figure::check_drawing_name(file);
  if (const auto call = fields.whole("call")) {
    request.call = static_cast<std::uint32_t>(std::min<std::uint64_t>(*call, kNoCall));
  } else if (debugger.call() != kNoCall) {
    request.call = debugger.call();
  }
  figure::write_drawing(file, debugger.draw(request));
  s.document.message = {"wrote " + file, false};
  return nullptr;
}

json frames(Session& s, const json& a) {
  const Debugger& debugger = need_trace(s.document);
  const Fields fields("frames", a, {"from", "to", "every", "file"});
  const FrameRange range = frame_range(
      {fields.whole("from"), fields.whole("to"), fields.whole("every")}, debugger.end());
  const std::string file = fields.text("file");
  if (file.ends_with(".mp4") || file.ends_with(".gif")) {
    write_video(s, range, file);
  } else {
    write_frames(s, range, file);
  }
  s.document.message = {fmt::format("wrote {} frames", range.count()), false};
  return range.count();
}

json title(Session& s, const json& a) {
  s.document.view.title = a.empty() ? "" : Arguments("title", a).text(0);
  return nullptr;
}

/// The menu takes the next one.
json background(Session& s, const json& a) {
  Background& shown = s.document.view.background;
  if (a.empty()) {
    shown = static_cast<Background>((static_cast<unsigned>(shown) + 1) % 3);
  } else {
    apply_json(s.document.view, {{"background", Arguments("background", a).text(0)}});
  }
  return to_json(s.document.view)["background"];
}

constexpr std::array kFigureCommands = {
    Command{
        "figure", "", kFileMenu, "figure{what = \"ring\", file = \"FILE.svg\", call = CALL}",
        "Write the ring, tree, timeline or shell of a call, or of the one at hand, as .svg, .pdf "
        "or .tex; the menu all of them as tetmend-ring.svg, ...",
        &figure},
    Command{
        "frames", "", "", "frames{from = N, to = N, every = N, file = \"f-%04d.png\"}",
        "Write pictures of a range of events of a trace, or a video, x.mp4 or x.gif; the result is "
        "their number",
        &frames},
    Command{"colour_bar", "", kViewMenu, "colour_bar()",
            "A colour bar with the numbers of the measure on or off; of regions, their colours",
            &toggle<&ViewSettings::colour_bar>},
    Command{"scale_bar", "", kViewMenu, "scale_bar()", "A scale bar on or off",
            &toggle<&ViewSettings::scale_bar>},
    Command{"title", "", "", "title(\"TEXT\")", "A title over the mesh; without a text, none",
            &title},
    Command{"background", "", kViewMenu, "background(\"white\")",
            "Background gradient, white or transparent, which PNG files have as alpha; the menu "
            "takes the next",
            &background},
};

}  // namespace

std::span<const Command> figure_commands() {
  return kFigureCommands;
}

}  // namespace tetmend::viewer
