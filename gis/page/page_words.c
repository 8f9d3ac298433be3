/* page_words.c: see page_words.h. */
#include "page/page_words.h"

#include <stddef.h>

#define N_OF(array) (sizeof(array) / sizeof *(array))

const char *gis_page_kind(sunder_conflict_kind kind)
{
    static const char *const words[] = {
        [SUNDER_CONFLICT_OVERLAP] = "overlap",
        [SUNDER_CONFLICT_TOO_CLOSE] = "too close",
        [SUNDER_CONFLICT_BARRIER] = "on a barrier",
        [SUNDER_CONFLICT_BARRIER_DRAWN] = "within the drawn width of a barrier",
        [SUNDER_CONFLICT_BARRIER_NEAR] = "too close to a barrier",
        [SUNDER_CONFLICT_CONTAINED] = "one within the other",
        [SUNDER_CONFLICT_DUPLICATE] = "duplicate",
        [SUNDER_CONFLICT_TIGHT] = "tight",
    };
    return (size_t)kind < N_OF(words) && words[kind] ? words[kind] : sunder_conflict_kind_string(kind);
}

/* The reason of a crowded conflict; it is distinguished only in texts for readers. */
enum { CROWDED = SUNDER_REASON_ROW + 1 };

static const struct {
    const char *word, *explanation;
    bool proved;
} reasons[] = {
    [SUNDER_REASON_MAX_SHIFT] = {"moves too short",
                                 "proved: the two alone cannot be separated within the limits of their moves", true},
    [SUNDER_REASON_FIXED] = {"both fixed", "neither of the two may move", true},
    [SUNDER_REASON_SIDE] = {"side of a barrier",
                            "proved: the two alone cannot be separated unless one crosses a barrier to its other side",
                            true},
    [SUNDER_REASON_JUMP] = {"no jumps", "proved: the two alone cannot be separated unless one jumps over the other",
                            true},
    [SUNDER_REASON_NO_ROOM] =
        {"no room",
         "proved: together with the features that block them, the two have no solution; none of these "
         "features can be left out of the proof",
         true},
    [SUNDER_REASON_SAME_BLOCK] = {"same block", "the two move as one", true},
    [SUNDER_REASON_KEPT] = {"kept", "the two are allowed to overlap", true},
    [SUNDER_REASON_UNRESOLVED] = {"unresolved", "neither a solution was found, nor a proof that there is none", false},
    [SUNDER_REASON_ROW] = {"row", "proved: the two alone cannot be separated unless they break the order of their row",
                           true},
    [CROWDED] = {"crowded",
                 "proved: some pair among these two and the features that block them has to stay in conflict; none of "
                 "these features can be left out of the proof",
                 true},
};

size_t gis_page_reasons(void) { return N_OF(reasons); }

size_t gis_page_reason_of(const sunder_conflict *conflict) { return conflict->crowded ? CROWDED : conflict->reason; }

const char *gis_page_reason(size_t reason)
{
    return reasons[reason].word ? reasons[reason].word : sunder_reason_string((sunder_reason)reason);
}

const char *gis_page_explanation(size_t reason) { return reasons[reason].word ? reasons[reason].explanation : ""; }

bool gis_page_is_proved(const sunder_conflict *conflict) { return reasons[gis_page_reason_of(conflict)].proved; }
