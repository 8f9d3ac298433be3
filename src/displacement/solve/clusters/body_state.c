/* The table of transitions: for each event, the next state from each state of the aspects that it concerns. */
#include "displacement/solve/clusters/solver.h"

#include "base/invariant.h"

#include <string.h>

enum { MOST_STATES = 5, MOST_CONCERNED = 2 };

/* The event cannot happen in this state. */
#define NEVER 0xff

typedef struct transition {
    unsigned char aspect;            /* SUNDER_I_NO_ASPECT: no further one */
    unsigned char next[MOST_STATES]; /* by the state before the event, in the order of the enumeration */
} transition;

#define S(name) SUNDER_I_##name
#define FROM_ANY(state)                                                                                                \
    {                                                                                                                  \
        S(state), S(state), S(state), S(state), S(state)                                                               \
    }

/* clang-format off */
static const transition table[S(EVENTS)][MOST_CONCERNED] = {
    /* SEARCH: from UNIMPROVED, DUE, CHEAPEST, IMPROVED, IMPROVED_CHEAPEST */
    [S(MEETS_CONFLICT)]     = {{S(SEARCH), FROM_ANY(DUE)}},
    [S(IS_SOLVED)]          = {{S(SEARCH), FROM_ANY(UNIMPROVED)}},
    [S(IS_SOLVED_CHEAPEST)] = {{S(SEARCH), FROM_ANY(CHEAPEST)}},
    [S(MOVES)]       = {{S(SEARCH), {S(UNIMPROVED),     S(DUE), S(UNIMPROVED),              S(IMPROVED), S(IMPROVED)}}},
    [S(IS_IMPROVED)] = {{S(SEARCH), {S(IMPROVED), NEVER,  S(IMPROVED_CHEAPEST), S(IMPROVED), S(IMPROVED_CHEAPEST)}}},
    [S(GOES_HOME)]   = {{S(SEARCH), {S(UNIMPROVED),     NEVER,  S(CHEAPEST),          S(UNIMPROVED),     S(CHEAPEST)}}},
    /* SCOPE: from WANTED, LEFT. QUESTION: from DOUBTFUL, DOUBTFUL_ASKED, CERTAIN, CERTAIN_ASKED */
    [S(IS_WANTED)] = {{S(SCOPE), FROM_ANY(WANTED)}},
    [S(IS_LEFT)]   = {{S(SCOPE), FROM_ANY(LEFT)}},
    [S(BEGINS_AGAIN_FREED)]   = {{S(SCOPE), FROM_ANY(WANTED)},
                                 {S(QUESTION), {S(DOUBTFUL), S(DOUBTFUL), S(CERTAIN), S(CERTAIN)}}},
    [S(BEGINS_AGAIN_LIMITED)] = {{S(SCOPE), FROM_ANY(WANTED)},
                                 {S(QUESTION), {S(DOUBTFUL), S(DOUBTFUL_ASKED), S(DOUBTFUL), S(DOUBTFUL_ASKED)}}},
    [S(IS_ASKED_IN_VAIN)] =
        {{S(QUESTION), {S(DOUBTFUL_ASKED), S(DOUBTFUL_ASKED), S(CERTAIN_ASKED), S(CERTAIN_ASKED)}}},
    [S(IS_DOUBTED)] = {{S(QUESTION), FROM_ANY(DOUBTFUL)}},
    [S(IS_CERTAIN)] = {{S(QUESTION), {S(CERTAIN), S(CERTAIN_ASKED), S(CERTAIN), S(CERTAIN_ASKED)}}},
    /* RETRY: from NO_RETRY, TO_RETRY */
    [S(GIVES_UP)]   = {{S(RETRY), FROM_ANY(TO_RETRY)}},
    [S(IS_RETRIED)] = {{S(RETRY), FROM_ANY(NO_RETRY)}},
    /* LIMITS: from IN_FORCE, LIFTED, ASIDE */
    [S(LIMIT_IS_LIFTED)]   = {{S(LIMITS), {S(LIFTED), NEVER,       NEVER}}},
    [S(IS_SET_ASIDE)]      = {{S(LIMITS), {NEVER,     S(ASIDE),    S(ASIDE)}}},
    [S(LIMIT_IS_RESTORED)] = {{S(LIMITS), {NEVER,     S(IN_FORCE), S(IN_FORCE)}}},
    /* HOLDING: from NOT_HELD, HELD, HELD_AS_COARSE, LET_GO */
    [S(IS_HELD)]           = {{S(HOLDING), {S(HELD), NEVER,             NEVER,             NEVER}}},
    [S(IS_HELD_AS_COARSE)] = {{S(HOLDING), {NEVER,   S(HELD_AS_COARSE), S(HELD_AS_COARSE), NEVER}}},
    [S(IS_LET_GO)]         = {{S(HOLDING), {NEVER,   S(LET_GO),         S(LET_GO),         S(LET_GO)}}},
    [S(IS_HELD_AGAIN)]     = {{S(HOLDING), {NEVER,   S(HELD),           S(HELD_AS_COARSE), S(HELD)}}},
    /* Each of these three has two states, and keeps the second. */
    [S(LACKS_SLACK)]    = {{S(SLACK), FROM_ANY(WITH_SLACK)}},
    [S(IS_SHAKEN)]      = {{S(SHAKING), FROM_ANY(SHAKEN)}},
    [S(JUMPS_IN_PROOF)] = {{S(DIAGONALS), FROM_ANY(WITH_DIAGONALS)}},
};
/* clang-format on */

