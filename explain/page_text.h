// SPDX-License-Identifier: MIT
// Text and data on their way into an HTML page.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "figure/markup.h"

namespace tetmend::explain {

using figure::escaped;

/// json_text() that nothing in it can end: no tag begins in it.
std::string in_script(const nlohmann::ordered_json& json);
std::string in_script(const nlohmann::json& json);

/// Replaces each @NAME@ once. What is put in is not looked at again.
std::string fill_in(std::string_view form,
                    const std::vector<std::pair<std::string_view, std::string>>& values);

}  // namespace tetmend::explain
