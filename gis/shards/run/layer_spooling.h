/* layer_spooling.h: reads a whole layer a batch at a time, by the rules of `separate`: its features onto the disk
 * (shards/spool/spool.h), and facts about all of them. */
#ifndef GIS_LAYER_SPOOLING_H
#define GIS_LAYER_SPOOLING_H

#include "layer/gap_rules.h"
#include "shards/parts/contact_group.h"
#include "shards/spool/spool.h"

/* Facts about the whole layer, which a part does not have. Members are as in gis_layer_input where the names are the
 * same. */
typedef struct gis_layer_facts {
    char *name; /* owned */
    gis_source_facts source;
    gis_crs_units units;
    double gap, least_gap, max_shift, tolerance;
    double longest_limit; /* the longest move that any feature may make; 0: none may move */
    double barrier_reach;
    bool points;
    bool has_id; /* --id-field is given, and its values are of type id_type: OFTInteger64, OFTReal or OFTString */
    OGRFieldType id_type;
    size_t invalid, null, other;
    size_t skipped;  /* number of features that conflict with nothing; they are not in the spool */
    size_t aside;    /* number of skipped features that are in GIS_SPOOL_ASIDE */
    size_t enlarged; /* number of features made larger */
    size_t vertices; /* of all shapes after cleaning, as sunder_layer_summary counts them */
    double box[4];   /* of all features that may conflict; box[0] > box[2]: there are none */
    /* The classes for gaps that features have. */
    bool class_there[GIS_MOST_CLASSES];
    bool multi;              /* a shape has several polygons, so symbols are written as MultiPolygons */
    uint64_t checksum;       /* of everything that determines the moves, as it was read (layer/layer_checksum.h) */
    gis_contact_group group; /* the largest contact group in the input, or a set that contains it (shard_run.c) */
} gis_layer_facts;

/* Subdirectory with a second spool: features that conflict with nothing, but have a shape and will be drawn. It exists
 * only if there are any. */
#define GIS_SPOOL_ASIDE "aside"

/* The bytes of each feature in the file `status`: its status; and if features may have other shapes, the diameter of
 * the largest disc in its shape as read, a double. */
size_t gis_layer_status_bytes(const gis_layer_rules *rules);

/* Reads the layer, with all warnings, into the files `features` and `cells` of an existing directory, divided into
 * `shards` shards. The file `status` gets gis_layer_status_bytes() for each feature, in input order, first the
 * sunder_feature_status that the feature would have alone, as one byte, without a move (a fixed member fixes its whole
 * block, which is not known here). Ids in the spool are texts: integers, reals with 17 digits, or strings. Barriers go
 * into `barriers` (shards/spool/barrier_spool.h). Memory is needed for a batch, a run of the spool's sorter, the
 * distinct values of --block-field and, with --weight, 8 bytes per feature. */
bool gis_layer_spool(const gis_layer_input_request *request, unsigned shards, const char *directory,
                     gis_layer_facts *facts, gis_error *error);
void gis_layer_facts_clear(gis_layer_facts *facts);
/* Spools the barriers within reach of the features in `features`, as the barriers' sources are now, into `barriers` of
 * the directory. */
bool gis_layer_spool_barriers(const gis_layer_input *input, double reach, gis_spool *features, const char *directory,
                              gis_error *error);

#endif
