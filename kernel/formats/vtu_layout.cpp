// SPDX-License-Identifier: MIT
// The format: kernel/formats/vtu_reader.cpp, which reads all that is refused here, or says why not.
#include "kernel/formats/vtu_layout.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "kernel/error.h"
#include "kernel/formats/base64.h"
#include "kernel/formats/byte_reader.h"
#include "kernel/formats/compression.h"
#include "kernel/formats/element_checks.h"
#include "kernel/from_chars.h"

namespace tetmend::formats {

namespace {

/// Thrown where a file is not as the header says.
struct NotPlain {};

void expect(bool is_plain) {
  if (!is_plain) throw NotPlain();
}

bool is_white(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Passes over the XML, character by character.
class Outliner {
 public:
  explicit Outliner(const std::filesystem::path& file) : file_(file) {}

  VtuOutline run() {
    constexpr std::size_t kMostXml = std::size_t{1} << 24;
    outline_.size = file_.size();
    bool is_array = false;
    while (outline_.appended == 0) {
      if (!pass_over_text(is_array ? &outline_.contents.back() : nullptr)) break;
      expect(outline_.xml.size() < kMostXml);
      is_array = take_tag();
    }
    return std::move(outline_);
  }

 private:
  /// The next character; 0 at the end of the file.
  char look() {
    if (at_ == end_) {
      constexpr std::size_t kAtOnce = std::size_t{1} << 18;
      begin_ = position();
      const std::size_t some = std::min<std::uint64_t>(kAtOnce, file_.size() - begin_);
      at_ = buffer_ = file_.read(begin_, some);
      end_ = buffer_ + some;
      if (some == 0) return '\0';
    }
    return *at_;
  }
  std::uint64_t position() const { return begin_ + static_cast<std::uint64_t>(at_ - buffer_); }

  /// Up to the next tag. False if there is none.
  bool pass_over_text(VtuOutline::Content* content) {
    if (content != nullptr) content->begin = position();
    bool is_inside = false;  // a word
    for (char c = look(); c != '<'; ++at_, c = look()) {
      if (c == '\0') {
        expect(at_ == end_);
        return false;
      }
      if (content == nullptr) continue;
      if (!is_white(c) && !is_inside && content->words++ % VtuOutline::kWordsOfStep == 0) {
        content->steps.push_back(position());
      }
      is_inside = !is_white(c);
    }
    if (content != nullptr) content->end = position();
    return true;
  }

  /// True if it opens an array, whose numbers may follow.
  bool take_tag() {
    const std::size_t first = outline_.xml.size();
    char quote = '\0';
    char c = '\0';
    do {
      c = look();
      expect(c != '\0');
      outline_.xml += c;
      ++at_;
      if (quote != '\0') {
        if (c == quote) quote = '\0';
      } else if (c == '"' || c == '\'') {
        quote = c;
      }
      expect(outline_.xml.size() - first < std::size_t{1} << 16);
    } while (c != '>' || quote != '\0');
    const std::string_view tag = std::string_view(outline_.xml).substr(first);
    expect(!tag.starts_with("<!"));
    if (tag.ends_with("/>")) return false;
    if (tag.starts_with("<AppendedData")) {
      begin_appended();  // `tag` is gone
      return false;
    }
    constexpr std::string_view kArray = "<DataArray";
    if (!tag.starts_with(kArray) || is_name(tag[kArray.size()])) return false;
    // A number by which it is found again.
    outline_.xml.insert(first + kArray.size(),
                        fmt::format(" tetmend_content=\"{}\"", outline_.contents.size()));
    outline_.contents.emplace_back();
    return true;
  }
  static bool is_name(char c) { return c != '>' && c != '/' && !is_white(c); }

  void begin_appended() {
    while (look() != '_') {
      expect(is_white(look()));
      ++at_;
    }
    outline_.appended = position() + 1;
    outline_.xml += "</AppendedData></VTKFile>";
  }

  FileBytes file_;
  VtuOutline outline_;
  std::uint64_t begin_ = 0;  // of the buffer
  const char* buffer_ = nullptr;
  const char* at_ = nullptr;
  const char* end_ = nullptr;
};

/// From the XML to the arrays that a mesh needs.
class Layouter {
 public:
  explicit Layouter(const VtuOutline& outline) : outline_(outline) {}

  VtuLayout run() {
    expect(static_cast<bool>(document_.load_buffer(outline_.xml.data(), outline_.xml.size())));
    const pugi::xml_node root = document_.child("VTKFile");
    read_head(root);
    const pugi::xml_node grid = root.child("UnstructuredGrid");
    if (grid.child("FieldData")) layout_.notes.emplace_back("the field data are not kept");
    const pugi::xml_node piece = grid.child("Piece");
    expect(piece && !piece.next_sibling("Piece"));
    layout_.points = count(piece, "NumberOfPoints");
    layout_.cells = count(piece, "NumberOfCells");
    expect(layout_.points > 0 && layout_.points <= kMostVertices && layout_.cells > 0);
    layout_.places = column(piece.child("Points").child("DataArray"));
    expect(layout_.places.components == 3);
    layout_.connectivity = cell_column(piece, "connectivity");
    layout_.offsets = cell_column(piece, "offsets");
    layout_.types = cell_column(piece, "types");
    add_arrays(piece.child("PointData"), layout_.point_data);
    add_arrays(piece.child("CellData"), layout_.cell_data);
    return std::move(layout_);
  }

 private:
  void read_head(const pugi::xml_node& root) {
    expect(std::string_view(root.attribute("type").as_string()) == "UnstructuredGrid");
    const std::string_view order = root.attribute("byte_order").as_string("LittleEndian");
    expect(order == "LittleEndian" || order == "BigEndian");
    layout_.swap = (order == "LittleEndian") != (std::endian::native == std::endian::little);
    const std::string_view header = root.attribute("header_type").as_string("UInt32");
    expect(header == "UInt32" || header == "UInt64");
    layout_.header_size = header == "UInt32" ? 4 : 8;
    const std::string_view compressor = root.attribute("compressor").as_string();
    expect(compressor.empty() || compressor == "vtkZLibDataCompressor");
    layout_.is_packed = !compressor.empty();
    const std::string_view encoding =
        root.child("AppendedData").attribute("encoding").as_string("base64");
    expect(encoding == "raw" || encoding == "base64");
    is_raw_ = encoding == "raw";
  }

  static std::uint64_t count(const pugi::xml_node& node, const char* name) {
    const std::string_view word = node.attribute(name).as_string();
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    expect(!word.empty() && error == std::errc() && end == word.data() + word.size());
    return value;
  }

  VtuColumn column(const pugi::xml_node& node) const {
    expect(static_cast<bool>(node));
    VtuColumn made;
    made.name = node.attribute("Name").as_string();
    made.type = find_vtu_type(node.attribute("type").as_string());
    expect(made.type != nullptr);
    if (node.attribute("NumberOfComponents")) made.components = count(node, "NumberOfComponents");
    const std::string_view format = node.attribute("format").as_string("ascii");
    expect(format == "ascii" || format == "binary" || format == "appended");
    if (format == "appended") {
      const std::uint64_t offset = count(node, "offset");
      expect(outline_.appended > 0 && offset <= outline_.size - outline_.appended);
      made.coding = is_raw_ ? VtuColumn::Coding::raw : VtuColumn::Coding::base64;
      made.begin = outline_.appended + offset;
      made.end = outline_.size;
      return made;
    }
    made.content = count(node, "tetmend_content");
    expect(made.content < outline_.contents.size());
    const VtuOutline::Content& content = outline_.contents[made.content];
    if (format == "ascii") return made;
    made.coding = VtuColumn::Coding::base64;
    made.begin = content.steps.empty() ? content.end : content.steps.front();
    made.end = content.end;
    return made;
  }

  VtuColumn cell_column(const pugi::xml_node& piece, std::string_view name) const {
    for (const pugi::xml_node node : piece.child("Cells").children("DataArray")) {
      if (node.attribute("Name").as_string() != name) continue;
      VtuColumn found = column(node);
      found.components = 1;
      expect(found.type->kind != VtuType::Kind::real);
      return found;
    }
    throw NotPlain();
  }

  void add_arrays(const pugi::xml_node& parent, std::vector<VtuColumn>& columns) {
    std::set<std::pair<std::string, std::size_t>> known;
    for (const pugi::xml_node node : parent.children("DataArray")) {
      if (find_vtu_type(node.attribute("type").as_string()) == nullptr) {
        layout_.notes.push_back(fmt::format("the array {} is not kept: it holds no numbers",
                                            in_quotes(node.attribute("Name").as_string())));
        continue;
      }
      const bool has_no_values =
          node.attribute("NumberOfComponents") && count(node, "NumberOfComponents") == 0;
      if (has_no_values) continue;
      VtuColumn made = column(node);
      expect(known.insert({made.name, made.components}).second);
      columns.push_back(std::move(made));
    }
  }

  const VtuOutline& outline_;
  pugi::xml_document document_;
  VtuLayout layout_;
  bool is_raw_ = false;
};

}  // namespace

std::optional<VtuOutline> outline_vtu(const std::filesystem::path& file) {
  try {
    return Outliner(file).run();
  } catch (const NotPlain&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<VtuLayout> lay_out_vtu(const VtuOutline& outline) {
  try {
    return Layouter(outline).run();
  } catch (const NotPlain&) {
    return std::nullopt;
  }
}

VtuRows::VtuRows(const std::filesystem::path& file, const VtuOutline& outline,
                 const VtuLayout& layout, const VtuColumn& column, std::uint64_t rows)
    : file_(file), outline_(outline), layout_(layout), column_(column), size_(0) {
  constexpr std::uint64_t kBestPacking = 1032;  // as read_vtu()
  const std::uint64_t most = (layout.is_packed ? kBestPacking : 2) * outline.size;
  if (rows > most / column.components) fail();
  if (column.coding == VtuColumn::Coding::text) {
    size_ = rows * column.components;
    if (outline.contents[column.content].words != size_) fail();
    return;
  }
  size_ = rows * column.components * column.type->size;
  const Stream head = {column.begin, 0};
  if (layout.is_packed) {
    open_blocks(head);
    return;
  }
  if (header(encoded(head, 0, layout.header_size), 0) != size_) fail();
  data_ = behind(head, layout.header_size);
}

void VtuRows::fail() const {
  throw Error(fmt::format("the array '{}' is damaged", column_.name));
}

std::uint64_t VtuRows::header(const std::string& bytes, std::size_t i) const {
  const char* at = bytes.data() + i * layout_.header_size;
  return layout_.header_size == 4 ? load<std::uint32_t>(at, layout_.swap)
                                  : load<std::uint64_t>(at, layout_.swap);
}

/// Some bytes of a stream: three of them are four characters of base64.
std::string VtuRows::encoded(const Stream& stream, std::uint64_t begin, std::size_t size) {
  if (size == 0) return {};
  begin += stream.skipped;
  const bool is_raw = column_.coding == VtuColumn::Coding::raw;
  const std::uint64_t first = is_raw ? begin : begin / 3 * 4;
  const std::uint64_t last = is_raw ? begin + size : (begin + size + 2) / 3 * 4;
  if (last > column_.end - std::min(column_.end, stream.begin)) fail();
  const char* at = file_.read(stream.begin + first, last - first);
  if (is_raw) return {at, size};
  std::string bytes;
  std::string_view text(at, last - first);
  decode_base64(text, begin % 3 + size, bytes);
  if (bytes.size() < begin % 3 + size) fail();
  return bytes.substr(begin % 3, size);
}

/// What follows a head of so many bytes, which in base64 may be a stream of its own.
VtuRows::Stream VtuRows::behind(const Stream& head, std::uint64_t size) {
  if (column_.coding == VtuColumn::Coding::raw) return {head.begin + size, 0};
  const std::uint64_t characters = (size + 2) / 3 * 4;
  if (head.begin + characters > column_.end) fail();
  const bool is_padded = *file_.read(head.begin + characters - 1, 1) == '=';
  return is_padded || size % 3 == 0 ? Stream{head.begin + characters, 0} : Stream{head.begin, size};
}

void VtuRows::open_blocks(const Stream& head) {
  constexpr std::uint64_t kLargestBlock = std::uint64_t{1} << 25;
  const std::string first = encoded(head, 0, 3 * layout_.header_size);
  const std::uint64_t blocks = header(first, 0);
  block_size_ = header(first, 1);
  const std::uint64_t last = header(first, 2);
  if (blocks == 0 || blocks > outline_.size || last > block_size_ || block_size_ == 0) {
    if (blocks == 0 && size_ == 0) return;
    fail();
  }
  const std::uint64_t full = last == 0 ? blocks : blocks - 1;
  if (block_size_ > kLargestBlock || (full > 0 && block_size_ > size_ / full) ||
      full * block_size_ + last != size_ || is_bomb(outline_.size, size_)) {
    fail();
  }
  const std::uint64_t head_size = (3 + blocks) * layout_.header_size;
  const std::string sizes = encoded(head, 0, head_size);
  data_ = behind(head, head_size);
  blocks_ = {0};
  for (std::uint64_t i = 0; i < blocks; ++i) {
    const std::uint64_t size = header(sizes, 3 + i);
    if (size > outline_.size) fail();
    blocks_.push_back(blocks_.back() + size);
  }
}

const std::string& VtuRows::block(std::size_t i) {
  if (i == block_) return unpacked_;
  block_ = SIZE_MAX;
  const std::string packed = encoded(data_, blocks_[i], blocks_[i + 1] - blocks_[i]);
  unpacked_.resize(std::min(block_size_, size_ - i * block_size_));
  if (!inflate_block(packed, unpacked_.data(), unpacked_.size())) fail();
  block_ = i;
  return unpacked_;
}

std::string VtuRows::bytes(std::uint64_t begin, std::size_t size) {
  if (!layout_.is_packed) return encoded(data_, begin, size);
  std::string bytes;
  bytes.reserve(size);
  while (bytes.size() < size) {
    const std::uint64_t at = begin + bytes.size();
    const std::string& from = block(at / block_size_);
    bytes += std::string_view(from).substr(at % block_size_, size - bytes.size());
  }
  return bytes;
}

DataArray::Values VtuRows::read(std::uint64_t first, std::size_t count) {
  first *= column_.components;
  count *= column_.components;
  if (column_.coding == VtuColumn::Coding::text) return parse(first, count);
  const std::size_t value = column_.type->size;
  return decode_vtu(bytes(first * value, count * value), *column_.type, count, layout_.swap);
}

std::vector<std::int64_t> VtuRows::integers(std::uint64_t first, std::size_t count) {
  DataArray::Values values = read(first, count);
  if (auto* wide = std::get_if<std::vector<std::int64_t>>(&values)) return std::move(*wide);
  const auto* narrow = std::get_if<std::vector<std::int32_t>>(&values);
  if (narrow == nullptr) fail();
  return {narrow->begin(), narrow->end()};
}

template <class Value>
std::vector<Value> VtuRows::parse_as(std::uint64_t first, std::size_t count) {
  const VtuOutline::Content& content = outline_.contents[column_.content];
  std::vector<Value> values;
  if (count == 0) return values;
  if (first + count > content.words) fail();
  const std::uint64_t step = first / VtuOutline::kWordsOfStep;
  const std::uint64_t last = (first + count - 1) / VtuOutline::kWordsOfStep + 1;
  const std::uint64_t begin = content.steps[step];
  const std::uint64_t end = last < content.steps.size() ? content.steps[last] : content.end;
  const char* at = file_.read(begin, end - begin);
  const char* const stop = at + (end - begin);
  std::uint64_t word = step * VtuOutline::kWordsOfStep;
  for (; word < first + count; ++word) {
    at = std::find_if_not(at, stop, is_white);
    if (word < first) {
      at = std::find_if(at, stop, is_white);
      continue;
    }
    const auto [behind, error] = from_chars(at, stop, values.emplace_back());
    if (error != std::errc() || (behind < stop && !is_white(*behind))) fail();
    at = behind;
  }
  return values;
}

DataArray::Values VtuRows::parse(std::uint64_t first, std::size_t count) {
  const VtuType& type = *column_.type;
  if (type.kind == VtuType::Kind::real) {
    if (type.size == 4) return parse_as<float>(first, count);
    return parse_as<double>(first, count);
  }
  if (type.is_narrow()) return parse_as<std::int32_t>(first, count);
  if (type.kind == VtuType::Kind::unsigned_integer && type.size == 8) {
    const std::vector<std::uint64_t> values = parse_as<std::uint64_t>(first, count);
    return std::vector<std::int64_t>(values.begin(), values.end());
  }
  return parse_as<std::int64_t>(first, count);
}

}  // namespace tetmend::formats
