// SPDX-License-Identifier: MIT
// Faces of tets that an Abaqus deck names by element and number.
#include "kernel/formats/inp_faces.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "kernel/formats/harmless_notes.h"
#include "kernel/formats/inp_fields.h"
#include "kernel/formats/word_list.h"

namespace tetmend::formats {
namespace {

constexpr std::array<std::string_view, 6> kLoads = {"DLOAD",      "DFLUX",     "FILM",
                                                    "FOUNDATION", "MASS FLOW", "RADIATE"};
// Their first field may be the number of an element.
constexpr std::array<std::string_view, 4> kOfElements = {"DISTRIBUTION", "INITIAL CONDITIONS",
                                                         "MODEL CHANGE", "ELEMENT MATRIX OUTPUT"};

bool is_tet(const InpMesh& mesh, std::uint32_t element) {
  const int type = mesh.block_of(element).type.vtk_type;
  return type == kVtkTet || type == kVtkTet10;
}

/// "P3NU" is the face 3 (from 1) with "P" before and "NU" behind; 0: it is no face of a tet.
struct FaceLabel {
  std::string_view prefix;
  std::size_t face = 0;
  std::string_view suffix;
};
FaceLabel to_face(std::string_view text) {
  const std::size_t digit = text.find_first_of("0123456789");
  if (digit == std::string_view::npos || digit == 0 || text[digit] < '1' || text[digit] > '4') {
    return {};
  }
  const std::string_view suffix = text.substr(digit + 1);
  if (!suffix.empty() && std::isdigit(static_cast<unsigned char>(suffix[0])) != 0) return {};
  return {text.substr(0, digit), static_cast<std::size_t>(text[digit] - '0'), suffix};
}

class InpFacesReader {
 public:
  InpFacesReader(const InpLines& lines, const InpMesh& mesh, InpSets& sets)
      : lines_(lines), mesh_(mesh), sets_(sets) {
    find_other_instances();
  }

  void read(const InpBlock& block) {
    if (!block.is_of_mesh) return;
    if (block.keyword == "SURFACE") {
      const std::string type = inp_key(block.value("TYPE"));
      if (type.empty() || type == "ELEMENT") read_surface(block);
    } else if (contains(kLoads, block.keyword)) {
      read_load(block);
    } else if (contains(kOfElements, block.keyword)) {
      InpFields fields(block);
      while (fields.next_line()) note_element(block, fields, fields.field());
    }
  }

  InpFaces take() { return std::move(result_); }

 private:
  /// Elements of the mesh that a field names.
  struct Named {
    std::size_t scope = 0;
    std::size_t instance = 0;  // from 1; 0: none is named
    InpSet* set = nullptr;     // null: one element
    std::uint32_t one = 0;

    std::span<const std::uint32_t> elements() const {
      return set == nullptr ? std::span(&one, 1) : std::span<const std::uint32_t>(set->members);
    }
  };

  std::vector<Named> find_elements(std::string_view text, const InpBlock& block) {
    const std::size_t dot = text.rfind('.');
    const bool has_prefix = dot != std::string_view::npos;
    std::int64_t number = 0;
    if (to_integer(has_prefix ? text.substr(dot + 1) : text, number)) {
      Named named{block.scope, block.instance, nullptr, 0};
      if (has_prefix) named.instance = lines_.find_instance(text.substr(0, dot));
      if (named.instance != 0) {
        named.scope = lines_.instances[named.instance - 1].scope;
      } else if (named.scope == 0 && lines_.mesh_scopes.size() == 1) {
        named.scope = lines_.mesh_scopes[0];
      }
      if (!lines_.scopes[named.scope].is_mesh) return {};
      const std::uint32_t place = mesh_.elements.find(lines_.scopes[named.scope].element(number));
      if (place == InpNumbers::kNone) return {};
      named.one = place;
      return {std::move(named)};
    }
    std::vector<Named> found;
    for (InpSet* set : sets_.find_all(false, text, block)) {
      found.push_back({set->scope, instance_of(*set, text, block), set, 0});
    }
    return found;
  }

  /// That lines of an assembly, or behind it, name a set by.
  std::size_t instance_of(const InpSet& set, std::string_view text, const InpBlock& block) const {
    if (set.instance != 0) return set.instance;
    if (block.scope != 0 && !block.is_in_assembly) return 0;
    const std::size_t dot = text.rfind('.');
    return dot == std::string_view::npos ? 0 : lines_.find_instance(text.substr(0, dot));
  }

