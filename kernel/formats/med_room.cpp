// SPDX-License-Identifier: MIT
// What a MED file says besides mesh, groups and fields, and what it has no place for.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/med.h"
#include "kernel/printable.h"

namespace tetmend::formats {

bool is_med_name(std::string_view name) {
  return fits(name, kMedGroupNames);
}

std::string med_remark_key(std::string_view what, std::string_view about) {
  return about.empty() ? std::string(what) : fmt::format("{} of {}", what, about);
}

MedRemarks med_remarks(const MeshData& mesh) {
  MedRemarks remarks;
  if (mesh.variant != kMed) return remarks;
  for (const std::string& piece : mesh.deck) {
    const std::size_t end = piece.find('\0');
    if (end != std::string::npos) remarks[piece.substr(0, end)] = piece.substr(end + 1);
  }
  return remarks;
}

std::size_t med_remarks_to_miss(const MeshData& mesh) {
  std::size_t count = 0;
  for (const auto& [what, text] : med_remarks(mesh)) {
    const bool is_form =
        what == "mesh" || what == "NOM" || what == "order" || what.starts_with("bare family");
    const bool is_blank = text.find_first_not_of(' ') == std::string::npos;
    count += is_form || is_blank ? 0 : 1;
  }
  return count;
}

std::vector<std::string> not_in_med(const std::filesystem::path&, const MeshData& mesh) {
  std::vector<std::string> notes;
  const auto look = [&](const std::vector<DataArray>& arrays) {
    for (const DataArray& array : arrays) {
      if (!fits(array.name, kMedNames))
        notes.push_back(
            fmt::format("the name of the array '{}' is not kept as it is: .med has other rules",
                        printable(array.name)));
    }
  };
  look(mesh.point_data);
  look(mesh.tet_data);
  std::map<int, std::size_t> lists;
  for (const OtherElements& others : mesh.other_elements) {
    if (!others.data.empty() && ++lists[others.vtk_type] == 2) {
      notes.push_back(
          fmt::format("arrays of elements of VTK's type {} are not kept: .med has one "
                      "list of them",
                      others.vtk_type));
    }
  }
  return notes;
}

}  // namespace tetmend::formats
