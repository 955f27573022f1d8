// SPDX-License-Identifier: MIT
// A mesh of Elmer: a folder with mesh.header, mesh.nodes, mesh.elements, mesh.boundary.
#include "kernel/formats/elmer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/face_sides.h"
#include "kernel/formats/gmsh_tags.h"
#include "kernel/formats/label_names.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/text_reader.h"

namespace tetmend::formats {
namespace {

constexpr std::array<std::string_view, 5> kElmerExtensions = {".header", ".nodes", ".elements",
                                                              ".boundary", ".names"};

constexpr std::string_view kBodies = "! ----- names for bodies -----\n";
constexpr std::string_view kBoundaries = "! ----- names for boundaries -----\n";

std::filesystem::path file_beside(const std::filesystem::path& header, std::string_view extension) {
  return std::filesystem::path(header).replace_extension(extension);
}

/// One of the files.
struct Source {
  explicit Source(const std::filesystem::path& file)
      : input(file), text(input, TextReader::kNoComments) {}

  void expect_end(std::string_view what) {
    const std::string_view word = text.word();
    if (word.empty()) return;
    text.fail(
        fmt::format("{} follows the last {}: expected the end of the file", in_quotes(word), what));
  }
  /// Refuses a count of the header that this file cannot hold.
  void check_count(std::size_t count, std::string_view what, std::size_t bytes_each) const {
    if (count <= (text.bytes_left() + 1) / bytes_each) return;
    text.fail_at(text.position(),
                 fmt::format("{} {} cannot fit into the {} bytes of the file: the count in the "
                             "header is wrong or the file is truncated",
                             count, what, text.bytes_left()));
  }

  InputFile input;
  TextReader text;
};

class ElmerReader {
 public:
  ElmerReader(std::filesystem::path header, TetPlace* question)
      : header_(std::move(header)), question_(question), sorter_(mesh_) {}

  MeshData read() {
    read_header();
    read_nodes();
    read_elements(".elements", counts_[1], true);
    read_elements(".boundary", counts_[2], false);
    check_types();
    read_names();
    return std::move(mesh_);
  }

 private:
  void read_header() {
    Source source(header_);
    if (source.text.at_end()) {
      source.text.fail("the file is empty: expected the numbers of nodes and elements");
    }
    for (std::size_t& count : counts_) {
      count = static_cast<std::size_t>(
          source.text.integer("the numbers of nodes, elements, boundary elements", 0, INT64_MAX));
    }
    const auto types = source.text.count("types", std::string_view("303 1\n").size());
    for (std::size_t i = 0; i < types; ++i) {
      const std::int64_t type = source.text.integer("the type of elements", 0, INT32_MAX);
      wanted_[type] += source.text.integer("the number of elements of a type", 0, INT64_MAX / 1000);
    }
    source.expect_end("type");
  }

  void read_nodes() {
    Source source(file_beside(header_, ".nodes"));
    source.check_count(counts_[0], "nodes", std::string_view("1 -1 0 0 0\n").size());
    if (counts_[0] > kMostVertices) source.text.fail("the nodes are too many");
    mesh_.points.resize(counts_[0]);
    std::vector<std::int64_t> numbers(counts_[0]);
    std::vector<const char*> places(counts_[0]);
    read_rows(source.text, counts_[0], [&](TextReader& text, std::size_t i) {
      numbers[i] = text.integer("the number of a node", 1, INT64_MAX);
      places[i] = text.last_word();
      text.integer("the partition of a node", INT64_MIN, INT64_MAX);
      for (int axis = 0; axis < 3; ++axis) mesh_.points[i][axis] = text.real("a coordinate");
    });
    source.expect_end("node");
    order_ = ascending_order(numbers);
    std::vector<std::int64_t> ascending(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      ascending[i] = numbers[order_[i]];
      if (i == 0 || ascending[i] != ascending[i - 1]) continue;
      source.text.fail_at(
          places[order_[i]],
          fmt::format("the number '{}' of a node appears for the second time", ascending[i]));
    }
    bool in_order = true;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      in_order &= numbers[i] == static_cast<std::int64_t>(i) + 1;
    }
    if (!in_order) mesh_.notes.emplace_back("the numbers of nodes are not kept");
    tags_ = GmshTags(std::move(ascending));
  }

