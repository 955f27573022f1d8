// SPDX-License-Identifier: MIT
// Writes MED files.
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/med.h"
#include "kernel/formats/med_families.h"
#include "kernel/formats/new_numbers.h"
#include "kernel/formats/output_file.h"
#include "kernel/formats/unique_names.h"

namespace tetmend::formats {
namespace {

const std::string kWhole = "MED_NO_PROFILE_INTERNAL";
constexpr std::int32_t kMedReal = 6;
constexpr std::int32_t kMedInteger32 = 24;
constexpr std::int32_t kMedInteger64 = 26;

constexpr std::array<std::int64_t, 2> kMedLimits = {INT32_MAX, INT64_MAX};

class MedWriter {
 public:
  MedWriter(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file),
        file_(make_hdf5(file.string(), "MED")),
        mesh_(mesh),
        lists_(mesh),
        remarks_(mesh.data() == nullptr ? MedRemarks() : med_remarks(*mesh.data())),
        families_(mesh.data(), remarks_) {}

  void write() {
    begin_mesh();
    write_points();
    write_elements();
    write_families();
    write_fields();
    out_.put(file_->bytes());
    out_.commit(mesh_.companions());
  }

 private:
  std::string remark(std::string_view what, std::string_view otherwise,
                     std::string_view about = {}) const {
    const auto found = remarks_.find(med_remark_key(what, about));
    return found == remarks_.end() ? std::string(otherwise) : found->second;
  }

  void begin_mesh() {
    file_->group("INFOS_GENERALES");
    file_->set("INFOS_GENERALES", "MAJ", 3);  // which programs with MED 4 read, too
    file_->set("INFOS_GENERALES", "MIN", 0);
    file_->set("INFOS_GENERALES", "REL", 0);
    name_ = fit_name(remark("mesh", "mesh"), kMedNames);
    const std::string path = "ENS_MAA/" + name_;
    file_->group(path);
    for (const char* what : {"DIM", "ESP"}) file_->set(path, what, 3);
    for (const char* what : {"REP", "TYP"}) file_->set(path, what, 0);
    file_->set(path, "SRT", 1);
    for (const char* what : {"NXT", "NXI"}) file_->set(path, what, -1);
    file_->set(path, "NOM", remark("NOM", fmt::format("{:<16}{:<16}{:<16}", "x", "y", "z")));
    file_->set(path, "UNI", remark("UNI", std::string(48, ' ')));
    file_->set(path, "UNT", remark("UNT", ""));
    file_->set(path, "DES", remark("DES", ""));
    step_ = path + "/-0000000000000000001-0000000000000000001";
    file_->group(step_);
    for (const char* what : {"NDT", "NOR", "NXT", "NXI", "PVT", "PVI"}) file_->set(step_, what, -1);
    file_->set(step_, "PDT", -1.0);
    file_->set(step_, "CGT", 1);
  }

  void begin_support(const std::string& path) {
    file_->group(path);
    file_->set(path, "CGT", 1);
    file_->set(path, "CGS", 1);
    file_->set(path, "PFL", kWhole);
  }
  void write_list(const std::string& path, DataArray::Values values, std::size_t count) {
    file_->write(path, values);
    file_->set(path, "CGT", 1);
    file_->set(path, "NBR", static_cast<std::int32_t>(count));
  }
  /// With 32 bits where they do, as MED has integers.
  static DataArray::Values integers(std::vector<std::int64_t> values) {
    if (std::all_of(values.begin(), values.end(),
                    [](std::int64_t value) { return value <= INT32_MAX; })) {
      return std::vector<std::int32_t>(values.begin(), values.end());
    }
    return values;
  }

  void write_points() {
    const std::size_t count = mesh_.point_count();
    const std::string path = step_ + "/NOE";
    begin_support(path);
    std::vector<double> all(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
      const Point point = mesh_.point(i);
      for (std::size_t axis = 0; axis < 3; ++axis)
        all[axis * count + i] = point[static_cast<Eigen::Index>(axis)];
    }
    write_list(path + "/COO", std::move(all), count);
    const std::vector<std::uint32_t> chains = families_.chains(0, count);
    point_places_.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      point_places_[i] = families_.place_of({0, false, 0, mesh_.point_label(i), chains[i]});
    if (mesh_.data() != nullptr && mesh_.data()->point_numbers.size() == count) {
      std::vector<std::int64_t> numbers = written_point_numbers(mesh_, kMedLimits);
      if (count > 0) write_list(path + "/NUM", integers(std::move(numbers)), count);
    }
  }

