// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The runtime as a C interface (C99): models and meshes as handles, plain structs, every query for one pair, for many, and for
/// one pair in many poses. Points and directions of answers are in A's frame, lengths in the bodies' unit. What answers mean
/// and cost is said in query.h, depth.h, manifold.h, mesh_query.h and mesh_contacts.h of C++, by the same names; laws by
/// number: LAWS.md.
///
/// Errors. A function that can fail returns a code, SWIFTLET_OK or another, and takes, last, where to write what was wrong, or
/// NULL. A null pointer is an error unless its words allow it. After an error nothing is written but the error. No exception
/// leaves the library. What bodies or a pose lack is no error but the status of an answer.
///
/// Sizes. A struct whose first member is `size` may grow at its end. The caller sets `size` to what it was compiled with, a
/// multiple of the struct's alignment, as sizeof always is; any other is refused with SWIFTLET_BAD_SIZE. An input that is
/// shorter than the library's has the defaults in what it lacks; one that is longer is refused likewise unless the rest is 0
/// bytes. An output is written as far as `size` says; what a longer one has more is set to 0. An output shorter than its words
/// allow is refused likewise. In arrays all elements have the first one's size: the others' is not read, and the library sets
/// it in outputs. Other structs, and the values of enumerations, never change within one SOVERSION.
///
/// Threads. Handles may be used by any number of threads at once, and a handle freed by any of them.
#ifndef SWIFTLET_SWIFTLET_H
#define SWIFTLET_SWIFTLET_H

#include <stddef.h>
#include <stdint.h>

/// Marks what the shared library shows.
#if defined(_WIN32) && defined(SWIFTLET_C_BUILDS)
#define SWIFTLET_API __declspec(dllexport)
#elif defined(_WIN32)
#define SWIFTLET_API __declspec(dllimport)
#else
#define SWIFTLET_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

// ---- Errors ----------------------------------------------------------------------------------------------------------------

/// What a function that can fail returns: one of the codes below.
typedef int32_t swiftlet_code;

/// Codes. Up to SWIFTLET_CANCELLED those of C++'s ErrorCode, plus 1.
enum {
  SWIFTLET_OK = 0,              ///< done
  SWIFTLET_CANNOT_READ = 1,     ///< the file is missing or unreadable
  SWIFTLET_CANNOT_WRITE = 2,    ///< the file cannot be created or the disk is full; nothing half-written is left
  SWIFTLET_BAD_FORMAT = 3,      ///< the data are not in the format expected, or damaged
  SWIFTLET_BAD_VERSION = 4,     ///< a format version that this library does not read
  SWIFTLET_BAD_VALUE = 5,       ///< an argument, option or coordinate out of its range
  SWIFTLET_EMPTY = 6,           ///< there are no points
  SWIFTLET_NOT_CONVEX = 7,      ///< a reflex edge, or faces that do not close to one convex surface
  SWIFTLET_NOT_SOLID = 8,       ///< flat, collinear or a single point where a solid was required
  SWIFTLET_NOT_ENCLOSING = 9,   ///< a coarser level does not enclose level 0
  SWIFTLET_TOO_LARGE = 10,      ///< more than 30-bit feature ids can name, or the format or machine holds
  SWIFTLET_CANCELLED = 11,      ///< a callback of the caller's asked to stop
  SWIFTLET_NULL_POINTER = 100,  ///< a pointer that may not be null is
  SWIFTLET_BAD_SIZE = 101,      ///< `size` is too small, no multiple of the alignment, or too large and the rest is not 0
  SWIFTLET_NO_MEMORY = 102,     ///< there is no memory
  SWIFTLET_UNEXPECTED = 103     ///< anything else
};

/// Receives what was wrong. Its size: any from 16 up; `message` goes as far as the size says, so it may be longer or shorter
/// than here. Of a smaller size nothing is written: the code that the function returns says what was wrong.
typedef struct swiftlet_error {
  uint32_t size;       ///< of this struct in bytes, set by the caller
  swiftlet_code code;  ///< that which the function returned; unchanged if that is SWIFTLET_OK
  char message[504];   ///< one sentence in UTF-8 that names the argument, file, vertex or edge; ends with 0
} swiftlet_error;

/// Returns one sentence on what a code means. Never null; lives as long as the library.
SWIFTLET_API const char* swiftlet_code_text(swiftlet_code code);
/// Returns the library's version as "MAJOR.MINOR.PATCH".
SWIFTLET_API const char* swiftlet_version(void);

// ---- Poses, features, seeds ------------------------------------------------------------------------------------------------

/// A motion that maps a point p of its own frame to R p + t. abs(R^T R - I) <= 1e-6 in every entry, each coordinate of t at
/// most 1e45 in magnitude, else queries answer SWIFTLET_STATUS_INVALID_POSE. 96 bytes, which never change.
typedef struct swiftlet_pose {
  double rotation[9];     ///< row by row: entry (i, k) is rotation[3 * i + k]
  double translation[3];  ///< in the target frame and the bodies' unit
} swiftlet_pose;

/// Gives the pose of B in A's frame, given both poses in a common frame. Translations are subtracted first, and A's rotation is
/// inverted, not transposed.
SWIFTLET_API swiftlet_code swiftlet_relative(const swiftlet_pose* a_in_world, const swiftlet_pose* b_in_world,
                                             swiftlet_pose* b_in_a, swiftlet_error* error);
/// Gives the pose that undoes `pose`.
SWIFTLET_API swiftlet_code swiftlet_inverse(const swiftlet_pose* pose, swiftlet_pose* inverse, swiftlet_error* error);

/// Names a feature of one level: the kind in the two highest bits, the index within its kind in the thirty others. 0: none.
typedef uint32_t swiftlet_feature;

/// Kinds of features.
enum {
  SWIFTLET_FEATURE_NONE = 0,    ///< no feature
  SWIFTLET_FEATURE_VERTEX = 1,  ///< the index is a vertex's
  SWIFTLET_FEATURE_EDGE = 2,    ///< the index is a half-edge's; of a mesh 3 * triangle + the corner where the edge begins
  SWIFTLET_FEATURE_FACE = 3     ///< the index is a face's; of a mesh a triangle's
};

/// Stands for "no index".
#define SWIFTLET_NO_INDEX UINT32_C(0xffffffff)

/// The warm start that a query leaves for the next query of the same ordered pair of bodies; all 0 is a cold start. 128 bytes,
/// which never change, and the caller's: any bits are legal, and change the work, never the truth.
typedef struct swiftlet_seed {
  uint64_t words[16];  ///< nothing to read
} swiftlet_seed;

// ---- Executors -------------------------------------------------------------------------------------------------------------

/// Where tasks run.
typedef struct swiftlet_executor swiftlet_executor;
/// A task: call it with its context and an index. It may be called on any thread, and returns when it is done.
typedef void (*swiftlet_task)(void* context, size_t index);
/// Calls task(context, 0) to task(context, count - 1), each once, in any order, on any threads, and returns when all are done.
/// `data` is the caller's. It must not throw.
typedef void (*swiftlet_execute)(size_t count, swiftlet_task task, void* context, void* data);
/// Returns not 0 to stop: no further task of the batch begins. Asked before each task until then, on the thread that is about
/// to run it. `data` is the caller's.
typedef int32_t (*swiftlet_stop)(void* data);

