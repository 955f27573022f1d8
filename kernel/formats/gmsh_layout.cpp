// SPDX-License-Identifier: MIT
// Where things stand in a Gmsh file of version 4.1.
#include "kernel/formats/gmsh_layout.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "kernel/error.h"
#include "kernel/formats/byte_reader.h"
#include "kernel/formats/gmsh_elements.h"

namespace tetmend::formats {
namespace {

constexpr std::uint64_t kRowsOfChunk = std::uint64_t{1} << 15;
constexpr std::size_t kMostHead = std::size_t{1} << 26;

/// Thrown where a file is not as scan_gmsh() says.
struct NotRegular {};

void require(bool is_regular) {
  if (!is_regular) throw NotRegular();
}

/// Passes over a file from its beginning, with some of it in memory.
class Scan {
 public:
  explicit Scan(const std::filesystem::path& file)
      : in_(file, std::ios::binary | std::ios::ate),
        size_(static_cast<std::uint64_t>(std::max<std::streamoff>(0, in_.tellg()))) {
    in_.seekg(0);
  }

  std::uint64_t size() const { return size_; }
  std::uint64_t position() const { return begin_ + at_; }
  bool at_end() const { return position() >= size_; }

  void seek(std::uint64_t position) {
    require(position <= size_);
    if (position >= begin_ && position <= begin_ + buffer_.size()) {
      at_ = position - begin_;
      return;
    }
    begin_ = position;
    at_ = 0;
    buffer_.clear();
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(position));
  }
  /// Goes on by `rows` times `row_size`.
  void skip(std::uint64_t rows, std::uint64_t row_size) {
    require(row_size == 0 || rows <= (size_ - position()) / row_size);
    seek(position() + rows * row_size);
  }

  /// The next line, without its break and blanks behind.
  std::string line() {
    constexpr std::size_t kLongest = std::size_t{1} << 20;
    std::string line;
    for (;;) {
      require(at_ < buffer_.size() || fill());
      const std::string_view rest = std::string_view(buffer_).substr(at_);
      const std::size_t end = rest.find('\n');
      line += rest.substr(0, end);
      require(line.size() < kLongest);
      at_ += end == rest.npos ? rest.size() : end + 1;
      if (end != rest.npos) break;
    }
    line.erase(line.find_last_not_of(" \t\r") + 1);
    return line;
  }
  void skip_lines(std::uint64_t lines) {
    while (lines > 0) {
      require(at_ < buffer_.size() || fill());
      const void* found = std::memchr(buffer_.data() + at_, '\n', buffer_.size() - at_);
      if (found == nullptr) {
        at_ = buffer_.size();
        continue;
      }
      at_ = static_cast<std::size_t>(static_cast<const char*>(found) - buffer_.data()) + 1;
      --lines;
    }
  }
  template <class T>
  T number(bool swap) {
    return load<T>(bytes(sizeof(T)).data(), swap);
  }
  std::string bytes(std::size_t size) {
    std::string bytes;
    while (bytes.size() < size) {
      require(at_ < buffer_.size() || fill());
      const std::size_t part = std::min(size - bytes.size(), buffer_.size() - at_);
      bytes.append(buffer_, at_, part);
      at_ += part;
    }
    return bytes;
  }

 private:
  bool fill() {
    constexpr std::size_t kAtOnce = std::size_t{1} << 20;
    begin_ += buffer_.size();
    at_ = 0;
    buffer_.resize(kAtOnce);
    in_.read(buffer_.data(), static_cast<std::streamsize>(kAtOnce));
    buffer_.resize(static_cast<std::size_t>(in_.gcount()));
    return !buffer_.empty();
  }

  std::ifstream in_;
  std::uint64_t size_;
  std::uint64_t begin_ = 0;  // of the buffer
  std::string buffer_;
  std::size_t at_ = 0;
};

/// The numbers of a line, of which there are so many.
template <std::size_t N>
std::array<std::int64_t, N> numbers_of(std::string_view line) {
  std::array<std::int64_t, N> numbers{};
  const char* at = line.data();
  const char* const end = at + line.size();
  const auto skip_blanks = [&] {
    while (at < end && (*at == ' ' || *at == '\t')) ++at;
  };
  for (std::int64_t& number : numbers) {
    skip_blanks();
    const auto [stop, error] = std::from_chars(at, end, number);
    require(error == std::errc() && (stop == end || *stop == ' ' || *stop == '\t'));
    at = stop;
  }
  skip_blanks();
  require(at == end);
  return numbers;
}

/// {dimension, number} of entities, with the label of their elements: the first group.
std::map<std::pair<int, Label>, Label> labels_of_entities(const MeshData& head) {
  std::set<std::pair<int, Label>> named;
  for (const Group& group : head.groups) named.insert({group.dimension, group.number});
  std::map<std::pair<int, Label>, Label> labels;
  for (const GeometricEntity& entity : head.entities) {
    const auto group =
        std::find_if(entity.groups.begin(), entity.groups.end(), [](Label g) { return g != 0; });
    if (group == entity.groups.end()) continue;
    const bool is_turned =
        *group < 0 && *group > INT32_MIN && !named.contains({entity.dimension, *group});
    labels.try_emplace({entity.dimension, entity.tag}, is_turned ? -*group : *group);
  }
  return labels;
}

class Scanner {
 public:
  explicit Scanner(const std::filesystem::path& file) : scan_(file) {}

