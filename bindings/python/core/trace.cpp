// SPDX-License-Identifier: MIT
// A recorded run.
#include <memory>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <tetmend/trace.h>

#include "bindings/python/core/detached.h"
#include "bindings/python/core/mesh.h"

namespace tetmend::python {

namespace py = pybind11;
using namespace py::literals;

namespace {

void add_range(py::dict& made, const Trace::Range& range) {
  made["events"] = py::make_tuple(range.begin, range.end);
  made["seconds"] = py::make_tuple(range.begin_seconds, range.end_seconds);
}

py::dict dict_of(const Trace::Call& call) {
  py::dict made("operator"_a = call.operator_name, "settings"_a = call.settings,
                "parent"_a = call.parent, "subtree_end"_a = call.subtree_end,
                "level"_a = call.level, "depth"_a = call.depth, "edits"_a = call.edits,
                "target"_a = py::tuple(py::cast(call.target)), "verdict"_a = call.verdict,
                "reason"_a = call.reason, "accepted"_a = call.accepted,
                "for_good"_a = call.for_good, "undone_with"_a = call.undone_with,
                "worst_before"_a = call.worst_before, "worst_after"_a = call.worst_after,
                "missing"_a = call.missing);
  add_range(made, call.events);
  return made;
}

py::dict dict_of(const Trace::Visit& visit) {
  py::dict made("tet"_a = py::tuple(py::cast(visit.tet)), "quality"_a = visit.quality,
                "calls"_a = py::make_tuple(visit.first_call, visit.last_call));
  add_range(made, visit.events);
  return made;
}

py::dict dict_of(const Trace::Pass& pass) {
  py::dict made("name"_a = pass.name, "round"_a = pass.round,
                "calls"_a = py::make_tuple(pass.first_call, pass.last_call),
                "n_bad"_a = pass.after.n_bad, "q_worst"_a = pass.after.q_worst,
                "q_aver"_a = pass.after.q_aver);
  add_range(made, pass.events);
  return made;
}

py::dict dict_of(const Trace::Entry& entry) {
  return py::dict("operator"_a = entry.operator_name, "level"_a = entry.level,
                  "ending"_a = entry.ending, "reason"_a = entry.reason,
                  "refused"_a = entry.is_refusal, "calls"_a = entry.calls, "share"_a = entry.share,
                  "seconds"_a = entry.seconds, "nearest"_a = entry.nearest);
}

py::list ledger_of(const Trace& trace) {
  py::list made;
  for (const Trace::Entry& entry : trace.ledger()) made.append(dict_of(entry));
  return made;
}

std::vector<std::uint32_t> calls_of(const Trace& trace, const std::string& operator_name,
                                    unsigned level, const std::string& ending) {
  Trace::Entry entry;
  entry.operator_name = operator_name;
  entry.level = level;
  entry.ending = ending;
  return trace.calls_of(entry);
}

py::list worse_than(const Trace& trace, const Trace& other) {
  std::vector<Trace::TetPair> pairs;
  run_detached([&] { pairs = trace.worse_than(other); });
  py::list made;
  for (const Trace::TetPair& pair : pairs) {
    made.append(
        py::dict("bad"_a = py::tuple(py::cast(pair.bad)), "bad_quality"_a = pair.bad_quality,
                 "good"_a = py::tuple(py::cast(pair.good)), "good_quality"_a = pair.good_quality));
  }
  return made;
}

py::dict dict_of(const Trace::Event& event) {
  return py::dict("kind"_a = event.kind, "name"_a = event.name, "seconds"_a = event.seconds,
                  "vertices"_a = py::tuple(py::cast(event.vertices)), "verdict"_a = event.verdict,
                  "removed"_a = event.removed, "created"_a = event.created);
}

py::list events_of(const Trace& trace, std::uint64_t first, std::uint64_t last) {
  py::list made;
  for (const Trace::Event& event : trace.events(first, last)) made.append(dict_of(event));
  return made;
}

}  // namespace

void add_trace(py::module_& module) {
  py::class_<Trace>(module, "Trace")
      .def(py::init([](const std::filesystem::path& file) {
             std::unique_ptr<Trace> trace;
             run_detached([&] { trace = std::make_unique<Trace>(file); });
             return trace;
           }),
           "file"_a)
      .def_property_readonly("program", &Trace::program)
      .def_property_readonly("input", &Trace::input)
      .def_property_readonly("schedule", &Trace::schedule)
      .def_property_readonly("measure", &Trace::measure)
      .def_property_readonly("settings", &Trace::settings)
      .def_property_readonly("filter", &Trace::filter)
      .def_property_readonly("damage", &Trace::damage)
      .def_property_readonly("limit_reached", &Trace::limit_reached)
      .def_property_readonly("event_count", &Trace::event_count)
      .def_property_readonly("call_count", &Trace::call_count)
      .def_property_readonly("visit_count", &Trace::visit_count)
      .def_property_readonly("pass_count", &Trace::pass_count)
      .def("call", [](const Trace& trace, std::uint32_t i) { return dict_of(trace.call(i)); })
      .def("visit", [](const Trace& trace, std::size_t i) { return dict_of(trace.visit(i)); })
      .def("pass_", [](const Trace& trace, std::size_t i) { return dict_of(trace.pass(i)); })
      .def("events", &events_of)
      .def("mesh_at",
           [](const Trace& trace, std::uint64_t n) {
             std::shared_ptr<Mesh> mesh;
             run_detached([&] { mesh = std::make_shared<Mesh>(trace.mesh_at(n)); });
             return mesh;
           })
      .def("quality_at",
           [](const Trace& trace, std::uint64_t n) {
             std::vector<float> qualities;
             run_detached([&] { qualities = trace.quality_at(n); });
             return py::array_t<float>(static_cast<py::ssize_t>(qualities.size()),
                                       qualities.data());
           })
      .def("ledger", &ledger_of)
      .def("calls_of", &calls_of)
      .def("worse_than", &worse_than)
      .def("against",
           [](const Trace& trace, const Trace& other) {
             std::string text;
             run_detached([&] { text = trace.against(other); });
             return text;
           })
      .def("history",
           [](const Trace& trace, const std::string& what) {
             std::string text;
             run_detached([&] { text = trace.history(what); });
             return text;
           })
      .def("summary", &Trace::summary)
      .def("tree", &Trace::tree)
      .def("dot", &Trace::dot)
      .def("slices", [](const Trace& trace) {
        std::string text;
        trace.write_slices([&](std::string_view piece) { text += piece; });
        return text;
      });
}

}  // namespace tetmend::python
