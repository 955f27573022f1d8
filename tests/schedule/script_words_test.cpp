// SPDX-License-Identifier: MIT
// Words of scripts against their reference, and many passes. Only these make passes by the hundred.
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "schedule/reference.h"
#include "schedule/words.h"
#include "tests/schedule/script_outcome.h"
#include "tests/support/registry.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("every word of the reference exists and takes every argument that it names") {
  std::set<std::string> names;
  for (const WordInfo& word : schedule_words()) {
    CAPTURE(word.name);
    names.insert(std::string(word.name));
    CHECK(contains(run_script("nonsense()").error, std::string(word.name)));
    const bool is_pass = !word.fields.empty();
    if (!is_pass) continue;
    std::string call = std::string(word.name) + (word.name == "apply" ? "('smoothing', {" : "({");
    for (const WordField& field : word.fields) {
      call += std::string(field.name) + " = " + std::string(field.initial) + ", ";
    }
    for (const ParameterSpec& spec : word.numbers) {
      const bool flag = spec.kind == ParameterSpec::Kind::flag;
      const std::string value = flag ? "true" : std::to_string(static_cast<int>(spec.initial));
      call += std::string(spec.name) + " = " + value + ", ";
    }
    CAPTURE(call);
    CHECK(run_script(call + "})").error == "");
  }
  // Nothing is missing in it.
  const std::string error = run_script("nonsense()").error;
  const std::set<std::string> library = {"assert",   "error",    "ipairs", "math",
                                         "pairs",    "select",   "string", "table",
                                         "tonumber", "tostring", "type"};
  std::string list = error.substr(error.find("valid: ") + 7) + ", ";
  for (std::size_t end = 0; (end = list.find(", ")) != std::string::npos; list.erase(0, end + 2)) {
    const std::string name = list.substr(0, end);
    CHECK_MESSAGE((names.contains(name) || library.contains(name)), name);
  }
}

TEST_CASE("a word takes the parameters of its operators and no others") {
  for (const WordInfo& word : schedule_words()) {
    if (word.operators.empty()) continue;
    CAPTURE(word.name);
    std::string operators = std::string(word.operators) + " ";
    for (std::size_t end = 0; (end = operators.find(' ')) != std::string::npos;
         operators.erase(0, end + 1)) {
      for (const ParameterSpec& spec : kRegistry.find(operators.substr(0, end)).parameters) {
        const bool flag = spec.kind == ParameterSpec::Kind::flag;
        const std::string value = flag ? "false" : std::to_string(spec.initial);
        const std::string script = std::string(word.name) + "{" + std::string(spec.name) + " = " +
                                   (spec.kind == ParameterSpec::Kind::integer
                                        ? std::to_string(static_cast<int>(spec.initial))
                                        : value) +
                                   "}";
        CAPTURE(script);
        CHECK(run_script(script).error == "");
      }
    }
  }
}

TEST_CASE("passes without end come to an end") {
  for (const char* pass : {"smooth{}", "attempt('smoothing', {0})"}) {
    CAPTURE(pass);
    CHECK(contains(run_script(std::string("while true do ") + pass + " end").error,
                   "records of passes"));
  }
}
