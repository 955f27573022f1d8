// SPDX-License-Identifier: MIT
// A mesh whose arrays lie on the ranks: each has a range of the vertices and some of the tets, which
// name vertices by their numbers in the whole mesh.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "kernel/formats/run_files.h"
#include "kernel/mesh_data.h"
#include "pieces/divided_mesh.h"
#include "pieces/rows.h"

namespace tetmend::pieces {

class CarriedRows;

/// What one rank has. Vertices are numbered through: those of the first rank first. Elements of one
/// rank come before those of the next.
struct RankShare {
  template <std::size_t N>
  struct Element {
    std::array<std::uint64_t, N> vertices{};  ///< of the whole mesh
    Label label = 0;
  };
  std::vector<Point> points;
  std::vector<Label> point_labels;  ///< of each point, or none
  std::vector<Element<4>> tets;
  std::vector<Element<3>> triangles;
  std::vector<Element<2>> edges;
  std::vector<std::uint64_t> required_vertices;  ///< in the whole mesh
  /// Values of its own points and elements. All ranks have the same arrays, also where they have no
  /// values for them.
  KindArrays arrays;
  std::vector<std::string> notes;  ///< what of a file is not here, one sentence each
};

/// Files that all ranks read and write together.
class ArrayFiles {
 public:
  virtual ~ArrayFiles() = default;
  virtual bool is_one(const std::filesystem::path& file) const = 0;
  /// All ranks: each gets a share. @throws Error
  /// @param label_array for formats of named arrays, which of them holds labels; empty: as usual
  virtual RankShare read(const std::filesystem::path& file,
                         const std::string& label_array) const = 0;
  /// All ranks. @throws Error
  virtual void write(const std::filesystem::path& file, const RankShare& arrays) const = 0;
  /// All ranks: the stored pieces. @throws Error
  /// @param rows of their points and elements; null: none
  virtual void write_stored(const std::filesystem::path& file, const DividedMesh& mesh,
                            const CarriedRows* rows) const;
  /// What read() opens. Nothing is said where the file cannot be read.
  virtual formats::FileSet files_read(const std::filesystem::path& file) const {
    return {.files = {file}, .numbered = {}};
  }
  /// What write() may make, replace or remove, also of an older mesh.
  virtual formats::FileSet files_written(const std::filesystem::path& file) const {
    return {.files = {file}, .numbered = {}};
  }
  /// @throws Error when it is known already that it cannot be written
  virtual void check_output(const std::filesystem::path&) const {}
  /// Whether each stored piece is a file of its own.
  virtual bool is_in_parts(const std::filesystem::path&) const { return false; }
  /// Whether it can hold required vertices.
  virtual bool has_required_vertices(const std::filesystem::path&) const { return true; }
  /// Whether it can hold an array.
  virtual bool takes(const std::filesystem::path&, RowKind, const DataArray&) const {
    return false;
  }
};

/// Those of several kinds: the first that knows a file has it. All must outlive it.
class SeveralArrayFiles final : public ArrayFiles {
 public:
  explicit SeveralArrayFiles(std::vector<const ArrayFiles*> kinds) : kinds_(std::move(kinds)) {}
  bool is_one(const std::filesystem::path& file) const override;
  RankShare read(const std::filesystem::path& file, const std::string& label_array) const override;
  void write(const std::filesystem::path& file, const RankShare& arrays) const override;
  void write_stored(const std::filesystem::path& file, const DividedMesh& mesh,
                    const CarriedRows* rows) const override;
  formats::FileSet files_read(const std::filesystem::path& file) const override;
  formats::FileSet files_written(const std::filesystem::path& file) const override;
  void check_output(const std::filesystem::path& file) const override;
  bool is_in_parts(const std::filesystem::path& file) const override;
  bool has_required_vertices(const std::filesystem::path& file) const override;
  bool takes(const std::filesystem::path& file, RowKind kind,
             const DataArray& array) const override;

 private:
  /// Precondition: is_one().
  const ArrayFiles& of(const std::filesystem::path& file) const;

  std::vector<const ArrayFiles*> kinds_;
};

/// All of a mesh, as the share of one rank.
RankShare all_of(const MeshData& data);

bool has_arrays(const KindArrays& arrays);
/// All ranks: each gets those that the first one has, without values.
void share_outlines(KindArrays& arrays, Ranks& ranks);
/// All ranks: the first one gets the values of all.
KindArrays gather_arrays(const KindArrays& arrays, Ranks& ranks);

/// All ranks: how many elements there are on all of them.
struct ArrayCounts {
  std::uint64_t points = 0, tets = 0, triangles = 0, edges = 0, required_vertices = 0;
};
ArrayCounts count_all(const RankShare& arrays, Ranks& ranks);

/// All ranks: adds the mesh to one that has nothing yet, with end_slices(). A rank has its share in
/// memory, and what a slice of it needs from others.
/// @throws Error for a vertex that is not there, a repeated one, and a coordinate that is not finite
void add_arrays(const RankShare& arrays, DividedMesh& to);

/// All ranks: the stored pieces as such arrays. Vertices and elements have the order of join(),
/// vertices are shared out evenly, elements stay where their pieces are. Precondition: each rank has a
/// range of the pieces, as after a division without zones.
/// @param rows of the pieces; null: none
RankShare take_arrays(const DividedMesh& mesh, const CarriedRows* rows = nullptr);

}  // namespace tetmend::pieces
