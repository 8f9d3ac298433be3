/* layer_spooling.h: a whole layer read a batch at a time, by the rules of separate: its features on disk
 * (shards/spool/spool.h), and the facts about all of them. */
#ifndef GIS_LAYER_SPOOLING_H
#define GIS_LAYER_SPOOLING_H

#include "layer/layer_input.h"
#include "shards/parts/contact_group.h"
#include "shards/spool/spool.h"

/* What a part of the layer does not tell; as in gis_layer_input where the names are the same. */
typedef struct gis_layer_facts {
    char *name; /* owned */
    gis_source_facts source;
    gis_crs_units units;
    double gap, max_shift, tolerance;
    double longest_limit; /* the longest way that any feature may go; 0: none may */
    double barrier_reach;
    bool points;
    bool has_id; /* there is an --id-field, and its values are of this type: OFTInteger64, OFTReal, OFTString */
    OGRFieldType id_type;
    size_t invalid, null, other;
    size_t skipped;          /* conflict with nothing: they are not in the spool */
    size_t aside;            /* of these, the number in GIS_SPOOL_ASIDE */
    size_t vertices;         /* of all shapes, cleaned: as sunder_layer_summary counts them */
    double box[4];           /* of all that conflicts with anything; box[0] > box[2]: nothing does */
    bool multi;              /* a shape has several members: symbols are written as MultiPolygons */
    uint64_t checksum;       /* of all that decides the moves, as it was read (layer/layer_checksum.h) */
    gis_contact_group group; /* the largest as the layer stands, or more than that (shard_run.c) */
} gis_layer_facts;

/* Where in the directory what conflicts with nothing lies, and has a shape, if it is to be drawn: a spool of its own,
 * which is there if there is any. */
#define GIS_SPOOL_ASIDE "aside"

/* Reads the layer, with all its warnings, into the files `features` and `cells` of the directory, which exists, divided
 * into `shards` shards. The file `status` gets a byte for each feature, in the order of the input: its
 * sunder_feature_status by itself, if it does not move (a fixed member fixes its whole block, which is not known here).
 * The ids in the spool are the texts of integers, or of reals with 17 digits. Barriers go into `barriers`
 * (shards/spool/barrier_spool.h). Memory is that of a batch, of a part of the spool, of the distinct values of
 * --block-field and, with --weight, of 8 bytes a feature. */
bool gis_layer_spool(const gis_layer_input_request *request, unsigned shards, const char *directory,
                     gis_layer_facts *facts, gis_error *error);
void gis_layer_facts_clear(gis_layer_facts *facts);
/* Spools the barriers within reach of the features as they stand now, and no others, into the directory's
 * `barriers`. */
bool gis_layer_spool_barriers(const gis_layer_input *input, double reach, gis_spool *features, const char *directory,
                              gis_error *error);

#endif
