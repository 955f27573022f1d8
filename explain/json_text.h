// SPDX-License-Identifier: MIT
// JSON of what strangers called their files, groups and arrays.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace tetmend::explain {

/// The same with printable_lines() of each text, and of each name of a member.
nlohmann::json printable_json(nlohmann::json json);
nlohmann::ordered_json printable_json(nlohmann::ordered_json json);

/// The texts and names that printable_json() changes, as it writes them; each once.
std::vector<std::string> changed_texts(const nlohmann::json& json);

/// printable_json() as text, which cannot fail for what its texts hold.
/// @param indent as of dump(): below 0, one line
std::string json_text(const nlohmann::json& json, int indent = -1);
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace tetmend::explain
