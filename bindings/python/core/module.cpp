// SPDX-License-Identifier: MIT
// tetmend._core: what the package tetmend is written on. Users see the package.
#include <string>

#include <dlfcn.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <tetmend/catalogue.h>
#include <tetmend/error.h>

#include "bindings/python/core/figures.h"
#include "bindings/python/core/mesh.h"

namespace py = pybind11;
using namespace py::literals;

namespace {

/// Plugins take their code from libtetmend.so. Python loads the extension, and with it the library,
/// for itself alone; this shows the library's names to all that is loaded later.
void show_library_to_plugins() {
  Dl_info library{};
  if (::dladdr(reinterpret_cast<const void*>(&tetmend::version), &library) == 0) return;
  ::dlopen(library.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_GLOBAL);  // stays: never closed
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  using namespace tetmend::python;
  show_library_to_plugins();
  const auto error = py::register_exception<tetmend::Error>(module, "Error", PyExc_ValueError);
  py::register_exception<tetmend::OptionError>(module, "OptionError", error);
  add_mesh(module);
  add_improve(module);
  add_trace(module);
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
