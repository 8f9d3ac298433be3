/* config.c: see config.h. */
#include "commands/config.h"

#include <cpl_conv.h>
#include <cpl_string.h>

void gis_configure(const gis_options *options)
{
    const char **pairs = options->list[OPT_CONFIG];
    for (size_t i = 0; pairs && pairs[i]; i++) {
        char *key = NULL;
        const char *value = CPLParseNameValue(pairs[i], &key);
        if (key) CPLSetConfigOption(key, value);
        CPLFree(key);
    }
}
