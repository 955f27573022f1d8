// SPDX-License-Identifier: MIT
// The rulers of a mesh that is never there as a whole: measured share by share.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "kernel/compensated_sum.h"
#include "kernel/ruler_histogram.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// Which faces and vertices of a mesh are of a share. All tets at these must be there.
struct RulerScope {
  std::function<bool(HalfFace)> has_face;  ///< asked by all threads, as the next
  std::function<bool(VertexHandle)> has_vertex;
};

/// What adds up, by Ruler. A score is a value whose sign is such that less is worse; of an angle it is
/// the cosine. Lengths as in the file.
struct RulerShare {
  struct Scores {
    std::uint64_t count = 0;
    double worst = std::numeric_limits<double>::infinity();
    CompensatedSum sum;
  };
  std::array<Scores, kRulerCount> of;
  double shortest_edge = std::numeric_limits<double>::infinity();
  std::uint64_t faces_above_70 = 0;
  std::uint64_t turned = 0;  ///< shares with a tet of no positive volume

  void add(const RulerShare& other);
};

/// The worst scores of all shares: among them are those that 1 % are not better than.
class WorstScores {
 public:
  /// Precondition: no more than so many tets are measured. Memory: 2 bytes for each at most.
  explicit WorstScores(std::uint64_t tets);

  using Limits = std::array<double, kRulerCount>;
  /// Scores that are not below need not be added.
  const Limits& limits() const { return limits_; }
  void add(std::size_t ruler, const std::vector<double>& scores);
  /// Of one ruler, ascending.
  const std::vector<double>& sorted(std::size_t ruler);

 private:
  std::array<std::size_t, kRulerCount> most_{};
  Limits limits_;
  std::array<std::vector<double>, kRulerCount> scores_;
};

/// Adds all tets of a mesh to the share. Cost: about that of measure_rulers(), with the next.
void measure_tets(const TetMesh& mesh, RulerShare& share, WorstScores& worst);
/// Adds faces and vertices.
void measure_around(const TetMesh& mesh, const RulerScope& scope, RulerShare& share,
                    WorstScores& worst);
/// The same for counts, whose bins are set.
void count_tets(const TetMesh& mesh, RulerHistograms& counts);
void count_around(const TetMesh& mesh, const RulerScope& scope, RulerHistograms& counts);
/// Nothing counted yet. @param means  see count_rulers()
RulerHistograms bins_for(const MeshRulers& means);

/// Of the worst scores of so many, the place of the figure at 1 %, from 0.
constexpr std::uint64_t place_of_one_percent(std::uint64_t count) {
  return (count + 99) / 100 - 1;
}
/// The figures of all shares together. What a walk from the surface through the whole mesh would tell,
/// cg_steps and work, is not a number.
/// @param one_percent  the scores at 1 %, by Ruler
MeshRulers rulers_of(const RulerShare& all, const std::array<double, kRulerCount>& one_percent);

}  // namespace tetmend
