/* barrier_spool.h: barriers on disk, and loading those of one part of the layer.
 *
 * Barriers have a spool of their own. Each is stored with the box within which features owe it a distance, so that only
 * barriers whose box meets a part's boxes matter to the part. In addition every part gets a few barriers that represent
 * properties of all barriers together, on which the core's decisions depend: the largest distance owed, and whether
 * there is any barrier, one with lines, one to which no distance is owed, one with a full gap. */
#ifndef GIS_BARRIER_SPOOL_H
#define GIS_BARRIER_SPOOL_H

#include "shards/spool/spool.h"

/* Subdirectory of the plan's directory. */
#define GIS_BARRIERS "barriers"
/* Subdirectory of that, with the barriers that every part gets. */
#define GIS_BARRIERS_EVERYWHERE "everywhere"

typedef struct gis_spooled_barrier {
    size_t number; /* ascending in reading order; numbers may be missing */
    int64_t fid;
    const char *layer; /* name of the layer */
    sunder_barrier demands;
    uint32_t gap_class; /* its class for gaps */
} gis_spooled_barrier;

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

typedef struct gis_barriers_writer gis_barriers_writer;

/* Creates `barriers` in the directory, in place of an existing one. `gap` and `full_gap` are those of barriers without
 * a gap of their own; the latter is the greater, or they are equal. The tables of `gaps`, which are borrowed, replace
 * them if it has classes. */
bool gis_barriers_create(const char *directory, double gap, double full_gap, const sunder_gaps *gaps,
                         gis_barriers_writer **out, gis_error *error);
bool gis_barriers_add(gis_barriers_writer *writer, const gis_spooled_barrier *barrier, gis_error *error);
bool gis_barriers_finish(gis_barriers_writer *writer, gis_error *error);
void gis_barriers_writer_free(gis_barriers_writer *writer);

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

/* The barriers of a layer. A zeroed struct is empty. */
typedef struct gis_spooled_barriers {
    gis_spool *all, *everywhere;
} gis_spooled_barriers;

bool gis_barriers_open(const char *directory, gis_spooled_barriers *out, gis_error *error);
void gis_barriers_close(gis_spooled_barriers *spool);
/* May a barrier matter to features within the box? May be true although none does. */
bool gis_barriers_may_meet(const gis_spooled_barriers *spool, const double box[4]);

/* The barriers of a part, sorted by number. A zeroed list is empty. */
typedef struct gis_barriers_list {
    gis_spooled_barrier *item; /* everything in it is owned */
    size_t n, capacity;
} gis_barriers_list;

/* Loads all barriers that meet one of n boxes, and those that every part gets. */
bool gis_barriers_load(const gis_spooled_barriers *spool, const double (*box)[4], size_t n, gis_barriers_list *out,
                       gis_error *error);
bool gis_barriers_set(const gis_barriers_list *list, sunder_layer *layer, gis_error *error);
void gis_barriers_list_clear(gis_barriers_list *list);

#endif