/// Makes an executor of the calling thread and `thread_count` - 1 of its own, which wait as long as it lives. `thread_count` is
/// clamped to 1 to 1024.
SWIFTLET_API swiftlet_code swiftlet_executor_on_threads(uint32_t thread_count, swiftlet_executor** executor,
                                                        swiftlet_error* error);
/// Makes an executor of the caller's. `data` may be null.
SWIFTLET_API swiftlet_code swiftlet_executor_create(swiftlet_execute execute, void* data, swiftlet_executor** executor,
                                                    swiftlet_error* error);
/// Ends the threads of an executor, which must not be in use. Null: does nothing.
SWIFTLET_API void swiftlet_executor_release(swiftlet_executor* executor);

/// How a batch runs. Null or zero: on the calling thread, to the end.
typedef struct swiftlet_run {
  uint32_t size;                      ///< of this struct, set by the caller
  uint32_t reserved;                  ///< 0
  const swiftlet_executor* executor;  ///< null: the calling thread
  swiftlet_stop stop;                 ///< null: never
  void* stop_data;                    ///< handed to `stop`
} swiftlet_run;

// ---- Models ----------------------------------------------------------------------------------------------------------------

/// A convex body at several levels of detail; it never changes. Made with one reference.
typedef struct swiftlet_model swiftlet_model;

/// Which levels to keep; null: all.
typedef struct swiftlet_detail {
  double deviation;  ///< keep no level finer than the coarsest one with a smaller deviation, in the body's unit; 0: all
  uint64_t bytes;    ///< keep only levels that lie wholly in this many first bytes of the block; UINT64_MAX: all
} swiftlet_detail;

/// How many samples the start table of a model has.
enum {
  SWIFTLET_TABLE_NONE = 0,        ///< none
  SWIFTLET_TABLE_DEGREES_22 = 1,  ///< 114, 22.5 degrees apart
  SWIFTLET_TABLE_DEGREES_11 = 2,  ///< 482, 11.25 degrees
  SWIFTLET_TABLE_DEGREES_5 = 3    ///< 1986, 5.625 degrees
};

/// The tables from which cold queries on a model start, as TableSpec of C++. 16 bytes, which never change.
typedef struct swiftlet_table_spec {
  int32_t resolution;    ///< one of SWIFTLET_TABLE_*
  uint32_t map_cells;    ///< entries of a support map per vertex, 0 (no maps) to 64
  double radius_factor;  ///< of the start table's sphere of samples, in bounding radii: 1 to 1e6
} swiftlet_table_spec;

/// One level as plain arrays: LevelArrays of C++. Faces are counter-clockwise seen from outside. Counts of optional arrays
/// follow from the others'. Size: at least up to `face_sizes`.
typedef struct swiftlet_level_arrays {
  uint32_t size;                      ///< of this struct, set by the caller
  uint32_t reserved;                  ///< 0
  const double* vertices;             ///< x, y, z of each vertex: 0 or 1e-70 to 1e45 in magnitude
  size_t vertex_count;                ///< vertices
  const uint32_t* face_vertices;      ///< the vertices of each face, one face after the other
  size_t face_vertex_count;           ///< entries of `face_vertices`
  const uint32_t* face_sizes;         ///< vertices per face; null: all are triangles
  size_t face_count;                  ///< faces; read only with `face_sizes`
  const uint32_t* vertex_source;      ///< level 0 only: the user's id of each vertex; null: 0, 1, 2, ...
  const uint32_t* face_source_begin;  ///< level 0 only, one more than faces: where a face's list in `face_source` begins, then
                                      ///< the last one's end; null: face k has the id k
  const uint32_t* face_source;        ///< level 0 only: the user's triangle ids; as many as the last of `face_source_begin`
  const uint32_t* child_vertex;       ///< per vertex, a vertex of the finer arrays; null: the nearest
  const uint32_t* child_of_face;      ///< per face, a vertex of the finer arrays; null: its first vertex's child
} swiftlet_level_arrays;

/// Options of swiftlet_model_from_levels.
typedef struct swiftlet_model_options {
  uint32_t size;                      ///< of this struct, set by the caller
  int32_t repair;                     ///< not 0: flip reflex edges that rounding left in the given faces, instead of refusing
  swiftlet_table_spec table;          ///< the start table and support maps to fill
  const swiftlet_executor* executor;  ///< runs what can be cut into tasks; null: the calling thread. The same bytes on any
} swiftlet_model_options;

/// Writes the defaults into a struct of `size` bytes.
SWIFTLET_API swiftlet_code swiftlet_model_options_init(swiftlet_model_options* options, size_t size, swiftlet_error* error);

/// Loads a model file. `path` is UTF-8 (on Windows too), `detail` may be null. Cost: one pass over the bytes read.
SWIFTLET_API swiftlet_code swiftlet_model_load(const char* path, const swiftlet_detail* detail, swiftlet_model** model,
                                               swiftlet_error* error);
/// Loads a model whose memory is the mapped file. The file's content must not change while the model lives.
SWIFTLET_API swiftlet_code swiftlet_model_map(const char* path, const swiftlet_detail* detail, swiftlet_model** model,
                                              swiftlet_error* error);
/// Reads the complete levels of a file that was cut short. `note` receives, as far as `note_size` bytes go, one sentence on
/// what is missing, empty for a whole file; it may be null.
SWIFTLET_API swiftlet_code swiftlet_model_salvage(const char* path, char* note, size_t note_size, swiftlet_model** model,
                                                  swiftlet_error* error);
/// Loads a model from the bytes of a file, of any alignment, which are copied. (Without a copy: swiftlet_model_map.)
SWIFTLET_API swiftlet_code swiftlet_model_from_bytes(const void* bytes, size_t byte_count, const swiftlet_detail* detail,
                                                     swiftlet_model** model, swiftlet_error* error);
/// Makes a model of one or several levels, finest first. `options` may be null. Errors name the reflex edge and its height.
SWIFTLET_API swiftlet_code swiftlet_model_from_levels(const swiftlet_level_arrays* levels, size_t level_count,
                                                      const swiftlet_model_options* options, swiftlet_model** model,
                                                      swiftlet_error* error);
/// Writes a new file beside `path`, PATH.XXXX.part, then renames it. `written` receives its bytes and may be null.
SWIFTLET_API swiftlet_code swiftlet_model_save(const swiftlet_model* model, const char* path, uint64_t* written,
                                               swiftlet_error* error);
/// Makes a model without the levels that `detail` leaves out.
SWIFTLET_API swiftlet_code swiftlet_model_cut(const swiftlet_model* model, const swiftlet_detail* detail, swiftlet_model** cut,
                                              swiftlet_error* error);
/// Makes a model of the same block with `level` and all coarser levels ready for queries, if the block holds them, as that of a
/// mapped model does.
SWIFTLET_API swiftlet_code swiftlet_model_ensure(const swiftlet_model* model, int32_t level, swiftlet_model** ensured,
                                                 swiftlet_error* error);
/// Makes a model of the levels present with new tables.
SWIFTLET_API swiftlet_code swiftlet_model_with_table(const swiftlet_model* model, const swiftlet_table_spec* spec,
                                                     swiftlet_model** with_table, swiftlet_error* error);
/// Adds a reference, and returns the model; null: null.
SWIFTLET_API const swiftlet_model* swiftlet_model_retain(const swiftlet_model* model);
/// Takes a reference; the last one frees the model and all that points into it. Null: does nothing.
SWIFTLET_API void swiftlet_model_release(const swiftlet_model* model);

