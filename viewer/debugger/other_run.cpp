// SPDX-License-Identifier: MIT
#include "viewer/debugger/other_run.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "viewer/debugger/tets_drawing.h"

namespace tetmend::viewer {

namespace {

/// The tet first, then those with an edge of it; at their places in the file.
std::vector<LocalTet> tets_at(const SlotMesh& mesh, const HistorySubject& tet) {
  std::vector<LocalTet> found;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    const TetVertices& vertices = mesh.vertices(t);
    const auto shared = std::count_if(vertices.begin(), vertices.end(), [&](VertexHandle v) {
      return std::find(tet.begin(), tet.end(), v) != tet.end();
    });
    if (shared < 2) continue;
    LocalTet local{t, vertices, {}, mesh.quality(t)};
    for (unsigned k = 0; k < 4; ++k) {
      local.corners[k] = mesh.scale().to_file(mesh.point(vertices[k]));
    }
    found.push_back(local);
    if (shared == 4) std::swap(found.front(), found.back());
  }
  return found;
}

}  // namespace

OtherRun::OtherRun(const TraceFile& here, std::filesystem::path name)
    : name_(std::move(name)),
      file_(name_),
      replay_(file_, 0),
      comparison_(compare_runs(here, file_)) {}

const TetPair* OtherRun::pair() const {
  return place_ ? &comparison_.worse_in_a[place_->number] : nullptr;
}

void OtherRun::look_at(std::size_t number, const SlotMesh& here) {
  if (number >= comparison_.worse_in_a.size()) {
    throw Error(fmt::format("there are {} tets that are bad here and good there, counted from 0",
                            comparison_.worse_in_a.size()));
  }
  const TetPair& pair = comparison_.worse_in_a[number];
  PlaceInBoth place;
  place.number = number;
  place.here = tets_at(here, pair.bad);
  place.there = tets_at(replay_.mesh_at(file_.event_count()), pair.good);
  place.ball = ball_around(place.here).value_or(Ball());
  place.told = history_paragraph(file_, history_of(file_, replay_, pair.good));
  place_ = std::move(place);
}

}  // namespace tetmend::viewer
