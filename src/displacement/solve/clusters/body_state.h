/* The states of a body while its layer is solved, and the events that change them.
 *
 * A body has one state of each aspect below. Aspects are independent of each other; the states of one aspect exclude
 * each other. States change in one way only: a stage reports an event of a body to sunder_i_body_event(), and the table
 * in body_state.c tells the next state of each aspect that the event concerns. */
#ifndef SUNDER_I_BODY_STATE_H
#define SUNDER_I_BODY_STATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum sunder_i_aspect {
    SUNDER_I_NO_ASPECT,
    SUNDER_I_SEARCH,    /* how far is the search for its place? */
    SUNDER_I_SCOPE,     /* do the stages of the present pass work on its cluster? */
    SUNDER_I_QUESTION,  /* is it asked whether its given-up pairs have a solution (reconsider.c)? */
    SUNDER_I_RETRY,     /* are its given-up pairs tried once more (retry_list.c)? */
    SUNDER_I_LIMITS,    /* is its limit in force (lifted_limits.c)? */
    SUNDER_I_HOLDING,   /* is it held as fixed (coarse_bodies.c)? */
    SUNDER_I_SLACK,     /* may proofs propose a layout without room for rounding (optimise.c)? */
    SUNDER_I_SHAKING,   /* was its contact group shaken with patience (optimise.c)? */
    SUNDER_I_DIAGONALS, /* do proofs heed the diagonals between its pieces (optimise.c)? */
    SUNDER_I_ASPECTS
} sunder_i_aspect;

/* Each aspect begins with its first state. */
enum {
    /* SUNDER_I_SEARCH */
    SUNDER_I_UNIMPROVED = 0,    /* better sides have not been looked for since it was last solved, if ever */
    SUNDER_I_DUE,               /* its cluster is solved in the present round */
    SUNDER_I_CHEAPEST,          /* it stands where a solution put it that is known to be the cheapest */
    SUNDER_I_IMPROVED,          /* better sides were looked for since it was last solved */
    SUNDER_I_IMPROVED_CHEAPEST, /* both */
    /* SUNDER_I_SCOPE */
    SUNDER_I_WANTED = 0, /* stages work on the clusters that contain such a body */
    SUNDER_I_LEFT,       /* it stays as the pass before left it */
    /* SUNDER_I_QUESTION; whether it was asked is noted at the root of a component of the conflicts at the start */
    SUNDER_I_DOUBTFUL = 0,   /* its pairs may be asked about */
    SUNDER_I_DOUBTFUL_ASKED, /* they may be, but were asked about without finding a solution */
    SUNDER_I_CERTAIN,        /* they are not asked about, unless a doubtful body is in the cluster */
    SUNDER_I_CERTAIN_ASKED,  /* the same, and they were asked about before without finding a solution */
    /* SUNDER_I_RETRY */
    SUNDER_I_NO_RETRY = 0,
    SUNDER_I_TO_RETRY, /* a pair of it was given up, and is tried once more */
    /* SUNDER_I_LIMITS */
    SUNDER_I_IN_FORCE = 0,
    SUNDER_I_LIFTED, /* it may go anywhere for now */
    SUNDER_I_ASIDE,  /* it stays where it stands until limits are in force again */
    /* SUNDER_I_HOLDING */
    SUNDER_I_NOT_HELD = 0,
    SUNDER_I_HELD,
    SUNDER_I_HELD_AS_COARSE, /* its moves are of no use to a neighbour */
    SUNDER_I_LET_GO,
    /* SUNDER_I_SLACK */
    SUNDER_I_ANY_LAYOUT = 0,
    SUNDER_I_WITH_SLACK, /* a layout without room for rounding failed the exact check */
    /* SUNDER_I_SHAKING */
    SUNDER_I_NOT_SHAKEN = 0,
    SUNDER_I_SHAKEN,
    /* SUNDER_I_DIAGONALS */
    SUNDER_I_PIECES_ALONE = 0,
    SUNDER_I_WITH_DIAGONALS, /* a proposed layout jumped with it: perhaps along a diagonal between two pieces */
};

typedef enum sunder_i_body_event_kind {
    /* the rounds (settle.c) */
    SUNDER_I_MEETS_CONFLICT, /* its cluster has to be solved */
    SUNDER_I_IS_SOLVED,
    SUNDER_I_IS_SOLVED_CHEAPEST,
    SUNDER_I_MOVES,
    SUNDER_I_IS_IMPROVED, /* better sides were looked for */
    SUNDER_I_GOES_HOME,   /* it goes back to its original place, and forgets what was found */
    /* passes */
    SUNDER_I_IS_WANTED,            /* the present pass works on it from now on */
    SUNDER_I_IS_LEFT,              /* the next pass leaves it as it is */
    SUNDER_I_BEGINS_AGAIN_FREED,   /* it begins again, since a held body was let go */
    SUNDER_I_BEGINS_AGAIN_LIMITED, /* it begins again within limits */
    /* given-up pairs */
    SUNDER_I_GIVES_UP, /* or may try once more what it gave up in an earlier pass */
    SUNDER_I_IS_RETRIED,
    SUNDER_I_IS_ASKED_IN_VAIN,
    SUNDER_I_IS_DOUBTED, /* a limit is in force in its cluster: more can be proved */
    SUNDER_I_IS_CERTAIN, /* none is */
    /* limits */
    SUNDER_I_LIMIT_IS_LIFTED,
    SUNDER_I_IS_SET_ASIDE,
    SUNDER_I_LIMIT_IS_RESTORED,
    /* held bodies */
    SUNDER_I_IS_HELD,
    SUNDER_I_IS_HELD_AS_COARSE,
    SUNDER_I_IS_LET_GO,
    SUNDER_I_IS_HELD_AGAIN, /* the layout in which it was held is taken back */
    /* proofs of contact groups */
    SUNDER_I_LACKS_SLACK,
    SUNDER_I_IS_SHAKEN,
    SUNDER_I_JUMPS_IN_PROOF,
    SUNDER_I_EVENTS
} sunder_i_body_event_kind;

/* A zeroed struct has no bodies. */
typedef struct sunder_i_body_states {
    unsigned char *of[SUNDER_I_ASPECTS]; /* of[aspect][body]; of[SUNDER_I_NO_ASPECT] is NULL */
    size_t n;
} sunder_i_body_states;

/* All of n bodies in their first states; does nothing if they have states already. False if memory is out. */
bool sunder_i_body_states_init(sunder_i_body_states *states, size_t n);
void sunder_i_body_states_free(sunder_i_body_states *states);
/* May the event happen to the body in its present states? */
bool sunder_i_body_may(const sunder_i_body_states *states, uint32_t body, sunder_i_body_event_kind event);
/* Takes the body to its next states. The event has to be possible, which builds with assertions check. */
void sunder_i_body_event(sunder_i_body_states *states, uint32_t body, sunder_i_body_event_kind event);

#endif