/// What a model is. Size: at least up to `dimension`.
typedef struct swiftlet_model_info {
  uint32_t size;              ///< of this struct, set by the caller
  int32_t level_count;        ///< at least 1; level 0 is the exact hull, larger is coarser
  int32_t finest_level;       ///< the finest level present; 0 in a whole model
  int32_t dimension;          ///< 3 solid, 2 flat, 1 segment, 0 point
  double centre[3];           ///< body frame: area centroid of level 0, or the mean of its vertices if it has no faces
  double radius;              ///< largest distance of a vertex of level 0 from `centre`, rounded up
  double extent;              ///< largest absolute coordinate over all levels
  double box_min[3];          ///< body frame: smallest coordinates of level 0
  double box_max[3];          ///< body frame: largest coordinates of level 0
  double volume;              ///< of level 0, in cubic units
  swiftlet_table_spec table;  ///< what the tables were filled from
  int32_t map_level;          ///< the finest level with a support map; `level_count` if there is none
  uint32_t reserved;          ///< 0
} swiftlet_model_info;

/// Tells what a model is.
SWIFTLET_API swiftlet_code swiftlet_model_get_info(const swiftlet_model* model, swiftlet_model_info* info,
                                                   swiftlet_error* error);

/// A vertex and its ring, the half-edges that start here, counter-clockwise seen from outside.
typedef struct swiftlet_vertex {
  double x;             ///< body frame, the caller's unit
  double y;             ///< likewise
  double z;             ///< likewise
  uint32_t ring_begin;  ///< first half-edge of the ring
  uint32_t ring_count;  ///< number of half-edges
} swiftlet_vertex;

/// One of the two directed halves of an edge; its origin is the head of its twin.
typedef struct swiftlet_half_edge {
  uint32_t head;  ///< the vertex at which it ends
  uint32_t twin;  ///< the opposite half-edge
  uint32_t face;  ///< the face on its left; SWIFTLET_NO_INDEX for a segment. The same as the twin's: a diagonal of a flat face
} swiftlet_half_edge;

/// The plane of a face with more than three vertices: FacePlane of C++.
typedef struct swiftlet_face_plane {
  double x;          ///< unit outward normal, body frame
  double y;          ///< likewise
  double z;          ///< likewise
  double thickness;  ///< greatest distance of a vertex of the face from the plane
  double over;       ///< no vertex of the body is higher than this above the plane
} swiftlet_face_plane;

/// A level of a model: Level and ConvexView of C++. Pointers live as long as the model. Size: at least up to `volume`.
typedef struct swiftlet_level {
  uint32_t size;                         ///< of this struct, set by the caller
  uint32_t map_side;                     ///< `support_map` has 2 map_side^2 cells
  double deviation;                      ///< bound on the distance of this level's points from level 0
  double volume;                         ///< in cubic units; 0 for a body that is not solid
  const swiftlet_vertex* vertices;       ///< null on levels finer than the finest present, as all arrays but `support_map`
  size_t vertex_count;                   ///< vertices
  const swiftlet_half_edge* half_edges;  ///< sorted by origin
  size_t half_edge_count;                ///< half-edges, two for each edge
  const uint32_t* face_first;            ///< per face, a half-edge of its loop
  size_t face_count;                     ///< faces
  const swiftlet_face_plane* planes;     ///< planes of the first `plane_count` faces, which have more than three vertices
  size_t plane_count;                    ///< planes
  const uint32_t* child_vertex;          ///< per vertex, the vertex one level finer; null on level 0
  const swiftlet_feature* child_face;    ///< per face, the face or vertex one level finer; null on level 0
  const uint32_t* parent_face;           ///< per face, the vertex one level coarser; null on the coarsest
  const uint32_t* support_map;           ///< per cell, the vertex extreme there and a bound on its error; null: no map
  size_t support_map_count;              ///< its entries
  double map_frame[6];                   ///< of Level::map_frame
  double extent;                         ///< largest absolute coordinate
  double centre[3];                      ///< any point of the body
  double inner_radius;                   ///< of a ball around `centre` in the body; 0: none is known
  double reach;                          ///< upper bound on the distance of two points of the body; 0: not known
  double edge_length;                    ///< mean length of the edges, diagonals included
  uint64_t bytes;                        ///< size of this level in the block of a whole model
  uint64_t prefix;                       ///< bytes from the block's beginning to this level's end, of level 0 all; 0 if the
                                         ///< block lacks it
  uint64_t edge_count;                   ///< edges without diagonals
  uint64_t triangle_count;               ///< 2 V - 4 for a solid
} swiftlet_level;

/// Shows a level, 0 <= `index` < level_count.
SWIFTLET_API swiftlet_code swiftlet_model_get_level(const swiftlet_model* model, int32_t index, swiftlet_level* level,
                                                    swiftlet_error* error);
/// Lists the vertices of a face, counter-clockwise seen from outside: `count` of them, of which `vertices` receives the first
/// `capacity`. `vertices` may be null if `capacity` is 0.
SWIFTLET_API swiftlet_code swiftlet_model_face(const swiftlet_model* model, int32_t level, uint32_t face, uint32_t* vertices,
                                               size_t capacity, size_t* count, swiftlet_error* error);

/// Maps the features of level 0 to the user's own ids. Pointers live as long as the model; null if level 0 is absent.
typedef struct swiftlet_source_map {
  uint32_t size;               ///< of this struct, set by the caller
  uint32_t reserved;           ///< 0
  const uint32_t* vertex;      ///< per vertex of level 0, the user's vertex
  size_t vertex_count;         ///< vertices
  const uint32_t* face_begin;  ///< per face, the begin of its list in `face`; then the last's end
  size_t face_begin_count;     ///< faces and one
  const uint32_t* face;        ///< lists of the user's triangles
  size_t face_source_count;    ///< entries of `face`
} swiftlet_source_map;

/// Shows the user's ids of level 0. All members are written.
SWIFTLET_API swiftlet_code swiftlet_model_get_source(const swiftlet_model* model, swiftlet_source_map* source,
                                                     swiftlet_error* error);
/// Finds a support vertex of the finest level: no other is farther along `direction` (three numbers, body frame, any length).
SWIFTLET_API swiftlet_code swiftlet_model_support(const swiftlet_model* model, const double* direction, uint32_t* vertex,
                                                  swiftlet_error* error);
/// Shows the start table, a vertex of level 0 per sample; null and 0 if there is none.
SWIFTLET_API swiftlet_code swiftlet_model_get_table(const swiftlet_model* model, const uint32_t** table, size_t* count,
                                                    swiftlet_error* error);
/// Finds a vertex of level 0 that faces `direction`, by one look-up, as a start of swiftlet_march, in the table or else
/// the support maps; 0 if there is neither, or level 0 is absent.
SWIFTLET_API swiftlet_code swiftlet_model_table_start(const swiftlet_model* model, const double* direction,
                                                      swiftlet_feature* vertex, swiftlet_error* error);
/// Shows the block, which is what swiftlet_model_save writes. It lives as long as the model.
SWIFTLET_API swiftlet_code swiftlet_model_get_bytes(const swiftlet_model* model, const void** bytes, size_t* byte_count,
                                                    swiftlet_error* error);
