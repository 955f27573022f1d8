// SPDX-License-Identifier: MIT
// Pages of calls, for notebooks.
#include <string>

#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>
#include <tetmend/catalogue.h>

#include "bindings/python/core/detached.h"
#include "bindings/python/core/mesh.h"
#include "explain/call_page.h"

namespace tetmend::python {

namespace py = pybind11;
using namespace py::literals;

void add_page(py::module_& module) {
  module.def(
      "page_of_call",
      [](const std::filesystem::path& file, std::uint32_t call) {
        std::string html;
        run_detached(
            [&] { html = explain::page_of_call(file, call, "tetmend " + std::string(version())); });
        return html;
      },
      "file"_a, "call"_a);
}

}  // namespace tetmend::python