  /// Within a part, numbers are its own.
  std::string prefix_of(std::size_t instance, const InpBlock& block) const {
    const bool is_inside = block.scope != 0 && !block.is_in_assembly;
    return instance == 0 || is_inside ? "" : lines_.instances[instance - 1].name + ".";
  }

  void read_surface(const InpBlock& block) {
    const std::size_t first_use = result_.uses.size();
    const std::string_view given = block.value("NAME");
    const std::string name(
        given.size() > 1 && given.front() == '"' ? given.substr(1, given.size() - 2) : given);
    const std::size_t owner = block.is_in_assembly ? 0 : block.scope;
    if (!names_.emplace(owner, inp_key(name)).second) {
      block.fail(fmt::format("there is a surface {} already", in_quotes(name)));
    }
    std::map<std::string, std::uint32_t> use_of;  // by the prefix of its instance
    std::string more;
    InpFields fields(block);
    while (fields.next_line()) {
      const std::string_view first = fields.field();
      const std::string_view face = fields.field();
      const FaceLabel label = to_face(face);
      const std::string_view rest = fields.rest();
      const bool is_face = label.face != 0 && inp_key(label.prefix) == "S" && label.suffix.empty();
      bool any = false;
      for (const Named& named : is_face ? find_elements(first, block) : std::vector<Named>()) {
        const std::string prefix = prefix_of(named.instance, block);
        const auto next = static_cast<std::uint32_t>(result_.uses.size());
        const auto known = use_of.find(prefix);
        const std::uint32_t use = known == use_of.end() ? next : known->second;
        if (!add_faces(named, block, label.face, use)) continue;
        any = true;
        add_other_lines(named, block, face, rest, more);
        if (known != use_of.end()) continue;
        use_of[prefix] = next;
        InpFaceUse made;
        made.block = &block;
        made.is_surface = true;
        made.goes_on = next > first_use;
        made.scope = named.scope;
        made.instance = prefix;
        made.prefix = std::string("S");
        made.name = made.goes_on ? name + "_" + prefix.substr(0, prefix.size() - 1) : name;
        result_.uses.push_back(std::move(made));
      }
      if (any) {
        add_other_instances(first, block, face, rest, more);
        continue;
      }
      note_element(block, fields, is_face ? std::string_view() : first);
      more += fmt::format("{}\n", trimmed(fields.line()));
    }
    if (result_.uses.size() > first_use) result_.uses.back().more = std::move(more);
  }

  void read_load(const InpBlock& block) {
    using Key = std::tuple<std::string, std::string, std::string, std::string>;
    std::map<Key, std::uint32_t> use_of;
    std::string rest_of_block;
    const std::size_t before = result_.faces.size();
    InpFields fields(block);
    while (fields.next_line()) {
      const std::string_view first = fields.field();
      const std::string_view face = fields.field();
      const FaceLabel label = to_face(face);
      const std::string_view rest = fields.rest();
      bool any = false;
      for (const Named& named :
           label.face != 0 ? find_elements(first, block) : std::vector<Named>()) {
        const std::string prefix = prefix_of(named.instance, block);
        const auto next = static_cast<std::uint32_t>(result_.uses.size());
        const Key key{label.prefix, label.suffix, rest, prefix};
        const auto known = use_of.find(key);
        const std::uint32_t use = known == use_of.end() ? next : known->second;
        if (!add_faces(named, block, label.face, use)) continue;
        any = true;
        add_other_lines(named, block, face, rest, rest_of_block);
        if (known != use_of.end()) continue;
        use_of[key] = next;
        InpFaceUse made;
        made.block = &block;
        made.scope = named.scope;
        made.instance = prefix;
        made.name = fmt::format("{}_{}", block.keyword, next + 1);
        made.prefix = label.prefix;
        made.suffix = label.suffix;
        made.rest = rest;
        result_.uses.push_back(std::move(made));
      }
      if (any) {
        add_other_instances(first, block, face, rest, rest_of_block);
        continue;
      }
      note_element(block, fields, first);
      rest_of_block += fmt::format("{}\n", trimmed(fields.line()));
    }
    if (result_.faces.size() > before) result_.rest_of_load[&block] = std::move(rest_of_block);
  }

