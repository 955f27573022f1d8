// SPDX-License-Identifier: MIT
#include "kernel/formats/vtu_array.h"

#include <bit>
#include <utility>

#include <fmt/format.h>

#include "kernel/formats/base64.h"
#include "kernel/formats/compression.h"
#include "kernel/printable.h"

namespace tetmend::formats {
namespace {

constexpr std::size_t kVtuBlockSize = std::size_t{1} << 17;

}  // namespace

void VtuBlocks::put(std::string_view bytes, const Sink& sink) {
  size_ += bytes.size();
  if (!waiting_.empty()) {
    const std::string_view first = bytes.substr(0, kVtuBlockSize - waiting_.size());
    waiting_ += first;
    bytes.remove_prefix(first.size());
    if (waiting_.size() < kVtuBlockSize) return;
    pack(waiting_, sink);
    waiting_.clear();
  }
  for (; bytes.size() >= kVtuBlockSize; bytes.remove_prefix(kVtuBlockSize)) {
    pack(bytes.substr(0, kVtuBlockSize), sink);
  }
  waiting_ = bytes;
}

void VtuBlocks::finish(const Sink& sink) {
  if (!waiting_.empty()) pack(waiting_, sink);
  waiting_.clear();
}

void VtuBlocks::pack(std::string_view block, const Sink& sink) {
  const std::string packed = deflate_block(block);
  packed_sizes_.push_back(packed.size());
  sink(packed);
}

std::vector<std::uint64_t> VtuBlocks::header() const {
  std::vector<std::uint64_t> header = {packed_sizes_.size(), kVtuBlockSize, size_ % kVtuBlockSize};
  header.insert(header.end(), packed_sizes_.begin(), packed_sizes_.end());
  return header;
}

VtuArray::VtuArray(std::string_view name, std::string_view type, std::size_t components)
    : tag_(vtu_array_tag(name, type, components)) {}

void VtuArray::measure(std::string_view bytes) {
  measured_.put(bytes, [](std::string_view) {});
}

void VtuArray::begin(OutputFile& out) {
  measured_.finish([](std::string_view) {});
  const std::vector<std::uint64_t> header = measured_.header();
  out.put(tag_);
  out.put(encode_base64(
      {reinterpret_cast<const char*>(header.data()), header.size() * sizeof(std::uint64_t)}));
}

void VtuArray::write(std::string_view bytes, OutputFile& out) {
  written_.put(bytes, [&](std::string_view packed) { write_packed(packed, out); });
}

/// Three bytes are four characters, wherever a block ends.
void VtuArray::write_packed(std::string_view packed, OutputFile& out) {
  waiting_ += packed;
  const std::size_t whole = waiting_.size() / 3 * 3;
  out.put(encode_base64(std::string_view(waiting_).substr(0, whole)));
  waiting_.erase(0, whole);
}

void VtuArray::end(OutputFile& out) {
  written_.finish([&](std::string_view packed) { write_packed(packed, out); });
  out.put(encode_base64(waiting_));
  out.put(kVtuArrayEnd);
}

std::string xml_escaped(std::string_view text) {
  std::string result;
  for (const char c : printable(text)) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string_view vtu_type_of(const DataArray& array) {
  constexpr std::array<std::string_view, 4> kTypes = {"Int32", "Int64", "Float32", "Float64"};
  return kTypes[array.values.index()];
}

std::string vtu_components(std::size_t components) {
  return components == 1 ? "" : fmt::format(" NumberOfComponents=\"{}\"", components);
}

std::string vtu_array_tag(std::string_view name, std::string_view type, std::size_t components,
                          bool is_text, bool is_id) {
  return fmt::format("<DataArray type=\"{}\" {}Name=\"{}\"{} format=\"{}\">\n", type,
                     is_id ? "IdType=\"1\" " : "", xml_escaped(name), vtu_components(components),
                     is_text ? "ascii" : "binary");
}

std::string vtu_head(std::uint64_t points, std::uint64_t cells) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
      "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", points, cells);
}

}  // namespace tetmend::formats
