/* resolve_common.h: parts that the requests of several commands have. */
#ifndef GIS_RESOLVE_COMMON_H
#define GIS_RESOLVE_COMMON_H

#include "commands/resolve.h"

/* *number becomes the index of the option's value in an enumeration. word(i) is the name of enumerator i; "" marks the
 * end. Fails if the enumeration has no such name, that is, if it and the table of options differ. */
bool gis_resolve_choice(const gis_options *options, gis_option_id id, const char *(*word)(unsigned), unsigned *number,
                        gis_error *error);
bool gis_resolve_invalid(const gis_options *options, gis_invalid_policy *out, gis_error *error);
uint64_t gis_resolve_seed(const gis_options *options);
/* Returns the number of threads; 0: one for each processor. */
unsigned gis_resolve_threads(const gis_options *options);
/* Returns the operand OUTPUT, which is the last operand of every command; NULL if it was not given. */
const char *gis_resolve_output(const gis_options *options);
/* Returns the request for the operand that messages call INPUT or OBSTACLES. */
gis_source_request gis_resolve_source(const gis_options *options);

#endif
