// SPDX-License-Identifier: MIT
// The sets of nodes and elements of an Abaqus deck.
#include "kernel/formats/inp_sets.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "kernel/formats/compression.h"
#include "kernel/formats/inp_fields.h"

namespace tetmend::formats {
namespace {

template <class T>
void make_unique(std::vector<T>& values) {
  if (!std::is_sorted(values.begin(), values.end())) std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Of "Part-1-1.17" that is "17".
std::string_view without_instance(std::string_view text) {
  const std::size_t dot = text.rfind('.');
  const bool has_instance =
      dot != std::string_view::npos &&
      (text[0] == '"' || std::isalpha(static_cast<unsigned char>(text[0])) != 0);
  return has_instance ? text.substr(dot + 1) : text;
}

}  // namespace

bool to_label(std::string_view key, Label& label) {
  constexpr std::string_view kPrefix = "LABEL_";
  if (!key.starts_with(kPrefix)) return false;
  std::string digits(key.substr(kPrefix.size()));
  // What UniqueNames puts behind a name that a set of another dimension has.
  if (const std::size_t again = digits.find('_'); again != std::string::npos) {
    const std::string_view number = std::string_view(digits).substr(again + 1);
    int place = 0;
    const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), place);
    const bool is_whole = error == std::errc() && stop == number.data() + number.size();
    if (!is_whole || place < 2 || fmt::format_int(place).size() != number.size()) return false;
    digits.resize(again);
  }
  key = key.substr(0, kPrefix.size() + digits.size());
  if (digits.starts_with('M')) digits[0] = '-';
  const char* end = digits.data() + digits.size();
  Label number = 0;  // "Label_3_of_4" begins like one
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  if (error != std::errc() || stop != end || inp_key(label_name(number)) != key) return false;
  label = number;
  return true;
}

std::string label_name(Label label) {
  return label < 0 ? fmt::format("Label_m{}", -std::int64_t{label})
                   : fmt::format("Label_{}", label);
}

bool is_set_block(const InpBlock& block) {
  const bool is_set = block.keyword == "NSET" || block.keyword == "ELSET";
  return is_set && block.is_of_mesh && (!block.is_in_assembly || block.find("INSTANCE") != nullptr);
}

InpSets::InpSets(const InpLines& lines, const InpMesh& mesh) : lines_(lines), mesh_(mesh) {
  std::uint32_t nodes = 0;
  for (const InpBlock& block : lines.blocks) {
    if (!is_mesh_block(block, "NODE")) continue;
    InpFields fields(block);
    std::uint32_t count = 0;
    InpSet* set = of_block(block);
    while (set != nullptr && fields.next_line()) ++count;
    // Counting again is needed only where a set is named; else the place is found by the next.
    if (set == nullptr) {
      while (fields.next_line()) ++count;
    } else {
      for (std::uint32_t i = 0; i < count; ++i) set->members.push_back(nodes + i);
    }
    nodes += count;
  }
  for (const InpElements& elements : mesh.blocks) {
    InpSet* set = of_block(*elements.block);
    if (set == nullptr) continue;
    for (std::size_t i = 0; i < elements.count; ++i) {
      set->members.push_back(static_cast<std::uint32_t>(elements.first + i));
    }
  }
  for (const InpBlock& block : lines.blocks) {
    // Springs and their like.
    if (is_mesh_block(block, "ELEMENT") &&
        inp_type(block.value("TYPE")).kind == InpType::Kind::other) {
      InpSet* set = of_block(block);
      InpFields fields(block);
      std::int64_t number = 0;
      while (set != nullptr && fields.next_line()) {
        if (!to_integer(fields.field(), number)) continue;
        set->others.push_back(number + lines.scopes[block.scope].element_offset);
      }
    }
  }
  for (InpSet& set : all) make_unique(set.members);
  for (const InpBlock& block : lines.blocks) {
    if (is_set_block(block)) read(block);
  }
  for (InpSet& set : all) {
    make_unique(set.members);
    make_unique(set.others);
  }
}

