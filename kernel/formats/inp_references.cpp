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
#include "kernel/formats/inp_fields.h"
#include "kernel/formats/word_list.h"

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

class InpReferenceFinder {
 public:
  InpReferenceFinder(const InpLines& lines, const InpMesh& mesh) : lines_(lines), mesh_(mesh) {}

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

}  // namespace

InpReferences find_references(const InpLines& lines, const std::vector<const InpBlock*>& kept,
                              const InpMesh& mesh) {
  InpReferenceFinder finder(lines, mesh);
  for (const InpBlock* block : kept) finder.look_at(*block);
  return finder.take();
}

bool inp_knows_nodes_of(const InpBlock& block) {
  return block.keyword == "EQUATION" || nodes_of(block).is_known;
}

}  // namespace tetmend::formats
