// SPDX-License-Identifier: MIT
// The frames of a trace file: compressed pieces, each with its length and a checksum.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kernel/error.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/pending_file.h"

namespace tetmend {

/// First bytes of every trace file, the version of the format included.
inline constexpr std::size_t kTraceMagicSize = 12;
inline constexpr std::uint32_t kTraceVersion = 2;

/// Writes frames into FILE.part, each at once. So a crash costs only what was not handed over yet.
/// Without a commit of file(), short of a crash, FILE.part vanishes.
class FrameWriter {
 public:
  /// @throws Error when the file cannot be written.
  explicit FrameWriter(const std::filesystem::path& file);
  /// Appends to `memory`, which outlives this; there is no file then.
  explicit FrameWriter(std::string& memory);
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  bool is_in_memory() const { return memory_ != nullptr; }
  /// Bytes so far.
  std::size_t written() const { return written_; }
  /// Compresses; the bytes of a frame as they are to be written, valid until the next call.
  std::span<const std::byte> pack(std::span<const std::byte> content);
  /// @throws Error when the disk is full.
  void write(std::span<const std::byte> packed);
  /// What is to get its name when all is written. Precondition: !is_in_memory().
  formats::PendingFile& file() { return *file_; }

 private:
  struct Compressor;

  void begin();

  std::optional<formats::PendingFile> file_;
  std::string* memory_ = nullptr;
  std::size_t written_ = 0;
  std::unique_ptr<Compressor> compressor_;
  std::vector<std::byte> packed_;
};

/// Takes a file apart into frames.
class FrameReader {
 public:
  /// Reads the file, as it is.
  /// @throws Error when it cannot be read, is no trace, or is of a version that is not known here.
  explicit FrameReader(const std::filesystem::path& file) : FrameReader(formats::InputFile(file)) {}
  /// The same, of bytes that are there already.
  explicit FrameReader(formats::InputFile file);

  /// Finds the next frame. False at the end of the file, or when it is cut off or damaged there:
  /// then damage() says so.
  bool next();
  /// Where the frame that was found last lies in the file.
  std::size_t offset() const { return offset_; }
  /// Nothing if all is well so far.
  const std::string& damage() const { return damage_; }
  /// The content of the frame at `offset`, which next() found.
  /// Takes no more memory than the bytes of the frame can fill.
  /// @throws Error when it is damaged.
  void unpack(std::size_t offset, std::vector<std::byte>& content) const;
  std::size_t file_size() const { return file_.size(); }

 private:
  const std::byte* at(std::size_t offset) const {
    return reinterpret_cast<const std::byte*>(file_.begin()) + offset;
  }

  formats::InputFile file_;
  std::size_t offset_ = 0;
  std::size_t next_ = kTraceMagicSize;
  std::string damage_;
};

}  // namespace tetmend
