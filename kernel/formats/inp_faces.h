// SPDX-License-Identifier: MIT
// Faces of tets that an Abaqus deck names by element and number: surfaces, and loads on faces.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "kernel/formats/inp_deck.h"
#include "kernel/formats/inp_mesh.h"
#include "kernel/formats/inp_sets.h"

namespace tetmend::formats {

/// A *SURFACE, or what lines of a load say alike of some faces.
struct InpFaceUse {
  const InpBlock* block = nullptr;
  bool is_surface = false;
  bool goes_on = false;   ///< with the surface of the use before, of another instance
  std::size_t scope = 0;  ///< of the tets
  std::string instance;   ///< before their numbers: "Part-1-1."
  std::string name;
  std::string prefix, suffix, rest;  ///< "P", "NU" and ", 5.0" of "17, P3NU, 5.0"
  std::string more;                  ///< lines of a surface about other elements, as they are
  Label number = 0;                  ///< of its group
};

struct InpFace {
  std::array<std::uint32_t, 3> corners{};  ///< seen from outside counter-clockwise
  std::uint32_t use = 0;
};

struct InpFaces {
  std::vector<InpFaceUse> uses;
  std::vector<InpFace> faces;
  /// Of each load with faces: its other lines as they are.
  std::map<const InpBlock*, std::string> rest_of_load;
  std::set<const InpSet*> sets;  ///< by which faces were named
  std::vector<std::string> notes;
};

InpFaces read_inp_faces(const InpLines& lines, const InpMesh& mesh, InpSets& sets);

}  // namespace tetmend::formats
