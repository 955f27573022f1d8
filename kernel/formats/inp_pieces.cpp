// SPDX-License-Identifier: MIT
// From the blocks of an Abaqus deck to the pieces of MeshData::deck.
#include "kernel/formats/inp_pieces.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "kernel/formats/inp_deck.h"

namespace tetmend::formats {
namespace {

bool is_mesh_element(const InpBlock& block) {
  return is_mesh_block(block, "ELEMENT") &&
         inp_type(block.value("TYPE")).kind == InpType::Kind::mesh;
}

class Maker {
 public:
  explicit Maker(const InpContent& content) : in_(content) {
    for (const InpFaceUse& use : in_.faces.uses) uses_of_[use.block].push_back(&use);
    for (std::size_t b = 0; b < in_.mesh.blocks.size(); ++b) {
      number_of_block_[in_.mesh.blocks[b].block] = b;
    }
  }

  std::vector<std::string> run() {
    find_inlined();
    add_numberings();
    deck_.remarks = in_.remarks;
    for (std::size_t p = 0; p < in_.parts.all.size(); ++p) {
      deck_.block_of_part.emplace_back(static_cast<Label>(p + 1),
                                       static_cast<Label>(in_.parts.all[p].home));
    }
    for (const InpBlock& block : in_.lines.blocks) add_block(block);
    return pack_deck(deck_);
  }

 private:
  bool is_use(const InpBlock& block) const { return uses_of_.contains(&block); }

  void add_numberings() {
    const std::vector<std::size_t>& scopes = in_.lines.mesh_scopes;
    deck_.numberings.clear();
    numbering_of_.assign(in_.lines.scopes.size(), 0);
    for (const std::size_t s : scopes) {
      const InpScope& scope = in_.lines.scopes[s];
      numbering_of_[s] = deck_.numberings.size();
      deck_.numberings.push_back(
          {scope.node_offset, scope.element_offset, scope.most_node, scope.most_element});
    }
    if (scopes.size() < 2) {
      deck_.numberings = {{0, 0, in_.mesh.nodes.most(), in_.mesh.most_element()}};
    }
  }

  /// Files with something of the mesh in them are written into the deck.
  void find_inlined() {
    inlined_.assign(in_.lines.includes.size(), false);
    inlined_[0] = true;
    for (const InpBlock& block : in_.lines.blocks) {
      if (!is_listed_anew(block) && !is_use(block)) continue;
      for (int k = block.file_number; k != 0;
           k = in_.lines.includes[static_cast<std::size_t>(k)].parent) {
        inlined_[static_cast<std::size_t>(k)] = true;
      }
    }
    for (std::size_t k = 1; k < inlined_.size(); ++k) {
      const InpLines::Include& include = in_.lines.includes[k];
      const auto parent = static_cast<std::size_t>(include.parent);
      if (!inlined_[parent]) inlined_[k] = false;
      if (inlined_[parent] && !include.parent_is_beside) inlined_[k] = true;
    }
  }

  void add_block(const InpBlock& block) {
    if (!inlined_[static_cast<std::size_t>(block.file_number)]) return;
    if (block.included != 0) {
      if (inlined_[static_cast<std::size_t>(block.included)]) return;
      deck_.folder = std::filesystem::absolute(in_.file).parent_path().lexically_normal().string();
      return add_text(block.text());
    }
    if (is_mesh_block(block, "NODE")) {
      add_nodes(block);
    } else if (is_mesh_element(block)) {
      add_element_block(block);
    } else if (is_set_block(block)) {
      add_set(block);
    } else if (is_use(block)) {
      add_uses(block);
    } else {
      add_text(block.text());
    }
  }

  void add_text(std::string_view text) {
    if (text.empty()) return;
    const bool cut = text.back() != '\n';
    if (deck_.pieces.empty() || deck_.pieces.back().kind != InpPieceKind::verbatim) {
      deck_.pieces.push_back({});
    }
    deck_.pieces.back().text += text;
    if (cut && &in_.lines.blocks.back().text().back() != &text.back())
      deck_.pieces.back().text += '\n';
  }

