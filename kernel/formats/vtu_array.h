// SPDX-License-Identifier: MIT
// An array of a VTK XML file as write_vtu() writes it: inline base64, in blocks of zlib.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/data.h>

#include "kernel/formats/output_file.h"

namespace tetmend::formats {

/// Packs bytes that come some at a time.
class VtuBlocks {
 public:
  /// Called for each block when it is full, and for the last one.
  using Sink = std::function<void(std::string_view packed)>;

  void put(std::string_view bytes, const Sink& sink);
  /// No more bytes come.
  void finish(const Sink& sink);
  /// Behind finish(): number of blocks, their size, size of the last one if it is not full; then packed
  /// sizes.
  std::vector<std::uint64_t> header() const;

 private:
  void pack(std::string_view block, const Sink& sink);

  std::string waiting_;
  std::uint64_t size_ = 0;
  std::vector<std::uint64_t> packed_sizes_;
};

/// An array whose bytes nobody has at once. They come twice: first to learn what goes before them, then to
/// be written.
class VtuArray {
 public:
  VtuArray(std::string_view name, std::string_view type, std::size_t components);

  void measure(std::string_view bytes);
  /// Ends measuring.
  void begin(OutputFile& out);
  void write(std::string_view bytes, OutputFile& out);
  void end(OutputFile& out);

 private:
  void write_packed(std::string_view packed, OutputFile& out);

  std::string tag_;
  VtuBlocks measured_;
  VtuBlocks written_;
  std::string waiting_;  // for a group of three bytes
};

/// As the value of an attribute: printable().
std::string xml_escaped(std::string_view text);
/// As files name the type of its numbers.
std::string_view vtu_type_of(const DataArray& array);
/// The attribute of how many, with a blank in front. None for one: meshio makes a table of an array that
/// has it.
std::string vtu_components(std::size_t components);
/// What stands before the content of an array, which follows as two streams of base64: header() of its
/// blocks, and the blocks; or as text.
/// @param is_id  VTK's vtkIdType, which the type must be
std::string vtu_array_tag(std::string_view name, std::string_view type, std::size_t components,
                          bool is_text = false, bool is_id = false);
inline constexpr std::string_view kVtuArrayEnd = "\n</DataArray>\n";
/// The first lines of a file, to the counts of its piece.
std::string vtu_head(std::uint64_t points, std::uint64_t cells);
inline constexpr std::string_view kVtuEnd = "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";

}  // namespace tetmend::formats
