/* page_words.h: the names of kinds of conflict and of reasons on the page, and their explanations. A kind or a reason
 * without a text here is shown by its name in the output layers. */
#ifndef GIS_PAGE_WORDS_H
#define GIS_PAGE_WORDS_H

#include "sunder.h"

const char *gis_page_kind(sunder_conflict_kind kind);
/* Reasons as the page distinguishes them, numbered from 0; the reason of crowded conflicts is the last one. */
size_t gis_page_reasons(void);
size_t gis_page_reason_of(const sunder_conflict *conflict);
const char *gis_page_reason(size_t reason);
/* Returns the explanation of a reason, a sentence; "" if there is none. */
const char *gis_page_explanation(size_t reason);
/* Returns whether it is proved that the conflict has no solution; for a crowded conflict, that some pair of its group
 * must stay in conflict. */
bool gis_page_is_proved(const sunder_conflict *conflict);

#endif
