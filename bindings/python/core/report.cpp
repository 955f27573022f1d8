// SPDX-License-Identifier: MIT
// A report as charts, for notebooks.
#include <string>

#include <nlohmann/json.hpp>
#include <pybind11/pybind11.h>

#include "bindings/python/core/mesh.h"
#include "report/fragment.h"

namespace tetmend::python {

namespace py = pybind11;
using namespace py::literals;

void add_report(py::module_& module) {
  module.def(
      "charts",
      [](const std::string& report) {
        return report::write_fragment(nlohmann::json::parse(report));
      },
      "report"_a);
}

}  // namespace tetmend::python
