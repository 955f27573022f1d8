// SPDX-License-Identifier: MIT
//   head -> section headers -> table of dynamic symbols -> its names -> the symbol -> the section
//   that holds its value
#include "ops/plugin_abi.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <link.h>

namespace tetmend {

namespace {

using Head = ElfW(Ehdr);
using Section = ElfW(Shdr);
using Symbol = ElfW(Sym);

constexpr std::string_view kName = "tetmend_plugin_abi";
constexpr std::size_t kMostBytes = std::size_t{1} << 28;  // of a table; a larger one is none

/// Whether the file is for a program like this one.
bool is_library_of_this_machine(const Head& head) {
  constexpr unsigned char kClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  const auto* ident = reinterpret_cast<const char*>(head.e_ident);
  return std::string_view(ident, SELFMAG) == ELFMAG && head.e_ident[EI_CLASS] == kClass &&
         head.e_type == ET_DYN && head.e_shentsize == sizeof(Section);
}

class ElfFile {
 public:
  explicit ElfFile(const std::filesystem::path& file) : in_(file, std::ios::binary) {}

  std::optional<PluginAbi> abi() {
    const std::vector<Head> head = read<Head>(0, 1);
    if (head.empty() || !is_library_of_this_machine(head[0])) return {};
    sections_ = read<Section>(head[0].e_shoff, head[0].e_shnum);
    for (const Section& section : sections_) {
      if (section.sh_type == SHT_DYNSYM) return abi_among(section);
    }
    return {};
  }

 private:
  /// Empty when the file has not so much.
  template <class Row>
  std::vector<Row> read(std::uint64_t at, std::uint64_t count) {
    std::vector<Row> rows;
    if (count > kMostBytes / sizeof(Row) || at > std::numeric_limits<std::int64_t>::max())
      return {};
    rows.resize(count);
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(at));
    in_.read(reinterpret_cast<char*>(rows.data()),
             static_cast<std::streamsize>(count * sizeof(Row)));
    if (!in_) rows.clear();
    return rows;
  }

  std::optional<PluginAbi> abi_among(const Section& table) {
    if (table.sh_link >= sections_.size()) return {};
    const Section& strings = sections_[table.sh_link];
    const std::vector<char> names = read<char>(strings.sh_offset, strings.sh_size);
    for (const Symbol& symbol : read<Symbol>(table.sh_offset, table.sh_size / sizeof(Symbol))) {
      if (symbol.st_name >= names.size() || symbol.st_shndx >= sections_.size()) continue;
      const std::string_view rest(names.data() + symbol.st_name, names.size() - symbol.st_name);
      if (rest.substr(0, rest.find('\0')) != kName) continue;
      return value_of(symbol);
    }
    return {};
  }

  std::optional<PluginAbi> value_of(const Symbol& symbol) {
    const Section& home = sections_[symbol.st_shndx];
    if (home.sh_type != SHT_PROGBITS || symbol.st_value < home.sh_addr) return {};
    const std::uint64_t inside = symbol.st_value - home.sh_addr;
    if (home.sh_size < sizeof(PluginAbi) || inside > home.sh_size - sizeof(PluginAbi)) return {};
    const std::vector<PluginAbi> value = read<PluginAbi>(home.sh_offset + inside, 1);
    if (value.empty()) return {};
    return value[0];
  }

  std::ifstream in_;
  std::vector<Section> sections_;
};

}  // namespace

std::optional<PluginAbi> read_plugin_abi(const std::filesystem::path& file) {
  return ElfFile(file).abi();
}

}  // namespace tetmend
