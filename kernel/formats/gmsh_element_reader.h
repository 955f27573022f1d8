// SPDX-License-Identifier: MIT
// The section $Elements of a Gmsh file.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/formats/gmsh_draft.h"
#include "kernel/formats/gmsh_nodes.h"
#include "kernel/formats/gmsh_source.h"

namespace tetmend::formats {

class GmshElementReader {
 public:
  /// With `with_places` the draft gets the place of each element.
  GmshElementReader(GmshSource& source, const GmshNodes& nodes, GmshDraft& draft, bool with_places)
      : source_(source), nodes_(nodes), draft_(draft), with_places_(with_places) {}

  /// The section of version 2.2 and of version 4.1. @throws Error
  void read_2();
  void read_4();

  /// Elements of version 2.2 were in partitions.
  bool partitioned() const { return partitioned_; }

 private:
  struct Row;

  int read_type();
  int known_type(const char* at, std::int64_t type) const;
  GmshRows& grow(int type, std::size_t count);
  std::uint32_t vertex(TextReader& text) const;
  template <class Integer>
  std::uint32_t vertex_at(const char* at) const;
  [[noreturn]] void fail_without_node(const char* at, std::int64_t tag) const;

  void read_block(int type, std::size_t count, Label label, Label part);
  void read_text_2(std::size_t count);
  Row read_row(TextReader& text) const;
  void add(const Row& row);
  void read_binary_2(std::size_t count);
  void read_run(int type, std::size_t count, std::size_t tags);

  GmshSource& source_;
  const GmshNodes& nodes_;
  GmshDraft& draft_;
  bool with_places_;
  bool partitioned_ = false;
};

}  // namespace tetmend::formats
