// SPDX-License-Identifier: MIT
// Improves any mesh of tets that PETSc reads or makes, on any number of processes.
//
//   mpirun -n 2 improve_plex -dm_plex_filename part.msh -better_dm_view hdf5:better.h5
#include <cstdio>
#include <exception>

#include <petscdmplex.h>
#include <tetmend/petsc.h>

namespace {

/// In the way of PETSc: a status, and what the caller gets at the end.
PetscErrorCode improve(DM dm, DM* better) {
  PetscFunctionBeginUser;
  try {
    const tetmend::Result result = tetmend::petsc::improve(dm, better, {.goal = {35, 140}});
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                          "tets %zu to %zu, bad %zu to %zu, angles from %g to %g\n",
                          result.before.tets, result.after.tets, result.before.n_bad,
                          result.after.n_bad, result.before.theta_min, result.after.theta_min));
    for (const std::string& note : result.notes) {
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n", note.c_str()));
    }
  } catch (const std::exception& error) {  // memory may have run out on one process alone
    SETERRQ(PETSC_COMM_SELF, PETSC_ERR_LIB, "%s", error.what());
  }
  PetscFunctionReturn(0);
}

PetscErrorCode run() {
  DM dm = nullptr;
  DM better = nullptr;
  PetscFunctionBeginUser;
  PetscCall(DMCreate(PETSC_COMM_WORLD, &dm));
  PetscCall(DMSetType(dm, DMPLEX));
  PetscCall(DMSetFromOptions(dm));  // reads or makes the mesh, and distributes it
  PetscCall(improve(dm, &better));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscObjectSetOptionsPrefix(reinterpret_cast<PetscObject>(better), "better_"));
  PetscCall(DMViewFromOptions(better, nullptr, "-dm_view"));
  PetscCall(DMDestroy(&better));
  PetscFunctionReturn(0);
}

}  // namespace

int main(int argc, char** argv) {
  PetscCall(PetscInitialize(&argc, &argv, nullptr, nullptr));
  PetscCallAbort(PETSC_COMM_WORLD, run());  // ends all processes
  return PetscFinalize();
}
