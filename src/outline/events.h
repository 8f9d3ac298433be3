/* events.h: the events along one line: where intervals of cover begin and end, sides rest, and corners touch. */
#ifndef SUNDER_I_EVENTS_H
#define SUNDER_I_EVENTS_H

#include "base/sort.h"
#include "predicate/predicate.h"

/* The numbers of parts that cover the point, that rest on the left or the right side of the line, and of live
 * candidates. */
typedef struct sunder_i_line_state {
    int32_t cover, left, right, domain;
} sunder_i_line_state;

#define SUNDER_I_NO_CORNER UINT32_MAX
#define SUNDER_I_NO_SIDE UINT32_MAX

/* The change of the state at a position of the line; all zero if only a corner is there. */
typedef struct sunder_i_event {
    sunder_i_fraction at;
    sunder_i_line_state change;
    uint32_t corner; /* a corner of a part at that position; SUNDER_I_NO_CORNER: none is known */
    uint32_t side;   /* a side of a part, not on the line, that passes or ends there; SUNDER_I_NO_SIDE: none is known */
} sunder_i_event;

typedef struct sunder_i_events {
    sunder_i_event *event;
    sunder_i_valued *order; /* [n] after sorting: the events in order; the first one at each position is marked */
    size_t n, capacity, order_capacity;
} sunder_i_events;

/* Makes room for `more` events. Returns false if out of memory. */
static inline bool sunder_i_events_reserve(sunder_i_events *events, size_t more)
{
    return sunder_i_reserve(&events->event, &events->capacity, events->n + more, sizeof *events->event);
}

bool sunder_i_events_sort(sunder_i_events *events, sunder_i_lattice *lattice);
void sunder_i_events_free(sunder_i_events *events);

#endif
