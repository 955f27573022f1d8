// SPDX-License-Identifier: MIT
#include "schedule/sweep.h"

#include <exception>

namespace tetmend {

namespace {

/// The part of `slots` from `begin` to `end`.
template <class Handle>
std::vector<Handle> deal(const std::vector<Handle>& slots, std::size_t begin, std::size_t end) {
  return {slots.begin() + static_cast<std::ptrdiff_t>(begin),
          slots.begin() + static_cast<std::ptrdiff_t>(end)};
}

/// Takes free slots from the mesh for each load, in proportion to its items.
std::vector<Workspace::FreeSlots> deal_slots(Run& run, std::span<const BlockLoad> loads,
                                             double new_vertices) {
  // Most operations leave fewer tets than they find; what runs out of slots is deferred.
  constexpr std::size_t kLeast = 64;
  std::size_t tets = 0;
  for (const BlockLoad& load : loads) tets += kLeast + load.end - load.begin;
  const auto vertices_for = [&](std::size_t items) {
    return static_cast<std::size_t>(new_vertices * static_cast<double>(items));
  };
  Workspace& all = run.worker().workspace();
  all.provide(run.mesh(), tets, vertices_for(tets));
  Workspace::FreeSlots& pool = all.free_slots();
  const std::size_t first_tet = pool.tets.size() - tets;
  const std::size_t first_vertex = pool.vertices.size() - vertices_for(tets);

  std::vector<Workspace::FreeSlots> dealt(loads.size());
  std::size_t done = 0;
  for (std::size_t n = 0; n < loads.size(); ++n) {
    const std::size_t next = done + kLeast + loads[n].end - loads[n].begin;
    dealt[n].tets = deal(pool.tets, first_tet + done, first_tet + next);
    dealt[n].vertices =
        deal(pool.vertices, first_vertex + vertices_for(done), first_vertex + vertices_for(next));
    done = next;
  }
  pool.tets.resize(first_tet);
  pool.vertices.resize(first_vertex);
  return dealt;
}

/// A worker in the territory of a block while this lives, also when an operator throws.
class Stay {
 public:
  Stay(Worker& worker, const Territory& territory, Workspace::FreeSlots& slots)
      : workspace_(worker.workspace()), slots_(slots) {
    workspace_.enter(territory, slots_);
  }
  ~Stay() { workspace_.leave(slots_); }
  Stay(const Stay&) = delete;
  Stay& operator=(const Stay&) = delete;

 private:
  Workspace& workspace_;
  Workspace::FreeSlots& slots_;
};

}  // namespace

void run_blocks(Run& run, PassScope& scope, Partition& partition, std::span<const BlockLoad> loads,
                double new_vertices, const std::function<void(Worker&, const BlockLoad&)>& work) {
  if (loads.empty()) return;
  std::vector<Workspace::FreeSlots> slots = deal_slots(run, loads, new_vertices);
  partition.include(run.mesh(), {});  // slots that were just made have a block, too
  std::vector<double> seconds(loads.size(), 0);
  std::vector<std::size_t> largest_first(loads.size());
  for (std::size_t n = 0; n < loads.size(); ++n) largest_first[n] = n;
  std::stable_sort(largest_first.begin(), largest_first.end(), [&](std::size_t x, std::size_t y) {
    return loads[x].end - loads[x].begin > loads[y].end - loads[y].begin;
  });
  std::atomic<std::size_t> next = 0;
  const auto work_here = [&](Worker& worker) {
    for (std::size_t k = next++; k < loads.size(); k = next++) {
      const std::size_t n = largest_first[k];
      const auto start = std::chrono::steady_clock::now();
      {
        const Stay stay(worker, Territory(partition.blocks(), loads[n].block), slots[n]);
        work(worker, loads[n]);
      }
      seconds[n] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
  };
  std::exception_ptr failure;  // the mesh is put in order before it goes on
  try {
    run.on_all_threads(work_here);
  } catch (...) {
    failure = std::current_exception();
  }
  Workspace::FreeSlots& all = run.worker().workspace().free_slots();
  for (const Workspace::FreeSlots& part : slots) {
    all.tets.insert(all.tets.end(), part.tets.begin(), part.tets.end());
    all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
  }
  run.collect_from_workers(scope);
  scope.note_blocks(seconds);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace tetmend
