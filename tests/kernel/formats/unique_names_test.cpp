// SPDX-License-Identifier: MIT
// Names that a format takes, of which none is like another.
#include "kernel/formats/unique_names.h"

#include <doctest/doctest.h>

#include "kernel/formats/vector_parts.h"

using namespace tetmend;
using namespace tetmend::formats;

TEST_CASE("a name that is too long is cut between two characters, and without blanks at the end") {
  const NameRules rules = {.most = 5};
  CHECK(fit_name("abcde", rules) == "abcde");
  CHECK(fit_name("abcdef", rules) == "abcde");
  CHECK(fit_name("abcd\xC3\xA4", rules) == "abcd");  // of two bytes
  CHECK(fit_name("ab\xE2\x82\xAC", rules) == "ab\xE2\x82\xAC");
  CHECK(fit_name("abc\xE2\x82\xAC", rules) == "abc");
  CHECK(fit_name("\x80\x81\x82\x83\x84\x85", rules) == "\x80\x81\x82\x83\x84");  // no UTF-8
  CHECK(fit_name("abcd ef", rules) == "abcd");
  CHECK(fit_name("a\nb", rules) == "a_b");
  CHECK(fit_name("", rules) == "unnamed");
}

TEST_CASE("a part of a path has no slash, no blank in front, and is no folder") {
  const NameRules rules = {.most = 32, .slash = '!'};
  CHECK(fit_name("a/b", rules) == "a!b");
  CHECK(fit_name("  a", rules) == "a");
  for (const char* name : {".", "..", "   "}) CHECK(fit_name(name, rules) == "unnamed");
  CHECK(fit_name("a/b", {.most = 32}) == "a/b");
}

TEST_CASE("names that are cut to the same one get numbers within the length of a name") {
  UniqueNames names(NameRules{.most = 8});
  CHECK(names.make_fit("pressure of water") == "pressure");
  CHECK(names.make_fit("pressure of air") == "pressu_2");
  for (int i = 3; i < 10; ++i) names.make_fit("pressure");
  CHECK(names.make_fit("pressure") == "press_10");
}

TEST_CASE("components of an array whose name is cut or taken still have the endings of axes") {
  const AxisEndings axes = {"X", "Y", "Z"};
  const DataArray velocity{"velocity of water", 3, std::vector<double>(3)};
  UniqueNames taken(NameRules{.most = 9});
  taken.take("velocityY");
  using Names = std::vector<std::string>;
  CHECK(component_names(velocity, axes, taken) == Names{"veloci_2X", "veloci_2Y", "veloci_2Z"});
  CHECK(component_names(velocity, axes, taken) == Names{"veloci_3X", "veloci_3Y", "veloci_3Z"});
  CHECK(component_names({"velocityX", 1, std::vector<double>(1)}, axes, taken) ==
        Names{"velocityX"});
}
