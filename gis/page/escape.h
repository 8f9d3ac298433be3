/* escape.h: escapes texts of the input (names, attributes, paths) for the page. Any bytes become visible characters,
 * never markup or script. */
#ifndef GIS_PAGE_ESCAPE_H
#define GIS_PAGE_ESCAPE_H

#include "base/text.h"

/* Escapes a text for the content of an element or a quoted attribute. */
void gis_escape_markup(gis_text *to, const char *words);
/* Writes a text as a JSON string with its quotes, safe within a script element. */
void gis_escape_script(gis_text *to, const char *words);

#endif
