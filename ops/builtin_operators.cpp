// SPDX-License-Identifier: MIT
#include "ops/builtin_operators.h"

#include "ops/registry.h"

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