  void read_elements(std::string_view extension, std::size_t count, bool are_volumes) {
    Source source(file_beside(header_, extension));
    source.check_count(
        count, "elements",
        std::string_view(are_volumes ? "1 1 504 1 2 3 4\n" : "1 1 0 0 202 1 2\n").size());
    const auto read = [&](TextReader& text, ElementRow& row) {
      text.integer("the number of an element", 0, INT64_MAX);
      row.place = text.last_word();
      row.label = text.label(are_volumes ? "the number of a body" : "the number of a boundary");
      for (int k = 0; k < 2 && !are_volumes; ++k) {
        text.integer("the number of a parent", INT64_MIN, INT64_MAX);
      }
      read_vertices(text, row, are_volumes);
    };
    read_element_rows(source.text, count, read, [&](const ElementRow& row) {
      sorter_.add(row);
      ++found_[row.kind->vtk_type];
      answer(question_, mesh_, source.text, row);
    });
    source.expect_end("element");
  }

  void read_vertices(TextReader& text, ElementRow& row, bool are_volumes) const {
    const std::int64_t number = text.integer("the type of an element", 0, INT32_MAX);
    row.kind = nullptr;
    for (const ElmerType& type : kElmerTypes) {
      if (type.number == number) row.kind = element_kind(type.vtk_type);
    }
    if (row.kind == nullptr || (row.kind->dimension == 3) != are_volumes) {
      text.fail(fmt::format(
          "elements of type {} cannot be read here: expected {}", number,
          are_volumes ? "504, 510, 605, 706 or 808" : "202, 203, 303, 306, 404 or 408"));
    }
    for (std::size_t k = 0; k < row.kind->width; ++k) {
      const std::int64_t node = text.integer("the number of a node", 1, INT64_MAX);
      const std::uint32_t found = tags_.find(node);
      if (found == GmshTags::kNone) {
        text.fail(fmt::format("'{}' is not the number of a node: expected one of the nodes", node));
      }
      row.vertices[k] = order_[found];
    }
  }

  void check_types() const {
    std::map<std::int64_t, std::int64_t> found;
    for (const ElmerType& type : kElmerTypes) {
      const auto at = found_.find(type.vtk_type);
      if (at != found_.end()) found[type.number] = at->second;
    }
    for (const auto& [type, count] : wanted_) {
      if (count > 0 && !found.contains(type)) found[type] = 0;
    }
    for (const auto& [type, count] : found) {
      const auto at = wanted_.find(type);
      const std::int64_t wanted = at == wanted_.end() ? 0 : at->second;
      if (wanted == count) continue;
      const InputFile header(header_);
      header.fail_at_line(header.begin(),
                          fmt::format("the files hold {} elements of type {}: expected {}, as the "
                                      "header says",
                                      count, type, wanted));
    }
  }

  void read_names() {
    const std::filesystem::path file = file_beside(header_, ".names");
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return;
    Source source(file);
    bool are_bodies = true;
    std::size_t passed = 0;
    while (!source.text.at_end()) {
      const std::string_view line = source.text.skip_line();
      if (line[0] == '!') {
        if (line.find("boundaries") != std::string_view::npos) are_bodies = false;
        if (line.find("bodies") != std::string_view::npos) are_bodies = true;
      } else if (line[0] == '$') {
        read_name(source, line.substr(1), are_bodies);
      } else {
        ++passed;
      }
    }
    if (passed > 0) {
      mesh_.notes.push_back(fmt::format("{} lines of {} are not kept: they give no name", passed,
                                        file.filename().string()));
    }
  }

