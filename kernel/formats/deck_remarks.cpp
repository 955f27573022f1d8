// SPDX-License-Identifier: MIT
// What a deck makes of the mesh in it.
#include "kernel/formats/deck_remarks.h"

#include "kernel/formats/febio.h"
#include "kernel/formats/inp.h"
#include "kernel/formats/inp_deck.h"
#include "kernel/formats/lsdyna.h"
#include "kernel/formats/nastran.h"

namespace tetmend {

std::vector<std::string> deck_remarks(const MeshData& mesh) {
  std::string text;
  if (mesh.variant == formats::kNastran && mesh.deck.size() > formats::nastran_remarks) {
    text = mesh.deck[formats::nastran_remarks];
  } else if (mesh.variant == formats::kInp && formats::is_inp_deck(mesh.deck)) {
    text = formats::unpack_deck(mesh.deck).remarks;
  } else if ((mesh.variant == formats::kLsDyna || mesh.variant == formats::kFebio) &&
             !mesh.deck.empty()) {
    text = mesh.deck[0];
  }
  std::vector<std::string> remarks;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    remarks.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return remarks;
}

}  // namespace tetmend
