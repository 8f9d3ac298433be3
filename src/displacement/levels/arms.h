/* The arms of a shape: pieces that are too thin for a disc, and longer than wide. */
#ifndef SUNDER_I_ARMS_H
#define SUNDER_I_ARMS_H

#include "displacement/levels/levels.h"

/* Where an arc of the opening by the disc leaves the walls, or comes back to them: at the part t of the edge from
 * vertex v. */
typedef struct sunder_i_wall_contact {
    uint32_t v, arc;
    bool leaves;
    double t, xy[2];
} sunder_i_wall_contact;

/* An arc of the opening, and a part of the walls of the piece beyond it: from where the arc leaves them to the next
 * contact. */
typedef struct sunder_i_open_arc {
    size_t leaves, returns; /* its contacts */
    uint32_t next;          /* the arc that returns at that next contact; the arcs of a piece form a cycle */
    bool seen, off;         /* off: the piece is an arm */
} sunder_i_open_arc;

typedef struct sunder_i_arms {
    const sunder_shape *given, *shape; /* as given, and cut */
    double on_wall;                    /* what is no farther from a wall is on it */
    double least_length;               /* shorter pieces are no arms */
    double *xy;                        /* the corners of the opening, ring by ring */
    size_t *end, rings, room, end_room;
    sunder_i_wall_contact *contact; /* ring by ring of the shape, in their order along it */
    size_t contacts, contact_room;
    sunder_i_open_arc *arc;
    size_t arcs;
} sunder_i_arms;

/* Finds the arms of a shape that was cut from another one, for a disc of this diameter. *found: there are some. The
 * caller frees what *out holds, also after a failure; the shapes must outlive it. Fails with SUNDER_ENOMEM,
 * SUNDER_ESIZE or SUNDER_ECANCEL. */
sunder_status sunder_i_arms_find(const sunder_shape *given, const sunder_shape *shape, const sunder_shape *disc,
                                 double diameter, sunder_i_arms *out, bool *found, sunder_error *err);
void sunder_i_arms_free(sunder_i_arms *arms);

/* Returns the number of the contact after k on its ring. */
size_t sunder_i_contact_after(const sunder_i_arms *a, size_t k);
/* Go through the vertices between two contacts: the first one, and then *v, the one to be visited next, until there is
 * none. */
#define SUNDER_I_NO_VERTEX UINT32_MAX
uint32_t sunder_i_vertex_after(const sunder_i_arms *a, const sunder_i_wall_contact *from,
                               const sunder_i_wall_contact *to);
uint32_t sunder_i_next_vertex(const sunder_i_arms *a, const sunder_i_wall_contact *to, uint32_t v);

#endif
