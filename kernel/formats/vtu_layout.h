// SPDX-License-Identifier: MIT
// Where things stand in a VTU file that is too large to be held in memory, and its arrays, some
// rows at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kernel/formats/file_bytes.h"
#include "kernel/formats/vtu_numbers.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// The XML of a file without its numbers.
struct VtuOutline {
  /// The numbers between the tags of an array, if they stand there.
  struct Content {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    std::uint64_t words = 0;  ///< of text
    /// Where each kWordsOfStep words of text begin.
    std::vector<std::uint64_t> steps;
  };
  static constexpr std::uint64_t kWordsOfStep = std::uint64_t{1} << 15;

  std::string xml;
  std::vector<Content> contents;  ///< of each DataArray, in the order of the file
  std::uint64_t appended = 0;     ///< where the appended data begin; 0: there are none
  std::uint64_t size = 0;         ///< of the file
};

/// Reads the file once, a part at a time. @returns nothing for one that is not so, or has comments
std::optional<VtuOutline> outline_vtu(const std::filesystem::path& file);

/// An array of a file.
struct VtuColumn {
  enum class Coding { text, base64, raw };

  std::string name;
  const VtuType* type = nullptr;
  std::size_t components = 1;
  Coding coding = Coding::text;
  std::size_t content = 0;  ///< which of VtuOutline::contents
  std::uint64_t begin = 0;  ///< of what is no text: its head
  std::uint64_t end = 0;
};

struct VtuLayout {
  bool swap = false;
  bool is_packed = false;
  std::size_t header_size = 4;
  std::uint64_t points = 0;
  std::uint64_t cells = 0;
  VtuColumn places, connectivity, offsets, types;
  std::vector<VtuColumn> point_data, cell_data;
  std::vector<std::string> notes;  ///< as MeshData has them
};

/// @returns nothing for a file of several pieces or without cells, and where read_vtu() complains
std::optional<VtuLayout> lay_out_vtu(const VtuOutline& outline);

/// Reads rows of an array.
class VtuRows {
 public:
  /// Outline and layout must outlive it. @throws Error for an array that is damaged or has another
  /// size; also for blocks that are too large for this way of reading
  VtuRows(const std::filesystem::path& file, const VtuOutline& outline, const VtuLayout& layout,
          const VtuColumn& column, std::uint64_t rows);

  const VtuColumn& column() const { return column_; }
  /// Rows `first` to `first + count - 1`. @throws Error where they are damaged
  DataArray::Values read(std::uint64_t first, std::size_t count);
  /// The same of integers. @throws Error also for other numbers
  std::vector<std::int64_t> integers(std::uint64_t first, std::size_t count);

 private:
  /// Bytes as they stand in the file, or as base64.
  struct Stream {
    std::uint64_t begin = 0;
    std::uint64_t skipped = 0;  ///< bytes between there and the first that counts
  };

  std::string encoded(const Stream& stream, std::uint64_t begin, std::size_t size);
  Stream behind(const Stream& head, std::uint64_t size);
  std::uint64_t header(const std::string& bytes, std::size_t i) const;
  void open_blocks(const Stream& head);
  std::string bytes(std::uint64_t begin, std::size_t size);
  const std::string& block(std::size_t i);
  DataArray::Values parse(std::uint64_t first, std::size_t count);
  template <class Value>
  std::vector<Value> parse_as(std::uint64_t first, std::size_t count);
  [[noreturn]] void fail() const;

  FileBytes file_;
  const VtuOutline& outline_;
  const VtuLayout& layout_;
  const VtuColumn& column_;
  std::uint64_t size_;  // of all, in bytes, or words of text
  Stream data_;
  std::uint64_t block_size_ = 0;
  std::vector<std::uint64_t> blocks_;  // where each begins in the data, and where the last one ends
  std::size_t block_ = SIZE_MAX;       // that is unpacked
  std::string unpacked_;
};

}  // namespace tetmend::formats
