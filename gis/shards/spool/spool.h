/* spool.h: the features of a layer on disk, with what the core needs, in an order in which neighbours are close to each
 * other, so that a part of the layer can be read with its surroundings.
 *
 * A spool is two files in a directory. `features` holds a record for each feature, sorted along a Hilbert curve through
 * the centres of their boxes and divided into cells of about a thousand features, or fewer if these have many vertices.
 * `cells` tells for each cell where it is, the box of all its features, and the part that it belongs to; parts have
 * about the same number of vertices and features, and their cells are neighbours on the curve. Everything is in the
 * machine's byte order, which is recorded, and has checksums.
 *
 * Writing takes bounded memory: features are sorted in runs of GIS_SORT_BYTES bytes, which are stored on disk and
 * merged; so writing takes twice the final size on disk. If the extent of the features is not known beforehand, they
 * are also stored in input order until all have been added. */
#ifndef GIS_SPOOL_H
#define GIS_SPOOL_H

#include "base/gis_error.h"
#include "sunder_hiding.h"

#include <stdint.h>

/* The rings of a shape, as sunder_shape_given() has them. */
typedef struct gis_spool_rings {
    const double *xy;
    const size_t *ring_end, *poly_end;
    size_t polygons; /* 0: there is none */
    bool repaired;
} gis_spool_rings;

typedef struct gis_spool_feature {
    size_t index;              /* place in the input, from 0 */
    int64_t fid;               /* OGRNullFID: it has none */
    sunder_feature demands;    /* its shape is borrowed when a feature is added, and owned by the visitor when it is
                             * read */
    double start[2];           /* of a point feature: the start of its arrow; otherwise NAN */
    double area;               /* of the shape, if weights depend on it; of a barrier, the full gap; else 0 */
    const char *id;            /* value of --id-field as text; NULL: null */
    sunder_obstacle lines;     /* of a barrier (shards/spool/barrier_spool.h), borrowed; its shape member is not used */
    int64_t row;               /* number of its row of --rows FIELD, from 1 on; 0: none */
    sunder_hiding_cost hiding; /* what it costs to hide it; weight 0: nothing is hidden or smaller */
    bool rigid;                /* its shape never changes */
    uint32_t gap_class;        /* its class for gaps */
    gis_spool_rings given;     /* the shape that it had before it became larger, borrowed; none if it did not */
    double reach;              /* its box is enlarged by this on all sides; 0 except for a barrier */
    uint64_t place;            /* offset of its record in the spool that it was read from */
} gis_spool_feature;

/* The box of the shape of its demands, and of the one that it had before it became larger; box[0] > box[2] if both are
 * empty. */
void gis_spool_feature_box(const gis_spool_feature *feature, double box[4]);
gis_spool_rings gis_spool_rings_of(const sunder_shape *shape);
bool gis_spool_rings_shape(const gis_spool_rings *rings, sunder_shape **out, gis_error *error);

typedef struct gis_spool_cell {
    double box[4]; /* xmin, ymin, xmax, ymax of all its shapes; box[0] > box[2] if all of them are empty */
    size_t features, vertices;
    unsigned part; /* number of its part, from 0 */
} gis_spool_cell;

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

typedef struct gis_spool_writer gis_spool_writer;

/* Creates a spool in an existing directory; an old spool in it stays until the new one is complete. frame: the box in
 * which features are expected, or NULL. If many features are outside of it, or all are in a small corner of it, they
 * are sorted again at the end. */
bool gis_spool_create(const char *directory, const double frame[4], gis_spool_writer **out, gis_error *error);
/* Adds a feature; each index once, in any order. The rings of the shape are stored as they were given
 * (sunder_shape_given()). */
bool gis_spool_add(gis_spool_writer *writer, const gis_spool_feature *feature, gis_error *error);

/* Called once for each feature when all have been added: sets the weight, the limit and (if the feature was added with
 * one) the block of its demands. The shape is NULL. If it returns false for a feature, the spool fails with the message
 * for the first such feature in input order. */
typedef bool gis_spool_settle(void *user, gis_spool_feature *feature, gis_error *error);

/* Sorts the features, divides them into cells, assigns the cells to `parts` parts (1 or more), and puts the files in
 * place. settle may be NULL. */
bool gis_spool_finish(gis_spool_writer *writer, unsigned parts, gis_spool_settle *settle, void *user, gis_error *error);
/* Frees a writer, and removes the temporary files of a spool that was not finished. */
void gis_spool_writer_free(gis_spool_writer *writer);

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

typedef struct gis_spool gis_spool;

/* Opens a spool. Fails if a file is missing, cut off, of another version or byte order, or not as it was written. */
bool gis_spool_open(const char *directory, gis_spool **out, gis_error *error);
void gis_spool_close(gis_spool *spool);

size_t gis_spool_features(const gis_spool *spool);
size_t gis_spool_vertices(const gis_spool *spool); /* as they were given; the sum over all cells */
unsigned gis_spool_parts(const gis_spool *spool);
/* A checksum of all contents. */
uint64_t gis_spool_checksum(const gis_spool *spool);
size_t gis_spool_cells(const gis_spool *spool);
const gis_spool_cell *gis_spool_cell_at(const gis_spool *spool, size_t cell);

/* The text of id is valid until the next feature is read. The shape belongs to the visitor, whatever it returns;
 * returning false ends the visit. */
typedef bool gis_spool_visit(void *user, const gis_spool_feature *feature, gis_error *error);
/* Visits each feature of a cell after the checksum of the cell was verified. */
bool gis_spool_read(gis_spool *spool, size_t cell, gis_spool_visit *visit, void *user, gis_error *error);
/* Visits the feature at a place that an earlier visit reported. */
bool gis_spool_read_one(gis_spool *spool, uint64_t place, gis_spool_visit *visit, void *user, gis_error *error);
/* Like gis_spool_read(), but several times faster, since shapes and lines are not made or checked: the visitor gets the
 * box, as in a gis_spool_cell, and the number of vertices. */
typedef bool gis_spool_glance(void *user, const gis_spool_feature *feature, const double box[4], size_t vertices,
                              gis_error *error);
bool gis_spool_skim(gis_spool *spool, size_t cell, gis_spool_glance *glance, void *user, gis_error *error);
/* Lists the boxes of the features of a cell that have a non-empty shape; box[] must have room for all features of the
 * cell. */
bool gis_spool_boxes(gis_spool *spool, size_t cell, double (*box)[4], size_t *n, gis_error *error);

#endif
