// SPDX-License-Identifier: MIT
// How --help looks: a usage line with all that is required, and option names without the parser's
// types.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace tetmend::apps {

class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(28); }
  /// "Usage: tetmend improve IN -o OUT [OPTIONS]"
  std::string make_usage(const CLI::App* app, std::string name) const override;
  /// What follows the name of an option: the name of its value.
  std::string make_option_opts(const CLI::Option* option) const override;
};

}  // namespace tetmend::apps
