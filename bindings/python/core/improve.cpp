// SPDX-License-Identifier: MIT
// Improving, measuring and checking.
#include <atomic>
#include <optional>
#include <utility>

#include <pybind11/stl.h>
#include <tetmend/check.h>
#include <tetmend/improve.h>
#include <tetmend/measure.h>
#include <tetmend/option_text.h>

#include "bindings/python/core/arrays.h"
#include "bindings/python/core/detached.h"
#include "bindings/python/core/figures.h"
#include "bindings/python/core/mesh.h"

namespace tetmend::python {

using namespace py::literals;

namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;  ///< as on the command line

const char* stage_name(Stage stage) {
  switch (stage) {
    case Stage::building:
      return "building";
    case Stage::measuring:
      return "measuring";
    case Stage::improving:
      return "improving";
  }
  return "";
}

/// What a progress function gets: a copy, for it may be kept.
struct Moment {
  const char* stage = "";
  std::string phase;
  unsigned round = 0;
  double share = 0;
  QualityIndicators now;
};

/// Functions of Python that a run calls, from any of its threads. What one of them raises stops the
/// run.
class Callbacks {
 public:
  Callbacks(py::object progress, py::object note, py::object size_at, std::atomic<bool>& cancel)
      : progress_(std::move(progress)),
        note_(std::move(note)),
        size_at_(std::move(size_at)),
        cancel_(cancel) {}

  void add_to(Options& options) {
    if (!progress_.is_none()) {
      options.progress = [this](const Progress& progress) { return tell(progress); };
    }
    if (!note_.is_none()) {
      options.note = [this](std::string_view text) {
        const py::gil_scoped_acquire interpreter;
        guarded([&] { note_(python::to_text(text)); });
      };
    }
    if (!size_at_.is_none()) {
      options.size_at = [this](double x, double y, double z) { return ask_size(x, y, z); };
    }
  }

  void raise_if_failed() {
    if (failure_) throw std::move(*failure_);
  }

 private:
  template <class Call>
  void guarded(const Call& call) {
    if (failure_) return;
    try {
      call();
    } catch (py::error_already_set& error) {
      failure_.emplace(std::move(error));
      cancel_ = true;
    }
  }

  bool tell(const Progress& progress) {
    const py::gil_scoped_acquire interpreter;
    bool goes_on = true;
    guarded([&] {
      const py::object answer =
          progress_(Moment{stage_name(progress.stage), std::string(progress.phase), progress.round,
                           progress.share, progress.now});
      goes_on = answer.is_none() || PyObject_IsTrue(answer.ptr()) != 0;
      if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    });
    return goes_on && !failure_;
  }

  /// @throws Error where it failed: no other length would do
  double ask_size(double x, double y, double z) {
    const py::gil_scoped_acquire interpreter;
    double length = 0;
    guarded([&] {
      const py::object answer = size_at_(x, y, z);
      length = PyFloat_AsDouble(answer.ptr());
      if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    });
    if (failure_) throw Error("a function of Python has failed");
    return length;
  }