  GmshLayout run() {
    read_format();
    bool has_nodes = false;
    for (std::string name = section(); name != "$Elements"; name = section()) {
      if (name == "$Nodes") {
        require(!std::exchange(has_nodes, true));
        skipped_.push_back({section_at_, 0});
        read_nodes();
        expect("$EndNodes");
        skipped_.back().second = scan_.position();
      } else if (name == "$Entities" && layout_.binary) {
        pass_over_entities();
        expect("$EndEntities");
      } else {
        require(name == "$PhysicalNames" || name == "$Entities");
        const std::string end = "$End" + name.substr(1);
        while (scan_.line() != end) {
        }
      }
      require(scan_.position() < kMostHead || has_nodes);
    }
    require(has_nodes);
    skipped_.push_back({section_at_, scan_.size()});
    read_elements();
    expect("$EndElements");
    while (!scan_.at_end()) require(scan_.line().empty());
    read_head();
    return std::move(layout_);
  }

 private:
  /// The name of the next one, which begins at `section_at_`.
  std::string section() {
    std::string name;
    while (name.empty()) {
      section_at_ = scan_.position();
      name = scan_.line();
    }
    return name;
  }
  void expect(std::string_view name) { require(section() == name); }

  void read_format() {
    require(scan_.line() == "$MeshFormat");
    const std::string line = scan_.line();
    require(line == "4.1 0 8" || line == "4.1 1 8");
    layout_.binary = line == "4.1 1 8";
    if (layout_.binary) {
      const auto one = scan_.number<std::int32_t>(false);
      layout_.swap = one != 1;
      require(one == 1 || one == byte_swapped(std::int32_t{1}));
    }
    expect("$EndMeshFormat");
  }

  /// Whole numbers of 4 and 8 bytes, or the next line.
  template <class... Integers>
  std::array<std::int64_t, sizeof...(Integers)> row() {
    if (!layout_.binary) return numbers_of<sizeof...(Integers)>(scan_.line());
    return {std::int64_t{scan_.number<Integers>(layout_.swap)}...};
  }

  void pass_over_entities() {
    const auto counts = row<std::int64_t, std::int64_t, std::int64_t, std::int64_t>();
    const auto skip_list = [this] {
      scan_.skip(static_cast<std::uint64_t>(scan_.number<std::int64_t>(layout_.swap)), 4);
    };
    for (std::size_t dimension = 0; dimension < counts.size(); ++dimension) {
      for (std::int64_t i = 0; i < counts[dimension]; ++i) {
        scan_.skip(1, dimension == 0 ? 4 + 3 * 8 : 4 + 6 * 8);
        skip_list();
        if (dimension > 0) skip_list();
      }
    }
  }

  /// Lines or bytes of a block. @returns where each chunk of rows begins, and where the last one ends
  std::vector<std::uint64_t> pass_over(std::uint64_t rows, std::uint64_t row_size) {
    std::vector<std::uint64_t> places = {scan_.position()};
    for (std::uint64_t row = 0; row < rows; row += kRowsOfChunk) {
      const std::uint64_t some = std::min(kRowsOfChunk, rows - row);
      layout_.binary ? scan_.skip(some, row_size) : scan_.skip_lines(some);
      places.push_back(scan_.position());
    }
    return places;
  }

  void add_chunks(GmshLayout::Kind kind, std::uint64_t rows,
                  const std::vector<std::uint64_t>& numbers,
                  const std::vector<std::uint64_t>& places) {
    for (std::uint64_t row = 0, i = 0; row < rows; row += kRowsOfChunk, ++i) {
      GmshChunk& chunk = layout_.chunks[kind].emplace_back();
      chunk.block = layout_.blocks.size() - 1;
      chunk.first = layout_.counts[kind] + row;
      chunk.rows = std::min(kRowsOfChunk, rows - row);
      chunk.at = numbers[i];
      chunk.size = numbers[i + 1] - numbers[i];
      if (places.empty()) continue;
      chunk.places_at = places[i];
      chunk.places_size = places[i + 1] - places[i];
    }
    layout_.counts[kind] += rows;
  }

