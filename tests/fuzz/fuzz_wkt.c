/* Hostile texts of SHAPEs: WKT, discs, squares, lengths with units. */
#include "base/length.h"
#include "read/shape_text.h"
#include "sunder.h"

#include "bytes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A refusal gives a reason; a text that is accepted without repair gives the same shape with repair. */
static void ask_wkt(const char *text)
{
    sunder_shape *strict = NULL, *repaired = NULL;
    gis_error error = {0};
    double building;
    if (gis_shape_of_wkt(text, "P", GIS_INVALID_FAIL, &strict, &building, &error)) {
        FUZZ_DEMAND(strict != NULL);
        FUZZ_DEMAND(gis_shape_of_wkt(text, "P", GIS_INVALID_REPAIR, &repaired, &building, &error));
        FUZZ_DEMAND(sunder_shape_area(strict) == sunder_shape_area(repaired));
        FUZZ_DEMAND(sunder_shape_vertices(strict) == sunder_shape_vertices(repaired));
    } else {
        FUZZ_DEMAND(error.message[0] != 0);
    }
    sunder_shape_free(strict);
    sunder_shape_free(repaired);
}

static void ask_shape(const char *text)
{
    const gis_crs_units units = {.has_crs = true, .unit_metres = 0.3048, .scale = 25000};
    sunder_shape *shape = NULL;
    gis_error error = {0};
    if (!gis_shape_is_text(text) || text[0] == '@') return; /* data sources and files are not read here */
    if (gis_shape_from_text(text, "P", &units, GIS_INVALID_FAIL, &shape, NULL, &error)) {
        double box[4];
        sunder_shape_box(shape, box);
        FUZZ_DEMAND(box[0] <= box[2] && box[1] <= box[3]);
    } else {
        FUZZ_DEMAND(error.message[0] != 0);
    }
    sunder_shape_free(shape);
}

static void ask_length(const char *text)
{
    const char *why = NULL;
    gis_length length = {-1, GIS_LAYER_UNIT};
    if (gis_length_parse(text, strlen(text), &length, &why))
        FUZZ_DEMAND(length.value >= 0 && isfinite(length.value));
    else
        FUZZ_DEMAND(why && why[0] && length.value == -1);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    if (!text) return 0;
    memcpy(text, data, size);
    text[size] = 0;
    ask_wkt(text);
    ask_shape(text);
    ask_length(text);
    free(text);
    return 0;
}
