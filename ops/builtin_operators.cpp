// SPDX-License-Identifier: MIT
// The operators of tetmend itself, one line each.
#include "ops/cavity_insertion.h"
#include "ops/centroid_insertion.h"
#include "ops/circumcentre_insertion.h"
#include "ops/edge_contraction.h"
#include "ops/edge_removal.h"
#include "ops/edge_split.h"
#include "ops/flip_2_3.h"
#include "ops/flip_3_2.h"
#include "ops/flip_4_4.h"
#include "ops/joint_smoothing.h"
#include "ops/mean_smoothing.h"
#include "ops/multi_face_removal.h"
#include "ops/polyhedron_reconnection.h"
#include "ops/recursive_shell_transformation.h"
#include "ops/registry.h"
#include "ops/shell_transformation.h"
#include "ops/smoothing.h"
#include "ops/surface_contraction.h"
#include "ops/surface_edge_removal.h"
#include "ops/surface_insertion.h"
#include "ops/surface_smoothing.h"
#include "ops/surface_split.h"
#include "ops/vertex_removal.h"

namespace tetmend {

Registry Registry::builtin() {
  Registry registry;
  registry.add(shell_transformation_info());
  registry.add(recursive_shell_transformation_info());
  registry.add(multi_face_removal_info());
  registry.add(edge_removal_info());
  registry.add(flip_2_3_info());
  registry.add(flip_3_2_info());
  registry.add(flip_4_4_info());
  registry.add(smoothing_info());
  registry.add(joint_smoothing_info());
  registry.add(mean_smoothing_info());
  registry.add(edge_split_info());
  registry.add(edge_contraction_info());
  registry.add(centroid_insertion_info());
  registry.add(circumcentre_insertion_info());
  registry.add(polyhedron_reconnection_info());
  registry.add(vertex_removal_info());
  registry.add(cavity_insertion_info());
  registry.add(surface_smoothing_info());
  registry.add(surface_edge_removal_info());
  registry.add(surface_contraction_info());
  registry.add(surface_split_info());
  registry.add(surface_insertion_info());
  return registry;
}

}  // namespace tetmend
