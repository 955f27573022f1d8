/* SPDX-License-Identifier: MIT */
/* tetmend for C, and for all languages that can call C.
 *
 *   tetmend_mesh* mesh = tetmend_create();
 *   tetmend_load(mesh, "part.mesh");
 *   tetmend_set(mesh, "schedule", "thorough");
 *   if (tetmend_improve(mesh) != TETMEND_OK) puts(tetmend_last_error(mesh));
 *   tetmend_save(mesh, "better.mesh");
 *   tetmend_destroy(mesh);
 *
 * Nothing here prints, ends the program or throws. What a call gets is copied; what it gives out
 * goes into memory of the caller. A text that is given out stays until the next call with the same
 * handle. Two threads may work on two handles at the same time; one handle belongs to one thread at
 * a time.
 *
 * Flags, traps and rounding of the caller's floating-point arithmetic have no effect on a call, and
 * are what they were after it.
 *
 * Every function of type tetmend_status may be given a null handle, and says TETMEND_WRONG_CALL. */
#ifndef TETMEND_TETMEND_H
#define TETMEND_TETMEND_H

#include <stddef.h>
#include <stdint.h>
#include <tetmend/api.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Handles and errors ---- */

/* A mesh, the options for improving it, and what the last run has found. */
typedef struct tetmend_mesh tetmend_mesh;

typedef enum tetmend_status {
  TETMEND_OK = 0,
  TETMEND_WRONG_INPUT = 1,  /* a file, an array, a script or the topology of the mesh */
  TETMEND_WRONG_OPTION = 2, /* its name or its value */
  TETMEND_WRONG_CALL = 3,   /* a null pointer, too little room, or what is not there */
  TETMEND_NO_MEMORY = 4,    /* memory ran out; the mesh is sound: as before, improved so far, or
                               empty where it was to be made of arrays */
  TETMEND_FAILED = 5        /* anything else */
} tetmend_status;

/* An empty mesh with the default options; null when memory runs out. */
TETMEND_API tetmend_mesh* tetmend_create(void);
/* Null is allowed. */
TETMEND_API void tetmend_destroy(tetmend_mesh* mesh);

/* What was wrong with the last call: one line with the place and the reason; "" after one that went
 * well. Functions without a status leave it as it is. */
TETMEND_API const char* tetmend_last_error(const tetmend_mesh* mesh);

/* "0.1.0" */
TETMEND_API const char* tetmend_version(void);

/* ---- Options ---- */

/* Sets an option like `--NAME VALUE` of the command `tetmend improve`: "schedule" "thorough", "goal"
 * "35,140", "threads" "8", "time-limit" "60". A switch takes "true", "false" or "". A second value of
 * "set", "plugin", "protect", "only", "conserve" and "trace-operator" is put beside the first. Also:
 * "script", the text of a schedule; "limit", a switch: prove what the surface allows; "label-array"
 * of tetmend_load() and "variant" of tetmend_save(), as `tetmend convert` has them.
 * TETMEND_WRONG_OPTION for an unknown name, and for a value of another form. */
TETMEND_API tetmend_status tetmend_set(tetmend_mesh* mesh, const char* name, const char* value);
/* Finds what else is wrong with the options, before a large mesh is read. */
TETMEND_API tetmend_status tetmend_check_options(tetmend_mesh* mesh);
/* Makes all options those of a new handle. */
TETMEND_API tetmend_status tetmend_reset_options(tetmend_mesh* mesh);

/* The number of the first point and of the first tet, 0 (as in a new handle) or 1, in all arrays that
 * go in and out. */
TETMEND_API tetmend_status tetmend_set_first_number(tetmend_mesh* mesh, int number);

/* ---- Files ---- */

/* Reads a mesh; the format follows from the extension. The older mesh goes, unless this fails. */
TETMEND_API tetmend_status tetmend_load(tetmend_mesh* mesh, const char* file);
/* Writes the mesh. The file appears when it is complete; a failure leaves an older one as it was. */
TETMEND_API tetmend_status tetmend_save(tetmend_mesh* mesh, const char* file);

/* ---- Arrays in ---- */

/* Begins a new mesh with n points: x, y, z of the first, of the second, ... All else of the older one
 * goes. The functions below give it the rest, each list once; a second call replaces it. A mesh from
 * a file cannot be changed by them.
 * TETMEND_WRONG_INPUT, with its place, for a coordinate that is NaN or infinite, a number out of
 * range, and a point twice in an element. */
