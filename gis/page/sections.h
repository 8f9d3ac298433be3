/* sections.h: the sections of the page that are text: headings, figures and tables. Each function adds HTML. */
#ifndef GIS_PAGE_SECTIONS_H
#define GIS_PAGE_SECTIONS_H

#include "page/thinning.h"

typedef bool gis_page_section(const gis_page_model *model, const gis_thinning *thinning, gis_text *to,
                              gis_error *error);

gis_page_section gis_page_title;       /* the layer's name */
gis_page_section gis_page_lede;        /* the request and its result, in a few sentences */
gis_page_section gis_page_figures;     /* the key figures */
gis_page_section gis_page_legend;      /* the part of the legend that only some layers have */
gis_page_section gis_page_map_note;    /* how much of the layer the map shows */
gis_page_section gis_page_places;      /* close-ups, the worst conflicts first */
gis_page_section gis_page_moves;       /* the histogram */
gis_page_section gis_page_rows;        /* the rows of neighbours, with close-ups of the most bent rows */
gis_page_section gis_page_blocked;     /* the table of remaining conflicts */
gis_page_section gis_page_hidden;      /* hidden features: sums by class, the table, close-ups */
gis_page_section gis_page_certificate; /* what is proved, and the options of the run */
gis_page_section gis_page_sheet;       /* the specification of the run, if there is one */
gis_page_section gis_page_colophon;    /* version and date */

/* Writes a specification, given as JSON; NULL: nothing. */
bool gis_page_add_sheet(const char *sheet, gis_text *to, gis_error *error);

/* Returns the number of pairs in conflict between blocks, of all kinds. */
size_t gis_page_conflict_count(const sunder_conflict_counts *counts);
/* Writes "12 features": the number, then `one` or `many`. */
void gis_page_add_number_of(gis_text *to, size_t n, const char *one, const char *many);
/* Writes the opening tag of a link that shows `window` on the map. */
void gis_page_open_link(const double window[4], gis_text *to);
/* Writes the name of a feature or barrier, escaped, in a bdi element. */
bool gis_page_add_name(const gis_page_model *model, size_t thing, gis_text *to, gis_error *error);
/* Writes a place of the list of close-ups: its two pictures and its caption, which `caption` writes. */
typedef bool gis_page_caption(const gis_page_model *model, const gis_page_place *place, gis_text *to, gis_error *error);
bool gis_page_add_place(const gis_page_model *model, const gis_page_place *place, gis_page_caption *caption,
                        gis_text *to, gis_error *error);

#endif
