// SPDX-License-Identifier: MIT
// What documents and headers quote is what the code and the program have.
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/judge.h"
#include "kernel/tet_mesh.h"
#include "ops/registry.h"
#include "tests/apps/program.h"
#include "tests/support/assets.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> matches(const std::string& text, const std::regex& pattern,
                                 std::size_t group = 0) {
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    found.push_back((*it)[group]);
  }
  return found;
}

/// Runs of blanks become one.
std::string with_single_blanks(const std::string& line) {
  static const std::regex kBlanks("\\s+");
  return std::regex_replace(line, kBlanks, " ");
}

// ---- The glossary -------------------------------------------------------------------------------

/// The cells of a row of a table; nothing for another line.
std::vector<std::string> cells_of(const std::string& line) {
  static const std::regex kCell("([^|]*)\\|");
  if (!line.starts_with("|")) return {};
  return matches(line.substr(1), kCell, 1);
}

/// What stands between backticks.
std::vector<std::string> quotes_of(const std::string& cell) {
  static const std::regex kQuote("`([^`]*)`");
  return matches(cell, kQuote, 1);
}

struct Entry {
  std::string term;
  std::vector<std::string> identifiers;
  std::vector<std::string> files;
};

/// The rows of all tables that end with an identifier and a file.
std::vector<Entry> read_glossary() {
  std::vector<Entry> entries;
  for (const std::string& line : lines_of(read_text(kSource / "docs/glossary.md"))) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() < 3 || line.starts_with("|---") || cells.back() == " File ") continue;
    entries.push_back({cells.front(), quotes_of(cells[cells.size() - 2]), quotes_of(cells.back())});
  }
  return entries;
}

/// True if each word of an identifier such as `Shell::ring` is a word of the text.
bool has_words(const std::set<std::string>& words_of_text, const std::string& text,
               const std::string& identifier) {
  static const std::regex kWord("--[a-z-]+|[A-Za-z_]\\w*");
  for (const std::string& word : matches(identifier, kWord)) {
    const bool found = word.starts_with("--") ? text.find(word) != std::string::npos
                                              : words_of_text.contains(word);
    if (!found) return false;
  }
  return true;
}

bool stands_in_one_of(const std::vector<std::string>& files, const std::string& identifier) {
  static const std::regex kWord("[A-Za-z_]\\w*");
  for (const std::string& file : files) {
    const std::string text = read_text(kSource / file);
    const std::vector<std::string> words = matches(text, kWord);
    if (has_words({words.begin(), words.end()}, text, identifier)) return true;
  }
  return false;
}

// ---- The deviations -----------------------------------------------------------------------------

struct QuotedParameter {
  std::string name;
  std::string value;
  std::string file;
};

/// What stands as `name = value`, `file`, wherever lines end.
std::vector<QuotedParameter> parameters_of(const std::string& page) {
  static const std::regex kParameter("`(\\w+) = ([^`]*)`, `([\\w./]+)`");
  std::vector<QuotedParameter> found;
  for (std::sregex_iterator it(page.begin(), page.end(), kParameter), end; it != end; ++it) {
    found.push_back({(*it)[1], (*it)[2], (*it)[3]});
  }
  return found;
}

/// A constant, a word of Lua, a parameter of a schedule or of an operator.
bool has_value(const std::string& source, const QuotedParameter& parameter) {
  const std::string value =
      std::regex_replace(parameter.value, std::regex("[.*+?^${}()|\\[\\]\\\\]"), "\\$&");
  const std::regex forms("\\b" + parameter.name + "( = |\", default = |\"(,\\s+[^,{}]*){3},\\s+)" +
                         value + "f?[;,})\\s]");
  return std::regex_search(source, forms);
}

/// The last cells of the rows of its tables: what holds a deviation.
std::vector<std::string> holders_of(const std::string& page) {
  std::vector<std::string> holders;
  for (const std::string& line : lines_of(page)) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() == 3 && cells.back() != " Held by " && !line.starts_with("|---")) {
      holders.push_back(cells.back());
    }
  }
  return holders;
}

// ---- Comments of operators ----------------------------------------------------------------------

/// The comments of a file as one line.
std::string comments_of(const std::string& text) {
  static const std::regex kComment("//[/<]* ?(.*)");
  std::string all;
  for (const std::string& comment : matches(text, kComment, 1)) all += comment + " ";
  return all;
}

}  // namespace

TEST_CASE("each identifier of docs/glossary.md stands in a file that is named beside it") {
  const std::vector<Entry> entries = read_glossary();
  REQUIRE(entries.size() > 100);
  for (const Entry& entry : entries) {
    CAPTURE(entry.term);
    CHECK_FALSE(entry.files.empty());
    for (const std::string& file : entry.files) {
      CHECK_MESSAGE(std::filesystem::exists(kSource / file), file);
    }
    for (const std::string& identifier : entry.identifiers) {
      CHECK_MESSAGE(stands_in_one_of(entry.files, identifier), identifier);
    }
  }
}

