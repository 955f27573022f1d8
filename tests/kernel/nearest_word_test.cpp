// SPDX-License-Identifier: MIT
// Guesses at mistyped words.
#include "kernel/nearest_word.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

using tetmend::guess;
using tetmend::guess_of;
using tetmend::nearest_word;

namespace {

const std::vector<std::string> kWords = {"improve", "quality", "check", "convert", "--report"};

}  // namespace

TEST_CASE("a word with a slip is taken for the one that was meant") {
  CHECK(nearest_word("imrpove", kWords) == "improve");
  CHECK(nearest_word("improv", kWords) == "improve");
  CHECK(nearest_word("qualitty", kWords) == "quality");
  CHECK(nearest_word("chekc", kWords) == "check");
  CHECK(nearest_word("--raport", kWords) == "--report");
  CHECK(nearest_word("improve", kWords) == "improve");
  CHECK(guess("convrt", kWords) == ": did you mean 'convert'?");
}

TEST_CASE("another word is no slip") {
  CHECK(nearest_word("smooth", kWords).empty());
  CHECK(nearest_word("x", kWords).empty());
  CHECK(nearest_word("", kWords).empty());
  CHECK(nearest_word(std::string(10'000, 'a'), kWords).empty());
  CHECK(guess("smooth", kWords).empty());
  CHECK(nearest_word("check", {}).empty());
}

TEST_CASE("behind a list of what is valid the nearest of it is asked for") {
  CHECK(guess_of("edge_slit", "edge_split, flip_2_3") == "; did you mean 'edge_split'?");
  CHECK(guess_of("flip_2_4", "edge_split, flip_2_3") == "; did you mean 'flip_2_3'?");
  CHECK(guess_of("smooth", "edge_split, flip_2_3").empty());
  CHECK(guess_of("smooth", "").empty());
}