TETMEND_API tetmend_status tetmend_set_points(tetmend_mesh* mesh, const double* xyz, size_t n);
/* Numbers of the four points of each tet, in any order. A face between tets of two labels stays.
 * labels: n of them, or null: all are 0. */
TETMEND_API tetmend_status tetmend_set_tets(tetmend_mesh* mesh, const int32_t* tets, size_t n,
                                            const int32_t* labels);
/* Triangles with a name: of the surface, between two regions, or inside one. They stay. */
TETMEND_API tetmend_status tetmend_set_triangles(tetmend_mesh* mesh, const int32_t* triangles,
                                                 size_t n, const int32_t* labels);
TETMEND_API tetmend_status tetmend_set_edges(tetmend_mesh* mesh, const int32_t* edges, size_t n,
                                             const int32_t* labels);
/* One for each point. */
TETMEND_API tetmend_status tetmend_set_point_labels(tetmend_mesh* mesh, const int32_t* labels);
/* Points that neither move nor vanish. */
TETMEND_API tetmend_status tetmend_set_required_vertices(tetmend_mesh* mesh,
                                                         const int32_t* vertices, size_t n);

/* What data belong to. */
typedef enum tetmend_place {
  TETMEND_POINTS = 0,
  TETMEND_EDGES = 1,
  TETMEND_TRIANGLES = 2,
  TETMEND_TETS = 3
} tetmend_place;

typedef enum tetmend_type {
  TETMEND_INT32 = 0,
  TETMEND_INT64 = 1,
  TETMEND_FLOAT = 2,
  TETMEND_DOUBLE = 3
} tetmend_type;

/* Named numbers for each point or element, so many components for the first, then for the second.
 * An array of the same name and place is replaced. They come over to the improved mesh: of points
 * linearly in the old mesh, of tets from the old tet at the centroid, or see the option "conserve".
 * The points or elements must be there already. */
TETMEND_API tetmend_status tetmend_set_data(tetmend_mesh* mesh, tetmend_place place,
                                            const char* name, tetmend_type type, size_t components,
                                            const void* values);

/* ---- Arrays out ---- */

/* 0 for a null handle. */
TETMEND_API size_t tetmend_count(const tetmend_mesh* mesh, tetmend_place place);

/* Into room for n points or elements; TETMEND_WRONG_CALL if that is too little. `labels`, with room
 * for one number each, may be null. */
TETMEND_API tetmend_status tetmend_get_points(tetmend_mesh* mesh, double* xyz, size_t n);
TETMEND_API tetmend_status tetmend_get_tets(tetmend_mesh* mesh, int32_t* tets, int32_t* labels,
                                            size_t n);
TETMEND_API tetmend_status tetmend_get_triangles(tetmend_mesh* mesh, int32_t* triangles,
                                                 int32_t* labels, size_t n);
TETMEND_API tetmend_status tetmend_get_edges(tetmend_mesh* mesh, int32_t* edges, int32_t* labels,
                                             size_t n);
TETMEND_API tetmend_status tetmend_get_point_labels(tetmend_mesh* mesh, int32_t* labels, size_t n);

/* How many arrays of data there are. */
TETMEND_API size_t tetmend_data_count(const tetmend_mesh* mesh, tetmend_place place);
/* Array i, from 0, of them. Any of the three results may be null. */
TETMEND_API tetmend_status tetmend_data_info(tetmend_mesh* mesh, tetmend_place place, size_t i,
                                             const char** name, tetmend_type* type,
                                             size_t* components);
/* The numbers of an array, into room for n of them. TETMEND_WRONG_CALL unless it has that type. */
TETMEND_API tetmend_status tetmend_get_data(tetmend_mesh* mesh, tetmend_place place,
                                            const char* name, tetmend_type type, void* values,
                                            size_t n);

/* ---- Improving ---- */

typedef enum tetmend_stage {
  TETMEND_BUILDING = 0,  /* adjacency, order of the tets */
  TETMEND_MEASURING = 1, /* before and after */
  TETMEND_IMPROVING = 2  /* the schedule runs */
} tetmend_stage;

typedef struct tetmend_progress {
  tetmend_stage stage;
  const char* phase; /* while improving: the name of the pass; else "" */
  unsigned round;    /* of the schedule; 0 before its main loop */
  double share;      /* of the phase that is done, 0 to 1 */
  size_t n_bad;      /* bad tets after the pass before; not while building */
} tetmend_progress;