  /// All elements of one type.
  struct Block {
    const MedType* type = nullptr;
    std::vector<const ElementList*> lists;
    std::size_t count = 0;
    std::vector<std::uint32_t> places;  // of families

    std::string path(const std::string& step) const {
      return step + "/MAI/" + std::string(type->name);
    }
  };

  void write_elements() {
    for (const MedType& type : kMedTypes) {
      Block block;
      block.type = &type;
      for (const ElementList& list : lists_.all()) {
        if (list.kind.vtk_type != type.vtk_type) continue;
        block.lists.push_back(&list);
        block.count += list.count;
      }
      if (block.count > 0) blocks_.push_back(std::move(block));
    }
    if (blocks_.empty()) return;
    file_->group(step_ + "/MAI");
    file_->set(step_ + "/MAI", "CGT", 1);
    bool with_numbers = true;
    std::vector<std::int64_t> known;  // elements of two types may have the same
    for (const ElementList& list : lists_.all()) {
      with_numbers = with_numbers && list.numbers != nullptr;
      if (with_numbers) known.insert(known.end(), list.numbers->begin(), list.numbers->end());
    }
    NewNumbers next = numbers_beside(known, lists_.taken_numbers(), kMedLimits);
    for (Block& block : blocks_) {
      write_block(block);
      if (with_numbers) write_numbers(block, next);
    }
  }

  void write_block(Block& block) {
    begin_support(block.path(step_));
    file_->set(block.path(step_), "GEO", block.type->number);
    const std::size_t width = element_kind(block.type->vtk_type)->width;
    const bool as_in_vtk = remark("order", "") == "VTK" || block.type->order[1] == 0;
    std::vector<std::int64_t> nodes(block.count * width);
    std::size_t done = 0;
    for (const ElementList* list : block.lists) {
      for (std::size_t i = 0; i < list->count; ++i, ++done) {
        const std::span<const std::uint32_t> vertices = list->vertices(i);
        for (std::size_t k = 0; k < width; ++k) {
          nodes[k * block.count + done] =
              std::int64_t{vertices[as_in_vtk ? k : block.type->order[k]]} + 1;
        }
      }
      assign(*list, block.places);
    }
    write_list(block.path(step_) + "/NOD", integers(std::move(nodes)), block.count);
  }

  /// Lists of other elements are in groups by their parts and labels alone.
  void assign(const ElementList& list, std::vector<std::uint32_t>& places) {
    const int dimension = list.kind.dimension;
    const std::vector<std::uint32_t> chains =
        families_.chains(list.others == nullptr ? dimension : -1, list.count);
    for (std::size_t i = 0; i < list.count; ++i) {
      const bool has_part = list.parts != nullptr;
      places.push_back(
          families_.place_of({std::max(dimension, 1), has_part, has_part ? (*list.parts)[i] : 0,
                              list.label(i), chains[i]}));
    }
  }

  void write_numbers(const Block& block, NewNumbers& next) {
    std::vector<std::int64_t> numbers;
    for (const ElementList* list : block.lists)
      numbers.insert(numbers.end(), list->numbers->begin(), list->numbers->end());
    complete(numbers, next);
    write_list(block.path(step_) + "/NUM", integers(std::move(numbers)), block.count);
  }

  void write_families() {
    const std::vector<MedFamilies::Family> all = families_.finish();
    const auto write = [&](const std::string& path, const std::vector<std::uint32_t>& places) {
      std::vector<std::int32_t> numbers;
      for (const std::uint32_t place : places) numbers.push_back(all[place].number);
      if (std::all_of(numbers.begin(), numbers.end(),
                      [](std::int32_t number) { return number == 0; }))
        return;
      write_list(path + "/FAM", numbers, places.size());
    };
    write(step_ + "/NOE", point_places_);
    for (const Block& block : blocks_) write(block.path(step_), block.places);
    const std::string path = "FAS/" + name_;
    file_->group(path + "/FAMILLE_ZERO");
    file_->set(path + "/FAMILLE_ZERO", "NUM", 0);
    std::map<std::int32_t, const MedFamilies::Family*> sorted;
    for (const MedFamilies::Family& family : all) sorted[family.number] = &family;
    for (const auto& [number, family] : sorted) {
      if (number != 0) write_family(path + (number > 0 ? "/NOEUD/" : "/ELEME/"), *family);
    }
  }

