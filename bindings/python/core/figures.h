// SPDX-License-Identifier: MIT
// What runs and measurements find, as dicts with the names of the command line's JSON.
#pragma once

#include <optional>

#include <pybind11/pybind11.h>
#include <tetmend/catalogue.h>
#include <tetmend/check.h>
#include <tetmend/improve.h>
#include <tetmend/measure.h>

namespace tetmend::python {

namespace py = pybind11;

py::dict to_dict(const MeshStatistics& statistics, const std::optional<MeshRulers>& rulers,
                 const std::optional<CurvedStatistics>& curved);
py::dict to_dict(const BuildReport& report);
py::dict to_dict(const SurfaceLimit& limit);
/// All but the maps.
py::dict to_dict(const Result& result);
py::dict to_dict(const Measurement& measurement);
py::dict to_dict(const Fact& fact);
py::dict to_dict(const ScheduleInfo& schedule);
py::dict to_dict(const OperatorDescription& description);

}  // namespace tetmend::python
