/* lines.h: the supporting lines of candidate sides, each once. */
#ifndef SUNDER_I_LINES_H
#define SUNDER_I_LINES_H

#include "convex/pieces.h"

#define SUNDER_I_NO_LINE UINT32_MAX

typedef struct sunder_i_supporting_line {
    sunder_i_point a, b; /* b - a is the direction of the class */
    uint32_t class;
} sunder_i_supporting_line;

/* There is a line for every few sides, and most of them are inside the union at first: so little is stored of each. */
typedef struct sunder_i_lines {
    uint32_t *side; /* [lines] a side on each line */
    uint32_t n;
    uint32_t *of;           /* [sides] the line of each candidate; SUNDER_I_NO_LINE for the other sides */
    sunder_i_point *second; /* [lines] the second point of each line on a wide lattice, where computing it needs memory;
                             * else NULL */
    /* borrowed from the parts: [corners], [corners], [classes] */
    const sunder_i_point *corner;
    const uint32_t *rank;
    const sunder_i_point *direction;
    uint32_t classes;
} sunder_i_lines;

static inline uint32_t sunder_i_lines_class(const sunder_i_lines *lines, uint32_t number)
{
    const uint32_t rank = lines->rank[lines->side[number]];
    return rank < lines->classes ? rank : rank - lines->classes;
}

static inline sunder_i_supporting_line sunder_i_lines_get(const sunder_i_lines *lines, uint32_t number)
{
    const sunder_i_point a = lines->corner[lines->side[number]];
    const uint32_t class = sunder_i_lines_class(lines, number);
    if (lines->second) return (sunder_i_supporting_line){a, lines->second[number], class};
    const sunder_i_point d = lines->direction[class];
    return (sunder_i_supporting_line){a, {a.x + d.x, a.y + d.y}, class};
}

/* Groups the candidates of the parts by line. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_lines_group(const sunder_i_convex_pieces *parts, sunder_i_lines *out, sunder_error *err);
void sunder_i_lines_free(sunder_i_lines *lines);

#endif
