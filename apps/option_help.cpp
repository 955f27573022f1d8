// SPDX-License-Identifier: MIT
#include "apps/option_help.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include <fmt/format.h>

#include "apps/help_formatter.h"

namespace tetmend::apps {

std::string help_of(const OptionForm& form) {
  if (form.initial.empty()) return std::string(form.help);
  if (!form.help.ends_with(')')) return fmt::format("{} (default: {})", form.help, form.initial);
  return fmt::format("{}; default: {})", form.help.substr(0, form.help.size() - 1), form.initial);
}

std::string help_of(std::string_view name) {
  const std::vector<OptionForm> forms = option_forms();
  const auto found =
      std::find_if(forms.begin(), forms.end(), [&](const auto& form) { return form.name == name; });
  assert(found != forms.end());
  return help_of(*found);
}

std::string heading_of(OptionGroup group) {
  switch (group) {
    case OptionGroup::change:
      return headings::kChange;
    case OptionGroup::search:
      return headings::kSearch;
    case OptionGroup::data:
      return headings::kData;
    case OptionGroup::record:
      return headings::kRecord;
    case OptionGroup::plugins:
      return headings::kPlugins;
    case OptionGroup::usual:
    case OptionGroup::other:
      break;
  }
  return headings::kUsual;
}

}  // namespace tetmend::apps