  /// False if there is no tet among the elements.
  bool add_faces(const Named& named, const InpBlock& block, std::size_t face, std::uint32_t use) {
    if (named.set != nullptr) {
      sets_.add_work(named.set->members.size() + named.set->others.size(), block);
    }
    bool any = false;
    for (const std::uint32_t element : named.elements()) {
      if (!is_tet(mesh_, element)) continue;
      const std::uint32_t* v = mesh_.vertices_of(element);
      const auto& corners = kInpTetFaces[face - 1];
      result_.faces.push_back({{v[corners[0]], v[corners[2]], v[corners[1]]}, use});
      any = true;
    }
    if (any && named.set != nullptr) result_.sets.insert(named.set);
    return any;
  }

  /// What a line says of elements that are no tets is said element by element.
  void add_other_lines(const Named& named, const InpBlock& block, std::string_view face,
                       std::string_view rest, std::string& lines) {
    if (named.set == nullptr) return;
    const std::string prefix = prefix_of(named.instance, block);
    const std::int64_t offset = lines_.scopes[named.scope].element_offset;
    const auto add = [&](std::int64_t number) {
      lines += fmt::format("{}{}, {}{}\n", prefix, number - offset, face, rest);
    };
    for (const std::uint32_t element : named.set->members) {
      if (!is_tet(mesh_, element)) add(mesh_.elements.numbers()[element]);
    }
    for (const std::int64_t number : named.set->others) add(number);
  }

  /// A set of an assembly may have elements of instances that are not in the mesh, too.
  void add_other_instances(std::string_view text, const InpBlock& block, std::string_view face,
                           std::string_view rest, std::string& lines) {
    if (others_of_set_.empty() || (block.scope != 0 && !block.is_in_assembly)) return;
    const auto others = others_of_set_.find(inp_key(text));
    if (others == others_of_set_.end()) return;
    for (const std::string& each : others->second) {
      lines += fmt::format("{}, {}{}\n", each, face, rest);
    }
  }

  /// By the name of the set: "Shell-1.17", or "Shell-1.Set-1".
  void find_other_instances() {
    for (const InpBlock& block : lines_.blocks) {
      if (block.keyword != "ELSET" || block.instance == 0 || block.is_of_mesh) continue;
      const std::string prefix = lines_.instances[block.instance - 1].name + ".";
      std::vector<std::string>& others = others_of_set_[inp_key(block.value("ELSET"))];
      InpFields fields(block);
      while (fields.next_line()) {
        if (block.find("GENERATE") == nullptr) {
          while (fields.more()) others.push_back(prefix + std::string(fields.field()));
          continue;
        }
        const std::int64_t first = fields.integer("the first number of a range");
        const std::int64_t last = fields.more() ? fields.integer("the last number") : first;
        const std::int64_t step =
            std::max<std::int64_t>(1, fields.more() ? fields.integer("the step of a range") : 1);
        if (last < first) continue;
        sets_.add_work(static_cast<std::size_t>((last - first) / step + 1), block);
        for (std::int64_t number = first; number <= last; number += step) {
          others.push_back(fmt::format("{}{}", prefix, number));
        }
      }
      std::erase(others, prefix);
    }
  }

  void note_element(const InpBlock& block, const InpFields& fields, std::string_view text) {
    std::int64_t number = 0;
    if (!to_integer(text, number)) return;
    if (block.scope == 0 && lines_.mesh_scopes.size() > 1) return;
    const std::uint32_t place = mesh_.elements.find(lines_.scopes[block.scope].element(number));
    if (place == InpNumbers::kNone || !is_tet(mesh_, place)) return;
    if (result_.notes.size() > kMostNotes) return;
    result_.notes.push_back(fmt::format("line {} of *{} names the tet {}: {}",
                                        block.file->line_place(fields.line().data()), block.keyword,
                                        number, kMayBeGone));
  }

  static constexpr std::size_t kMostNotes = 20;
  const InpLines& lines_;
  const InpMesh& mesh_;
  InpSets& sets_;
  InpFaces result_;
  std::set<std::pair<std::size_t, std::string>> names_;            // of surfaces, by scope
  std::map<std::string, std::vector<std::string>> others_of_set_;  // by its name
};

}  // namespace

InpFaces read_inp_faces(const InpLines& lines, const InpMesh& mesh, InpSets& sets) {
  InpFacesReader reader(lines, mesh, sets);
  for (const InpBlock& block : lines.blocks) reader.read(block);
  return reader.take();
}

}  // namespace tetmend::formats
