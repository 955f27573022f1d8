// SPDX-License-Identifier: MIT
#include "kernel/formats/gmsh_rows.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"

namespace tetmend::formats {
namespace {

/// Without what would end the name in a file.
std::string clean_name(std::string_view name) {
  std::string clean(name);
  std::replace(clean.begin(), clean.end(), '\n', ' ');
  return clean;
}

}  // namespace

void GmshSections::begin(std::string_view section) {
  out_.put(fmt::format("${}\n", section));
}

void GmshSections::end_numbers(std::string_view section) {
  if (binary_) out_.put('\n');
  end(section);
}

void GmshSections::end(std::string_view section) {
  out_.put(fmt::format("$End{}\n", section));
}

void GmshSections::write_header() {
  out_.put(fmt::format("$MeshFormat\n{} {} 8\n", is_4_ ? "4.1" : "2.2", binary_ ? 1 : 0));
  if (binary_) {
    out_.put_bytes(std::int32_t{1});
    out_.put('\n');
  }
  end("MeshFormat");
}

void GmshSections::write_names(std::span<const Group> names) {
  if (names.empty()) return;
  begin("PhysicalNames");
  out_.put(fmt::format("{}\n", names.size()));
  for (const Group& group : names) {
    out_.put(fmt::format("{} {} \"{}\"\n", group.dimension, group.number, clean_name(group.name)));
  }
  end("PhysicalNames");
}

void GmshSections::write_entities(const std::array<std::vector<GeometricEntity>, 4>& entities) {
  begin("Entities");
  auto counts = row();
  for (const auto& of_dimension : entities) counts.size(of_dimension.size());
  counts.end();
  for (const auto& of_dimension : entities) {
    for (const GeometricEntity& entity : of_dimension) write_entity(entity);
  }
  end_numbers("Entities");
}

void GmshSections::write_entity(const GeometricEntity& entity) {
  auto numbers = row();
  numbers.integer(entity.tag);
  for (std::size_t k = 0; k < (entity.dimension == 0 ? 3U : 6U); ++k) numbers.real(entity.box[k]);
  numbers.size(entity.groups.size());
  for (const Label group : entity.groups) numbers.integer(group);
  if (entity.dimension > 0) {
    numbers.size(entity.boundary.size());
    for (const Label tag : entity.boundary) numbers.integer(tag);
  }
  numbers.end();
}

void GmshSections::write_view_head(std::string_view section, std::string_view view,
                                   std::size_t components, std::size_t count) {
  if (count > INT32_MAX) {
    throw Error(
        fmt::format("{}: cannot be written: a view of the format holds at most {} "
                    "values, '{}' has {}",
                    name_, INT32_MAX, view, count));
  }
  begin(section);
  out_.put(fmt::format("1\n\"{}\"\n1\n0\n3\n0\n{}\n{}\n", clean_name(view), components, count));
}

}  // namespace tetmend::formats
