// SPDX-License-Identifier: MIT
// The layout of the format: kernel/formats/gmsh_writer.cpp.
//
//   a small mesh with an element for each label -> its plan: entities, their boxes and numbers
//   or the entities of the file that was read: their numbers go where labels are otherwise
//   entity of each vertex: that of lowest dimension that has an element with it
//   nodes, then elements, entity by entity: many small ones, or one large, in a walk over all pieces
#include "pieces/gmsh_output.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/formats/gmsh_plan.h"
#include "kernel/formats/gmsh_rows.h"
#include "kernel/formats/output_file.h"
#include "pieces/bytes.h"
#include "pieces/file_walk.h"

namespace tetmend::pieces {

namespace {

/// What a stored piece has of one label, among its edges, triangles or tets.
struct LabelShare {
  std::uint64_t part = 0;
  std::int32_t dimension = 0;
  Label label = 0;
  std::uint64_t count = 0;
  std::array<double, 3> low{};
  std::array<double, 3> high{};
};

/// In the order in which labels come.
template <class Element>
void add_label_shares(const Piece& piece, std::uint64_t part, std::int32_t dimension,
                      const std::vector<Element>& elements, std::vector<LabelShare>& shares) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::map<Label, std::size_t> place;
  for (const Element& element : elements) {
    const auto [at, is_new] = place.try_emplace(element.label, shares.size());
    if (is_new) {
      shares.push_back(
          {part, dimension, element.label, 0, {kFar, kFar, kFar}, {-kFar, -kFar, -kFar}});
    }
    LabelShare& share = shares[at->second];
    ++share.count;
    for (const std::uint32_t v : element.vertices) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = piece.points[v][static_cast<Eigen::Index>(axis)];
        share.low[axis] = std::min(share.low[axis], x);
        share.high[axis] = std::max(share.high[axis], x);
      }
    }
  }
}

/// Gives elements their entities for labels, and leaves out walls.
class EntityNames {
 public:
  /// @param carried  null: labels stay
  explicit EntityNames(const CarriedEntities* carried) : carried_(carried) {}

  void operator()(std::size_t part, Piece& piece) const {
    if (carried_ == nullptr) return;
    name(part, RowKind::edge, 1, piece.edges);
    name(part, RowKind::triangle, 2, piece.triangles);
    name(part, RowKind::tet, 3, piece.tets);
  }

 private:
  template <class Element>
  void name(std::size_t part, RowKind kind, std::size_t dimension,
            std::vector<Element>& elements) const {
    if (carried_->rows.layout(kind).size() == 0) {
      const auto& entity_of = carried_->extras.entity_of[dimension];
      for (Element& element : elements) element.label = entity_of.find(element.label)->second;
      return;
    }
    const std::string rows = carried_->rows.column(kind, part, 0, 0, elements.size());
    std::string_view rest = rows;
    for (Element& element : elements) take(rest, element.label);
    std::erase_if(elements, [](const Element& element) { return element.label == kWall; });
  }

  const CarriedEntities* carried_;
};

/// Of all ranks, in the order of the pieces.
std::vector<LabelShare> gather_shares(const DividedMesh& mesh, const EntityNames& names) {
  std::string bytes;
  for (const std::size_t part : mesh.own()) {
    Piece piece = mesh.stored(part);
    names(part, piece);
    std::vector<LabelShare> shares;
    add_label_shares(piece, part, 1, piece.edges, shares);
    add_label_shares(piece, part, 2, piece.triangles, shares);
    add_label_shares(piece, part, 3, piece.tets, shares);
    for (const LabelShare& share : shares) put(share, bytes);
  }
  std::vector<LabelShare> all;
  for (const std::string& from : mesh.ranks().gather(bytes)) {
    for (std::string_view rest = from; !rest.empty();) take(rest, all.emplace_back());
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const LabelShare& a, const LabelShare& b) { return a.part < b.part; });
  return all;
}

