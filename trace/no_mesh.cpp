// SPDX-License-Identifier: MIT
#include "trace/no_mesh.h"

#include <array>
#include <fstream>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"

namespace tetmend {

bool is_trace(const std::filesystem::path& file) {
  constexpr std::string_view kMagic = "TETTRAC\n";
  std::array<char, kMagic.size()> begin{};
  std::ifstream in(file, std::ios::binary);
  return in.read(begin.data(), begin.size()) &&
         std::string_view(begin.data(), begin.size()) == kMagic;
}

void refuse_what_is_no_mesh(const std::filesystem::path& file) {
  if (!format_name(file).empty()) return;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    if (!error) error = std::make_error_code(std::errc::no_such_file_or_directory);
    throw Error(fmt::format("{}: cannot be read: {}", file.string(), error.message()));
  }
  if (is_trace(file)) {
    throw Error(
        fmt::format("{}: this is the trace of a run, not a mesh: see 'tetmend trace' and "
                    "tetmend-view",
                    file.string()));
  }
}

}  // namespace tetmend
