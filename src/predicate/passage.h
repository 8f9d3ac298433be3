/* passage.h: a straight path of a point, whose end is a sum of doubles that need not be a double itself, and segments
 * that it may meet. */
#ifndef SUNDER_I_PASSAGE_H
#define SUNDER_I_PASSAGE_H

#include <stdbool.h>

/* The closed segment from `from` to from + t - s, where the sum is not rounded: the path of a point of an object that
 * moves by t, relative to an object that moves by s. All six numbers are finite. */
typedef struct sunder_i_passage {
    double from[2], t[2], s[2];
} sunder_i_passage;

/* *box becomes a box that contains the passage, rounded outward; the whole plane if the sum may be beyond the range of
 * doubles. */
void sunder_i_passage_box(const sunder_i_passage *passage, double box[4]);
/* Returns true if the passage meets the closed segment cd; exact. Nothing is allocated, so that it cannot fail. Either
 * may be a point. */
bool sunder_i_passage_meets(const sunder_i_passage *passage, const double c[2], const double d[2]);

/* ---- The single steps, so that tests can call each ---- */

#define SUNDER_I_PASSAGE_UNSURE 2

/* Return the side of c with respect to the line of the passage, and that of the passage's end with respect to the line
 * cd: with floating point and a proved error bound (+1, -1 or SUNDER_I_PASSAGE_UNSURE), and exactly. */
int sunder_i_passage_side_filter(const sunder_i_passage *passage, const double c[2]);
int sunder_i_passage_side_exact(const sunder_i_passage *passage, const double c[2]);
int sunder_i_passage_end_filter(const sunder_i_passage *passage, const double c[2], const double d[2]);
int sunder_i_passage_end_exact(const sunder_i_passage *passage, const double c[2], const double d[2]);

/* Returns true if two closed segments meet. c, d: the sides of the ends of one segment with respect to the line of the
 * other; from, to: those of the ends of the other. all_on(of): called if all four are 0; it returns true if the
 * segments share a coordinate on both axes. */
static inline bool sunder_i_sides_meet(int c, int d, int from, int to, bool (*all_on)(const void *), const void *of)
{
    /* If both ends of one segment are strictly on one side, the two are disjoint. If neither is so, and not all four
     * are 0, the lines intersect in one point, which is on both segments (if they were parallel, both ends would be
     * strictly on one side). A segment of length zero has both its ends on one side of the other's line, or on it; with
     * respect to its own line every side is 0. */
    if (c * d > 0 || from * to > 0) return false;
    return c || d || from || to || all_on(of);
}

#endif
