/* Random operands whose members nearly coincide, like several digitisations of one object. They are slow cases for
 * splitting squares and for sorting along lines. All are valid. */
#ifndef SUNDER_TESTS_GENERATE_NEARLY_H
#define SUNDER_TESTS_GENERATE_NEARLY_H

#include "polyset.h"
#include "random.h"

typedef enum nearly_kind {
    NEARLY_VERSIONS,   /* one outline several times, every corner slightly changed */
    NEARLY_COPIES,     /* exact copies, some of them several times, and one that is not quite equal */
    NEARLY_SLIVERS,    /* long rectangles, shifted a little along themselves and across */
    NEARLY_THIN,       /* triangles whose shortest side is a few units in the last place */
    NEARLY_HEAP,       /* many rectangles at one place, each slightly larger or rotated more */
    NEARLY_FAR,        /* fine detail, and another member far away */
    NEARLY_EDGES,      /* walls on one line that overlap partly, or are slightly off it */
    NEARLY_MAGNITUDES, /* members within the unit square, of map coordinates, and tiny ones */
    NEARLY_FITS,       /* a pocket, and a shape that nearly fits into it */
    NEARLY_KINDS
} nearly_kind;

const char *nearly_kind_string(nearly_kind kind);
/* P with up to about `members` members, Q with one or two. */
void random_nearly(polyset *p, polyset *q, rng *r, nearly_kind kind, int members);

#endif
