// SPDX-License-Identifier: MIT
// tetmend._core: what the package tetmend is written on. Users see the package.
#include <exception>
#include <string>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <tetmend/catalogue.h>
#include <tetmend/error.h>

#include "bindings/python/core/arrays.h"
#include "bindings/python/core/figures.h"
#include "bindings/python/core/mesh.h"
#include "platform/platform.h"

namespace py = pybind11;
using namespace py::literals;

namespace {

/// Plugins take their code from libtetmend.so. Python loads the extension, and with it the library,
/// for itself alone; this shows the library's names to all that is loaded later.
void show_library_to_plugins() {
  tetmend::platform::show_names_of_library(reinterpret_cast<const void*>(&tetmend::version));
}

/// Messages quote names of files and groups, which may be any bytes: the usual translation would fail
/// for those that are no UTF-8.
void translate_errors(py::handle error, py::handle option_error) {
  static py::handle error_type;
  static py::handle option_error_type;
  error_type = error;
  option_error_type = option_error;
  py::register_exception_translator([](std::exception_ptr thrown) {
    const auto raise = [](py::handle type, const std::exception& what) {
      PyErr_SetObject(type.ptr(), tetmend::python::to_text(what.what()).ptr());
    };
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const tetmend::OptionError& failure) {
      raise(option_error_type, failure);
    } catch (const tetmend::Error& failure) {
      raise(error_type, failure);
    }
  });
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  using namespace tetmend::python;
  show_library_to_plugins();
  const auto error = py::register_exception<tetmend::Error>(module, "Error", PyExc_ValueError);
  error.doc() =
      "Something is wrong with an array, a file, a mesh or an option. Its text is one line, with "
      "the "
      "place.";
  const auto option_error =
      py::register_exception<tetmend::OptionError>(module, "OptionError", error);
  option_error.doc() =
      "Something is wrong with an option of `improve()`: its value, or a schedule or plugin that "
      "it "
      "names.";
  translate_errors(error, option_error);
  add_mesh(module);
  add_improve(module);
  add_kernel(module);
  add_trace(module);
  add_page(module);
  add_report(module);
  module.attr("__version__") = std::string(tetmend::version());
  module.def("schedules", [] {
    py::list made;
    for (const tetmend::ScheduleInfo& schedule : tetmend::schedules()) {
      made.append(to_dict(schedule));
    }
    return made;
  });
  module.def(
      "describe_schedule",
      [](const std::string& name) { return to_dict(tetmend::describe_schedule(name)); }, "name"_a);
  module.def("schedule_source", &tetmend::schedule_source, "name"_a);
  module.def(
      "operators",
      [](const std::vector<std::filesystem::path>& plugins) {
        py::list made;
        for (const tetmend::OperatorDescription& each : tetmend::operators(plugins)) {
          made.append(to_dict(each));
        }
        return made;
      },
      "plugins"_a);
}
