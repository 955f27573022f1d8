// SPDX-License-Identifier: MIT
//   kernel_programs MESH
// The programs of docs/kernel.md, run one after the other on one mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <tetmend/improve.h>
#include <tetmend/kernel.h>
#include <tetmend/measure.h>
#include <tetmend/operators.h>
#include <tetmend/schedule.h>

using namespace tetmend::kernel;

double aspect(const std::array<Point, 4>& p) {
  double longest = 0;
  for (auto [i, j] : kEdgeVertices) longest = std::max(longest, (p[i] - p[j]).norm());
  return std::sqrt(2.0) * volume6(p[0], p[1], p[2], p[3]) / std::pow(longest, 3);
}

std::array<std::size_t, 10> histogram(const TetMesh& mesh) {
  std::array<std::size_t, 10> bins{};
  for (TetHandle t : mesh.tets()) {
    ++bins[static_cast<std::size_t>(std::clamp(10 * aspect(mesh.points(t)), 0.0, 9.0))];
  }
  return bins;
}

void look_around(const TetMesh& mesh, TetEdge e) {
  const Ring ring = mesh.ring(e);
  std::printf("%zu tets, %s; star %zu, one-ring %zu\n", ring.tets.size(),
              ring.closed ? "closed" : "open", mesh.star(ring.a).size(),
              mesh.one_ring(ring.a).size());
  const auto boundary = mesh.boundary();
  std::printf("%td faces, %td of them on the boundary\n",
              std::distance(mesh.faces().begin(), mesh.faces().end()),
              std::distance(boundary.begin(), boundary.end()));
}

std::size_t count_sharp_edges(TetMesh& mesh) {
  auto sharp = mesh.vertex_property<int>("sharp");
  const auto normal = [&](VertexHandle a, VertexHandle b, VertexHandle c) -> Point {
    return (mesh.point(b) - mesh.point(a)).cross(mesh.point(c) - mesh.point(a)).normalized();
  };
  std::size_t count = 0;
  for (TetEdge e : mesh.edges()) {
    const Ring ring = mesh.ring(e);
    if (ring.closed) continue;  // inside the mesh
    const auto [a, b] = mesh.vertices(e);
    const Point first = normal(b, a, ring.vertices.front());
    if (first.dot(normal(a, b, ring.vertices.back())) > 0.7) continue;
    ++count;
    ++sharp[a];
    ++sharp[b];
  }
  return count;
}

std::size_t count_new(TetMesh& mesh) {
  auto age = mesh.tet_property<int>("age");
  for (TetHandle t : mesh.tets()) age[t] = 7;
  for (TetHandle t : mesh.tets()) attempt(mesh, "edge_removal", TetEdge(t, 0));
  mesh.collect_garbage();
  std::size_t count = 0;
  for (TetHandle t : mesh.tets()) count += age[t] == 0 ? 1 : 0;  // a new tet
  return count;
}

void smooth(TetMesh& mesh) {
  for (VertexHandle v : mesh.vertices()) {
    if (mesh.is_fixed(v)) continue;
    Point mean = Point::Zero();
    const OneRing ring = mesh.one_ring(v);
    for (VertexHandle w : ring) mean += mesh.point(w) / static_cast<double>(ring.size());
    Transaction edit(mesh);
    if (edit.move(v, mean) == EditResult::made) edit.keep();  // no tet turned over
  }
}

double worst(const std::vector<std::array<Point, 4>>& tets) {
  return aspect(std::ranges::min(tets, {}, aspect));
}

void flip_edges_away(TetMesh& mesh) {
  for (TetEdge e : mesh.edges()) {
    Transaction edit(mesh);
    if (edit.flip_3_2(e) != EditResult::made) continue;
    if (worst(edit.after()) > worst(edit.before())) edit.keep();
  }  // what was not kept is as it was, bit for bit
}

