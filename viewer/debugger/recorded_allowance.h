// SPDX-License-Identifier: MIT
// How far the run that a trace is of let the surface move.
#pragma once

#include "kernel/error.h"
#include "trace/recorder.h"
#include "trace/surface_setting.h"
#include "viewer/mesh/reference_surface.h"

namespace tetmend::viewer {

/// Nothing where the surface stayed, or where the trace says what no option is: it is for show.
inline Allowance recorded_allowance(const TraceHeader& header) {
  for (const auto& [name, value] : header.settings) {
    if (name != kSurfaceSetting) continue;
    try {
      return Allowance::parse(value);
    } catch (const Error&) {
      return {};
    }
  }
  return {};
}

}  // namespace tetmend::viewer