/// A mesh that has the same entities, with the same boxes.
MeshData skeleton_of(const std::vector<LabelShare>& shares) {
  MeshData data;
  for (const LabelShare& share : shares) {
    const auto low = static_cast<std::uint32_t>(data.points.size());
    const std::uint32_t high = low + 1;
    data.points.emplace_back(share.low[0], share.low[1], share.low[2]);
    data.points.emplace_back(share.high[0], share.high[1], share.high[2]);
    if (share.dimension == 1) data.edges.push_back({{low, high}, share.label});
    if (share.dimension == 2) data.triangles.push_back({{low, high, high}, share.label});
    if (share.dimension == 3) data.tets.push_back({{low, high, high, high}, share.label});
  }
  return data;
}

/// The first rank writes what all send it.
class GmshWriter {
 public:
  /// @param out null on all ranks but the first
  GmshWriter(OutputFile* out, const std::filesystem::path& file, const DividedMesh& mesh,
             bool binary, const CarriedEntities* carried)
      : out_(out),
        ranks_(mesh.ranks()),
        first_id_(mesh.state().first_id),
        walk_(mesh),
        carried_(carried),
        names_(carried),
        shares_(gather_shares(mesh, names_)),
        skeleton_(carried != nullptr ? carried->extras.head : skeleton_of(shares_)),
        view_(skeleton_),
        plan_(view_) {
    if (out_ != nullptr) sections_.emplace(*out_, file.string(), true, binary);
    carried == nullptr ? list_entities() : list_carried_entities();
    for (const LabelShare& share : shares_) {
      counts_[static_cast<std::size_t>(share.dimension)] += share.count;
    }
  }

  void write() {
    if (sections_) {
      sections_->write_header();
      sections_->write_names(plan_.names);
      sections_->write_entities(plan_.entities);
    }
    write_nodes();
    write_elements();
    if (walk_.has_point_labels()) write_point_labels();
  }

 private:
  struct Entity {
    std::int32_t dimension = 0;
    Label tag = 0;
    std::uint64_t elements = 0;
    std::uint64_t nodes = 0;
  };
  /// An element as it comes to the first rank.
  template <std::size_t N>
  struct FileRow {
    std::array<std::uint64_t, N> numbers;
    std::int64_t label;
  };

  /// In the order of the file, with the number of elements of each.
  void list_entities() {
    std::array<std::size_t, 4> begins{};
    for (std::size_t d = 0; d < 4; ++d) {
      begins[d] = entities_.size();
      for (const GeometricEntity& entity : plan_.entities[d]) {
        entities_.push_back({entity.dimension, entity.tag, 0, 0});
      }
    }
    for (const formats::GmshKind& kind : plan_.kinds) {
      const auto d = static_cast<std::size_t>(kind.dimension());
      if (d == 0) continue;
      std::size_t number = 0;  // of an element of the skeleton
      for (const LabelShare& share : shares_) {
        if (share.dimension != kind.dimension()) continue;
        const std::size_t entity = begins[d] + kind.entity_of[number++];
        entities_[entity].elements += share.count;
        entity_of_[d][share.label] = static_cast<std::uint32_t>(entity);
      }
    }
    first_volume_ = static_cast<std::uint32_t>(begins[3]);
  }
  /// Those of the file that was read, by their numbers.
  void list_carried_entities() {
    for (std::size_t d = 0; d < 4; ++d) {
      if (d == 3) first_volume_ = static_cast<std::uint32_t>(entities_.size());
      for (const GeometricEntity& entity : plan_.entities[d]) {
        entity_of_[d][entity.tag] = static_cast<std::uint32_t>(entities_.size());
        entities_.push_back({entity.dimension, entity.tag, 0, 0});
      }
    }
    for (const LabelShare& share : shares_) {
      entities_[entity_of(static_cast<std::size_t>(share.dimension), share.label)].elements +=
          share.count;
    }
    for (const GmshPointElement& point : carried_->extras.points) {
      ++entities_[entity_of(0, point.entity)].elements;
    }
    counts_[0] = carried_->extras.points.size();
  }
  std::uint32_t entity_of(std::size_t dimension, std::int64_t label) const {
    return entity_of_[dimension].find(static_cast<Label>(label))->second;
  }