void adapt_lengths(TetMesh& mesh, double low, double high) {
  const auto length = [&](VertexHandle v, VertexHandle w) {
    return (mesh.point(v) - mesh.point(w)).norm();
  };
  for (VertexHandle v : mesh.vertices()) {
    for (VertexHandle w : mesh.one_ring(v)) {
      if (length(v, w) > low) continue;
      Transaction edit(mesh);
      if (edit.contract(v, w) != EditResult::made) continue;
      edit.keep();
      break;  // v is gone
    }
  }
  for (TetEdge e : mesh.edges()) {
    const auto [v, w] = mesh.vertices(e);
    if (length(v, w) < high) continue;
    Transaction edit(mesh);
    if (edit.split(e, (mesh.point(v) + mesh.point(w)) / 2).is_valid()) edit.keep();
  }
}

int find_regions(TetMesh& mesh) {
  auto region = mesh.tet_property<int>("region");
  int count = 0;
  for (TetHandle seed : mesh.tets()) {
    if (region[seed] > 0) continue;
    region[seed] = ++count;
    for (std::deque<TetHandle> queue{seed}; !queue.empty(); queue.pop_front())
      for (TetHandle n : mesh.neighbours(queue.front()))
        if (region[n] == 0 && mesh.label(n) == mesh.label(seed))
          region[queue.emplace_back(n)] = count;
  }
  return count;
}

Mesh half_of(const TetMesh& mesh, double x) {
  return extract(mesh, [&](TetHandle t) { return mesh.points(t)[0].x() > x; });
}

TetMesh refine(const TetMesh& mesh) {
  std::vector<Point> points;
  std::vector<std::uint32_t> number(mesh.vertex_slots());
  for (VertexHandle v : mesh.vertices()) {
    number[v.index()] = static_cast<std::uint32_t>(points.size());
    points.push_back(mesh.point(v));
  }
  std::vector<std::array<std::uint32_t, 6>> middle(mesh.tet_slots());
  for (TetEdge e : mesh.edges()) {
    const auto [v, w] = mesh.vertices(e);
    for (TetHandle t : mesh.ring(e).tets) {
      for (TetEdge same : mesh.edges(t)) {
        const auto [a, b] = mesh.vertices(same);
        if ((a == v && b == w) || (a == w && b == v))
          middle[t.index()][same.edge()] = static_cast<std::uint32_t>(points.size());
      }
    }
    points.push_back((mesh.point(v) + mesh.point(w)) / 2);
  }
  std::vector<std::array<std::uint32_t, 4>> tets;
  for (TetHandle t : mesh.tets()) {
    const auto& m = middle[t.index()];
    std::array<std::uint32_t, 4> v{};
    for (unsigned i = 0; i < 4; ++i) v[i] = number[mesh.vertices(t)[i].index()];
    tets.insert(tets.end(), {{v[0], m[0], m[1], m[2]},
                             {m[0], v[1], m[3], m[4]},
                             {m[1], m[3], v[2], m[5]},
                             {m[2], m[4], m[5], v[3]},
                             {m[0], m[1], m[2], m[4]},
                             {m[0], m[3], m[1], m[4]},
                             {m[1], m[5], m[2], m[4]},
                             {m[1], m[3], m[5], m[4]}});
  }
  return TetMesh(points, tets);
}

Call largest_call(TetMesh& mesh) {
  Call largest;
  for (TetHandle t : mesh.tets()) {
    if (mesh.quality(t) >= 1) continue;
    for (TetEdge e : mesh.edges(t)) {
      Call call = try_only(mesh, "recursive_shell_transformation", e, {{"max_level", 5}});
      if (call.size() > largest.size()) largest = std::move(call);
    }
  }
  return largest;
}

Operators own_operators() {
  Operators own;
  own.add(
      "my_flip", "three tets of an edge become two",
      [](const TetMesh& look, TetEdge e, Proposal& out) {
        const Ring r = look.ring(e);
        if (!r.closed || r.tets.size() != 3) return Verdict::not_applicable;
        const auto& p = r.vertices;
        return out.replace(r.tets, {{r.a, p[0], p[1], p[2]}, {p[0], p[1], p[2], r.b}});
      },
      Judge::by([](Judge::Tets before, Judge::Tets now) { return now.size() < before.size(); }));
  return own;
}

