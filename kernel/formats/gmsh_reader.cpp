// SPDX-License-Identifier: MIT
// Reads Gmsh's files of versions 2.2 and 4.1.
//
//   $MeshFormat | version, 0 or 1 (binary), 8 | the integer 1 if binary | $EndMeshFormat
//   then sections  $Name ... $EndName
//
// Their numbers are text or bytes; counts and names of some sections are text in both codings.
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/degenerate.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/gmsh.h"
#include "kernel/formats/gmsh_draft.h"
#include "kernel/formats/gmsh_element_reader.h"
#include "kernel/formats/gmsh_layout.h"
#include "kernel/formats/gmsh_nodes.h"
#include "kernel/formats/gmsh_source.h"
#include "kernel/formats/gmsh_views.h"

namespace tetmend::formats {
namespace {

class GmshReader {
 public:
  /// @param is_part one of several files of a mesh
  GmshReader(const InputFile& file, TetPlace* question, bool is_part)
      : source_(file),
        text_(source_.text()),
        question_(question),
        nodes_(source_),
        elements_(source_, nodes_, draft_, question != nullptr),
        views_(source_),
        is_part_(is_part) {}

  MeshData read() {
    read_header();
    while (!text_.at_end()) read_section(text_.word());
    if (!seen("$Nodes")) fail_without("$Nodes");
    if (!seen("$Elements")) fail_without("$Elements");
    finish();
    return std::move(mesh_);
  }

 private:
  void read_header() {
    std::string_view first = text_.word();
    while (first.size() > 1 && first[0] == '$' && is_unknown(first)) {  // $Comments may come first
      pass_over(first);
      first = text_.word();
    }
    if (first != "$MeshFormat") {
      if (first.starts_with('(')) text_.fail("this is a mesh of Fluent, not of Gmsh");
      text_.fail(first.empty() ? "the file is empty: expected $MeshFormat"
                 : first == "$NOD"
                     ? "this is an MSH file of version 1: expected 4.1 or 2.2, as which 'gmsh FILE "
                       "-save -format msh41' saves it"
                     : fmt::format("{} is not the beginning of an MSH file of version 2 or 4: "
                                   "expected $MeshFormat",
                                   in_quotes(first)));
    }
    read_version(text_.expect_word("the version of the format"));
    const bool binary = text_.integer("0 for text or 1 for binary", 0, 1) == 1;
    const std::int64_t size = text_.integer("the size of numbers", 1, 64);
    if (size != 8 && !(size == 4 && is_4_)) {
      text_.fail(fmt::format("'{}' is not a size of numbers that can be read: expected 8{}", size,
                             is_4_ ? " or 4" : ""));
    }
    source_.set_wide_size(static_cast<std::size_t>(size));
    if (binary) {
      source_.set_binary();
      text_.skip_line();
      read_byte_order();
    }
    expect_end("$MeshFormat");
    mesh_.variant = fmt::format("{} {}", is_4_ ? "4.1" : "2.2", binary ? "binary" : "ASCII");
  }

  void read_version(std::string_view version) {
    constexpr std::array<std::string_view, 4> kTwo = {"2", "2.0", "2.1", "2.2"};
    is_4_ = version == "4.1";
    if (is_4_ || std::find(kTwo.begin(), kTwo.end(), version) != kTwo.end()) return;
    text_.fail(
        fmt::format("version {} of the format cannot be read: expected 4.1 or 2.2, as which "
                    "'gmsh FILE -save -format msh41' saves it",
                    in_quotes(version)));
  }

  void read_byte_order() {
    const std::int64_t one = source_.integer("the integer 1", INT32_MIN, INT32_MAX);
    if (one != 1 && one != byte_swapped(std::int32_t{1})) {
      text_.fail(fmt::format("'{}' does not tell the byte order: expected the integer 1", one));
    }
    source_.set_swap(one != 1);
  }

  void expect_end(std::string_view name) {
    const std::string end = fmt::format("$End{}", name.substr(1));
    const std::string_view word = text_.expect_word(end);
    if (word != end) {
      text_.fail(fmt::format("{} is not expected here: expected {}", in_quotes(word), end));
    }
  }

  /// What a section says is not of the mesh.
  static bool is_unknown(std::string_view section) {
    constexpr std::array<std::string_view, 11> kKnown = {
        "$MeshFormat", "$PhysicalNames", "$Entities", "$PartitionedEntities",
        "$Nodes",      "$Elements",      "$Periodic", "$ParametricNodes",
        "$NodeData",   "$ElementData",   "$NOD"};
    return !section.starts_with("$End") &&
           std::find(kKnown.begin(), kKnown.end(), section) == kKnown.end();
  }

