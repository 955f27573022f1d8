// SPDX-License-Identifier: MIT
// docs/library.md and kernel.md show programs that are compiled and run; the first has all options that there are.
#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/kernel/formats/fixtures.h"
#include "tests/support/assets.h"

using namespace tetmend::test;

namespace {

/// What stands between ```LANGUAGE and ```.
std::vector<std::string> blocks_of(const std::string& page, const std::string& language) {
  const std::string begin = "```" + language + "\n";
  std::vector<std::string> blocks;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    blocks.push_back(page.substr(at, page.find("```", at) - at));
  }
  return blocks;
}

}  // namespace

TEST_CASE("the programs of docs/library.md are those that the install test builds and runs") {
  const std::string page = read_text(kSource / "docs/library.md");
  const auto programs = kSource / "tests/install/library_user";
  const std::string sources =
      read_text(programs / "main.cpp") + read_text(programs / "embedded.cpp");
  CHECK(blocks_of(page, "cpp").size() == 6);
  for (const std::string& block : blocks_of(page, "cpp")) {
    CAPTURE(block);
    CHECK(sources.find(block) != std::string::npos);
  }
  const std::string projects = read_text(programs / "CMakeLists.txt") +
                               read_text(programs / "../subproject_user/CMakeLists.txt");
  CHECK(blocks_of(page, "cmake").size() == 2);
  for (const std::string& block : blocks_of(page, "cmake")) {
    CAPTURE(block);
    CHECK(projects.find(block) != std::string::npos);
  }
}

TEST_CASE("the ten programs of docs/kernel.md are those that the install test builds and runs") {
  const std::string page = read_text(kSource / "docs/kernel.md");
  const auto programs = kSource / "tests/install/kernel_user";
  const std::string source =
      read_text(programs / "main.cpp") + read_text(programs / "programs.cpp");
  const auto blocks = blocks_of(page, "cpp");
  CHECK(blocks.size() >= 10);
  for (const std::string& block : blocks) {
    CAPTURE(block);
    CHECK(source.find(block) != std::string::npos);
  }
  CHECK(blocks_of(page, "cmake").size() == 1);
  CHECK(read_text(programs / "CMakeLists.txt").find(blocks_of(page, "cmake")[0]) !=
        std::string::npos);
}

TEST_CASE("the ten programs of docs/kernel.md stay as short as a page of programs needs") {
  struct Program {
    std::vector<std::string> functions;
    long most_lines;
  };
  const std::vector<Program> programs = {
      {{"histogram"}, 7},     {{"look_around"}, 11},   {{"count_new"}, 9},
      {{"smooth"}, 13},       {{"adapt_lengths"}, 21}, {{"worst", "flip_edges_away"}, 13},
      {{"find_regions"}, 13}, {{"half_of"}, 4},        {{"refine"}, 35},
      {{"largest_call"}, 12}};
  const auto blocks = blocks_of(read_text(kSource / "docs/kernel.md"), "cpp");
  for (const Program& program : programs) {
    long lines = 0;
    for (const std::string& function : program.functions) {
      CAPTURE(function);
      const auto block = std::find_if(blocks.begin(), blocks.end(), [&](const std::string& text) {
        return text.substr(0, text.find('\n')).find(' ' + function + '(') != std::string::npos;
      });
      REQUIRE(block != blocks.end());
      lines += std::count(block->begin(), block->end(), '\n');
    }
    CAPTURE(program.functions.front());
    CHECK(lines <= program.most_lines);
  }
}

TEST_CASE("docs/library.md has a row for each field of Options and Result") {
  const std::string page = read_text(kSource / "docs/library.md");
  const std::string header = read_text(kSource / "include/tetmend/improve.h");
  std::size_t fields = 0;
  for (const std::string name : {"struct Options {", "struct Result {"}) {
    const std::size_t begin = header.find(name);
    REQUIRE(begin != std::string::npos);
    const std::string body = header.substr(begin, header.find("\n};", begin) - begin);
    const std::regex field(R"(\n  [A-Za-z][\w:<>(), &*]* \*?(\w+)( = [^;]+)?;)");
    for (std::sregex_iterator each(body.begin(), body.end(), field), end; each != end; ++each) {
      const std::string word = (*each)[1].str();
      if (word == "const") continue;  // a function
      CAPTURE(word);
      CHECK(page.find('`' + word + '`') != std::string::npos);
      ++fields;
    }
  }
  CHECK(fields >= 35);
}
