/* spool.h: the features of a layer on disk, as the core needs them, in an order in which neighbours are near each
 * other: so that a part of a layer can be read by itself, with what is around it.
 *
 * A spool is two files of a directory. `features` holds a record of each feature, along a Hilbert curve through the
 * centres of their boxes, cell behind cell: about a thousand features each, or fewer that have many vertices. `cells`
 * says of each where it is, what box holds all that its features cover, and to which part it was dealt: about
 * as many vertices and features each, and neighbours along the curve. Everything is in the machine's own
 * order of bytes, which is told, and has checksums.
 *
 * Writing takes bounded memory: features are sorted by parts of GIS_SORT_BYTES bytes, which wait on the disk, and these
 * merged. So disk is needed for twice what a spool takes in the end. Where nothing was known beforehand of where they
 * lie they wait in the order in which they come, too, until all are there. */
#ifndef GIS_SPOOL_H
#define GIS_SPOOL_H

#include "base/gis_error.h"
#include "sunder.h"

#include <stdint.h>

typedef struct gis_spool_feature {
    size_t index;           /* place in the input, from 0 */
    int64_t fid;            /* OGRNullFID: none */
    sunder_feature demands; /* the shape: lent when a feature is added; owned by the visitor of one */
    double start[2];        /* of a point feature: where its arrow starts; NAN otherwise */
    double area;            /* of the shape, where weights ask for it; else 0 */
    const char *id;         /* the user's own key as text; NULL: null */
    sunder_obstacle lines;  /* of a barrier (shards/spool/barrier_spool.h), lent; its shape is not asked for */
    double reach;           /* its box is larger by this on all sides; 0 except for a barrier */
    uint64_t place;         /* where it lies in the spool that it is read from */
} gis_spool_feature;

typedef struct gis_spool_cell {
    double box[4]; /* xmin, ymin, xmax, ymax of all its shapes; empty ones have none: then box[0] > box[2] */
    size_t features, vertices;
    unsigned part; /* from 0 */
} gis_spool_cell;

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

typedef struct gis_spool_writer gis_spool_writer;

/* Creates a spool in an existing directory; an old spool in it stays until the new one is complete. frame: the box
 * in which features are said to lie, or NULL. If many lie outside it, or all in a small corner of it, they are
 * sorted again at the end. */
bool gis_spool_create(const char *directory, const double frame[4], gis_spool_writer **out, gis_error *error);
/* Each index once; the order does not matter. The shape's rings are kept as they were given (sunder_shape_given()). */
bool gis_spool_add(gis_spool_writer *writer, const gis_spool_feature *feature, gis_error *error);

/* Sets what is known of a feature only when all are there: the weight, the limit and, if it was added with one, the
 * block of its demands. Its shape is NULL. Called once for each. False refuses it, and with it the spool: of several
 * the first in the order of the input is told. */
typedef bool gis_spool_settle(void *user, gis_spool_feature *feature, gis_error *error);

/* Sorts, cuts into cells, deals these to `parts` (1 or more) and puts the files in place; settle may be NULL. */
bool gis_spool_finish(gis_spool_writer *writer, unsigned parts, gis_spool_settle *settle, void *user, gis_error *error);
/* What was begun and not finished is taken away. */
void gis_spool_writer_free(gis_spool_writer *writer);

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

typedef struct gis_spool gis_spool;

/* Fails where a file is missing, cut off, of another version or machine, or not what was written. */
bool gis_spool_open(const char *directory, gis_spool **out, gis_error *error);
void gis_spool_close(gis_spool *spool);

size_t gis_spool_features(const gis_spool *spool);
size_t gis_spool_vertices(const gis_spool *spool); /* as given: those of cells add up to it */
unsigned gis_spool_parts(const gis_spool *spool);
/* Of everything in it, other than for a spool of the same features. */
uint64_t gis_spool_checksum(const gis_spool *spool);
size_t gis_spool_cells(const gis_spool *spool);
const gis_spool_cell *gis_spool_cell_at(const gis_spool *spool, size_t cell);

/* The text of id is the reader's, until the next feature. The shape is the visitor's, whatever it returns; false ends
 * it all. */
typedef bool gis_spool_visit(void *user, const gis_spool_feature *feature, gis_error *error);
/* Visits each feature of a cell, once all of it is known to be what was written. */
bool gis_spool_read(gis_spool *spool, size_t cell, gis_spool_visit *visit, void *user, gis_error *error);
/* Visits the one at a place that was visited before. */
bool gis_spool_read_one(gis_spool *spool, uint64_t place, gis_spool_visit *visit, void *user, gis_error *error);
/* As gis_spool_read(), which it is several times as fast as, but without shapes, lines and their checks: of these there
 * are the box, as in a gis_spool_cell, and the number of vertices. */
typedef bool gis_spool_glance(void *user, const gis_spool_feature *feature, const double box[4], size_t vertices,
                              gis_error *error);
bool gis_spool_skim(gis_spool *spool, size_t cell, gis_spool_glance *glance, void *user, gis_error *error);
/* The boxes of the features of a cell that cover anything, without the rest: box[] has room for all of them. */
bool gis_spool_boxes(gis_spool *spool, size_t cell, double (*box)[4], size_t *n, gis_error *error);

#endif
