// SPDX-License-Identifier: MIT
// What the lines of an Abaqus deck that are kept word for word say of its mesh.
#include "kernel/formats/inp_references.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "kernel/formats/field_pattern.h"
#include "kernel/formats/pin_remarks.h"
#include "kernel/grouping.h"

namespace tetmend::formats {
namespace {

// What Abaqus and CalculiX have about nodes; the fields count within each data line.
struct KeywordRow {
  std::string_view keyword;
  std::string_view pattern;
};
constexpr std::array kWithNodes = std::to_array<KeywordRow>({
    {"BOUNDARY", "p"},
    {"CECHARGE", "p"},
    {"CECURRENT", "p"},
    {"CFILM", "p"},
    {"CFLOW", "p"},
    {"CFLUX", "p"},
    {"CLOAD", "p"},
    {"CONCENTRATION FLUX", "p"},
    {"CRADIATE", "p"},
    {"DISPLAY BODY", "(p)"},
    {"DISTRIBUTING COUPLING", "p"},
    {"ELEMENT", "-(p)"},
    {"FIELD", "p"},
    {"INCIDENT WAVE INTERACTION", "-pp"},
    {"KINEMATIC COUPLING", "p"},
    {"MASS FLOW RATE", "p"},
    {"MPC", "(p)"},
    {"NETWORK MPC", "(p--)"},
    {"NODAL THICKNESS", "p"},
    {"NORMAL", "-p"},
    {"NSET", "(p)"},
    {"PRESSURE STRESS", "p"},
    {"RETAINED NODAL DOFS", "p"},
    {"SECONDARY BASE", "p"},
    {"SLIDE LINE", "(p)"},
    {"SUBMODEL", "(p)"},
    {"TEMPERATURE", "p"},
    {"VELOCITY", "p"},
});

// Their data lines hold none, only numbers of elements, of steps and degrees of freedom, values and
// names.
constexpr std::array kWithoutNodes =
    std::to_array<std::string_view>({"ADAPTIVE MESH",
                                     "AMPLITUDE",
                                     "ASSEMBLY",
                                     "BASE MOTION",
                                     "BEAM GENERAL SECTION",
                                     "BUCKLE",
                                     "CHANGE FRICTION",
                                     "CHANGE MATERIAL",
                                     "CHANGE PLASTIC",
                                     "CHANGE SURFACE BEHAVIOR",
                                     "CLEARANCE",
                                     "COMPLEX FREQUENCY",
                                     "CONDUCTIVITY",
                                     "CONNECTOR BEHAVIOR",
                                     "CONNECTOR DAMPING",
                                     "CONNECTOR ELASTICITY",
                                     "CONNECTOR LOAD",
                                     "CONNECTOR MOTION",
                                     "CONSTRAINT",
                                     "CONTACT",
                                     "CONTACT DAMPING",
                                     "CONTACT INCLUSIONS",
                                     "CONTACT EXCLUSIONS",
                                     "CONTACT PAIR",
                                     "CONTACT PROPERTY ASSIGNMENT",
                                     "COUPLED TEMPERATURE-DISPLACEMENT",
                                     "COUPLING",
                                     "CREEP",
                                     "CYCLIC HARDENING",
                                     "CYCLIC SYMMETRY MODEL",
                                     "DAMAGE EVOLUTION",
                                     "DAMAGE INITIATION",
                                     "DAMPING",
                                     "DASHPOT",
                                     "DECHARGE",
                                     "DECURRENT",
                                     "DEFORMATION PLASTICITY",
                                     "DENSITY",
                                     "DEPVAR",
                                     "DESIGN RESPONSE",
                                     "DESIGN VARIABLES",
                                     "DFLOW",
                                     "DFLUX",
                                     "DIELECTRIC",
                                     "DIFFUSIVITY",
                                     "DISTRIBUTING",
                                     "DISTRIBUTION TABLE",
                                     "DLOAD",
                                     "DRUCKER PRAGER",
                                     "DSFLOW",
                                     "DSFLUX",
                                     "DSLOAD",
                                     "DYNAMIC",
                                     "ELASTIC",
                                     "ELECTRICAL CONDUCTIVITY",
                                     "ELECTROMAGNETICS",
                                     "ELSET",
                                     "EMBEDDED ELEMENT",
                                     "END ASSEMBLY",
                                     "END INSTANCE",
                                     "END PART",
                                     "END STEP",
                                     "ELEMENT PROPERTIES",
                                     "EXPANSION",
                                     "FILM",
                                     "FILM PROPERTY",
                                     "FILTER",
                                     "FLUID BEHAVIOR",
                                     "FLUID CAVITY",
                                     "FLUID CONSTANTS",
                                     "FLUID DENSITY",
                                     "FOUNDATION",
                                     "FREQUENCY",
                                     "FRICTION",
                                     "GAP",
                                     "GAP CONDUCTANCE",
                                     "GAP ELECTRICAL CONDUCTANCE",
                                     "GAP HEAT GENERATION",
                                     "GAP RADIATION",
                                     "GEOMETRIC CONSTRAINT",
                                     "GREEN",
                                     "HEADING",
                                     "HEAT GENERATION",
                                     "HEAT TRANSFER",
                                     "HYPERELASTIC",
                                     "HYPERFOAM",
                                     "INELASTIC HEAT FRACTION",
                                     "INSTANCE",
                                     "KINEMATIC",
                                     "LATENT HEAT",
                                     "MAGNETIC PERMEABILITY",
                                     "MASS",
                                     "MASS FLOW",
                                     "MATERIAL",
                                     "MODAL DAMPING",
                                     "MODAL DYNAMIC",
                                     "MODEL CHANGE",
                                     "MODEL DEFINITION",
                                     "MOHR COULOMB",
                                     "MONITOR",
                                     "NO ANALYSIS",
                                     "NODE",
                                     "OBJECTIVE",
                                     "PARAMETER",
                                     "PART",
                                     "PERMEABILITY",
                                     "PHYSICAL CONSTANTS",
                                     "PIEZOELECTRIC",
                                     "PLASTIC",
                                     "POROUS BULK MODULI",
                                     "PREPRINT",
                                     "RADIATE",
                                     "RATE DEPENDENT",
                                     "REFINE MESH",
                                     "RELEASE",
                                     "RESTART",
                                     "RIGID BODY",
                                     "ROBUST DESIGN",
                                     "ROTARY INERTIA",
                                     "SECTION CONTROLS",
                                     "SELECT CYCLIC SYMMETRY MODES",
                                     "SENSITIVITY",
                                     "SFILM",
                                     "SHELL TO SOLID COUPLING",
                                     "SOILS",
                                     "SOLUTION TECHNIQUE",
                                     "SPECIFIC GAS CONSTANT",
                                     "SPECIFIC HEAT",
                                     "SPRING",
                                     "SRADIATE",
                                     "STATIC",
                                     "STEADY STATE DYNAMICS",
                                     "STEP",
                                     "SURFACE BEHAVIOR",
                                     "SURFACE INTERACTION",
                                     "TIE",
                                     "TIME POINTS",
                                     "TRANSFORM",
                                     "TRANSFORMF",
                                     "UNCOUPLED TEMPERATURE-DISPLACEMENT",
                                     "USER ELEMENT",
                                     "USER MATERIAL",
                                     "VALUES AT INFINITY",
                                     "VIEWFACTOR",
                                     "VISCO",
                                     "VISCOELASTIC",
                                     "VISCOUS"});
// These end their keywords.
constexpr std::array kEndingsWithoutNodes =
    std::to_array<std::string_view>({"SECTION", "OUTPUT", "PRINT", "FILE", "CONTROLS", "FORMAT"});
// What these say is of elements.
constexpr std::array kConditionsOfElements = std::to_array<std::string_view>(
    {"DAMAGE INITIATION", "HARDENING", "INITIAL GAP", "PLASTIC STRAIN", "REF COORDINATE",
     "RELATIVE DENSITY", "SOLUTION", "SPECIFIC ENERGY", "STRESS", "VOLUME FRACTION"});

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& names, std::string_view word) {
  return std::find(names.begin(), names.end(), word) != names.end();
}

/// What the data lines of a block say of nodes.
struct NodesOfBlock {
  FieldPattern pattern{""};
  bool is_known = true;  // false: all that could be nodes counts
  bool first_line_only = false;
};

/// Keywords of which a parameter decides.
std::optional<NodesOfBlock> by_parameter(const InpBlock& block) {
  const auto is = [&](std::string_view parameter, std::string_view value) {
    return inp_key(block.value(parameter)) == value;
  };
  const auto only_if = [](bool condition, std::string_view pattern) {
    return NodesOfBlock{FieldPattern(condition ? pattern : "")};
  };
  if (block.keyword == "SURFACE") return only_if(is("TYPE", "NODE"), "p");
  if (block.keyword == "DISTRIBUTION") return only_if(is("LOCATION", "NODE"), "p");
  if (block.keyword == "IMPERFECTION") return only_if(block.find("FILE") == nullptr, "p");
  if (block.keyword == "INITIAL CONDITIONS") {
    return only_if(!contains(kConditionsOfElements, inp_key(block.value("TYPE"))), "p");
  }
  if (block.keyword == "ORIENTATION") {
    NodesOfBlock nodes = only_if(is("DEFINITION", "NODES"), "(p)");
    nodes.first_line_only = true;
    return nodes;
  }
  return {};
}

NodesOfBlock nodes_of(const InpBlock& block) {
  if (const auto nodes = by_parameter(block)) return *nodes;
  const auto* row = std::find_if(kWithNodes.begin(), kWithNodes.end(), [&](const KeywordRow& each) {
    return each.keyword == block.keyword;
  });
  if (row != kWithNodes.end()) return {FieldPattern(row->pattern)};
  const bool ends = std::any_of(kEndingsWithoutNodes.begin(), kEndingsWithoutNodes.end(),
                                [&](std::string_view end) { return block.keyword.ends_with(end); });
  if (ends || contains(kWithoutNodes, block.keyword)) return {};
  return {FieldPattern("(p)"), false};
}

class Finder {
 public:
  Finder(const InpLines& lines, const InpMesh& mesh) : lines_(lines), mesh_(mesh) {}

