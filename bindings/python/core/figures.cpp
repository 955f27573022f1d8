// SPDX-License-Identifier: MIT
#include "bindings/python/core/figures.h"

#include <algorithm>
#include <string>

#include <pybind11/stl.h>

#include "bindings/python/core/arrays.h"

namespace tetmend::python {

using namespace py::literals;

namespace {

using tetmend::python::to_dict;

py::dict to_dict(const MeshRulers& rulers) {
  py::dict made("shortest_edge"_a = rulers.shortest_edge, "inner_faces"_a = rulers.inner_faces,
                "faces_above_70"_a = rulers.faces_above_70, "cg_steps"_a = rulers.cg_steps,
                "work"_a = rulers.work);
  for (std::size_t i = 0; i < kRulerCount; ++i) {
    const RulerFigures& of = rulers.figures[i];
    made[py::str(std::string(kRulers[i].name))] =
        py::dict("worst"_a = of.worst, "one_percent"_a = of.one_percent, "mean"_a = of.mean);
  }
  return made;
}

py::dict to_dict(const CurvedStatistics& curved) {
  return py::dict("mid_nodes"_a = curved.mid_nodes, "curved"_a = curved.curved,
                  "turned_over"_a = curved.turned_over,
                  "worst_jacobian_ratio"_a = curved.worst.at_nodes,
                  "bound_of_jacobian_ratio"_a = curved.worst.bound);
}

py::dict to_dict(const Pass& pass) {
  py::dict verdicts;
  for (std::size_t i = 0; i < kVerdictCount; ++i) {
    std::string name(to_string(static_cast<Verdict>(i)));
    std::replace(name.begin(), name.end(), ' ', '_');
    verdicts[py::str(name)] = pass.verdicts[i];
  }
  return py::dict("name"_a = pass.name, "round"_a = pass.round, "seconds"_a = pass.seconds,
                  "attempts"_a = pass.attempts(), "accepted"_a = pass.accepted(),
                  "verdicts"_a = verdicts, "items"_a = pass.items, "deferred"_a = pass.deferred,
                  "seconds_in_scans"_a = pass.seconds_in_scans,
                  "seconds_in_blocks"_a = pass.seconds_in_blocks, "q_worst"_a = pass.after.q_worst,
                  "n_bad"_a = pass.after.n_bad, "n_needles"_a = pass.after.n_needles,
                  "q_aver"_a = pass.after.q_aver);
}

py::dict to_dict(const CarriedArray& array) {
  return py::dict("name"_a = to_text(array.name), "on"_a = array.on, "rule"_a = array.rule,
                  "integral_error"_a = array.integral_error);
}

py::dict to_dict(const BadTet& bad) {
  return py::dict(
      "tet"_a = bad.tet, "number"_a = bad.number, "label"_a = bad.label, "centre"_a = bad.centre,
      "theta_min"_a = bad.theta_min, "theta_max"_a = bad.theta_max, "quality"_a = bad.quality,
      "free_vertices"_a = bad.free_vertices, "reason"_a = std::string(to_string(bad.hindrance)));
}

const char* ending_name(Ending ending) {
  switch (ending) {
    case Ending::finished:
      return "finished";
    case Ending::time_limit:
      return "time_limit";
    case Ending::cancelled:
      return "cancelled";
  }
  return "";
}

py::dict to_dict(const SizeDrift& drift) {
  return py::dict("one_percent"_a = drift.one_percent, "median"_a = drift.median,
                  "ninety_nine_percent"_a = drift.ninety_nine_percent);
}

py::dict to_dict(const SizeStatistics& sizes) {
  return py::dict("edges"_a = sizes.edges, "bounds"_a = SizeStatistics::kBounds,
                  "histogram"_a = sizes.histogram, "in_range"_a = sizes.in_range,
                  "within_two"_a = sizes.within_two, "shortest"_a = sizes.shortest,
                  "longest"_a = sizes.longest, "off_on_surface"_a = sizes.on_surface,
                  "off_between_walls"_a = sizes.between_walls, "tets_wanted"_a = sizes.tets_wanted);
}

py::dict to_dict(const SurfaceChange& change) {
  py::list regions;
  for (const SurfaceChange::Region& region : change.regions) {
    regions.append(py::dict("label"_a = region.label, "area_before"_a = region.area_before,
                            "area_after"_a = region.area_after,
                            "volume_before"_a = region.volume_before,
                            "volume_after"_a = region.volume_after));
  }
  return py::dict("tolerance"_a = change.tolerance, "proven_distance"_a = change.proven,
                  "sampled_distance"_a = change.sampled,
                  "triangles_before"_a = change.triangles_before,
                  "triangles_after"_a = change.triangles_after,
                  "triangles_touched"_a = change.touched, "regions"_a = regions);
}

template <class T>
py::object to_object(const std::optional<T>& value) {
  if (!value) return py::none();
  return to_dict(*value);
}

template <class T>
py::list to_list(const std::vector<T>& values) {
  py::list made;
  for (const T& value : values) made.append(to_dict(value));
  return made;
}

py::object to_object(const Fact::Number& number) {
  if (const auto* count = std::get_if<std::uint64_t>(&number)) return py::int_(*count);
  if (const auto* value = std::get_if<double>(&number)) return py::float_(*value);
  return py::none();
}

template <class Parameter>
py::dict to_dict_of_numbers(const Parameter& parameter) {
  using Kind = typename Parameter::Kind;
  py::dict made("name"_a = parameter.name, "help"_a = parameter.help);
  const auto number = [&](double value) -> py::object {
    if (parameter.kind == Kind::flag) return py::bool_(value != 0);
    if (parameter.kind == Kind::integer) return py::int_(static_cast<std::int64_t>(value));
    return py::float_(value);
  };
  made["default"] = number(parameter.initial);
  if (parameter.kind != Kind::flag) {
    made["low"] = number(parameter.low);
    made["high"] = number(parameter.high);
  }
  return made;
}

}  // namespace

py::dict to_dict(const MeshStatistics& s, const std::optional<MeshRulers>& rulers,
                 const std::optional<CurvedStatistics>& curved) {
  return py::dict("tets"_a = s.tets, "vertices"_a = s.vertices,
                  "boundary_triangles"_a = s.boundary_triangles, "inverted"_a = s.inverted,
                  "flat"_a = s.flat, "volume"_a = s.volume, "theta_min"_a = s.theta_min,
                  "theta_max"_a = s.theta_max, "lambda"_a = s.lambda,
                  "lambda_bands"_a = s.lambda_bands, "q_worst"_a = s.q_worst, "q_mean"_a = s.q_mean,
                  "n_bad"_a = s.n_bad, "q_aver"_a = s.q_aver, "histogram"_a = s.histogram,
                  "rulers"_a = to_object(rulers), "second_order"_a = to_object(curved));
}

py::dict to_dict(const BuildReport& report) {
  return py::dict(
      "mirrored"_a = report.mirrored, "reordered_tets"_a = report.reordered_tets,
      "inverted_tets"_a = report.inverted_tets, "flat_tets"_a = report.flat_tets,
      "loose_triangles"_a = report.loose_triangles, "loose_edges"_a = report.loose_edges,
      "unused_points"_a = report.unused_points, "constrained_faces"_a = report.constrained_faces,
      "dropped_triangles"_a = report.dropped_triangles, "dropped_edges"_a = report.dropped_edges,
      "dropped_vertices"_a = report.dropped_vertices);
}

py::dict to_dict(const SurfaceLimit& limit) {
  py::dict bad;
  for (std::size_t i = 0; i < kHindranceCount; ++i) {
    bad[py::str(std::string(to_string(static_cast<Hindrance>(i))))] = limit.bad[i];
  }
  return py::dict("n_forced"_a = limit.n_forced, "n_bad"_a = limit.n_bad,
                  "q_worst"_a = limit.q_worst, "theta_min"_a = limit.theta_min,
                  "theta_max"_a = limit.theta_max, "bad"_a = bad);
}

py::dict to_dict(const Result& result) {
  return py::dict(
      "goal"_a = py::make_tuple(result.goal.min_angle, result.goal.max_angle),
      "before"_a = to_dict(result.before, result.rulers_before, result.curved_before),
      "after"_a = to_dict(result.after, result.rulers_after, result.curved_after),
      "sizes_before"_a = to_object(result.sizes_before),
      "sizes_after"_a = to_object(result.sizes_after),
      "size_drift"_a = to_object(result.size_drift), "ending"_a = ending_name(result.ending),
      "passes"_a = to_list(result.passes), "notes"_a = to_texts(result.notes),
      "data"_a = to_list(result.carried), "build"_a = to_dict(result.build),
      "protected"_a =
          py::dict("tets"_a = result.protected_tets, "bad_tets"_a = result.protected_bad_tets),
      "layers"_a = py::dict("tets"_a = result.layer_tets, "bad_tets"_a = result.layer_bad_tets),
      "curved_edges"_a = result.curved_edges, "straightened_edges"_a = result.straightened_edges,
      "touched_tets"_a = result.touched_tets, "limit"_a = to_object(result.limit),
      "worse_than_before"_a = result.worse_than_before(), "missed_aims"_a = result.missed_aims(),
      "surface_fingerprint"_a = result.surface_fingerprint,
      "surface_fingerprint_before"_a = result.surface_fingerprint_before,
      "surface_change"_a = to_object(result.surface_change),
      "not_positive_tets"_a =
          py::dict("before"_a = result.not_positive_before, "after"_a = result.not_positive_after),
      "volume_change"_a = result.volume_change(),
      "seconds"_a = py::dict("building"_a = result.building, "measuring"_a = result.measuring,
                             "improving"_a = result.improving, "carrying"_a = result.carrying));
}

py::dict to_dict(const Measurement& measurement) {
  py::dict measures;
  for (const MeasureSummary& each : measurement.measures) {
    measures[py::str(std::string(each.name))] =
        py::dict("worst"_a = each.worst, "mean"_a = each.mean);
  }
  return py::dict(
      "statistics"_a = to_dict(measurement.statistics, measurement.rulers, measurement.curved),
      "build"_a = to_dict(measurement.build), "measures"_a = measures,
      "limit"_a = to_object(measurement.limit), "bad_tets"_a = to_list(measurement.bad_tets),
      "notes"_a = to_texts(measurement.notes));
}

py::dict to_dict(const Fact& fact) {
  return py::dict("name"_a = fact.name, "holds"_a = fact.holds, "text"_a = to_text(fact.text),
                  "value"_a = to_object(fact.value), "wanted"_a = to_object(fact.wanted));
}

py::dict to_dict(const ScheduleInfo& schedule) {
  py::list parameters;
  for (const ScheduleParameter& parameter : schedule.parameters) {
    if (parameter.kind == ScheduleParameter::Kind::choice) {
      parameters.append(py::dict("name"_a = parameter.name, "help"_a = parameter.help,
                                 "default"_a = parameter.choices.front(),
                                 "choices"_a = parameter.choices));
    } else {
      parameters.append(to_dict_of_numbers(parameter));
    }
  }
  return py::dict("name"_a = schedule.name, "description"_a = schedule.description,
                  "parameters"_a = parameters);
}

py::dict to_dict(const OperatorDescription& description) {
  py::list parameters;
  for (const auto& parameter : description.parameters) {
    parameters.append(to_dict_of_numbers(parameter));
  }
  return py::dict("name"_a = description.name, "target"_a = description.target,
                  "help"_a = description.help, "plugin"_a = description.plugin.string(),
                  "parameters"_a = parameters);
}

}  // namespace tetmend::python
