// SPDX-License-Identifier: MIT
// zlib: whole files in gzip's format, and blocks of VTK files.
#include "kernel/formats/compression.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cstring>
#include <new>
#include <utility>

#include <zlib.h>

#include "kernel/error.h"

namespace tetmend::formats {

namespace {

constexpr int kGzip = 15 + 16;  // zlib: largest window, with gzip's header

/// zlib counts in 32 bits.
uInt clipped(std::size_t size) {
  return static_cast<uInt>(std::min<std::size_t>(size, UINT_MAX));
}

Bytef* as_bytes(const char* bytes) {
  return reinterpret_cast<Bytef*>(const_cast<char*>(bytes));
}

class Inflater {
 public:
  Inflater() {
    if (::inflateInit2(&stream_, kGzip) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { ::inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  z_stream& get() { return stream_; }

 private:
  z_stream stream_{};
};

}  // namespace

bool is_gzip(std::string_view bytes) {
  return bytes.starts_with("\x1f\x8b");
}

Inflated inflate_gzip(std::string_view bytes) {
  constexpr std::size_t kLeast = std::size_t{1} << 16;
  const std::size_t packed = bytes.size();
  Inflater inflater;
  z_stream& stream = inflater.get();
  std::size_t capacity = std::max(kLeast, 4 * bytes.size());
  Inflated result{std::unique_ptr<char[]>(new char[capacity + 1]), 0};
  int status = Z_OK;
  while (status != Z_STREAM_END || !bytes.empty()) {
    if (status == Z_STREAM_END) ::inflateReset(&stream);
    if (result.size == capacity) {
      std::unique_ptr<char[]> larger(new char[2 * capacity + 1]);
      std::memcpy(larger.get(), result.bytes.get(), result.size);
      result.bytes = std::move(larger);
      capacity *= 2;
    }
    stream.next_in = as_bytes(bytes.data());
    stream.avail_in = clipped(bytes.size());
    stream.next_out = as_bytes(result.bytes.get() + result.size);
    stream.avail_out = clipped(capacity - result.size);
    const uInt in = stream.avail_in;
    const uInt out = stream.avail_out;
    status = ::inflate(&stream, Z_NO_FLUSH);
    bytes.remove_prefix(in - stream.avail_in);
    result.size += out - stream.avail_out;
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (is_bomb(packed, result.size)) {
      throw Error("the gzip file holds hundreds of times its size, which no mesh does");
    }
    if (status == Z_BUF_ERROR && result.size == capacity) status = Z_OK;
    if (status != Z_OK && status != Z_STREAM_END) {
      throw Error(bytes.empty() ? "the gzip file is truncated" : "the gzip file is damaged");
    }
  }
  result.bytes[result.size] = '\0';
  return result;
}

std::uint32_t checksum(std::string_view bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(::crc32_z(before, as_bytes(bytes.data()), bytes.size()));
}

bool inflate_block(std::string_view block, char* to, std::size_t size) {
  const std::size_t packed = block.size();
  // zlib's numbers have 32 bits on Windows.
  if (!std::in_range<uLong>(size) || !std::in_range<uLong>(packed)) return false;
  auto got = static_cast<uLongf>(size);
  return ::uncompress(as_bytes(to), &got, as_bytes(block.data()), static_cast<uLong>(packed)) ==
             Z_OK &&
         got == size;
}

std::string deflate_block(std::string_view bytes) {
  const auto plain = static_cast<uLong>(bytes.size());  // what we write is cut into small blocks
  uLongf size = ::compressBound(plain);
  std::string block(size, '\0');
  if (::compress2(as_bytes(block.data()), &size, as_bytes(bytes.data()), plain, 1) != Z_OK) {
    throw std::bad_alloc();
  }
  block.resize(size);
  return block;
}

struct GzipWriter::Stream {
  z_stream z{};
  gz_header head{};
  std::array<char, std::size_t{1} << 16> out{};
};

GzipWriter::GzipWriter(Sink sink) : sink_(std::move(sink)), stream_(std::make_unique<Stream>()) {
  constexpr int kMemoryLevel = 8;
  if (::deflateInit2(&stream_->z, 6, Z_DEFLATED, kGzip, kMemoryLevel, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  constexpr int kUnix = 3;  // said on all systems: the same bytes
  stream_->head.os = kUnix;
  ::deflateSetHeader(&stream_->z, &stream_->head);
}

GzipWriter::~GzipWriter() {
  ::deflateEnd(&stream_->z);
}

void GzipWriter::put(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::string_view part = bytes.substr(0, UINT_MAX);
    run(part, Z_NO_FLUSH);
    bytes.remove_prefix(part.size());
  }
}

void GzipWriter::finish() {
  run({}, Z_FINISH);
}

void GzipWriter::run(std::string_view bytes, int flush) {
  z_stream& z = stream_->z;
  z.next_in = as_bytes(bytes.data());
  z.avail_in = clipped(bytes.size());
  do {
    z.next_out = as_bytes(stream_->out.data());
    z.avail_out = clipped(stream_->out.size());
    ::deflate(&z, flush);
    sink_({stream_->out.data(), stream_->out.size() - z.avail_out});
  } while (z.avail_out == 0);
}

}  // namespace tetmend::formats