/// Hashes the block; equal blocks have equal hashes.
SWIFTLET_API swiftlet_code swiftlet_model_get_hash(const swiftlet_model* model, uint64_t* hash, swiftlet_error* error);

// ---- Meshes ----------------------------------------------------------------------------------------------------------------

/// Triangles of any topology and a tree of boxes over them; they never change. Made with one reference.
typedef struct swiftlet_mesh swiftlet_mesh;

/// Gets the fraction done in [0, 1]; returns 0 to cancel. `data` is the caller's.
typedef int32_t (*swiftlet_progress)(double fraction, void* data);

/// Makes a mesh of triangles, three indices each, over points, three coordinates each: 0 or 1e-45 to 1e45 in magnitude.
/// `progress` and its data may be null.
SWIFTLET_API swiftlet_code swiftlet_mesh_from_triangles(const double* points, size_t point_count, const uint32_t* triangles,
                                                        size_t triangle_count, swiftlet_progress progress, void* progress_data,
                                                        swiftlet_mesh** mesh, swiftlet_error* error);
/// Makes the mesh with its points moved: the user's, in the order in which swiftlet_mesh_from_triangles got them.
SWIFTLET_API swiftlet_code swiftlet_mesh_refit(const swiftlet_mesh* mesh, const double* points, size_t point_count,
                                               swiftlet_mesh** refitted, swiftlet_error* error);
/// Loads a mesh file. `path` is UTF-8, `detail` may be null.
SWIFTLET_API swiftlet_code swiftlet_mesh_load(const char* path, const swiftlet_detail* detail, swiftlet_mesh** mesh,
                                              swiftlet_error* error);
/// Loads a mesh whose memory is the mapped file. The file's content must not change while the mesh lives.
SWIFTLET_API swiftlet_code swiftlet_mesh_map(const char* path, swiftlet_mesh** mesh, swiftlet_error* error);
/// Reads what is complete in a file that was cut short; `note` as of swiftlet_model_salvage.
SWIFTLET_API swiftlet_code swiftlet_mesh_salvage(const char* path, char* note, size_t note_size, swiftlet_mesh** mesh,
                                                 swiftlet_error* error);
/// Loads a mesh from the bytes of a file, of any alignment, which are copied.
SWIFTLET_API swiftlet_code swiftlet_mesh_from_bytes(const void* bytes, size_t byte_count, swiftlet_mesh** mesh,
                                                    swiftlet_error* error);
/// Writes a new file beside `path`, PATH.XXXX.part, then renames it. `written` receives its bytes and may be null.
SWIFTLET_API swiftlet_code swiftlet_mesh_save(const swiftlet_mesh* mesh, const char* path, uint64_t* written,
                                              swiftlet_error* error);
/// Makes the mesh without triangles and without the lower levels of nodes that `detail` allows to leave out.
SWIFTLET_API swiftlet_code swiftlet_mesh_cut(const swiftlet_mesh* mesh, const swiftlet_detail* detail, swiftlet_mesh** cut,
                                             swiftlet_error* error);
/// Tells, 1 or 0, whether a file begins as a mesh's does; 0 too if it cannot be read.
SWIFTLET_API swiftlet_code swiftlet_is_mesh_file(const char* path, int32_t* is_mesh, swiftlet_error* error);
/// Adds a reference, and returns the mesh; null: null.
SWIFTLET_API const swiftlet_mesh* swiftlet_mesh_retain(const swiftlet_mesh* mesh);
/// Takes a reference; the last one frees the mesh and all that points into it. Null: does nothing.
SWIFTLET_API void swiftlet_mesh_release(const swiftlet_mesh* mesh);

/// What a mesh is, and its topology, counted after equal points became one vertex. Size: at least up to `triangle_count`.
typedef struct swiftlet_mesh_info {
  uint32_t size;            ///< of this struct, set by the caller
  int32_t is_closed;        ///< 1 if the triangles bound a volume: what SWIFTLET_BODY_SOLID needs, of a mesh that is not cut
  uint64_t vertex_count;    ///< vertices kept; 0 of a mesh that was cut
  uint64_t triangle_count;  ///< as many as were given; 0 likewise
  double volume;            ///< enclosed, negative for a surface that is inside out; 0 unless closed
  double box_min[3];        ///< body frame: smallest coordinates
  double box_max[3];        ///< body frame: largest coordinates
  double extent;            ///< largest absolute coordinate
  double deviation;         ///< how far a point of a mesh that was cut may be from the surface; else 0
  uint64_t node_count;      ///< nodes of the tree
  uint64_t hull_count;      ///< nodes that have a convex hull
  int32_t is_whole;         ///< 1 unless the mesh was cut
  int32_t level_count;      ///< levels of nodes that the mesh has
  int32_t depth;            ///< levels of nodes of the whole tree
  uint32_t components;      ///< sets of triangles joined by common edges
  uint32_t open_edges;      ///< edges of a single triangle
  uint32_t non_manifold_edges;      ///< edges of more than two triangles
  uint32_t flipped_edges;           ///< edges that their two triangles run along in the same direction
  uint32_t flat_triangles;          ///< triangles whose corners lie on one line
  uint32_t duplicates;              ///< triangles with the corners of an earlier one
  uint32_t reserved;                ///< 0
  const uint32_t* source_vertex;    ///< per vertex, the user's point; lives as long as the mesh
  const uint32_t* source_triangle;  ///< per triangle, the user's triangle; likewise
} swiftlet_mesh_info;

/// Tells what a mesh is.
SWIFTLET_API swiftlet_code swiftlet_mesh_get_info(const swiftlet_mesh* mesh, swiftlet_mesh_info* info, swiftlet_error* error);
/// Tells how far a point of the mesh cut after so many levels, from 1 to depth - 1, may be from the surface.
SWIFTLET_API swiftlet_code swiftlet_mesh_deviation(const swiftlet_mesh* mesh, int32_t levels, double* deviation,
                                                   swiftlet_error* error);
/// Copies the coordinates of vertices [first, first + count), three each.
SWIFTLET_API swiftlet_code swiftlet_mesh_vertices(const swiftlet_mesh* mesh, size_t first, size_t count, double* vertices,
                                                  swiftlet_error* error);
/// Copies the vertices of triangles [first, first + count), three each.
SWIFTLET_API swiftlet_code swiftlet_mesh_triangles(const swiftlet_mesh* mesh, size_t first, size_t count, uint32_t* triangles,
                                                   swiftlet_error* error);
/// Shows the block, which is what swiftlet_mesh_save writes. It lives as long as the mesh.
SWIFTLET_API swiftlet_code swiftlet_mesh_get_bytes(const swiftlet_mesh* mesh, const void** bytes, size_t* byte_count,
                                                   swiftlet_error* error);
/// Hashes the block; equal blocks have equal hashes.
SWIFTLET_API swiftlet_code swiftlet_mesh_get_hash(const swiftlet_mesh* mesh, uint64_t* hash, swiftlet_error* error);

// ---- Bodies ----------------------------------------------------------------------------------------------------------------

