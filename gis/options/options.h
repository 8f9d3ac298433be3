/* options.h: the one table of options. It feeds the parser (options.c), --help (help.c), --options-json
 * (options_json.c), from which other programs know them, and the tests that compare these with the manual page. */
#ifndef GIS_OPTIONS_H
#define GIS_OPTIONS_H

#include "base/gis_error.h"
#include "base/length.h"

/* Commands, as bits. */
enum {
    GIS_SEPARATE = 1,
    GIS_CHECK = 2,
    GIS_SUM = 4,
    GIS_PAIR = 8,
    GIS_BUFFER = 16,
    GIS_ROUTE = 32,
    GIS_PLAN = 64, /* knows what separate knows */
    GIS_MERGE = 128,
    GIS_LAYERS = GIS_SEPARATE | GIS_CHECK | GIS_PLAN,
    GIS_SHAPES = GIS_SUM | GIS_PAIR,
    GIS_ALL = GIS_LAYERS | GIS_SHAPES | GIS_BUFFER | GIS_ROUTE,
    GIS_EVERY = GIS_ALL | GIS_MERGE
};

/* clang-format off */
typedef enum gis_option_id {
    OPT_GAP, OPT_BARRIER, OPT_MAX_SHIFT, OPT_MAX_SHIFT_FIELD, OPT_WEIGHT, OPT_WEIGHT_FIELD, OPT_FIXED_WHERE,
    OPT_IGNORE_WHERE, OPT_TOUCH_TOLERANCE, OPT_BLOCK_FIELD, OPT_NO_BLOCKS, OPT_CONTAINED, OPT_ALLOW_JUMPS, OPT_SYMBOL,
    OPT_SYMBOL_FIELD, OPT_SYMBOL_SIZE_FIELD, OPT_ID_FIELD, OPT_LIST_INSIDE, OPT_BEFORE, OPT_EFFORT, OPT_SCALE,
    OPT_REFLECT, OPT_EXACT, OPT_ALGORITHM, OPT_DECOMPOSITION, OPT_ORDER, OPT_SEED, OPT_PLANAR_MAP, OPT_ROBOT,
    OPT_FROM, OPT_TO, OPT_FREE_SPACE, OPT_SHARDS, OPT_SHARD,
    OPT_ALLOW_CONFLICTS,
    OPT_SHAPE, OPT_OPERATION, OPT_DISSOLVE, OPT_DISSOLVE_FIELD, OPT_EXPLODE, OPT_ALIGN, OPT_DEGENERATE,
    OPT_INPUT_LAYER, OPT_WHERE, OPT_SQL, OPT_DIALECT, OPT_BBOX, OPT_IF, OPT_OO, OPT_CONFIG, OPT_INPUT_CRS,
    OPT_OUTPUT, OPT_OF, OPT_NLT, OPT_LCO, OPT_CO, OPT_OUTPUT_LAYER, OPT_LAYERS, OPT_OVERWRITE, OPT_UPDATE,
    OPT_OVERWRITE_LAYER, OPT_OGR_OVERWRITE, OPT_NO_STYLES,
    OPT_INVALID, OPT_STRICT, OPT_ALLOW_INEXACT_OUTPUT,
    OPT_THREADS, OPT_MAX_MEMORY, OPT_TRACE, OPT_PROGRESS, OPT_QUIET, OPT_STATS, OPT_REPORT, OPT_PROOF,
    OPT_LOG, OPT_MESSAGES, OPT_HELP,
    OPT_N
} gis_option_id;
/* clang-format on */