/* Called several times a second, by any thread of the run but never by two at once. Anything but 0
 * stops the run; the mesh is improved so far. It must not call functions of tetmend with this
 * handle. A null function: none. */
typedef int (*tetmend_progress_function)(void* user, const tetmend_progress* progress);
TETMEND_API tetmend_status tetmend_set_progress(tetmend_mesh* mesh,
                                                tetmend_progress_function function, void* user);

/* Improves the mesh in place. Its surface and all constraints stay bit for bit. The same mesh and
 * options give the same bytes, for every number of threads, and the same as the command line. */
TETMEND_API tetmend_status tetmend_improve(tetmend_mesh* mesh);

/* ---- What the last run has found ---- */

/* By the old number of a point or tet its new one; -1, or 0 where numbers begin with 1, if it is
 * gone. Points that stay come first, in their old order. n: room, for so many as there were before. */
TETMEND_API tetmend_status tetmend_get_vertex_map(tetmend_mesh* mesh, int32_t* map, size_t n);
TETMEND_API tetmend_status tetmend_get_tet_map(tetmend_mesh* mesh, int32_t* map, size_t n);

#define TETMEND_BANDS 5
#define TETMEND_BINS 36
#define TETMEND_RULERS 10

/* Worst value of a measure, the value that 1 % are as bad as or worse than, and the mean. */
typedef struct tetmend_ruler {
  double worst;
  double one_percent;
  double mean;
} tetmend_ruler;

/* The figures that the command line prints. Angles in degrees, shares in percent of the dihedral
 * angles; a tet is bad if it misses the goal. */
typedef struct tetmend_statistics {
  size_t tets;
  size_t vertices; /* also those of no tet */
  size_t boundary_triangles;
  size_t inverted;
  size_t flat;
  double volume;
  double theta_min;
  double theta_max;
  double lambda;
  double lambda_bands[TETMEND_BANDS];
  double q_worst; /* minimum sine of the worst tet */
  double q_mean;
  size_t n_bad;
  double q_aver;                        /* mean minimum sine of the bad tets */
  size_t histogram[TETMEND_BINS];       /* dihedral angles in bins of 5 degrees */
  tetmend_ruler rulers[TETMEND_RULERS]; /* see tetmend_ruler_name() */
  double shortest_edge;
  size_t faces_above_70; /* inner faces of more than 70 degrees non-orthogonality */
} tetmend_statistics;

/* "mean_ratio", ... of ruler 0 to TETMEND_RULERS - 1; null for another number. */
TETMEND_API const char* tetmend_ruler_name(int ruler);

/* Of the mesh as it is, for a goal of 30 and 150 degrees. Takes seconds for a large mesh. */
TETMEND_API tetmend_status tetmend_measure(tetmend_mesh* mesh, tetmend_statistics* statistics);
/* Of the mesh before and after the last run. Either may be null. */
TETMEND_API tetmend_status tetmend_get_statistics(tetmend_mesh* mesh, tetmend_statistics* before,
                                                  tetmend_statistics* after);

typedef enum tetmend_ending {
  TETMEND_FINISHED = 0,
  TETMEND_TIME_LIMIT = 1,
  TETMEND_STOPPED = 2 /* by the progress function */
} tetmend_ending;

typedef struct tetmend_result {
  tetmend_ending ending;
  double goal_min; /* degrees: what the run worked towards */
  double goal_max;
  size_t passes;
  size_t attempts;
  size_t accepted;
  size_t touched_tets; /* new ones, and those with a point that moved */
  size_t protected_tets;
  size_t not_positive_before; /* tets without positive volume, in exact arithmetic */
  size_t not_positive_after;
  uint64_t surface_fingerprint; /* the same before and after */
  double volume_change;         /* |after - before| / |before| */
  double building;              /* seconds */
  double measuring;
  double improving;
} tetmend_result;

TETMEND_API tetmend_status tetmend_get_result(tetmend_mesh* mesh, tetmend_result* result);

/* What the last tetmend_load(), tetmend_improve() or tetmend_save() had to say, one sentence each:
 * what of a file is not kept, and what is left of bad tets and why. Null for another number. */
TETMEND_API size_t tetmend_note_count(const tetmend_mesh* mesh);
TETMEND_API const char* tetmend_note(const tetmend_mesh* mesh, size_t i);

#ifdef __cplusplus
}
#endif

#endif