/// What a body is made of.
enum {
  SWIFTLET_BODY_MODEL = 0,     ///< a convex hull at several levels of detail
  SWIFTLET_BODY_POINT = 1,     ///< points[0]; with a radius, a sphere
  SWIFTLET_BODY_SEGMENT = 2,   ///< points[0] to points[1]; with a radius, a capsule
  SWIFTLET_BODY_TRIANGLE = 3,  ///< points[0], [1], [2], in any order
  SWIFTLET_BODY_BOX = 4,       ///< smallest corner points[0], largest points[1]; parallel to the axes of the body's frame
  SWIFTLET_BODY_MESH = 5,      ///< the surface of a mesh
  SWIFTLET_BODY_SOLID = 6      ///< a closed mesh and the volume that it encloses
};

/// A body: the set of all points within `radius` of what it is made of. It borrows its model or mesh.
typedef struct swiftlet_body {
  uint32_t size;                ///< of this struct, set by the caller
  int32_t kind;                 ///< one of SWIFTLET_BODY_*
  double radius;                ///< 0 to 1e45, in the body's unit
  double points[3][3];          ///< of a primitive: coordinates in the body's frame
  const swiftlet_model* model;  ///< of SWIFTLET_BODY_MODEL
  const swiftlet_mesh* mesh;    ///< of SWIFTLET_BODY_MESH and SWIFTLET_BODY_SOLID
} swiftlet_body;

// ---- Options ---------------------------------------------------------------------------------------------------------------

/// Where a query starts: StartPolicy of C++.
enum {
  SWIFTLET_START_AUTOMATIC = 0,  ///< the seed's features, or the support maps, or the coarsest pair
  SWIFTLET_START_PAPER = 1,      ///< the seed's features, else the coarsest pair, never the maps
  SWIFTLET_START_FINEST = 2,     ///< the seed's features on level 0, without the hierarchy
  SWIFTLET_START_COARSEST = 3,   ///< the coarsest level pair, from the seed's features there
  SWIFTLET_START_TABLE = 4       ///< level 0, from the start tables or else the maps
};
/// By how many levels a query descends: Refinement of C++.
enum {
  SWIFTLET_REFINEMENT_SINGLE = 0,         ///< one level finer in one body
  SWIFTLET_REFINEMENT_SINGLE_SINGLE = 1,  ///< one level finer in both bodies; the default
  SWIFTLET_REFINEMENT_DOUBLE_DOUBLE = 2   ///< two levels finer in both bodies
};
/// Which violated Voronoi plane a step follows: PlaneRule of C++.
enum {
  SWIFTLET_PLANE_RULE_MOST_VIOLATED = 0,  ///< the nearest side that the point is beyond; the default
  SWIFTLET_PLANE_RULE_FIRST_VIOLATED = 1  ///< the first one found
};
/// Why a walk's own tests were not the proof: Doubt of C++.
enum {
  SWIFTLET_DOUBT_NONE = 0,        ///< they were
  SWIFTLET_DOUBT_NO_MINIMUM = 1,  ///< the walk got inside a body, stalled, or spent its budget
  SWIFTLET_DOUBT_NEIGHBOUR = 2,   ///< a neighbour is as high as the feature within rounding
  SWIFTLET_DOUBT_WIDTH = 3,       ///< the bounds are wider than law 2's
  SWIFTLET_DOUBT_LEAN = 4,        ///< the points lean against the plane
  SWIFTLET_DOUBT_THRESHOLD = 5,   ///< the distance is within law 2's bound of a threshold
  SWIFTLET_DOUBT_ASKED = 6        ///< the caller asked for the careful proof
};

/// Limits on a query. 8 bytes, which never change.
typedef struct swiftlet_budget {
  uint32_t steps;        ///< sum over all levels; not time
  int32_t finest_level;  ///< no level finer than this is read
} swiftlet_budget;

/// One level pair that a query visited. 40 bytes, which never change.
typedef struct swiftlet_level_record {
  int32_t level_a;       ///< the level of A
  int32_t level_b;       ///< the level of B
  double lower;          ///< proved so far for the bodies
  double upper;          ///< likewise
  uint32_t steps;        ///< work on this level pair
  uint32_t plane_tests;  ///< likewise
  int32_t doubt;         ///< one of SWIFTLET_DOUBT_*
  uint32_t reserved;     ///< 0
} swiftlet_level_record;

/// Up to four vertex pairs whose differences have the origin in their convex hull. 36 bytes, which never change.
typedef struct swiftlet_overlap_proof {
  uint32_t count;        ///< number of pairs; 0: nothing is proved
  uint32_t vertex_a[4];  ///< of A
  uint32_t vertex_b[4];  ///< of B
} swiftlet_overlap_proof;

/// Settings for experts: Tuning of C++. The answer is true with any. It never changes.
typedef struct swiftlet_tuning {
  int32_t start;                  ///< one of SWIFTLET_START_*
  int32_t refinement;             ///< one of SWIFTLET_REFINEMENT_*
  int32_t plane_rule;             ///< one of SWIFTLET_PLANE_RULE_*
  int32_t careful;                ///< not 0: prove bounds by support vertices even where the walk's own tests do
  swiftlet_level_record* trace;   ///< receives the level pairs visited, as many as the answer says; null: none. Not of batches
  size_t trace_count;             ///< records that `trace` has; if it is too short, its last one is overwritten
  swiftlet_overlap_proof* proof;  ///< receives the proof of an overlap; null: none. Not of batches
} swiftlet_tuning;

/// Options of a distance. Null: exact, without limits.
typedef struct swiftlet_options {
  uint32_t size;           ///< of this struct, set by the caller
  uint32_t reserved;       ///< 0
  double absolute;         ///< stop when upper - lower <= max(absolute, relative * (the bound nearer to 0)); the bodies' unit
  double relative;         ///< a fraction of the bound nearer to 0
  double beyond;           ///< stop when lower > beyond; the bodies' unit; the default is infinity
  swiftlet_budget budget;  ///< limits on the query
  swiftlet_tuning tuning;  ///< settings for experts
} swiftlet_options;

/// Options of a question of yes or no. Null: without limits.
typedef struct swiftlet_effort {
  uint32_t size;           ///< of this struct, set by the caller
  uint32_t reserved;       ///< 0
  swiftlet_budget budget;  ///< limits on the query
  swiftlet_tuning tuning;  ///< settings for experts
} swiftlet_effort;

/// Options of swiftlet_closest_features. Null: without limits.
typedef struct swiftlet_closest_options {
  uint32_t size;           ///< of this struct, set by the caller
  uint32_t steps;          ///< as of swiftlet_budget
  double beyond;           ///< stop when lower > beyond; the default is infinity
  swiftlet_tuning tuning;  ///< settings for experts
} swiftlet_closest_options;

/// Options of a manifold. Null: the defaults. Lengths are in the bodies' unit.
typedef struct swiftlet_manifold_options {
  uint32_t size;         ///< of this struct, set by the caller
  uint32_t most_points;  ///< 1 to 8; the default is 4
  double margin;         ///< points with a separation above this plus tolerance are left out; the default is 0
  double flatness;       ///< what counts as one face, relative to the body's extent; the default is 2^-21
} swiftlet_manifold_options;

/// Writes the defaults into a struct of `size` bytes.
SWIFTLET_API swiftlet_code swiftlet_options_init(swiftlet_options* options, size_t size, swiftlet_error* error);
/// Writes the defaults into a struct of `size` bytes.
SWIFTLET_API swiftlet_code swiftlet_effort_init(swiftlet_effort* effort, size_t size, swiftlet_error* error);
/// Writes the defaults into a struct of `size` bytes.
SWIFTLET_API swiftlet_code swiftlet_closest_options_init(swiftlet_closest_options* options, size_t size, swiftlet_error* error);
/// Writes the defaults into a struct of `size` bytes.
SWIFTLET_API swiftlet_code swiftlet_manifold_options_init(swiftlet_manifold_options* options, size_t size,
                                                          swiftlet_error* error);

