/* SPDX-License-Identifier: MIT */
/* Makes and destroys a thousand handles with a small mesh in each, every 250th of which is improved:
 * for a run that looks for leaks. */
#include <stdio.h>

#include <tetmend/tetmend.h>

static const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
static const int32_t tets[] = {0, 1, 2, 3, 1, 2, 3, 4};

int main(void) {
  int i;
  for (i = 0; i < 1000; ++i) {
    tetmend_mesh* mesh = tetmend_create();
    int32_t wrong = 7;
    int good = mesh != NULL && tetmend_set_points(mesh, xyz, 5) == TETMEND_OK &&
               tetmend_set_tets(mesh, tets, 2, NULL) == TETMEND_OK &&
               tetmend_set_data(mesh, TETMEND_POINTS, "x", TETMEND_DOUBLE, 3, xyz) == TETMEND_OK &&
               tetmend_set_required_vertices(mesh, &wrong, 1) == TETMEND_WRONG_INPUT &&
               tetmend_set(mesh, "threads", "none") == TETMEND_WRONG_OPTION &&
               (i % 250 != 0 || tetmend_improve(mesh) == TETMEND_OK) &&
               tetmend_count(mesh, TETMEND_TETS) == 2;
    if (!good) printf("mesh %d: %s\n", i, tetmend_last_error(mesh));
    tetmend_destroy(mesh);
    if (!good) return 1;
  }
  return 0;
}
