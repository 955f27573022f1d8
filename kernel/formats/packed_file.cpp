// SPDX-License-Identifier: MIT
// Whole files that are packed: by gzip, bzip2, xz or Zstandard.
#include "kernel/formats/packed_file.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cstring>
#include <new>
#include <utility>

#include <fmt/format.h>

#ifdef TETMEND_HAS_BZIP2
#include <bzlib.h>
#endif
#ifdef TETMEND_HAS_LZMA
#include <lzma.h>
#endif
#include <zstd.h>

#include "kernel/error.h"

namespace tetmend::formats {
namespace {

/// What comes out of a packed file, in memory that grows.
class Unpacked {
 public:
  Unpacked(std::string_view packed, std::string_view name)
      : packed_(packed.size()), name_(name), capacity_(std::max(kLeast, 4 * packed.size())) {
    result_.bytes.reset(new char[capacity_ + 1]);
  }

  char* next() { return result_.bytes.get() + result_.size; }
  /// At least 1.
  std::size_t room() {
    if (result_.size == capacity_) {
      std::unique_ptr<char[]> larger(new char[2 * capacity_ + 1]);
      std::memcpy(larger.get(), result_.bytes.get(), result_.size);
      result_.bytes = std::move(larger);
      capacity_ *= 2;
    }
    return capacity_ - result_.size;
  }
  void took(std::size_t bytes) {
    result_.size += bytes;
    if (!is_bomb(packed_, result_.size)) return;
    throw Error(
        fmt::format("the {} file holds hundreds of times its size, which no mesh does", name_));
  }
  Inflated finish() {
    result_.bytes[result_.size] = '\0';
    return std::move(result_);
  }
  [[noreturn]] void fail(bool is_cut) const {
    throw Error(fmt::format("the {} file is {}", name_, is_cut ? "truncated" : "damaged"));
  }

 private:
  static constexpr std::size_t kLeast = std::size_t{1} << 16;

