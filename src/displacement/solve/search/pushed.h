/* Which bodies are pushed, one after the other, when a pair is separated? See pushed.c. */
#ifndef SUNDER_I_PUSHED_H
#define SUNDER_I_PUSHED_H

#include "displacement/solve/search/neighbourhood.h"

/* Number of directions for which obstacles are remembered. */
#define PUSHED_DIRECTIONS 64

/* The distance that a body keeps from another: n.(t_other - t) >= d, whichever of the two moves. */
typedef struct sunder_i_push_line {
    uint32_t other;
    double n[2], d;
    double u[2]; /* the relative place that it was taken at */
} sunder_i_push_line;

/* The lines of a body, and where it stood when they were taken. */
typedef struct sunder_i_push_lines {
    sunder_i_push_line *line;
    size_t n, capacity;
    double at[2];
    bool known;
    bool fresh; /* no body has moved since the lines were checked */
} sunder_i_push_lines;

/* A pushed body: from which distance on, and how far. */
typedef struct sunder_i_push {
    double spare;    /* what it takes until it is pushed, along the way there */
    double progress; /* how far on it stands */
    uint32_t body;
} sunder_i_push;

/* One side of a pair, which gives way in one direction. */
typedef struct sunder_i_push_front {
    double along[2];
    double most;         /* how far the side may give way, as far as is known */
    double *spare;       /* [n] for the bodies reached; else INFINITY */
    sunder_i_push *heap; /* bodies still to be examined */
    size_t waiting, capacity;
    uint32_t *reached; /* [n]; `n` of them, in no order */
    size_t n;
} sunder_i_push_front;

/* For one direction: failed questions since the shortest paths to limits were computed, and these paths. */
typedef struct sunder_i_push_survey {
    size_t in_vain; /* how many were looked at */
    uint32_t *next; /* [n] the next body that a body pushes; SUNDER_I_NOBODY: its own limit stops it. NULL: not
                     * computed */
} sunder_i_push_survey;

typedef struct sunder_i_pushed {
    sunder_i_neighbourhood about;
    sunder_i_push_lines *of; /* [all->n] */
    sunder_i_push_front front[2];
    double reach; /* nothing is to give way any farther */
    double *to;   /* [2 n] */
    sunder_i_push_survey survey[PUSHED_DIRECTIONS];
} sunder_i_pushed;

/* For a search without clashes, in which no pair misses more than `reach`. False if memory is out; the caller frees it
 * in any case. */
bool sunder_i_pushed_init(sunder_i_pushed *pushed, sunder_i_search *all, double reach);
void sunder_i_pushed_free(sunder_i_pushed *pushed);
/* What the pair misses of all that it owes, as it stands, and in which direction, from i to j, its pieces that miss
 * most are parted soonest. */
double sunder_i_pushed_missing(sunder_i_pushed *pushed, uint32_t i, uint32_t j, double n[2]);
/* What the pair is held to is another from now on. */
void sunder_i_pushed_renew(sunder_i_pushed *pushed, uint32_t i, uint32_t j);
/* Can the pair, which misses `missed` in direction n (from i to j), be separated by pushing the bodies in the way
 * straight on, within their limits? */
bool sunder_i_pushed_reaches(sunder_i_pushed *pushed, uint32_t i, uint32_t j, const double n[2], double missing);
/* If that was so: puts them there, unless somebody else is in the way. */
bool sunder_i_pushed_part(sunder_i_pushed *pushed, double missing);
/* All that the body has to keep from those that it might push; not as things stood where they went far. */
const sunder_i_push_lines *sunder_i_pushed_lines(sunder_i_pushed *pushed, uint32_t body);
/* How far the body may yet go that way. */
double sunder_i_pushed_room(const sunder_i_pushed *pushed, uint32_t body, const double along[2]);

/* ---- pushed_in_vain.c -------------------------------------------------------------------------------------------- */

/* Is it known that the pair is not parted so, without looking about? */
bool sunder_i_pushed_is_in_vain(sunder_i_pushed *pushed, uint32_t i, uint32_t j, const double n[2], double missing);
/* Records that a question with these fronts failed. */
void sunder_i_pushed_note_in_vain(sunder_i_pushed *pushed);

#endif
