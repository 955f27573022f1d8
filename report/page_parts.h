// SPDX-License-Identifier: MIT
// The parts of a page, as they are in assets/page/report.
#pragma once

#include <string_view>

namespace tetmend::report {

std::string_view page_form();     ///< HTML with places to fill in: @TITLE@, @STYLE@, ...
std::string_view page_style();    ///< CSS
std::string_view charts_style();  ///< CSS of the charts alone, of page_style()
std::string_view page_script();   ///< JavaScript, all files in order

}  // namespace tetmend::report