  /// see( numbers, label ) on the first rank, for each element of a kind.
  template <class Element, class See>
  void for_each(std::vector<Element> Piece::*list, See see) const {
    using RowOf = FileRow<std::tuple_size_v<decltype(Element::vertices)>>;
    const auto pack = [](const auto& numbers, Label label, std::string& bytes) {
      pieces::put(RowOf{numbers, label}, bytes);
    };
    walk_.elements(
        list, pack,
        [&](std::string_view bytes) {
          RowOf row;
          while (!bytes.empty()) {
            pieces::take(bytes, row);
            see(row);
          }
        },
        names_);
  }

  /// Vertices of the file that was read have an entity that the file names.
  void take_named_entities() {
    if (carried_ == nullptr) return;
    const CarriedRows& rows = carried_->rows;
    std::size_t v = 0;
    walk_.vertex_bytes(
        rows.layout(RowKind::vertex).width(0),
        [&](std::size_t part, std::size_t begin, const Piece& vertices) {
          return rows.column(RowKind::vertex, part, 0, begin, begin + vertices.ids.size());
        },
        [&](std::string_view bytes) {
          for (std::array<std::int32_t, 2> entity{}; !bytes.empty(); ++v) {
            pieces::take(bytes, entity);
            if (entity[0] < 0) continue;
            entity_of_node_[v] = entity_of(static_cast<std::size_t>(entity[0]), entity[1]);
          }
        });
  }

  void classify_nodes() {
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    if (out_ != nullptr) entity_of_node_.assign(walk_.counts().vertices, kNone);
    take_named_entities();
    const auto classify = [&](std::size_t dimension, auto list) {
      for_each(list, [&](const auto& row) {
        for (const std::uint64_t v : row.numbers) {
          if (entity_of_node_[v] == kNone) entity_of_node_[v] = entity_of(dimension, row.label);
        }
      });
    };
    classify(1, &Piece::edges);
    classify(2, &Piece::triangles);
    if (plan_.entities[3].size() > 1) classify(3, &Piece::tets);
    std::replace(entity_of_node_.begin(), entity_of_node_.end(), kNone, first_volume_);
    std::vector<std::uint64_t> counts(entities_.size(), 0);
    for (const std::uint32_t entity : entity_of_node_) ++counts[entity];
    std::string bytes;
    if (out_ != nullptr) pieces::put(counts, bytes);
    const std::vector<std::string> all = ranks_.gather(bytes);
    std::string_view first = all.front();
    pieces::take(first, counts);
    for (std::size_t i = 0; i < counts.size(); ++i) entities_[i].nodes = counts[i];
  }

  /// Calls run(begin, end) for entities that follow each other: as many as have few bytes, or one.
  template <class Run>
  void in_turns(std::size_t begin, std::size_t end, const std::vector<std::uint64_t>& bytes,
                Run run) const {
    constexpr std::uint64_t kAtOnce = std::uint64_t{1} << 25;
    while (begin < end) {
      std::size_t last = begin + 1;
      for (std::uint64_t sum = bytes[begin]; last < end; ++last) {
        sum += bytes[last];
        if (sum > kAtOnce) break;
      }
      run(begin, last);
      begin = last;
    }
  }

  /// Numbers of blocks and of all rows, the least and the greatest number of a row.
  void begin_section(std::string_view name, std::uint64_t Entity::*rows) {
    if (!sections_) return;
    std::size_t blocks = 0;
    std::uint64_t count = 0;
    for (const Entity& entity : entities_) {
      blocks += entity.*rows > 0 ? 1 : 0;
      count += entity.*rows;
    }
    sections_->begin(name);
    const auto last = static_cast<std::int64_t>(count);
    sections_->row()
        .size(blocks)
        .size(count)
        .wide(std::min<std::int64_t>(last, 1))
        .wide(last)
        .end();
  }

