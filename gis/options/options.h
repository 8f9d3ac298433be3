/* options.h: the table of options. The parser (options.c), --help (help.c) and --options-json (options_json.c) are
 * generated from it; other programs read the latter, and tests compare all of them with the manual page. */
#ifndef GIS_OPTIONS_H
#define GIS_OPTIONS_H

#include "base/gis_error.h"
#include "base/length.h"

/* The commands, as bits. */
enum {
    GIS_SEPARATE = 1,
    GIS_CHECK = 2,
    GIS_SUM = 4,
    GIS_PAIR = 8,
    GIS_BUFFER = 16,
    GIS_ROUTE = 32,
    GIS_PLAN = 64, /* has the options of separate that parts of a layer can have */
    GIS_MERGE = 128,
    GIS_FOLLOW = 256,
    GIS_LAYERS = GIS_SEPARATE | GIS_CHECK | GIS_PLAN,
    GIS_SHAPES = GIS_SUM | GIS_PAIR,
    GIS_ALL = GIS_LAYERS | GIS_SHAPES | GIS_BUFFER | GIS_ROUTE | GIS_FOLLOW,
    GIS_EVERY = GIS_ALL | GIS_MERGE
};

/* clang-format off */
typedef enum gis_option_id {
    OPT_GAP, OPT_LEAST_GAP, OPT_BARRIER, OPT_MAX_SHIFT, OPT_MAX_SHIFT_FIELD, OPT_WEIGHT, OPT_WEIGHT_FIELD,
    OPT_FIXED_WHERE, OPT_IGNORE_WHERE, OPT_TOUCH_TOLERANCE, OPT_BLOCK_FIELD, OPT_NO_BLOCKS, OPT_CONTAINED,
    OPT_ALLOW_JUMPS, OPT_ROWS, OPT_ROW_STIFFNESS, OPT_EASE, OPT_PREFER_DX, OPT_PREFER_DY,
    OPT_PREVIOUS, OPT_PREVIOUS_RELAX, OPT_LINKS, OPT_LINKS_RADIUS,
    OPT_HIDE, OPT_HIERARCHY_FIELD, OPT_HIDE_WEIGHT,
    OPT_DROP_HIDDEN, OPT_TRIM, OPT_TRIM_KEEP, OPT_INSET, OPT_MIN_SIZE, OPT_ENLARGE, OPT_SYMBOL_SIZE, OPT_RIGID_WHERE,
    OPT_CROSSED,
    OPT_SYMBOL, OPT_SYMBOL_FIELD, OPT_SYMBOL_SIZE_FIELD,
    OPT_ID_FIELD, OPT_LIST_INSIDE,
    OPT_BEFORE, OPT_HIDDEN_FIELD, OPT_BY, OPT_EFFORT, OPT_SCALE,
    OPT_REFLECT, OPT_EXACT, OPT_ALGORITHM, OPT_DECOMPOSITION, OPT_ORDER, OPT_PLANAR_MAP, OPT_ROBOT,
    OPT_FROM, OPT_TO, OPT_FREE_SPACE, OPT_SHARDS, OPT_SHARD,
    OPT_ALLOW_CONFLICTS,
    OPT_SHAPE, OPT_OPERATION, OPT_DISSOLVE, OPT_DISSOLVE_FIELD, OPT_EXPLODE, OPT_ALIGN, OPT_DEGENERATE,
    OPT_SPEC, OPT_PRINT_SPEC,
    OPT_INPUT_LAYER, OPT_WHERE, OPT_SQL, OPT_DIALECT, OPT_BBOX, OPT_IF, OPT_OO, OPT_CONFIG, OPT_INPUT_CRS,
    OPT_OUTPUT, OPT_OF, OPT_NLT, OPT_LCO, OPT_CO, OPT_OUTPUT_LAYER, OPT_LAYERS, OPT_OVERWRITE, OPT_UPDATE,
    OPT_OVERWRITE_LAYER, OPT_OGR_OVERWRITE, OPT_NO_STYLES,
    OPT_INVALID, OPT_STRICT, OPT_ALLOW_INEXACT_OUTPUT,
    OPT_THREADS, OPT_MAX_MEMORY, OPT_TRACE, OPT_SEED, OPT_PROGRESS, OPT_QUIET, OPT_STATS, OPT_REPORT, OPT_PROOF,
    OPT_LOG, OPT_MESSAGES, OPT_HELP,
    OPT_N
} gis_option_id;
/* clang-format on */

