// SPDX-License-Identifier: MIT
// Facts about a mesh, or about what became of it: what `tetmend check` prints.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <tetmend/goal.h>
#include <tetmend/mesh.h>

namespace tetmend {

/// What was looked at, and whether it holds.
struct Fact {
  using Number =
      std::variant<std::monostate, std::uint64_t, double>;  ///< nothing, a count, a value
  std::string name;                                         ///< for programs
  bool holds = true;                                        ///< else the check has failed
  std::string text;                                         ///< for people
  Number value;                                             ///< of the mesh
  Number wanted;                                            ///< the threshold
};

/// Thresholds and presets; the options of `tetmend check` have the same names.
struct CheckOptions {
  double min_dihedral = 0;    ///< degrees, 0 to 71: no smaller dihedral angle; 0: any
  double max_dihedral = 180;  ///< degrees, 70 to 180: no larger one; 180: any
  bool no_inverted =
      false;  ///< no inverted or flat tet, in exact arithmetic, as vertices are listed
  /// Worst values of rulers (kRulers): {"mean_ratio", 0.1}.
  std::vector<std::pair<std::string, double>> measure = {};
  std::string preset = {};  ///< what a solver or a use asks, see check_presets(); empty: none
  int threads = 1;          ///< 1 to 1024
  Goal goal = {};           ///< of the run, for compare(): tets that miss it are bad
  std::string surface =
      {};  ///< of the run, for compare(), as Options::surface: how far it may have moved

  /// Whether there is anything to look at.
  bool asks() const {
    return min_dihedral > 0 || max_dihedral < 180 || no_inverted || !measure.empty() ||
           !preset.empty();
  }
};

/// The facts that the options ask for, in a fixed order.
/// @throws OptionError for an unknown ruler ("measure") or preset ("for"), or a threshold out of
/// range; Error as measure().
TETMEND_API std::vector<Fact> check(const Mesh& mesh, const CheckOptions& options);

/// What an improved mesh must have in common with the mesh that it came from, and that it is no
/// worse. Looks at the two meshes alone: it knows nothing of the run.
/// @param preset  a use that it must suit as well as before: "explicit", "implicit"; others add no
/// facts
/// @param goal  of the run, if there was one: what of it is no worse depends on which tets are bad
/// @param surface  of the run, as Options::surface: how far the surface may have moved, faces between
/// labels and named triangles included. Each is proven, wholly, to lie within that of what was there,
/// and what was there of it; without one, they must be the same, bit for bit
/// @throws Error as measure(); OptionError for an unknown preset ("for") or a surface that is none.
/// Cost: n log n.
TETMEND_API std::vector<Fact> compare(const Mesh& before, const Mesh& after, int threads = 1,
                                      std::string_view preset = {}, const Goal& goal = {},
                                      std::string_view surface = {});

/// What one solver, or one use, asks of a mesh.
struct CheckPreset {
  std::string_view name;    ///< of the solver or use: "calculix", "explicit"
  std::string_view source;  ///< who asks for it
};
/// What CheckOptions::preset can name; all of them ask for no inverted tet.
TETMEND_API std::vector<CheckPreset> check_presets();

}  // namespace tetmend
