// SPDX-License-Identifier: MIT
// Reads fields of MED files.
#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "kernel/formats/input_file.h"
#include "kernel/formats/med_blocks.h"

namespace tetmend::formats {
namespace {

constexpr std::string_view kWholeMesh = "MED_NO_PROFILE_INTERNAL";

std::string without_padding(std::string text) {
  text.resize(text.find_last_not_of(' ') + 1);
  return text;
}

class MedFieldReader {
 public:
  MedFieldReader(const Hdf5Reader& file, std::string name, std::span<const MedBlock> blocks,
                 ElementSorter& sorter, MeshData& mesh)
      : file_(file), name_(std::move(name)), blocks_(blocks), sorter_(sorter), mesh_(mesh) {}

  void read() {
    if (!file_.has("CHA")) return;
    for (const std::string& name : file_.names("CHA")) {
      const std::string path = "CHA/" + name;
      if (without_padding(file_.text(path, "MAI")) != name_) {
        mesh_.notes.push_back(
            fmt::format("the field {} is not kept: it is of another mesh", in_quotes(name)));
        continue;
      }
      const std::vector<std::string> steps = file_.names(path);
      if (steps.size() > 1) {
        mesh_.notes.push_back(fmt::format("of the {} steps of the field {} only the first is kept",
                                          steps.size(), in_quotes(name)));
      }
      if (steps.empty()) continue;
      for (const char* what : {"NOM", "UNI", "UNT"})
        add_med_remark(mesh_, what, file_.text(path, what), name);
      read_step(name, path + "/" + steps[0]);
    }
  }

 private:
  void read_step(const std::string& name, const std::string& path) {
    const std::int64_t components = file_.integer("CHA/" + name, "NCO");
    if (components < 1 || components > 1000000)
      file_.fail("CHA/" + name, "the number of components makes no sense");
    add_med_remark(mesh_, "step",
                   fmt::format("{} {} {}", file_.integer(path, "NDT"), file_.integer(path, "NOR"),
                               file_.real(path, "PDT")),
                   name);
    for (const std::string& support : file_.names(path)) {
      const std::string profile = without_padding(file_.text(path + "/" + support, "PFL"));
      const std::string values = path + "/" + support + "/" + profile;
      const auto block = std::find_if(blocks_.begin(), blocks_.end(), [&](const MedBlock& each) {
        return "MAI." + std::string(each.type->name) == support;
      });
      const bool is_whole =
          profile == kWholeMesh && file_.has(values, "NGA") && file_.integer(values, "NGA") == 1;
      if ((support != "NOE" && block == blocks_.end()) || !is_whole) {
        mesh_.notes.push_back(fmt::format("the values of the field {} for {} are not kept: {}",
                                          in_quotes(name), in_quotes(support),
                                          profile == kWholeMesh
                                              ? "they are not one for each point or element"
                                              : "they are of a part of the mesh"));
        continue;
      }
      const std::size_t count = support == "NOE" ? mesh_.points.size() : block->count;
      add_array(
          name, values + "/CO", count, static_cast<std::size_t>(components),
          support == "NOE" ? mesh_.point_data : med_lists_of(block->kind(), sorter_, mesh_).data);
    }
  }

  void add_array(const std::string& name, const std::string& path, std::size_t count,
                 std::size_t components, std::vector<DataArray>& to) {
    DataArray array;
    array.name = name;
    array.components = components;
    array.values = file_.values(path);
    if (array.size() != count * components || count == 0) {
      file_.fail(path, fmt::format("the table has {} values: expected {} for each of {}",
                                   array.size(), components, count));
    }
    std::visit(
        [&](auto& values) {
          auto turned = values;
          for (std::size_t i = 0; i < values.size(); ++i)
            turned[i % count * components + i / count] = values[i];
          values = std::move(turned);
        },
        array.values);
    to.push_back(std::move(array));
  }

  const Hdf5Reader& file_;
  std::string name_;  // of the mesh
  std::span<const MedBlock> blocks_;
  ElementSorter& sorter_;
  MeshData& mesh_;
};

}  // namespace

void read_med_fields(const Hdf5Reader& file, const std::string& name,
                     std::span<const MedBlock> blocks, ElementSorter& sorter, MeshData& mesh) {
  MedFieldReader(file, name, blocks, sorter, mesh).read();
}

}  // namespace tetmend::formats
