// SPDX-License-Identifier: MIT
// JSON with texts of strangers.
#include "explain/json_text.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace tetmend::explain;
using nlohmann::json;

TEST_CASE("JSON of any bytes is UTF-8 that a reader takes") {
  const json report = {{"input", "caf\xe9.mesh"},
                       {"lines", "one\ntwo"},
                       {"\x1b[31m", {1, 2.5, nullptr, true, "\xff\xfe", "\u202e"}}};
  const json read = json::parse(json_text(report));
  CHECK(read["input"] == "café.mesh");
  CHECK(read["lines"] == "one\ntwo");
  CHECK(read["\\x1b[31m"] == json{1, 2.5, nullptr, true, "ÿþ", "\\u202e"});
  CHECK(json_text(json{{"a", 1}}, 2) == json{{"a", 1}}.dump(2));
}

TEST_CASE("the order of members stays") {
  const nlohmann::ordered_json ordered = {{"z", "\xe9"}, {"a", 1}};
  CHECK(json_text(ordered) == "{\"z\":\"é\",\"a\":1}");
}

TEST_CASE("texts that change are named once") {
  const json report = {{"a", "\xe9"}, {"b", {"\xe9", "plain", "x\ny"}}, {"\x01", 1}};
  CHECK(changed_texts(report) == std::vector<std::string>{"\\x01", "é"});
}
