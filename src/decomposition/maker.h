/* maker.h: a decomposition under construction: declarations shared by the files of this folder.
 *
 *   maker.c         the shape's rings on the lattice; lists of pieces and Steiner points; the final decomposition
 *   ray_shooting.c  rays through a triangulated polygon, and the vertices visible from one of its vertices
 *   by_diagonals.c  decompositions by diagonals: triangulation; Hertel-Mehlhorn, also by length
 *   cuts.c          makes pieces from cuts
 *   vertical.c      vertical cuts
 *   bisector.c      cuts near the bisectors of reflex vertices (direction.c selects their directions)
 *   optimal.c       diagonals of least number or total weight, by dynamic programming
 *   mixed.c         two operands together */
#ifndef SUNDER_I_MAKER_H
#define SUNDER_I_MAKER_H

#include "decomposition/decomposition.h"
#include "shape/build.h"

typedef struct sunder_i_maker {
    sunder_i_lattice *lattice;
    const sunder_shape *shape;
    sunder_i_rings rings;   /* the shape's rings, with its vertices on the lattice */
    sunder_i_arena scratch; /* memory for one polygon at a time; `failed` is set by all functions on failure */
    uint32_t fallbacks;
    uint32_t polygon; /* the current polygon */
    /* the pieces so far */
    uint32_t pieces, sides, steiner_n;
    uint32_t *piece_end, *piece_corner, *member;
    sunder_i_point *along;
    sunder_i_rational_point *steiner; /* with numbers in the lattice's arena, not yet in lowest terms */
    size_t pieces_room, member_room, corner_room, along_room, steiner_room;
} sunder_i_maker;

/* A polygon of the shape: its rings, and its vertices, which have consecutive numbers. */
typedef struct sunder_i_member {
    uint32_t ring_lo, ring_hi, first, n, reflex;
} sunder_i_member;

/* ---- maker.c ---- */

bool sunder_i_maker_init(sunder_i_maker *m, sunder_i_lattice *lattice, const sunder_shape *shape,
                         const sunder_i_point *at);
void sunder_i_maker_free(sunder_i_maker *m);
sunder_i_member sunder_i_maker_member(const sunder_i_maker *m, uint32_t polygon);
/* Adds a polygon without reflex vertices as one piece. */
void sunder_i_maker_add_whole(sunder_i_maker *m, const sunder_i_member *member);
/* Add a piece side by side, counterclockwise: a side's first corner and its vector. Corners that are straight are
 * omitted by end_piece(). */
void sunder_i_maker_add_side(sunder_i_maker *m, uint32_t corner, sunder_i_point along);
void sunder_i_maker_end_piece(sunder_i_maker *m);
/* Adds a piece whose corners are the given vertices of the shape. */
void sunder_i_maker_add_vertices(sunder_i_maker *m, const uint32_t *vertex, uint32_t n);
/* Adds the corner at a + t (b - a), and returns its number. */
uint32_t sunder_i_maker_add_steiner(sunder_i_maker *m, sunder_i_point a, sunder_i_point b, const sunder_i_fraction *t);
bool sunder_i_maker_failed(const sunder_i_maker *m);
/* Makes the result in *out. Returns false if out of memory; then *out has no memory. */
bool sunder_i_maker_finish(sunder_i_maker *m, sunder_i_decomposition *out);

static inline bool sunder_i_is_reflex(const sunder_i_rings *r, uint32_t v)
{
    return sunder_i_rings_orient(r, r->prev[v], v, r->next[v]) < 0;
}

/* ---- ray_shooting.c ---- */

/* The state for rays and visibility in a triangulated polygon. */
typedef struct sunder_i_ray_shooting {
    const sunder_i_rings *r;
    sunder_i_mesh mesh;
    uint32_t first, n;
    uint32_t *start; /* [n] the half-edge from vertex first + i to the next one */
    /* the vertices found by the last call of sunder_i_ray_shooting_visible(), in no order */
    uint32_t *seen, seen_n;
    size_t seen_room;
    struct sunder_i_window *stack;
    size_t stack_room;
} sunder_i_ray_shooting;

/* The first element that a ray meets: the vertex `which`, or the interior of the edge that leaves it. which is
 * SUNDER_I_NONE if out of memory. */
typedef struct sunder_i_hit {
    bool at_vertex;
    uint32_t which;
} sunder_i_hit;

/* Prepares the state; the mesh is allocated in the arena. Returns false if out of memory. */
bool sunder_i_ray_shooting_init(sunder_i_ray_shooting *s, const sunder_i_rings *r, const sunder_i_member *member,
                                sunder_i_arena *arena);
void sunder_i_ray_shooting_free(sunder_i_ray_shooting *s);
/* Returns the first element on the ray from vertex v through `toward`, which must be in a direction strictly inside the
 * sector of v. A vertex that the ray only grazes counts. */
