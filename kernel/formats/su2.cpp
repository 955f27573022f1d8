// SPDX-License-Identifier: MIT
// The native format `.su2` of the flow solver SU2, for meshes in space.
#include "kernel/formats/su2.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/label_names.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/text_reader.h"
#include "kernel/formats/unique_names.h"

namespace tetmend::formats {
namespace {

constexpr char kComment = '%';
constexpr std::string_view kBlanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view before_comment(std::string_view line) {
  return line.substr(0, line.find(kComment));
}

/// What must be known before the first element is read.
struct Survey {
  std::int64_t points = 0;  ///< as NPOIN says, not checked
  std::vector<std::string> tags;
};

/// Looks at the lines with an equals sign only.
Survey survey_file(const InputFile& file) {
  Survey found;
  bool counted = false;
  const char* next = file.begin();
  const auto left = [&] { return static_cast<std::size_t>(file.end() - next); };
  while (left() > 0) {
    const auto* sign = static_cast<const char*>(std::memchr(next, '=', left()));
    if (sign == nullptr) break;
    const char* begin = sign;
    while (begin != next && begin[-1] != '\n') --begin;
    next = sign;
    const auto* newline = static_cast<const char*>(std::memchr(next, '\n', left()));
    const char* end = newline == nullptr ? file.end() : newline;
    const std::string_view name = trimmed({begin, static_cast<std::size_t>(sign - begin)});
    const std::string_view value =
        trimmed(before_comment({sign + 1, static_cast<std::size_t>(end - sign - 1)}));
    if (name == "MARKER_TAG") found.tags.emplace_back(value);
    if (name == "NPOIN" && !std::exchange(counted, true)) {
      std::from_chars(value.data(), value.data() + value.size(), found.points);
    }
    next = end;
  }
  return found;
}

bool is_label(const std::string& tag, Label& label) {
  const char* end = tag.data() + tag.size();
  const auto [stop, error] = std::from_chars(tag.data(), end, label);
  return error == std::errc() && stop == end && fmt::format("{}", label) == tag;
}

/// Of each marker: the number that is its tag, else its place; if that is taken, one behind the last.
std::vector<Label> marker_labels(const std::vector<std::string>& tags) {
  std::vector<Label> labels(tags.size());
  std::vector<bool> is_known(tags.size());
  std::set<Label> taken;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    is_known[i] = is_label(tags[i], labels[i]);
    if (is_known[i]) taken.insert(labels[i]);
  }
  auto last = static_cast<Label>(tags.size());
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (is_known[i]) continue;
    labels[i] = static_cast<Label>(i + 1);
    while (!taken.insert(labels[i]).second) labels[i] = ++last;
  }
  return labels;
}

class Su2Reader {
 public:
  Su2Reader(const InputFile& file, TetPlace* question)
      : text_(file, kComment),
        question_(question),
        survey_(survey_file(file)),
        labels_(marker_labels(survey_.tags)),
        sorter_(mesh_) {}

  MeshData read() {
    if (text_.at_end()) text_.fail("the file is empty: expected NDIME=");
    while (read_keyword()) {
    }
    for (const std::string_view name : {"NDIME", "NELEM", "NPOIN", "NMARK"}) {
      if (!seen_.contains(name)) text_.fail(fmt::format("the keyword {} is missing", name));
    }
    if (mesh_.groups.size() != markers_ || is_open_) {
      text_.fail(fmt::format("{} markers are complete: expected {}",
                             mesh_.groups.size() - (is_open_ ? 1 : 0), markers_));
    }
    mesh_.variant = kSu2;
    return std::move(mesh_);
  }

 private:
  /// False at the end of the file.
  bool read_keyword() {
    if (text_.at_end()) return false;
    const char* begin = text_.position();
    const std::string_view line = before_comment(text_.skip_line());
    const std::size_t sign = line.find('=');
    if (sign == std::string_view::npos) {
      text_.fail(fmt::format("{} is not expected here: expected a keyword and '='",
                             in_quotes(trimmed(line))));
    }
    const std::string_view name = trimmed(line.substr(0, sign));
    constexpr std::string_view kOnce[] = {"NDIME", "NELEM", "NPOIN", "NMARK"};
    if (std::find(std::begin(kOnce), std::end(kOnce), name) != std::end(kOnce) &&
        !seen_.insert(name).second) {
      text_.fail(fmt::format("{} appears for the second time", in_quotes(name)));
    }
    const std::string_view value = trimmed(line.substr(sign + 1));
    if (value.empty()) {
      text_.fail(fmt::format("{} says nothing: expected a value behind '='", in_quotes(name)));
    }
    text_.seek(line.data() + sign + 1);
    if (!read_section(name, value)) {
      text_.seek(begin);
      keep();
    }
    return true;
  }

