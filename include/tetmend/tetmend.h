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

/** A mesh, the options for improving it, and what the last run has found. */
typedef struct tetmend_mesh tetmend_mesh;

/** What became of a call. */
typedef enum tetmend_status {
  TETMEND_OK = 0,           /**< it went well */
  TETMEND_WRONG_INPUT = 1,  /**< a file, an array, a script or the topology of the mesh */
  TETMEND_WRONG_OPTION = 2, /**< its name or its value */
  TETMEND_WRONG_CALL = 3,   /**< a null pointer, too little room, or what is not there */
  TETMEND_NO_MEMORY = 4,    /**< memory ran out; the mesh is sound: as before, improved so far, or
                               empty where it was to be made of arrays */
  TETMEND_FAILED = 5        /**< anything else */
} tetmend_status;

/** An empty mesh with the default options; null when memory runs out. */
TETMEND_API tetmend_mesh* tetmend_create(void);
/** Frees all that belongs to the handle. Null is allowed. */
TETMEND_API void tetmend_destroy(tetmend_mesh* mesh);

/** What was wrong with the last call: one line with the place and the reason; "" after one that went
 * well. Functions without a status leave it as it is. */
TETMEND_API const char* tetmend_last_error(const tetmend_mesh* mesh);

/** For what wraps this in another language: makes `message` the last error, and gives
 * TETMEND_WRONG_CALL. */
TETMEND_API tetmend_status tetmend_refuse(tetmend_mesh* mesh, const char* message);

/** Of the library: "0.1.0". */
TETMEND_API const char* tetmend_version(void);

/* ---- Options ---- */

/** Sets an option like `--NAME VALUE` of the command `tetmend improve`: "schedule" "thorough", "goal"
 * "35,140", "threads" "8", "time-limit" "60". A switch takes "true", "false" or "". A second value of
 * "set", "plugin", "protect", "only", "conserve" and "trace-operator" is put beside the first. Also:
 * "script", the text of a schedule; "limit", a switch: prove what the surface allows; "label-array"
 * of tetmend_load() and "variant" of tetmend_save(), as `tetmend convert` has them.
 * TETMEND_WRONG_OPTION for an unknown name, and for a value of another form. */
TETMEND_API tetmend_status tetmend_set(tetmend_mesh* mesh, const char* name, const char* value);
/** Finds what else is wrong with the options, before a large mesh is read. */
TETMEND_API tetmend_status tetmend_check_options(tetmend_mesh* mesh);
/** Makes all options those of a new handle. */
TETMEND_API tetmend_status tetmend_reset_options(tetmend_mesh* mesh);

/** The number of the first point and of the first tet, 0 (as in a new handle) or 1, in all arrays that
 * go in and out. */
TETMEND_API tetmend_status tetmend_set_first_number(tetmend_mesh* mesh, int number);

/* ---- Files ---- */

/** Reads a mesh; the format follows from the extension. The older mesh goes, unless this fails. */
TETMEND_API tetmend_status tetmend_load(tetmend_mesh* mesh, const char* file);
/** Writes the mesh. The file appears when it is complete; a failure leaves an older one as it was.
 * TETMEND_WRONG_CALL for a mesh without points, as a new handle has it. */
TETMEND_API tetmend_status tetmend_save(tetmend_mesh* mesh, const char* file);

/* ---- Arrays in ---- */

/** Begins a new mesh with n points: x, y, z of the first, of the second, ... All else of the older one
 * goes. The functions below give it the rest, each list once; a second call replaces it. A mesh from
 * a file cannot be changed by them.
 * TETMEND_WRONG_INPUT, with its place, for a coordinate that is NaN or infinite, a number out of
 * range, and a point twice in an element. */
TETMEND_API tetmend_status tetmend_set_points(tetmend_mesh* mesh, const double* xyz, size_t n);
/** Numbers of the four points of each tet, in any order. A face between tets of two labels stays.
 * labels: n of them, or null: all are 0. */
TETMEND_API tetmend_status tetmend_set_tets(tetmend_mesh* mesh, const int32_t* tets, size_t n,
                                            const int32_t* labels);
