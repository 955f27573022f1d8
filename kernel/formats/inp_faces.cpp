// SPDX-License-Identifier: MIT
// Faces of tets that an Abaqus deck names by element and number.
#include "kernel/formats/inp_faces.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace tetmend::formats {
namespace {

constexpr std::array<std::string_view, 6> kLoads = {"DLOAD",      "DFLUX",     "FILM",
                                                    "FOUNDATION", "MASS FLOW", "RADIATE"};
// Their first field may be the number of an element.
constexpr std::array<std::string_view, 4> kOfElements = {"DISTRIBUTION", "INITIAL CONDITIONS",
                                                         "MODEL CHANGE", "ELEMENT MATRIX OUTPUT"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& names, std::string_view word) {
  return std::find(names.begin(), names.end(), word) != names.end();
}

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

class Reader {
 public:
  Reader(const InpMesh& mesh, InpSets& sets) : mesh_(mesh), sets_(sets) {}

  void read(const InpBlock& block) {
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
  /// The elements of the mesh that a field names; null if it names none.
  const std::vector<std::uint32_t>* elements(std::string_view text, const InpBlock& block,
                                             InpSet*& set) {
    set = nullptr;
    const std::size_t dot = text.rfind('.');
    std::int64_t number = 0;
    if (to_integer(dot == std::string_view::npos ? text : text.substr(dot + 1), number)) {
      const std::uint32_t place = mesh_.elements.find(number);
      if (place == InpNumbers::kNone) return nullptr;
      one_.assign(1, place);
      return &one_;
    }
    set = sets_.find(false, text, block);
    return set == nullptr ? nullptr : &set->members;
  }

  void read_surface(const InpBlock& block) {
    InpFaceUse use{&block, true, {}, {}, {}, {}, {}, 0};
    const auto number = static_cast<std::uint32_t>(result_.uses.size());
    const std::string_view name = block.value("NAME");
    use.name = name.size() > 1 && name.front() == '"' ? name.substr(1, name.size() - 2) : name;
    if (!names_.insert(inp_key(use.name)).second) {
      block.fail(fmt::format("there is a surface {} already", in_quotes(use.name)));
    }
    const std::size_t before = result_.faces.size();
    InpFields fields(block);
    while (fields.next_line()) {
      const std::string_view first = fields.field();
      const std::string_view face = fields.field();
      const FaceLabel label = to_face(face);
      const std::string_view rest = fields.rest();
      const bool is_face = label.face != 0 && inp_key(label.prefix) == "S" && label.suffix.empty();
      if (!is_face || !add_faces(first, block, label.face, number)) {
        note_element(block, fields, is_face ? std::string_view() : first);
        use.more += fmt::format("{}\n", trimmed(fields.line()));
      } else {
        add_other_lines(first, block, face, rest, use.more);
      }
    }
    if (result_.faces.size() > before) result_.uses.push_back(std::move(use));
  }

  void read_load(const InpBlock& block) {
    using Key = std::tuple<std::string, std::string, std::string>;
    std::map<Key, std::uint32_t> use_of;
    std::string rest_of_block;
    const std::size_t before = result_.faces.size();
    InpFields fields(block);
    while (fields.next_line()) {
      const std::string_view first = fields.field();
      const std::string_view face = fields.field();
      const FaceLabel label = to_face(face);
      const std::string_view rest = fields.rest();
      const auto next = static_cast<std::uint32_t>(result_.uses.size());
      const Key key{label.prefix, label.suffix, rest};
      const auto known = use_of.find(key);
      if (label.face == 0 ||
          !add_faces(first, block, label.face, known == use_of.end() ? next : known->second)) {
        note_element(block, fields, first);
        rest_of_block += fmt::format("{}\n", trimmed(fields.line()));
        continue;
      }
      add_other_lines(first, block, face, rest, rest_of_block);
      if (known != use_of.end()) continue;
      use_of[key] = next;
      InpFaceUse use{&block,           false, {}, std::get<0>(key), std::get<1>(key),
                     std::get<2>(key), {},    0};
      use.name = fmt::format("{}_{}", block.keyword, next + 1);
      result_.uses.push_back(std::move(use));
    }
    if (result_.faces.size() > before) result_.rest_of_load[&block] = std::move(rest_of_block);
  }

  /// False if there is no tet among the elements.
  bool add_faces(std::string_view text, const InpBlock& block, std::size_t face,
                 std::uint32_t use) {
    InpSet* set = nullptr;
    const auto* found = elements(text, block, set);
    bool any = false;
    if (found == nullptr) return any;
    if (set != nullptr) sets_.add_work(found->size() + set->others.size(), block);
    for (const std::uint32_t element : *found) {
      if (!is_tet(mesh_, element)) continue;
      const std::uint32_t* v = mesh_.vertices_of(element);
      const auto& corners = kInpTetFaces[face - 1];
      result_.faces.push_back({{v[corners[0]], v[corners[2]], v[corners[1]]}, use});
      any = true;
    }
    if (any && set != nullptr) result_.sets.insert(set);
    return any;
  }

  /// What a line says of elements that are no tets is said element by element.
  void add_other_lines(std::string_view text, const InpBlock& block, std::string_view face,
                       std::string_view rest, std::string& lines) {
    InpSet* set = nullptr;
    const auto* found = elements(text, block, set);
    if (set == nullptr) return;
    for (const std::uint32_t element : *found) {
      if (is_tet(mesh_, element)) continue;
      lines += fmt::format("{}, {}{}\n", mesh_.elements.numbers()[element], face, rest);
    }
    for (const std::int64_t number : set->others) {
      lines += fmt::format("{}, {}{}\n", number, face, rest);
    }
  }

  void note_element(const InpBlock& block, const InpFields& fields, std::string_view text) {
    std::int64_t number = 0;
    if (!to_integer(text, number)) return;
    const std::uint32_t place = mesh_.elements.find(number);
    if (place == InpNumbers::kNone || !is_tet(mesh_, place)) return;
    if (result_.notes.size() > kMostNotes) return;
    result_.notes.push_back(
        fmt::format("line {} of *{} names the tet {}: an improved mesh may not have it",
                    block.file->line_place(fields.line().data()), block.keyword, number));
  }

  static constexpr std::size_t kMostNotes = 20;
  const InpMesh& mesh_;
  InpSets& sets_;
  InpFaces result_;
  std::vector<std::uint32_t> one_;
  std::set<std::string> names_;  // of surfaces
};

}  // namespace

InpFaces read_inp_faces(const InpLines& lines, const InpMesh& mesh, InpSets& sets) {
  Reader reader(mesh, sets);
  for (const InpBlock& block : lines.blocks) reader.read(block);
  return reader.take();
}

}  // namespace tetmend::formats
