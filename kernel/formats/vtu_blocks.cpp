// SPDX-License-Identifier: MIT
// Packed blocks of the arrays of a .vtu file.
#include "kernel/formats/vtu_blocks.h"

#include <algorithm>
#include <cstdint>

#ifdef TETMEND_HAS_LZMA
#include <lzma.h>
#endif

#include "kernel/formats/compression.h"

namespace tetmend::formats {
namespace {

/// A block of LZ4: sequences of a token, literals, and a copy of what came out before. The upper half of
/// a token counts literals, the lower one the bytes to copy less 4; 15 is followed by more.
class Lz4Block {
 public:
  Lz4Block(std::string_view in, char* to, std::size_t size) : in_(in), to_(to), size_(size) {}

  bool unpack() {
    while (!in_.empty()) {
      const unsigned token = next();
      std::size_t literals = token >> 4;
      if (!read_length(literals) || literals > in_.size() || literals > size_ - done_) return false;
      std::copy_n(in_.data(), literals, to_ + done_);
      in_.remove_prefix(literals);
      done_ += literals;
      if (in_.empty()) break;  // the last sequence has no copy
      if (in_.size() < 2) return false;
      std::size_t distance = next();
      distance |= std::size_t{next()} << 8;
      std::size_t length = token & 15U;
      if (!read_length(length)) return false;
      length += 4;
      if (distance == 0 || distance > done_ || length > size_ - done_) return false;
      for (; length > 0; --length, ++done_) to_[done_] = to_[done_ - distance];  // may overlap
    }
    return done_ == size_;
  }

 private:
  unsigned next() {
    const auto byte = static_cast<unsigned char>(in_.front());
    in_.remove_prefix(1);
    return byte;
  }
  bool read_length(std::size_t& length) {
    constexpr unsigned kMore = 255;
    if (length != 15) return true;
    for (unsigned more = kMore; more == kMore; length += more) {
      if (in_.empty()) return false;
      more = next();
    }
    return true;
  }

  std::string_view in_;
  char* to_;
  std::size_t size_;
  std::size_t done_ = 0;
};

bool unpack_lzma([[maybe_unused]] std::string_view block, [[maybe_unused]] char* to,
                 [[maybe_unused]] std::size_t size) {
#ifdef TETMEND_HAS_LZMA
  std::uint64_t most_memory = std::uint64_t{1} << 30;
  std::size_t in = 0;
  std::size_t out = 0;
  return ::lzma_stream_buffer_decode(
             &most_memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(block.data()), &in,
             block.size(), reinterpret_cast<std::uint8_t*>(to), &out, size) == LZMA_OK &&
         out == size;
#else
  return false;
#endif
}

}  // namespace

std::optional<VtuPacking> vtu_packing(std::string_view compressor) {
  if (compressor.empty()) return VtuPacking::none;
  if (compressor == "vtkZLibDataCompressor") return VtuPacking::zlib;
  if (compressor == "vtkLZ4DataCompressor") return VtuPacking::lz4;
  if (compressor == "vtkLZMADataCompressor") return VtuPacking::lzma;
  return {};
}

bool can_unpack([[maybe_unused]] VtuPacking packing) {
#ifdef TETMEND_HAS_LZMA
  return true;
#else
  return packing != VtuPacking::lzma;
#endif
}

bool unpack_block(VtuPacking packing, std::string_view block, char* to, std::size_t size) {
  switch (packing) {
    case VtuPacking::zlib:
      return inflate_block(block, to, size);
    case VtuPacking::lz4:
      return Lz4Block(block, to, size).unpack();
    case VtuPacking::lzma:
      return unpack_lzma(block, to, size);
    case VtuPacking::none:
      break;
  }
  return false;
}

}  // namespace tetmend::formats