  void read_section(std::string_view name) {
    if (name.size() < 2 || name.front() != '$' || name.starts_with("$End")) {
      text_.fail(
          fmt::format("{} is not expected here: expected the name of a section, such as "
                      "$Nodes or $Elements",
                      in_quotes(name)));
    }
    if (name == "$NodeData" || name == "$ElementData") {
      views_.read_head(name == "$NodeData");
      if (source_.binary()) return expect_end(name);
      return skip_to_end(name);
    }
    if (is_unknown(name)) return pass_over(name);
    const std::string_view section = name;
    if (name == "$ParametricNodes") name = "$Nodes";
    if (seen(name)) text_.fail(fmt::format("{} appears for the second time", in_quotes(name)));
    seen_.push_back(name);
    if (name == "$PhysicalNames") read_names();
    if (name == "$Entities") read_entities();
    if (name == "$PartitionedEntities") read_partitioned_entities();
    if (name == "$Nodes") is_4_ ? nodes_.read_4() : nodes_.read_2(section != name);
    if (name == "$Elements") read_elements();
    if (name == "$Periodic") read_periodic();
    expect_end(section);
  }

  void pass_over(std::string_view name) {
    skip_to_end(name);
    if (!passed_.insert(name).second) return;
    mesh_.notes.push_back(fmt::format("section {} is not kept", in_quotes(name)));
  }

  void skip_to_end(std::string_view name) {
    const std::string end = fmt::format("\n$End{}", name.substr(1));
    const std::string_view rest(text_.position(), text_.bytes_left());
    const std::size_t at = rest.find(end);
    if (at == std::string_view::npos) {
      text_.fail(fmt::format("the section {} has no end: expected {}; the file seems truncated",
                             in_quotes(name), end.substr(1)));
    }
    text_.seek(rest.data() + at);
    expect_end(name);
  }

  bool seen(std::string_view name) const {
    return std::find(seen_.begin(), seen_.end(), name) != seen_.end();
  }
  [[noreturn]] void fail_without(std::string_view name) {
    text_.fail_at(text_.position(), fmt::format("the section {} is missing", name));
  }

  static std::string_view trimmed_name(std::string_view line) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::size_t first = std::min(line.find_first_not_of(kBlanks), line.size());
    return line.substr(first, line.find_last_not_of(kBlanks) + 1 - first);
  }

  /// The rest of the line, and those that follow where quotes end there: Gmsh's API takes any name.
  std::string_view name_lines() {
    const std::string_view line = text_.skip_line();
    if (std::count(line.begin(), line.end(), '"') != 1) return line;
    const std::string_view rest(line.data(), line.size() + text_.bytes_left());
    const std::size_t end = rest.find('"', line.size());
    if (end == std::string_view::npos || end > rest.find("\n$", line.size() - 1)) return line;
    const std::size_t after = std::min(rest.find_first_not_of(" \t\r", end + 1), rest.size() - 1);
    if (rest[after] != '\n') return line;  // it opens the next name
    text_.seek(rest.data() + after + 1);
    return rest.substr(0, end + 1);
  }

  // Text in both codings.
  void read_names() {
    const std::size_t count = text_.count("names of groups", std::string_view("1 1 \"\"\n").size());
    for (std::size_t i = 0; i < count; ++i) {
      Group group;
      group.dimension = static_cast<int>(text_.integer("the dimension of a group", 0, 3));
      group.number = text_.label("the number of a group");
      const char* place = text_.last_word();
      const std::string_view line = name_lines();
      const std::size_t first = line.find('"');
      const std::size_t last = line.rfind('"');
      const std::string_view bare = trimmed_name(line);  // some writers have no quotes
      if (first == last && (first != std::string_view::npos || bare.empty())) {
        text_.fail_at(line.data(), fmt::format("{} is not expected here: expected the name of a "
                                               "group in quotes",
                                               in_quotes(line)));
      }
      group.name = first == last ? bare : line.substr(first + 1, last - first - 1);
      if (is_named(group.dimension, group.number)) {
        text_.fail_at(place, fmt::format("the group '{} {}' is named for the second time",
                                         group.dimension, group.number));
      }
      named_numbers_.insert({group.dimension, group.number});
      draft_.named.push_back(std::move(group));
    }
  }

  bool is_named(int dimension, Label number) const {
    return named_numbers_.contains({dimension, number});
  }

