// SPDX-License-Identifier: MIT
// Files of HDF5 as text, so that what is fuzzed is what MED, CGNS and XDMF mean, not HDF5's own code.
// Each line is one of
//
//   a PATH NAME i|d|t VALUE              an attribute; its group need not be there before
//   n PATH i32|i64|f32|f64 R[xC] NUMBER...
//   c PATH WIDTH CHARACTERS              rows of so many characters
//
// Words have %20 for a blank, and so on.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/input_file.h"

namespace tetmend::formats {
namespace {

std::string decoded(std::string_view word) {
  std::string text;
  for (std::size_t i = 0; i < word.size(); ++i) {
    unsigned code = 0;
    const char* const at = word.data() + i + 1;
    if (word[i] == '%' && i + 2 < word.size() &&
        std::from_chars(at, at + 2, code, 16).ptr == at + 2) {
      text += static_cast<char>(code);
      i += 2;
    } else {
      text += word[i];
    }
  }
  return text;
}

std::string encoded(std::string_view text) {
  std::string word;
  for (const char c : text) {
    const bool is_plain =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '/' || c == '_' || c == '-';
    word += is_plain ? std::string(1, c) : fmt::format("%{:02x}", static_cast<unsigned char>(c));
  }
  return word;
}

struct TextTable {
  DataArray::Values numbers;
  std::vector<std::uint64_t> extents;
  std::string characters;
  std::size_t width = 0;  ///< 0: it holds numbers
};

class TextTreeReader final : public Hdf5Reader {
 public:
  explicit TextTreeReader(const InputFile& input) : Hdf5Reader(input) {
    std::istringstream lines(std::string(input.begin(), input.size()));
    groups_.insert("/");
    for (std::string line; std::getline(lines, line);) read(line);
  }

