// SPDX-License-Identifier: MIT
// Reads files of netCDF in their classic forms: CDF-1, CDF-2 and CDF-5. Numbers stand with their highest
// byte first; tables with a row for each step are cut into these rows at the end of the file.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/byte_reader.h"
#include "kernel/formats/netcdf_file.h"

namespace tetmend::formats {
namespace {

enum NetcdfType : std::uint32_t {
  nc_byte = 1,
  nc_char,
  nc_short,
  nc_int,
  nc_float,
  nc_double,
  nc_ubyte,
  nc_ushort,
  nc_uint,
  nc_int64,
  nc_uint64
};
/// Bytes of a number of each type.
constexpr std::array<std::size_t, 12> kSizes = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};

struct NetcdfTable {
  std::uint32_t type = 0;
  std::vector<std::uint64_t> extents;
  bool has_steps = false;
  std::uint64_t steps = 1;  ///< rows that are apart
  std::uint64_t begin = 0;
  std::map<std::string, std::string> texts;
  std::map<std::string, double> numbers;

  /// Of one step.
  std::uint64_t count() const {
    std::uint64_t product = 1;
    for (std::size_t k = has_steps ? 1 : 0; k < extents.size(); ++k) product *= extents[k];
    return product;
  }
  std::uint64_t padded_bytes() const { return (count() * kSizes[type] + 3) / 4 * 4; }
};

class ClassicReader final : public Hdf5Reader {
 public:
  explicit ClassicReader(const InputFile& input) : Hdf5Reader(input), input_(input), bytes_(input) {
    bytes_.set_swap(std::endian::native == std::endian::little);
    read_header();
  }

  bool has(const std::string& path) const override { return tables_.contains(path); }
  std::vector<std::string> names(const std::string&) const override {
    std::vector<std::string> all;
    for (const auto& [name, table] : tables_) all.push_back(name);
    return all;
  }
  std::vector<std::uint64_t> extents(const std::string& path) const override {
    return table(path).extents;
  }
  DataArray::Values values(const std::string& path) const override {
    return values(path, table(path));
  }
  DataArray::Values row(const std::string& path, std::uint64_t number) const override {
    NetcdfTable from = table(path);
    if (from.has_steps) {
      from.begin += number * stride(from);
    } else {
      from.extents[0] = 1;
      from.begin += number * from.count() * kSizes[from.type];
    }
    from.steps = 1;
    return values(path, from);
  }
  std::vector<std::int64_t> integers(const std::string& path) const override {
    const std::uint32_t type = table(path).type;
    if (type == nc_float || type == nc_double) fail(path, "the table holds no integers");
    return numbers<std::int64_t>(path, table(path));
  }
  std::vector<double> reals(const std::string& path) const override {
    return numbers<double>(path, table(path));
  }
  std::vector<std::string> texts(const std::string& path) const override {
    const NetcdfTable& from = table(path);
    if (from.type != nc_char || from.extents.empty()) fail(path, "the table holds no texts");
    const auto width = static_cast<std::size_t>(from.extents.back());
    take(path, from.steps * from.count() / 8);
    std::string all;
    each_step(from, [&](const char* begin, std::uint64_t count) { all.append(begin, count); });
    return text_rows(all, width);
  }

  bool has(const std::string& path, const char* attribute) const override {
    const NetcdfTable* of = path == "/" ? &file_ : has(path) ? &table(path) : nullptr;
    return of != nullptr && (of->texts.contains(attribute) || of->numbers.contains(attribute));
  }
  std::int64_t integer(const std::string& path, const char* attribute) const override {
    return static_cast<std::int64_t>(real(path, attribute));
  }
  double real(const std::string& path, const char* attribute) const override {
    const NetcdfTable& of = path == "/" ? file_ : table(path);
    const auto found = of.numbers.find(attribute);
    if (found == of.numbers.end()) {
      fail(path, fmt::format("the attribute {} is not there, or no value", attribute));
    }
    return found->second;
  }
  std::string text(const std::string& path, const char* attribute) const override {
    const NetcdfTable& of = path == "/" ? file_ : table(path);
    const auto found = of.texts.find(attribute);
    return found == of.texts.end() ? std::string() : found->second;
  }

 private:
  const NetcdfTable& table(const std::string& path) const {
    const auto found = tables_.find(path);
    if (found == tables_.end()) fail(path, "it is not there");
    return found->second;
  }

  // ---- Header -------------------------------------------------------------------------------------

