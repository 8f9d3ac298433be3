/* links.h: lines from old places to new ones (--links DATASET[,layer=NAME]), and the move that they give any place.
 *
 * At the start of a link the move is the link. Between starts it is linear over their Delaunay triangulation; beyond
 * its boundary it is that of the nearest point of the boundary. With a radius R, a place farther than R / 2 from all
 * starts has less of this move, one farther than R nothing. In between it decreases linearly, so the move is
 * continuous. */
#ifndef GIS_LINKS_H
#define GIS_LINKS_H

#include "base/length.h"
#include "layer/links/triangulation.h"
#include "read/source.h"

/* The parsed value of --links, and that of --links-radius. */
typedef struct gis_links_request {
    char *dataset; /* owned; NULL: not given */
    const char *layer;
    gis_optional_length radius;
} gis_links_request;

/* Parses the value of --links. Fails only if out of memory. */
bool gis_links_parse(const char *text, gis_links_request *out, gis_error *error);
void gis_links_request_clear(gis_links_request *request);

typedef struct gis_link {
    double from[2], move[2];
    gis_grid_point at; /* the start on the grid */
    GIntBig fid;
} gis_link;

typedef struct gis_links {
    gis_link *link; /* [n] sorted by their places on the grid, which are different */
    size_t n, capacity;
    double radius;            /* in units of the layer; INFINITY: there is none */
    double origin[2], cell;   /* the grid: a corner, and the side of a cell, a power of two */
    gis_grid_point *at;       /* [n] the starts on the grid */
    gis_triangulation starts; /* the starts, triangulated */
    size_t hint;
} gis_links;

/* The layer whose features the links move. */
typedef struct gis_links_surroundings {
    OGRSpatialReferenceH crs; /* NULL: none */
    const gis_crs_units *units;
    const char *output; /* path of the output, which must not replace the dataset of the links; NULL: none */
    bool update;        /* the output is updated, so it may be in that dataset */
} gis_links_surroundings;

/* Reads the links and transforms them to the layer's CRS. Fails if two start at one place and end at different ones.
 * Without links there are no moves, and a warning. Call gis_links_clear() also after a failure. */
bool gis_links_read(const gis_links_request *request, const gis_links_surroundings *around, gis_links *out,
                    gis_error *error);
void gis_links_clear(gis_links *links);

/* Puts links[n] with `from` and `move` on a grid, and triangulates their starts. Of equal links one stays. */
bool gis_links_begin(gis_links *links, const char *who, gis_error *error);
/* Sets `move` to the move of the place `at`. */
void gis_links_move(gis_links *links, const double at[2], double move[2]);

#endif
