/* words.h: what the page calls kinds of conflict and reasons, and how it explains them. A kind or a reason that has no
 * words here is shown by the word that the layers have for it. */
#ifndef GIS_REPORT_WORDS_H
#define GIS_REPORT_WORDS_H

#include "sunder.h"

const char *gis_page_kind(sunder_conflict_kind kind);
const char *gis_page_reason(sunder_reason reason);
/* A sentence; "" if there is none. */
const char *gis_page_explanation(sunder_reason reason);
/* Is it proved that the conflict could not be solved, by its reason? */
bool gis_page_is_proved(sunder_reason reason);

#endif
