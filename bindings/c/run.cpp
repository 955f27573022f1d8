// SPDX-License-Identifier: MIT
// The part of the C interface that works: handles, options, files, improving and what came of it.
#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include <tetmend/catalogue.h>
#include <tetmend/io.h>
#include <tetmend/measure.h>

#include "bindings/c/handle.h"

namespace tetmend::c {

namespace {

void to_c(const MeshRulers& rulers, tetmend_statistics& made) {
  static_assert(kRulerCount == TETMEND_RULERS);
  for (std::size_t i = 0; i < kRulerCount; ++i) {
    const RulerFigures& figures = rulers.figures[i];
    made.rulers[i] = {figures.worst, figures.one_percent, figures.mean};
  }
  made.shortest_edge = rulers.shortest_edge;
  made.faces_above_70 = rulers.faces_above_70;
  made.cg_steps = rulers.cg_steps;
  made.work = rulers.work;
}

tetmend_statistics to_c(const MeshStatistics& statistics, const std::optional<MeshRulers>& rulers) {
  tetmend_statistics made{};
  made.tets = statistics.tets;
  made.vertices = statistics.vertices;
  made.boundary_triangles = statistics.boundary_triangles;
  made.inverted = statistics.inverted;
  made.flat = statistics.flat;
  made.volume = statistics.volume;
  made.theta_min = statistics.theta_min;
  made.theta_max = statistics.theta_max;
  made.lambda = statistics.lambda;
  static_assert(std::tuple_size_v<decltype(statistics.lambda_bands)> == TETMEND_BANDS);
  std::copy(statistics.lambda_bands.begin(), statistics.lambda_bands.end(), made.lambda_bands);
  made.q_worst = statistics.q_worst;
  made.q_mean = statistics.q_mean;
  made.n_bad = statistics.n_bad;
  made.q_aver = statistics.q_aver;
  static_assert(std::tuple_size_v<decltype(statistics.histogram)> == TETMEND_BINS);
  std::copy(statistics.histogram.begin(), statistics.histogram.end(), made.histogram);
  if (rulers) to_c(*rulers, made);
  return made;
}

const Result& result_of(const tetmend_mesh& handle) {
  if (!handle.result) throw WrongCall("this mesh has not been improved");
  return *handle.result;
}

void get_map(const std::vector<std::uint32_t>& map, std::int32_t* numbers, std::size_t n,
             std::int32_t first) {
  need_room(n, map.size());
  need(numbers, "map", !map.empty());
  std::transform(map.begin(), map.end(), numbers, [first](std::uint32_t now) {
    return now == kGone ? first - 1 : static_cast<std::int32_t>(now) + first;
  });
}

/// As the library has it, but an unknown name is also told what only files in C need.
void set_other_option(Options& options, std::string_view name, std::string_view value) {
  try {
    set_option(options, name, value);
  } catch (const OptionError& error) {
    if (!error.option().empty()) throw;
    throw OptionError("", std::string(error.what()) + ", label-array, variant");
  }
}

bool tell(const tetmend_mesh& handle, const Progress& progress) {
  const std::string phase(progress.phase);
  const tetmend_progress made = {static_cast<tetmend_stage>(progress.stage), phase.c_str(),
                                 progress.round, progress.share, progress.now.n_bad};
  return handle.progress(handle.user, &made) == 0;
}

}  // namespace

}  // namespace tetmend::c

using namespace tetmend;
using namespace tetmend::c;

tetmend_mesh* tetmend_create(void) {
  try {
    return std::make_unique<tetmend_mesh>().release();
  } catch (...) {
    return nullptr;
  }
}

void tetmend_destroy(tetmend_mesh* mesh) {
  const std::unique_ptr<tetmend_mesh> last(mesh);
}

const char* tetmend_last_error(const tetmend_mesh* mesh) {
  return mesh == nullptr ? "the handle is null" : mesh->last_error;
}

tetmend_status tetmend_refuse(tetmend_mesh* mesh, const char* message) {
  return guarded(mesh, [&](tetmend_mesh&) {
    need(message, "message");
    throw WrongCall(message);
  });
}

const char* tetmend_version(void) {
  return version().data();
}

tetmend_status tetmend_set(tetmend_mesh* mesh, const char* name, const char* value) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    need(name, "name");
    need(value, "value");
    const std::string_view word = name;
    if (word == "label-array") {
      handle.label_array = value;
    } else if (word == "variant") {
      handle.variant = value;
    } else {
      set_other_option(handle.options, word, value);
    }
  });
}

tetmend_status tetmend_check_options(tetmend_mesh* mesh) {
  return guarded(mesh, [](tetmend_mesh& handle) { check(handle.options); });
}

tetmend_status tetmend_reset_options(tetmend_mesh* mesh) {
  return guarded(mesh, [](tetmend_mesh& handle) {
    handle.options = Options();
    handle.label_array.clear();
    handle.variant.clear();
  });
}