  /// "name = number"
  void read_name(Source& source, std::string_view line, bool is_body) {
    const std::size_t sign = line.find('=');
    const auto trimmed = [](std::string_view text) {
      constexpr std::string_view kBlanks = " \t\r\v\f";
      const std::size_t first = text.find_first_not_of(kBlanks);
      if (first == std::string_view::npos) return std::string_view();
      return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
    };
    const std::string_view name = trimmed(line.substr(0, sign));
    const std::string_view word =
        sign == std::string_view::npos ? std::string_view() : trimmed(line.substr(sign + 1));
    Label number = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (name.empty() || error != std::errc() || stop != word.data() + word.size()) {
      source.text.fail_at(line.data(), fmt::format("{} names nothing: expected '$ name = number'",
                                                   in_quotes(line)));
    }
    const int dimension = is_body ? 3 : dimension_of_boundary(number);
    if (!named_.insert({dimension, number}).second) {
      source.text.fail_at(line.data(), fmt::format("the number '{}' has a second name", number));
    }
    mesh_.groups.push_back({dimension, number, std::string(name), {}, {}});
  }

  /// 2 unless only edges have this number.
  int dimension_of_boundary(Label number) {
    if (!surface_labels_) {
      surface_labels_.emplace();
      for (const auto& triangle : mesh_.triangles) (*surface_labels_)[triangle.label] = true;
      for (const OtherElements& others : mesh_.other_elements) {
        const bool is_surface = element_kind(others.vtk_type)->dimension == 2;
        for (const Label label : others.labels) {
          if (is_surface) (*surface_labels_)[label] = true;
        }
      }
      for (const auto& edge : mesh_.edges) surface_labels_->try_emplace(edge.label, false);
    }
    const auto found = surface_labels_->find(number);
    return found == surface_labels_->end() || found->second ? 2 : 1;
  }

  std::filesystem::path header_;
  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  std::array<std::size_t, 3> counts_{};          // of nodes, elements, boundary elements
  std::map<std::int64_t, std::int64_t> wanted_;  // elements of each type of Elmer's
  std::map<int, std::int64_t> found_;            // of each type of VTK's
  std::vector<std::uint32_t> order_;             // in which the numbers of nodes ascend
  GmshTags tags_;
  std::optional<std::map<Label, bool>> surface_labels_;  // false: of edges only
  std::set<std::pair<int, Label>> named_;                // dimension and number
};

int elmer_type(int vtk_type) {
  for (const ElmerType& type : kElmerTypes) {
    if (type.vtk_type == vtk_type) return type.number;
  }
  return 0;
}

class ElmerWriter {
 public:
  ElmerWriter(const std::filesystem::path& header, const MeshView& mesh)
      : header_(header),
        nodes_(file_beside(header, ".nodes")),
        elements_(file_beside(header, ".elements")),
        boundary_(file_beside(header, ".boundary")),
        mesh_(mesh),
        lists_(mesh) {
    std::error_code ignored;
    const std::filesystem::path names = file_beside(header, ".names");
    const bool has_groups = mesh.data() != nullptr && !mesh.data()->groups.empty();
    if (has_groups || std::filesystem::exists(names, ignored)) names_.emplace(names);
  }

  void write() {
    write_nodes();
    write_elements();
    write_boundary();
    write_header();
    if (names_) write_names();
    std::vector<OutputFile*> all = {&nodes_, &elements_, &boundary_, &header_};
    if (names_) all.push_back(&*names_);
    OutputFile::commit_all(all, mesh_.companions());
  }

 private:
  void write_nodes() {
    put_rows(nodes_, mesh_.point_count(), [this](std::size_t i, OutputBuffer& buffer) {
      buffer.put_integer(static_cast<std::int64_t>(i) + 1);
      buffer.put(" -1");
      for (int axis = 0; axis < 3; ++axis) {
        buffer.put(' ');
        buffer.put_real(mesh_.point(i)[axis]);
      }
      buffer.put('\n');
    });
  }

  static void put_vertices(OutputBuffer& buffer, const ElementList& list, std::size_t i) {
    buffer.put_integer(elmer_type(list.kind.vtk_type));
    for (const std::uint32_t vertex : list.vertices(i)) {
      buffer.put(' ');
      buffer.put_integer(std::int64_t{vertex} + 1);
    }
    buffer.put('\n');
  }

