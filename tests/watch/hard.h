/* Operands on which geometry code is slow: extreme cases of map data, and random ones. */
#ifndef SUNDER_TESTS_HARD_H
#define SUNDER_TESTS_HARD_H

#include "polyset.h"
#include "random.h"

typedef enum hard_kind {
    HARD_STAIRS,   /* an outline traced along pixels, and the same displaced a little */
    HARD_COAST,    /* a ragged outline, and the same digitised again */
    HARD_VERSIONS, /* many outlines of one building, corners a millimetre apart; a polygon with random doubles */
    HARD_SLIVERS,  /* long rectangles a micrometre apart; an L */
    HARD_SCRIBBLE, /* a closed random polyline that crosses itself; a square */
    HARD_TRACK,    /* a wandering track closed to a ring that crosses itself; a square */
    HARD_BOWS,     /* two round outlines with a few vertices swapped, invalid */
    HARD_COMBS,    /* comb with teeth upwards, comb with teeth sideways */
    HARD_SCATTER,  /* many small members far from each other; a star */
    HARD_SIEVE,    /* a plate with many holes; a square that fits into none */
    HARD_KINDS
} hard_kind;

const char *hard_kind_string(hard_kind kind);
/* About n vertices; it may be invalid, and is then read by the even-odd rule. */
void random_hard(polyset *p, polyset *q, rng *r, hard_kind kind, int n);

#endif
