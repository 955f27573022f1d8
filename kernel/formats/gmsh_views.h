// SPDX-License-Identifier: MIT
// Numbers on nodes and elements of a Gmsh file: $NodeData, $ElementData, $ElementNodeData.
#pragma once

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/formats/gmsh_nodes.h"
#include "kernel/formats/gmsh_source.h"
#include "kernel/formats/gmsh_tags.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// The sections may stand before the mesh: they are looked at when all is read.
class GmshViews {
 public:
  explicit GmshViews(GmshSource& source) : source_(source) {}

  /// Reads the head of a section and passes over its numbers. @throws Error
  void read_head(bool of_nodes);
  /// Moves the numbers into `mesh`, and what is not kept into its notes. `tags` are the numbers of
  /// tets, triangles and edges. @throws Error
  void move_into(MeshData& mesh, const GmshNodes& nodes, const std::array<GmshTags, 3>& tags);

 private:
  struct View {
    std::string name;
    bool of_nodes = false;
    std::size_t components = 1;
    std::size_t count = 0;
    const char* numbers = nullptr;
  };
  /// Values for all points, or all elements of a kind.
  struct Filled {
    std::vector<double> values;
    std::vector<bool> given;
    std::size_t missing = 0;
  };

  void add_note(std::string note);
  template <class Add>
  void read_rows_of(const View& view, const Add& add);
  double value(TextReader& text) const;
  void add_point_data(const View& view, const GmshNodes& nodes, MeshData& mesh);
  void add_element_data(const View& view, const std::array<GmshTags, 3>& tags, MeshData& mesh);

  GmshSource& source_;
  std::vector<View> views_;
  std::set<std::pair<bool, std::string>> names_;  // of nodes, name
  std::vector<std::string> notes_;
  std::set<std::string> known_notes_;
};

}  // namespace tetmend::formats