  void write_nodes() {
    classify_nodes();
    begin_section("Nodes", &Entity::nodes);
    std::vector<std::uint64_t> bytes;
    for (const Entity& entity : entities_) bytes.push_back(sizeof(Point) * entity.nodes);
    in_turns(0, entities_.size(), bytes,
             [&](std::size_t begin, std::size_t end) { write_nodes_of(begin, end); });
    if (sections_) sections_->end_numbers("Nodes");
    entity_of_node_ = {};
  }

  void begin_node_block(std::uint32_t number) {
    const Entity& entity = entities_[number];
    sections_->row()
        .integer(entity.dimension)
        .integer(entity.tag)
        .integer(0)
        .size(entity.nodes)
        .end();
    for (std::size_t v = 0; v < entity_of_node_.size(); ++v) {
      if (entity_of_node_[v] == number)
        sections_->row().wide(static_cast<std::int64_t>(v) + 1).end();
    }
  }
  void write_point(const std::array<double, 3>& p) {
    sections_->row().real(p[0]).real(p[1]).real(p[2]).end();
  }
  void write_nodes_of(std::size_t begin, std::size_t end) {
    const bool is_alone = end == begin + 1;
    std::vector<std::vector<std::array<double, 3>>> points(end - begin);
    if (is_alone && entities_[begin].nodes == 0) return;
    if (is_alone && sections_) begin_node_block(static_cast<std::uint32_t>(begin));
    std::size_t v = 0;
    walk_.vertices([&](std::span<const FileVertex> some) {
      for (const FileVertex& vertex : some) {
        const std::size_t entity = entity_of_node_[v++];
        if (entity < begin || entity >= end) continue;
        if (is_alone) {
          write_point(vertex.point);
        } else {
          points[entity - begin].push_back(vertex.point);
        }
      }
    });
    if (is_alone || !sections_) return;
    for (std::size_t i = begin; i < end; ++i) {
      if (entities_[i].nodes == 0) continue;
      begin_node_block(static_cast<std::uint32_t>(i));
      for (const auto& point : points[i - begin]) write_point(point);
    }
  }

  void write_elements() {
    begin_section("Elements", &Entity::elements);
    write_point_elements();
    std::uint64_t first = 1 + counts_[0];
    write_kind(1, formats::gmsh_edge, first, &Piece::edges);
    first += counts_[1];
    write_kind(2, formats::gmsh_triangle, first, &Piece::triangles);
    first += counts_[2];
    write_kind(3, formats::gmsh_tet, first, &Piece::tets);
    if (sections_) sections_->end_numbers("Elements");
  }

