// SPDX-License-Identifier: MIT
#include "ops/centroid_insertion.h"

#include "ops/vertex_insertion.h"

namespace tetmend {

namespace {

class CentroidInsertion final : public VertexInsertion {
 public:
  explicit CentroidInsertion(const ParameterValues& values)
      : VertexInsertion(centroid_insertion_info(), values) {}

 protected:
  Point place(const TetMesh& mesh, TetHandle t) const override {
    Point sum = Point::Zero();
    for (const VertexHandle v : mesh.vertices(t)) sum += mesh.point(v);
    return sum / 4;
  }
};

}  // namespace

const OperatorInfo& centroid_insertion_info() {
  static const OperatorInfo kInfo = {
      "centroid_insertion", TargetKind::tet, "insert a vertex at the centroid of a tet",
      VertexInsertion::parameters(),
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<CentroidInsertion>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
