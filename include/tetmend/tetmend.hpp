// SPDX-License-Identifier: MIT
// The interface for C, <tetmend/tetmend.h>, as a class for C++17: exceptions, vectors, and a handle that frees itself. For
// programs that cannot be compiled as C++20, which the other headers need.
//
//   auto mesh = tetmend::cpp17::Mesh::load("part.mesh");
//   mesh.set("schedule", "thorough").set("goal", "30,150");
//   mesh.improve();
//   mesh.save("better.mesh");
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tetmend/tetmend.h>

namespace tetmend {
namespace cpp17 {

/// One line with the place and the reason.
class Error : public std::runtime_error {
 public:
  Error(tetmend_status status, const char* message)
      : std::runtime_error(message), status_(status) {}
  /// What kind of mistake: an input, an option, a call.
  tetmend_status status() const noexcept { return status_; }

 private:
  tetmend_status status_;
};

/// Numbers in a row that belong to somebody else: a vector, an array, or a pointer and how many.
template <class T>
class View {
 public:
  View() = default;
  View(const T* data, std::size_t size) : data_(data), size_(size) {}
  /// Of a vector or an array, wherever one is wanted.
  template <class Container, class = decltype(std::declval<const Container&>().data())>
  View(const Container& all) : data_(all.data()), size_(all.size()) {}  // NOLINT(*-explicit-*)
  const T* data() const noexcept { return data_; }
  std::size_t size() const noexcept { return size_; }
  /// A vector without elements may have memory all the same.
  const T* or_null() const noexcept { return size_ == 0 ? nullptr : data_; }

 private:
  const T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// A mesh, the options for improving it, and what the last run has found. It can be moved, not
/// copied; one belongs to one thread at a time. Points and tets are numbered from 0. Each function
/// throws Error, or std::bad_alloc when memory runs out; docs of <tetmend/tetmend.h> say more.
class Mesh {
 public:
  Mesh() : handle_(tetmend_create()) {
    if (!handle_) throw std::bad_alloc();
  }
  /// Of a file; the format follows from the extension.
  static Mesh load(const std::string& file) {
    Mesh mesh;
    mesh.check(tetmend_load(mesh.get(), file.c_str()));
    return mesh;
  }
  /// Three coordinates for each point, four points for each tet; labels: one for each tet, or none.
  static Mesh of(View<double> points, View<std::int32_t> tets, View<std::int32_t> labels = {}) {
    Mesh mesh;
    mesh.whole(points.size(), 3, "points");
    mesh.whole(tets.size(), 4, "tets");
    mesh.labelled(labels, tets.size() / 4);
    mesh.check(tetmend_set_points(mesh.get(), points.data(), points.size() / 3));
    mesh.check(tetmend_set_tets(mesh.get(), tets.data(), tets.size() / 4, labels.or_null()));
    return mesh;
  }
  /// Appears when it is complete; a failure leaves an older file as it was.
  void save(const std::string& file) const { check(tetmend_save(get(), file.c_str())); }

  /// An option like `--NAME VALUE` of `tetmend improve`.
  Mesh& set(const std::string& name, const std::string& value) {
    check(tetmend_set(get(), name.c_str(), value.c_str()));
    return *this;
  }
  /// Three points for each triangle, which stays; labels: one for each, or none.
  Mesh& set_triangles(View<std::int32_t> triangles, View<std::int32_t> labels = {}) {
    whole(triangles.size(), 3, "triangles");
    labelled(labels, triangles.size() / 3);
    check(tetmend_set_triangles(get(), triangles.data(), triangles.size() / 3, labels.or_null()));
    return *this;
  }
  /// Points that neither move nor vanish.
  Mesh& set_required(View<std::int32_t> points) {
    check(tetmend_set_required_vertices(get(), points.data(), points.size()));
    return *this;
  }
  /// Numbers that come over to the improved mesh: so many for each point (TETMEND_POINTS) or tet
  /// (TETMEND_TETS), which must be there already.
  Mesh& set_data(tetmend_place place, const std::string& name, View<double> values) {
    const std::size_t count = tetmend_count(get(), place);
    if (count == 0 || values.size() == 0 || values.size() % count != 0) {
      refuse(name + ": " + std::to_string(values.size()) + " numbers for " + std::to_string(count));
    }
    check(tetmend_set_data(get(), place, name.c_str(), TETMEND_DOUBLE, values.size() / count,
                           values.data()));
    return *this;
  }

  /// Called several times a second, by any thread of the run; the run stops if it gives false. What
  /// it throws stops the run as well, and improve() throws it on.
  Mesh& on_progress(std::function<bool(const tetmend_progress&)> function) {
    stand();
    progress_->function = std::move(function);
    check(tetmend_set_progress(get(), progress_->function ? &Progress::call : nullptr,
                               progress_.get()));
    return *this;
  }
  /// Improves the mesh in place. Its surface and all constraints stay bit for bit.
  tetmend_result improve() {
    stand();
    progress_->thrown = nullptr;
    const tetmend_status status = tetmend_improve(get());
    if (progress_->thrown) std::rethrow_exception(std::exchange(progress_->thrown, nullptr));
    check(status);
    tetmend_result result;
    check(tetmend_get_result(get(), &result));
    return result;
  }

