/* resolve_common.c: what the requests of several commands have (resolve_common.h). */
#include "commands/resolve_common.h"

#include <math.h>
#include <string.h>

bool gis_resolve_choice(const gis_options *options, gis_option_id id, const char *(*word)(unsigned), unsigned *number,
                        gis_error *error)
{
    const char *given = options->text[id];
    for (unsigned i = 0; word(i)[0]; i++)
        if (given && strcmp(word(i), given) == 0) {
            *number = i;
            return true;
        }
    gis_fail_usage(error, "%s: the library does not know the name %s", gis_option_table[id].names,
                   given ? given : "(none)");
    return false;
}

static const char *invalid_word(unsigned i) { return gis_invalid_string((gis_invalid_policy)i); }

bool gis_resolve_invalid(const gis_options *options, gis_invalid_policy *out, gis_error *error)
{
    unsigned policy;
    if (!gis_resolve_choice(options, OPT_INVALID, invalid_word, &policy, error)) return false;
    *out = (gis_invalid_policy)policy;
    return true;
}

/* The largest number of threads that is used. If an option asks for more, which is probably a typing error, this
 * many are used, without a message. */
static const double most_threads = 4096;

uint64_t gis_resolve_seed(const gis_options *options)
{
    return options->given[OPT_SEED] ? (uint64_t)options->number[OPT_SEED] : 0;
}

unsigned gis_resolve_threads(const gis_options *options)
{
    return options->given[OPT_THREADS] ? (unsigned)fmin(options->number[OPT_THREADS], most_threads) : 0;
}

gis_optional_length gis_resolve_length(const gis_options *options, gis_option_id id)
{
    return (gis_optional_length){options->text[id], options->length[id]};
}

const char *gis_resolve_output(const gis_options *options) { return options->operand[options->command->most - 1]; }

gis_source_request gis_resolve_source(const gis_options *options)
{
    return (gis_source_request){
        .path = options->operand[options->command->bit == GIS_FOLLOW ? 1 : 0],
        .drivers = options->list[OPT_IF],
        .open_options = options->list[OPT_OO],
        .layer = options->text[OPT_INPUT_LAYER],
        .sql = options->text[OPT_SQL],
        .dialect = options->text[OPT_DIALECT],
        .where = options->text[OPT_WHERE],
        .bbox = options->given[OPT_BBOX] ? options->box : NULL,
        .input_crs = options->text[OPT_INPUT_CRS],
    };
}