  void write_family(const std::string& folder, const MedFamilies::Family& family) {
    std::string name = fmt::format("FAM_{}", family.number);
    for (const std::string& group : family.groups) name += "_" + group;
    const std::string path = folder + fit_name(name, kMedNames);
    file_->group(path);
    file_->set(path, "NUM", family.number);
    if (family.groups.empty()) return;
    file_->group(path + "/GRO");
    file_->set(path + "/GRO", "NBR", static_cast<std::int32_t>(family.groups.size()));
    file_->write_texts(path + "/GRO/NOM", family.groups, kMedGroupNames.most);
  }

  void write_fields() {
    if (mesh_.data() == nullptr) return;
    for (const DataArray& array : mesh_.data()->point_data)
      write_field(array, "NOE", mesh_.point_count());
    for (const Block& block : blocks_) {
      if (block.lists.size() > 1) continue;  // see not_in_med()
      for (const DataArray& array : *block.lists[0]->data) {
        write_field(array, "MAI." + std::string(block.type->name), block.count);
      }
    }
  }

  void write_field(const DataArray& array, const std::string& support, std::size_t count) {
    const std::string path = field_of(array) + "/" + support;
    file_->group(path);
    file_->set(path, "GAU", "");
    file_->set(path, "PFL", kWhole);
    const std::string values = path + "/" + kWhole;
    file_->group(values);
    file_->set(values, "GAU", "");
    file_->set(values, "NBR", static_cast<std::int32_t>(count));
    file_->set(values, "NGA", 1);
    const auto turned = [&](const auto& from, auto to) {
      to.resize(from.size());
      for (std::size_t i = 0; i < from.size(); ++i)
        to[i % array.components * count + i / array.components] = from[i];
      file_->write(values + "/CO", std::move(to));
    };
    std::visit(
        [&](const auto& from) {
          using Values = std::decay_t<decltype(from)>;
          if constexpr (std::is_same_v<Values, std::vector<float>>) {
            turned(from, std::vector<double>());
          } else {
            turned(from, Values());
          }
        },
        array.values);
  }

  /// The path of the step of its field, made if need be. Arrays of one name that are alike share one.
  std::string field_of(const DataArray& array) {
    const std::int32_t type = array.values.index() == 0   ? kMedInteger32
                              : array.values.index() == 1 ? kMedInteger64
                                                          : kMedReal;
    const auto [at, is_new] = fields_.try_emplace({array.name, type, array.components});
    if (!is_new) return at->second;
    const std::string path = "CHA/" + field_names_.make_fit(array.name);
    const auto width = static_cast<std::int32_t>(array.components);
    file_->group(path);
    file_->set(path, "MAI", name_);
    file_->set(path, "TYP", type);
    file_->set(path, "NCO", width);
    const std::string blanks(16 * array.components, ' ');
    for (const char* what : {"NOM", "UNI"})
      file_->set(path, what, remark(what, blanks, array.name));
    file_->set(path, "UNT", remark("UNT", "", array.name));
    std::istringstream step(remark("step", "-1 -1 0", array.name));
    std::int32_t number = -1;
    std::int32_t order = -1;
    double time = 0;
    step >> number >> order >> time;
    at->second = fmt::format("{}/{:020}{:020}", path, number, order);
    file_->group(at->second);
    file_->set(at->second, "NDT", number);
    file_->set(at->second, "NOR", order);
    file_->set(at->second, "PDT", time);
    for (const char* what : {"RDT", "ROR"}) file_->set(at->second, what, -1);
    return at->second;
  }

  OutputFile out_;
  std::unique_ptr<Hdf5Writer> file_;
  const MeshView& mesh_;
  ElementLists lists_;
  MedRemarks remarks_;
  MedFamilies families_;
  std::string name_;  // of the mesh
  std::string step_;  // its path
  std::vector<std::uint32_t> point_places_;
  std::vector<Block> blocks_;
  std::map<std::tuple<std::string, std::int32_t, std::size_t>, std::string> fields_;
  UniqueNames field_names_{kMedNames};
};

}  // namespace

void write_med(const std::filesystem::path& file, const MeshView& mesh) {
  MedWriter(file, mesh).write();
}

}  // namespace tetmend::formats