/// Ranges, and sets of sets, name more than they have characters.
void InpSets::add_work(std::size_t members, const InpBlock& block) {
  work_ += members;
  if (is_bomb(lines_.size_of_files(), work_ * InpSet::kBytesOfMember)) {
    block.fail("the sets hold hundreds of times the size of the deck, which those of no mesh do");
  }
}

InpSet& InpSets::named(bool of_nodes, const InpBlock& block, std::string_view name) {
  const std::size_t owner = block.is_in_assembly ? kAssembly : block.scope;
  const Key key = {of_nodes, owner, inp_key(name)};
  InpSet*& known = by_instance_[{key, block.instance}];
  if (known != nullptr) return *known;
  InpSet& set = all.emplace_back();
  known = &set;
  set.key = std::get<std::string>(key);
  const bool quoted = name.size() > 1 && name.front() == '"' && name.back() == '"';
  set.name = quoted ? name.substr(1, name.size() - 2) : name;
  set.of_nodes = of_nodes;
  set.scope = block.scope;
  set.instance = block.instance;
  by_key_[key].push_back(&set);
  return set;
}

std::vector<InpSet*> InpSets::find_all(bool of_nodes, std::string_view name,
                                       const InpBlock& where) const {
  const auto look = [&](std::size_t owner, std::string_view text) -> std::vector<InpSet*> {
    const auto found = by_key_.find({of_nodes, owner, inp_key(text)});
    return found == by_key_.end() ? std::vector<InpSet*>() : found->second;
  };
  const bool is_outside = where.is_in_assembly || where.scope == 0;
  if (!is_outside || where.instance != 0) {
    if (auto found = look(where.scope, name); !found.empty()) return found;
  }
  if (auto found = look(kAssembly, name); !found.empty()) return found;
  if (auto found = look(0, name); !found.empty()) return found;
  const std::string_view last = without_instance(name);
  if (last.size() < name.size()) {
    const std::size_t instance =
        lines_.find_instance(name.substr(0, name.size() - last.size() - 1));
    if (instance != 0) return look(lines_.instances[instance - 1].scope, last);
  }
  // Where there is but one part, its names are known outside as well.
  const std::vector<std::size_t>& scopes = lines_.mesh_scopes;
  if (scopes.size() > 1) return {};
  for (const std::string_view text : {name, last}) {
    for (const std::size_t owner : {scopes.empty() ? 0 : scopes[0], kAssembly}) {
      if (auto found = look(owner, text); !found.empty()) return found;
    }
  }
  return {};
}

InpSet* InpSets::of_block(const InpBlock& block) {
  const bool of_nodes = block.keyword == "NODE" || block.keyword == "NSET";
  const std::string_view name = block.value(of_nodes ? "NSET" : "ELSET");
  return name.empty() ? nullptr : &named(of_nodes, block, name);
}

void InpSets::read(const InpBlock& block) {
  InpSet* set = of_block(block);
  if (set == nullptr) {
    block.fail(fmt::format("*{} has no name: expected {}=NAME", block.keyword, block.keyword));
  }
  set->is_listed = true;
  set->is_internal = block.find("INTERNAL") != nullptr;
  set->is_unsorted = set->is_unsorted || block.find("UNSORTED") != nullptr;
  InpFields fields(block);
  if (set->of_nodes && block.find("ELSET") != nullptr) {
    add_nodes_of(block, *set);
  } else if (block.find("GENERATE") != nullptr) {
    while (fields.next_line()) read_range(fields, block, *set);
  } else {
    while (fields.next_line()) read_members(fields, block, *set);
  }
  // Not at each of many blocks of one set.
  if (set->members.size() + set->others.size() < 2 * set->unique) return;
  make_unique(set->members);
  make_unique(set->others);
  set->unique = set->members.size() + set->others.size();
}

