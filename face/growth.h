// SPDX-License-Identifier: MIT
// How many tets a run may make, and what becomes of the lengths of edges.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tetmend/improve.h>

#include "kernel/tet_mesh.h"

namespace tetmend::face {

/// Options::tets, read.
class Growth {
 public:
  /// @throws OptionError for a text that is neither a share nor a number
  /// @param more  so many tets more are allowed whatever the share
  explicit Growth(const std::string& tets, std::size_t more = 0);
  /// The most tets that a mesh of so many may come to; none for no bound.
  /// @throws OptionError for a number of tets below that, unless it is marked as meant: often its
  /// percent sign is missing
  std::optional<std::size_t> most(std::size_t now) const;

 private:
  std::string text_;
  std::size_t more_;
  std::optional<double> share_;        // more
  std::optional<std::size_t> number_;  // in all
  bool is_meant_ = false;              // 10!
};

/// The mean lengths of edges at some vertices of a file, spread evenly.
class LocalLengths {
 public:
  LocalLengths() = default;
  /// At 20,000 vertices or so. `count`: vertices in the file. Cost: linear in the vertices, and a
  /// walk around each of the chosen.
  LocalLengths(const TetMesh& mesh, std::size_t count);
  /// None is measured yet: add() does that.
  explicit LocalLengths(std::size_t count);
  /// Those of a share of the mesh.
  /// @param number_of  a vertex, in the file; nothing: it is not of the share. All threads ask.
  void add(const TetMesh& mesh,
           const std::function<std::optional<std::uint64_t>(VertexHandle)>& number_of);
  std::size_t count() const { return count_; }  ///< vertices in the file
  /// By chosen vertex, as in the file; 0: it is not there, or not of a share that was added.
  std::span<double> lengths() { return lengths_; }

  /// At the same vertices by now. Looks only where something has changed since these were measured.
  /// Precondition: that was when nothing had changed since the mesh was built of that file.
  LocalLengths renewed(const TetMesh& mesh) const;

  /// Precondition: both are of the same file.
  SizeDrift drift_to(const LocalLengths& after) const;
  friend bool operator==(const LocalLengths&, const LocalLengths&) = default;

 private:
  template <class NumberOf>
  void measure(const TetMesh& mesh, const NumberOf& number_of);

  std::size_t count_ = 0;
  std::size_t step_ = 1;         // from one chosen number of a vertex to the next
  std::vector<double> lengths_;  // 0 for a vertex that is not there
};

}  // namespace tetmend::face
