// SPDX-License-Identifier: MIT
// A mesh that a solver moves from step to step, and that is mended in between, where it got bad.
//
//   tetmend::Improver session(std::move(mesh), {.threads = 4});
//   while (...) {
//     if (!session.move(points)) ...;  // a tet would turn over: nothing has moved
//     session.improve(20000);          // at most about that many attempts
//     ... session.mesh().tets() ...
//   }
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tetmend/improve.h>

namespace tetmend {

/// What Improver::improve() did.
struct Step {
  Ending ending = Ending::finished;  ///< why it ended; `finished` also where attempts ran out
  std::size_t bad_tets = 0;      ///< those that had got bad, or worse, since they were last tried
  std::size_t attempts = 0;      ///< in all
  std::size_t accepted = 0;      ///< of them
  bool is_complete = true;       ///< false: attempts or time ran out; the next call goes on there
  std::size_t touched_tets = 0;  ///< tets that are new or have a vertex that was moved by this
  QualityIndicators before;      ///< of the mesh as the program moved it
  QualityIndicators after;       ///< of the mesh as it is now
  /// With Options::maps, as in Result: from the mesh before this call to the one after it.
  std::vector<std::uint32_t> vertex_map;
  std::vector<std::uint32_t> tet_map;  ///< likewise
  std::vector<std::string> notes;      ///< of a schedule
};

/// A mesh in a solver's loop. It stays built between the steps, and improve() works only where tets
/// have got bad since they were last tried. The first call tries all bad tets.
///
/// Vertices and tets are numbered as in mesh(): they keep their numbers while improve() finds nothing
/// to change, and its Step says where they went else.
class TETMEND_API Improver {
 public:
  static constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();

  /// Options are those of improve(): goal, measure, purpose, threads, protect, only, layers, keep_size, conserve,
  /// tets (of those at the start), plugin, progress, cancel, and time_limit of each step. Of lengths of
  /// edges they take `size_at`, which is asked anew in each step. Without a `script` or another
  /// schedule than the default each step is a few rounds of reconnection, smoothing, removal and
  /// insertion of points; with `size_at` the schedule "adapt".
  /// @throws OptionError for an option without sense or one that no session has: surface, size, trace,
  /// limit, straighten; Error as improve(), and for a mesh of second order
  explicit Improver(Mesh mesh, Options options = {});
  ~Improver();
  Improver(Improver&& other) noexcept;
  Improver& operator=(Improver&& other) noexcept;

  /// All points go where the program says, those of the surface too. False if a tet with a positive
  /// volume would lose it: then nothing has moved. Make the step in parts.
  /// @param points one for each of mesh(), in its order
  /// @throws Error for another number of points, or one that is not finite
  /// Cost: linear.
  bool move(std::span<const std::array<double, 3>> points);

  /// Vertices that must stay where they are in the calls of improve() to come: asked once for each of
  /// mesh() at the beginning of each. An empty function: none but those of the surface and of constraints.
  /// What the function throws comes out of improve(), and nothing has changed then.
  void hold(std::function<bool(std::uint32_t vertex)> must_stay);

  /// Improves what has got bad. Surface and constraints stay bit for bit. The same calls give the same
  /// mesh, for every number of threads, unless a time limit or `cancel` ends them.
  /// @param attempts after about that many it ends: the tet that is just tried may take a few more
  /// @throws as improve(); the mesh is sound and improved so far then
  /// Cost: linear for what it looks at, besides the attempts.
  Step improve(std::size_t attempts = kAnyNumber);

  /// As it is now, with labels, groups and data, carried over in each step as improve() does. Valid
  /// until the next move() or improve(). Cost: linear, once after each of them.
  const Mesh& mesh() const;
  std::size_t point_count() const;  ///< of mesh(), without making it
  std::size_t tet_count() const;    ///< likewise

 private:
  class Session;
  std::unique_ptr<Session> session_;
};

}  // namespace tetmend
