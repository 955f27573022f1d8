// SPDX-License-Identifier: MIT
// A run from file to file whose file is the arrays.
#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <tetmend/distributed.h>

#include "pieces/improve.h"
#include "pieces/out_of_core.h"

namespace tetmend {

namespace {

using pieces::RankShare;

constexpr const char* kMeshName = "mesh";  // in messages

void check_labels(std::size_t labels, std::size_t entities, std::string_view name) {
  if (labels == 0 || labels == entities) return;
  throw Error(fmt::format("{}: there are {} for {} entities", name, labels, entities));
}

template <std::size_t N>
void take(const std::vector<std::array<std::uint64_t, N>>& from,
          const std::vector<std::int32_t>& labels, std::string_view name,
          std::vector<RankShare::Element<N>>& to) {
  check_labels(labels.size(), from.size(), name);
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    to[i] = {from[i], labels.empty() ? 0 : labels[i]};
  }
}

template <std::size_t N>
void give(const std::vector<RankShare::Element<N>>& from,
          std::vector<std::array<std::uint64_t, N>>& to, std::vector<std::int32_t>& labels) {
  to.clear();
  labels.clear();
  for (const auto& element : from) {
    to.push_back(element.vertices);
    labels.push_back(element.label);
  }
  const auto is_zero = [](std::int32_t label) { return label == 0; };
  if (std::all_of(labels.begin(), labels.end(), is_zero)) labels.clear();
}

/// Arrays in the place of a file.
class Arrays final : public pieces::ArrayFiles {
 public:
  explicit Arrays(RankArrays& arrays) : arrays_(arrays) {}

  bool is_one(const std::filesystem::path&) const override { return true; }

  RankShare read(const std::filesystem::path&, const std::string&) const override {
    RankShare share;
    for (const auto& p : arrays_.points) share.points.emplace_back(p[0], p[1], p[2]);
    check_labels(arrays_.point_labels.size(), arrays_.points.size(), "point_labels");
    share.point_labels.assign(arrays_.point_labels.begin(), arrays_.point_labels.end());
    take(arrays_.tets, arrays_.tet_labels, "tet_labels", share.tets);
    take(arrays_.triangles, arrays_.triangle_labels, "triangle_labels", share.triangles);
    take(arrays_.edges, arrays_.edge_labels, "edge_labels", share.edges);
    share.required_vertices = arrays_.required_vertices;
    return share;
  }

  void write(const std::filesystem::path&, const RankShare& share) const override {
    RankArrays made;
    for (const Point& p : share.points) made.points.push_back({p.x(), p.y(), p.z()});
    made.point_labels.assign(share.point_labels.begin(), share.point_labels.end());
    give(share.tets, made.tets, made.tet_labels);
    give(share.triangles, made.triangles, made.triangle_labels);
    give(share.edges, made.edges, made.edge_labels);
    made.required_vertices = share.required_vertices;
    arrays_ = std::move(made);
  }

 private:
  RankArrays& arrays_;
};

}  // namespace

Result improve(RankArrays& mesh, Ranks& ranks, const Options& options, const Pieces& pieces) {
  const Arrays arrays(mesh);
  pieces::OutOfCore files;
  files.input = files.output = kMeshName;
  files.array_files = &arrays;
  pieces::Division division;
  division.pieces = pieces.count;
  if (pieces.count == 0) {
    std::int64_t tets = static_cast<std::int64_t>(mesh.tets.size());
    ranks.add({&tets, 1});
    division.pieces =
        std::max<std::size_t>(2, pieces::usual_pieces(static_cast<std::size_t>(tets)));
  } else if (pieces.count == 1) {
    throw OptionError("pieces", "pieces: at least 2 are needed");
  }
  return pieces::improve_files(files, options, division, ranks);
}

}  // namespace tetmend
