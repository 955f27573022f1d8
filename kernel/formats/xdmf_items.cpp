// SPDX-License-Identifier: MIT
#include "kernel/formats/xdmf_items.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <variant>

#include <fmt/format.h>

namespace tetmend::formats {

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
  if (format != "HDF") {
    fail(item,
         fmt::format("data of format {} cannot be read: expected XML or HDF", in_quotes(format)));
  }
  std::string text = item.text().as_string();
  text.erase(0, std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  text.resize(text.find_last_not_of(" \t\r\n") + 1);
  const std::size_t colon = text.find(":/");
  if (colon == std::string::npos || colon + 2 >= text.size())
    fail(item, fmt::format("{} names no table: expected FILE:/PATH", in_quotes(text)));
  open(text.substr(0, colon));
  return tables_->values(text.substr(colon + 2));
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
