// SPDX-License-Identifier: MIT
// Reads files of Exodus II.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "kernel/exact_orientation.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_orders.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/exodus.h"
#include "kernel/formats/exodus_tables.h"
#include "kernel/formats/netcdf_file.h"

namespace tetmend::formats {
namespace {

class ExodusReader {
 public:
  ExodusReader(const InputFile& input, TetPlace* question)
      : file_(open_netcdf(input, "Exodus")), input_(input), question_(question), sorter_(mesh_) {}

  MeshData read() {
    read_points();
    read_blocks();
    read_sets("ns", "node set");
    read_sets("ss", "side set");
    read_sets("els", "element set");
    number_sets_of_dimensions();
    label_elements();
    std::vector<ElementSet> all = std::move(volumes_);
    for (auto* sets : {&surfaces_, &points_})
      std::move(sets->begin(), sets->end(), std::back_inserter(all));
    if (!all.empty()) add_groups(mesh_, places_, homes_, all);
    read_exodus_variables(*file_, blocks_, mesh_, known_);
    note_exodus_rest(*file_, mesh_, known_);
    mesh_.variant = kExodus;
    return std::move(mesh_);
  }

 private:
  std::string numbered(std::string_view name, std::size_t number) {
    std::string made = fmt::format("{}{}", name, number);
    known_.insert(made);
    return made;
  }
  bool has(const std::string& name) {
    known_.insert(name);
    return file_->has(name);
  }

  // ---- Points and elements ------------------------------------------------------------------------

  void read_points() {
    std::array<std::vector<double>, 3> axes;
    if (has("coord")) {
      const std::vector<double> all = file_->reals("coord");
      const auto extents = file_->extents("coord");
      if (extents.size() != 2 || extents[0] != 3) {
        file_->fail("coord", "the mesh does not lie in space: expected three rows");
      }
      const auto count = static_cast<std::ptrdiff_t>(extents[1]);
      for (std::ptrdiff_t k = 0; k < 3; ++k) {
        axes[static_cast<std::size_t>(k)].assign(all.begin() + k * count,
                                                 all.begin() + (k + 1) * count);
      }
    } else if (file_->has("coordx") || !file_->has("/", "api_version")) {
      constexpr std::array<const char*, 3> kNames = {"coordx", "coordy", "coordz"};
      for (std::size_t k = 0; k < 3; ++k) {
        known_.insert(kNames[k]);
        axes[k] = file_->reals(kNames[k]);
        if (axes[k].size() == axes[0].size()) continue;
        file_->fail(kNames[k], fmt::format("the table has {} values: expected {}", axes[k].size(),
                                           axes[0].size()));
      }
    }
    if (axes[0].size() > kMostVertices) file_->fail("coordx", "the points are too many");
    mesh_.points.resize(axes[0].size());
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < axes[k].size(); ++i) {
        if (!std::isfinite(axes[k][i])) {
          file_->fail("/", fmt::format("a coordinate of point {} is not finite", i + 1));
        }
        mesh_.points[i][static_cast<Eigen::Index>(k)] = axes[k][i];
      }
    }
    mesh_.point_numbers = numbers_of("node_num_map", mesh_.points.size());
  }

  std::vector<std::int64_t> numbers_of(const std::string& name, std::size_t count) {
    if (!has(name)) return {};
    std::vector<std::int64_t> all = file_->integers(name);
    std::vector<std::int64_t> sorted = all;
    std::sort(sorted.begin(), sorted.end());
    const bool is_good = all.size() == count && !sorted.empty() && sorted[0] > 0 &&
                         std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
    if (is_good) return all;
    if (count > 0) {
      mesh_.notes.push_back(
          fmt::format("the numbers in {} are not kept: they are not unique", in_quotes(name)));
    }
    return {};
  }

  std::vector<std::int64_t> ids(const std::string& name) {
    return has(name) ? file_->integers(name) : std::vector<std::int64_t>();
  }
  std::vector<std::string> names(const std::string& name) {
    return has(name) ? file_->texts(name) : std::vector<std::string>();
  }

