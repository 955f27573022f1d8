// SPDX-License-Identifier: MIT
#include "trace/trace_frame.h"

#include <array>
#include <cstring>

#include <fmt/format.h>
#include <zstd.h>

namespace tetmend {

namespace {

constexpr std::array<char, 8> kMagic = {'T', 'E', 'T', 'T', 'R', 'A', 'C', '\n'};
/// The run waits for it: level -3 takes twice the time and saves a quarter of the file.
constexpr int kLevel = -16;
/// More than any frame that is written, far less than what a damaged length may ask for.
constexpr std::uint64_t kMostContent = std::uint64_t{1} << 36;

struct FrameHead {
  std::uint64_t content;  // bytes before compression
  std::uint64_t stored;
};

void check(std::size_t result) {
  if (ZSTD_isError(result) != 0) throw Error(ZSTD_getErrorName(result));
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
    : file_(file, formats::PendingFile::Name::part), compressor_(std::make_unique<Compressor>()) {
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
  file_.write({reinterpret_cast<const char*>(packed.data()), packed.size()});
}

FrameReader::FrameReader(const std::filesystem::path& file) : file_(file) {
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
  const std::byte* packed = at(offset + sizeof head);
  const auto size = ZSTD_getFrameContentSize(packed, head.stored);
  if (head.content <= kMostContent && size == head.content) {
    content.resize(head.content);
    if (ZSTD_decompress(content.data(), content.size(), packed, head.stored) == head.content) {
      return;
    }
  }
  throw Error(fmt::format("{}: byte {}: damaged", file_.name(), offset));
}

}  // namespace tetmend
