/* sections.h: the parts of the page that are text: headings, figures, tables. Each adds HTML. */
#ifndef GIS_REPORT_SECTIONS_H
#define GIS_REPORT_SECTIONS_H

#include "report/thinning.h"

typedef bool gis_page_section(const gis_page_model *model, const gis_thinning *thinning, gis_text *to,
                              gis_error *error);

gis_page_section gis_page_title;       /* the layer's name */
gis_page_section gis_page_lede;        /* what came of the run, in a sentence or two */
gis_page_section gis_page_figures;     /* the few numbers that matter */
gis_page_section gis_page_legend;      /* parts that only some layers have */
gis_page_section gis_page_map_note;    /* how much of the layer the map draws */
gis_page_section gis_page_places;      /* close-ups, the worst first */
gis_page_section gis_page_moves;       /* the histogram */
gis_page_section gis_page_blocked;     /* the table of conflicts that remain */
gis_page_section gis_page_certificate; /* what is proved, and what was requested */
gis_page_section gis_page_colophon;    /* program and date */

/* Pairs in conflict between blocks, of every kind. */
size_t gis_page_count(const sunder_conflict_counts *counts);
/* "12 features" */
void gis_page_add_number_of(gis_text *to, size_t n, const char *one, const char *many);
/* A link that shows a window of the map: its opening tag. */
void gis_page_open_link(const double window[4], gis_text *to);
/* The name of a feature, escaped, and set apart from the words about it. */
bool gis_page_add_name(const gis_page_model *model, size_t thing, gis_text *to, gis_error *error);

#endif
