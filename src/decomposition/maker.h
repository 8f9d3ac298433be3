/* A decomposition in the making: what the stages hand each other.
 *
 * maker.c         the shape's rings on the lattice; pieces and Steiner points as they come; everything into its place
 *                 at the end
 * ray_shooting.c  rays through a triangulated member, and the vertices seen from one of its vertices
 * by_diagonals.c  decompositions by diagonals: triangulation; Hertel-Mehlhorn, by length too
 * cuts.c          cuts -> pieces
 * vertical.c      vertical cuts
 * bisector.c      cuts near the bisectors of reflex vertices (direction.c chooses them)
 * optimal.c       fewest or lightest diagonals, by dynamic programming
 * mixed.c         two operands together */
#ifndef SUNDER_I_MAKER_H
#define SUNDER_I_MAKER_H

#include "decomposition/decomposition.h"
#include "shape/build.h"

typedef struct sunder_i_maker {
    sunder_i_lattice *lattice;
    const sunder_shape *shape;
    sunder_i_rings rings;   /* the shape's, its vertices on the lattice */
    sunder_i_arena scratch; /* of one member at a time; `failed` is the sticky error of all stages */
    uint32_t fallbacks;
    uint32_t polygon; /* the member in hand */
    /* pieces so far */
    uint32_t pieces, sides, steiner_n;
    uint32_t *piece_end, *piece_corner, *member;
    sunder_i_point *along;
    sunder_i_rational_point *steiner; /* on the lattice's arena, not yet reduced */
    size_t pieces_room, member_room, corner_room, along_room, steiner_room;
} sunder_i_maker;

/* A member: its rings and its vertices, which are numbered on end. */
typedef struct sunder_i_member {
    uint32_t ring_lo, ring_hi, first, n, reflex;
} sunder_i_member;

/* ---- maker.c ---- */

bool sunder_i_maker_init(sunder_i_maker *m, sunder_i_lattice *lattice, const sunder_shape *shape,
                         const sunder_i_point *at);
void sunder_i_maker_free(sunder_i_maker *m);
sunder_i_member sunder_i_maker_member(const sunder_i_maker *m, uint32_t polygon);
/* A member without reflex vertices is a piece. */
void sunder_i_maker_add_whole(sunder_i_maker *m, const sunder_i_member *member);
/* Pieces are added side by side, counter-clockwise: the corner where the side starts and its vector. Corners that
 * turn out straight are left out. */
void sunder_i_maker_add_side(sunder_i_maker *m, uint32_t corner, sunder_i_point along);
void sunder_i_maker_end_piece(sunder_i_maker *m);
/* A piece with these vertices of the shape for corners. */
void sunder_i_maker_add_vertices(sunder_i_maker *m, const uint32_t *vertex, uint32_t n);
/* The number of a new corner: the point a + t (b - a). */
uint32_t sunder_i_maker_add_steiner(sunder_i_maker *m, sunder_i_point a, sunder_i_point b, const sunder_i_fraction *t);
bool sunder_i_maker_failed(const sunder_i_maker *m);
/* Puts the result together; false if memory is out, with nothing kept. */
bool sunder_i_maker_finish(sunder_i_maker *m, sunder_i_decomposition *out);

static inline bool sunder_i_is_reflex(const sunder_i_rings *r, uint32_t v)
{
    return sunder_i_rings_orient(r, r->prev[v], v, r->next[v]) < 0;
}

/* ---- ray_shooting.c ---- */

/* A triangulated member. */
typedef struct sunder_i_ray_shooting {
    const sunder_i_rings *r;
    sunder_i_mesh mesh;
    uint32_t first, n;
    uint32_t *start; /* [n] the half-edge first + i -> next */
    /* the vertices seen by the last sunder_i_ray_shooting_visible(), in no order */
    uint32_t *seen, seen_n;
    size_t seen_room;
    struct sunder_i_window *stack;
    size_t stack_room;
} sunder_i_ray_shooting;

/* What a ray runs into first: a vertex, or the inside of the edge that leaves vertex `which`. which is NONE where
 * memory is out. */
typedef struct sunder_i_hit {
    bool at_vertex;
    uint32_t which;
} sunder_i_hit;

/* The mesh lives in the arena. False if memory is out. */
bool sunder_i_ray_shooting_init(sunder_i_ray_shooting *s, const sunder_i_rings *r, const sunder_i_member *member,
                                sunder_i_arena *arena);
void sunder_i_ray_shooting_free(sunder_i_ray_shooting *s);
/* From vertex v through `toward`, a direction strictly inside v's sector. A vertex that the ray only grazes is one
 * that it runs into. */