  static bool is_comment(std::string_view line) {
    const std::string_view content = trimmed(line);
    return content.empty() || content.starts_with("**");
  }

  /// Comments and empty lines among the data: those before the first of it, or the others. Where
  /// there is no data, all are others, so that they stay behind the line of the keyword.
  void add_comments(const InpBlock& block, bool leading) {
    const std::string_view data(block.data, static_cast<std::size_t>(block.end - block.data));
    bool before = has_data(data);
    for_each_line(data, [&](std::string_view line) {
      const bool is_text = is_comment(line);
      before = before && is_text;
      if (is_text && before == leading) add_text(line);
    });
  }

  /// Those within the line of a keyword, which is written anew.
  void add_comments_of_keyword(const InpBlock& block) {
    for_each_line(block.keyword_text(), [&](std::string_view line) {
      if (trimmed(line).starts_with("**")) add_text(line);
    });
  }

  static bool has_data(std::string_view lines) {
    bool found = false;
    for_each_line(lines, [&](std::string_view line) { found = found || !is_comment(line); });
    return found;
  }

  template <class Function>
  static void for_each_line(std::string_view rest, Function&& visit) {
    while (!rest.empty()) {
      const std::size_t length = std::min(rest.find('\n'), rest.size() - 1) + 1;
      visit(rest.substr(0, length));
      rest.remove_prefix(length);
    }
  }

  static std::string keyword_line(const InpBlock& block, const std::set<std::string>& without) {
    const std::string_view text = trimmed(block.keyword_text());
    std::string line(trimmed(text.substr(0, std::min(text.find(','), text.size()))));
    for (const InpBlock::Parameter& parameter : block.parameters) {
      if (!without.contains(parameter.name)) line += fmt::format(", {}", parameter.text);
    }
    return ended(line);
  }

  /// A line of a keyword that data may follow: after a comma they would be read as its parameters.
  static std::string ended(std::string_view line) {
    while (!line.empty() && (line.back() == ',' || trimmed(line.substr(line.size() - 1)).empty())) {
      line.remove_suffix(1);
    }
    return std::string(line) + '\n';
  }

  /// Byte for byte, but where data could not follow.
  static std::string as_it_stands(const InpBlock& block) {
    const std::string_view text = block.keyword_text();
    return text.ends_with('\n') && !trimmed(text).ends_with(',') ? std::string(text) : ended(text);
  }

  InpPiece& add_piece(InpPieceKind kind, std::size_t scope, std::string text) {
    InpPiece& piece = deck_.pieces.emplace_back();
    piece.kind = kind;
    piece.numbering = numbering_of_[scope];
    piece.text = std::move(text);
    return piece;
  }

  void add_nodes(const InpBlock& block) {
    const InpSet* set = in_.sets.of_block(block);
    add_comments_of_keyword(block);
    if (nodes_done_.insert(block.scope).second) {
      InpPiece& piece =
          add_piece(InpPieceKind::nodes, block.scope, keyword_line(block, {"INPUT", "NSET"}));
      add_more_of_nodes(block, piece.more);
      if (set != nullptr && set_done_.insert(set).second) piece.groups = set->groups;
    } else if (set != nullptr && set_done_.insert(set).second) {
      add_piece(InpPieceKind::node_set, block.scope,
                fmt::format("*NSET, NSET={}\n", block.value("NSET")))
          .groups = set->groups;
    }
    add_comments(block, true);
    add_comments(block, false);
  }

  /// Of all nodes of this scope: "7, 0., 0., 1.".
  void add_more_of_nodes(const InpBlock& block, std::string& lines) {
    const InpScope& own = in_.lines.scopes[block.scope];
    const auto& all = in_.mesh.more_of_node;
    const auto end = all.upper_bound(own.node_offset + own.most_node);
    for (auto at = all.upper_bound(own.node_offset); at != end; ++at) {
      lines += fmt::format("{}{}\n", at->first - own.node_offset, at->second);
    }
  }