/** Triangles with a name: of the surface, between two regions, or inside one. They stay. */
TETMEND_API tetmend_status tetmend_set_triangles(tetmend_mesh* mesh, const int32_t* triangles,
                                                 size_t n, const int32_t* labels);
/** Edges with a name. They stay, like triangles. */
TETMEND_API tetmend_status tetmend_set_edges(tetmend_mesh* mesh, const int32_t* edges, size_t n,
                                             const int32_t* labels);
/** One for each point; they are carried along. */
TETMEND_API tetmend_status tetmend_set_point_labels(tetmend_mesh* mesh, const int32_t* labels);
/** Points that neither move nor vanish. */
TETMEND_API tetmend_status tetmend_set_required_vertices(tetmend_mesh* mesh,
                                                         const int32_t* vertices, size_t n);

/** What data and groups belong to. The value is the dimension. */
typedef enum tetmend_place {
  TETMEND_POINTS = 0,    /**< all of them, also those of no tet */
  TETMEND_EDGES = 1,     /**< those with a name, see tetmend_set_edges() */
  TETMEND_TRIANGLES = 2, /**< those with a name, see tetmend_set_triangles() */
  TETMEND_TETS = 3       /**< all of them */
} tetmend_place;

/** Of the numbers of an array of data. */
typedef enum tetmend_type {
  TETMEND_INT32 = 0, /**< int32_t */
  TETMEND_INT64 = 1, /**< int64_t */
  TETMEND_FLOAT = 2, /**< float, 32 bits */
  TETMEND_DOUBLE = 3 /**< double, 64 bits */
} tetmend_type;

/** Named numbers for each point or element, so many components for the first, then for the second.
 * An array of the same name and place is replaced. They come over to the improved mesh: of points
 * linearly in the old mesh, of tets from the old tet at the centroid, or see the option "conserve".
 * The points or elements must be there already. */
TETMEND_API tetmend_status tetmend_set_data(tetmend_mesh* mesh, tetmend_place place,
                                            const char* name, tetmend_type type, size_t components,
                                            const void* values);

/** A named or numbered set of points or elements; one of them may be in several. It comes over to the
 * improved mesh: a new tet is in it if the old tet at its centroid was, so give tets of different
 * sets different labels where the border between them must stay. A group of the same place, number and
 * name is replaced.
 *
 * - number: no other group of the place has it; 0: none
 * - name: may be ""
 * - members: n numbers of points or elements, none of them twice; null: all with the label `number`
 *
 * The points or elements must be there already; when they are set anew, their groups go. */
TETMEND_API tetmend_status tetmend_set_group(tetmend_mesh* mesh, tetmend_place place,
                                             int32_t number, const char* name,
                                             const int32_t* members, size_t n);

/* ---- Arrays out ---- */

/** How many points or elements there are; 0 for a null handle. */
TETMEND_API size_t tetmend_count(const tetmend_mesh* mesh, tetmend_place place);

/** Three coordinates for each point, into room for n points. Here and below, too little room is
 * TETMEND_WRONG_CALL. */
TETMEND_API tetmend_status tetmend_get_points(tetmend_mesh* mesh, double* xyz, size_t n);
/** Four points for each tet, into room for n tets. `labels`, with room for one number each, may be
 * null, here and below. */
TETMEND_API tetmend_status tetmend_get_tets(tetmend_mesh* mesh, int32_t* tets, int32_t* labels,
                                            size_t n);
/** Three points for each triangle, into room for n triangles. */
TETMEND_API tetmend_status tetmend_get_triangles(tetmend_mesh* mesh, int32_t* triangles,
                                                 int32_t* labels, size_t n);
/** Two points for each edge, into room for n edges. */
TETMEND_API tetmend_status tetmend_get_edges(tetmend_mesh* mesh, int32_t* edges, int32_t* labels,
                                             size_t n);
/** One for each point, into room for n labels. */
TETMEND_API tetmend_status tetmend_get_point_labels(tetmend_mesh* mesh, int32_t* labels, size_t n);