sunder_i_hit sunder_i_ray_shooting_shoot(const sunder_i_ray_shooting *s, uint32_t v, sunder_i_point toward);
/* The vertices w such that the open segment vw runs inside and meets no vertex, v's neighbours included. With `cone`
 * (two vectors) at least those with cross(cone[0], w - v) >= 0 and cross(w - v, cone[1]) >= 0. False if memory is
 * out. */
bool sunder_i_ray_shooting_visible(sunder_i_ray_shooting *s, uint32_t v, const sunder_i_point *cone);

/* ---- cuts.c ---- */

/* A cut runs from a vertex along a lattice vector to a vertex, or into the inside of an edge or of another cut. It
 * divides its vertex's sector where it starts, and the other's where it ends. */
typedef enum sunder_i_cut_end { SUNDER_I_AT_VERTEX, SUNDER_I_ON_EDGE, SUNDER_I_ON_CUT } sunder_i_cut_end;

typedef struct sunder_i_cut {
    uint32_t from;
    sunder_i_point toward, along; /* toward = from's place + along */
    sunder_i_cut_end end;
    uint32_t at;              /* the vertex; the edge's first vertex; the number of the cut */
    sunder_i_fraction length; /* in units of along */
    sunder_i_fraction on;     /* where on the edge, or on the cut, in units of its vector; not of AT_VERTEX */
} sunder_i_cut;

/* From what the cut starts with, its end on the member's rings. False where memory is out. */
bool sunder_i_cut_run(sunder_i_cut *cut, const sunder_i_ray_shooting *rays);
/* The pieces into which the cuts divide the member; none of them is reflex. */
void sunder_i_cuts_apply(sunder_i_maker *m, const sunder_i_member *member, const sunder_i_cut *cut, uint32_t n);
/* Order of a and b by counter-clockwise angle from the vector ref, in [0, 2 pi). */
int sunder_i_around(sunder_i_lattice *lattice, sunder_i_point ref, sunder_i_point a, sunder_i_point b);

/* ---- The ways ---- */

void sunder_i_make_shape_pieces(sunder_i_maker *m); /* the whole shape at once */
/* The faces of what is left of a mesh; uses it up. */
void sunder_i_maker_add_faces(sunder_i_maker *m, sunder_i_mesh *mesh);
void sunder_i_make_triangles(sunder_i_maker *m, const sunder_i_member *member);
/* Hertel and Mehlhorn's merging, the longest diagonals first: the mesh that is left, on the maker's scratch memory,
 * and how many diagonals it has and how long they are, added to what stands there. Errors are in the maker. */
void sunder_i_mesh_short(sunder_i_maker *m, const sunder_i_member *member, sunder_i_mesh *mesh, uint32_t *diagonals,
                         double *sum);
void sunder_i_make_vertical(sunder_i_maker *m, const sunder_i_member *member);
void sunder_i_make_bisector(sunder_i_maker *m, const sunder_i_member *member);

/* ---- direction.c ---- */

/* A vector in the open cone that opens counter-clockwise by less than pi from a to b, not far from its bisector and
 * of small integers; or a itself (on the cone's boundary) where small integers do not reach into it. */
sunder_i_point sunder_i_direction_within(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b);
/* The vector's length to a few ulps, in units of 2^*exponent so that it is never out of range; the vector's approximate
 * coordinates divided by its length in unit[]. */
double sunder_i_direction_unit(sunder_i_lattice *lattice, sunder_i_point u, double unit[2], long *exponent);

/* ---- optimal.c ---- */

/* A member without holes prepared for dynamic programming over its diagonals; see optimal.c. */
typedef struct sunder_i_program sunder_i_program;

/* NULL if memory is out. Most of it is on the maker's scratch memory; _free gives back the rest. */
sunder_i_program *sunder_i_program_new(sunder_i_maker *m, const sunder_i_member *member);
/* Chooses diagonals of least total weight, each weighing `each` + `by_length` * its length; each > 0, by_length >=
 * 0. *diagonals: how many; *length: of them all. False if memory is out. */
bool sunder_i_program_solve(sunder_i_program *program, double each, double by_length, uint32_t *diagonals,
                            double *length);
/* Adds the pieces of the last solution. */
void sunder_i_program_emit(const sunder_i_program *program, sunder_i_maker *m);
void sunder_i_program_free(sunder_i_program *program);

/* Can the member be solved so? */
static inline bool sunder_i_has_program(const sunder_i_member *member)
{
    return member->ring_hi - member->ring_lo == 1 && member->n <= SUNDER_I_OPTIMAL_MOST;
}

/* ---- mixed.c ---- */

/* Decomposes both; errors are in the makers. */
void sunder_i_make_mixed(sunder_i_maker *p, sunder_i_maker *q);

#endif