  /// False if the keyword is none of ours.
  bool read_section(std::string_view name, std::string_view value) {
    if (name == "NDIME") {
      if (text_.integer("the dimension", 1, 3) != 3) {
        text_.fail("the mesh is not three-dimensional: expected NDIME= 3");
      }
      text_.skip_line();
    } else if (name == "NZONE" || name == "IZONE") {
      if (text_.integer("the number of zones", 1, INT32_MAX) != 1) {
        text_.fail("several zones cannot be read: expected one mesh");
      }
      text_.skip_line();
    } else if (name == "NELEM") {
      read_elements(count("elements", std::string_view("10 0 1 2 3\n").size()), 3, 0);
    } else if (name == "NPOIN") {
      read_points();
    } else if (name == "NMARK") {
      markers_ = count("markers", std::string_view("MARKER_TAG=a\nMARKER_ELEMS=0\n").size());
    } else if (name == "MARKER_TAG") {
      begin_marker(value);
    } else if (name == "MARKER_ELEMS") {
      if (!std::exchange(is_open_, false))
        text_.fail("the elements of no marker: expected MARKER_TAG=");
      read_elements(count("elements", std::string_view("5 0 1 2\n").size()), 2,
                    mesh_.groups.back().number);
    } else if (name == "SEND_RECV") {
      text_.fail("'SEND_RECV' cannot be read: expected a mesh in one piece");
    } else if (name == "FFD_SURFACE_POINTS") {
      drop_surface_points();
    } else {
      return false;
    }
    return true;
  }

  /// The rest of its line says how many are no halo.
  std::size_t count(std::string_view what, std::size_t bytes_each) {
    const std::size_t found = text_.count(what, bytes_each);
    while (!text_.word_on_line().empty()) {
    }
    return found;
  }

  void begin_marker(std::string_view tag) {
    text_.skip_line();
    if (mesh_.groups.size() == labels_.size()) text_.fail("expected MARKER_TAG on its own line");
    if (!tags_.insert(tag).second) {
      text_.fail(fmt::format("the marker {} appears for the second time", in_quotes(tag)));
    }
    if (std::exchange(is_open_, true))
      text_.fail("a marker has no elements: expected MARKER_ELEMS=");
    mesh_.groups.push_back({2, labels_[mesh_.groups.size()], std::string(tag), {}, {}});
  }

  void read_points() {
    const std::size_t points = count("points", std::string_view("0 0 0\n").size());
    if (points > kMostVertices) text_.fail(fmt::format("{} points are too many", points));
    mesh_.points.resize(points);
    read_rows(text_, points, [this](TextReader& text, std::size_t i) {
      for (int axis = 0; axis < 3; ++axis) mesh_.points[i][axis] = text.real("a coordinate");
      const auto place = static_cast<std::int64_t>(i);
      if (!text.at_line_end()) text.integer("the place of the point in the list", place, place);
    });
  }

  void read_elements(std::size_t count, int dimension, Label label) {
    const auto last = std::min<std::int64_t>(survey_.points, kMostVertices) - 1;
    const auto read = [&](TextReader& text, ElementRow& row) {
      const std::int64_t type = text.integer("the type of an element", 0, INT32_MAX);
      row.kind = element_kind(type);
      row.place = text.last_word();
      row.label = label;
      if (row.kind == nullptr || row.kind->dimension != dimension) {
        text.fail(
            fmt::format("elements of type {} cannot be read here: expected {}", type,
                        dimension == 3 ? "10 (tetrahedron), 12, 13 or 14" : "5 (triangle) or 9"));
      }
      for (std::size_t k = 0; k < row.kind->width; ++k) {
        row.vertices[k] = static_cast<std::uint32_t>(text.integer("a vertex number", 0, last));
      }
      if (!text.at_line_end()) text.integer("the number of an element", INT64_MIN, INT64_MAX);
    };
    read_element_rows(text_, count, read, [this](const ElementRow& row) {
      sorter_.add(row);
      answer(question_, mesh_, text_, row);
    });
  }

  /// Keeps a keyword with what follows up to the next one.
  void keep() {
    std::string piece;
    do {
      piece += text_.skip_line();
      piece += '\n';
      const char* next = text_.position();
      const std::string_view line = before_comment(text_.skip_line());
      text_.seek(next);
      if (line.find('=') != std::string_view::npos) break;
    } while (text_.bytes_left() > 0);
    mesh_.deck.push_back(std::move(piece));
  }

  void drop_surface_points() {
    const std::size_t points = count("points", 2);
    text_.skip_line();
    for (std::size_t i = 0; i < points; ++i) text_.skip_line();
    mesh_.deck.emplace_back("FFD_SURFACE_POINTS= 0\n");
    if (points == 0) return;
    mesh_.notes.emplace_back("the surface points of an FFD box are not kept: SU2 finds them anew");
  }

