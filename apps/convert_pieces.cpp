// SPDX-License-Identifier: MIT
#include "apps/convert_pieces.h"

#include <cstdint>
#include <string>
#include <vector>

#include "apps/mesh_formats.h"
#include "pieces/improve.h"
#include "pieces/mesh_files.h"
#include "pieces/mesh_output.h"

namespace tetmend::apps {

void convert_pieces(const std::filesystem::path& input, const std::filesystem::path& output,
                    const CarryOptions& carry, const pieces::ArrayFiles* known, std::size_t parts,
                    Ranks& ranks) {
  if (ranks.is_first()) {
    check_formats(input, output, carry, known);
    const NamedFile from = {"IN", input, NamedFile::Kind::mesh};
    const NamedFile to = {"OUT", output, NamedFile::Kind::mesh};
    prepare_files({&from, 1}, {&to, 1}, known);
  }
  pieces::InputMesh mesh(input, ranks, known, carry.label_array);
  if (ranks.is_first()) {
    std::vector<std::string> notes;
    tell_lost(input, mesh.lost_in(output), carry, notes);
  }
  pieces::MemoryShelf shelf;
  pieces::DividedMesh slices(shelf, ranks, mesh.vertices());
  const std::uint64_t vertices = mesh.vertices();
  const std::uint64_t tets = mesh.tets();
  const bool holds_more = mesh.holds_more(output);
  mesh.add_to(slices, ranks.count());
  pieces::write_pieces(output, slices,
                       {.vertices = vertices,
                        .array_files = known,
                        .parts = parts > 0 ? parts : pieces::usual_pieces(tets),
                        .variant = carry.variant,
                        .source = holds_more ? input : std::filesystem::path(),
                        .label_array = carry.label_array,
                        .shelf = &shelf,
                        .pieces = ranks.count()});
}

}  // namespace tetmend::apps
