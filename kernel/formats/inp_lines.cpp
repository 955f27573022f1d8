// SPDX-License-Identifier: MIT
// An Abaqus deck as a list of blocks.
#include "kernel/formats/inp_lines.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/compression.h"
#include "kernel/formats/included_path.h"
#include "kernel/formats/inp_fields.h"
#include "kernel/formats/inp_types.h"

namespace tetmend::formats {
namespace {

const char* after_line(const char* begin, const char* end) {
  const char* stop = inp_line_end(begin, end);
  return stop == end ? end : stop + 1;
}

bool is_keyword(const char* begin, const char* end) {
  while (begin != end && is_inp_blank(*begin)) ++begin;
  return end - begin > 1 && begin[0] == '*' && begin[1] != '*';
}

std::string in_capitals(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

/// "Solid  section" is "SOLID SECTION".
std::string keyword_name(std::string_view text) {
  std::string name;
  for (const char c : in_capitals(trimmed(text))) {
    if (!is_inp_blank(c) || (!name.empty() && name.back() != ' '))
      name += is_inp_blank(c) ? ' ' : c;
  }
  return name;
}

/// Commas in quotes part nothing.
std::size_t find_comma(std::string_view text) {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == ',' && !quoted) return i;
  }
  return text.size();
}

/// What is left behind blanks and lines of comments.
std::string_view behind_comments(std::string_view text) {
  for (;;) {
    const std::string_view rest =
        text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (!rest.starts_with("**")) return text;
    text = rest.substr(std::min(rest.find('\n'), rest.size()));
  }
}

void read_parameters(InpBlock& block) {
  std::string_view rest = trimmed(block.keyword_text()).substr(1);
  const std::size_t first = find_comma(rest);
  block.keyword = keyword_name(rest.substr(0, first));
  rest.remove_prefix(first);
  while (!rest.empty()) {
    rest = behind_comments(rest.substr(1));
    const std::size_t length = find_comma(rest);
    const std::string_view field = rest.substr(0, length);
    const std::size_t equals = std::min(field.find('='), field.size());
    InpBlock::Parameter parameter{keyword_name(field.substr(0, equals)), {}, trimmed(field)};
    if (equals < field.size()) parameter.value = trimmed(field.substr(equals + 1));
    if (!parameter.name.empty()) block.parameters.push_back(std::move(parameter));
    rest.remove_prefix(length);
  }
}

}  // namespace

