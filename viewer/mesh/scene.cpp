// SPDX-License-Identifier: MIT
//   build:   which tets are shown, which are bad -> the triangles of each, by slot
//   update:  the same for the tets that changed; then the triangles of these and of all whose looks
//            follow from theirs. A triangle that is gone leaves its place to the last one.
#include "viewer/mesh/scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "kernel/grouped.h"
#include "viewer/mesh/tet_triangles.h"

namespace tetmend::viewer {

namespace {

constexpr Quality kNotBad = std::numeric_limits<Quality>::infinity();
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

void sort_out(std::vector<std::uint32_t>& slots) {
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
}

}  // namespace

class SceneWork {
 public:
  SceneWork(SceneKeeper& keeper, const SceneInput& input)
      : k_(keeper),
        scene_(keeper.scene_),
        in_(input),
        mesh_(input.mesh),
        settings_(input.settings),
        filter_(input.mesh, input.settings, input.figures, input.ball),
        triangles_(input, keeper.shown_, keeper.taken_) {}

  void build();
  /// False if all must be built.
  bool update(std::span<const TetHandle> changed);

 private:
  enum List : std::size_t { kSurface, kThrough, kGhosts };

  // Of build().
  void clear();
  void choose(std::uint32_t slot, std::vector<SceneKeeper::Bad>& bad);
  void take_worst(std::vector<SceneKeeper::Bad>& bad);
  void draw_all();
  void add_constraints();
  void add_reference();
  void own(std::vector<TetHandle>& tets, const std::vector<SurfaceVertex>& vertices, TetHandle t);
  void write_note();
  template <class Visit>
  void for_each_slot(Visit visit) const {
    if (k_.only_) {
      for (const std::uint32_t slot : *k_.only_) visit(slot);
    } else {
      for (std::uint32_t slot = 0; slot < k_.shown_.size(); ++slot) visit(slot);
    }
  }

  // Of update().
  void follow();
  void chain(List list);
  void choose_again(std::uint32_t slot, std::vector<std::uint32_t>& looks);
  void change_bad(std::uint32_t slot, Quality quality, std::vector<std::uint32_t>& looks);
  void take(const SceneKeeper::Bad& bad, bool take, std::vector<std::uint32_t>& looks);
  void add_neighbours(std::vector<std::uint32_t>& slots) const;
  void draw_again(std::uint32_t slot);
  void replace(List list, std::uint32_t slot, const std::vector<SurfaceVertex>& fresh);
  void write(List list, std::uint32_t triangle, const SurfaceVertex* corners, std::uint32_t slot);
  void drop(List list, std::uint32_t triangle);
  std::uint32_t* link_to(List list, std::uint32_t triangle);
  std::vector<SurfaceVertex>& vertices(List list) {
    return list == kSurface ? scene_.surface : list == kThrough ? scene_.through : scene_.ghosts;
  }
  std::vector<TetHandle>& tets(List list) {
    return list == kSurface   ? scene_.surface_tets
           : list == kThrough ? scene_.through_tets
                              : scene_.ghost_tets;
  }
  /// Beyond a cut it is, too, if the settings say so. Red would spoil the colours of a measure.
  bool is_seen_as_bad(TetHandle t) const {
    const bool is_plain = settings_.colour == "region" || settings_.colour == kDistance;
    return is_plain && triangles_.is_bad(t) &&
           (settings_.bad_beyond_cuts || (!filter_.is_cut_away(t) && !triangles_.is_cut_away(t)));
  }
  /// 1 if something of the tet is shown; remembered for what changes later.
  std::uint8_t counts(std::uint32_t slot) {
    k_.counted_[slot] = k_.shown_[slot] != 0 && !triangles_.is_cut_away(TetHandle(slot)) ? 1 : 0;
    return k_.counted_[slot];
  }
  bool shrinks_all() const {
    return scene_.tets_shown <= kMostShrunkTets || triangles_.cuts_tets();
  }