bool sunder_i_body_states_init(sunder_i_body_states *states, size_t n)
{
    if (states->of[SUNDER_I_SEARCH]) return true;
    unsigned char *all = sunder_i_calloc(n, SUNDER_I_ASPECTS);
    if (!all) return false;
    for (size_t k = SUNDER_I_SEARCH; k < SUNDER_I_ASPECTS; k++) states->of[k] = all + (k - SUNDER_I_SEARCH) * n;
    states->n = n;
    return true;
}

void sunder_i_body_states_free(sunder_i_body_states *states)
{
    sunder_i_free(states->of[SUNDER_I_SEARCH]);
    memset(states, 0, sizeof *states);
}

bool sunder_i_body_may(const sunder_i_body_states *states, uint32_t body, sunder_i_body_event_kind event)
{
    for (size_t k = 0; k < MOST_CONCERNED && table[event][k].aspect; k++)
        if (table[event][k].next[states->of[table[event][k].aspect][body]] == NEVER) return false;
    return true;
}

void sunder_i_body_event(sunder_i_body_states *states, uint32_t body, sunder_i_body_event_kind event)
{
    SUNDER_I_ASSERT(sunder_i_body_may(states, body, event));
    for (size_t k = 0; k < MOST_CONCERNED && table[event][k].aspect; k++) {
        unsigned char *state = &states->of[table[event][k].aspect][body];
        *state = table[event][k].next[*state];
    }
}

/* ---- The checker ------------------------------------------------------------------------------------------------- */

static const char *check_body(const sunder_i_solver *s, uint32_t b)
{
    static const unsigned char states[SUNDER_I_ASPECTS] = {0, 5, 2, 4, 2, 3, 4, 2, 2, 2};
    const sunder_i_body *body = &s->model.body[b];
    const unsigned char limits = s->states.of[SUNDER_I_LIMITS][b], holding = s->states.of[SUNDER_I_HOLDING][b];
    for (size_t k = SUNDER_I_SEARCH; k < SUNDER_I_ASPECTS; k++)
        if (s->states.of[k][b] >= states[k]) return "a body in a state that its aspect does not have";
    if (s->states.of[SUNDER_I_SEARCH][b] == SUNDER_I_DUE) return "a body that waits to be solved, though no round runs";
    const bool lifted = s->limit && !s->model.lifted;
    if (lifted != (limits != SUNDER_I_IN_FORCE)) return "a limit that is lifted for some bodies only";
    if (lifted && !body->fixed && body->limit < INFINITY) return "a body with a limit while limits are lifted";
    if (body->held != (holding == SUNDER_I_HELD || holding == SUNDER_I_HELD_AS_COARSE))
        return "a body that is held for the model, but not for the solver, or the other way round";
    if (body->held && !body->fixed) return "a held body that may move";
    return NULL;
}

const char *sunder_i_solver_check_states(const sunder_i_solver *solver)
{
    const char *broken = solver->states.n == solver->model.bodies ? NULL : "states of another number of bodies";
    for (uint32_t b = 0; b < solver->model.bodies && !broken; b++) broken = check_body(solver, b);
    return broken;
}
