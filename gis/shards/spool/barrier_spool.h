/* barrier_spool.h: barriers on disk, and those of a part of the layer.
 *
 * They lie in a spool of their own, each with the box of all within which it owes features anything: so what meets a
 * box is met by it. Whatever the part, a few of them are there that stand for what the core asks of all barriers at
 * once: how much any owes at most, whether there is one, one of lines, one that owes nothing.
 */
#ifndef GIS_BARRIER_SPOOL_H
#define GIS_BARRIER_SPOOL_H

#include "shards/spool/spool.h"

/* Where in the plan's directory. */
#define GIS_BARRIERS "barriers"
/* ... within that, those that are of each part. */
#define GIS_BARRIERS_EVERYWHERE "everywhere"

typedef struct gis_spooled_barrier {
    size_t number; /* ascending in the order in which they were read; some may be left out */
    int64_t fid;
    const char *layer; /* its name */
    sunder_barrier demands;
} gis_spooled_barrier;

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

typedef struct gis_barriers_writer gis_barriers_writer;

/* Makes `barriers` in the directory, in place of what is there. gap: of those that have none of their own. */
bool gis_barriers_create(const char *directory, double gap, gis_barriers_writer **out, gis_error *error);
bool gis_barriers_add(gis_barriers_writer *writer, const gis_spooled_barrier *barrier, gis_error *error);
bool gis_barriers_finish(gis_barriers_writer *writer, gis_error *error);
void gis_barriers_writer_free(gis_barriers_writer *writer);

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

/* Of a layer: zeroed: none. */
typedef struct gis_spooled_barriers {
    gis_spool *all, *everywhere;
} gis_spooled_barriers;

bool gis_barriers_open(const char *directory, gis_spooled_barriers *out, gis_error *error);
void gis_barriers_close(gis_spooled_barriers *spool);
/* May some barrier matter within the box? */
bool gis_barriers_may_meet(const gis_spooled_barriers *spool, const double box[4]);

/* Those of a part, by their numbers. Zeroed: none. */
typedef struct gis_barriers_list {
    gis_spooled_barrier *item; /* all of each is owned */
    size_t n, capacity;
} gis_barriers_list;

/* All that meet some of n boxes, and those that are everywhere. */
bool gis_barriers_load(const gis_spooled_barriers *spool, const double (*box)[4], size_t n, gis_barriers_list *out,
                       gis_error *error);
bool gis_barriers_set(const gis_barriers_list *list, sunder_layer *layer, gis_error *error);
void gis_barriers_list_clear(gis_barriers_list *list);

#endif