// ---- Answers ---------------------------------------------------------------------------------------------------------------

/// How a query ended.
enum {
  SWIFTLET_STATUS_NOT_ASKED = 0,       ///< nothing is known: no query has written this answer, or a batch was stopped
  SWIFTLET_STATUS_CONVERGED = 1,       ///< the interval is as narrow as asked, or the verdict is proved
  SWIFTLET_STATUS_BEYOND = 2,          ///< stopped early because lower > beyond
  SWIFTLET_STATUS_BUDGET = 3,          ///< the query used up its steps; the interval is true
  SWIFTLET_STATUS_LEVEL_LIMIT = 4,     ///< a level that the tolerance needs is absent; the interval is true
  SWIFTLET_STATUS_NOT_CONVERGED = 5,   ///< the interval is true but wider than asked
  SWIFTLET_STATUS_INVALID_POSE = 6,    ///< the pose is not finite, too far or not orthonormal to 1e-6: nothing is known
  SWIFTLET_STATUS_INVALID_RADIUS = 7,  ///< a radius is not a number from 0 to 1e45, or not that of the answer to refine
  SWIFTLET_STATUS_INVALID_BODY = 8     ///< a primitive has a coordinate that no model may have, or a solid is not closed
};
/// What is proved about the two bodies as closed sets.
enum {
  SWIFTLET_VERDICT_UNDECIDED = 0,   ///< none of the others
  SWIFTLET_VERDICT_DISJOINT = 1,    ///< lower > 0
  SWIFTLET_VERDICT_TOUCHING = 2,    ///< the signed distance is within tolerance of 0
  SWIFTLET_VERDICT_OVERLAPPING = 3  ///< the bodies share a point
};
/// Whether a distance is at most a threshold.
enum {
  SWIFTLET_DECISION_UNDECIDED = 0,  ///< the interval contains the threshold
  SWIFTLET_DECISION_NO = 1,         ///< proved: lower > threshold
  SWIFTLET_DECISION_YES = 2         ///< proved: upper <= threshold
};

/// The result of a query: Answer of C++. A number that means nothing is NaN, a feature that means nothing 0. Size: at least up
/// to `upper`; all of it where a function reads an answer.
typedef struct swiftlet_answer {
  uint32_t size;               ///< of this struct, set by the caller
  int32_t status;              ///< one of SWIFTLET_STATUS_*
  int32_t verdict;             ///< one of SWIFTLET_VERDICT_*
  int32_t is_signed;           ///< 1: the bounds are of the signed distance
  double lower;                ///< proved bound on the distance
  double upper;                ///< likewise
  double normal[3];            ///< unit, from A to B
  double point_a[3];           ///< the witness point of A
  double point_b[3];           ///< the witness point of B
  swiftlet_feature feature_a;  ///< on `level_a`, holds `point_a`
  swiftlet_feature feature_b;  ///< on `level_b`, holds `point_b`
  int32_t level_a;             ///< the level that answered
  int32_t level_b;             ///< likewise
  uint32_t steps;              ///< work
  uint32_t plane_tests;        ///< likewise
  double radius_a;             ///< of the body asked about
  double radius_b;             ///< likewise
  uint32_t levels_visited;     ///< level pairs: the records that a complete trace has
  uint32_t reserved;           ///< 0
} swiftlet_answer;

/// A nearest feature by the user's own ids: SourceFeature of C++. All members are written.
typedef struct swiftlet_source {
  uint32_t size;              ///< of this struct, set by the caller
  int32_t kind;               ///< one of SWIFTLET_FEATURE_*; NONE if the answer is not on level 0
  uint32_t vertices[2];       ///< the vertex, or both ends of the edge; else SWIFTLET_NO_INDEX
  const uint32_t* triangles;  ///< the triangles of the face; lives as long as the model or mesh
  size_t triangle_count;      ///< none or several
} swiftlet_source;

/// One pair of a batch. All members are read.
typedef struct swiftlet_pair {
  uint32_t size;           ///< of this struct, set by the caller
  uint32_t reserved;       ///< 0
  const swiftlet_body* a;  ///< pairs may share bodies
  const swiftlet_body* b;  ///< likewise
  swiftlet_pose b_in_a;    ///< maps B's frame into A's
  swiftlet_seed* seed;     ///< no two pairs of a batch may share one; null: the query starts cold
} swiftlet_pair;

// ---- One pair --------------------------------------------------------------------------------------------------------------

// Bodies may be convex or meshes. `seed`, `options` and `effort` may be null. Queries without a trace allocate nothing.
// A call that fails may, even where `error` is null.

/// Gives the distance: exact by default, or within the errors of `options`.
SWIFTLET_API swiftlet_code swiftlet_distance(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                             swiftlet_seed* seed, const swiftlet_options* options, swiftlet_answer* answer,
                                             swiftlet_error* error);
/// Goes on from `so_far`, the answer of any query about the same convex bodies and pose, to the precision that `options` asks
/// for. Meshes: SWIFTLET_BAD_VALUE. `so_far` and `answer` may be the same.
SWIFTLET_API swiftlet_code swiftlet_refine(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                           const swiftlet_answer* so_far, swiftlet_seed* seed, const swiftlet_options* options,
                                           swiftlet_answer* answer, swiftlet_error* error);
/// Gives the signed distance: where the bodies overlap, minus the depth.
SWIFTLET_API swiftlet_code swiftlet_signed_distance(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                                    swiftlet_seed* seed, const swiftlet_options* options,
                                                    swiftlet_answer* answer, swiftlet_error* error);
/// Decides whether the bodies share a point: read the answer's verdict.
SWIFTLET_API swiftlet_code swiftlet_intersects(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                               swiftlet_seed* seed, const swiftlet_effort* effort, swiftlet_answer* answer,
                                               swiftlet_error* error);
/// Decides whether the distance is at most `threshold` (>= 0): one of SWIFTLET_DECISION_*. `answer` may be null.
SWIFTLET_API swiftlet_code swiftlet_within(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                           double threshold, swiftlet_seed* seed, const swiftlet_effort* effort,
                                           int32_t* decision, swiftlet_answer* answer, swiftlet_error* error);
/// Decides whether the signed distance is at most `threshold`. `answer` may be null.
SWIFTLET_API swiftlet_code swiftlet_signed_within(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                                  double threshold, swiftlet_seed* seed, const swiftlet_effort* effort,
                                                  int32_t* decision, swiftlet_answer* answer, swiftlet_error* error);
/// Gives the nearest features and the user's ids of them. `source_a` and `source_b` may be null.
SWIFTLET_API swiftlet_code swiftlet_closest_features(const swiftlet_body* a, const swiftlet_body* b,
                                                     const swiftlet_pose* b_in_a, swiftlet_seed* seed,
                                                     const swiftlet_closest_options* options, swiftlet_answer* answer,
                                                     swiftlet_source* source_a, swiftlet_source* source_b,
                                                     swiftlet_error* error);
/// Gives law 2's bound for this pair; NaN where a query refuses the bodies or the pose.
SWIFTLET_API swiftlet_code swiftlet_tolerance(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                              double* tolerance, swiftlet_error* error);