TEST_CASE("each parameter of docs/deviations.md has its value in the file that is named with it") {
  const std::string page = with_single_blanks(read_text(kSource / "docs/deviations.md"));
  const std::vector<QuotedParameter> parameters = parameters_of(page);
  REQUIRE(parameters.size() > 15);
  for (const QuotedParameter& parameter : parameters) {
    CAPTURE(parameter.name);
    CAPTURE(parameter.value);
    REQUIRE_MESSAGE(std::filesystem::exists(kSource / parameter.file), parameter.file);
    CHECK_MESSAGE(has_value(read_text(kSource / parameter.file), parameter), parameter.file);
  }
  CHECK(matches(page, std::regex("`\\w+ = ")).size() == parameters.size());
  const std::string sizes = "makes " + std::to_string(TetMesh::bytes_per_tet()) +
                            " bytes a tet and " + std::to_string(TetMesh::bytes_per_vertex()) +
                            " a vertex";
  CHECK_MESSAGE(page.find(sizes) != std::string::npos, sizes);
}

TEST_CASE("each deviation of docs/deviations.md is held by what stands in the file that it names") {
  static const std::regex kHolder("[^;]+");
  const std::vector<std::string> holders = holders_of(read_text(kSource / "docs/deviations.md"));
  REQUIRE(holders.size() > 30);
  for (const std::string& cell : holders) {
    for (const std::string& holder : matches(cell, kHolder)) {
      CAPTURE(holder);
      std::vector<std::string> quotes = quotes_of(holder);
      REQUIRE(quotes.size() > 1);
      const std::string file = quotes.back();
      REQUIRE(std::filesystem::is_regular_file(kSource / file));
      quotes.pop_back();
      for (const std::string& quote : quotes) {
        CHECK_MESSAGE(stands_in_one_of({file}, quote.substr(0, quote.find(" = "))), quote);
      }
    }
  }
}

TEST_CASE("docs/operators.md has the promise of each judge") {
  const std::string page = read_text(kSource / "docs/operators.md");
  const std::vector<std::pair<std::string, Judge>> judges = {
      {"strict", Judge::strict()},
      {"fair", Judge::fair({})},
      {"reaches", Judge::reaches(1)},
      {"lowers_angle", Judge::lowers_angle(0)},
      {"raises_mean", Judge::raises_mean(0)},
      {"fits_lengths", Judge::fits_lengths(0)},
      {"untangles", Judge::untangles()},
      {"opening", Judge::opening()}};
  for (const auto& [name, judge] : judges) {
    const std::string row = "| `" + name + "` | " + std::string(judge.promise()) + " |";
    CHECK_MESSAGE(page.find(row) != std::string::npos, row);
  }
}

TEST_CASE("no comment of an operator quotes a default: the table of the program has them") {
  const Registry registry = Registry::builtin();
  std::size_t sources = 0;
  for (const auto& file : std::filesystem::directory_iterator(kSource / "ops")) {
    ++sources;
    CAPTURE(file.path());
    const std::string comments = comments_of(read_text(file.path()));
    for (const OperatorInfo* info : registry.operators()) {
      for (const ParameterSpec& parameter : info->parameters) {
        const std::regex quoted("\\b" + std::string(parameter.name) + "`? \\(-?[0-9]");
        CHECK_MESSAGE(!std::regex_search(comments, quoted), parameter.name);
      }
    }
  }
  CHECK(sources > registry.operators().size());
}

TEST_CASE("the table of README.md is what script/demo prints") {
  const std::string page = read_text(kSource / "README.md");
  const std::size_t first = page.find("<!-- table -->");
  const std::size_t last = page.find("<!-- /table -->");
  REQUIRE(first < last);
  REQUIRE(last < page.size());
  const std::vector<std::string> blocks =
      matches(page.substr(first, last - first), std::regex("```\n([^`]*)```"), 1);
  REQUIRE(blocks.size() == 1);

  const TempFolder folder;
  const std::string mesh = (kSource / "assets/meshes/bracket.meshb").string();
  const Outcome demo = run_program({"improve", mesh, "-o", (folder / "improved.mesh").string()});
  REQUIRE(demo.status == 0);
  std::vector<std::string> printed;
  for (const std::string& line : lines_of(demo.out)) printed.push_back(with_single_blanks(line));

  std::size_t figures = 0;
  for (const std::string& line : lines_of(blocks[0])) {
    if (line.starts_with("---")) continue;
    // Long lines are shortened.
    const std::string quoted = with_single_blanks(line);
    const bool found = std::any_of(printed.begin(), printed.end(), [&](const std::string& text) {
      return text.starts_with(quoted);
    });
    CHECK_MESSAGE(found, line);
    if (line.find_first_of("0123456789") != std::string::npos) ++figures;
  }
  CHECK(figures >= 5);
}
