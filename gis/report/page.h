/* page.h: the page of --report: one HTML file that shows a separated layer, and needs nothing beside itself. */
#ifndef GIS_REPORT_PAGE_H
#define GIS_REPORT_PAGE_H

#include "base/text.h"
#include "layer/layer_input.h"
#include "layer/result_view.h"

/* An option of the run, as it was given; value "": it takes none. */
typedef struct gis_page_option {
    char *name, *value;
} gis_page_option;

/* What the page is about. All of it is borrowed. */
typedef struct gis_page_request {
    const gis_layer_input *input; /* only its rules and the source's names are used */
    const gis_result_view *view;
    const sunder_layer_summary *summary;
    const char *unit;   /* of coordinates: the name that the CRS has for it */
    const char *output; /* where the layers went */
    const char *main_layer;
    bool verified;
    double optimality_gap;
    const gis_sentences *losses;
    const gis_page_option *options;
    size_t n_options;
    double seconds_read, seconds_write; /* what the summary has no figures of */
} gis_page_request;

/* Adds the whole page. The bytes depend on the request alone, and on SOURCE_DATE_EPOCH if that is set. */
bool gis_page_write(const gis_page_request *request, gis_text *to, gis_error *error);

#endif
