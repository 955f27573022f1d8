// SPDX-License-Identifier: MIT
#include "viewer/live/program_version.h"

#include <tetmend/catalogue.h>

namespace tetmend::viewer {

std::string_view program_version() {
  return version();
}

}  // namespace tetmend::viewer