  void read_entities() {
    if (!is_4_) text_.fail("'$Entities' is not expected here: version 2.2 has none");
    source_.begin_numbers();
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = source_.count("entities", 8, 36);
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
        read_entity(dimension);
      }
    }
  }

  void read_entity(int dimension) {
    GeometricEntity entity;
    entity.dimension = dimension;
    entity.tag = source_.tag("the number of an entity");
    const auto [at, is_new] = draft_.groups_of.try_emplace({dimension, entity.tag});
    if (!is_new) {
      text_.fail(
          fmt::format("the entity '{} {}' appears for the second time", dimension, entity.tag));
    }
    const std::size_t reals = dimension == 0 ? 3 : 6;
    for (std::size_t k = 0; k < reals; ++k) entity.box[k] = source_.real("a bound of an entity");
    if (dimension == 0) std::copy_n(entity.box.begin(), 3, entity.box.begin() + 3);
    entity.groups.resize(source_.count("groups of an entity", 2, 4));
    std::unordered_set<Label> known;
    for (Label& group : entity.groups) {
      group = source_.tag("the number of a group");
      // A negative number stands for the group turned round.
      const bool is_turned = group < 0 && group > INT32_MIN && !is_named(dimension, group);
      const Label number = is_turned ? -group : group;
      if (number != 0 && known.insert(number).second) at->second.push_back(number);
    }
    if (dimension > 0) {
      entity.boundary.resize(source_.count("bounds of an entity", 2, 4));
      for (Label& tag : entity.boundary) tag = source_.tag("the number of an entity");
    }
    mesh_.entities.push_back(std::move(entity));
  }

  /// Of these only what they are pieces of is kept.
  void read_partitioned_entities() {
    if (!is_4_) text_.fail("'$PartitionedEntities' is not expected here: version 2.2 has none");
    source_.begin_numbers();
    source_.wide("the number of partitions", 0, INT64_MAX);
    const std::size_t ghosts = source_.count("ghost entities", 4, 8);
    for (std::size_t i = 0; i < 2 * ghosts; ++i) source_.tag("the number of a ghost entity");
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = source_.count("entities of partitions", 12, 44);
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
        read_partitioned_entity(dimension);
      }
    }
  }

  void read_partitioned_entity(int dimension) {
    const Label tag = source_.tag("the number of an entity");
    const auto of = static_cast<int>(source_.integer("the dimension of its parent", -1, 3));
    const Label parent = source_.tag("the number of its parent");
    if (of >= dimension) draft_.parents[{dimension, tag}] = {of, parent};
    const auto skip = [this](const char* what) {
      const std::size_t count = source_.count(what, 2, 4);
      for (std::size_t i = 0; i < count; ++i) source_.tag("a whole number");
    };
    skip("partitions of an entity");
    const int reals = dimension == 0 ? 3 : 6;
    for (int k = 0; k < reals; ++k) source_.real("a bound of an entity");
    skip("groups of an entity");
    if (dimension > 0) skip("bounds of an entity");
  }

  void read_elements() {
    if (!seen("$Nodes")) text_.fail("'$Elements' is not expected here: expected $Nodes before");
    is_4_ ? elements_.read_4() : elements_.read_2();
  }

  // Text in version 2.2, whatever the coding.
  void read_periodic() {
    if (!seen("$Nodes")) text_.fail("'$Periodic' is not expected here: expected $Nodes before");
    if (!is_4_) return read_periodic_2();
    source_.begin_numbers();
    const std::size_t links = source_.count("periodic links", 10, 28);
    for (std::size_t i = 0; i < links; ++i) {
      PeriodicLink link;
      link.dimension = static_cast<int>(source_.integer("the dimension of an entity", 0, 3));
      link.tag = source_.tag("the number of an entity");
      link.master = source_.tag("the number of an entity");
      link.affine.resize(source_.count("numbers of a map", 2, 8));
      for (double& number : link.affine) number = source_.real("a number of a map");
      check_affine(link);
      link.points.resize(source_.count("nodes of a link", 4, 16));
      for (auto& pair : link.points) {
        for (std::uint32_t& point : pair) {
          point = find_node(source_.wide("the number of a node", 0, INT64_MAX));
        }
      }
      mesh_.periodic.push_back(std::move(link));
    }
  }

  void read_periodic_2() {
    const std::size_t links = text_.count("periodic links", 8);
    for (std::size_t i = 0; i < links; ++i) {
      PeriodicLink link;
      link.dimension = static_cast<int>(text_.integer("the dimension of an entity", 0, 3));
      link.tag = text_.label("the number of an entity");
      link.master = text_.label("the number of an entity");
      const char* before = text_.position();
      if (text_.word() == "Affine") {
        while (!text_.at_line_end()) link.affine.push_back(text_.real("a number of a map"));
        check_affine(link);
      } else {
        text_.seek(before);
      }
      link.points.resize(text_.count("nodes of a link", 4));
      for (auto& pair : link.points) {
        for (std::uint32_t& point : pair) {
          point = find_node(text_.integer("the number of a node", 0, INT64_MAX));
        }
      }
      mesh_.periodic.push_back(std::move(link));
    }
  }

  void check_affine(const PeriodicLink& link) {
    if (link.affine.empty() || link.affine.size() == 16) return;
    text_.fail(fmt::format("'{}' is not the number of numbers of a map: expected 0 or 16",
                           link.affine.size()));
  }

  std::uint32_t find_node(std::int64_t tag) {
    const std::uint32_t found = nodes_.find(tag);
    if (found != GmshTags::kNone) return found;
    text_.fail(fmt::format("'{}' is not the number of a node: expected one of $Nodes", tag));
  }

  void finish() {
    mesh_.points = std::move(nodes_.points);
    mesh_.point_entities = std::move(nodes_.entities);
    if (!draft_.parents.empty()) {
      mesh_.notes.emplace_back("the partitions of elements are not kept");
      for (auto& [dimension, tag] : mesh_.point_entities) {
        const auto parent = draft_.parents.find({dimension, tag});
        if (parent != draft_.parents.end()) std::tie(dimension, tag) = parent->second;
      }
    }
    if (!is_4_) draft_.merge_repeated();
    draft_.sort();
    answer_question();
    if (is_part_) {
      mesh_.point_numbers = nodes_.numbers();
    } else {
      refuse_without_tets();
    }
    if (!is_4_) classify_points();
    std::array<GmshTags, 3> tags;
    draft_.move_into(mesh_, tags);
    views_.move_into(mesh_, nodes_, tags);
    if (nodes_.parametric()) mesh_.notes.emplace_back("the parameters of nodes are not kept");
    if (elements_.partitioned()) {
      mesh_.notes.emplace_back("the partitions of elements are not kept");
    }
  }

  void answer_question() {
    if (question_ == nullptr) return;
    const bool is_second = draft_.rows[gmsh_tet].size() == 0;
    const auto type = question_->dimension == 1   ? gmsh_edge
                      : question_->dimension == 2 ? gmsh_triangle
                      : is_second                 ? gmsh_second_order_tet
                                                  : gmsh_tet;
    const std::vector<const char*>& places = draft_.rows[type].places;
    if (question_->tet < places.size()) question_->place = text_.place_of(places[question_->tet]);
  }

  void refuse_without_tets() {
    if (draft_.rows[gmsh_tet].size() > 0 || draft_.rows[gmsh_second_order_tet].size() > 0 ||
        mesh_.points.empty()) {
      return;
    }
    text_.fail_at(text_.position(),
                  "the mesh has no tetrahedra: expected elements of type 4 or 11");
  }

  // Version 2.2 has the entities of points only where they are elements.
  void classify_points() {
    const GmshRows& points = draft_.rows[gmsh_point];
    if (points.size() == 0) return;
    mesh_.point_entities.resize(mesh_.points.size(), {-1, 0});
    for (std::size_t i = 0; i < points.size(); ++i) {
      mesh_.point_entities[points.vertices[i]] = {0, points.parts[i]};
    }
  }

  GmshSource source_;
  TextReader& text_;
  TetPlace* question_;
  GmshNodes nodes_;
  GmshDraft draft_;
  GmshElementReader elements_;
  GmshViews views_;
  MeshData mesh_;
  bool is_part_;
  bool is_4_ = false;
  std::vector<std::string_view> seen_;
  std::set<std::string_view> passed_;  // names of sections that are not kept
  std::set<std::pair<int, Label>> named_numbers_;
};

}  // namespace

MeshData read_gmsh(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return GmshReader(input, question, false).read();
}

MeshData read_gmsh_part(const std::filesystem::path& file) {
  const InputFile input(file);
  MeshData part = GmshReader(input, nullptr, true).read();
  drop_degenerate(part);
  return part;
}

MeshData read_gmsh_head(const std::string& bytes) {
  const InputFile input({}, bytes);
  return GmshReader(input, nullptr, true).read();
}

}  // namespace tetmend::formats