  bool has(const std::string& path) const override { return groups_.contains(path); }
  std::vector<std::string> names(const std::string& group) const override {
    if (!has(group)) fail(group, "it is not there, or a link to elsewhere");
    if (tables_.contains(group)) fail(group, "the group cannot be read");
    const std::string begin = group == "/" ? "" : group + "/";
    std::vector<std::string> found;
    for (auto at = groups_.lower_bound(begin); at != groups_.end() && at->starts_with(begin);
         ++at) {
      const std::string name = at->substr(begin.size());
      if (!name.empty() && name.find('/') == std::string::npos) found.push_back(name);
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  std::vector<std::uint64_t> extents(const std::string& path) const override {
    return table(path).extents;
  }
  DataArray::Values values(const std::string& path) const override { return numbers(path).numbers; }
  DataArray::Values row(const std::string& path, std::uint64_t number) const override {
    const TextTable& from = numbers(path);
    return std::visit(
        [&](const auto& all) -> DataArray::Values {
          const std::size_t size = all.size() / static_cast<std::size_t>(from.extents[0]);
          const auto begin = all.begin() + static_cast<std::ptrdiff_t>(number * size);
          return std::decay_t<decltype(all)>(begin, begin + static_cast<std::ptrdiff_t>(size));
        },
        from.numbers);
  }
  std::vector<std::int64_t> integers(const std::string& path) const override {
    const DataArray::Values& from = numbers(path).numbers;
    if (const auto* small = std::get_if<std::vector<std::int32_t>>(&from))
      return {small->begin(), small->end()};
    if (const auto* large = std::get_if<std::vector<std::int64_t>>(&from)) return *large;
    fail(path, "the table holds no integers");
  }
  std::vector<double> reals(const std::string& path) const override {
    return std::visit([](const auto& all) { return std::vector<double>(all.begin(), all.end()); },
                      numbers(path).numbers);
  }
  std::vector<std::string> texts(const std::string& path) const override {
    const TextTable& from = table(path);
    if (from.width == 0) fail(path, "the table holds no texts");
    return text_rows(from.characters, from.width);
  }

  bool has(const std::string& path, const char* attribute) const override {
    return attributes_.contains({path, attribute});
  }
  std::int64_t integer(const std::string& path, const char* attribute) const override {
    return static_cast<std::int64_t>(std::clamp(real(path, attribute), -9e18, 9e18));
  }
  double real(const std::string& path, const char* attribute) const override {
    const auto found = attributes_.find({path, attribute});
    if (found == attributes_.end() || found->second.first == "t")
      fail(path, fmt::format("the attribute {} is not there, or no value", attribute));
    const double value = std::strtod(found->second.second.c_str(), nullptr);
    return value == value ? value : 0;
  }
  std::string text(const std::string& path, const char* attribute) const override {
    const auto found = attributes_.find({path, attribute});
    if (found == attributes_.end() || found->second.first != "t") return {};
    return found->second.second.substr(0, found->second.second.find('\0'));
  }

 private:
  void read(const std::string& line) {
    std::istringstream words(line);
    std::string kind, path, word;
    if (!(words >> kind >> path)) return;
    path = decoded(path);
    if (path.starts_with('/') || path.ends_with('/') || path.find("//") != std::string::npos)
      return;
    for (std::size_t end = 0; end != std::string::npos;) {
      end = path.find('/', end + 1);
      if (tables_.contains(path.substr(0, end))) return;
      groups_.insert(path.substr(0, end));
    }
    if (kind == "a") {
      std::string type, value;
      words >> word >> type >> value;
      attributes_[{path, decoded(word)}] = {type, decoded(value)};
    } else if (kind == "c") {
      TextTable table;
      words >> table.width >> word;
      table.characters = decoded(word);
      table.width = std::clamp<std::size_t>(table.width, 1, 1000);
      table.characters.resize(table.characters.size() / table.width * table.width);
      table.extents = {table.characters.size() / table.width, table.width};
      tables_[path] = std::move(table);
    } else if (kind == "n") {
      read_numbers(path, words);
    }
  }

  void read_numbers(const std::string& path, std::istringstream& words) {
    std::string type, shape;
    words >> type >> shape;
    if (type == "i32") return add<std::int32_t>(path, shape, words);
    if (type == "i64") return add<std::int64_t>(path, shape, words);
    if (type == "f32") return add<float>(path, shape, words);
    if (type == "f64") return add<double>(path, shape, words);
  }
  template <class Number>
  void add(const std::string& path, const std::string& shape, std::istringstream& words) {
    std::vector<Number> all;
    for (std::string word; words >> word;) {
      if constexpr (std::is_integral_v<Number>) {
        all.push_back(static_cast<Number>(std::strtoll(word.c_str(), nullptr, 10)));
      } else {
        all.push_back(static_cast<Number>(std::strtod(word.c_str(), nullptr)));
      }
    }
    std::size_t columns = 1;
    const std::size_t by = shape.find('x');
    if (by != std::string::npos) columns = std::strtoull(shape.c_str() + by + 1, nullptr, 10);
    columns = std::clamp<std::size_t>(columns, 1, std::max<std::size_t>(all.size(), 1));
    all.resize(all.size() / columns * columns);
    TextTable table;
    table.extents = {all.size() / columns};
    if (by != std::string::npos) table.extents.push_back(columns);
    table.numbers = std::move(all);
    tables_[path] = std::move(table);
  }

  const TextTable& table(const std::string& path) const {
    const auto found = tables_.find(path);
    if (found == tables_.end()) fail(path, "it is no table that can be read");
    return found->second;
  }
  const TextTable& numbers(const std::string& path) const {
    const TextTable& found = table(path);
    if (found.width > 0) fail(path, "the table holds no numbers");
    return found;
  }

  std::set<std::string> groups_;  // and tables
  std::map<std::string, TextTable> tables_;
  std::map<std::pair<std::string, std::string>, std::pair<std::string, std::string>> attributes_;
};

class TextTreeWriter final : public Hdf5Writer {
 public:
  void group(const std::string& path) override {
    out_ += fmt::format("a {} {}\n", encoded(path), "t");
  }
  void write(const std::string& path, const DataArray::Values& values,
             std::size_t columns) override {
    constexpr const char* kTypes[] = {"i32", "i64", "f32", "f64"};
    const std::size_t count = std::visit([](const auto& all) { return all.size(); }, values);
    out_ += fmt::format(
        "n {} {} {}", encoded(path), kTypes[values.index()],
        columns == 0 ? fmt::format("{}", count) : fmt::format("{}x{}", count / columns, columns));
    std::visit(
        [&](const auto& all) {
          for (const auto number : all) out_ += fmt::format(" {}", number);
        },
        values);
    out_ += '\n';
  }
  void write_texts(const std::string& path, const std::vector<std::string>& texts,
                   std::size_t width) override {
    std::string all;
    for (const std::string& text : texts) {
      all += text.substr(0, width);
      all.append(width - std::min(width, text.size()), '\0');
    }
    out_ += fmt::format("c {} {} {}\n", encoded(path), width, encoded(all));
  }
  void write_characters(const std::string& path, const std::string& text) override {
    out_ += fmt::format("c {} {} {}\n", encoded(path), std::max<std::size_t>(text.size(), 1),
                        encoded(text));
  }
  void set(const std::string& path, const char* attribute, const Attribute& value) override {
    out_ += fmt::format("a {} {} ", encoded(path), encoded(attribute));
    if (const auto* text = std::get_if<std::string>(&value)) {
      out_ += fmt::format("t {}\n", encoded(*text));
    } else if (const auto* real = std::get_if<double>(&value)) {
      out_ += fmt::format("d {}\n", *real);
    } else {
      out_ += fmt::format("i {}\n", std::get<std::int32_t>(value));
    }
  }
  std::string bytes() override { return std::move(out_); }

 private:
  std::string out_;
};

[[maybe_unused]] const bool kIsProvided = [] {
  static constexpr Hdf5Driver kDriver = {
      .open = [](const InputFile& file, std::string_view) -> std::unique_ptr<Hdf5Reader> {
        return std::make_unique<TextTreeReader>(file);
      },
      .make = [](std::string) -> std::unique_ptr<Hdf5Writer> {
        return std::make_unique<TextTreeWriter>();
      }};
  provide_hdf5(kDriver);
  return true;
}();

}  // namespace
}  // namespace tetmend::formats
