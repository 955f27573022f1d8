// SPDX-License-Identifier: MIT
// Rows of numbers and the sections without elements of Gmsh's files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/formats/output_file.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// A row of numbers, as text or as bytes.
template <class Out>
class GmshRow {
 public:
  GmshRow(Out& out, bool binary) : out_(out), binary_(binary) {}
  /// 4 bytes.
  GmshRow& integer(std::int64_t value) {
    return binary_ ? bytes(static_cast<std::int32_t>(value)) : text(value);
  }
  /// 8 bytes.
  GmshRow& wide(std::int64_t value) { return binary_ ? bytes(value) : text(value); }
  GmshRow& size(std::size_t value) { return wide(static_cast<std::int64_t>(value)); }
  GmshRow& real(double value) {
    if (binary_) return bytes(value);
    separate();
    out_.put_real(value);
    return *this;
  }
  GmshRow& point(const Point& point) { return real(point[0]).real(point[1]).real(point[2]); }
  void end() {
    if (!binary_) out_.put('\n');
    is_first_ = true;
  }

 private:
  void separate() {
    if (!is_first_) out_.put(' ');
    is_first_ = false;
  }
  template <class T>
  GmshRow& bytes(T value) {
    out_.put_bytes(value);
    return *this;
  }
  GmshRow& text(std::int64_t value) {
    separate();
    out_.put_integer(value);
    return *this;
  }

  Out& out_;
  bool binary_;
  bool is_first_ = true;
};

/// Writes what a file of version 2.2 or 4.1 has besides its nodes and elements.
class GmshSections {
 public:
  /// @param name of the file, for messages
  GmshSections(OutputFile& out, std::string name, bool is_4, bool binary)
      : out_(out), name_(std::move(name)), is_4_(is_4), binary_(binary) {}

  GmshRow<OutputFile> row() { return {out_, binary_}; }
  void begin(std::string_view section);
  /// Of a section whose numbers are binary in a binary file.
  void end_numbers(std::string_view section);
  void end(std::string_view section);

  void write_header();
  void write_names(std::span<const Group> names);
  void write_entities(const std::array<std::vector<GeometricEntity>, 4>& entities);
  /// What goes before the values of a view. @throws Error for more than it can hold
  void write_view_head(std::string_view section, std::string_view view, std::size_t components,
                       std::size_t count);

 private:
  void write_entity(const GeometricEntity& entity);

  OutputFile& out_;
  std::string name_;
  bool is_4_;
  bool binary_;
};

}  // namespace tetmend::formats
