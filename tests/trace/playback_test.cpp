// SPDX-License-Identifier: MIT
#include "trace/playback.h"

#include <functional>
#include <string_view>

#include <doctest/doctest.h>

#include "tests/support/tets.h"
#include "tests/support/traced_run.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

TraceEvent cavity_of(std::vector<TetHandle> removed, std::vector<TetHandle> created,
                     std::vector<TetVertices> vertices) {
  TraceEvent event;
  event.kind = EventKind::replace_cavity;
  event.removed = std::move(removed);
  event.created = std::move(created);
  event.created_vertices = std::move(vertices);
  return event;
}

TraceEvent vertex_event(EventKind kind, std::uint32_t vertex, std::vector<TetHandle> star = {}) {
  TraceEvent event;
  event.kind = kind;
  event.vertices = {VertexHandle(vertex)};
  event.point = Point(1, 2, 3);
  event.removed = std::move(star);
  return event;
}

}  // namespace

TEST_CASE("an event that does not fit the mesh is damage, and the mesh is what it was") {
  const SlotMesh mesh{TetMesh(two_tets())};
  const TetHandle first(0);
  const TetVertices sound = mesh.vertices(first);
  Playback playback(mesh);
  const std::vector<TraceEvent> wrong = {
      cavity_of({TetHandle(2)}, {TetHandle(2)}, {sound}),
      cavity_of({first}, {first}, {tet_of(0, 1, 2, 5)}),
      cavity_of({first}, {first}, {tet_of(0, 1, 2, 0xffffffff)}),
      cavity_of({first}, {first}, {tet_of(0, 1, 1, 2)}),
      cavity_of({first}, {first, TetHandle(70'000)}, {sound, sound}),
      cavity_of({first}, {first, TetHandle(1)}, {sound, sound}),
      cavity_of({}, {TetHandle(2)}, {sound}),
      vertex_event(EventKind::add_vertex, 70'000),
      vertex_event(EventKind::add_vertex, 4),
      vertex_event(EventKind::remove_vertex, 5),
      vertex_event(EventKind::move_vertex, 5),
      vertex_event(EventKind::move_vertex, 0, {TetHandle(2)}),
      vertex_event(EventKind::undo, 0)};
  for (std::size_t k = 0; k < wrong.size(); ++k) {
    CAPTURE(k);
    CHECK_THROWS_AS(playback.prepare(wrong[k], 0), ByteReader::Damage);
    CHECK(playback.mesh().fingerprint() == mesh.fingerprint());
    CHECK(playback.mesh().tet_slots() == 2);
    CHECK(playback.mesh().vertex_slots() == 5);
  }
}

TEST_CASE("steps are made, undone and taken back") {
  const SlotMesh mesh{TetMesh(two_tets())};
  Playback playback(mesh);
  const auto play = [&](const TraceEvent& event, std::uint64_t position) {
    REQUIRE(playback.prepare(event, position));
    playback.make();
  };
  play(vertex_event(EventKind::add_vertex, 5), 0);
  const std::uint64_t with_vertex = playback.mesh().fingerprint();
  CHECK(playback.mesh().vertex_count() == 6);
  CHECK(playback.vertex_changes(1).size() == 1);
  play(vertex_event(EventKind::undo, 0), 1);
  CHECK(playback.mesh().fingerprint() == mesh.fingerprint());
  playback.back_to(1);
  CHECK(playback.mesh().fingerprint() == with_vertex);
  playback.back_to(0);
  CHECK(playback.mesh().fingerprint() == mesh.fingerprint());
  CHECK(playback.log_size() == 0);
}