  void look_at(const InpBlock& block) {
    block_ = &block;
    find_scopes(block.scope, block.is_of_mesh);
    for (const InpBlock::Parameter& parameter : block.parameters) {
      const bool names_node = parameter.name.find("NODE") != std::string::npos;
      look_at(parameter.value, names_node);
    }
    if (block.keyword.empty() || block.keyword == "HEADING" || block.keyword == "INCLUDE") return;
    if (block.keyword == "EQUATION") return look_at_equations(block);
    const NodesOfBlock nodes = nodes_of(block);
    // In an assembly, plain numbers in these are of its own nodes.
    needs_instance_ =
        block.is_in_assembly && (block.keyword == "ELEMENT" || block.keyword == "NSET");
    InpFields fields(block);
    bool goes_on = false;  // an element, behind a comma
    for (bool is_first = true; fields.next_line(); is_first = false) {
      const bool has_nodes = is_first || !nodes.first_line_only;
      for (std::size_t i = goes_on ? 1 : 0; fields.more(); ++i) {
        look_at(fields.field(), has_nodes && nodes.pattern.is_point(i));
      }
      goes_on = block.keyword == "ELEMENT" && trimmed(fields.line()).ends_with(',');
    }
    needs_instance_ = false;
  }

  InpReferences take() { return std::move(result_); }