/** How many arrays of data there are. */
TETMEND_API size_t tetmend_data_count(const tetmend_mesh* mesh, tetmend_place place);
/** Array i, from 0, of them. Any of the three results may be null. */
TETMEND_API tetmend_status tetmend_data_info(tetmend_mesh* mesh, tetmend_place place, size_t i,
                                             const char** name, tetmend_type* type,
                                             size_t* components);
/** The numbers of an array, into room for n of them. TETMEND_WRONG_CALL unless it has that type. */
TETMEND_API tetmend_status tetmend_get_data(tetmend_mesh* mesh, tetmend_place place,
                                            const char* name, tetmend_type type, void* values,
                                            size_t n);

/** How many groups there are; 0 for a null handle. */
TETMEND_API size_t tetmend_group_count(const tetmend_mesh* mesh);
/** Group i, from 0, and how many members it has. Any of the four results may be null. */
TETMEND_API tetmend_status tetmend_group_info(tetmend_mesh* mesh, size_t i, tetmend_place* place,
                                              int32_t* number, const char** name, size_t* count);
/** Numbers of its points or elements, ascending unless it was set otherwise, into room for n. */
TETMEND_API tetmend_status tetmend_get_group(tetmend_mesh* mesh, size_t i, int32_t* members,
                                             size_t n);

/* ---- Improving ---- */

/** What a run is doing. */
typedef enum tetmend_stage {
  TETMEND_BUILDING = 0,  /**< adjacency, order of the tets */
  TETMEND_MEASURING = 1, /**< before and after */
  TETMEND_IMPROVING = 2  /**< the schedule runs */
} tetmend_stage;

/** How far a run has come. */
typedef struct tetmend_progress {
  tetmend_stage stage; /**< what it is doing */
  const char* phase;   /**< while improving: the name of the pass; else "" */
  unsigned round;      /**< of the schedule; 0 before its main loop */
  double share;        /**< of the phase that is done, 0 to 1 */
  size_t n_bad;        /**< bad tets after the pass before; not while building */
} tetmend_progress;

/** Called several times a second, by any thread of the run but never by two at once. Anything but 0
 * stops the run; the mesh is improved so far. It must not call functions of tetmend with this
 * handle. A null function: none. */
typedef int (*tetmend_progress_function)(void* user, const tetmend_progress* progress);
/** `user` is what the function gets as its first argument. */
TETMEND_API tetmend_status tetmend_set_progress(tetmend_mesh* mesh,
                                                tetmend_progress_function function, void* user);

/** Improves the mesh in place. Its surface and all constraints stay bit for bit. The same mesh and
 * options give the same bytes, for every number of threads, and the same as the command line. */
TETMEND_API tetmend_status tetmend_improve(tetmend_mesh* mesh);

/* ---- What the last run has found ---- */

/** By the old number of a point or tet its new one; -1, or 0 where numbers begin with 1, if it is
 * gone. Points that stay come first, in their old order. n: room, for so many as there were before. */
TETMEND_API tetmend_status tetmend_get_vertex_map(tetmend_mesh* mesh, int32_t* map, size_t n);
/** The same for tets. One is the same as long as its four points stay together, though they may
 * move. */
TETMEND_API tetmend_status tetmend_get_tet_map(tetmend_mesh* mesh, int32_t* map, size_t n);

/** Bands of shares in tetmend_statistics. */
#define TETMEND_BANDS 5
/** Bins of its histogram. */
#define TETMEND_BINS 36
/** How many measures of other programs there are. */
#define TETMEND_RULERS 11

/** Figures of one measure over all tets, faces or vertices. */
typedef struct tetmend_ruler {
  double worst;       /**< of the worst of them */
  double one_percent; /**< 1 % are as bad or worse */
  double mean;        /**< of all */
} tetmend_ruler;

/** The figures that the command line prints. Angles in degrees, shares in percent of the dihedral
 * angles; a tet is bad if it misses the goal. */
