// SPDX-License-Identifier: MIT
// An Abaqus deck as a list of blocks: a keyword line with parameters, and the lines below it.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/deck_files.h"

namespace tetmend::formats {

/// In capitals, without blanks at the ends or quotes: names are compared so.
std::string inp_key(std::string_view text);
std::string_view trimmed(std::string_view text);
/// A blank, a tab, or the first half of a line break of Windows.
inline bool is_inp_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
/// Where a line ends: at its line break, or where the text does.
const char* inp_line_end(const char* begin, const char* end);

/// Of nodes and elements, that is read.
inline constexpr std::int64_t kInpGreatestNumber = std::int64_t{1} << 53;

/// Where numbers and names of a deck mean something: the deck itself, a part, or an instance that has
/// nodes of its own.
struct InpScope {
  std::string name;      ///< of the part or instance, as inp_key() has it
  bool is_mesh = false;  ///< else its lines stay as they are
  /// From its numbers to those of the mesh, where the scopes of the mesh follow each other.
  std::int64_t node_offset = 0;
  std::int64_t element_offset = 0;
  std::int64_t most_node = kInpGreatestNumber;  ///< its own where there are several scopes
  std::int64_t most_element = kInpGreatestNumber;

  /// The number in the mesh of a number of this scope; 0, which nothing has: it is one of another scope.
  std::int64_t node(std::int64_t number) const {
    return number < 1 || number > most_node ? 0 : number + node_offset;
  }
  std::int64_t element(std::int64_t number) const {
    return number < 1 || number > most_element ? 0 : number + element_offset;
  }
};

struct InpInstance {
  std::string name;       ///< as it stands there
  std::string part;       ///< as inp_key() has it
  std::size_t scope = 0;  ///< of its part, or its own
};

/// Lines of a file from a keyword to the next one; the first block of a file has none.
struct InpBlock {
  struct Parameter {
    std::string name;        ///< in capitals
    std::string_view value;  ///< as it stands there; empty: none
    std::string_view text;   ///< both
  };
  const InputFile* file = nullptr;
  std::string keyword;  ///< "SOLID SECTION"; empty: what comes before the first keyword
  std::vector<Parameter> parameters;
  const char* begin = nullptr;  ///< of the keyword line
  const char* data = nullptr;   ///< behind it
  const char* end = nullptr;
  int file_number = 0;          ///< 0: the deck, else that of an included file
  int included = 0;             ///< of *INCLUDE: the number of that file
  bool is_in_assembly = false;  ///< and in no instance with nodes of its own
  std::size_t scope = 0;        ///< of its numbers; for an assembly that of the instance it names
  std::size_t instance = 0;     ///< that a block of the assembly names, from 1; 0: none
  bool is_of_mesh = true;       ///< that scope is part of the mesh
  const InputFile* input = nullptr;  ///< its data lines are those of this file

  std::string_view text() const { return {begin, static_cast<std::size_t>(end - begin)}; }
  std::string_view keyword_text() const { return {begin, static_cast<std::size_t>(data - begin)}; }
  /// Null if the keyword line does not have it.
  const Parameter* find(std::string_view name) const;
  std::string_view value(std::string_view name) const;
  [[noreturn]] void fail(std::string_view reason) const { file->fail_at_line(begin, reason); }
};

/// A deck with the files that it includes, each where it is included.
class InpLines {
 public:
  explicit InpLines(const std::filesystem::path& file);

  std::deque<InpBlock> blocks;
  std::vector<InpScope> scopes = {{"", true}};  ///< 0: the deck itself
  std::vector<InpInstance> instances;
  /// That lines outside of parts may mean. More than one: by the name of an instance alone.
  std::vector<std::size_t> mesh_scopes;
  struct Include {
    int parent = 0;                ///< file that includes it
    bool parent_is_beside = true;  ///< beside the deck: so the line would mean the same there
  };
  std::vector<Include> includes;  ///< by file number; 0 is the deck itself

  /// From 1; 0: none is called so.
  std::size_t find_instance(std::string_view name) const;

  /// Bytes of all files, each once however often it is included.
  std::size_t size_of_files() const { return files_.size_of_files(); }
  /// That were opened, the deck first.
  const std::vector<std::filesystem::path>& files() const { return files_.paths(); }

 private:
  void read(const InputFile& file, const std::filesystem::path& path, int number);
  void add(InpBlock block, const std::filesystem::path& path);

  DeckFiles files_;
  std::filesystem::path folder_;
  std::map<std::string, std::size_t, std::less<>> number_of_instance_;  // from 1
  void enter(InpBlock& block);
  void choose_scopes();
  void place_blocks();
  void set_offsets();

  bool in_assembly_ = false;
  std::size_t scope_ = 0;  // that lines are in
};

}  // namespace tetmend::formats
