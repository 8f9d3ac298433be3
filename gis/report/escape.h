/* escape.h: texts of the user's (names, attributes, paths) as parts of a page: whatever bytes they are, they end up as
 * characters that are shown, and never as markup or as program. */
#ifndef GIS_REPORT_ESCAPE_H
#define GIS_REPORT_ESCAPE_H

#include "base/text.h"

/* As text of an element, or within a quoted attribute. */
void gis_escape_markup(gis_text *to, const char *words);
/* As a JSON string, quotes and all, that may stand in a script element. */
void gis_escape_script(gis_text *to, const char *words);

#endif
