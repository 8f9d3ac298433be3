/* Who is pushed when a pair is parted, one after the other; see pushed.c. */
#ifndef SUNDER_I_PUSHED_H
#define SUNDER_I_PUSHED_H

#include "displacement/solve/search/neighbourhood.h"

/* Directions of which it is kept what stops bodies there. */
#define PUSHED_WAYS 64

/* What a body has to keep from another: n.(t_other - t) >= d, whoever of the two moves. */
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
    bool fresh; /* nobody has gone since it was looked whether they say enough */
} sunder_i_push_lines;

/* A body that is pushed: from what on, and so far. */
typedef struct sunder_i_push {
    double spare;    /* what it takes until it is pushed, along the way there */
    double progress; /* how far on it stands */
    uint32_t body;
} sunder_i_push;

/* One side of a pair, which gives way in one direction. */
typedef struct sunder_i_push_front {
    double along[2];
    double most;         /* how far the side may give way, as far as is known */
    double *spare;       /* [n] of who was reached; INFINITY */
    sunder_i_push *heap; /* who is yet to be looked at */
    size_t waiting, capacity;
    uint32_t *reached; /* [n]; `n` of them, in no order */
    size_t n;
} sunder_i_push_front;

/* Of one direction: what was asked in vain since the ways to those who stop it were looked for, and these. */
typedef struct sunder_i_push_ways {
    size_t in_vain; /* how many were looked at */
    uint32_t *next; /* [n] whom a body pushes on the way; SUNDER_I_NOBODY: its own limit stops it. NULL: never looked */
} sunder_i_push_ways;

typedef struct sunder_i_pushed {
    sunder_i_neighbourhood about;
    sunder_i_push_lines *of; /* [all->n] */
    sunder_i_push_front front[2];
    double reach; /* nothing is to give way any farther */
    double *to;   /* [2 n] */
    sunder_i_push_ways ways[PUSHED_WAYS];
} sunder_i_pushed;

/* Of a search that stands without clashes, in which no pair misses more than `reach`. False if memory is out; is to be
 * freed then, too. */
bool sunder_i_pushed_init(sunder_i_pushed *pushed, sunder_i_search *all, double reach);
void sunder_i_pushed_free(sunder_i_pushed *pushed);
/* What the pair misses of all that it owes, as it stands, and in which direction, from i to j, its pieces that miss
 * most are parted soonest. */
double sunder_i_pushed_missing(sunder_i_pushed *pushed, uint32_t i, uint32_t j, double n[2]);
/* What the pair is held to is another from now on. */
void sunder_i_pushed_renew(sunder_i_pushed *pushed, uint32_t i, uint32_t j);
/* Can the pair, which misses so much in direction n (from i to j), be parted by pushing whoever stands in the way
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
/* A question with these fronts was in vain. */
void sunder_i_pushed_note_in_vain(sunder_i_pushed *pushed);

#endif