  /// Counts, lengths and places have 8 bytes in CDF-5.
  std::uint64_t length(std::string_view what) {
    return version_ == 5 ? bytes_.number<std::uint64_t>(what) : bytes_.number<std::uint32_t>(what);
  }
  /// Of things that take at least `bytes_each`.
  std::uint64_t count(std::string_view what, std::uint64_t bytes_each) {
    const std::size_t at = bytes_.position();
    const std::uint64_t found = length(what);
    if (found > bytes_.bytes_left() / bytes_each) {
      bytes_.fail_at(at, fmt::format("{} {} cannot fit into the rest of the file: the count is "
                                     "wrong or the file is truncated",
                                     found, what));
    }
    return found;
  }
  void skip_padding(std::uint64_t size) {
    const std::uint64_t padding = (4 - size % 4) % 4;
    bytes_.seek(bytes_.position() + std::min<std::size_t>(padding, bytes_.bytes_left()));
  }
  std::string text_of(std::uint64_t size) {
    std::string found(bytes_.here(), static_cast<std::size_t>(size));
    bytes_.seek(bytes_.position() + static_cast<std::size_t>(size));
    skip_padding(size);
    return found;
  }
  std::string name() { return text_of(count("characters of a name", 1)); }
  /// Of a list that begins with this tag; 0: there is none.
  std::uint64_t list(std::uint32_t tag, std::string_view what) {
    const std::size_t at = bytes_.position();
    const auto found = bytes_.number<std::uint32_t>(what);
    const std::uint64_t size = count(what, 8);
    if (found != tag && (found != 0 || size != 0)) {
      bytes_.fail_at(at, fmt::format("'{}' is no list of {} of a netCDF file", found, what));
    }
    return size;
  }
  std::uint32_t type() {
    const std::size_t at = bytes_.position();
    const auto found = bytes_.number<std::uint32_t>("a type");
    if (found == 0 || found >= kSizes.size()) {
      bytes_.fail_at(at, fmt::format("'{}' is no type of netCDF", found));
    }
    return found;
  }

  void read_header() {
    version_ = static_cast<unsigned char>(input_.begin()[3]);
    bytes_.seek(4);
    steps_ = length("steps");
    const std::uint64_t streaming = version_ == 5 ? UINT64_MAX : UINT32_MAX;
    if (steps_ == streaming) steps_ = 0;  // whoever wrote them did not come back to count them
    for (std::uint64_t n = list(10, "dimensions"); n > 0; --n) {
      name();
      lengths_.push_back(length("the length of a dimension"));
    }
    read_attributes(file_);
    for (std::uint64_t n = list(11, "tables"); n > 0; --n) read_table();
    for (auto& [name, table] : tables_) check(name, table);
  }

  void read_attributes(NetcdfTable& of) {
    for (std::uint64_t n = list(12, "attributes"); n > 0; --n) {
      const std::string called = name();
      const std::uint32_t of_type = type();
      const std::uint64_t size = count("values of an attribute", kSizes[of_type]);
      const char* const begin = bytes_.here();
      std::string all = text_of(size * kSizes[of_type]);
      if (of_type == nc_char) {
        all.resize(std::min(all.find('\0'), all.size()));
        of.texts[called] = std::move(all);
      } else if (size == 1) {
        of.numbers[called] = number<double>(begin, of_type);
      }
    }
  }

  void read_table() {
    const std::string called = name();
    NetcdfTable table;
    for (std::uint64_t n = count("dimensions of a table", 4); n > 0; --n) {
      const std::size_t at = bytes_.position();
      const std::uint64_t number = length("a dimension");
      if (number >= lengths_.size()) {
        bytes_.fail_at(at, fmt::format("'{}' is not the number of a dimension", number));
      }
      const bool is_step = lengths_[number] == 0;
      table.has_steps = table.has_steps || (is_step && table.extents.empty());
      table.extents.push_back(is_step ? steps_ : lengths_[number]);
    }
    if (table.has_steps) table.steps = steps_;
    read_attributes(table);
    table.type = type();
    length("the size of a table");  // it says nothing new, and large ones have none
    table.begin = version_ == 1 ? bytes_.number<std::uint32_t>("the place of a table")
                                : bytes_.number<std::uint64_t>("the place of a table");
    tables_[called] = std::move(table);
  }