  void read_nodes() {
    const auto [blocks, count, least, most] =
        row<std::int64_t, std::int64_t, std::int64_t, std::int64_t>();
    require(blocks >= 0 && least >= 0 && most >= 0);
    for (std::int64_t i = 0; i < blocks; ++i) {
      const auto [dimension, part, parametric, rows] =
          row<std::int32_t, std::int32_t, std::int32_t, std::int64_t>();
      require(dimension >= 0 && dimension <= 3 && (parametric == 0 || parametric == 1));
      require(part >= INT32_MIN && part <= INT32_MAX && rows >= 0 && rows <= count);
      GmshBlock& block = layout_.blocks.emplace_back();
      block.dimension = static_cast<std::int32_t>(dimension);
      block.part = static_cast<Label>(part);
      block.parameters = static_cast<std::uint32_t>(parametric * dimension);
      layout_.parametric = layout_.parametric || parametric == 1;
      const auto size = static_cast<std::uint64_t>(rows);
      const std::vector<std::uint64_t> numbers = pass_over(size, sizeof(std::int64_t));
      const std::vector<std::uint64_t> places =
          pass_over(size, (3 + block.parameters) * sizeof(double));
      add_chunks(GmshLayout::nodes, size, numbers, places);
    }
    require(count >= 0 && layout_.counts[GmshLayout::nodes] == static_cast<std::uint64_t>(count));
  }

  void read_elements() {
    const auto [blocks, count, least, most] =
        row<std::int64_t, std::int64_t, std::int64_t, std::int64_t>();
    require(blocks >= 0 && least >= 0 && most >= 0);
    std::int64_t left = count;
    for (std::int64_t i = 0; i < blocks; ++i) {
      const auto [dimension, part, type, rows] =
          row<std::int32_t, std::int32_t, std::int32_t, std::int64_t>();
      const bool is_known =
          type == gmsh_edge || type == gmsh_triangle || type == gmsh_tet || type == gmsh_point;
      require(is_known && gmsh_type(static_cast<int>(type)).dimension == dimension);
      require(part >= INT32_MIN && part <= INT32_MAX && rows >= 0 && rows <= left);
      left -= rows;
      GmshBlock& block = layout_.blocks.emplace_back();
      block.dimension = static_cast<std::int32_t>(dimension);
      block.part = static_cast<Label>(part);
      const auto kind = static_cast<GmshLayout::Kind>(dimension);
      const auto size = static_cast<std::uint64_t>(rows);
      const std::uint64_t numbers = 1 + gmsh_type(static_cast<int>(type)).width;
      const std::vector<std::uint64_t> places = pass_over(size, numbers * sizeof(std::int64_t));
      if (kind == GmshLayout::nodes) {
        for (std::uint64_t row = 0, k = 0; row < size; row += kRowsOfChunk, ++k) {
          layout_.point_elements.push_back({layout_.blocks.size() - 1, row,
                                            std::min(kRowsOfChunk, size - row), places[k],
                                            places[k + 1] - places[k], 0, 0});
        }
      } else {
        add_chunks(kind, size, places, {});
      }
    }
    require(left == 0);
  }

  /// What is left of the file without the two sections, and empty ones in their place.
  void read_head() {
    std::uint64_t begin = 0;
    const std::string nothing = layout_.binary ? std::string(4 * sizeof(std::int64_t), '\0') + "\n"
                                               : std::string("0 0 0 0\n");
    for (const auto& [from, to] : skipped_) {
      scan_.seek(begin);
      require(from - begin < kMostHead);
      layout_.head += scan_.bytes(from - begin);
      const std::string name = from == skipped_.back().first ? "Elements" : "Nodes";
      layout_.head += "$" + name + "\n" + nothing + "$End" + name + "\n";
      begin = to;
    }
    const auto labels = labels_of_entities(read_gmsh_head(layout_.head));
    for (GmshBlock& block : layout_.blocks) {
      const auto found = labels.find({block.dimension, block.part});
      block.label = found == labels.end() ? 0 : found->second;
    }
    for (const GmshChunk& chunk : layout_.point_elements) {
      if (layout_.blocks[chunk.block].label == 0) layout_.loose_points += chunk.rows;
    }
  }

  Scan scan_;
  GmshLayout layout_;
  std::uint64_t section_at_ = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> skipped_;  // from where to where
};

}  // namespace

std::optional<GmshLayout> scan_gmsh(const std::filesystem::path& file) {
  try {
    return Scanner(file).run();
  } catch (const NotRegular&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace tetmend::formats
