// SPDX-License-Identifier: MIT
// Which tets a pass works on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
// Boxes alone, see kernel/geometry.h.
#if EIGEN_VERSION_AT_LEAST(3, 4, 90)
#include <Eigen/Geometry>
#else
// clang-format off
#include <Eigen/src/Core/util/DisableStupidWarnings.h>
#include <Eigen/src/Geometry/AlignedBox.h>
#include <Eigen/src/Core/util/ReenableStupidWarnings.h>
// clang-format on
#endif

#include "kernel/tet_mesh.h"

namespace tetmend {

/// Numbers of tets by name: arrays that a mesh came with, or properties of a program.
class TetValues {
 public:
  using Of = std::function<double(const TetMesh&, TetHandle)>;

  virtual ~TetValues() = default;
  /// What it gives may be called by several threads, for live tets. Empty: there are none of that name.
  virtual Of find(std::string_view name) const = 0;
  virtual std::vector<std::string> names() const = 0;
};

/// Tets of a value from low to high: that of the TetValues of a run, of a measure that was added to its
/// registry, or of a quality measure of tetmend, of that name.
struct ValueRange {
  std::string name;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Conditions that all hold together; by default the bad tets. It says at which tets operators are
/// tried, not where the mesh may change: an operator replaces tets around the selected one.
struct Selection {
  static constexpr Quality kAll = std::numeric_limits<Quality>::infinity();

  Quality below = kBadThreshold;  ///< tets of lower quality; kAll: every tet
  std::size_t at_least = 0;       ///< if fewer are below, the worst bad ones fill up to so many
  /// Of these, at most so many, the worst.
  std::size_t worst = std::numeric_limits<std::size_t>::max();
  double share = 1;                ///< and at most this share of the tets of the mesh, the worst
  std::vector<Label> labels = {};  ///< of the region; empty: any
  std::optional<Eigen::AlignedBox3d> box = {};  ///< with all vertices in it or on its border
  std::optional<ValueRange> value = {};
  /// With a vertex around which something changed at that date or later (TetMesh::changed()).
  Date since = 0;

  /// The same for a part of a mesh that has `part` of its `whole` tets: numbers of tets become less
  /// in proportion, rounded up. Precondition: part <= whole, 0 < whole < 2^34, part < 2^30.
  Selection of_part(std::uint64_t part, std::uint64_t whole) const;
  /// Equal for selections that mean the same.
  std::string describe() const;
};

/// A selection bound to a mesh. Both must outlive it.
class SelectionTest {
 public:
  /// @param values null: there are none
  /// @param measures that were added; must outlive it
  /// @throws Error when neither a value nor a measure has the name, with the valid ones.
  SelectionTest(const TetMesh& mesh, const Selection& selection, const TetValues* values = nullptr,
                std::span<const Standard> measures = {});

  /// Tets of this quality or higher are out of the question.
  Quality limit() const;
  /// Conditions other than quality and number. Precondition: t is live.
  bool admits(TetHandle t) const;
  /// How many tets are taken of `candidates` that all are under the limit, when `below` of them are
  /// of lower quality than Selection::below.
  std::size_t take(std::size_t candidates, std::size_t below) const;

 private:
  void find_value(const TetValues* values, std::span<const Standard> measures);
  double value_of(TetHandle t) const;

  const TetMesh& mesh_;
  const Selection& selection_;
  bool plain_;
  TetValues::Of named_;
  const QualityMeasure* measure_ = nullptr;
  const Standard* own_ = nullptr;  // by a measure that was added
};

}  // namespace tetmend
