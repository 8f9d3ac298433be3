/* page_words.h: what the page calls kinds of conflict and reasons, and how it explains them. A kind or a reason that
 * has no words here is shown by the word that the layers have for it. */
#ifndef GIS_PAGE_WORDS_H
#define GIS_PAGE_WORDS_H

#include "sunder.h"

const char *gis_page_kind(sunder_conflict_kind kind);
/* Reasons as the page tells them apart, from 0: that of conflicts that are crowded is behind all others. */
size_t gis_page_reasons(void);
size_t gis_page_reason_of(const sunder_conflict *conflict);
const char *gis_page_reason(size_t reason);
/* A sentence; "" if there is none. */
const char *gis_page_explanation(size_t reason);
/* Is it proved that the conflict could not be solved; or, of one that is crowded, not all that it is one of? */
bool gis_page_is_proved(const sunder_conflict *conflict);

#endif