void InpSets::read_range(InpFields& fields, const InpBlock& block, InpSet& set) {
  std::int64_t first = fields.integer("the first number of a range");
  std::int64_t last = fields.more() ? fields.integer("the last number of a range") : first;
  const std::int64_t step = fields.more() ? fields.integer("the step of a range") : 1;
  if (step == 0) fields.fail("'0' is no step of a range: expected 1 or more");
  const InpScope& scope = lines_.scopes[block.scope];
  const std::int64_t offset = set.of_nodes ? scope.node_offset : scope.element_offset;
  const std::int64_t most = set.of_nodes ? std::min(scope.most_node, mesh_.nodes.most())
                                         : std::min(scope.most_element, mesh_.most_element());
  if (last < first) {
    fields.fail(
        fmt::format("'{}' is not the last number of a range: expected {} or more", last, first));
  }
  if (last > most) {  // which solvers take
    notes.push_back(
        fmt::format("the range of line {} ends with {}, but the greatest number of {} is {}",
                    fields.line_place(), last, set.of_nodes ? "a node" : "an element", most));
    last = most;
    if (first > most) return;
  }
  if (first == 0) first = step;  // 0 is the last number of the scope before
  add_work(numbers(set).collect(first + offset, last + offset, step, set.members), block);
  if (set.of_nodes) return;
  const auto begin = std::lower_bound(mesh_.others.begin(), mesh_.others.end(), first + offset);
  const auto end = std::upper_bound(begin, mesh_.others.end(), last + offset);
  add_work(static_cast<std::size_t>(end - begin), block);
  std::copy_if(begin, end, std::back_inserter(set.others), [&](std::int64_t number) {
    return (number - offset - first) % step == 0 &&
           mesh_.elements.find(number) == InpNumbers::kNone;
  });
}

/// One of the same scope, and of the same instance if there is one.
const InpSet* InpSets::find_beside(const InpSet& set, bool of_nodes, std::string_view name,
                                   const InpBlock& where) const {
  const InpSet* found = nullptr;
  for (const InpSet* each : find_all(of_nodes, name, where)) {
    if (each->scope != set.scope) continue;
    if (found == nullptr || each->instance == set.instance) found = each;
  }
  return found;
}

void InpSets::read_members(InpFields& fields, const InpBlock& block, InpSet& set) {
  const InpScope& scope = lines_.scopes[block.scope];
  while (fields.more()) {
    const std::string_view text = fields.field();
    if (text.empty()) continue;
    std::int64_t number = 0;
    if (to_integer(text, number)) {
      const std::int64_t of_mesh = set.of_nodes ? scope.node(number) : scope.element(number);
      const std::uint32_t place = numbers(set).find(of_mesh);
      const bool is_other =
          !set.of_nodes && std::binary_search(mesh_.others.begin(), mesh_.others.end(), of_mesh);
      if (place != InpNumbers::kNone) {
        set.members.push_back(place);
      } else if (is_other) {
        set.others.push_back(of_mesh);
      } else {
        fields.fail(fmt::format("'{}' is not the number of {}: expected one of {}", number,
                                set.of_nodes ? "a node" : "an element",
                                set.of_nodes ? "*NODE" : "*ELEMENT"));
      }
      continue;
    }
    const InpSet* other = find_beside(set, set.of_nodes, text, block);
    if (other == nullptr) {
      fields.fail(
          fmt::format("{} is neither a number nor the name of a set: expected one that is "
                      "defined above",
                      in_quotes(text)));
    }
    if (other == &set) continue;
    add_work(other->members.size() + other->others.size(), block);
    set.members.insert(set.members.end(), other->members.begin(), other->members.end());
    set.others.insert(set.others.end(), other->others.begin(), other->others.end());
    if (set.members.size() > 4 * numbers(set).numbers().size()) make_unique(set.members);
    if (set.others.size() > 4 * mesh_.others.size()) make_unique(set.others);
  }
}

void InpSets::add_nodes_of(const InpBlock& block, InpSet& set) {
  const InpSet* elements = find_beside(set, false, block.value("ELSET"), block);
  if (elements == nullptr) {
    block.fail(
        fmt::format("{} is not the name of a set of elements: expected one that is defined "
                    "above",
                    in_quotes(block.value("ELSET"))));
  }
  for (const std::uint32_t element : elements->members) {
    const std::uint32_t* vertices = mesh_.vertices_of(element);
    const std::size_t width = mesh_.block_of(element).type.width;
    add_work(width, block);
    set.members.insert(set.members.end(), vertices, vertices + width);
  }
}

}  // namespace tetmend::formats
