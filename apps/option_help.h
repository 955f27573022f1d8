// SPDX-License-Identifier: MIT
// What help says of the options that the library reads.
#pragma once

#include <string>
#include <string_view>

#include <tetmend/option_text.h>

namespace tetmend::apps {

/// With its default.
std::string help_of(const OptionForm& form);
/// Of the option of this name. Precondition: there is one.
std::string help_of(std::string_view name);

/// Under which help lists it.
std::string heading_of(OptionGroup group);

}  // namespace tetmend::apps
