// SPDX-License-Identifier: MIT
// Values of all tets of a mesh, their histogram and the worst of them, kept up while the mesh changes.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viewer/mesh/histogram.h"
#include "viewer/mesh/tet_values.h"

namespace tetmend::viewer {

/// The worst of many, by value and then by number, while values change one by one.
class WorstTets {
 public:
  /// Cost: linear.
  void build(std::span<const float> values, std::size_t count);
  /// Of one slot. `values` are those after the change. Not a number: no tet.
  /// Cost: logarithmic; linear when too many of the worst have gone.
  void change(TetHandle t, float before, std::span<const float> values);
  /// `count` of them, the worst first, as worst_tets() gives them.
  std::vector<TetHandle> list() const;

 private:
  using Entry = std::pair<float, std::uint32_t>;  // and its slot

  static constexpr std::size_t kReserve = 16;  // so many times the count are kept at first

  std::size_t count_ = 0;
  std::vector<Entry> kept_;     // ascending: all that are not worse than...
  std::optional<Entry> limit_;  // ... this; without one, all
};

/// What it gives is of the mesh of the last question, until forget() or update().
class TetLists {
 public:
  static constexpr std::size_t kWorstListed = 100;

  /// Another mesh.
  void forget();
  /// These slots have other tets, or tets of other shape; among them those that have come or gone.
  void update(const TetMesh& mesh, std::span<const TetHandle> changed);

  /// By slot. `measure` is a name of tet_values(). @throws Error for another.
  std::span<const float> values(const TetMesh& mesh, const std::string& measure);
  const Histogram& histogram(const TetMesh& mesh, const std::string& measure);
  const std::vector<TetHandle>& worst(const TetMesh& mesh, const std::string& measure);

 private:
  void list(const TetMesh& mesh, const std::string& measure);

  std::map<std::string, std::vector<float>> values_;
  std::string listed_;  // the measure of what follows; empty: not made yet
  Histogram histogram_;
  WorstTets order_;
  std::vector<TetHandle> worst_;
};

}  // namespace tetmend::viewer
