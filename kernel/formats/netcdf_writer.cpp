// SPDX-License-Identifier: MIT
// Writes files of netCDF in a classic form.
#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <type_traits>

#include "kernel/formats/byte_reader.h"
#include "kernel/formats/netcdf_file.h"

namespace tetmend::formats {
namespace {

constexpr std::uint64_t kMostOfTable = UINT32_MAX - 3;  // in CDF-2
constexpr std::size_t kAlignment = 4;
/// Of the integers of 32 bits, the texts and the real numbers that are written.
enum WrittenType : std::uint32_t { text_type = 2, int_type = 4, float_type = 5, double_type = 6 };

template <class Number>
void put_reversed(std::string& to, Number value) {
  if constexpr (std::endian::native == std::endian::little) value = byte_swapped(value);
  std::array<char, sizeof(Number)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(Number));
  to.append(bytes.data(), bytes.size());
}

std::uint32_t netcdf_type_of(const DataArray::Values& values) {
  constexpr std::array<std::uint32_t, 4> kTypes = {int_type, double_type, float_type, double_type};
  return kTypes[values.index()];
}
std::size_t byte_count_of(const DataArray::Values& values) {
  const std::size_t size = netcdf_type_of(values) == double_type ? 8 : 4;
  return size * std::visit([](const auto& numbers) { return numbers.size(); }, values);
}

void pad(std::string& text) {
  text.append((kAlignment - text.size() % kAlignment) % kAlignment, '\0');
}

}  // namespace

struct NetcdfWriter::Layout {
  unsigned version = 2;
  std::vector<std::uint64_t> begins;  ///< of tables
};

void NetcdfWriter::dimension(const std::string& name, std::size_t length) {
  dimensions_.emplace_back(name, length);
}

void NetcdfWriter::attribute(const std::string& name, DataArray::Values value) {
  attributes_.push_back({name, std::move(value), {}, false});
}

void NetcdfWriter::attribute(const std::string& name, std::string text) {
  attributes_.push_back({name, {}, std::move(text), true});
}

std::size_t NetcdfWriter::dimension_number(const std::string& name) const {
  const auto found = std::find_if(dimensions_.begin(), dimensions_.end(),
                                  [&](const auto& each) { return each.first == name; });
  assert(found != dimensions_.end());
  return static_cast<std::size_t>(found - dimensions_.begin());
}

void NetcdfWriter::add(const std::string& name, std::vector<std::string> dimensions,
                       DataArray::Values values, Attributes attributes) {
  Variable& variable = variables_.emplace_back();
  variable.name = name;
  for (const std::string& each : dimensions) variable.dimensions.push_back(dimension_number(each));
  variable.numbers = std::move(values);
  for (auto& [called, text] : attributes)
    variable.attributes.push_back({called, {}, std::move(text), true});
}

void NetcdfWriter::add_texts(const std::string& name, std::vector<std::string> dimensions,
                             const std::vector<std::string>& texts) {
  const std::size_t width = dimensions_[dimension_number(dimensions.back())].second;
  Variable& variable = variables_.emplace_back();
  variable.name = name;
  for (const std::string& each : dimensions) variable.dimensions.push_back(dimension_number(each));
  variable.is_text = true;
  for (const std::string& text : texts) {
    variable.text += text.substr(0, width);
    variable.text.append(width - std::min(width, text.size()), '\0');
  }
}

bool NetcdfWriter::is_step(const Variable& variable) const {
  return !variable.dimensions.empty() && dimensions_[variable.dimensions[0]].second == 0;
}

std::string NetcdfWriter::header(const Layout& layout) const {
  std::string out = "CDF";
  out += static_cast<char>(layout.version);
  const auto put_length = [&](std::uint64_t value) {
    if (layout.version == 5)
      put_reversed(out, value);
    else
      put_reversed(out, static_cast<std::uint32_t>(value));
  };
  const auto put_name = [&](const std::string& name) {
    put_length(name.size());
    out += name;
    pad(out);
  };
  const auto put_list = [&](std::uint32_t tag, std::size_t size) {
    put_reversed(out, size == 0 ? 0 : tag);
    put_length(size);
  };
  const auto put_attributes = [&](const std::vector<Attribute>& attributes) {
    put_list(12, attributes.size());
    for (const Attribute& attribute : attributes) {
      put_name(attribute.name);
      put_reversed<std::uint32_t>(
          out, attribute.is_text ? text_type : netcdf_type_of(attribute.numbers));
      if (attribute.is_text) {
        put_length(attribute.text.size());
        out += attribute.text;
      } else {
        std::visit(
            [&](const auto& numbers) {
              put_length(numbers.size());
              for (const auto number : numbers) put_reversed(out, number);
            },
            attribute.numbers);
      }
      pad(out);
    }
  };
  const bool has_steps = std::any_of(variables_.begin(), variables_.end(),
                                     [&](const Variable& each) { return is_step(each); });
  put_length(has_steps ? 1 : 0);
  put_list(10, dimensions_.size());
  for (const auto& [name, length] : dimensions_) {
    put_name(name);
    put_length(length);
  }
  put_attributes(attributes_);
  put_list(11, variables_.size());
  for (std::size_t v = 0; v < variables_.size(); ++v) {
    const Variable& variable = variables_[v];
    put_name(variable.name);
    put_length(variable.dimensions.size());
    for (const std::size_t dimension : variable.dimensions) put_length(dimension);
    put_attributes(variable.attributes);
    put_reversed<std::uint32_t>(out,
                                variable.is_text ? text_type : netcdf_type_of(variable.numbers));
    const std::size_t size =
        variable.is_text ? variable.text.size() : byte_count_of(variable.numbers);
    put_length((size + kAlignment - 1) / kAlignment * kAlignment);
    put_reversed<std::uint64_t>(out, layout.begins[v]);
  }
  return out;
}

void NetcdfWriter::write(OutputFile& out) const {
  Layout layout;
  layout.begins.resize(variables_.size());
  const auto size_of = [](const Variable& variable) {
    return variable.is_text ? variable.text.size() : byte_count_of(variable.numbers);
  };
  for (const Variable& variable : variables_) {
    if (size_of(variable) > kMostOfTable) layout.version = 5;
  }
  std::uint64_t at = header(layout).size();
  std::vector<std::size_t> order;  // tables with a row for each step come last
  for (const bool of_step : {false, true}) {
    for (std::size_t v = 0; v < variables_.size(); ++v) {
      if (is_step(variables_[v]) != of_step) continue;
      order.push_back(v);
      layout.begins[v] = at;
      at += (size_of(variables_[v]) + kAlignment - 1) / kAlignment * kAlignment;
    }
  }
  out.put(header(layout));
  for (const std::size_t v : order) {
    const Variable& variable = variables_[v];
    std::string bytes;
    const auto flush = [&](std::size_t most) {
      if (bytes.size() < most) return;
      out.put(bytes);
      bytes.clear();
    };
    if (variable.is_text) {
      bytes = variable.text;
    } else {
      std::visit(
          [&](const auto& numbers) {
            using Number = typename std::decay_t<decltype(numbers)>::value_type;
            using Written =
                std::conditional_t<std::is_same_v<Number, std::int64_t>, double, Number>;
            for (const Number number : numbers) {
              put_reversed(bytes, static_cast<Written>(number));
              flush(std::size_t{1} << 18);
            }
          },
          variable.numbers);
    }
    pad(bytes);  // what went before is a multiple of four
    flush(0);
  }
}

}  // namespace tetmend::formats
