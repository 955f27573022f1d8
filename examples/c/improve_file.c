/* SPDX-License-Identifier: MIT */
/* improve_file IN OUT [OPTION VALUE]...
 *
 * Improves the mesh of a file, and prints the figures that the command line prints.
 *   improve_file part.mesh better.mesh schedule thorough threads 4 */
#include <stdio.h>

#include <tetmend/tetmend.h>

static void print_count(const char* name, size_t before, size_t after) {
  printf("%-22s %14lu %14lu\n", name, (unsigned long)before, (unsigned long)after);
}

static void print_figure(const char* name, double before, double after) {
  printf("%-22s %14.4f %14.4f\n", name, before, after);
}

static void print_statistics(const tetmend_statistics* before, const tetmend_statistics* after) {
  print_count("tets", before->tets, after->tets);
  print_count("points", before->vertices, after->vertices);
  print_count("boundary triangles", before->boundary_triangles, after->boundary_triangles);
  print_figure("theta_min, degrees", before->theta_min, after->theta_min);
  print_figure("theta_max, degrees", before->theta_max, after->theta_max);
  print_figure("lambda %", before->lambda, after->lambda);
  print_figure("q_worst", before->q_worst, after->q_worst);
  print_count("bad tets", before->n_bad, after->n_bad);
}

/* Anything but 0 stops the run. */
static int show(void* user, const tetmend_progress* progress) {
  size_t* fewest = (size_t*)user;
  if (progress->stage == TETMEND_IMPROVING && progress->n_bad < *fewest) {
    *fewest = progress->n_bad;
  }
  return 0;
}

static tetmend_status run(tetmend_mesh* mesh, int argc, char** argv) {
  tetmend_statistics before, after;
  size_t fewest = (size_t)-1;
  size_t i;
  int k;
  tetmend_status status = TETMEND_OK;
  for (k = 3; k + 1 < argc && status == TETMEND_OK; k += 2) {
    status = tetmend_set(mesh, argv[k], argv[k + 1]);
  }
  if (status == TETMEND_OK) status = tetmend_load(mesh, argv[1]);
  if (status == TETMEND_OK) status = tetmend_set_progress(mesh, show, &fewest);
  if (status == TETMEND_OK) status = tetmend_improve(mesh);
  if (status == TETMEND_OK) status = tetmend_get_statistics(mesh, &before, &after);
  if (status != TETMEND_OK) return status;
  print_statistics(&before, &after);
  for (i = 0; i < tetmend_note_count(mesh); ++i) printf("%s\n", tetmend_note(mesh, i));
  return tetmend_save(mesh, argv[2]);
}

int main(int argc, char** argv) {
  tetmend_mesh* mesh;
  tetmend_status status;
  if (argc < 3 || argc % 2 == 0) {
    fprintf(stderr, "usage: improve_file IN OUT [OPTION VALUE]...\n");
    return 2;
  }
  mesh = tetmend_create();
  if (mesh == NULL) {
    fprintf(stderr, "improve_file: out of memory\n");
    return 1;
  }
  status = run(mesh, argc, argv);
  if (status != TETMEND_OK) fprintf(stderr, "improve_file: %s\n", tetmend_last_error(mesh));
  tetmend_destroy(mesh);
  return status == TETMEND_OK ? 0 : 1;
}
