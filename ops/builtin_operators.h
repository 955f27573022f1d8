// SPDX-License-Identifier: MIT
// The operators of tetmend itself. What each one does stands at its class.
#pragma once

#include "ops/describe.h"

namespace tetmend {

// Edges: ops/shell_transformation.cpp, and a source each.
const OperatorInfo& shell_transformation_info();
const OperatorInfo& edge_removal_info();
const OperatorInfo& recursive_shell_transformation_info();
const OperatorInfo& flip_3_2_info();
const OperatorInfo& flip_4_4_info();
const OperatorInfo& surface_edge_removal_info();
// Faces and polyhedra: a source each.
const OperatorInfo& flip_2_3_info();
const OperatorInfo& multi_face_removal_info();
const OperatorInfo& polyhedron_reconnection_info();
// Vertices that move: ops/smoothing.cpp, and a source each.
const OperatorInfo& smoothing_info();
const OperatorInfo& surface_smoothing_info();
const OperatorInfo& joint_smoothing_info();
const OperatorInfo& mean_smoothing_info();
// New vertices: ops/edge_split.cpp, cavity_insertion.cpp, vertex_insertion.cpp.
const OperatorInfo& edge_split_info();
const OperatorInfo& surface_split_info();
const OperatorInfo& cavity_insertion_info();
const OperatorInfo& surface_insertion_info();
const OperatorInfo& centroid_insertion_info();
const OperatorInfo& circumcentre_insertion_info();
// Vertices that vanish: ops/edge_contraction.cpp, vertex_removal.cpp.
const OperatorInfo& edge_contraction_info();
const OperatorInfo& surface_contraction_info();
const OperatorInfo& vertex_removal_info();

}  // namespace tetmend
