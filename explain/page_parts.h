// SPDX-License-Identifier: MIT
// The parts of a page, as they are in assets/page/recording.
#pragma once

#include <string_view>

namespace tetmend::explain {

std::string_view page_form();     ///< HTML with places to fill in: @TITLE@, @STYLE@, ...
std::string_view index_form();    ///< likewise, of a list of pages
std::string_view index_script();  ///< JavaScript of that
std::string_view page_style();    ///< CSS
std::string_view page_script();   ///< JavaScript, all files in order

}  // namespace tetmend::explain
