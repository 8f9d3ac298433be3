/* sheet.h: a specification of a map sheet (--spec), as JSON: its scale, its layers, and the gaps between their classes.
 * It becomes the options of a command, as if they had been given; options of the command line override it. */
#ifndef GIS_SHEET_H
#define GIS_SHEET_H

#include "base/json.h"
#include "layer/gap_rules.h"
#include "legible/legible.h"
#include "options/options.h"

/* What holds for one layer that moves. */
typedef struct gis_sheet_moving {
    gis_gap_classes gaps; /* those of the sheet, with the class or field of this layer */
    gis_legible_rules legible;
} gis_sheet_moving;

typedef struct gis_sheet {
    struct json_object *root, *effective; /* as in the file; with the options of the command line in it */
    const char *path;                     /* of the file, as given */
    char *directory;                      /* relative paths in the file are relative to it */
    char *stem;                           /* the name of the file without its ending */
    gis_gap_classes gaps;                 /* name, rule and of_barrier are owned here */
    gis_sheet_moving *of_layer;           /* [moving] */
    size_t moving;                        /* the number of layers that move */
    gis_along *along;                     /* [followers] the layers that go along */
    size_t followers;
    const char **name;     /* [gaps.classes] borrowed from `root`; name[0] is NULL */
    gis_gap_rule *rule;    /* [gaps.rules] */
    uint32_t *of_barrier;  /* [barriers] */
    size_t barriers;       /* the number of values of --barrier that were made from layers */
    bool said[OPT_N];      /* the options that the command line gave */
    bool classes_by_field; /* a layer has its classes in a field, so any name may be one */
} gis_sheet;

/* Reads the file of --spec, if it is given, and sets the options that it has and the command line has not. With
 * --print-spec the options are not checked for a run. Errors name the place in the file. The caller clears *out, on
 * failure, too, and after the options, which borrow from it. */
bool gis_sheet_apply(gis_options *options, gis_sheet *out, gis_error *error);
void gis_sheet_clear(gis_sheet *sheet);

/* Puts gaps by classes as an object, for a plan to store; barriers: the number of values of --barrier. */
void gis_sheet_put_gaps(gis_json *out, const gis_gap_classes *gaps, size_t barriers);
/* Sets the gaps by classes of options from such an object. The caller clears *out as after gis_sheet_apply(). */
bool gis_sheet_take_gaps(const char *text, gis_options *options, gis_sheet *out, gis_error *error);

/* Prints the sheet with the options of the command line in it to stdout, as JSON. */
void gis_sheet_print(const gis_sheet *sheet);
/* Prints the JSON Schema of sheets to stdout. */
bool gis_sheet_print_schema(gis_error *error);

#endif