tetmend_status tetmend_set_first_number(tetmend_mesh* mesh, int number) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    if (number != 0 && number != 1) throw WrongCall("the first number is 0 or 1");
    handle.first_number = number;
  });
}

tetmend_status tetmend_load(tetmend_mesh* mesh, const char* file) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    need(file, "file");
    Mesh loaded = load(file, handle.options.threads, handle.label_array);
    std::vector<std::string> notes = loaded.notes();
    handle.mesh = std::move(loaded);
    handle.notes = std::move(notes);
    handle.draft = {};
    handle.is_draft = false;
    handle.is_from_file = true;
    handle.result.reset();
  });
}

tetmend_status tetmend_save(tetmend_mesh* mesh, const char* file) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    need(file, "file");
    const Mesh& settled = settle(handle);
    if (settled.point_count() == 0) {
      throw WrongCall("the mesh is empty: tetmend_load() or tetmend_set_points() comes first");
    }
    std::vector<std::string> notes = not_saved(file, settled, handle.variant);
    save(file, settled, handle.options.threads, handle.variant);
    handle.notes = std::move(notes);
  });
}

tetmend_status tetmend_set_progress(tetmend_mesh* mesh, tetmend_progress_function function,
                                    void* user) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    handle.progress = function;
    handle.user = user;
  });
}

tetmend_status tetmend_improve(tetmend_mesh* mesh) {
  return guarded(mesh, [](tetmend_mesh& handle) {
    Mesh& settled = settle(handle);
    handle.result.reset();
    Options options = handle.options;
    if (handle.progress != nullptr) {
      options.progress = [&handle](const Progress& progress) { return tell(handle, progress); };
    }
    Result result = improve(settled, options);
    std::vector<std::string> notes = result.notes;
    std::vector<std::string> worse = result.worse_than_before();
    handle.result = std::move(result);
    handle.notes = std::move(notes);
    handle.worse = std::move(worse);
  });
}

tetmend_status tetmend_get_vertex_map(tetmend_mesh* mesh, int32_t* map, size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    get_map(result_of(handle).vertex_map, map, n, handle.first_number);
  });
}

tetmend_status tetmend_get_tet_map(tetmend_mesh* mesh, int32_t* map, size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    get_map(result_of(handle).tet_map, map, n, handle.first_number);
  });
}

const char* tetmend_ruler_name(int ruler) {
  if (ruler < 0 || ruler >= TETMEND_RULERS) return nullptr;
  return kRulers[static_cast<std::size_t>(ruler)].name.data();
}

tetmend_status tetmend_measure(tetmend_mesh* mesh, tetmend_statistics* statistics) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    need(statistics, "statistics");
    Measurement measured =
        measure(settle(handle), {.goal = handle.options.goal, .threads = handle.options.threads});
    *statistics = to_c(measured.statistics, measured.rulers);
    handle.notes = std::move(measured.notes);
  });
}

tetmend_status tetmend_get_statistics(tetmend_mesh* mesh, tetmend_statistics* before,
                                      tetmend_statistics* after) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    const Result& result = result_of(handle);
    if (before != nullptr) *before = to_c(result.before, result.rulers_before);
    if (after != nullptr) *after = to_c(result.after, result.rulers_after);
  });
}

tetmend_status tetmend_get_result(tetmend_mesh* mesh, tetmend_result* result) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    need(result, "result");
    const Result& from = result_of(handle);
    tetmend_result made{};
    made.ending = static_cast<tetmend_ending>(from.ending);
    made.goal_min = from.goal.min_angle;
    made.goal_max = from.goal.max_angle;
    made.passes = from.passes.size();
    for (const Pass& pass : from.passes) {
      made.attempts += pass.attempts();
      made.accepted += pass.accepted();
    }
    made.touched_tets = from.touched_tets;
    made.protected_tets = from.protected_tets;
    made.not_positive_before = from.not_positive_before;
    made.not_positive_after = from.not_positive_after;
    made.surface_fingerprint = from.surface_fingerprint;
    made.volume_change = from.volume_change();
    made.building = from.building;
    made.measuring = from.measuring;
    made.improving = from.improving;
    *result = made;
  });
}

size_t tetmend_note_count(const tetmend_mesh* mesh) {
  return mesh == nullptr ? 0 : mesh->notes.size();
}

const char* tetmend_note(const tetmend_mesh* mesh, size_t i) {
  if (mesh == nullptr || i >= mesh->notes.size()) return nullptr;
  return mesh->notes[i].c_str();
}

size_t tetmend_worse_count(const tetmend_mesh* mesh) {
  return mesh == nullptr || !mesh->result ? 0 : mesh->worse.size();
}

const char* tetmend_worse(const tetmend_mesh* mesh, size_t i) {
  return i < tetmend_worse_count(mesh) ? mesh->worse[i].c_str() : nullptr;
}
