// SPDX-License-Identifier: MIT
// Reads MED files. Tables have all first coordinates, then all second ones, and so on.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_sets.h"
#include "kernel/formats/med.h"
#include "kernel/formats/med_blocks.h"
#include "kernel/formats/med_labels.h"
#include "kernel/geometry.h"

namespace tetmend::formats {
namespace {

/// Types that are not in kMedTypes, and that a mesh cannot do without.
constexpr std::array<std::string_view, 5> kOtherVolumes = {"P18", "H27", "OCT", "POE", "O12"};

class MedReader {
 public:
  MedReader(const InputFile& input, TetPlace* question)
      : input_(input), file_(open_hdf5(input, "MED")), question_(question), sorter_(mesh_) {}

  MeshData read() {
    find_mesh();
    read_points();
    read_blocks();
    labels_.read_families(*file_, "FAS/" + name_);
    for (const MedBlock& block : blocks_) labels_.use(block.kind().dimension, block.families);
    labels_.number_groups(mesh_);
    add_elements();
    add_groups();
    read_med_fields(*file_, name_, blocks_, sorter_, mesh_);
    note_the_rest();
    mesh_.variant = kMed;
    return std::move(mesh_);
  }

 private:
  void find_mesh() {
    const std::int64_t major = file_->integer("INFOS_GENERALES", "MAJ");
    const std::int64_t minor = file_->integer("INFOS_GENERALES", "MIN");
    if (major < 3 || major > 4) {
      file_->fail("INFOS_GENERALES",
                  fmt::format("the file is of version {}.{} of MED: expected 3 or "
                              "4, which MED's program medimport makes of older ones",
                              major, minor));
    }
    const std::vector<std::string> meshes = file_->names("ENS_MAA");
    if (meshes.size() != 1) {
      file_->fail("ENS_MAA", fmt::format("the file has {} meshes: expected one", meshes.size()));
    }
    name_ = meshes[0];
    const std::string path = "ENS_MAA/" + name_;
    if (file_->integer(path, "TYP") != 0)
      file_->fail(path, "the mesh is structured: expected tets");
    if (file_->integer(path, "ESP") != 3) file_->fail(path, "the mesh does not lie in space");
    add_med_remark(mesh_, "mesh", name_);
    for (const char* what : {"NOM", "UNI", "UNT", "DES"})
      add_med_remark(mesh_, what, file_->text(path, what));
    const std::vector<std::string> steps = file_->names(path);
    if (steps.empty()) file_->fail(path, "the mesh is empty");
    step_ = path + "/" + steps[0];
    if (steps.size() > 1) {
      mesh_.notes.push_back(
          fmt::format("of the {} steps of the mesh only the first is kept", steps.size()));
    } else if (file_->has(step_, "NDT") && file_->integer(step_, "NDT") != -1) {
      mesh_.notes.emplace_back("the time of the mesh is not kept");
    }
  }

  std::vector<std::int64_t> list(const std::string& path, std::size_t count) {
    if (!file_->has(path)) return {};
    std::vector<std::int64_t> values = file_->integers(path);
    if (values.size() != count) {
      file_->fail(path, fmt::format("the table has {} values: expected {}", values.size(), count));
    }
    return values;
  }

