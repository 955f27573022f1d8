/* SPDX-License-Identifier: MIT */
/* cube_lattice BEFORE AFTER
 *
 * Makes a mesh in memory: N x N x N cubes, each cut into six tets, with inner points out of place,
 * two materials and a temperature at the points. Improves it, takes the arrays back, checks what is
 * promised of them, and prints how many bad tets are left. Both meshes are saved. */
#include <stdio.h>
#include <stdlib.h>

#include <tetmend/tetmend.h>

#define N 8
#define POINTS ((N + 1) * (N + 1) * (N + 1))
#define TETS (6 * N * N * N)

static double xyz[3 * POINTS];
static double temperatures[POINTS];
static int32_t tets[4 * TETS];
static int32_t materials[TETS];
static int32_t map[POINTS];

static int32_t number(int x, int y, int z) {
  return (int32_t)((z * (N + 1) + y) * (N + 1) + x);
}

/* From -0.2 to 0.2, the same on every machine. */
static double jitter(unsigned long* state) {
  *state = (*state * 1103515245UL + 12345UL) % 2147483648UL;
  return 0.4 * (double)(*state / 65536UL) / 32768.0 - 0.2;
}

static void make_points(void) {
  unsigned long state = 1;
  int x, y, z;
  for (z = 0; z <= N; ++z) {
    for (y = 0; y <= N; ++y) {
      for (x = 0; x <= N; ++x) {
        const int32_t i = number(x, y, z);
        const int inner = x > 0 && x < N && y > 0 && y < N && z > 0 && z < N && x != N / 2;
        xyz[3 * i] = x + (inner ? jitter(&state) : 0);
        xyz[3 * i + 1] = y + (inner ? jitter(&state) : 0);
        xyz[3 * i + 2] = z + (inner ? jitter(&state) : 0);
        temperatures[i] = 300 + 2 * xyz[3 * i];
      }
    }
  }
}

/* The six ways from one corner of a cube to the opposite one, an edge at a time. */
static void make_tets(void) {
  static const int ways[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  int x, y, z, way, step;
  int32_t t = 0;
  for (z = 0; z < N; ++z) {
    for (y = 0; y < N; ++y) {
      for (x = 0; x < N; ++x) {
        for (way = 0; way < 6; ++way, ++t) {
          int corner[3];
          corner[0] = x;
          corner[1] = y;
          corner[2] = z;
          tets[4 * t] = number(x, y, z);
          for (step = 0; step < 3; ++step) {
            ++corner[ways[way][step]];
            tets[4 * t + step + 1] = number(corner[0], corner[1], corner[2]);
          }
          materials[t] = x < N / 2 ? 1 : 2;
        }
      }
    }
  }
}

/* Data are linear in the mesh, and points of the surface stay where they were. */
static int check_arrays(tetmend_mesh* mesh) {
  const size_t n = tetmend_count(mesh, TETMEND_POINTS);
  double* now = (double*)malloc(4 * n * sizeof(double));
  double* values = now + 3 * n;
  int good = now != NULL && tetmend_get_points(mesh, now, n) == TETMEND_OK &&
             tetmend_get_data(mesh, TETMEND_POINTS, "temperature", TETMEND_DOUBLE, values, n) ==
                 TETMEND_OK &&
             tetmend_get_vertex_map(mesh, map, POINTS) == TETMEND_OK;
  size_t i;
  for (i = 0; i < n && good; ++i) {
    const double error = values[i] - (300 + 2 * now[3 * i]);
    good = error > -1e-9 && error < 1e-9;
  }
  for (i = 0; i < (size_t)number(0, 0, 1) && good; ++i) {
    good = map[i] >= 0 && now[3 * map[i]] == xyz[3 * i] && now[3 * map[i] + 1] == xyz[3 * i + 1];
  }
  free(now);
  return good;
}

static tetmend_status run(tetmend_mesh* mesh, const char* before, const char* after) {
  tetmend_statistics was, is;
  tetmend_status status = tetmend_set_points(mesh, xyz, POINTS);
  if (status == TETMEND_OK) status = tetmend_set_tets(mesh, tets, TETS, materials);
  if (status == TETMEND_OK) status = tetmend_save(mesh, before);
  if (status == TETMEND_OK) {
    status =
        tetmend_set_data(mesh, TETMEND_POINTS, "temperature", TETMEND_DOUBLE, 1, temperatures);
  }
  if (status == TETMEND_OK) status = tetmend_improve(mesh);
  if (status == TETMEND_OK) status = tetmend_get_statistics(mesh, &was, &is);
  if (status != TETMEND_OK) return status;
  printf("tets      %8lu %8lu\n", (unsigned long)was.tets, (unsigned long)is.tets);
  printf("theta_min %8.4f %8.4f\n", was.theta_min, is.theta_min);
  printf("theta_max %8.4f %8.4f\n", was.theta_max, is.theta_max);
  printf("bad tets  %8lu %8lu\n", (unsigned long)was.n_bad, (unsigned long)is.n_bad);
  if (!check_arrays(mesh)) {
    fprintf(stderr, "cube_lattice: the arrays are not as promised\n");
    return TETMEND_FAILED;
  }
  return tetmend_save(mesh, after);
}

int main(int argc, char** argv) {
  tetmend_mesh* mesh;
  tetmend_status status;
  if (argc != 3) {
    fprintf(stderr, "usage: cube_lattice BEFORE AFTER\n");
    return 2;
  }
  make_points();
  make_tets();
  mesh = tetmend_create();
  if (mesh == NULL) {
    fprintf(stderr, "cube_lattice: out of memory\n");
    return 1;
  }
  status = run(mesh, argv[1], argv[2]);
  if (status != TETMEND_OK) fprintf(stderr, "cube_lattice: %s\n", tetmend_last_error(mesh));
  tetmend_destroy(mesh);
  return status == TETMEND_OK ? 0 : 1;
}
