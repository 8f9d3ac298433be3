/* Declarations that the files of the oracle share. */
#ifndef SUNDER_TESTS_ORACLE_INNER_H
#define SUNDER_TESTS_ORACLE_INNER_H

#include "even_odd.h"
#include "oracle.h"

#include <gmp.h>
#include <stdint.h>

__extension__ typedef __int128 oracle_i128;

/* A grid point. sx, sy are the same numbers if the grid is small (oracle.small). */
typedef struct zpoint {
    mpz_t x, y;
    int64_t sx, sy;
} zpoint;

/* A rational point (x / w, y / w) in grid units, w > 0, in lowest terms; ax, ay approximate it times 2^-shift. */
typedef struct hpoint {
    mpz_t x, y, w;
    double ax, ay;
} hpoint;

/* One operand: rings oriented so that the interior is on the left. */
typedef struct zset {
    size_t n;
    zpoint *v;
    size_t *next, *prev, *member;
    size_t members;
    size_t triangles;
    size_t *triangle; /* [3 * triangles] vertices */
} zset;

/* One side of a sum of two triangles: the inside is nx * x + ny * y < h. */
typedef struct halfplane {
    mpz_t nx, ny, h;
    double anx, any, ah; /* approximations, in units of about the input's (squared for h) */
} halfplane;

typedef struct subsum {
    halfplane side[6];
    double box[4]; /* xmin, ymin, xmax, ymax, enlarged by some ulps */
} subsum;

struct oracle {
    mpq_t unit; /* of the grid, in units of the input */
    long shift; /* approximations use 2^-shift, which is about the unit */
    bool small; /* grid coordinates of operands and their sums are below 2^60 */
    zset p, q;
    size_t subsums;
    subsum *sub;
};

/* Operands (oracle_operand.c) */
void oracle_load(oracle *o, zset *z, const polyset *set);
/* Makes the grid, of unit 1 / factor, fine enough for a set of rationals. */
void oracle_load_even_odd(oracle *o, zset *z, const even_odd *set, const mpz_t factor);
void oracle_unload(zset *z);
void oracle_triangulate(const oracle *o, zset *z);
void zpoint_init(zpoint *p);
void zpoint_clear(zpoint *p);
void zpoint_set_small(const oracle *o, zpoint *p);
int oracle_orient(const oracle *o, const zpoint *a, const zpoint *b, const zpoint *c);
int zpoint_cmp(const zpoint *a, const zpoint *b);

/* Membership (oracle.c). direction NULL: the point itself; otherwise the point moved by an infinitesimal amount in that
 * direction. */
bool oracle_covered(const oracle *o, const hpoint *x, const zpoint *direction);
void hpoint_init(hpoint *p);
void hpoint_clear(hpoint *p);
/* Reduces the point to lowest terms, and computes the approximation. */
void hpoint_finish(const oracle *o, hpoint *p);
int hpoint_cmp(const hpoint *a, const hpoint *b);

/* The arrangement and its classified pieces (oracle_arrangement.c); only uncovered parts are kept. */
typedef struct oracle_edge {
    uint32_t from, to; /* points; the boundary has the covered side on the left */
    zpoint along;      /* a grid vector from `from` to `to` */
} oracle_edge;

typedef struct oracle_map {
    hpoint *point;
    size_t points;
    oracle_edge *boundary; /* one side covered */
    size_t boundaries;
    oracle_edge *thin; /* both sides are covered, but not the piece itself: pieces of degenerate segments; from < to
                        * lexicographically */
    size_t thins;
    uint32_t *lone; /* degenerate points */
    size_t lones;
} oracle_map;

void oracle_map_build(const oracle *o, bool all_segments, oracle_map *map);
void oracle_map_free(oracle_map *map);

/* Canonical text (oracle_rings.c) */
char *oracle_map_text(const oracle *o, const oracle_map *map);

#endif
