// SPDX-License-Identifier: MIT
// How --help looks: a usage line with all that is required, the usual options first and the others
// in groups, and option names without the parser's types. -h shows the usual ones alone.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace tetmend::apps {

/// Under which options are listed, in this order.
namespace headings {
inline constexpr const char* kUsual = "Options";  // the parser's own for what has no other
inline constexpr const char* kChange = "How much may change";
inline constexpr const char* kSearch = "How it is searched";
inline constexpr const char* kData = "Files and data";
inline constexpr const char* kLarge = "Large meshes";
inline constexpr const char* kRecord = "Record of the run";
inline constexpr const char* kPlugins = "Plugins";
}  // namespace headings

class HelpFormatter : public CLI::Formatter {
 public:
  /// @param is_short what is usual alone, in one screen
  explicit HelpFormatter(bool is_short = false);

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  /// "Usage: tetmend improve IN -o OUT [OPTIONS]"
  std::string make_usage(const CLI::App* app, std::string name) const override;
  /// What follows the name of an option: the name of its value.
  std::string make_option_opts(const CLI::Option* option) const override;
  /// In lines as long as the column, wherever the text breaks its own.
  std::string make_option_desc(const CLI::Option* option) const override;

 private:
  std::string list_groups(const CLI::App& app) const;
  std::string list_commands(const CLI::App& app) const;

  bool is_short_;
};

/// Whether these arguments ask for the short help: -h, and not --help.
bool asks_for_short_help(const std::vector<std::string>& arguments);

/// The program's own options get headings beside those that the library's have.
void group_options(CLI::App& command);

/// The number of its heading.
std::size_t place_in_help(const CLI::Option& option);

/// What is wrong with the command line, in one line, for what the parser itself says in words of
/// its own. Precondition: the error is no request for help.
std::string message_of(const CLI::ParseError& error);

}  // namespace tetmend::apps
