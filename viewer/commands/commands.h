// SPDX-License-Identifier: MIT
// What a user can tell the viewer: one list for menus, keys and scripts.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "viewer/document.h"
#include "viewer/mesh/image.h"

namespace tetmend::viewer {

/// What commands need of the program around the document.
class Host {
 public:
  virtual ~Host() = default;
  /// Gives the mesh the part of the document's window that is left for it.
  virtual void arrange(Document& document) = 0;
  /// The picture of the document as it is now, in the size of its window.
  virtual Image render(Document& document) = 0;
  virtual void set_clipboard(const std::string& text) = 0;
  virtual std::string clipboard() = 0;
  /// What a script says: a line on standard output.
  virtual void print(const std::string& line);
};

struct Session {
  Document& document;
  Host& host;
  bool is_drawing = false;  ///< the panels, which may have asked for what follows
  std::vector<std::function<void()>> asked = {};  ///< by do_soon(), in its order
};

struct Command {
  std::string_view name;   ///< as a script calls it
  std::string_view keys;   ///< "Ctrl+O"; empty without a key
  std::string_view menu;   ///< "File", "View", ...; empty for scripts only
  std::string_view usage;  ///< its arguments in a script
  std::string_view help;
  /// Arguments come as a JSON array, empty from keys and menus; the result goes to the script.
  nlohmann::json (*run)(Session& session, const nlohmann::json& arguments);
};

/// All of them, in the order of menus and manual.
std::span<const Command> commands();

/// Precondition: there is a command of this name.
const Command& find_command(std::string_view name);
/// The command of a key such as "Ctrl+Shift+N", or null.
const Command* command_for_keys(std::string_view keys);

/// Runs the command that waits, whatever is lost. Precondition: there is one.
void run_waiting(Session& session);

/// Does it. Whatever is thrown becomes the message of the document, and the result is false.
bool guarded(Document& document, const std::function<void()>& work);

/// Does it, guarded: at once, or when all panels are drawn if one of them asks. Else a mesh or trace
/// would go from under those that are still to be drawn.
void do_soon(Session& session, const std::function<void()>& work);
/// What do_soon() has put off. Precondition: no panel is being drawn.
void do_asked(Session& session);

/// Runs it as a menu or key does, by do_soon(); what would lose unsaved work waits for the user's
/// answer, see Document::waiting.
void run_from_window(const Command& command, Session& session,
                     const nlohmann::json& arguments = nlohmann::json::array());

/// A Markdown table: keys and mouse, words of scripts, what they do. For the manual.
std::string command_reference();

/// What the mouse does: gesture and effect.
std::span<const std::pair<std::string_view, std::string_view>> mouse_gestures();

/// The place in a trace for scripts and tests: position, call, verdict, shell, code line.
/// Precondition: a trace is open.
nlohmann::json trace_state_of(Document& document);
/// The operator that was tried and how it ended; null without one.
nlohmann::json trial_state_of(const Document& document);

/// The state of the document for scripts and tests: counts, selection, view.
nlohmann::json state_of(Document& document);

}  // namespace tetmend::viewer
