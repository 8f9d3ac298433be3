/* Pushing: which bodies have to move, one after the other, if a pair is separated along a line? See pushed.c. */
#ifndef SUNDER_I_PUSHED_H
#define SUNDER_I_PUSHED_H

#include "displacement/solve/search/neighbourhood.h"

/* Shortest paths are remembered for this number of directions (pushed_in_vain.c). */
#define PUSHED_DIRECTIONS 64

/* A half-plane constraint between a body and `other`: n.(t_other - t) >= d. */
typedef struct sunder_i_push_line {
    uint32_t other;
    double n[2], d;
    double u[2]; /* the relative position of the pair at which the line was chosen */
} sunder_i_push_line;

/* The constraints of a body, and its move when they were chosen. */
typedef struct sunder_i_push_lines {
    sunder_i_push_line *line;
    size_t n, capacity;
    double at[2];
    bool known;
    bool fresh; /* neither the body nor one of `line` has moved since the lines were checked */
} sunder_i_push_lines;

/* A body waiting in the queue of a front. */
typedef struct sunder_i_push {
    double spare;    /* how far the end of the pair moves until this body is pushed, along the path found */
    double progress; /* its coordinate along the direction */
    uint32_t body;
} sunder_i_push;

/* The bodies that one end of the pair pushes, in one direction. */
typedef struct sunder_i_push_front {
    double along[2];
    double most;         /* an upper bound of how far this end can move */
    double *spare;       /* [n] for each body reached: `spare` of its shortest path so far; otherwise INFINITY */
    sunder_i_push *heap; /* [waiting] the queue */
    size_t waiting, capacity;
    uint32_t *reached; /* [n] the bodies reached, in no order */
    size_t n;
} sunder_i_push_front;

/* For one direction: the shortest paths from all bodies to a limit. */
typedef struct sunder_i_push_survey {
    size_t in_vain; /* bodies examined by failed questions since the paths were computed */
    uint32_t *next; /* [n] the next body on the path; SUNDER_I_NOBODY: the body's own limit. NULL: not computed */
} sunder_i_push_survey;

typedef struct sunder_i_pushed {
    sunder_i_neighbourhood about;
    sunder_i_push_lines *of; /* [all->n] the constraints of each body */
    sunder_i_push_front front[2];
    double reach; /* an upper bound of the violations that are to be resolved */
    double *to;   /* [2 n] new moves */
    sunder_i_push_survey survey[PUSHED_DIRECTIONS];
} sunder_i_pushed;

/* Prepares pushing in the search `all`. reach: an upper bound of the violations that are to be resolved; a body is
 * related to bodies within the gap plus twice `reach`. False if memory is out; the caller calls sunder_i_pushed_free()
 * in any case. */
bool sunder_i_pushed_init(sunder_i_pushed *pushed, sunder_i_search *all, double reach);
void sunder_i_pushed_free(sunder_i_pushed *pushed);
/* By how much pair (i, j) misses its full distance at present, relaxed or not; 0 if it keeps it. n: the direction from
 * i to j in which the worst pair of pieces is separated with the least move. */
double sunder_i_pushed_missing(sunder_i_pushed *pushed, uint32_t i, uint32_t j, double n[2]);
/* The demand on pair (i, j) has changed: forgets the lines of its bodies. */
void sunder_i_pushed_renew(sunder_i_pushed *pushed, uint32_t i, uint32_t j);
/* Can pair (i, j) be moved apart by `missing` in direction n (from i to j), if bodies in the way are pushed straight on
 * within their limits? */
bool sunder_i_pushed_reaches(sunder_i_pushed *pushed, uint32_t i, uint32_t j, const double n[2], double missing);
/* To be called after sunder_i_pushed_reaches() has returned true: moves the two bodies apart by `missing`, and all
 * bodies that they push. False, with no body moved, if a body would be pushed by both ends, or if a moved body would
 * clash with another one. */
bool sunder_i_pushed_part(sunder_i_pushed *pushed, double missing);
/* The lines of a body towards all bodies that it might push. They are chosen anew if bodies have moved far since they
 * were chosen. */
const sunder_i_push_lines *sunder_i_pushed_lines(sunder_i_pushed *pushed, uint32_t body);
/* How far the body's limit lets it move in direction `along`. */
double sunder_i_pushed_room(const sunder_i_pushed *pushed, uint32_t body, const double along[2]);

/* ---- pushed_in_vain.c -------------------------------------------------------------------------------------------- */

/* Do remembered paths show, without a search, that pair (i, j) cannot be moved apart by `missing`? */
bool sunder_i_pushed_is_in_vain(sunder_i_pushed *pushed, uint32_t i, uint32_t j, const double n[2], double missing);
/* To be called after the search with the present fronts failed: adds the bodies that it examined to the count for its
 * two directions. A direction whose count is large (PUSHED_SURVEY) gets new shortest paths. */
void sunder_i_pushed_note_in_vain(sunder_i_pushed *pushed);

#endif