tetmend::Result improve_by_aspect(Mesh& mesh) {
  Operators own = own_operators();
  own.add_measure(
      {"aspect", 0.3, [](const Point& a, const Point& b, const Point& c, const Point& d) {
         return aspect({a, b, c, d});
       }});
  return tetmend::improve(mesh, {.operators = &own, .measure = "aspect"});
}

QualityIndicators improve_by_rounds(TetMesh& mesh) {
  const Operators own = own_operators();
  Run run(mesh, {.threads = 4, .operators = &own});
  QualityIndicators before, now = run.indicators();
  do {
    before = now;
    run.local_reconnection({.edge_settings = {{"max_level", 2}}, .most_edges = 1});
    run.smooth();
    run.apply("my_flip");
    run.apply({.what = first_of({one("edge_removal"), one("multi_face_removal")}),
               .on = {.below = 0.5F, .worst = 100}});
    now = run.indicators();
  } while (now.n_bad > 0 && is_progress_over(now, before));
  return now;
}

struct Refusals final : TraceSink {
  std::map<std::string, std::map<Verdict, std::size_t>> of;
  std::vector<std::string> open;  // attempts lie in each other
  void attempt_begins(const AttemptEvent& event) override {
    open.emplace_back(event.operator_name);
  }
  void attempt_ends(Verdict verdict, std::span<const Quality>, std::span<const Quality>) override {
    ++of[open.back()][verdict];
    open.pop_back();
  }
};

/// Prints and ends the program when something of the page is not so.
void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", what);
  std::exit(1);
}

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const Mesh file = load(argv[1]);
  TetMesh mesh(file);
  expect(mesh.tet_count() == file.tet_count(), "a mesh has the tets of its file");
  std::size_t binned = 0;
  for (std::size_t bin : histogram(mesh)) binned += bin;
  expect(binned == mesh.tet_count(), "(a) each tet is in a bin");
  look_around(mesh, *mesh.edges().begin());
  std::printf("%zu sharp edges\n", count_sharp_edges(mesh));
  expect(count_new(mesh) > 0, "(c) edge removal makes tets");
  smooth(mesh);
  const std::size_t before_flips = mesh.tet_count();
  flip_edges_away(mesh);
  std::printf("%zu edges flipped away\n", before_flips - mesh.tet_count());
  adapt_lengths(mesh, 0.1, 2.0);
  std::printf("%d regions\n", find_regions(mesh));
  save("half.vtu", half_of(mesh, 0.5));
  expect(refine(mesh).tet_count() == 8 * mesh.tet_count(), "(i) eight tets for one");
  std::fputs(largest_call(mesh).text().c_str(), stdout);
  TetMesh better(mesh);
  const std::size_t left = improve_by_rounds(better).n_bad;
  std::printf("%zu bad tets after rounds\n", left);
  expect(better.check().empty(), "the mesh is sound after passes");
  expect(left <= Run(mesh).indicators().n_bad, "passes leave no more bad tets");
  Refusals told;
  TetMesh looked_at(mesh);
  const PassDone done = Run(looked_at, {.observer = &told}).apply("edge_removal", {.worst = 50});
  expect(done.accepted == told.of["edge_removal"][Verdict::accepted], "an observer is told of all");
  const Operators own = own_operators();
  std::size_t accepted = 0;
  for (TetEdge e : mesh.edges()) accepted += attempt(mesh, own, "my_flip", e).accepted() ? 1 : 0;
  expect(accepted > 0, "an operator of the program makes fewer tets of more");
  expect(mesh.check().empty(), "the mesh is sound after all that");
  Mesh by_aspect = file;
  const auto flat = [](const Mesh& of) {
    const auto bins = histogram(TetMesh(of));
    return bins[0] + bins[1] + bins[2];  // below 0.3
  };
  expect(improve_by_aspect(by_aspect).after.tets > 0, "improve() takes a measure of the program");
  std::printf("%zu tets below an aspect of 0.3, %zu after\n", flat(file), flat(by_aspect));
  expect(flat(by_aspect) < flat(file), "there are fewer tets that the measure calls bad");
  expect(tetmend::measure(mesh.to_mesh()).statistics.inverted == 0, "no tet is inverted");
  return 0;
}
