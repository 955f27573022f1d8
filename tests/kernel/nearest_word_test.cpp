// SPDX-License-Identifier: MIT
// Guesses at mistyped words.
#include "apps/nearest_word.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

using tetmend::apps::guess;
using tetmend::apps::nearest_word;

namespace {

const std::vector<std::string> kNames = {"improve", "quality", "check", "convert", "--report"};

}  // namespace

TEST_CASE("a word with a slip is taken for the one that was meant") {
  CHECK(nearest_word("imrpove", kNames) == "improve");
  CHECK(nearest_word("improv", kNames) == "improve");
  CHECK(nearest_word("qualitty", kNames) == "quality");
  CHECK(nearest_word("chekc", kNames) == "check");
  CHECK(nearest_word("--raport", kNames) == "--report");
  CHECK(nearest_word("improve", kNames) == "improve");
  CHECK(guess("convrt", kNames) == ": did you mean 'convert'?");
}

TEST_CASE("another word is no slip") {
  CHECK(nearest_word("smooth", kNames).empty());
  CHECK(nearest_word("x", kNames).empty());
  CHECK(nearest_word("", kNames).empty());
  CHECK(nearest_word(std::string(10'000, 'a'), kNames).empty());
  CHECK(guess("smooth", kNames).empty());
  CHECK(nearest_word("check", {}).empty());
}