  SceneKeeper& k_;
  Scene& scene_;
  const SceneInput& in_;
  const TetMesh& mesh_;
  const SceneSettings& settings_;
  TetFilter filter_;
  TetTriangles triangles_;
};

// ---- Anew ---------------------------------------------------------------------------------------

void SceneWork::build() {
  clear();
  std::vector<SceneKeeper::Bad> bad;
  for_each_slot([&](std::uint32_t slot) { choose(slot, bad); });
  take_worst(bad);
  for_each_slot([&](std::uint32_t slot) {
    if (k_.shown_[slot] != 0 && filter_.is_cut_away(TetHandle(slot))) k_.shown_[slot] = 0;
    scene_.tets_shown += counts(slot);
  });
  draw_all();
  write_note();
}

void SceneWork::clear() {
  scene_ = {};
  scene_.origin = in_.ball.centre;
  scene_.number = next_number();
  k_.is_followed_ = false;
  const std::size_t slots = mesh_.tet_slots();
  if (k_.only_ && in_.only && k_.shown_.size() == slots) {  // little was written last time
    for (const std::uint32_t slot : *k_.only_) {
      k_.shown_[slot] = k_.taken_[slot] = k_.counted_[slot] = 0;
      k_.bad_quality_[slot] = kNotBad;
    }
  } else {
    k_.shown_.assign(slots, 0);
    k_.taken_.assign(slots, 0);
    k_.counted_.assign(slots, 0);
    k_.bad_quality_.assign(slots, kNotBad);
  }
  k_.only_.reset();
  if (!in_.only) return;
  k_.only_.emplace();
  for (const TetHandle t : *in_.only) k_.only_->push_back(t.index());
}

void SceneWork::choose(std::uint32_t slot, std::vector<SceneKeeper::Bad>& bad) {
  const TetHandle t(slot);
  if (!filter_.is_chosen(t)) return;
  k_.shown_[slot] = 1;
  if (!is_seen_as_bad(t)) return;
  k_.bad_quality_[slot] = mesh_.quality(t);
  bad.emplace_back(mesh_.quality(t), slot);
}

/// Before anything is cut or peeled away: bad tets are seen all the same.
void SceneWork::take_worst(std::vector<SceneKeeper::Bad>& bad) {
  k_.bad_count_ = bad.size();
  if (bad.size() > in_.most_bad) {
    std::nth_element(bad.begin(), bad.begin() + static_cast<std::ptrdiff_t>(in_.most_bad),
                     bad.end());
    bad.resize(in_.most_bad);
  }
  for (const SceneKeeper::Bad& each : bad) k_.taken_[each.second] = 1;
}

void SceneWork::own(std::vector<TetHandle>& tets, const std::vector<SurfaceVertex>& vertices,
                    TetHandle t) {
  tets.resize(vertices.size() / 3, t);
}

void SceneWork::draw_all() {
  triangles_.shrink_all(shrinks_all());
  if (settings_.constraints) add_constraints();
  if (in_.reference != nullptr && settings_.reference > 0) add_reference();
  for_each_slot([&](std::uint32_t slot) {
    const TetHandle t(slot);
    if (k_.shown_[slot] != 0) triangles_.add_surface(t, scene_.surface);
    own(scene_.surface_tets, scene_.surface, t);
    if (k_.taken_[slot] != 0) triangles_.add_through(t, scene_.through);
    own(scene_.through_tets, scene_.through, t);
  });
  if (settings_.ghosts == 0) return;
  for (std::uint32_t slot = 0; slot < k_.shown_.size(); ++slot) {
    triangles_.add_ghosts(TetHandle(slot), scene_.ghosts);
    own(scene_.ghost_tets, scene_.ghosts, TetHandle(slot));
  }
}

void SceneWork::add_constraints() {
  for (const SurfaceTriangle& triangle : mesh_.surface_triangles()) {
    if (!triangle.interior) continue;
    std::array<glm::dvec3, 3> c;
    for (unsigned i = 0; i < 3; ++i) c[i] = to_glm(mesh_.point(triangle.vertices[i]));
    add_triangle(scene_.through, c, kConstraintColour, scene_.origin);
    std::swap(c[1], c[2]);  // seen from both sides
    add_triangle(scene_.through, c, kConstraintColour, scene_.origin);
  }
  own(scene_.through_tets, scene_.through, TetHandle());
}

void SceneWork::add_reference() {
  Colour colour = kReferenceColour;
  colour.alpha = static_cast<std::uint8_t>(std::lround(255 * settings_.reference));
  for (const auto& corners : in_.reference->triangles(mesh_.scale())) {
    add_triangle(scene_.ghosts, {to_glm(corners[0]), to_glm(corners[1]), to_glm(corners[2])},
                 colour, scene_.origin);
  }
  own(scene_.ghost_tets, scene_.ghosts, TetHandle());
}

void SceneWork::write_note() {
  scene_.bad_shown = std::min(k_.bad_count_, in_.most_bad);
  scene_.note.clear();
  const auto note = [&](const std::string& text) {
    scene_.note += (scene_.note.empty() ? "" : "; ") + text;
  };
  if (k_.bad_count_ > in_.most_bad) {
    note(fmt::format("{} bad tets: the worst {} are seen through the rest", grouped(k_.bad_count_),
                     grouped(in_.most_bad)));
  }
  if (triangles_.is_shrunk() && !shrinks_all()) {
    note("many tets: only the outer two layers are drawn shrunk");
  }
  if (settings_.colour == kDistance && in_.reference == nullptr) {
    note("there is no reference surface to have a distance from");
  }
}

// ---- What changed -------------------------------------------------------------------------------

bool SceneWork::update(std::span<const TetHandle> changed) {
  constexpr std::size_t kFew = 8;  // a share of the slots; beyond, all anew costs less
  if (k_.only_ || changed.size() > mesh_.tet_slots() / kFew) return false;
  if (!k_.is_followed_) follow();
  const bool shrank_all = shrinks_all();
  const std::size_t slots = std::max(mesh_.tet_slots(), k_.shown_.size());
  k_.shown_.resize(slots, 0);
  k_.taken_.resize(slots, 0);
  k_.counted_.resize(slots, 0);
  k_.bad_quality_.resize(slots, kNotBad);
  for (SceneKeeper::Chains& chains : k_.chains_) chains.first.resize(slots, kNone);
  std::vector<std::uint32_t> looks;
  for (const TetHandle t : changed) looks.push_back(t.index());
  sort_out(looks);
  for (const std::uint32_t slot : std::vector(looks)) choose_again(slot, looks);
  if (triangles_.is_shrunk() && shrinks_all() != shrank_all) return false;
  triangles_.shrink_all(shrinks_all());
  add_neighbours(looks);
  if (triangles_.is_shrunk() && !shrinks_all()) add_neighbours(looks);
  for (const std::uint32_t slot : looks) draw_again(slot);
  write_note();
  for (const auto& list : scene_.rewritten) {
    if (list.size() <= scene_.surface.size() + scene_.through.size() + scene_.ghosts.size()) {
      continue;
    }
    scene_.number = next_number();  // to copy all is less
    scene_.rewritten = {};
    break;
  }
  return true;
}

void SceneWork::follow() {
  for (const List list : {kSurface, kThrough, kGhosts}) chain(list);
  k_.taken_order_.clear();
  k_.rest_order_.clear();
  for (std::uint32_t slot = 0; slot < k_.bad_quality_.size(); ++slot) {
    if (k_.bad_quality_[slot] == kNotBad) continue;
    auto& order = k_.taken_[slot] != 0 ? k_.taken_order_ : k_.rest_order_;
    order.emplace(k_.bad_quality_[slot], slot);
  }
  k_.is_followed_ = true;
}

void SceneWork::chain(List list) {
  SceneKeeper::Chains& chains = k_.chains_[list];
  chains.first.assign(k_.shown_.size(), kNone);
  chains.next.assign(tets(list).size(), kNone);
  for (std::uint32_t i = 0; i < tets(list).size(); ++i) {
    const TetHandle t = tets(list)[i];
    if (!t.is_valid()) continue;
    chains.next[i] = chains.first[t.index()];
    chains.first[t.index()] = i;
  }
}

void SceneWork::choose_again(std::uint32_t slot, std::vector<std::uint32_t>& looks) {
  const TetHandle t(slot);
  const bool is_there = slot < mesh_.tet_slots() && filter_.is_chosen(t);
  change_bad(slot, is_there && is_seen_as_bad(t) ? mesh_.quality(t) : kNotBad, looks);
  scene_.tets_shown -= k_.counted_[slot];
  k_.shown_[slot] = is_there && !filter_.is_cut_away(t) ? 1 : 0;
  scene_.tets_shown += counts(slot);
}

void SceneWork::change_bad(std::uint32_t slot, Quality quality, std::vector<std::uint32_t>& looks) {
  const SceneKeeper::Bad before{k_.bad_quality_[slot], slot};
  k_.bad_quality_[slot] = quality;
  if (before.first != kNotBad) {
    --k_.bad_count_;
    k_.taken_[slot] = 0;
    if (k_.taken_order_.erase(before) == 0) k_.rest_order_.erase(before);
  }
  if (quality != kNotBad) {
    ++k_.bad_count_;
    take({quality, slot}, true, looks);
  }
  if (k_.taken_order_.size() > in_.most_bad) take(*k_.taken_order_.rbegin(), false, looks);
  // The last one that is taken is worse than the first one that is not.
  while (!k_.rest_order_.empty() && (k_.taken_order_.size() < in_.most_bad ||
                                     *k_.rest_order_.begin() < *k_.taken_order_.rbegin())) {
    take(*k_.rest_order_.begin(), true, looks);
    if (k_.taken_order_.size() > in_.most_bad) take(*k_.taken_order_.rbegin(), false, looks);
  }
}

void SceneWork::take(const SceneKeeper::Bad& bad, bool take, std::vector<std::uint32_t>& looks) {
  const SceneKeeper::Bad kept = bad;
  (take ? k_.rest_order_ : k_.taken_order_).erase(kept);
  (take ? k_.taken_order_ : k_.rest_order_).insert(kept);
  k_.taken_[kept.second] = take ? 1 : 0;
  looks.push_back(kept.second);
}

void SceneWork::add_neighbours(std::vector<std::uint32_t>& slots) const {
  const std::size_t count = slots.size();
  for (std::size_t i = 0; i < count; ++i) {
    const TetHandle t(slots[i]);
    if (slots[i] >= mesh_.tet_slots() || mesh_.is_deleted(t)) continue;
    for (const HalfFace n : mesh_.neighbours(t)) {
      if (!n.is_outside()) slots.push_back(n.tet().index());
    }
  }
  sort_out(slots);
}

void SceneWork::draw_again(std::uint32_t slot) {
  const TetHandle t(slot);
  std::vector<SurfaceVertex> fresh;
  if (k_.shown_[slot] != 0) triangles_.add_surface(t, fresh);
  replace(kSurface, slot, fresh);
  fresh.clear();
  if (k_.taken_[slot] != 0) triangles_.add_through(t, fresh);
  replace(kThrough, slot, fresh);
  if (settings_.ghosts == 0) return;
  fresh.clear();
  if (slot < mesh_.tet_slots()) triangles_.add_ghosts(t, fresh);
  replace(kGhosts, slot, fresh);
}

void SceneWork::replace(List list, std::uint32_t slot, const std::vector<SurfaceVertex>& fresh) {
  SceneKeeper::Chains& chains = k_.chains_[list];
  std::vector<std::uint32_t> old;
  for (std::uint32_t i = chains.first[slot]; i != kNone; i = chains.next[i]) old.push_back(i);
  std::sort(old.begin(), old.end());
  const std::size_t count = fresh.size() / 3;
  for (std::size_t k = 0; k < count; ++k) {
    if (k < old.size()) {
      write(list, old[k], &fresh[3 * k], slot);
      continue;
    }
    const auto end = static_cast<std::uint32_t>(tets(list).size());
    vertices(list).resize(3 * (std::size_t{end} + 1));
    tets(list).push_back(TetHandle(slot));
    chains.next.push_back(chains.first[slot]);
    chains.first[slot] = end;
    std::copy(&fresh[3 * k], &fresh[3 * k] + 3, &vertices(list)[3 * std::size_t{end}]);
    scene_.rewritten[list].push_back(end);
  }
  for (std::size_t k = old.size(); k-- > count;) drop(list, old[k]);
}

void SceneWork::write(List list, std::uint32_t triangle, const SurfaceVertex* corners,
                      std::uint32_t slot) {
  SurfaceVertex* place = &vertices(list)[3 * std::size_t{triangle}];
  tets(list)[triangle] = TetHandle(slot);
  if (std::memcmp(place, corners, 3 * sizeof(SurfaceVertex)) == 0) return;
  std::copy(corners, corners + 3, place);
  scene_.rewritten[list].push_back(triangle);
}

/// What points to a triangle in the chain of its tet.
std::uint32_t* SceneWork::link_to(List list, std::uint32_t triangle) {
  SceneKeeper::Chains& chains = k_.chains_[list];
  std::uint32_t* link = &chains.first[tets(list)[triangle].index()];
  while (*link != triangle) link = &chains.next[*link];
  return link;
}

void SceneWork::drop(List list, std::uint32_t triangle) {
  SceneKeeper::Chains& chains = k_.chains_[list];
  *link_to(list, triangle) = chains.next[triangle];
  const auto last = static_cast<std::uint32_t>(tets(list).size() - 1);
  if (triangle != last) {
    *link_to(list, last) = triangle;
    chains.next[triangle] = chains.next[last];
    write(list, triangle, &vertices(list)[3 * std::size_t{last}], tets(list)[last].index());
  }
  vertices(list).resize(3 * std::size_t{last});
  tets(list).pop_back();
  chains.next.pop_back();
}

// ---- Public -------------------------------------------------------------------------------------

void SceneKeeper::build(const SceneInput& input) {
  SceneWork(*this, input).build();
}

void SceneKeeper::update(const SceneInput& input, std::span<const TetHandle> changed) {
  if (!SceneWork(*this, input).update(changed)) SceneWork(*this, input).build();
}

Scene build_scene(const SceneInput& input) {
  SceneKeeper keeper;
  keeper.build(input);
  return keeper.scene();
}

}  // namespace tetmend::viewer