const char* inp_line_end(const char* begin, const char* end) {
  const void* found =
      begin == end ? nullptr : std::memchr(begin, '\n', static_cast<std::size_t>(end - begin));
  return found == nullptr ? end : static_cast<const char*>(found);
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return is_inp_blank(c) || c == '\n'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string inp_key(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  return in_capitals(text);
}

const InpBlock::Parameter* InpBlock::find(std::string_view name) const {
  for (const Parameter& parameter : parameters) {
    if (parameter.name == name) return &parameter;
  }
  return nullptr;
}

std::string_view InpBlock::value(std::string_view name) const {
  const Parameter* found = find(name);
  return found == nullptr ? std::string_view() : found->value;
}

InpLines::InpLines(const std::filesystem::path& file)
    : files_(file, DeckFiles::kMostInclusions), folder_(file.parent_path()) {
  includes.push_back({});
  read(files_.deck(), file, 0);
  choose_scopes();
  place_blocks();
  set_offsets();
}

std::size_t InpLines::find_instance(std::string_view name) const {
  const auto found = number_of_instance_.find(inp_key(name));
  return found == number_of_instance_.end() ? 0 : found->second;
}

/// A part or an instance begins or ends.
void InpLines::enter(InpBlock& block) {
  const bool is_part = block.keyword == "PART";
  if (block.keyword == "ASSEMBLY") in_assembly_ = true;
  if (block.keyword == "END ASSEMBLY") in_assembly_ = false;
  if (is_part || block.keyword == "INSTANCE") {
    scope_ = scopes.size();
    const std::string_view name = block.value("NAME");
    scopes.push_back({inp_key(name), false});
    if (!is_part) {
      instances.push_back({std::string(name), inp_key(block.value("PART")), scope_});
      if (!number_of_instance_.try_emplace(inp_key(name), instances.size()).second) {
        block.fail(fmt::format("there is an instance {} already", in_quotes(name)));
      }
    }
  }
  block.scope = scope_;
  block.is_in_assembly = in_assembly_ && scope_ == 0;
  if (block.keyword == "END PART" || block.keyword == "END INSTANCE") scope_ = 0;
}

/// The mesh is in the scopes with tets; where none has any, in those with other elements, or with
/// nodes at least. An instance stands for its part, unless it has a mesh of its own.
void InpLines::choose_scopes() {
  enum : int { nothing, nodes, elements, tets };
  std::vector<int> has(scopes.size(), nothing);
  for (const InpBlock& block : blocks) {
    int found = block.keyword == "NODE" ? nodes : nothing;
    if (block.keyword == "ELEMENT") {
      const InpType type = inp_type(block.value("TYPE"));
      const bool is_tet = type.vtk_type == kVtkTet || type.vtk_type == kVtkTet10;
      if (type.kind != InpType::Kind::other) found = is_tet ? tets : elements;
    }
    if (!block.is_in_assembly) has[block.scope] = std::max(has[block.scope], found);
  }
  const int most = *std::max_element(has.begin(), has.end());
  for (std::size_t s = 1; s < scopes.size(); ++s) {
    scopes[s].is_mesh = most != nothing && has[s] == most;
  }
  scopes[0].is_mesh = scopes.size() == 1 || has[0] != nothing;
  for (std::size_t s = 0; s < scopes.size(); ++s) {
    if (scopes[s].is_mesh) mesh_scopes.push_back(s);
  }
  std::map<std::string_view, std::size_t> parts;
  std::set<std::size_t> of_instances;
  for (const InpInstance& instance : instances) of_instances.insert(instance.scope);
  for (std::size_t s = 1; s < scopes.size(); ++s) {
    if (of_instances.contains(s)) continue;
    if (!parts.try_emplace(scopes[s].name, s).second) {
      throw Error(fmt::format("{}: there is a part {} already", files_.paths().front().string(),
                              in_quotes(scopes[s].name)));
    }
  }
  for (InpInstance& instance : instances) {
    const auto part = parts.find(instance.part);
    const bool has_less = part != parts.end() && has[instance.scope] < has[part->second];
    if (has_less || (has[instance.scope] == nothing && part != parts.end())) {
      instance.scope = part->second;
    }
  }
}

/// Lines of an assembly that name an instance mean its numbers.
void InpLines::place_blocks() {
  for (InpBlock& block : blocks) {
    if (block.is_in_assembly && block.find("INSTANCE") != nullptr) {
      block.instance = find_instance(block.value("INSTANCE"));
      if (block.instance != 0) {
        block.scope = instances[block.instance - 1].scope;
      } else if (mesh_scopes.size() == 1) {
        block.scope = mesh_scopes[0];
      } else {
        block.fail(
            fmt::format("{} is not the name of an instance", in_quotes(block.value("INSTANCE"))));
      }
    }
    block.is_of_mesh = block.scope == 0 || scopes[block.scope].is_mesh;
  }
}

void InpLines::set_offsets() {
  if (mesh_scopes.size() < 2) return;
  for (InpScope& scope : scopes) scope.most_node = scope.most_element = 0;
  for (const InpBlock& block : blocks) {
    const bool is_node = block.keyword == "NODE";
    if ((!is_node && block.keyword != "ELEMENT") || block.is_in_assembly) continue;
    InpScope& scope = scopes[block.scope];
    std::int64_t& most = is_node ? scope.most_node : scope.most_element;
    InpFields fields(block);
    std::int64_t number = 0;
    while (fields.next_line()) {
      if (to_integer(fields.field(), number) && number <= kInpGreatestNumber) {
        most = std::max(most, number);
      }
    }
  }
  constexpr std::int64_t kMost = std::int64_t{1} << 61;
  std::int64_t nodes = 0;
  std::int64_t elements = 0;
  for (const std::size_t s : mesh_scopes) {
    scopes[s].node_offset = nodes;
    scopes[s].element_offset = elements;
    nodes += scopes[s].most_node;
    elements += scopes[s].most_element;
    if (std::max(nodes, elements) < kMost) continue;
    throw Error(
        fmt::format("{}: the numbers of the parts are too great", files_.paths().front().string()));
  }
}

void InpLines::read(const InputFile& file, const std::filesystem::path& path, int number) {
  const DeckFiles::Nested nested(files_, path);
  const char* end = file.end();
  InpBlock block;
  block.file = &file;
  block.file_number = number;
  constexpr std::string_view kMark = "\xEF\xBB\xBF";  // of UTF-8
  const bool is_marked = std::string_view(file.begin(), file.size()).starts_with(kMark);
  block.begin = block.data = file.begin() + (is_marked ? kMark.size() : 0);
  for (const char* next = block.begin; next != end;) {
    if (!is_keyword(next, inp_line_end(next, end))) {
      next = after_line(next, end);
      continue;
    }
    block.end = next;
    add(block, path);
    block.begin = next;
    next = after_line(next, end);
    // A keyword line that ends in a comma goes on, if only behind empty lines and comments. Names of
    // parameters begin with no digit: such a line is data.
    bool goes_on =
        trimmed({block.begin, static_cast<std::size_t>(next - block.begin)}).ends_with(',');
    while (goes_on && next != end && !is_keyword(next, inp_line_end(next, end))) {
      const char* line = next;
      const char* line_after = after_line(next, end);
      const std::string_view more = trimmed({line, static_cast<std::size_t>(line_after - line)});
      if (!more.empty() && more[0] >= '0' && more[0] <= '9') break;
      next = line_after;
      goes_on = more.empty() || more.starts_with("**") || more.ends_with(',');
    }
    block.data = next;
  }
  block.end = end;
  add(block, path);
}

void InpLines::add(InpBlock block, const std::filesystem::path& path) {
  if (block.begin == block.end) return;
  if (is_bomb(size_of_files(),
              sizeof(InpBlock) * blocks.size())) {  // only where the deck is packed
    block.fail("the deck has more keywords than so small a file can hold of a mesh");
  }
  if (block.data != block.begin) read_parameters(block);
  enter(block);
  const bool is_include = block.keyword == "INCLUDE";
  const bool has_input = !is_include && block.find("INPUT") != nullptr &&
                         (block.keyword == "NODE" || block.keyword == "ELEMENT" ||
                          block.keyword == "NSET" || block.keyword == "ELSET");
  if (!is_include && !has_input) {
    blocks.push_back(std::move(block));
    return;
  }
  const std::string_view name = block.value("INPUT");
  if (name.empty()) block.fail("*INCLUDE names no file: expected INPUT=FILE");
  const std::filesystem::path target = included_path(path.parent_path(), name);
  std::string reason;
  const InputFile* included = files_.include(target, {block.begin, name}, reason);
  if (included == nullptr) block.fail(reason);
  const InputFile& file = *included;
  if (has_input) {
    block.input = &file;
    blocks.push_back(std::move(block));
    return;
  }
  const int number = static_cast<int>(includes.size());
  includes.push_back({block.file_number, path.parent_path() == folder_});
  // Comments below the line belong to the file that includes.
  InpBlock tail = block;
  tail.keyword.clear();
  tail.parameters.clear();
  tail.begin = tail.data;
  block.end = block.data;
  block.included = number;
  blocks.push_back(std::move(block));
  read(file, target, number);
  if (tail.begin != tail.end) blocks.push_back(std::move(tail));
}

}  // namespace tetmend::formats
