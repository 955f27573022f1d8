// SPDX-License-Identifier: MIT
#include "kernel/formats/xdmf_items.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "kernel/formats/byte_reader.h"

namespace tetmend::formats {

namespace {

std::string trimmed_text(const pugi::xml_node& item) {
  std::string text = item.text().as_string();
  text.erase(0, std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  text.resize(text.find_last_not_of(" \t\r\n") + 1);
  return text;
}

/// All numbers of one type from `begin` on, as those of another one.
template <class From, class To>
std::vector<To> loaded(const char* begin, std::size_t count, bool swap) {
  std::vector<To> all;
  all.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    all.push_back(static_cast<To>(load<From>(begin + i * sizeof(From), swap)));
  return all;
}

}  // namespace

std::string xdmf_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

void XdmfItems::fail(const pugi::xml_node& node, std::string_view reason) const {
  const std::ptrdiff_t offset = node.offset_debug();
  file_.fail_at_line(file_.begin() + std::clamp<std::ptrdiff_t>(
                                         offset, 0, static_cast<std::ptrdiff_t>(file_.size())),
                     reason);
}

pugi::xml_node XdmfItems::item_of(const pugi::xml_node& parent) const {
  const pugi::xml_node item = parent.child("DataItem");
  if (!item) fail(parent, "the element DataItem is missing");
  return item;
}
std::vector<std::size_t> XdmfItems::dimensions(const pugi::xml_node& item) const {
  const std::string text = item.attribute("Dimensions").as_string();
  std::vector<std::size_t> all;
  const char* at = text.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    const unsigned long long value = std::strtoull(at, &end, 10);
    if (end == at) break;
    all.push_back(static_cast<std::size_t>(value));
    at = end;
  }
  if (all.empty()) fail(item, "Dimensions are missing");
  return all;
}

DataArray::Values XdmfItems::values(const pugi::xml_node& item) {
  const std::string kind = item.attribute("ItemType").as_string("Uniform");
  const std::string format = item.attribute("Format").as_string("XML");
  if (kind != "Uniform" || item.attribute("Reference"))
    fail(item, "data by reference, slice or function cannot be read: expected numbers or a table");
  if (format == "XML") return inline_values(item);
  if (format == "Binary") return binary_values(item);
  if (format != "HDF") {
    fail(item, fmt::format("data of format {} cannot be read: expected XML, HDF or Binary",
                           in_quotes(format)));
  }
  const std::string text = trimmed_text(item);
  const std::size_t colon = text.find(":/");
  if (colon == std::string::npos || colon + 2 >= text.size())
    fail(item, fmt::format("{} names no table: expected FILE:/PATH", in_quotes(text)));
  open(file_in(item, text.substr(0, colon)));
  return tables_->values(text.substr(colon + 2));
}

std::string XdmfItems::file_in(const pugi::xml_node& item, std::string name) const {
  const bool has_control = std::any_of(name.begin(), name.end(), [](char c) {
    return std::iscntrl(static_cast<unsigned char>(c)) != 0;
  });
  if (has_control) fail(item, fmt::format("{} is no name of a file", in_quotes(name)));
  return name;
}

void XdmfItems::open(const std::string& name) {
  if (tables_ && name == open_name_) return;
  tables_.reset();  // one at a time is open
  input_.emplace(folder_ / name);
  tables_ = open_hdf5(*input_, "XDMF");
  open_name_ = name;
}

DataArray::Values XdmfItems::inline_values(const pugi::xml_node& item) const {
  const std::string type = xdmf_lower_case(
      item.attribute("NumberType").as_string(item.attribute("DataType").as_string("float")));
  const bool is_real = type == "float";
  const char* at = item.text().as_string();
  std::vector<double> reals;
  std::vector<std::int64_t> integers;
  for (;;) {
    while (*at != '\0' && std::isspace(static_cast<unsigned char>(*at)) != 0) ++at;
    if (*at == '\0') break;
    char* end = nullptr;
    if (is_real)
      reals.push_back(std::strtod(at, &end));
    else
      integers.push_back(std::strtoll(at, &end, 10));
    if (end == at)
      fail(item, fmt::format("{} is not a number", in_quotes(std::string_view(at).substr(0, 20))));
    at = end;
  }
  if (is_real) return reals;
  return integers;
}

/// Of a file that is nothing but numbers.
DataArray::Values XdmfItems::binary_values(const pugi::xml_node& item) const {
  const std::string type = xdmf_lower_case(
      item.attribute("NumberType").as_string(item.attribute("DataType").as_string("float")));
  const auto bytes_each = static_cast<std::size_t>(item.attribute("Precision").as_ullong(4));
  const bool is_real = type == "float";
  const bool is_known =
      (is_real || type == "int" || type == "uint") && (bytes_each == 4 || bytes_each == 8);
  if (!is_known || std::string_view(item.attribute("Compression").as_string("Raw")) != "Raw") {
    fail(item, fmt::format("binary data of type {} and {} bytes cannot be read: expected Float or "
                           "Int of 4 or 8 bytes, not compressed",
                           in_quotes(type), bytes_each));
  }
  const std::string endian = xdmf_lower_case(item.attribute("Endian").as_string("native"));
  const bool is_little =
      endian == "little" || (endian != "big" && std::endian::native == std::endian::little);
  const bool swap = is_little != (std::endian::native == std::endian::little);
  const InputFile file(folder_ / file_in(item, trimmed_text(item)));
  const auto first = static_cast<std::size_t>(item.attribute("Seek").as_ullong(0));
  std::size_t room = first > file.size() ? 0 : (file.size() - first) / bytes_each;
  std::size_t count = 1;
  for (const std::size_t extent : dimensions(item)) {
    if (extent > room) {
      fail(item, fmt::format("{} rows or columns cannot fit into the {} bytes of {}", extent,
                             file.size(), in_quotes(file.name())));
    }
    count *= extent;
    room = extent == 0 ? 0 : room / extent;
  }
  const char* const begin = file.begin() + first;
  if (is_real && bytes_each == 4) return loaded<float, float>(begin, count, swap);
  if (is_real) return loaded<double, double>(begin, count, swap);
  if (bytes_each == 8) return loaded<std::int64_t, std::int64_t>(begin, count, swap);
  if (type == "uint") return loaded<std::uint32_t, std::int64_t>(begin, count, swap);
  return loaded<std::int32_t, std::int32_t>(begin, count, swap);
}

std::vector<double> XdmfItems::reals(const pugi::xml_node& item) {
  return std::visit([](const auto& from) { return std::vector<double>(from.begin(), from.end()); },
                    values(item));
}

std::vector<std::int64_t> XdmfItems::integers(const pugi::xml_node& item) {
  constexpr double kMost = 9e15;  // what doubles have exactly
  return std::visit(
      [&](const auto& from) {
        std::vector<std::int64_t> all;
        all.reserve(from.size());
        for (const auto value : from) {
          if (!(std::abs(static_cast<double>(value)) <= kMost))
            fail(item, fmt::format("'{}' is not the number of anything", value));
          all.push_back(static_cast<std::int64_t>(value));
        }
        return all;
      },
      values(item));
}

}  // namespace tetmend::formats
