// SPDX-License-Identifier: MIT
#include <string>

#include <tetmend/petsc.h>

#include "bindings/petsc/exchange.h"
#include "bindings/petsc/plex_arrays.h"
#include "mpi/mpi_ranks.h"

namespace tetmend::petsc {

Result improve(DM from, DM* better, const Options& options, const Pieces& pieces,
               const Labels& labels) {
  if (from == nullptr || better == nullptr) throw Error("DM: there is none");
  if (!options.surface.empty() && options.surface != "fixed") {
    throw OptionError("surface", "surface: that of a DMPlex must stay fixed");
  }
  MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(from));
  mpi::MpiRanks ranks(comm);
  PlexArrays arrays = read_plex(from, labels, ranks);
  Result result = tetmend::improve(arrays.mesh, ranks, options, pieces);
  for (const std::string& what : arrays.left_behind) {
    result.notes.push_back("not carried to the new DMPlex: " + what);
  }
  *better = make_plex(comm, arrays, ranks);
  return result;
}

}  // namespace tetmend::petsc
