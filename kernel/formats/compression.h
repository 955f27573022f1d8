// SPDX-License-Identifier: MIT
// zlib: whole files in gzip's format, and blocks of VTK files.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace tetmend::formats {

bool is_gzip(std::string_view bytes);

struct Inflated {
  std::unique_ptr<char[]> bytes;  ///< followed by a zero byte
  std::size_t size = 0;
};
/// All of a gzip file, of one member or several. Memory is taken as bytes come out.
/// @throws Error with the reason, without the name of the file
Inflated inflate_gzip(std::string_view bytes);

/// A zlib block of `size` bytes to `to`. False if it is damaged or has another size.
bool inflate_block(std::string_view block, char* to, std::size_t size);
std::string deflate_block(std::string_view bytes);

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