/* The kind of a value. The kinds of text are for programs that offer choices: a completion, a dialogue. */
typedef enum gis_option_type {
    GIS_TYPE_FLAG,
    GIS_TYPE_TEXT,
    GIS_TYPE_LAYER,     /* of INPUT */
    GIS_TYPE_FIELD,     /* of that layer */
    GIS_TYPE_SQL,       /* a condition on its features */
    GIS_TYPE_STATEMENT, /* of SQL */
    GIS_TYPE_SHAPE,
    GIS_TYPE_POINT,   /* X,Y */
    GIS_TYPE_DATASET, /* that is read */
    GIS_TYPE_OUTPUT,  /* a dataset that is written */
    GIS_TYPE_FILE,    /* that is written */
    GIS_TYPE_FORMAT,  /* a driver of GDAL */
    GIS_TYPE_CRS,
    GIS_TYPE_CHOICE,   /* one of metavar's words, parted by | */
    GIS_TYPE_CHOICES,  /* several of metavar's words, there and here parted by commas */
    GIS_TYPE_LENGTH,   /* gis_length, >= 0 */
    GIS_TYPE_COUNT,    /* an integer >= 0 */
    GIS_TYPE_NUMBER,   /* a decimal >= 0 */
    GIS_TYPE_SCALE,    /* N or 1:N, > 0 */
    GIS_TYPE_BOX,      /* four numbers with commas, or, as -spat has them, four arguments */
    GIS_TYPE_OPTIONAL, /* alone, or with =metavar */
    /* These may be given again. */
    GIS_TYPE_BARRIERS, /* a data source with its keys */
    GIS_TYPE_FORMATS,  /* a driver of GDAL each */
    GIS_TYPE_SETTINGS, /* K=V */
    GIS_TYPE_PAIRS     /* K=V; also as two arguments, K V, as older GDAL takes --config */
} gis_option_type;

/* Sections of --help. What is peculiar to the commands gets a line each; the rest is known from ogr2ogr. */
typedef enum gis_option_group {
    GIS_GROUP_OWN,
    GIS_GROUP_IDENTITY, /* listed with those of the command's own */
    GIS_GROUP_INPUT,
    GIS_GROUP_OUTPUT,
    GIS_GROUP_TROUBLE,
    GIS_GROUP_RUNNING,
    GIS_GROUP_HIDDEN, /* an alternative spelling, described with its option */
    GIS_N_GROUPS
} gis_option_group;

typedef struct gis_option {
    gis_option_id id;
    const char *names; /* the long name, then other spellings, parted by blanks */
    gis_option_type type;
    unsigned commands;
    gis_option_group group;
    const char *metavar;  /* NULL: takes no value */
    const char *fallback; /* what holds if it is not given, or NULL */
    const char *help;     /* with the unit of lengths */
} gis_option;

/* Indexed by gis_option_id, in the order of --help. */
extern const gis_option gis_option_table[OPT_N];

/* May it be given again, each time with one more value? (A flag may be, too, and means the same.) */
bool gis_option_is_list(const gis_option *option);
/* Does no command that knows it run without it? */
bool gis_option_is_needed(const gis_option *option);

typedef struct gis_options gis_options;

typedef struct gis_command {
    unsigned bit;
    const char *name;
    const char *operands; /* as in the usage line */
    size_t least, most;   /* how many operands */
    const char *summary;
    const char *example;                    /* operands and options of a usual call */
    int (*run)(const gis_options *options); /* prints its own errors; returns the exit status */
} gis_command;

extern const gis_command gis_commands[];
extern const size_t gis_n_commands;

struct gis_options {
    const gis_command *command;
    bool given[OPT_N];
    const char *text[OPT_N];  /* of texts, CHOICE, OPTIONAL, LENGTH: as given, else the fallback of a CHOICE, or NULL */
    const char **list[OPT_N]; /* values of a repeatable option: NULL-terminated, or NULL */
    gis_length length[OPT_N];
    double number[OPT_N]; /* of COUNT, NUMBER, SCALE */
    double box[4];
    const char *operand[3]; /* NULL where not given */
    size_t n_operands;
    char **owned; /* texts made here (K=V from two arguments) */
    size_t n_owned;
};

/* Reads the arguments after the command's name. Strings are borrowed. With --help among them, given[OPT_HELP] is set
 * and nothing else is asked of them. Failures are GIS_USAGE. Clear in any case. */
bool gis_options_parse(const gis_command *command, int argc, char **argv, gis_options *out, gis_error *error);
void gis_options_clear(gis_options *options);

/* --help of the program and of one command, on stdout. */
void gis_help_program(void);
void gis_help_command(const gis_command *command);

/* --options-json: all commands with their operands and options, as JSON on stdout. False if memory is out. */
bool gis_options_json(gis_error *error);

#endif