/* The type of an option's value. Types of text are distinguished for programs that offer choices: shell completion,
 * dialogues. */
typedef enum gis_option_type {
    GIS_TYPE_FLAG,
    GIS_TYPE_TEXT,
    GIS_TYPE_LAYER,     /* the name of a layer of INPUT */
    GIS_TYPE_FIELD,     /* the name of a field of that layer */
    GIS_TYPE_SQL,       /* an SQL condition on its features */
    GIS_TYPE_STATEMENT, /* an SQL statement */
    GIS_TYPE_SHAPE,
    GIS_TYPE_POINT,   /* coordinates X,Y */
    GIS_TYPE_DATASET, /* a dataset that is read */
    GIS_TYPE_OUTPUT,  /* a dataset that is written */
    GIS_TYPE_FILE,    /* a file that is written */
    GIS_TYPE_FORMAT,  /* a driver of GDAL */
    GIS_TYPE_CRS,
    GIS_TYPE_CHOICE,   /* one word of metavar, which are separated by '|' */
    GIS_TYPE_CHOICES,  /* several words of metavar; in both, words are separated by commas */
    GIS_TYPE_LENGTH,   /* a gis_length >= 0 */
    GIS_TYPE_COUNT,    /* an integer >= 0 */
    GIS_TYPE_NUMBER,   /* a decimal >= 0 */
    GIS_TYPE_SCALE,    /* N or 1:N, > 0 */
    GIS_TYPE_BOX,      /* four numbers separated by commas, or four arguments as of -spat */
    GIS_TYPE_OPTIONAL, /* a flag, or =metavar as its value */
    /* options of the types below may be repeated */
    GIS_TYPE_BARRIERS, /* a dataset with keys, as of --barrier */
    GIS_TYPE_FORMATS,  /* a driver of GDAL for each value */
    GIS_TYPE_SETTINGS, /* K=V */
    GIS_TYPE_PAIRS     /* K=V, or the two arguments K V, as older versions of GDAL accept for --config */
} gis_option_type;

/* The sections of --help. Options that are specific to sunder have a line each; the others are known from ogr2ogr. */
typedef enum gis_option_group {
    GIS_GROUP_OWN,
    GIS_GROUP_IDENTITY, /* listed in the section of GIS_GROUP_OWN */
    GIS_GROUP_PLACES,   /* which places features prefer */
    GIS_GROUP_ROOM,     /* what happens to features that cannot be given room */
    GIS_GROUP_INPUT,
    GIS_GROUP_OUTPUT,
    GIS_GROUP_TROUBLE,
    GIS_GROUP_RUNNING,
    GIS_GROUP_HIDDEN, /* not listed: an alternative spelling, described with its option */
    GIS_N_GROUPS
} gis_option_group;

typedef struct gis_option {
    gis_option_id id;
    const char *names; /* the long name, then other spellings, separated by blanks */
    gis_option_type type;
    unsigned commands;
    gis_option_group group;
    const char *metavar;  /* the placeholder of the value in --help; NULL: the option takes no value */
    const char *fallback; /* the default, as text; NULL: there is none */
    const char *help;     /* the description, with the unit of lengths */
} gis_option;

/* The table of options, indexed by gis_option_id; the order is that of --help. */
extern const gis_option gis_option_table[OPT_N];

/* The most options that may give another one its meaning. */
enum { GIS_MOST_NEEDED = 6 };
/* An option that says how others work, and means nothing unless one of them is given. */
typedef struct gis_need {
    gis_option_id option;
    size_t n;
    gis_option_id one_of[GIS_MOST_NEEDED]; /* [n]; a command may have some of them only */
} gis_need;
/* Returns what an option needs, NULL if it needs none. */
const gis_need *gis_option_need(gis_option_id option);

