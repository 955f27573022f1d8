// SPDX-License-Identifier: MIT
// Options as text, as the command line takes them: for programs that read them from a file, and for
// other languages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/improve.h>

namespace tetmend {

/// What options are about. Help lists them so.
enum class OptionGroup : std::uint8_t { usual, change, search, data, record, plugins, other };

/// An option that text can set: all that help, manuals and other languages say of it.
struct OptionForm {
  std::string_view name;          ///< as on the command line: "time-limit"
  std::string_view value;         ///< what it takes: "SECONDS"; "true|false" of a switch
  bool adds = false;              ///< a second value is put beside the first
  std::string_view help = {};     ///< what it does, one line however long
  std::string_view initial = {};  ///< what holds without it, for people; empty: nothing to be said
  std::string_view needs = {};    ///< the option without which it does nothing; empty: none
  OptionGroup group = OptionGroup::other;  ///< where help lists it
  char letter = '\0';                      ///< of its short form; 0: there is none

  /// It takes no value on the command line.
  bool is_switch() const { return value == "true|false"; }
};

/// All that set_option() knows, in the order of help: the options of `tetmend improve` and `tetmend
/// adapt` that are part of Options, and "script" and "limit".
TETMEND_API std::vector<OptionForm> option_forms();

/// Sets an option like `--NAME VALUE` of `tetmend improve`. A switch takes "true", "false" or "",
/// which is true as well.
/// @throws OptionError for an unknown name, which option() leaves empty, and for a value of another
/// form. The other mistakes are found by check() and improve().
TETMEND_API void set_option(Options& options, std::string_view name, std::string_view value);

/// The message of an error about an option, with the name that it has on the command line:
/// "time-limit: ..."
TETMEND_API std::string message_of(const OptionError& error);

}  // namespace tetmend