  void read_blocks() {
    const std::vector<std::int64_t> numbers = ids("eb_prop1");
    const std::vector<std::string> called = names("eb_names");
    for (std::size_t b = 1; b <= numbers.size() || file_->has(fmt::format("connect{}", b)); ++b) {
      const std::string path = numbered("connect", b);
      if (const std::string faces = numbered("facconn", b); file_->has(faces))
        file_->fail(faces, "polyhedra cannot be kept: expected tets, pyramids, prisms, hexahedra");
      if (!file_->has(path)) continue;  // a block without elements
      ExodusBlock block;
      block.path = path;
      block.index = b;
      block.number = b <= numbers.size() ? numbers[b - 1] : static_cast<std::int64_t>(b);
      if (b <= called.size()) block.name = called[b - 1];
      const auto extents = file_->extents(path);
      if (extents.size() == 2) block.kind = kind_of(path, extents[1]);
      block.count = extents.empty() ? 0 : static_cast<std::size_t>(extents[0]);
      const std::string of_polygons = numbered("ebepecnt", b);  // whose table is one of nodes
      if (block.kind == nullptr && file_->has(of_polygons) && !file_->extents(of_polygons).empty())
        block.count = static_cast<std::size_t>(file_->extents(of_polygons)[0]);
      blocks_.push_back(block);
      if (block.kind == nullptr) {
        mesh_.notes.push_back(fmt::format("{} elements of Exodus' type {} are not kept",
                                          block.count, in_quotes(file_->text(path, "elem_type"))));
      }
    }
    if (blocks_.empty() && !mesh_.points.empty() && !file_->has("/", "api_version"))
      file_->fail("/", "the file has no elements: expected a table connect1");
    std::size_t count = 0;
    for (const ExodusBlock& block : blocks_) count += block.count;
    const std::vector<std::int64_t> all = numbers_of("elem_num_map", count);
    std::size_t first = 0;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      add_block(blocks_[b], static_cast<std::uint32_t>(b), all, first);
      first += blocks_[b].count;
    }
  }

  /// Null: none that is kept. Volumes that are none of ours are errors.
  const ElementKind* kind_of(const std::string& path, std::uint64_t width) const {
    const std::string name = file_->text(path, "elem_type");
    if (is_exodus_volume(name) && exodus_kind(name, width) == nullptr) {
      file_->fail(path, fmt::format("volume elements of type {} and {} nodes cannot be kept",
                                    in_quotes(name), width));
    }
    return exodus_kind(name, width);
  }

  void add_block(ExodusBlock& block, std::uint32_t home, const std::vector<std::int64_t>& numbers,
                 std::size_t first) {
    block.first_place = places_.size();
    place_of_.resize(first + block.count, kNoPlace);
    if (block.kind == nullptr) return;
    const ElementKind& kind = *block.kind;
    const std::vector<std::int64_t> nodes = file_->integers(block.path);
    const auto order = upright_first_order(kind.vtk_type);
    ElementRow row;
    row.kind = &kind;
    for (std::size_t i = 0; i < block.count; ++i) {
      for (std::size_t k = 0; k < kind.width; ++k) {
        const std::int64_t node = nodes[i * kind.width + (order.empty() ? k : order[k])];
        if (node < 1 || node > static_cast<std::int64_t>(mesh_.points.size())) {
          file_->fail(
              block.path,
              fmt::format("'{}' in element {} is not the number of a node: expected 1 to {}", node,
                          i + 1, mesh_.points.size()));
        }
        row.vertices[k] = static_cast<std::uint32_t>(node - 1);
      }
      row.number = numbers.empty() ? 0 : numbers[first + i];
      const std::size_t before = places_.size();
      std::uint32_t place = static_cast<std::uint32_t>(before);
      if (kind.dimension == 2 && kind.corners == kind.width) {
        place = faces_.add(row, sorter_, mesh_, places_);
      } else {
        sorter_.add(row, true);
        places_.push_back(last_place(mesh_, kind));
      }
      if (places_.size() > before) homes_.push_back(home);
      place_of_[first + i] = place;
      if (is_last_asked_for(question_, mesh_, kind.vtk_type)) {
        question_->place = fmt::format("{}: '/{}': element {}", input_.name(), block.path, i + 1);
      }
    }
    const std::size_t twice = block.count - (places_.size() - block.first_place);
    if (twice > 0) {
      mesh_.notes.push_back(fmt::format("{} elements of {} are not kept: they lie on others", twice,
                                        in_quotes(block.path)));
    }
  }

  // ---- Sets ---------------------------------------------------------------------------------------

  void read_sets(const std::string& kind, std::string_view what) {
    const std::vector<std::int64_t> numbers = ids(kind + "_prop1");
    const std::vector<std::string> called = names(kind + "_names");
    const std::string members = kind == "ns" ? "node_ns" : kind == "ss" ? "elem_ss" : "elem_els";
    for (std::size_t s = 1; s <= numbers.size() || file_->has(fmt::format("{}{}", members, s));
         ++s) {
      const std::string path = numbered(members, s);
      ElementSet set;
      set.number = s <= numbers.size() ? numbers[s - 1] : static_cast<std::int64_t>(s);
      if (s <= called.size()) set.name = called[s - 1];
      const bool is_there = file_->has(path);
      if (is_there && file_->extents(path).empty()) file_->fail(path, "the table has no dimension");
      if (!is_there || file_->extents(path)[0] == 0) {
        mesh_.notes.push_back(fmt::format("the {} {} has no members: not kept", what, set.number));
        continue;
      }
      if (kind == "ns") {
        for (const std::int64_t node : file_->integers(path)) {
          if (node < 1 || node > static_cast<std::int64_t>(mesh_.points.size()))
            file_->fail(path, fmt::format("'{}' is not the number of a node", node));
          set.points.push_back(static_cast<std::uint32_t>(node - 1));
        }
        points_.push_back(std::move(set));
      } else if (kind == "els") {
        for (const std::int64_t element : file_->integers(path)) add_member(set, path, element);
        volumes_.push_back(std::move(set));
      } else {
        read_sides(set, path, numbered("side_ss", s));
        surfaces_.push_back(std::move(set));
      }
      note_factors(fmt::format("dist_fact_{}{}", kind, s), what, numbers, s);
    }
  }

  void note_factors(const std::string& path, std::string_view what,
                    const std::vector<std::int64_t>& numbers, std::size_t s) {
    if (!has(path)) return;
    const std::vector<double> factors = file_->reals(path);
    if (std::all_of(factors.begin(), factors.end(), [&](double f) { return f == factors[0]; }))
      return;
    mesh_.notes.push_back(fmt::format("the factors of {} {} are not kept", what,
                                      s <= numbers.size() ? numbers[s - 1] : 0));
  }

  std::uint32_t find_element(const std::string& path, std::int64_t element) const {
    if (element < 1 || element > static_cast<std::int64_t>(place_of_.size()))
      file_->fail(path, fmt::format("'{}' is not the number of an element", element));
    return place_of_[static_cast<std::size_t>(element - 1)];
  }
  void add_member(ElementSet& set, const std::string& path, std::int64_t element) {
    const std::uint32_t place = find_element(path, element);
    if (place != kNoPlace) set.elements.push_back(place);
  }

  void read_sides(ElementSet& set, const std::string& path, const std::string& sides_path) {
    const std::vector<std::int64_t> elements = file_->integers(path);
    const std::vector<std::int64_t> sides = file_->integers(sides_path);
    if (elements.size() != sides.size()) {
      file_->fail(sides_path, fmt::format("the table has {} values: expected {}", sides.size(),
                                          elements.size()));
    }
    std::size_t lost = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const std::uint32_t place = find_element(path, elements[i]);
      if (place == kNoPlace) {
        ++lost;
        continue;
      }
      const ElementKind& kind = places_[place].of();
      const auto all = exodus_sides(kind);
      if (sides[i] < 1 || (kind.dimension == 3 && sides[i] > static_cast<std::int64_t>(all.size())))
        file_->fail(sides_path,
                    fmt::format("'{}' in row {} is no side of a {}", sides[i], i + 1, kind.name));
      if (sides[i] > static_cast<std::int64_t>(all.size())) {  // an edge of a shell
        ++lost;
        continue;
      }
      add_side(set, places_[place], all[static_cast<std::size_t>(sides[i] - 1)]);
    }
    if (lost == 0) return;
    mesh_.notes.push_back(fmt::format(
        "{} of {} sides of the side set {} are not kept: they are no faces of volumes or shells",
        lost, elements.size(), set.number));
  }

  void add_side(ElementSet& set, ElementPlace of, const FaceCorners& side) {
    ElementRow row;
    row.kind = element_kind(side[3] == kNoCorner ? vtk_triangle : vtk_quad);
    const auto vertices = vertices_at(mesh_, of);
    for (std::size_t k = 0; k < row.kind->width; ++k) row.vertices[k] = vertices[side[k]];
    const auto point = [&](std::size_t k) { return mesh_.points[vertices[k]]; };
    // Of a tet that is turned over, too, the normal points outwards: so the side is of it again.
    const bool is_tet = of.of().dimension == 3 && of.of().corners == 4;
    if (is_tet && is_turned_over(point(0), point(1), point(2), point(3)))
      std::swap(row.vertices[1], row.vertices[2]);
    const std::size_t before = places_.size();
    set.elements.push_back(faces_.add(row, sorter_, mesh_, places_));
    if (places_.size() > before) homes_.push_back(static_cast<std::uint32_t>(blocks_.size()));
  }

  /// Labels of blocks and sets of elements of one dimension differ. Blocks of volumes and side sets,
  /// which decks of solvers name, keep their numbers.
  void number_sets_of_dimensions() {
    number_blocks();
    std::vector<ElementSet> volumes, shells;
    for (const ExodusBlock& block : blocks_) {
      if (block.kind == nullptr) continue;
      ElementSet set{block.number, block.name, {}, {}};
      if (block.kind->dimension == 3) volumes.push_back(std::move(set));
      if (block.kind->dimension == 2) shells.push_back(std::move(set));
    }
    number_beside(volumes, volumes_, kElementSetNumbers);
    number_sets(surfaces_);
    number_beside(surfaces_, shells, kShellNumbers);
    number_sets(points_);
    auto shell = shells.begin();
    std::vector<ElementSet> named_volumes, named_surfaces;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      ExodusBlock& block = blocks_[b];
      if (block.kind == nullptr) continue;
      if (block.kind->dimension == 2) block.number = (shell++)->number;
      if (block.name.empty()) continue;
      ElementSet set{block.number, block.name, {}, {}};
      for (std::uint32_t i = 0; i < homes_.size(); ++i) {
        if (homes_[i] == b) set.elements.push_back(i);
      }
      (block.kind->dimension == 3 ? named_volumes : named_surfaces).push_back(std::move(set));
    }
    volumes_.insert(volumes_.begin(), named_volumes.begin(), named_volumes.end());
    surfaces_.insert(surfaces_.begin(), named_surfaces.begin(), named_surfaces.end());
  }

  void number_blocks() {
    std::vector<ElementSet> all;
    for (const ExodusBlock& block : blocks_) all.push_back({block.number, {}, {}, {}});
    number_sets(all);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      ExodusBlock& block = blocks_[b];
      if (block.number != all[b].number) {
        mesh_.notes.push_back(fmt::format("the {}. block has the number {} here: {} is not its own",
                                          block.index, all[b].number, block.number));
      }
      block.number = all[b].number;
    }
  }

  /// What numbers the file has for these is for the deck.
  void number_beside(const std::vector<ElementSet>& others, std::vector<ElementSet>& sets,
                     std::string_view piece) {
    std::vector<ElementSet> all = others;
    all.insert(all.end(), sets.begin(), sets.end());
    number_sets(all);
    for (std::size_t s = 0; s < sets.size(); ++s) {
      const std::int64_t number = all[others.size() + s].number;
      mesh_.deck.push_back(fmt::format("{}{}{} {}", piece, '\0', number, sets[s].number));
      sets[s].number = number;
    }
  }

  /// The first side set that has a face labels it.
  void label_elements() {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (homes_[i] < blocks_.size()) {
        label_at(mesh_, places_[i]) = static_cast<Label>(blocks_[homes_[i]].number);
      }
    }
    for (auto set = surfaces_.rbegin(); set != surfaces_.rend(); ++set) {
      for (const std::uint32_t element : set->elements) {
        if (homes_[element] == blocks_.size())
          label_at(mesh_, places_[element]) = static_cast<Label>(set->number);
      }
    }
  }

  std::unique_ptr<Hdf5Reader> file_;
  const InputFile& input_;
  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  FacesOnce faces_;
  std::set<std::string> known_;  // tables that are read, or looked for
  std::vector<ExodusBlock> blocks_;
  std::vector<ElementPlace> places_;
  std::vector<std::uint32_t> homes_;     // blocks of these; of sides of volumes: their number
  std::vector<std::uint32_t> place_of_;  // of each element of the file
  std::vector<ElementSet> volumes_, surfaces_, points_;
};

}  // namespace

MeshData read_exodus(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return ExodusReader(input, question).read();
}

}  // namespace tetmend::formats
