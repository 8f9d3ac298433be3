/* What happens along one line, place by place: where intervals of cover begin and end, sides rest, corners stand. */
#ifndef SUNDER_I_EVENTS_H
#define SUNDER_I_EVENTS_H

#include "base/sort.h"
#include "predicate/predicate.h"

/* How many cover, rest on either bank, or are live candidates. */
typedef struct sunder_i_line_state {
    int32_t cover, left, right, domain;
} sunder_i_line_state;

#define SUNDER_I_NO_CORNER UINT32_MAX
#define SUNDER_I_NO_SIDE UINT32_MAX

/* What changes at a place on the line; all zero where only a corner stands there. */
typedef struct sunder_i_event {
    sunder_i_fraction at;
    sunder_i_line_state change;
    uint32_t corner; /* of a part, at that place; SUNDER_I_NO_CORNER if none is known */
    uint32_t side;   /* of a part, not on the line, that passes or ends there; SUNDER_I_NO_SIDE if none is known */
} sunder_i_event;

typedef struct sunder_i_events {
    sunder_i_event *event;
    sunder_i_valued *order; /* [n] after sorting: the events in order, marked where the first at a place stands */
    size_t n, capacity, order_capacity;
} sunder_i_events;

/* Room for some more; false if memory is out. */
static inline bool sunder_i_events_reserve(sunder_i_events *events, size_t more)
{
    return sunder_i_reserve(&events->event, &events->capacity, events->n + more, sizeof *events->event);
}

bool sunder_i_events_sort(sunder_i_events *events, sunder_i_lattice *lattice);
void sunder_i_events_free(sunder_i_events *events);

#endif