  py::object progress_;
  py::object note_;
  py::object size_at_;
  std::atomic<bool>& cancel_;
  std::optional<py::error_already_set> failure_;
};

Options to_options(const Settings& settings) {
  Options options;
  for (const auto& [name, value] : settings) set_option(options, name, value);
  return options;
}

/// Improves the mesh itself; nobody may have looked at its arrays.
/// @returns (figures, vertex_map, tet_map)
py::tuple improve_in_place(Mesh& mesh, const Settings& settings, bool rulers, bool maps,
                           const py::object& progress, const py::object& note,
                           const py::object& size_at) {
  std::atomic<bool> cancel = false;
  Options options = to_options(settings);
  options.rulers = rulers;
  options.maps = maps;
  options.cancel = &cancel;
  Callbacks callbacks(progress, note, size_at, cancel);
  callbacks.add_to(options);
  Result result;
  try {
    run_detached([&] { result = improve(mesh, options); }, cancel);
  } catch (const Error&) {
    callbacks.raise_if_failed();  // which is why
    throw;
  }
  callbacks.raise_if_failed();
  const py::dict figures = to_dict(result);
  return py::make_tuple(figures, to_array(std::move(result.vertex_map)),
                        to_array(std::move(result.tet_map)));
}

py::dict measure_mesh(const Mesh& mesh, const std::vector<std::string>& measures, bool rulers,
                      bool limit, bool bad_tets, const Settings& settings, int threads) {
  const Goal goal = to_options(settings).goal;
  Measurement measured;
  run_detached([&] {
    measured = measure(mesh, {.measure = measures,
                              .goal = goal,
                              .rulers = rulers,
                              .limit = limit,
                              .bad_tets = bad_tets,
                              .threads = threads});
  });
  return to_dict(measured);
}

py::list check_mesh(const Mesh& mesh, const Mesh* improved, const CheckOptions& options) {
  std::vector<Fact> facts;
  run_detached([&] {
    if (improved != nullptr) {
      facts =
          compare(mesh, *improved, options.threads, options.preset, options.goal, options.surface);
    }
    if (!options.asks()) return;
    for (Fact& fact : check(improved != nullptr ? *improved : mesh, options)) {
      facts.push_back(std::move(fact));
    }
  });
  py::list made;
  for (const Fact& fact : facts) made.append(to_dict(fact));
  return made;
}

void add_progress(py::module_& module) {
  py::class_<Moment>(module, "Progress",
                     "How far a run has come: what a progress function is called with.")
      .def_readonly("stage", &Moment::stage, "'building', 'measuring' or 'improving'.")
      .def_readonly("phase", &Moment::phase, "Name of the pass, while improving.")
      .def_readonly("round", &Moment::round, "Of the schedule; 0 before its main loop.")
      .def_readonly("share", &Moment::share, "Of the phase that is done, 0 to 1.")
      .def_property_readonly(
          "n_bad", [](const Moment& moment) { return moment.now.n_bad; },
          "Bad tets after the pass before.")
      .def_property_readonly(
          "q_worst", [](const Moment& moment) { return moment.now.q_worst; },
          "Worst quality after the pass before; 1: the goal is just met.")
      .def("__repr__", [](const Moment& moment) {
        return "Progress(stage='" + std::string(moment.stage) + "', phase='" + moment.phase +
               "', round=" + std::to_string(moment.round) +
               ", n_bad=" + std::to_string(moment.now.n_bad) + ")";
      });
}

}  // namespace

void add_improve(py::module_& module) {
  add_progress(module);
  module.def("improve_in_place", &improve_in_place, "mesh"_a, "settings"_a, "rulers"_a, "maps"_a,
             "progress"_a, "note"_a, "size_at"_a);
  module.def(
      "check_options", [](const Settings& settings) { check(to_options(settings)); }, "settings"_a);
  module.def("option_forms", [] {
    std::vector<std::tuple<std::string, std::string, bool, std::string>> made;
    for (const OptionForm& form : option_forms()) {
      made.emplace_back(form.name, form.value, form.adds, form.needs);
    }
    return made;
  });
  module.def("measure", &measure_mesh, "mesh"_a, "measures"_a, "rulers"_a, "limit"_a, "bad_tets"_a,
             "settings"_a, "threads"_a);
  module.def("measures", [] {
    std::vector<std::pair<std::string, std::string>> made;
    for (const Measure& each : measures()) made.emplace_back(each.name, each.help);
    return made;
  });
  module.def(
      "check",
      [](const Mesh& mesh, const Mesh* improved, double min_dihedral, double max_dihedral,
         bool no_inverted, const std::vector<std::pair<std::string, double>>& measure,
         const std::string& preset, int threads, const Settings& settings) {
        const Options run = to_options(settings);
        return check_mesh(mesh, improved,
                          {min_dihedral, max_dihedral, no_inverted, measure, preset, threads,
                           run.goal, run.surface});
      },
      "mesh"_a, "improved"_a.none(true), "min_dihedral"_a, "max_dihedral"_a, "no_inverted"_a,
      "measure"_a, "preset"_a, "threads"_a, "settings"_a);
  module.def("check_presets", [] {
    std::vector<std::pair<std::string, std::string>> made;
    for (const CheckPreset& each : check_presets()) made.emplace_back(each.name, each.source);
    return made;
  });
}

}  // namespace tetmend::python
