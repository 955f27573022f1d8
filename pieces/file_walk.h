// SPDX-License-Identifier: MIT
// A divided mesh as one file has it: all vertices in their order, then element by element. The first rank
// is told, all others send it what they have, so that no rank holds more than a part.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/formats/output_file.h"
#include "pieces/bytes.h"
#include "pieces/divided_mesh.h"
#include "pieces/numbering.h"
#include "pieces/piece.h"

namespace tetmend::pieces {

/// What a vertex of the new file is.
struct FileVertex {
  std::array<double, 3> point;
  Label label;
};

/// All ranks call the same functions. The order is that of join(). Takes a quarter of a byte for each
/// vertex and what two pieces take.
class FileWalk {
 public:
  /// Of the stored pieces. It must not outlive the mesh.
  explicit FileWalk(const DividedMesh& mesh);

  struct Counts {
    std::uint64_t vertices = 0;
    std::uint64_t tets = 0;
    std::uint64_t triangles = 0;
    std::uint64_t edges = 0;
  };
  const Counts& counts() const { return counts_; }
  /// Ids of required vertices, sorted.
  const std::vector<VertexId>& required() const { return required_; }
  bool has_point_labels() const { return has_point_labels_; }  ///< one is not 0
  bool has_labels() const { return has_labels_; }              ///< of an element
  /// In the file, from 0.
  std::uint64_t number(VertexId id) const { return numbering_.number(id); }

  /// Tells the first rank some vertices at a time, in the order of the file.
  void vertices(const std::function<void(std::span<const FileVertex>)>& take) const;
  /// Likewise elements of one kind: the rank that has one packs it, by its numbers, and the first one
  /// gets these bytes, some at a time. @param change  may give them other labels, or leave some out
  template <class Element, class Pack>
  void elements(std::vector<Element> Piece::*list, Pack pack,
                const std::function<void(std::string_view)>& take,
                const std::function<void(std::size_t part, Piece&)>& change = {}) const {
    pieces(
        [&](std::size_t part, std::string& bytes) {
          std::array<std::uint64_t, std::tuple_size_v<decltype(Element::vertices)>> numbers;
          Piece piece = mesh_.stored(part);
          if (change) change(part, piece);
          for (const Element& element : piece.*list) {
            for (std::size_t k = 0; k < numbers.size(); ++k) {
              numbers[k] = number(piece.ids[element.vertices[k]]);
            }
            pack(numbers, element.label, bytes);
          }
        },
        take);
  }
  /// The rank that has a piece packs something of it, and the first one gets these bytes, in the order of
  /// the pieces.
  void pieces(const std::function<void(std::size_t part, std::string& bytes)>& pack,
              const std::function<void(std::string_view)>& take) const;
  /// Of a piece of this rank.
  template <class Element>
  std::size_t count(std::size_t part, std::vector<Element> Piece::*list) const {
    return (mesh_.stored(part).*list).size();
  }
  /// Packs the same number of bytes for each of these vertices, which are those of a stored piece from
  /// `begin` on.
  using PackVertices =
      std::function<std::string(std::size_t part, std::size_t begin, const Piece& vertices)>;
  /// Tells the first rank `size` bytes of each vertex, in the order of the file.
  void vertex_bytes(std::size_t size, const PackVertices& pack,
                    const std::function<void(std::string_view)>& take) const;

 private:
  class Ranges;
  void count();
  bool has(std::size_t part) const;
  std::string collect(const Ranges& ranges, std::size_t number, std::size_t size,
                      const PackVertices& pack) const;
  std::vector<std::string> send_to_first(std::string bytes) const;

  const DividedMesh& mesh_;
  Ranks& ranks_;
  Numbering numbering_;
  Counts counts_;
  std::vector<VertexId> required_;
  bool has_point_labels_ = false;
  bool has_labels_ = false;
};

/// All ranks: write(out) with the file on the first rank, with null on others. It is there when all are
/// done. @throws Error as OutputFile
void write_by_first(const std::filesystem::path& file, Ranks& ranks,
                    const std::function<void(OutputFile* out)>& write);

}  // namespace tetmend::pieces