  /// How many points, edges, triangles or tets there are.
  std::size_t count(tetmend_place place) const { return tetmend_count(get(), place); }
  /// Three coordinates for each.
  std::vector<double> points() const {
    std::vector<double> xyz(3 * count(TETMEND_POINTS));
    check(tetmend_get_points(get(), xyz.data(), xyz.size() / 3));
    return xyz;
  }
  /// Four points for each.
  std::vector<std::int32_t> tets() const {
    std::vector<std::int32_t> tets(4 * count(TETMEND_TETS));
    check(tetmend_get_tets(get(), tets.data(), nullptr, tets.size() / 4));
    return tets;
  }
  /// One for each tet.
  std::vector<std::int32_t> labels() const {
    std::vector<std::int32_t> tets(4 * count(TETMEND_TETS));
    std::vector<std::int32_t> labels(count(TETMEND_TETS));
    check(tetmend_get_tets(get(), tets.data(), labels.data(), labels.size()));
    return labels;
  }
  /// Three points for each triangle with a name.
  std::vector<std::int32_t> triangles() const {
    std::vector<std::int32_t> triangles(3 * count(TETMEND_TRIANGLES));
    check(tetmend_get_triangles(get(), triangles.data(), nullptr, triangles.size() / 3));
    return triangles;
  }
  /// Numbers for each point or tet, as set_data() or a file gave them in double precision.
  std::vector<double> data(tetmend_place place, const std::string& name) const {
    for (std::size_t i = 0; i < tetmend_data_count(get(), place); ++i) {
      const char* found = nullptr;
      std::size_t components = 0;
      check(tetmend_data_info(get(), place, i, &found, nullptr, &components));
      if (name != found) continue;
      std::vector<double> values(components * count(place));
      check(tetmend_get_data(get(), place, name.c_str(), TETMEND_DOUBLE, values.data(),
                             values.size()));
      return values;
    }
    refuse("there are no data '" + name + "'");
  }

  /// By the old number of a point its new one, -1 if it is gone. `count_before`: how many there were.
  std::vector<std::int32_t> vertex_map(std::size_t count_before) const {
    std::vector<std::int32_t> map(count_before);
    check(tetmend_get_vertex_map(get(), map.data(), map.size()));
    return map;
  }
  /// Figures of the mesh as it is, for a goal of 30 and 150 degrees.
  tetmend_statistics measure() const {
    tetmend_statistics statistics;
    check(tetmend_measure(get(), &statistics));
    return statistics;
  }
  /// Of the mesh before and after the last run.
  std::pair<tetmend_statistics, tetmend_statistics> statistics() const {
    std::pair<tetmend_statistics, tetmend_statistics> both;
    check(tetmend_get_statistics(get(), &both.first, &both.second));
    return both;
  }
  /// What the last call had to say, one sentence each.
  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < tetmend_note_count(get()); ++i) {
      notes.emplace_back(tetmend_note(get(), i));
    }
    return notes;
  }

  /// For functions of <tetmend/tetmend.h> that have no place here.
  tetmend_mesh* get() const noexcept { return handle_.get(); }
  /// Throws for a status other than TETMEND_OK.
  void check(tetmend_status status) const {
    if (status == TETMEND_NO_MEMORY) throw std::bad_alloc();
    if (status != TETMEND_OK) throw Error(status, tetmend_last_error(get()));
  }

 private:
  struct Destroyer {
    void operator()(tetmend_mesh* mesh) const { tetmend_destroy(mesh); }
  };
  /// At one place while the mesh is moved.
  struct Progress {
    std::function<bool(const tetmend_progress&)> function;
    std::exception_ptr thrown;

    static int call(void* user, const tetmend_progress* progress) {
      auto& self = *static_cast<Progress*>(user);
      if (self.thrown) return 1;
      try {
        return self.function(*progress) ? 0 : 1;
      } catch (...) {  // C must not see it
        self.thrown = std::current_exception();
        return 1;
      }
    }
  };

  /// Throws for what was moved from.
  void stand() const { check(get() != nullptr ? TETMEND_OK : TETMEND_WRONG_CALL); }
  [[noreturn]] void refuse(const std::string& message) const {
    throw Error(tetmend_refuse(get(), message.c_str()), message.c_str());
  }
  void whole(std::size_t size, std::size_t width, const char* name) const {
    if (size % width != 0) {
      refuse(std::string(name) + ": " + std::to_string(size) + " numbers are not " +
             std::to_string(width) + " for each");
    }
  }
  void labelled(View<std::int32_t> labels, std::size_t count) const {
    if (labels.size() != 0 && labels.size() != count) {
      refuse("labels: " + std::to_string(labels.size()) + " numbers for " + std::to_string(count));
    }
  }

  std::unique_ptr<tetmend_mesh, Destroyer> handle_;
  std::unique_ptr<Progress> progress_ = std::make_unique<Progress>();
};

}  // namespace cpp17
}  // namespace tetmend
