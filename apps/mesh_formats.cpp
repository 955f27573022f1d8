// SPDX-License-Identifier: MIT
#include "apps/mesh_formats.h"

#include <fmt/format.h>

#include "apps/commands.h"

namespace tetmend::apps {

void check_formats(const std::filesystem::path& input, const std::filesystem::path& output,
                   const CarryOptions& carry, const pieces::ArrayFiles* known) {
  const auto is_known = [&](const std::filesystem::path& file) {
    return known != nullptr && known->is_one(file);
  };
  for (const std::filesystem::path& file : {input, output}) {
    if (!is_known(file)) check_mesh_extension(file);
  }
  if (!is_known(output)) return check_variant(output, carry);
  if (!carry.variant.empty()) {
    throw UsageError(fmt::format("--variant: '{}' is none of {}: there is only one", carry.variant,
                                 output.string()));
  }
  known->check_output(output);
}

}  // namespace tetmend::apps
