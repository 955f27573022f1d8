// SPDX-License-Identifier: MIT
#include "apps/convert_pieces.h"

#include <cstdint>
#include <string>
#include <vector>

#include "pieces/mesh_files.h"

namespace tetmend::apps {

void convert_pieces(const std::filesystem::path& input, const std::filesystem::path& output,
                    const CarryOptions& carry, const pieces::ArrayFiles* known, Ranks& ranks) {
  const auto is_known = [&](const std::filesystem::path& file) {
    return known != nullptr && known->is_one(file);
  };
  if (ranks.is_first()) {
    for (const std::filesystem::path& file : {input, output}) {
      if (!is_known(file)) check_mesh_extension(file);
    }
    if (!is_known(output)) check_variant(output, carry);
    const NamedFile from = {"IN", input};
    const NamedFile to = {"OUT", output};
    prepare_files({&from, 1}, {&to, 1});
  }
  pieces::InputMesh mesh(input, ranks, known, carry.label_array);
  if (ranks.is_first()) {
    std::vector<std::string> notes;
    tell_lost(input, mesh.lost_in(output), carry, notes);
  }
  pieces::MemoryShelf shelf;
  pieces::DividedMesh slices(shelf, ranks, mesh.vertices());
  const std::uint64_t vertices = mesh.vertices();
  const bool holds_more = mesh.holds_more();
  mesh.add_to(slices, ranks.count());
  pieces::write_pieces(output, slices,
                       {.vertices = vertices,
                        .array_files = known,
                        .variant = carry.variant,
                        .source = holds_more ? input : std::filesystem::path(),
                        .label_array = carry.label_array});
}

}  // namespace tetmend::apps