  TextReader text_;
  TetPlace* question_;
  Survey survey_;
  std::vector<Label> labels_;
  MeshData mesh_;
  ElementSorter sorter_;
  std::set<std::string_view> seen_;
  std::set<std::string_view> tags_;
  std::size_t markers_ = 0;
  bool is_open_ = false;  // a marker whose elements have not come yet
};

/// Elements of one label.
struct Marker {
  std::string tag;
  std::vector<std::pair<const ElementList*, std::size_t>> elements;
};

class Su2Writer {
 public:
  Su2Writer(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file), mesh_(mesh), lists_(mesh) {}

  void write() {
    out_.put("NDIME= 3\n");
    write_volumes();
    out_.put(fmt::format("NPOIN= {}\n", mesh_.point_count()));
    put_rows(out_, mesh_.point_count(), [this](std::size_t i, OutputBuffer& buffer) {
      for (int axis = 0; axis < 3; ++axis) {
        buffer.put_real(mesh_.point(i)[axis]);
        buffer.put(' ');
      }
      buffer.put_integer(static_cast<std::int64_t>(i));
      buffer.put('\n');
    });
    write_markers();
    if (mesh_.data() != nullptr && mesh_.data()->variant == kSu2) {
      for (const std::string& piece : mesh_.data()->deck) out_.put(piece);
    }
    out_.commit(mesh_.companions());
  }

 private:
  static void put_element(OutputBuffer& buffer, const ElementList& list, std::size_t i) {
    buffer.put_integer(list.kind.vtk_type);
    for (const std::uint32_t vertex : list.vertices(i)) {
      buffer.put(' ');
      buffer.put_integer(vertex);
    }
  }

  void write_volumes() {
    std::size_t count = 0;
    for (const ElementList* list : lists_.of_dimension(3)) count += list->count;
    out_.put(fmt::format("NELEM= {}\n", count));
    std::size_t first = 0;
    for (const ElementList* list : lists_.of_dimension(3)) {
      put_rows(out_, list->count, [&](std::size_t i, OutputBuffer& buffer) {
        put_element(buffer, *list, i);
        buffer.put(' ');
        buffer.put_integer(static_cast<std::int64_t>(first + i));
        buffer.put('\n');
      });
      first += list->count;
    }
  }

  void write_markers() {
    collect_markers();
    out_.put(fmt::format("NMARK= {}\n", markers_.size()));
    for (const Marker& marker : markers_) {
      out_.put(
          fmt::format("MARKER_TAG= {}\nMARKER_ELEMS= {}\n", marker.tag, marker.elements.size()));
      put_rows(out_, marker.elements.size(), [&](std::size_t i, OutputBuffer& buffer) {
        put_element(buffer, *marker.elements[i].first, marker.elements[i].second);
        buffer.put('\n');
      });
    }
  }

  /// Those of groups first, in their order; then those of labels without a name.
  void collect_markers() {
    std::map<Label, std::size_t> marker_of;
    if (mesh_.data() != nullptr) {
      const LabelNames names(*mesh_.data());
      std::map<const Group*, Label> label_of;
      for (const auto& [label, group] : names.named(2)) label_of[group] = label;
      for (const Group& group : mesh_.data()->groups) {
        const auto found = label_of.find(&group);
        if (found != label_of.end()) add_marker(marker_of, found->second, group.name);
      }
    }
    for (const ElementList* list : lists_.of_dimension(2)) {
      for (std::size_t i = 0; i < list->count; ++i) {
        const Label label = list->label(i);
        const auto found = marker_of.find(label);
        const std::size_t marker = found != marker_of.end()
                                       ? found->second
                                       : add_marker(marker_of, label, fmt::format("{}", label));
        markers_[marker].elements.emplace_back(list, i);
      }
    }
  }

  /// A tag is one word, and no other marker has it.
  std::size_t add_marker(std::map<Label, std::size_t>& marker_of, Label label, std::string tag) {
    for (char& c : tag) {
      if (c == kComment || c == '=' || static_cast<unsigned char>(c) <= ' ') c = '_';
    }
    markers_.push_back({names_.make(tag), {}});
    return marker_of[label] = markers_.size() - 1;
  }

  OutputFile out_;
  const MeshView& mesh_;
  ElementLists lists_;
  std::vector<Marker> markers_;
  UniqueNames names_;
};

}  // namespace

MeshData read_su2(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return Su2Reader(input, question).read();
}

void write_su2(const std::filesystem::path& file, const MeshView& mesh) {
  Su2Writer(file, mesh).write();
}

}  // namespace tetmend::formats
