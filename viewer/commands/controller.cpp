// SPDX-License-Identifier: MIT
#include "viewer/commands/controller.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "kernel/error.h"

namespace tetmend::viewer {

void Controller::press(Button button, double x, double y, bool shift) {
  drag_ = button == Button::left && !shift ? Drag::orbit : Drag::pan;
  button_ = button;
  moved_ = false;
  pressed_ = last_ = {x, y};
}

void Controller::move(double x, double y) {
  constexpr double kHold = 3;  // pixels that a hand trembles
  const glm::dvec2 now(x, y);
  if (drag_ == Drag::nothing) return;
  if (!moved_ && glm::distance(now, pressed_) < kHold) return;
  moved_ = true;
  const glm::dvec2 d = now - last_;
  last_ = now;
  Camera& camera = session_.document.view.camera;
  if (drag_ == Drag::orbit) {
    camera.orbit(d.x, d.y);
  } else {
    camera.pan(d.x, d.y, session_.document.canvas);
  }
}

void Controller::release(double x, double y, double time) {
  const bool is_click = drag_ == Drag::orbit && !moved_;
  const bool is_question = drag_ == Drag::pan && !moved_ && button_ == Button::right;
  drag_ = Drag::nothing;
  if (!session_.document.has_mesh()) return;
  if (is_click) click(x, y, time);
  if (is_question) ask(x, y);
}

/// What lies there, and what is to be done with it.
void Controller::ask(double x, double y) {
  session_.document.begin_act();
  session_.document.pick(x, y);
  session_.document.offer_choices =
      !std::holds_alternative<std::monostate>(session_.document.selection());
}

void Controller::click(double x, double y, double time) {
  constexpr double kSoon = 0.3;
  session_.document.begin_act();
  if (time - last_click_ < kSoon) {
    session_.document.fit();  // what the first click has picked
  } else {
    session_.document.pick(x, y);
  }
  last_click_ = time;
}

void Controller::scroll(double steps, double x, double y) {
  constexpr double kStep = 1.15;
  const glm::dvec2 at = session_.document.to_canvas(x, y);
  session_.document.view.camera.zoom(std::pow(kStep, steps), at.x, at.y, session_.document.canvas);
}

void Controller::key(std::string_view keys) {
  if (const Command* command = command_for_keys(keys)) run_from_window(*command, session_);
}

void Controller::letter(char letter, std::string_view keys, double time) {
  constexpr double kSoon = 0.7;          // seconds
  constexpr std::size_t kWord = 4;       // letters
  constexpr std::size_t kDifferent = 3;  // of them: who holds a key down types no word
  Document& document = session_.document;
  if (time - word_.last > kSoon) {
    word_ = {};
    word_.view = document.view;
    if (document.debugger() != nullptr) word_.position = document.debugger()->position();
  }
  word_.last = time;
  word_.letters += letter;
  document.offer.reset();
  key(keys);
  if (document.offer) word_.made.push_back(document.offer->take_back);  // a file was written
  if (word_.letters.size() < kWord ||
      std::set<char>(word_.letters.begin(), word_.letters.end()).size() < kDifferent) {
    return;
  }
  document.offer = {fmt::format("\"{}\" was typed, and each letter is a key.", word_.letters),
                    "Undo", [word = word_](Document& d) { take_back(word, d); }};
}

void Controller::take_back(const Word& word, Document& document) {
  for (auto step = word.made.rbegin(); step != word.made.rend(); ++step) (*step)(document);
  if (word.position && document.debugger() != nullptr &&
      *word.position <= document.debugger()->end()) {
    document.debugger()->seek(*word.position);
    document.show_trace();
  }
  document.view = word.view;
}

void Controller::drop(const std::filesystem::path& file) {
  guarded(session_.document, [&] {
    const Command& open = find_command("open");
    if (file.extension() != ".json") return run_from_window(open, session_, {file.string()});
    std::ifstream in(file);
    std::stringstream text;
    if (!in || !(text << in.rdbuf())) {
      throw Error(fmt::format("{}: cannot read the view", file.string()));
    }
    const auto content = nlohmann::json::parse(text.str(), nullptr, false);
    if (content.is_object() && content.contains("steps")) {
      return run_from_window(open, session_, {file.string()});
    }
    apply_json_text(session_.document.view, text.str());
  });
}

}  // namespace tetmend::viewer
