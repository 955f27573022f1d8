// SPDX-License-Identifier: MIT
// The contract of operators as a whole: all trials of an operator of a registry on many meshes.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "contract/trials.h"
#include "envelope/envelope.h"
#include "ops/registry.h"

namespace tetmend::contract {

/// A mesh to try operators on. Names are unique and contain no spaces, unless they are files.
struct Ground {
  std::string name;
  TetMesh mesh;
};

/// The zoo, two rough cubes, a mesh with constraints of all kinds, one with frozen tets, one with free
/// slots between the live ones, and some with a surface that may change.
std::vector<Ground> grounds();
/// A cube of cells^3 cells, each of six tets, all vertices but the corners moved from their places,
/// those of sides and edges along them. Its surface may change where that changes no shape.
TetMesh cube_with_free_sides(unsigned cells, std::uint64_t seed);
/// A block of 27 cells in two layers of labels 1 and 2, bent so much that a flip of two triangles of
/// its faces or of the wall between them may take the surface a twentieth of an edge away.
TetMesh bowl_with_free_surface(const EnvelopeOptions& options, std::uint64_t seed);

/// With the default parameters.
Candidate with_defaults(const Registry& registry, std::string_view name);
/// One for each end of the range of each parameter, where that is not the default.
std::vector<Candidate> at_its_limits(const Registry& registry, std::string_view name);

/// Told what came of each mesh, and whether all went well there. "territory" is all of them once more.
using Listener = std::function<void(std::string_view mesh, const Outcome&)>;

/// Tries an operator, with its defaults and at the ends of its parameters, alone and in turns with
/// those of tetmend itself, on all meshes, and on each of them in territories. Stops at a mesh with the first
/// breach, and goes on with the next. An operator that was never accepted breaks the contract as
/// well, for then nothing was shown: the total says so. So does its note where nothing was accepted in
/// a territory.
/// @throws Error if the operator cannot be made. Cost: some seconds for the grounds(); on a large
/// mesh fewer targets are tried.
Outcome check_contract(const Registry& registry, std::string_view name,
                       const std::vector<Ground>& meshes, const Listener& listener);

}  // namespace tetmend::contract
