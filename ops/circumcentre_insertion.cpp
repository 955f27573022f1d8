// SPDX-License-Identifier: MIT
#include "ops/circumcentre_insertion.h"

#include "ops/vertex_insertion.h"

namespace tetmend {

namespace {

class CircumcentreInsertion final : public VertexInsertion {
 public:
  explicit CircumcentreInsertion(const ParameterValues& values)
      : VertexInsertion(circumcentre_insertion_info(), values) {}

 protected:
  Point place(const TetMesh& mesh, TetHandle t) const override {
    const auto& v = mesh.vertices(t);
    const Point& origin = mesh.point(v[0]);
    const Point a = mesh.point(v[1]) - origin;
    const Point b = mesh.point(v[2]) - origin;
    const Point c = mesh.point(v[3]) - origin;
    const Point sum =
        a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b);
    return origin + sum / (2 * a.dot(b.cross(c)));
  }
};

}  // namespace

const OperatorInfo& circumcentre_insertion_info() {
  static const OperatorInfo kInfo = {
      "circumcentre_insertion", TargetKind::tet, "insert a vertex at the circumcentre of a tet",
      VertexInsertion::parameters(),
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<CircumcentreInsertion>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
