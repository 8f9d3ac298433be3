/* page.h: the page of --report, one HTML file that shows a separated layer and loads no other file. */
#ifndef GIS_PAGE_H
#define GIS_PAGE_H

#include "base/text.h"
#include "layer/layer_input.h"
#include "layer/result_view.h"

/* An option of the run as it was given; value is "" for an option without a value. */
typedef struct gis_page_option {
    char *name, *value;
} gis_page_option;

/* The content of the page. Everything is borrowed. */
typedef struct gis_page_request {
    const gis_layer_input *input; /* only its rules and the names of the source are used */
    const gis_result_view *view;
    const gis_hiding *hiding; /* NULL unless features may be hidden */
    const sunder_layer_summary *summary;
    const char *unit;   /* the name that the CRS gives to the unit of coordinates */
    const char *output; /* the path of the output */
    const char *main_layer;
    bool verified;
    double optimality_gap;
    const gis_sentences *losses;
    const gis_page_option *options;
    size_t n_options;
    double seconds_read, seconds_write; /* times that the summary does not contain */
} gis_page_request;

/* Adds the whole page. Its bytes depend only on the request, and on the environment variable SOURCE_DATE_EPOCH if that
 * is set; else also on the date. */
bool gis_page_write(const gis_page_request *request, gis_text *to, gis_error *error);

#endif