/* Is the option about moves, so that check has no use for it without --before? */
bool gis_option_is_of_moves(gis_option_id option);

/* May the option be repeated, each time with one more value? (A flag may be repeated, too, without effect.) */
bool gis_option_is_list(const gis_option *option);
/* Do all commands that have the option fail without it? */
bool gis_option_is_needed(const gis_option *option);

typedef struct gis_options gis_options;

/* A layer of a sheet that goes along with what moves. Texts are borrowed; NULL: not given. */
typedef struct gis_along {
    const char *source, *layer, *where, *crs;
    const char *name;     /* in the output */
    const char *by;       /* as of --by */
    const char *of;       /* the name of the layer that it goes along with; NULL: all that move */
    const char *id_field; /* the field of that layer that `by` names */
} gis_along;

typedef struct gis_command {
    unsigned bit;
    const char *name;
    const char *operands; /* the operands, as in the usage line */
    size_t least, most;   /* the least and the largest number of operands */
    const char *summary;
    const char *example;                    /* the operands and options of a typical call */
    int (*run)(const gis_options *options); /* runs the command, prints its errors and returns the exit status */
} gis_command;

extern const gis_command gis_commands[];
extern const size_t gis_n_commands;

struct gis_options {
    const gis_command *command;
    bool given[OPT_N];
    const char *text[OPT_N];  /* of options whose value is a text, CHOICE, OPTIONAL or LENGTH: the value as given, else
                               * the default of a CHOICE, or NULL */
    const char **list[OPT_N]; /* the values of a repeatable option: NULL-terminated, or NULL */
    gis_length length[OPT_N];
    double number[OPT_N]; /* the values of COUNT, NUMBER and SCALE */
    double box[4];
    const char *operand[3]; /* NULL for operands that are not given */
    size_t n_operands;
    char **owned; /* [n_owned] texts allocated here (K=V joined from two arguments) */
    size_t n_owned;
    /* Of a sheet (--spec), borrowed; NULL: none. */
    const struct gis_gap_classes *gap_classes;
    const struct gis_legible_rules *legible; /* what check asks of each feature */
    const char *sheet;                       /* it, with the other options in it, as JSON */
    /* The dataset and the layer that move, as the sheet says: check --before looks for them. */
    const char *original_source, *original_layer;
    /* If several layers of the sheet move: its name, with which the names of other results begin; the name of the layer
     * that these options are about; and the options of the other layers, which are owned. */
    const char *sheet_name, *layer_name;
    struct gis_options *more; /* [n_more] */
    size_t n_more;
    const gis_along *along; /* [n_along] borrowed: the layers of the sheet that go along */
    size_t n_along;
};

/* Parses the arguments that follow the name of the command. *out borrows the strings of argv. If --help is among them,
 * only given[OPT_HELP] is set, and nothing else is checked. All failures are usage errors (GIS_USAGE). The caller calls
 * gis_options_clear() on failure, too. */
bool gis_options_parse(const gis_command *command, int argc, char **argv, gis_options *out, gis_error *error);
void gis_options_clear(gis_options *options);

/* For options that a sheet (--spec) gives. With --spec among the arguments gis_options_parse() does not check operands,
 * and conditions between options; gis_options_finish() does so once everything is set. */
/* Stores a value of an option, as if it had been given, once more for a list. value: NULL for a flag; copied. */
bool gis_options_set(gis_options *options, gis_option_id id, const char *value, gis_error *error);
/* Sets *copy to a copy of a text that lives as long as the options. */
bool gis_options_own(gis_options *options, const char *text, const char **copy, gis_error *error);
/* Copies options; the copy borrows the texts. */
bool gis_options_copy(const gis_options *options, gis_options *copy, gis_error *error);
bool gis_options_finish(gis_options *options, gis_error *error);

/* Print --help of the program, and of one command, to stdout. */
void gis_help_program(void);
void gis_help_command(const gis_command *command);

/* --options-json: prints all commands with their operands and options to stdout as JSON. Fails if out of memory. */
bool gis_options_json(gis_error *error);

#endif
