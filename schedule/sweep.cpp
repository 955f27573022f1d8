// SPDX-License-Identifier: MIT
#include "schedule/sweep.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <numeric>

#include "kernel/first_failure.h"
#include "kernel/workspace.h"

namespace tetmend {

namespace {

/// How many free slots of each kind the loads before the n-th get; the last is the sum.
struct Shares {
  std::vector<std::size_t> tets = {0};
  std::vector<std::size_t> vertices = {0};
};

/// In proportion to the items. Most operations leave fewer tets than they find, those that add a
/// vertex leave more; what runs out of slots is deferred.
Shares share_slots(std::span<const BlockLoad> loads, double new_vertices) {
  constexpr std::size_t kLeast = 64;
  constexpr double kTetsPerItem = 0.125;
  constexpr double kTetsPerVertex = 2;
  Shares shares;
  for (const BlockLoad& load : loads) {
    const auto items = static_cast<double>(kLeast + load.end - load.begin);
    const double tets = items * (kTetsPerItem + kTetsPerVertex * new_vertices);
    shares.tets.push_back(shares.tets.back() + kLeast + static_cast<std::size_t>(tets));
    shares.vertices.push_back(shares.vertices.back() +
                              static_cast<std::size_t>(new_vertices * items));
  }
  return shares;
}

/// Takes the slots of share `n` out of a pool, of which those from `first` on are shared out.
template <class Handle>
std::vector<Handle> deal(const std::vector<Handle>& pool, std::size_t first,
                         std::span<const std::size_t> shares, std::size_t n) {
  const auto begin = pool.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin + static_cast<std::ptrdiff_t>(shares[n]),
          begin + static_cast<std::ptrdiff_t>(shares[n + 1])};
}

/// Takes free slots from the mesh for each load.
std::vector<Workspace::FreeSlots> deal_slots(Run& run, std::span<const BlockLoad> loads,
                                             double new_vertices) {
  const Shares shares = share_slots(loads, new_vertices);
  Workspace& all = run.worker().workspace();
  all.provide(run.mesh(), shares.tets.back(), shares.vertices.back());
  Workspace::FreeSlots& pool = all.free_slots();
  const std::size_t first_tet = pool.tets.size() - shares.tets.back();
  const std::size_t first_vertex = pool.vertices.size() - shares.vertices.back();
  std::vector<Workspace::FreeSlots> dealt(loads.size());
  for (std::size_t n = 0; n < loads.size(); ++n) {
    dealt[n].tets = deal(pool.tets, first_tet, shares.tets, n);
    dealt[n].vertices = deal(pool.vertices, first_vertex, shares.vertices, n);
  }
  pool.tets.resize(first_tet);
  pool.vertices.resize(first_vertex);
  return dealt;
}

/// What is left of them. When memory runs out, the run does without the rest.
void take_back(Run& run, std::span<const Workspace::FreeSlots> slots) {
  Workspace::FreeSlots& all = run.worker().workspace().free_slots();
  for (const Workspace::FreeSlots& part : slots) {
    all.tets.insert(all.tets.end(), part.tets.begin(), part.tets.end());
    all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
  }
}

std::vector<std::size_t> largest_first(std::span<const BlockLoad> loads) {
  std::vector<std::size_t> order(loads.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
    return loads[x].end - loads[x].begin > loads[y].end - loads[y].begin;
  });
  return order;
}

/// How many tets each load may add, by its share of the items.
std::vector<std::size_t> share_growth(Run& run, std::span<const BlockLoad> loads) {
  const std::size_t most = run.worker().workspace().most_tets();
  std::vector<std::size_t> shares(loads.size(), Workspace::kAnyNumber);
  if (most == Workspace::kAnyNumber) return shares;
  const std::size_t now = run.mesh().tet_count();
  const std::size_t rest = most > now ? most - now : 0;
  std::size_t items = 0;
  for (const BlockLoad& load : loads) items += load.end - load.begin;
  for (std::size_t n = 0; n < loads.size(); ++n) {
    shares[n] = rest * (loads[n].end - loads[n].begin) / items;
  }
  return shares;
}

/// How many attempts each load may make, likewise.
std::vector<std::size_t> share_attempts(const Run& run, std::span<const BlockLoad> loads) {
  constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> shares(loads.size(), kAny);
  // Without a limit, or with one that no product holds.
  if (run.attempts_left() > kAny / std::max<std::size_t>(loads.back().end, 1)) return shares;
  const std::size_t items = loads.back().end - loads.front().begin;
  for (std::size_t n = 0; n < loads.size(); ++n) {
    shares[n] = run.attempts_left() * (loads[n].end - loads[n].begin) / items;
  }
  return shares;
}

/// A worker in the territory of a block while this lives, also when an operator throws.
class Stay {
 public:
  Stay(Worker& worker, const Territory& territory, Workspace::FreeSlots& slots,
       std::size_t more_tets)
      : workspace_(worker.workspace()), slots_(slots) {
    workspace_.enter(territory, slots_, more_tets);
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
  const std::vector<std::size_t> growth = share_growth(run, loads);
  const std::vector<std::size_t> attempts = share_attempts(run, loads);
  const std::vector<std::size_t> order = largest_first(loads);
  std::vector<double> seconds(loads.size(), 0);
  std::vector<Workspace::FreeSlots> slots = deal_slots(run, loads, new_vertices);
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> is_spent = false;
  const auto work_here = [&](Worker& worker) {
    for (std::size_t k = next++; k < loads.size(); k = next++) {
      const std::size_t n = order[k];
      const auto start = std::chrono::steady_clock::now();
      {
        const Stay stay(worker, Territory(partition.blocks(), loads[n].block), slots[n], growth[n]);
        worker.set_most_attempts(attempts[n]);
        work(worker, loads[n]);
        if (worker.is_spent()) is_spent = true;
      }
      seconds[n] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
  };
  FirstFailure failure;  // the mesh is put in order before it goes on
  failure.guard([&] {
    partition.include(run.mesh(), {});  // slots that were just made have a block, too
    run.on_all_threads([&](Worker& worker) {
      try {
        work_here(worker);
      } catch (...) {
        next = loads.size();  // for the others to stop
        throw;
      }
    });
  });
  if (is_spent) run.note_left_off();
  failure.guard([&] { run.collect_from_workers(scope); });
  failure.guard([&] { take_back(run, slots); });
  failure.rethrow();
  scope.note_blocks(seconds);
}

}  // namespace tetmend
