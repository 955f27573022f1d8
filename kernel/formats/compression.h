// SPDX-License-Identifier: MIT
// zlib: whole files in gzip's format, and blocks of VTK files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace tetmend::formats {

bool is_gzip(std::string_view bytes);

/// No mesh is packed that well: whoever made the file wants to use memory up. Meshes are packed to a
/// tenth, and regular ones to a fiftieth.
constexpr bool is_bomb(std::size_t packed, std::size_t unpacked) {
  constexpr std::size_t kMostRatio = 200;
  constexpr std::size_t kFree = std::size_t{1} << 23;
  return unpacked > kFree && unpacked / kMostRatio > packed;
}

struct Inflated {
  std::unique_ptr<char[]> bytes;  ///< followed by a zero byte
  std::size_t size = 0;
};
/// All of a gzip file, of one member or several. Memory is taken as bytes come out; see is_bomb().
/// @throws Error with the reason, without the name of the file
Inflated inflate_gzip(std::string_view bytes);

/// A zlib block of `size` bytes to `to`. False if it is damaged or has another size.
bool inflate_block(std::string_view block, char* to, std::size_t size);
std::string deflate_block(std::string_view bytes);

/// CRC-32, as in gzip's format. @param before  that of the bytes before these
std::uint32_t checksum(std::string_view bytes, std::uint32_t before = 0);

/// Packs a stream into gzip's format; the same bytes give the same file.
class GzipWriter {
 public:
  using Sink = std::function<void(std::string_view)>;
  explicit GzipWriter(Sink sink);
  ~GzipWriter();
  GzipWriter(const GzipWriter&) = delete;
  GzipWriter& operator=(const GzipWriter&) = delete;

  void put(std::string_view bytes);
  void finish();

 private:
  struct Stream;
  void run(std::string_view bytes, int flush);

  Sink sink_;
  std::unique_ptr<Stream> stream_;
};

}  // namespace tetmend::formats
