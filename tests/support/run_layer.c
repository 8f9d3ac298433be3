#include "run_layer.h"

#include "upheld.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static sunder_report *run(const sunder_feature *feature, size_t n, const sunder_layer_options *options, bool check)
{
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    sunder_error err;
    if (sunder_layer_new(feature, n, &layer, &err) || (check ? sunder_layer_check(layer, options, &report, &err)
                                                             : sunder_layer_separate(layer, options, &report, &err)))
        fail_msg("%s", err.message);
    sunder_layer_free(layer);
    return report;
}

sunder_report *run_separate(const sunder_feature *feature, size_t n, const sunder_layer_options *options)
{
    sunder_report *report = run(feature, n, options, false);
    const char *worse = upheld_breach(feature, n, options, report);
    if (worse) fail_msg("%s", worse);
    return report;
}

sunder_report *run_check(const sunder_feature *feature, size_t n, const sunder_layer_options *options)
{
    return run(feature, n, options, true);
}