sunder_i_hit sunder_i_ray_shooting_shoot(const sunder_i_ray_shooting *s, uint32_t v, sunder_i_point toward);
/* Lists in s->seen the vertices w for which the open segment vw is inside and meets no vertex, including the neighbours
 * of v. If cone is not NULL, at least those with cross(cone[0], w - v) >= 0 and cross(w - v, cone[1]) >= 0 are listed.
 * Returns false if out of memory. */
bool sunder_i_ray_shooting_visible(sunder_i_ray_shooting *s, uint32_t v, const sunder_i_point *cone);

/* ---- cuts.c ---- */

/* A cut leads from a vertex along a lattice vector to a vertex, or to the interior of an edge or of another cut. It
 * divides the sector of the vertex where it starts, and that of the vertex where it ends. */
typedef enum sunder_i_cut_end { SUNDER_I_AT_VERTEX, SUNDER_I_ON_EDGE, SUNDER_I_ON_CUT } sunder_i_cut_end;

typedef struct sunder_i_cut {
    uint32_t from;
    sunder_i_point toward, along; /* toward = the position of `from` + along */
    sunder_i_cut_end end;
    uint32_t at;              /* the vertex; or the edge's first vertex; or the number of the cut */
    sunder_i_fraction length; /* in units of `along` */
    sunder_i_fraction on;     /* the position of the end on the edge, or on the cut, in units of its vector; not set for
                               * AT_VERTEX */
} sunder_i_cut;

/* Sets the end of a cut, whose beginning and direction are set, on the polygon's rings. Returns false if out of
 * memory. */
bool sunder_i_cut_run(sunder_i_cut *cut, const sunder_i_ray_shooting *rays);
/* Adds the pieces into which the cuts divide the polygon; none of them may be reflex. */
void sunder_i_cuts_apply(sunder_i_maker *m, const sunder_i_member *member, const sunder_i_cut *cut, uint32_t n);
/* Compares a and b by the counterclockwise angle from the vector ref, in [0, 2 pi). */
int sunder_i_around(sunder_i_lattice *lattice, sunder_i_point ref, sunder_i_point a, sunder_i_point b);

/* ---- The methods ---- */

void sunder_i_make_shape_pieces(sunder_i_maker *m); /* all polygons at once */
/* Adds the faces of a mesh as pieces; destroys the mesh. */
void sunder_i_maker_add_faces(sunder_i_maker *m, sunder_i_mesh *mesh);
void sunder_i_make_triangles(sunder_i_maker *m, const sunder_i_member *member);
/* Hertel and Mehlhorn's merging, with the longest diagonals first: *mesh becomes the rest of the triangulation, in the
 * maker's scratch memory; the number of its diagonals is added to *diagonals and their total length to *sum. Failures
 * are stored in the maker. */
void sunder_i_mesh_short(sunder_i_maker *m, const sunder_i_member *member, sunder_i_mesh *mesh, uint32_t *diagonals,
                         double *sum);
void sunder_i_make_vertical(sunder_i_maker *m, const sunder_i_member *member);
void sunder_i_make_bisector(sunder_i_maker *m, const sunder_i_member *member);

/* ---- direction.c ---- */

/* Returns a vector in the open cone that opens counterclockwise by less than pi from a to b, near its bisector and with
 * small integers; or a itself (on the cone's boundary) if no vector with small integers is inside. */
sunder_i_point sunder_i_direction_within(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b);
/* Returns the length of the vector u, with an error of a few ulps, in units of 2^*exponent, so that it is never out of
 * range. unit becomes the approximate coordinates of u divided by its length. */
double sunder_i_direction_unit(sunder_i_lattice *lattice, sunder_i_point u, double unit[2], long *exponent);

/* ---- optimal.c ---- */

/* A polygon without holes, prepared for dynamic programming over its diagonals; see optimal.c. */
typedef struct sunder_i_program sunder_i_program;

/* Returns NULL if out of memory. Most of the memory is the maker's scratch memory; sunder_i_program_free() frees the
 * rest. */
sunder_i_program *sunder_i_program_new(sunder_i_maker *m, const sunder_i_member *member);
/* Selects diagonals of least total weight, where the weight of each is `each` + `by_length` * its length; each > 0,
 * by_length >= 0. *diagonals becomes their number, *length their total length. Returns false if out of memory. */
bool sunder_i_program_solve(sunder_i_program *program, double each, double by_length, uint32_t *diagonals,
                            double *length);
/* Adds the pieces of the last solution. */
void sunder_i_program_emit(const sunder_i_program *program, sunder_i_maker *m);
void sunder_i_program_free(sunder_i_program *program);

/* Returns true if dynamic programming is applicable to the polygon. */
static inline bool sunder_i_has_program(const sunder_i_member *member)
{
    return member->ring_hi - member->ring_lo == 1 && member->n <= SUNDER_I_OPTIMAL_MOST;
}

/* ---- mixed.c ---- */

/* Decomposes both operands; failures are stored in the makers. */
void sunder_i_make_mixed(sunder_i_maker *p, sunder_i_maker *q);

#endif
