/* unions.h: sums as unions of convex subsums, the three methods of Agarwal, Flato and Halperin [AFH00]. README.md
 * describes each.
 *
 *   P = union of P_i,  Q = union of Q_j,  R_ij = P_i + Q_j,  int P + int Q = union of the open R_ij
 *
 * Declarations shared by the files of this folder:
 *
 *   unions.c                                 the stages: decompose, unite, make the outline from the map
 *   subsum_order.c                           the order in which subsums are inserted
 *   feed.c                                   makes subsums one at a time and inserts them into a map
 *   arrangement.c, incremental.c, divide.c   the three unions
 *
 * sum/from_map.c makes the canonical sum from a marked map, sum/map_view.c the map for users. */
#ifndef SUNDER_I_UNIONS_H
#define SUNDER_I_UNIONS_H

#include "convex/convex_sum.h"
#include "planar_map/planar_map.h"
#include "sum/sum_value.h"

/* Sets an empty sum (except for its algorithm) by one of the three methods. On failure the caller frees the sum. Fails
 * with SUNDER_ENOMEM, SUNDER_ECANCEL, or SUNDER_ESIZE if there are too many subsums to number. */
sunder_status sunder_i_union_sum(sunder_sum *sum, const sunder_shape *p, const sunder_shape *q, bool force_wide,
                                 const sunder_sum_options *options, sunder_error *err);

/* The measure of fatness of a subsum; subsum_order.c compares the three. */
typedef enum sunder_i_fatness {
    SUNDER_I_FAT_AREA,    /* the area */
    SUNDER_I_FAT_BREADTH, /* area divided by perimeter: from a half to one times the radius of the largest disc
                           * inside */
    SUNDER_I_FAT_ROUND    /* area divided by the square of the perimeter: the same for all sizes */
} sunder_i_fatness;

#define SUNDER_I_FATNESS SUNDER_I_FAT_AREA /* the measure for SUNDER_ORDER_FAT */

/* The state of a union. Subsum k is the sum of piece k % pieces of P and piece k / pieces of Q. */
typedef struct sunder_i_uniting {
    sunder_i_lattice *lattice;
    sunder_i_decomposition p, q;
    sunder_i_arena arena; /* memory for the current subsum */
    const sunder_sum_options *options;
    sunder_i_fatness fatness;
    uint64_t random;
    uint32_t subsums, fed; /* subsums: their number; fed: the number of those that are in a map already */
    double seconds;        /* the time for making subsums, */
    sunder_counts counts;  /* and the operations */
} sunder_i_uniting;

/* Sorts n subsums, which are consecutive ascending numbers, in the order that the options require. Returns false if out
 * of memory. */
bool sunder_i_order_subsums(sunder_i_uniting *u, uint32_t *subsum, uint32_t n);

/* Makes one subsum in u->arena, and counts its time and operations. Returns false if out of memory. */
bool sunder_i_make_subsum(sunder_i_uniting *u, uint32_t subsum, sunder_i_convex_sum *out);

/* Makes each of n subsums in turn and adds it to the map with `add`: inserts it, or unites it with the map. */
typedef sunder_status (*sunder_i_add_polygon)(sunder_i_planar_map *map, const sunder_i_rational_point *corner,
                                              const sunder_i_point *along, size_t n, sunder_error *err);
sunder_status sunder_i_feed(sunder_i_uniting *u, const uint32_t *subsum, uint32_t n, sunder_i_add_polygon add,
                            sunder_i_planar_map *map, sunder_error *err);

/* The three methods. Each makes a new, marked map. */
sunder_status sunder_i_unite_by_arrangement(sunder_i_uniting *u, sunder_i_planar_map **out, sunder_error *err);
sunder_status sunder_i_unite_by_increments(sunder_i_uniting *u, sunder_i_planar_map **out, sunder_error *err);
sunder_status sunder_i_unite_by_halves(sunder_i_uniting *u, sunder_i_planar_map **out, sunder_error *err);

/* Makes the incremental union of the subsums first .. first + n - 1. */
sunder_status sunder_i_unite_some(sunder_i_uniting *u, uint32_t first, uint32_t n, sunder_i_planar_map **out,
                                  sunder_error *err);

#endif