typedef struct tetmend_statistics {
  size_t tets;                          /**< how many */
  size_t vertices;                      /**< also those of no tet */
  size_t boundary_triangles;            /**< of the surface */
  size_t inverted;                      /**< tets of negative volume */
  size_t flat;                          /**< tets of no volume */
  double volume;                        /**< of all tets */
  double theta_min;                     /**< smallest dihedral angle */
  double theta_max;                     /**< largest dihedral angle */
  double lambda;                        /**< share of the angles that miss the goal */
  double lambda_bands[TETMEND_BANDS];   /**< of it, the fifth of the worst angles first */
  double q_worst;                       /**< minimum sine of the worst tet */
  double q_mean;                        /**< mean minimum sine */
  size_t n_bad;                         /**< bad tets */
  double q_aver;                        /**< mean minimum sine of the bad tets */
  size_t histogram[TETMEND_BINS];       /**< dihedral angles in bins of 5 degrees */
  tetmend_ruler rulers[TETMEND_RULERS]; /**< see tetmend_ruler_name() */
  double shortest_edge;                 /**< its length */
  size_t faces_above_70; /**< inner faces of more than 70 degrees non-orthogonality */
  double cg_steps;       /**< estimate: of conjugate gradients with Jacobi's preconditioner */
  double work;           /**< tets times cg_steps */
} tetmend_statistics;

/** "mean_ratio", ... of ruler 0 to TETMEND_RULERS - 1; null for another number. */
TETMEND_API const char* tetmend_ruler_name(int ruler);

/** Of the mesh as it is, for the goal of its options. Takes seconds for a large mesh. */
TETMEND_API tetmend_status tetmend_measure(tetmend_mesh* mesh, tetmend_statistics* statistics);
/** Of the mesh before and after the last run. Either may be null. */
TETMEND_API tetmend_status tetmend_get_statistics(tetmend_mesh* mesh, tetmend_statistics* before,
                                                  tetmend_statistics* after);

/** Why a run ended. */
typedef enum tetmend_ending {
  TETMEND_FINISHED = 0,   /**< the schedule did */
  TETMEND_TIME_LIMIT = 1, /**< its time was over */
  TETMEND_STOPPED = 2     /**< by the progress function */
} tetmend_ending;

/** What a run did. */
typedef struct tetmend_result {
  tetmend_ending ending;        /**< why it ended */
  double goal_min;              /**< degrees: what the run worked towards */
  double goal_max;              /**< likewise */
  size_t passes;                /**< of the schedule */
  size_t attempts;              /**< of operators */
  size_t accepted;              /**< of them */
  size_t touched_tets;          /**< new ones, and those with a point that moved */
  size_t protected_tets;        /**< by the options "protect" and "only" */
  size_t not_positive_before;   /**< tets without positive volume, in exact arithmetic */
  size_t not_positive_after;    /**< likewise */
  uint64_t surface_fingerprint; /**< the same before and after */
  double volume_change;         /**< |after - before| / |before| */
  double building;              /**< seconds */
  double measuring;             /**< seconds */
  double improving;             /**< seconds */
} tetmend_result;

/** Of the last run. */
TETMEND_API tetmend_status tetmend_get_result(tetmend_mesh* mesh, tetmend_result* result);

/** How many sentences the last tetmend_load(), tetmend_measure(), tetmend_improve() or tetmend_save()
 * had to say: what of a file is not kept, where points touch without being joined, and what is left of
 * bad tets and why. */
TETMEND_API size_t tetmend_note_count(const tetmend_mesh* mesh);
/** Sentence i, from 0; null for another number. */
TETMEND_API const char* tetmend_note(const tetmend_mesh* mesh, size_t i);

/** How many figures are worse than before the last run: the line "worse than before" of the command
 * line. Of the promised ones none, unless inverted tets were mended. */
TETMEND_API size_t tetmend_worse_count(const tetmend_mesh* mesh);
/** Figure i of these in words, from 0; null for another number. */
TETMEND_API const char* tetmend_worse(const tetmend_mesh* mesh, size_t i);

#ifdef __cplusplus
}
#endif

#endif