  /// Numbers count on through all lists, also those that Elmer has not: so parents are found.
  void write_elements() {
    std::size_t first = 1;
    for (const ElementList* list : lists_.of_dimension(3)) {
      if (elmer_holds(list->kind.vtk_type)) {
        put_rows(elements_, list->count, [&](std::size_t i, OutputBuffer& buffer) {
          buffer.put_integer(static_cast<std::int64_t>(first + i));
          buffer.put(' ');
          buffer.put_integer(list->label(i));
          buffer.put(' ');
          put_vertices(buffer, *list, i);
        });
        count(*list, counts_[0]);
      }
      first += list->count;
    }
  }

  void count(const ElementList& list, std::size_t& sum) {
    sum += list.count;
    types_[elmer_type(list.kind.vtk_type)] += list.count;
  }

  void write_boundary() {
    const auto sides = find_face_sides(mesh_, lists_);
    const auto surfaces = lists_.of_dimension(2);
    for (std::size_t k = 0; k < surfaces.size(); ++k) put_boundary(*surfaces[k], sides[k]);
    for (const ElementList* list : lists_.of_dimension(1)) put_boundary(*list, {});
  }

  void put_boundary(const ElementList& list, const std::vector<FaceSides>& sides) {
    if (!elmer_holds(list.kind.vtk_type)) return;
    const std::size_t first = counts_[1] + 1;
    put_rows(boundary_, list.count, [&](std::size_t i, OutputBuffer& buffer) {
      buffer.put_integer(static_cast<std::int64_t>(first + i));
      buffer.put(' ');
      buffer.put_integer(list.label(i));
      FaceSides of_face = sides.empty() ? FaceSides{} : sides[i];
      if (of_face.behind == kNoElement) std::swap(of_face.behind, of_face.front);
      for (const std::uint32_t parent : {of_face.behind, of_face.front}) {
        buffer.put(' ');
        buffer.put_integer(parent == kNoElement ? 0 : std::int64_t{parent} + 1);
      }
      buffer.put(' ');
      put_vertices(buffer, list, i);
    });
    count(list, counts_[1]);
  }

  void write_header() {
    header_.put(
        fmt::format("{} {} {}\n{}\n", mesh_.point_count(), counts_[0], counts_[1], types_.size()));
    for (const auto& [type, count] : types_) header_.put(fmt::format("{} {}\n", type, count));
  }

  void write_names() {
    if (mesh_.data() == nullptr) return;
    const LabelNames names(*mesh_.data());
    names_->put(kBodies);
    put_names(names.named(3));
    names_->put(kBoundaries);
    auto boundaries = names.named(2);
    boundaries.merge(names.named(1));
    put_names(boundaries);
  }

  void put_names(const std::map<Label, const Group*>& names) {
    for (const auto& [label, group] : names) {
      std::string name = group->name;
      for (char& c : name) {
        if (c == '=' || static_cast<unsigned char>(c) <= ' ') c = '_';
      }
      names_->put(fmt::format("$ {} = {}\n", name, label));
    }
  }

  OutputFile header_, nodes_, elements_, boundary_;
  std::optional<OutputFile> names_;
  const MeshView& mesh_;
  ElementLists lists_;
  std::array<std::size_t, 2> counts_{};  // of elements and boundary elements
  std::map<int, std::size_t> types_;
};

}  // namespace

MeshData read_elmer(const std::filesystem::path& header, TetPlace* question) {
  return ElmerReader(header, question).read();
}

void write_elmer(const std::filesystem::path& header, const MeshView& mesh) {
  ElmerWriter(header, mesh).write();
}

std::vector<std::filesystem::path> elmer_files(const std::filesystem::path& header) {
  std::vector<std::filesystem::path> files = {header};
  for (const std::string_view extension : kElmerExtensions) {
    const std::filesystem::path file = file_beside(header, extension);
    if (file != header) files.push_back(file);
  }
  return files;
}

}  // namespace tetmend::formats