  /// Those in groups come first, by their vertices.
  void write_point_elements() {
    if (!sections_ || counts_[0] == 0) return;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> rows;  // vertex, entity
    for (const bool is_in_group : {true, false}) {
      const auto begin = static_cast<std::ptrdiff_t>(rows.size());
      for (const GmshPointElement& point : carried_->extras.points) {
        if (point.is_in_group != is_in_group) continue;
        rows.emplace_back(walk_.number(first_id_ + point.vertex), entity_of(0, point.entity));
      }
      if (is_in_group) std::sort(rows.begin() + begin, rows.end());
    }
    for (std::uint32_t entity = 0; entity < entities_.size(); ++entity) {
      if (entities_[entity].dimension > 0 || entities_[entity].elements == 0) continue;
      begin_element_block(entity, formats::gmsh_point);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].second != entity) continue;
        sections_->row()
            .wide(static_cast<std::int64_t>(i) + 1)
            .wide(static_cast<std::int64_t>(rows[i].first) + 1)
            .end();
      }
    }
  }
  void begin_element_block(std::size_t number, int type) {
    const Entity& entity = entities_[number];
    sections_->row()
        .integer(entity.dimension)
        .integer(entity.tag)
        .integer(type)
        .size(entity.elements)
        .end();
  }

  template <class Element>
  void write_kind(std::int32_t dimension, int type, std::uint64_t first,
                  std::vector<Element> Piece::*list) {
    const auto is_before = [](const Entity& entity, std::int32_t d) {
      return entity.dimension < d;
    };
    const auto begin_of = [&](std::int32_t d) {
      return static_cast<std::size_t>(
          std::lower_bound(entities_.begin(), entities_.end(), d, is_before) - entities_.begin());
    };
    constexpr std::size_t kVertices = std::tuple_size_v<decltype(Element::vertices)>;
    using Numbered = std::pair<std::uint64_t, std::array<std::uint64_t, kVertices>>;
    std::vector<std::uint64_t> bytes;
    for (const Entity& entity : entities_) bytes.push_back(sizeof(Numbered) * entity.elements);
    const auto write_row = [&](std::uint64_t number, const auto& vertices) {
      auto row = sections_->row();
      row.wide(static_cast<std::int64_t>(number));
      for (const std::uint64_t v : vertices) row.wide(static_cast<std::int64_t>(v) + 1);
      row.end();
    };
    in_turns(begin_of(dimension), begin_of(dimension + 1), bytes,
             [&](std::size_t begin, std::size_t end) {
               const bool is_alone = end == begin + 1;
               std::vector<std::vector<Numbered>> rows(end - begin);
               if (is_alone && entities_[begin].elements == 0) return;
               if (is_alone && sections_) begin_element_block(begin, type);
               std::uint64_t number = first;
               for_each(list, [&](const auto& row) {
                 const std::uint64_t here = number++;
                 const std::size_t entity =
                     entity_of(static_cast<std::size_t>(dimension), row.label);
                 if (entity < begin || entity >= end) return;
                 if (is_alone) {
                   write_row(here, row.numbers);
                 } else {
                   rows[entity - begin].push_back({here, row.numbers});
                 }
               });
               if (is_alone || !sections_) return;
               for (std::size_t i = begin; i < end; ++i) {
                 if (entities_[i].elements > 0) begin_element_block(i, type);
                 for (const auto& [here, vertices] : rows[i - begin]) write_row(here, vertices);
               }
             });
  }

  void write_point_labels() {
    if (sections_) {
      sections_->write_view_head("NodeData", formats::kGmshPointLabels, 1, walk_.counts().vertices);
    }
    std::int64_t number = 0;
    walk_.vertices([&](std::span<const FileVertex> some) {
      for (const FileVertex& vertex : some) {
        sections_->row().integer(++number).real(vertex.label).end();
      }
    });
    if (sections_) sections_->end_numbers("NodeData");
  }

  OutputFile* out_;
  Ranks& ranks_;
  const VertexId first_id_;
  const FileWalk walk_;
  const CarriedEntities* carried_;  // null: each label is an entity
  const EntityNames names_;
  const std::vector<LabelShare> shares_;
  const MeshData skeleton_;
  const MeshView view_;
  formats::GmshPlan plan_;
  std::optional<formats::GmshSections> sections_;  // the first rank has them
  std::vector<Entity> entities_;
  std::array<std::map<Label, std::uint32_t>, 4> entity_of_;  // by dimension and label
  std::array<std::uint64_t, 4> counts_{};                    // of elements, by dimension
  std::uint32_t first_volume_ = 0;
  std::vector<std::uint32_t> entity_of_node_;  // on the first rank
};

}  // namespace

void write_gmsh_slices(const std::filesystem::path& file, const DividedMesh& mesh, bool binary,
                       const CarriedEntities* carried) {
  write_by_first(file, mesh.ranks(),
                 [&](OutputFile* out) { GmshWriter(out, file, mesh, binary, carried).write(); });
}

}  // namespace tetmend::pieces