  std::vector<std::int64_t> families(const std::string& path, std::size_t count) {
    std::vector<std::int64_t> all = list(path + "/FAM", count);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i] > INT32_MIN && all[i] <= INT32_MAX) continue;
      file_->fail(path + "/FAM", fmt::format("'{}' is not the number of a family", all[i]));
    }
    return all;
  }

  void read_points() {
    const std::string path = step_ + "/NOE";
    const std::vector<double> all = file_->reals(path + "/COO");
    const std::size_t count = all.size() / 3;
    if (all.size() % 3 != 0)
      file_->fail(path + "/COO", "the coordinates are not three for each point");
    if (count > kMostVertices) file_->fail(path + "/COO", "the points are too many");
    mesh_.points.resize(count);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t point = i % count;
      if (!std::isfinite(all[i])) {
        file_->fail(path + "/COO",
                    fmt::format("a coordinate of point {} is not finite", point + 1));
      }
      mesh_.points[point][static_cast<Eigen::Index>(i / count)] = all[i];
    }
    point_families_ = families(path, count);
    mesh_.point_numbers = numbers(path, count);
  }

  std::vector<std::int64_t> numbers(const std::string& path, std::size_t count) {
    std::vector<std::int64_t> all = list(path + "/NUM", count);
    std::vector<std::int64_t> sorted = all;
    std::sort(sorted.begin(), sorted.end());
    const bool is_good =
        sorted.empty() ||
        (sorted[0] > 0 && std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
    if (!is_good)
      mesh_.notes.push_back(fmt::format("the numbers in {} are not kept: they are not unique",
                                        in_quotes("/" + path)));
    if (file_->has(path + "/NOM")) {
      mesh_.notes.push_back(
          fmt::format("the names of points or elements in {} are not kept", in_quotes("/" + path)));
    }
    return is_good ? all : std::vector<std::int64_t>();
  }

  void read_blocks() {
    const std::string path = step_ + "/MAI";
    if (!file_->has(path)) return;
    for (const std::string& name : file_->names(path)) {
      const auto type = std::find_if(kMedTypes.begin(), kMedTypes.end(),
                                     [&](const MedType& each) { return each.name == name; });
      if (type != kMedTypes.end()) {
        blocks_.push_back(read_block(*type, path + "/" + name));
      } else if (std::find(kOtherVolumes.begin(), kOtherVolumes.end(), name) !=
                 kOtherVolumes.end()) {
        file_->fail(path + "/" + name, "volume elements of this type cannot be kept");
      } else {
        mesh_.notes.push_back(
            fmt::format("elements of MED's type {} are not kept", in_quotes(name)));
      }
    }
    std::sort(blocks_.begin(), blocks_.end(),
              [](const MedBlock& a, const MedBlock& b) { return a.type < b.type; });
  }

  MedBlock read_block(const MedType& type, const std::string& path) {
    MedBlock block;
    block.type = &type;
    block.path = path;
    block.nodes = file_->integers(path + "/NOD");
    const std::size_t width = block.kind().width;
    block.count = block.nodes.size() / width;
    if (block.nodes.size() % width != 0) {
      file_->fail(path + "/NOD",
                  fmt::format("{} numbers are not {} for each element", block.nodes.size(), width));
    }
    for (std::size_t i = 0; i < block.nodes.size(); ++i) {
      if (block.nodes[i] >= 1 && block.nodes[i] <= static_cast<std::int64_t>(mesh_.points.size()))
        continue;
      file_->fail(path + "/NOD",
                  fmt::format("'{}' in element {} is not the number of a node: expected 1 to {}",
                              block.nodes[i], i % block.count + 1, mesh_.points.size()));
    }
    block.families = families(path, block.count);
    block.numbers = numbers(path, block.count);
    return block;
  }

  /// Files of other writers may have tets as VTK has them: most have a positive volume then.
  bool are_volumes_as_in_vtk() const {
    std::size_t turned = 0;
    std::size_t as_in_vtk = 0;
    for (const MedBlock& block : blocks_) {
      if (block.kind().dimension != 3 || block.kind().corners != 4) continue;
      for (std::size_t i = 0; i < block.count; ++i) {
        const auto point = [&](std::size_t k) {
          return mesh_.points[static_cast<std::size_t>(block.nodes[k * block.count + i] - 1)];
        };
        const double volume = volume6(point(0), point(1), point(2), point(3));
        turned += volume < 0 ? 1 : 0;
        as_in_vtk += volume > 0 ? 1 : 0;
      }
    }
    return as_in_vtk > turned;
  }

  void add_elements() {
    const bool as_in_vtk = are_volumes_as_in_vtk();
    if (as_in_vtk) add_med_remark(mesh_, "order", "VTK");
    bool with_numbers = true;
    std::set<std::int64_t> all;
    for (const MedBlock& block : blocks_) {
      with_numbers &= block.count == 0 || !block.numbers.empty();
      for (const std::int64_t number : block.numbers) with_numbers &= all.insert(number).second;
    }
    const bool has_numbers = !all.empty();
    const bool has_families =
        std::any_of(blocks_.begin(), blocks_.end(),
                    [](const MedBlock& block) { return !block.families.empty(); });
    if (has_numbers && !with_numbers)
      mesh_.notes.emplace_back("numbers of elements are not kept: not all have one of their own");
    for (const MedBlock& block : blocks_) {
      const ElementKind& kind = block.kind();
      std::vector<Label>& parts = med_lists_of(kind, sorter_, mesh_).parts;
      ElementRow row;
      row.kind = &kind;
      for (std::size_t i = 0; i < block.count; ++i) {
        for (std::size_t k = 0; k < kind.width; ++k) {
          const std::size_t from =
              as_in_vtk || block.type->order[1] == 0 ? k : block.type->order[k];
          row.vertices[k] = static_cast<std::uint32_t>(block.nodes[from * block.count + i] - 1);
        }
        const Label family = block.family(i);
        row.label = labels_.label_of(kind.dimension, family);
        row.number = block.numbers.empty() ? 0 : block.numbers[i];
        sorter_.add(row, has_numbers && with_numbers);
        if (has_families) parts.push_back(family);
        if (is_last_asked_for(question_, mesh_, kind.vtk_type)) {
          question_->place = fmt::format("{}: /{}: element {}", input_.name(), block.path, i + 1);
        }
      }
    }
  }

  /// Of points: a family without groups is a label.
  void add_groups() {
    std::map<std::string, std::size_t> group_at;
    mesh_.point_labels.assign(mesh_.points.size(), 0);
    for (std::uint32_t i = 0; i < point_families_.size(); ++i) {
      const auto family = static_cast<Label>(point_families_[i]);
      if (!labels_.has_groups(true, family)) {
        mesh_.point_labels[i] = family;
        continue;
      }
      for (const std::string& name : labels_.groups_of_points(family)) {
        if (to_label(inp_key(name), mesh_.point_labels[i])) continue;
        const auto [at, is_new] = group_at.try_emplace(name, mesh_.groups.size());
        if (is_new) mesh_.groups.push_back({0, static_cast<Label>(group_at.size()), name, {}, {}});
        mesh_.groups[at->second].members.push_back(i);
      }
    }
    drop_zero_point_labels(mesh_);
  }

  void note_the_rest() {
    const auto note = [&](const std::string& group, std::initializer_list<std::string_view> known) {
      for (const std::string& name : file_->names(group)) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        mesh_.notes.push_back(
            fmt::format("the section {} is not kept",
                        in_quotes(group == "/" ? "/" + name : "/" + group + "/" + name)));
      }
    };
    note("/", {"INFOS_GENERALES", "ENS_MAA", "FAS", "CHA", "PROFILS", "GAUSS"});
    note(step_, {"NOE", "MAI"});
    note(step_ + "/NOE", {"COO", "FAM", "NUM", "NOM"});
    for (const MedBlock& block : blocks_) note(block.path, {"NOD", "FAM", "NUM", "NOM"});
  }

  const InputFile& input_;
  std::unique_ptr<Hdf5Reader> file_;
  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  std::string name_;  // of the mesh
  std::string step_;  // its path
  std::vector<std::int64_t> point_families_;
  std::vector<MedBlock> blocks_;
  MedLabels labels_;
};

}  // namespace

MeshData read_med(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return MedReader(input, question).read();
}

}  // namespace tetmend::formats