 private:
  /// The number of terms; then node, degree of freedom and factor of each, four on a line.
  void look_at_equations(const InpBlock& block) {
    InpFields fields(block);
    std::int64_t left = 0;
    while (fields.next_line()) {
      const bool is_head = left <= 0;
      if (is_head) left = 0;
      for (std::size_t i = 0; fields.more(); ++i) {
        const std::string_view field = fields.field();
        if (is_head && i == 0) {
          to_integer(field, left);
        } else {
          const bool is_node = !is_head && i % 3 == 0 && left > 0 && !field.empty();
          look_at(field, is_node);
          left -= is_node ? 1 : 0;
        }
      }
    }
  }

  void look_at(std::string_view text, bool may_be_node) {
    if (text.empty()) return;
    const std::size_t dot = text.rfind('.');
    const bool has_instance = dot != std::string_view::npos && (text[0] < '0' || text[0] > '9') &&
                              text[0] != '-' && text[0] != '+' && text[0] != '.';
    const std::string_view last = has_instance ? text.substr(dot + 1) : text;
    std::int64_t number = 0;
    if (to_integer(last, number)) {
      if (!may_be_node || (!has_instance && needs_instance_)) return;
      const std::size_t instance =
          has_instance ? lines_.find_instance(text.substr(0, dot)) : std::size_t{0};
      if (instance != 0) {
        const InpScope& scope = lines_.scopes[lines_.instances[instance - 1].scope];
        if (scope.is_mesh) add_point(number, scope);
        return;
      }
      for (const InpScope* scope : scopes_) add_point(number, *scope);
      return;
    }
    const char c = text[0];
    if ((c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.') return;
    result_.names.insert(inp_key(text));
    if (has_instance) result_.names.insert(inp_key(last));
  }

  /// What numbers without an instance mean: within a part its own; outside those of the only one. Where
  /// there are several they mean none of these.
  void find_scopes(std::size_t scope, bool is_of_mesh) {
    scopes_.clear();
    if (scope == 0) {
      if (lines_.mesh_scopes.size() == 1) scopes_.push_back(&lines_.scopes[lines_.mesh_scopes[0]]);
    } else if (is_of_mesh) {
      scopes_.push_back(&lines_.scopes[scope]);
    }
  }

  void add_point(std::int64_t number, const InpScope& scope) {
    const std::uint32_t place = mesh_.nodes.find(scope.node(number));
    if (place != InpNumbers::kNone) result_.points.push_back({place, block_});
  }

  const InpLines& lines_;
  const InpMesh& mesh_;
  const InpBlock* block_ = nullptr;
  bool needs_instance_ = false;
  std::vector<const InpScope*> scopes_;  // that numbers without an instance are of
  InpReferences result_;
};

template <class Visit>
void for_tets(const InpMesh& mesh, const Visit& visit) {
  for (const InpElements& block : mesh.blocks) {
    if (block.type.vtk_type != kVtkTet && block.type.vtk_type != kVtkTet10) continue;
    for (std::size_t i = 0; i < block.count; ++i) {
      visit(block.vertices.data() + i * block.type.width, block.type.width,
            static_cast<std::uint32_t>(block.first + i));
    }
  }
}

/// Marks members of a set that are in no tet which the set holds wholly. 64 sets at a time.
void mark_single_members(const InpMesh& mesh, const std::vector<const InpSet*>& sets,
                         std::vector<char>& marks) {
  constexpr std::size_t kAtOnce = 64;
  std::vector<std::uint64_t> held(mesh.points.size());
  for (std::size_t first = 0; first < sets.size(); first += kAtOnce) {
    const std::size_t last = std::min(sets.size(), first + kAtOnce);
    std::fill(held.begin(), held.end(), 0);
    for (std::size_t k = first; k < last; ++k) {
      for (const std::uint32_t v : sets[k]->members) held[v] |= std::uint64_t{1} << (k - first);
    }
    std::vector<std::uint64_t> covered(held.size());
    for_tets(mesh, [&](const std::uint32_t* v, std::size_t width, std::uint32_t) {
      std::uint64_t all = ~std::uint64_t{0};
      for (std::size_t k = 0; k < 4; ++k) all &= held[v[k]];
      for (std::size_t k = 0; k < width; ++k) covered[v[k]] |= all;
    });
    for (std::size_t v = 0; v < held.size(); ++v) {
      if ((held[v] & ~covered[v]) != 0) marks[v] = 1;
    }
  }
}

/// Does what mark_single_members() does for the sets of few points, and drops these: each looks at
/// the tets at its points alone. Of the corners of a tet the one in the fewest tets has it.
void mark_members_of_small_sets(const InpMesh& mesh, std::vector<const InpSet*>& sets,
                                std::vector<char>& marks) {
  constexpr std::size_t kFew = 64;  // times as many points has the mesh, at least
  const auto is_large = [&](const InpSet* set) {
    return kFew * set->members.size() > mesh.points.size();
  };
  const auto small = std::stable_partition(sets.begin(), sets.end(), is_large);
  if (small == sets.end()) return;
  std::vector<std::uint32_t> tets_at(mesh.points.size());
  std::vector<std::span<const std::uint32_t>> tets;
  for_tets(mesh, [&](const std::uint32_t* v, std::size_t width, std::uint32_t) {
    tets.emplace_back(v, width);
    for (std::size_t k = 0; k < 4; ++k) ++tets_at[v[k]];
  });
  std::vector<std::uint32_t> owners;
  for (const auto v : tets) {
    owners.push_back(*std::min_element(v.begin(), v.begin() + 4,
                                       [&](auto a, auto b) { return tets_at[a] < tets_at[b]; }));
  }
  const Grouping of_owner = group_by_key(owners, static_cast<std::uint32_t>(mesh.points.size()));
  std::vector<std::uint32_t> held(mesh.points.size());
  std::vector<std::uint32_t> covered(mesh.points.size());
  std::uint32_t number = 0;
  for (auto set = small; set != sets.end(); ++set) {
    ++number;
    const auto& members = (*set)->members;
    for (const std::uint32_t v : members) held[v] = number;
    for (const std::uint32_t v : members) {
      for (const std::uint32_t t : of_owner.group(v)) {
        const auto is_held = [&](std::uint32_t corner) { return held[corner] == number; };
        if (!std::all_of(tets[t].begin(), tets[t].begin() + 4, is_held)) continue;
        for (const std::uint32_t node : tets[t]) covered[node] = number;
      }
    }
    for (const std::uint32_t v : members) {
      if (covered[v] != number) marks[v] = 1;
    }
  }
  sets.erase(small, sets.end());
}

/// Takes away the marks of points on faces that stay as they are: of one tet, between two parts, or
/// named.
class Unmarking {
 public:
  Unmarking(const InpMesh& mesh, std::vector<char>& marks) : mesh_(mesh), marks_(marks) {}

  void run(const InpFaces& named, std::span<const std::uint32_t> part_of) {
    std::vector<char> stays(marks_.size(), 1);  // or in no tet
    for_tets(mesh_, [&](const std::uint32_t* v, std::size_t width, std::uint32_t element) {
      for (std::size_t k = 0; k < width; ++k) stays[v[k]] = 0;
      if (std::any_of(v, v + width, [&](std::uint32_t i) { return marks_[i] != 0; })) {
        add_faces(v, width, part_of[element]);
      }
    });
    for (const InpFace& face : named.faces) add({face.corners, {kNone, kNone, kNone}, kNone});
    std::sort(faces_.begin(), faces_.end(),
              [](const Face& a, const Face& b) { return a.corners < b.corners; });
    for (std::size_t i = 0; i < faces_.size();) {
      std::size_t end = i + 1;
      while (end < faces_.size() && faces_[end].corners == faces_[i].corners) ++end;
      // Of a face whose other tet has no mark, none of its own points has.
      const bool is_free = end == i + 2 && faces_[i].part == faces_[i + 1].part;
      for (; i < end; ++i) {
        if (is_free) continue;
        for (const std::uint32_t v : faces_[i].corners) stays[v] = 1;
        for (const std::uint32_t v : faces_[i].middles) {
          if (v != kNone) stays[v] = 1;
        }
      }
    }
    for (std::size_t v = 0; v < marks_.size(); ++v) marks_[v] = marks_[v] != 0 && stays[v] == 0;
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  struct Face {
    std::array<std::uint32_t, 3> corners;
    std::array<std::uint32_t, 3> middles;
    std::uint32_t part;
  };

  void add_faces(const std::uint32_t* v, std::size_t width, std::uint32_t part) {
    // The middle of each edge of a tet of second order.
    constexpr std::array<std::array<std::size_t, 4>, 4> kMiddle = {
        {{0, 4, 6, 7}, {4, 0, 5, 8}, {6, 5, 0, 9}, {7, 8, 9, 0}}};
    for (const auto& c : kInpTetFaces) {
      Face face{{v[c[0]], v[c[1]], v[c[2]]}, {kNone, kNone, kNone}, part};
      if (width > 4)
        face.middles = {v[kMiddle[c[0]][c[1]]], v[kMiddle[c[1]][c[2]]], v[kMiddle[c[2]][c[0]]]};
      add(face);
    }
  }

  /// Faces without a mark are of no account.
  void add(Face face) {
    const auto is_marked = [&](std::uint32_t v) { return v != kNone && marks_[v] != 0; };
    if (face.part != kNone && std::none_of(face.corners.begin(), face.corners.end(), is_marked) &&
        std::none_of(face.middles.begin(), face.middles.end(), is_marked)) {
      return;
    }
    std::sort(face.corners.begin(), face.corners.end());
    faces_.push_back(face);
  }

  const InpMesh& mesh_;
  std::vector<char>& marks_;
  std::vector<Face> faces_;
};

/// Says who keeps how many points, in the order of the deck.
class Remarks {
 public:
  Remarks(const InpLines& lines, const std::vector<char>& marks) : marks_(marks) {
    for (const InpBlock& block : lines.blocks) places_.emplace(&block, places_.size());
  }

  void add_keywords(const InpReferences& references) {
    struct Pins {
      const InpBlock* first;
      std::set<const InpBlock*> blocks;
      std::vector<std::uint32_t> points;
    };
    std::map<std::string_view, Pins> pins;
    for (const InpReference& each : references.points) {
      if (marks_[each.point] == 0) continue;
      Pins& of = pins.try_emplace(each.block->keyword, Pins{each.block, {}, {}}).first->second;
      if (places_.at(each.block) < places_.at(of.first)) of.first = each.block;
      of.blocks.insert(each.block);
      of.points.push_back(each.point);
    }
    for (auto& [keyword, of] : pins) {
      std::sort(of.points.begin(), of.points.end());
      of.points.erase(std::unique(of.points.begin(), of.points.end()), of.points.end());
      const bool is_known = of.first->keyword == "EQUATION" || nodes_of(*of.first).is_known;
      add(*of.first, of.blocks.size(),
          fmt::format("*{}{}", keyword, is_known ? "" : ", whose fields are not known,"),
          of.points.size());
    }
  }

  void add_sets(const InpLines& lines, InpSets& sets, const InpReferences& references) {
    std::vector<char> named(marks_.size(), 0);
    for (const InpReference& each : references.points) named[each.point] = 1;
    std::set<const InpSet*> done;
    for (const InpBlock& block : lines.blocks) {
      const bool has_nodes =
          is_mesh_block(block, "NODE") || (block.keyword == "NSET" && is_set_block(block));
      const InpSet* set = has_nodes ? sets.of_block(block) : nullptr;
      if (set == nullptr || !done.insert(set).second) continue;
      std::size_t count = 0;
      for (const std::uint32_t v : set->members) {
        if (marks_[v] == 0 || named[v] != 0) continue;
        named[v] = 1;  // the first set says it
        ++count;
      }
      if (count > 0) add(block, 1, fmt::format("the set of nodes {}", in_quotes(set->name)), count);
    }
  }

  std::string text() {
    std::sort(remarks_.begin(), remarks_.end(),
              [](const Remark& a, const Remark& b) { return a.first < b.first; });
    std::vector<PinRemark> in_order;
    for (Remark& each : remarks_) in_order.push_back(std::move(each.second));
    return pin_remarks_text(in_order, "lines");
  }

 private:
  using Remark = std::pair<std::size_t, PinRemark>;  // place in the deck
  void add(const InpBlock& block, std::size_t blocks, std::string who, std::size_t count) {
    remarks_.push_back(
        {places_.at(&block), {block.file, block.begin, blocks, std::move(who), count}});
  }

  const std::vector<char>& marks_;
  std::map<const InpBlock*, std::size_t> places_;  // in the deck
  std::vector<Remark> remarks_;
};

}  // namespace

InpReferences find_references(const InpLines& lines, const std::vector<const InpBlock*>& kept,
                              const InpMesh& mesh) {
  Finder finder(lines, mesh);
  for (const InpBlock* block : kept) finder.look_at(*block);
  return finder.take();
}

InpPins find_pins(const InpLines& lines, const InpMesh& mesh, InpSets& sets, const InpFaces& faces,
                  const InpReferences& references, std::span<const std::uint32_t> part_of) {
  std::vector<char> marks(mesh.points.size());
  std::vector<const InpSet*> of_nodes;
  for (const InpSet& set : sets.all) {
    if (set.of_nodes && set.members.size() < mesh.points.size()) of_nodes.push_back(&set);
  }
  mark_members_of_small_sets(mesh, of_nodes, marks);
  mark_single_members(mesh, of_nodes, marks);
  for (const InpSet& set : sets.all) {
    if (!set.is_unsorted) continue;
    for (const std::uint32_t v : set.members) marks[v] = 1;
  }
  for (const InpReference& each : references.points) marks[each.point] = 1;
  if (std::find(marks.begin(), marks.end(), 1) == marks.end()) return {};
  Unmarking(mesh, marks).run(faces, part_of);
  InpPins pins;
  for (std::uint32_t v = 0; v < marks.size(); ++v) {
    if (marks[v] != 0) pins.points.push_back(v);
  }
  if (pins.points.empty()) return pins;
  Remarks remarks(lines, marks);
  remarks.add_keywords(references);
  remarks.add_sets(lines, sets, references);
  pins.remarks = remarks.text();
  return pins;
}

}  // namespace tetmend::formats