  /// That a table lies in the file; sums up what the tables of a step take.
  void check(const std::string& name, const NetcdfTable& table) {
    std::uint64_t room = input_.size() / kSizes[table.type];
    for (const std::uint64_t extent : table.extents) {
      if (extent > room) {
        fail(name, fmt::format("{} rows or columns cannot fit into the {} bytes of the file",
                               extent, input_.size()));
      }
      room = extent == 0 ? room : room / extent;
    }
    if (table.has_steps) {
      ++tables_of_step_;
      bytes_of_step_ += table.padded_bytes();
    }
  }

  // ---- Tables -------------------------------------------------------------------------------------

  template <class To, class From>
  static To converted(const char* from) {
    return static_cast<To>(load<From>(from, std::endian::native == std::endian::little));
  }
  template <class To>
  static To number(const char* from, std::uint32_t type) {
    switch (type) {
      case nc_short:
        return converted<To, std::int16_t>(from);
      case nc_int:
        return converted<To, std::int32_t>(from);
      case nc_float:
        return converted<To, float>(from);
      case nc_double:
        return converted<To, double>(from);
      case nc_ubyte:
        return converted<To, std::uint8_t>(from);
      case nc_ushort:
        return converted<To, std::uint16_t>(from);
      case nc_uint:
        return converted<To, std::uint32_t>(from);
      case nc_int64:
        return converted<To, std::int64_t>(from);
      case nc_uint64:
        return converted<To, std::uint64_t>(from);
      default:
        return converted<To, std::int8_t>(from);
    }
  }

  /// From one row of a table with steps to the next.
  std::uint64_t stride(const NetcdfTable& table) const {
    return tables_of_step_ == 1 ? table.count() * kSizes[table.type] : bytes_of_step_;
  }
  /// take(begin, count) for the numbers of each step; of a table without steps once.
  template <class Take>
  void each_step(const NetcdfTable& table, const Take& take) const {
    const std::uint64_t count = table.count();
    const std::uint64_t size = count * kSizes[table.type];
    for (std::uint64_t step = 0; step < table.steps; ++step) {
      const std::uint64_t begin = table.begin + step * stride(table);
      if (begin > input_.size() || size > input_.size() - begin) {
        throw Error(
            fmt::format("{}: byte {}: a table lies behind the end of the file: it is "
                        "truncated",
                        input_.name(), begin));
      }
      take(input_.begin() + begin, count);
    }
  }
  DataArray::Values values(const std::string& path, const NetcdfTable& from) const {
    switch (from.type) {
      case nc_float:
        return numbers<float>(path, from);
      case nc_double:
      case nc_uint64:
        return numbers<double>(path, from);
      case nc_int64:
      case nc_uint:
        return numbers<std::int64_t>(path, from);
      default:
        return numbers<std::int32_t>(path, from);
    }
  }
  template <class Number>
  std::vector<Number> numbers(const std::string& path, const NetcdfTable& from) const {
    if (from.type == nc_char) fail(path, "the table holds no numbers");
    std::vector<Number> all;
    take(path, from.steps * from.count());
    all.reserve(static_cast<std::size_t>(from.steps * from.count()));
    each_step(from, [&](const char* begin, std::uint64_t count) {
      for (std::uint64_t i = 0; i < count; ++i) {
        all.push_back(number<Number>(begin + i * kSizes[from.type], from.type));
      }
    });
    return all;
  }

  const InputFile& input_;
  ByteReader bytes_;
  unsigned version_ = 0;
  std::uint64_t steps_ = 0;
  std::vector<std::uint64_t> lengths_;  // of dimensions; 0: as many as steps
  NetcdfTable file_;                    // its attributes
  std::map<std::string, NetcdfTable> tables_;
  std::size_t tables_of_step_ = 0;
  std::uint64_t bytes_of_step_ = 0;
};

}  // namespace

std::unique_ptr<Hdf5Reader> open_netcdf(const InputFile& file, std::string_view format) {
  const std::string_view bytes(file.begin(), file.size());
  if (bytes.empty()) {
    file.fail_at_byte(file.begin(), "the file is empty: expected a file of netCDF");
  }
  const bool is_classic =
      bytes.starts_with("CDF\x01") || bytes.starts_with("CDF\x02") || bytes.starts_with("CDF\x05");
  if (is_classic) return std::make_unique<ClassicReader>(file);
  if (bytes.starts_with("\x89HDF\r\n\x1a\n")) return open_hdf5(file, format);
  throw Error(fmt::format("{}: the file is none of netCDF, as {} files are", file.name(), format));
}

}  // namespace tetmend::formats
