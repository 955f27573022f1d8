// SPDX-License-Identifier: MIT
#include "trace/trace_frame.h"

#include <array>
#include <cstring>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <zstd.h>

namespace tetmend {

namespace {

constexpr std::array<char, 8> kMagic = {'T', 'E', 'T', 'T', 'R', 'A', 'C', '\n'};
/// The run waits for it: level -3 takes twice the time and saves a quarter of the file.
constexpr int kLevel = -16;
/// A frame may ask for this much, and for this many times the bytes that it has: far more than any
/// that is written.
constexpr std::uint64_t kFreeContent = std::uint64_t{1} << 20;
constexpr std::uint64_t kMostRatio = 64;

struct FrameHead {
  std::uint64_t content;  // bytes before compression
  std::uint64_t stored;
};

void check(std::size_t result) {
  if (ZSTD_isError(result) != 0) throw Error(ZSTD_getErrorName(result));
}

/// How much the blocks of a Zstandard frame can unpack to at most, whatever its head claims. Nothing
/// if the blocks do not end where the frame does. [RFC 8878, 3.1.1]
std::optional<std::uint64_t> most_content(std::span<const std::byte> frame) {
  const auto byte = [&](std::size_t i) { return std::to_integer<std::uint32_t>(frame[i]); };
  constexpr std::size_t kMagicBytes = 4;
  constexpr std::uint32_t kMostInBlock = 1u << 17;
  if (frame.size() <= kMagicBytes) return std::nullopt;
  const std::uint32_t flags = byte(kMagicBytes);
  const bool single = (flags & 32u) != 0;
  constexpr std::array<std::size_t, 4> kDictionaryBytes = {0, 1, 2, 4};
  constexpr std::array<std::size_t, 4> kSizeBytes = {0, 2, 4, 8};
  const std::size_t size_bytes = single && flags < 64 ? 1 : kSizeBytes[flags >> 6];
  std::size_t at = kMagicBytes + 1 + (single ? 0 : 1) + kDictionaryBytes[flags & 3u] + size_bytes;
  std::uint64_t most = 0;
  for (bool last = false; !last;) {
    if (at + 3 > frame.size()) return std::nullopt;
    const std::uint32_t head = byte(at) | byte(at + 1) << 8 | byte(at + 2) << 16;
    const std::uint32_t size = head >> 3;
    const std::uint32_t kind = head >> 1 & 3u;  // raw, repeated byte, compressed
    last = (head & 1u) != 0;
    most += kind == 2 ? kMostInBlock : size;
    at += 3 + (kind == 1 ? 1 : size);
  }
  at += (flags & 4u) != 0 ? 4 : 0;  // checksum
  return at == frame.size() ? std::optional(most) : std::nullopt;
}

}  // namespace

struct FrameWriter::Compressor {
  ZSTD_CCtx* context = ZSTD_createCCtx();

  Compressor() {
    if (context == nullptr) throw std::bad_alloc();
    check(ZSTD_CCtx_setParameter(context, ZSTD_c_compressionLevel, kLevel));
    check(ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1));
  }
  ~Compressor() { ZSTD_freeCCtx(context); }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;
};

FrameWriter::FrameWriter(const std::filesystem::path& file)
    : file_(std::in_place, file, formats::PendingFile::Name::part),
      compressor_(std::make_unique<Compressor>()) {
  begin();
}

FrameWriter::FrameWriter(std::string& memory)
    : memory_(&memory), compressor_(std::make_unique<Compressor>()) {
  begin();
}

void FrameWriter::begin() {
  std::array<std::byte, kTraceMagicSize> head{};
  std::memcpy(head.data(), kMagic.data(), kMagic.size());
  std::memcpy(head.data() + kMagic.size(), &kTraceVersion, sizeof kTraceVersion);
  write(head);
}

FrameWriter::~FrameWriter() = default;

std::span<const std::byte> FrameWriter::pack(std::span<const std::byte> content) {
  FrameHead head{content.size(), 0};
  const std::size_t most = ZSTD_compressBound(content.size());
  if (packed_.size() < sizeof head + most) packed_.resize(sizeof head + most);
  head.stored = ZSTD_compress2(compressor_->context, packed_.data() + sizeof head, most,
                               content.data(), content.size());
  check(head.stored);
  std::memcpy(packed_.data(), &head, sizeof head);
  return {packed_.data(), sizeof head + head.stored};
}

void FrameWriter::write(std::span<const std::byte> packed) {
  written_ += packed.size();
  const std::string_view bytes(reinterpret_cast<const char*>(packed.data()), packed.size());
  if (file_) return file_->write(bytes);
  memory_->append(bytes);
}

FrameReader::FrameReader(formats::InputFile file) : file_(std::move(file)) {
  if (file_.size() < kTraceMagicSize || std::memcmp(at(0), kMagic.data(), kMagic.size()) != 0) {
    throw Error(fmt::format("{}: is no trace of tetmend", file_.name()));
  }
  std::uint32_t version = 0;
  std::memcpy(&version, at(kMagic.size()), sizeof version);
  if (version != kTraceVersion) {
    throw Error(fmt::format("{}: is a trace of version {}; this tetmend knows version {}",
                            file_.name(), version, kTraceVersion));
  }
}

bool FrameReader::next() {
  if (next_ == file_.size()) return false;
  FrameHead head{};
  const std::size_t left = file_.size() - next_;
  if (left >= sizeof head) std::memcpy(&head, at(next_), sizeof head);
  if (left < sizeof head || head.stored > left - sizeof head) {
    damage_ = fmt::format("{}: byte {}: cut off or damaged", file_.name(), next_);
    return false;
  }
  offset_ = next_;
  next_ += sizeof head + head.stored;
  return true;
}

void FrameReader::unpack(std::size_t offset, std::vector<std::byte>& content) const {
  FrameHead head{};
  std::memcpy(&head, at(offset), sizeof head);
  const auto fail = [&](std::string_view reason) {
    throw Error(fmt::format("{}: byte {}: damaged: {}", file_.name(), offset, reason));
  };
  const std::span<const std::byte> packed(at(offset + sizeof head), head.stored);
  if (ZSTD_getFrameContentSize(packed.data(), packed.size()) != head.content) {
    fail("its two lengths differ");
  }
  // Room is made only for what the bytes that are there can fill.
  const std::optional<std::uint64_t> most = most_content(packed);
  if (!most || head.content > *most || head.content > kFreeContent + kMostRatio * packed.size()) {
    fail(fmt::format("{} bytes cannot hold {}", packed.size(), head.content));
  }
  content.resize(head.content);
  const std::size_t got =
      ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size());
  if (got != head.content) fail("its checksum or its compression is wrong");
}

}  // namespace tetmend