// ---- Many pairs ------------------------------------------------------------------------------------------------------------

// Each writes the answer of pair i to answers[i], and decisions[i] or sources. Answers are those of the same queries asked one
// after the other, bit for bit, on any executor. A task is 32 pairs. `options`, `effort` and `run` may be null, and what may be
// null of one pair. SWIFTLET_CANCELLED if `run` stopped the batch: what was not asked has the status NOT_ASKED, and the
// decision UNDECIDED. If a pair is refused, as one with a null body, the error names it, and other answers may be written.

/// Asks swiftlet_distance for each pair.
SWIFTLET_API swiftlet_code swiftlet_distance_pairs(const swiftlet_pair* pairs, size_t count, const swiftlet_options* options,
                                                   const swiftlet_run* run, swiftlet_answer* answers, swiftlet_error* error);
/// Asks swiftlet_signed_distance for each pair.
SWIFTLET_API swiftlet_code swiftlet_signed_distance_pairs(const swiftlet_pair* pairs, size_t count,
                                                          const swiftlet_options* options, const swiftlet_run* run,
                                                          swiftlet_answer* answers, swiftlet_error* error);
/// Asks swiftlet_intersects for each pair.
SWIFTLET_API swiftlet_code swiftlet_intersects_pairs(const swiftlet_pair* pairs, size_t count, const swiftlet_effort* effort,
                                                     const swiftlet_run* run, swiftlet_answer* answers, swiftlet_error* error);
/// Asks swiftlet_within for each pair.
SWIFTLET_API swiftlet_code swiftlet_within_pairs(const swiftlet_pair* pairs, size_t count, double threshold,
                                                 const swiftlet_effort* effort, const swiftlet_run* run, int32_t* decisions,
                                                 swiftlet_answer* answers, swiftlet_error* error);
/// Asks swiftlet_signed_within for each pair.
SWIFTLET_API swiftlet_code swiftlet_signed_within_pairs(const swiftlet_pair* pairs, size_t count, double threshold,
                                                        const swiftlet_effort* effort, const swiftlet_run* run,
                                                        int32_t* decisions, swiftlet_answer* answers, swiftlet_error* error);
/// Asks swiftlet_closest_features for each pair.
SWIFTLET_API swiftlet_code swiftlet_closest_features_pairs(const swiftlet_pair* pairs, size_t count,
                                                           const swiftlet_closest_options* options, const swiftlet_run* run,
                                                           swiftlet_answer* answers, swiftlet_source* sources_a,
                                                           swiftlet_source* sources_b, swiftlet_error* error);

// ---- One pair in many poses ------------------------------------------------------------------------------------------------

// Each writes the answer in pose i to answers[i]. Poses are cut into chunks of SWIFTLET_POSES_PER_CHUNK; within a chunk each
// query starts from the seed of the one before, the first one cold, so that answers do not depend on the executor. A task is a
// chunk.

/// Poses in a chunk.
enum { SWIFTLET_POSES_PER_CHUNK = 1024 /**< the last chunk may have fewer */ };

/// Asks swiftlet_distance in each pose.
SWIFTLET_API swiftlet_code swiftlet_distance_poses(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                                   size_t count, const swiftlet_options* options, const swiftlet_run* run,
                                                   swiftlet_answer* answers, swiftlet_error* error);
/// Asks swiftlet_signed_distance in each pose.
SWIFTLET_API swiftlet_code swiftlet_signed_distance_poses(const swiftlet_body* a, const swiftlet_body* b,
                                                          const swiftlet_pose* b_in_a, size_t count,
                                                          const swiftlet_options* options, const swiftlet_run* run,
                                                          swiftlet_answer* answers, swiftlet_error* error);
/// Asks swiftlet_intersects in each pose.
SWIFTLET_API swiftlet_code swiftlet_intersects_poses(const swiftlet_body* a, const swiftlet_body* b,
                                                     const swiftlet_pose* b_in_a, size_t count, const swiftlet_effort* effort,
                                                     const swiftlet_run* run, swiftlet_answer* answers, swiftlet_error* error);
/// Asks swiftlet_within in each pose.
SWIFTLET_API swiftlet_code swiftlet_within_poses(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                                 size_t count, double threshold, const swiftlet_effort* effort,
                                                 const swiftlet_run* run, int32_t* decisions, swiftlet_answer* answers,
                                                 swiftlet_error* error);
/// Asks swiftlet_signed_within in each pose.
SWIFTLET_API swiftlet_code swiftlet_signed_within_poses(const swiftlet_body* a, const swiftlet_body* b,
                                                        const swiftlet_pose* b_in_a, size_t count, double threshold,
                                                        const swiftlet_effort* effort, const swiftlet_run* run,
                                                        int32_t* decisions, swiftlet_answer* answers, swiftlet_error* error);
/// Asks swiftlet_closest_features in each pose.
SWIFTLET_API swiftlet_code swiftlet_closest_features_poses(const swiftlet_body* a, const swiftlet_body* b,
                                                           const swiftlet_pose* b_in_a, size_t count,
                                                           const swiftlet_closest_options* options, const swiftlet_run* run,
                                                           swiftlet_answer* answers, swiftlet_source* sources_a,
                                                           swiftlet_source* sources_b, swiftlet_error* error);

// ---- Contact ---------------------------------------------------------------------------------------------------------------

/// A place of contact: ManifoldPoint of C++. 64 bytes, which never change.
typedef struct swiftlet_manifold_point {
  double point_a[3];           ///< in A
  double point_b[3];           ///< in B: point_a + separation * normal
  double separation;           ///< along the normal; negative where the bodies overlap
  swiftlet_feature feature_a;  ///< of A that `point_a` lies on
  swiftlet_feature feature_b;  ///< of B that `point_b` lies on
} swiftlet_manifold_point;

/// The area in which two bodies face each other: Manifold of C++. All members are read and written.
typedef struct swiftlet_manifold {
  uint32_t size;                      ///< of this struct, set by the caller
  uint32_t count;                     ///< number of points; 0: no contact
  double normal[3];                   ///< unit, from A to B
  swiftlet_feature face_a;            ///< the contact face of A, 0 where A has none
  swiftlet_feature face_b;            ///< that of B
  swiftlet_manifold_point points[8];  ///< [0, count): around the area, the one of least separation first
} swiftlet_manifold;

/// Gives the contact points of two convex bodies around `answer`, an exact answer about them in this pose. `options` and
/// `previous`, the pair's last manifold, may be null; `previous` may be `manifold` itself. Meshes: SWIFTLET_BAD_VALUE, for they
/// have swiftlet_contact_manifold.
SWIFTLET_API swiftlet_code swiftlet_contact_points(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                                   const swiftlet_answer* answer, const swiftlet_manifold_options* options,
                                                   const swiftlet_manifold* previous, swiftlet_manifold* manifold,
                                                   swiftlet_error* error);

