/* The largest disc in several shapes together, such as the members of a block, in doubles. */
#ifndef SUNDER_I_INSCRIBED_H
#define SUNDER_I_INSCRIBED_H

#include <stdbool.h>
#include <stddef.h>

/* Where a disc may lie: inside of its members or in cracks between them, and not across a wall. A wall or edge has four
 * coordinates, those of both ends. */
typedef struct sunder_i_disc_room {
    const double *wall;
    const double *edge; /* the edges of the members, one after the other */
    const size_t *end;  /* [members] the index past the last edge of each member; there is at least one member */
    size_t walls, members;
    double crack; /* members no farther apart than this have a crack between them */
} sunder_i_disc_room;

/* The radius of the largest disc is found up to this part of the lesser side of the box around the room. */
#define SUNDER_I_DISC_PRECISION 0x1p-10
/* Finds the largest disc in the room. Returns false if memory is out. */
bool sunder_i_largest_disc(const sunder_i_disc_room *room, double centre[2], double *radius);

/* Improves a disc by small steps, which are halved where none helps, from `step` on. In a long room, whose middle line
 * is full of discs that are nearly the largest, that finds more than the search in all of it. */
void sunder_i_disc_climb(const sunder_i_disc_room *room, double step, double centre[2], double *radius);

#endif