  std::size_t packed_;
  std::string_view name_;
  std::size_t capacity_;
  Inflated result_;
};

#ifdef TETMEND_HAS_BZIP2
/// Counts in 32 bits.
unsigned bzip2_size(std::size_t size) {
  return static_cast<unsigned>(std::min<std::size_t>(size, UINT_MAX));
}

class Bzip2Stream {
 public:
  Bzip2Stream() {
    if (::BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  ~Bzip2Stream() { ::BZ2_bzDecompressEnd(&stream); }
  Bzip2Stream(const Bzip2Stream&) = delete;
  Bzip2Stream& operator=(const Bzip2Stream&) = delete;

  bz_stream stream{};
};

Inflated unpack_bzip2(std::string_view bytes) {
  Unpacked out(bytes, "bzip2");
  while (!bytes.empty()) {
    Bzip2Stream one;
    for (int status = BZ_OK; status != BZ_STREAM_END;) {
      one.stream.next_in = const_cast<char*>(bytes.data());
      one.stream.avail_in = bzip2_size(bytes.size());
      one.stream.avail_out = bzip2_size(out.room());
      one.stream.next_out = out.next();
      const unsigned in = one.stream.avail_in;
      const unsigned room = one.stream.avail_out;
      status = ::BZ2_bzDecompress(&one.stream);
      bytes.remove_prefix(in - one.stream.avail_in);
      out.took(room - one.stream.avail_out);
      if (status == BZ_MEM_ERROR) throw std::bad_alloc();
      if (status != BZ_OK && status != BZ_STREAM_END) out.fail(false);
      if (status == BZ_OK && bytes.empty() && one.stream.avail_out == room) out.fail(true);
    }
  }
  return out.finish();
}
#endif

#ifdef TETMEND_HAS_LZMA
class LzmaStream {
 public:
  LzmaStream() {
    constexpr std::uint64_t kMostMemory = std::uint64_t{1} << 30;
    if (::lzma_stream_decoder(&stream, kMostMemory, LZMA_CONCATENATED) != LZMA_OK) {
      throw std::bad_alloc();
    }
  }
  ~LzmaStream() { ::lzma_end(&stream); }
  LzmaStream(const LzmaStream&) = delete;
  LzmaStream& operator=(const LzmaStream&) = delete;

  lzma_stream stream = LZMA_STREAM_INIT;
};

Inflated unpack_xz(std::string_view bytes) {
  Unpacked out(bytes, "xz");
  LzmaStream one;
  one.stream.next_in = reinterpret_cast<const std::uint8_t*>(bytes.data());
  one.stream.avail_in = bytes.size();
  for (lzma_ret status = LZMA_OK; status != LZMA_STREAM_END;) {
    const std::size_t room = out.room();
    one.stream.next_out = reinterpret_cast<std::uint8_t*>(out.next());
    one.stream.avail_out = room;
    status = ::lzma_code(&one.stream, LZMA_FINISH);
    out.took(room - one.stream.avail_out);
    if (status == LZMA_MEM_ERROR) throw std::bad_alloc();
    if (status != LZMA_OK && status != LZMA_STREAM_END) out.fail(status == LZMA_BUF_ERROR);
  }
  return out.finish();
}
#endif

Inflated unpack_zstd(std::string_view bytes) {
  Unpacked out(bytes, "Zstandard");
  const std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream(::ZSTD_createDStream(),
                                                                             ::ZSTD_freeDStream);
  if (stream == nullptr) throw std::bad_alloc();
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  for (std::size_t left = 1; in.pos < in.size || left != 0;) {
    const std::size_t room = out.room();
    ZSTD_outBuffer to{out.next(), room, 0};
    const std::size_t before = in.pos;
    left = ::ZSTD_decompressStream(stream.get(), &to, &in);
    if (::ZSTD_isError(left) != 0) out.fail(false);
    out.took(to.pos);
    if (left != 0 && to.pos == 0 && in.pos == before) out.fail(true);
  }
  return out.finish();
}

struct Packing {
  std::string_view extension;
  std::string_view begin;  ///< of the file
  std::string_view library;
  Inflated (*unpack)(std::string_view);  ///< null: tetmend is built without it
};

constexpr std::array<Packing, 4> kPackings = {{
    {".gz", "\x1f\x8b", "zlib", inflate_gzip},
#ifdef TETMEND_HAS_BZIP2
    {".bz2", "BZh", "libbz2", unpack_bzip2},
#else
    {".bz2", "BZh", "libbz2", nullptr},
#endif
#ifdef TETMEND_HAS_LZMA
    {".xz", std::string_view("\xfd\x37zXZ\0", 6), "liblzma", unpack_xz},
#else
    {".xz", std::string_view("\xfd\x37zXZ\0", 6), "liblzma", nullptr},
#endif
    {".zst", "\x28\xb5\x2f\xfd", "libzstd", unpack_zstd},
}};

const Packing* find_packing(std::string_view bytes) {
  const auto* const found =
      std::find_if(kPackings.begin(), kPackings.end(),
                   [&](const Packing& packing) { return bytes.starts_with(packing.begin); });
  return found == kPackings.end() ? nullptr : found;
}

}  // namespace

bool is_packed(std::string_view bytes) {
  return find_packing(bytes) != nullptr;
}

Inflated unpack(std::string_view bytes) {
  const Packing& packing = *find_packing(bytes);
  if (packing.unpack != nullptr) return packing.unpack(bytes);
  throw Error(fmt::format("the file is packed as {} files are, and tetmend is built without {}",
                          packing.extension, packing.library));
}

bool has_packed_name(const std::filesystem::path& file) {
  return std::any_of(kPackings.begin(), kPackings.end(),
                     [&](const Packing& packing) { return file.extension() == packing.extension; });
}

void check_packing_to_write(const std::filesystem::path& file) {
  if (!has_packed_name(file) || file.extension() == ".gz") return;
  throw Error(
      fmt::format("{}: files that end in {} are read, but not written: expected .gz or none",
                  file.string(), file.extension().string()));
}

}  // namespace tetmend::formats