/// A region where two surfaces are within reach of each other: MeshContact of C++. All members are read and written.
typedef struct swiftlet_contact {
  uint32_t size;               ///< of this struct, set by the caller
  int32_t verdict;             ///< one of SWIFTLET_VERDICT_*
  double lower;                ///< proved bound on the bodies' distance in the region
  double upper;                ///< likewise
  swiftlet_feature feature_a;  ///< of the nearest point
  swiftlet_feature feature_b;  ///< likewise
  uint32_t triangle_a;         ///< of the nearest pair; of a convex body 0
  uint32_t triangle_b;         ///< likewise
  double point_a[3];           ///< A's nearest point; of a crossing, one of it
  double point_b[3];           ///< B's
  double normal[3];            ///< unit, from A to B; NaN where triangles cross
  double box_min[3];           ///< the region's box: smallest coordinates
  double box_max[3];           ///< largest coordinates
} swiftlet_contact;

/// What swiftlet_contacts found: MeshContacts of C++. All members are written.
typedef struct swiftlet_contact_list {
  uint32_t size;       ///< of this struct, set by the caller
  int32_t status;      ///< CONVERGED: all regions are stored; BUDGET: not all are; LEVEL_LIMIT: a mesh was cut, and nothing is
                       ///< stored, or a model lacks level 0, and regions are those of its finest level; else as of queries
  int32_t is_counted;  ///< 1: `count` is the number of regions
  uint32_t count;      ///< regions in all; unless `is_counted`, as many as were told apart
  uint32_t stored;     ///< regions that the array holds
  uint32_t steps;      ///< pairs of nodes that were opened
  uint32_t plane_tests;  ///< pairs of triangles that were looked at
  uint32_t reserved;     ///< 0
} swiftlet_contact_list;

/// Finds every region where the bodies are within `reach` (>= 0) of each other, nearest first. `contacts` has room for
/// `capacity`; if there are more, it gets the nearest ones; it may be null if `capacity` is 0. `budget` may be null. Allocates
/// 160 bytes for each contact that there is room for.
SWIFTLET_API swiftlet_code swiftlet_contacts(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                             double reach, const swiftlet_budget* budget, swiftlet_contact* contacts,
                                             size_t capacity, swiftlet_contact_list* found, swiftlet_error* error);
/// Gives the points of a region that swiftlet_contacts found about the same bodies in the same pose. `options` and `previous`
/// may be null.
SWIFTLET_API swiftlet_code swiftlet_contact_manifold(const swiftlet_body* a, const swiftlet_body* b,
                                                     const swiftlet_pose* b_in_a, const swiftlet_contact* contact,
                                                     const swiftlet_manifold_options* options,
                                                     const swiftlet_manifold* previous, swiftlet_manifold* manifold,
                                                     swiftlet_error* error);

// ---- Trust -----------------------------------------------------------------------------------------------------------------

/// The result of a check: Check of C++. Size: at least 16; `message` goes as far as the size says.
typedef struct swiftlet_check_result {
  uint32_t size;      ///< of this struct, set by the caller
  int32_t ok;         ///< 1: the certificate holds
  char message[504];  ///< what failed first, with numbers; empty when ok; ends with 0
} swiftlet_check_result;

/// What an answer is one to, as far as it does not tell itself: Question of C++.
enum {
  SWIFTLET_QUESTION_ANY = 0,   ///< any question
  SWIFTLET_QUESTION_EXACT = 1  ///< a distance, a signed distance or closest features without an allowed error
};

/// Recomputes what `answer` claims by brute force; of convex bodies, where `asked` is SWIFTLET_QUESTION_EXACT, also that it is
/// as narrow and its points as near as such an answer promises. `proof`, which convex bodies alone have, may be null.
SWIFTLET_API swiftlet_code swiftlet_check(const swiftlet_body* a, const swiftlet_body* b, const swiftlet_pose* b_in_a,
                                          const swiftlet_answer* answer, int32_t asked, const swiftlet_overlap_proof* proof,
                                          swiftlet_check_result* result, swiftlet_error* error);
/// Proves all that a model file claims.
SWIFTLET_API swiftlet_code swiftlet_model_verify(const swiftlet_model* model, swiftlet_check_result* result,
                                                 swiftlet_error* error);
/// Proves all that a mesh file claims.
SWIFTLET_API swiftlet_code swiftlet_mesh_verify(const swiftlet_mesh* mesh, swiftlet_check_result* result,
                                                swiftlet_error* error);

// ---- Below the queries -----------------------------------------------------------------------------------------------------

/// How a march ended: MarchStatus of C++.
enum {
  SWIFTLET_MARCH_DISJOINT = 0,       ///< the interval is as narrow as asked, and lower > 0
  SWIFTLET_MARCH_TOUCHING = 1,       ///< the signed distance is within tolerance of 0
  SWIFTLET_MARCH_OVERLAPPING = 2,    ///< proved; lower = upper = 0
  SWIFTLET_MARCH_NEAR = 3,           ///< the interval is as narrow as asked and lower = 0
  SWIFTLET_MARCH_BEYOND = 4,         ///< stopped because lower > beyond
  SWIFTLET_MARCH_BUDGET = 5,         ///< the budget ended the march
  SWIFTLET_MARCH_NOT_CONVERGED = 6,  ///< none of the above could be proved
  SWIFTLET_MARCH_INVALID_POSE = 7    ///< bounds are 0 and infinity
};

/// When a march stops: MarchRule of C++. Null: exact.
typedef struct swiftlet_march_rule {
  uint32_t size;         ///< of this struct, set by the caller
  uint32_t step_budget;  ///< steps of the walk
  double absolute;       ///< the bodies' unit
  double relative;       ///< a fraction
  double beyond;         ///< the bodies' unit; 0: ask only whether they are apart; the default is infinity
  double floor;          ///< a lower bound already proved
  int32_t plane_rule;    ///< one of SWIFTLET_PLANE_RULE_*
  int32_t careful;       ///< not 0: for tests
} swiftlet_march_rule;

/// Writes the defaults into a struct of `size` bytes.
SWIFTLET_API swiftlet_code swiftlet_march_rule_init(swiftlet_march_rule* rule, size_t size, swiftlet_error* error);

/// The result of a march: MarchResult of C++. Size: at least up to `upper`.
typedef struct swiftlet_march_result {
  uint32_t size;                 ///< of this struct, set by the caller
  int32_t status;                ///< one of SWIFTLET_MARCH_*
  swiftlet_feature a;            ///< where the march ended; with `b` it can start the next one
  swiftlet_feature b;            ///< of B
  double lower;                  ///< proved bound on the distance
  double upper;                  ///< likewise
  double normal[3];              ///< unit, A's frame, from A to B; or 0
  double point_a[3];             ///< the witness point of A, in A's frame
  double point_b[3];             ///< of B, in A's frame
  uint32_t steps;                ///< changes of feature
  uint32_t plane_tests;          ///< planes and support comparisons evaluated
  int32_t doubt;                 ///< one of SWIFTLET_DOUBT_*
  swiftlet_overlap_proof proof;  ///< filled where the status is OVERLAPPING
} swiftlet_march_result;

/// Marches from two features, 0 for the default start, on one level of each model. An absent level is SWIFTLET_BAD_VALUE.
/// `rule` may be null. Allocates nothing.
SWIFTLET_API swiftlet_code swiftlet_march(const swiftlet_model* a, int32_t level_a, const swiftlet_model* b, int32_t level_b,
                                          const swiftlet_pose* b_in_a, swiftlet_feature start_a, swiftlet_feature start_b,
                                          const swiftlet_march_rule* rule, swiftlet_march_result* result,
                                          swiftlet_error* error);

#ifdef __cplusplus
}
#endif

#endif  // SWIFTLET_SWIFTLET_H