  void add_element_block(const InpBlock& block) {
    const bool is_cut_away =
        block.input == nullptr &&
        !has_data({block.data, static_cast<std::size_t>(block.end - block.data)});
    if (is_cut_away) return add_text(block.text());  // its part would no longer count as the mesh
    const std::size_t number = number_of_block_[&block];
    const std::uint32_t home = in_.home_of_block[number];
    const bool as_is = block.input == nullptr;
    const bool is_new = home_done_.insert(home).second;
    if (!is_new || !as_is) add_comments_of_keyword(block);
    add_comments(block, true);
    if (is_new) {
      InpPiece& piece = add_piece(InpPieceKind::elements, block.scope,
                                  as_is ? as_it_stands(block) : keyword_line(block, {"INPUT"}));
      piece.type = in_.mesh.blocks[number].name;
      piece.block = static_cast<Label>(home);
      const InpSet* set = in_.homes[home - 1].set;
      if (set != nullptr) piece.groups = set->groups;
    }
    add_comments(block, false);
  }

  void add_set(const InpBlock& block) {
    const InpSet* set = in_.sets.of_block(block);
    if (block.find("UNSORTED") != nullptr && block.input == nullptr) {
      return add_unsorted(block, *set);
    }
    add_comments_of_keyword(block);
    add_comments(block, true);
    if (set->is_kept && set_done_.insert(set).second) {
      const auto kind = set->of_nodes ? InpPieceKind::node_set : InpPieceKind::element_set;
      std::set<std::string> without = {"GENERATE", "INPUT", "UNSORTED"};
      if (set->of_nodes) without.insert("ELSET");
      InpPiece& piece = add_piece(kind, set->scope, keyword_line(block, without));
      piece.groups = set->groups;
      const std::int64_t offset = in_.lines.scopes[set->scope].element_offset;
      for (const std::int64_t number : set->others) {
        piece.more += fmt::format("{},\n", number - offset);
      }
    }
    add_comments(block, false);
  }

  /// Nodes whose order matters: the lines as they are.
  void add_unsorted(const InpBlock& block, const InpSet& set) {
    InpPiece& piece = add_piece(InpPieceKind::node_set, set.scope, as_it_stands(block));
    piece.type = kInpUnsorted;
    piece.more = std::string(block.data, block.end);
    if (set_done_.insert(&set).second) piece.groups = set.groups;
  }

  void add_uses(const InpBlock& block) {
    add_comments(block, true);
    const auto load = in_.faces.rest_of_load.find(&block);
    if (load != in_.faces.rest_of_load.end()) {
      add_text(block.keyword_text());
      add_text(load->second);
    }
    for (const InpFaceUse* use : uses_of_[&block]) {
      const bool begins = use->is_surface && !use->goes_on;
      InpPiece& piece = begins ? add_piece(InpPieceKind::surface, use->scope, as_it_stands(block))
                               : add_piece(InpPieceKind::face_load, use->scope, use->rest);
      piece.instance = use->instance;
      piece.groups = {{2, use->number}};
      piece.type = use->prefix;
      piece.suffix = use->suffix;
      piece.more = use->more;
    }
    add_comments(block, false);
  }

  const InpContent& in_;
  InpDeck deck_;
  std::map<const InpBlock*, std::vector<const InpFaceUse*>> uses_of_;
  std::map<const InpBlock*, std::size_t> number_of_block_;
  std::vector<bool> inlined_;
  std::set<std::size_t> nodes_done_;       // scopes
  std::vector<std::size_t> numbering_of_;  // each scope
  std::set<const InpSet*> set_done_;
  std::set<std::uint32_t> home_done_;
};

}  // namespace

bool is_listed_anew(const InpBlock& block) {
  return is_mesh_block(block, "NODE") || is_mesh_element(block) || is_set_block(block);
}

std::vector<std::string> make_inp_deck(const InpContent& content) {
  return Maker(content).run();
}

}  // namespace tetmend::formats
