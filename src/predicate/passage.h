/* A straight way of a point, whose end is a sum of doubles that no double need hold, and segments that it may meet. */
#ifndef SUNDER_I_PASSAGE_H
#define SUNDER_I_PASSAGE_H

#include <stdbool.h>

/* The closed segment from `from` to from + t - s, the sum not rounded: the way of a point of what moves by t, as seen
 * from what moves by s. All six finite. */
typedef struct sunder_i_passage {
    double from[2], t[2], s[2];
} sunder_i_passage;

/* A box that holds it, rounded outward; the whole plane where the sum may be beyond the range of doubles. */
void sunder_i_passage_box(const sunder_i_passage *passage, double box[4]);
/* Does it meet the closed segment cd? Exact; nothing is allocated, so nothing can fail. Either may be a point. */
bool sunder_i_passage_meets(const sunder_i_passage *passage, const double c[2], const double d[2]);

/* ---- The rungs, each by itself so that tests can force them ---- */

#define SUNDER_I_PASSAGE_UNSURE 2

/* The side of c to the line of the passage, and of the passage's end to the line cd: floating point with a proved bound
 * (+1, -1 or unsure), and exactly. */
int sunder_i_passage_side_filter(const sunder_i_passage *passage, const double c[2]);
int sunder_i_passage_side_exact(const sunder_i_passage *passage, const double c[2]);
int sunder_i_passage_end_filter(const sunder_i_passage *passage, const double c[2], const double d[2]);
int sunder_i_passage_end_exact(const sunder_i_passage *passage, const double c[2], const double d[2]);

/* Do two closed segments meet? ends: the sides of either's ends to the line of the other, two and two. all_on: asked
 * where all four are 0: do they share a coordinate on both axes? */
static inline bool sunder_i_sides_meet(int c, int d, int from, int to, bool (*all_on)(const void *), const void *of)
{
    /* Strictly on one side: apart. Weakly separated both ways, and not all on one line: then the lines cross in one
     * point, which lies on both (were they parallel, both ends would be strictly on one side). A segment without
     * length has both its ends on one side of the other's line, or on it; and to its own line everything is 0. */
    if (c * d > 0 || from * to > 0) return false;
    return c || d || from || to || all_on(of);
}

#endif
