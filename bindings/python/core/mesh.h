// SPDX-License-Identifier: MIT
// The classes Mesh, TetMesh and Trace of the extension, and improving.
#pragma once

#include <pybind11/pybind11.h>

namespace tetmend::python {

void add_mesh(pybind11::module_& module);
void add_improve(pybind11::module_& module);
void add_kernel(pybind11::module_& module);
void add_trace(pybind11::module_& module);
void add_page(pybind11::module_& module);
void add_report(pybind11::module_& module);

}  // namespace tetmend::python
