/* Which features become smaller or are left out, because a layout of all of them does not exist. See hiding.c. */
#ifndef SUNDER_I_HIDING_H
#define SUNDER_I_HIDING_H

#include "displacement/hide/cover.h"
#include "displacement/report/influence.h"

/* The conflict that a clause was made of, by the caller's numbers. */
typedef struct sunder_i_clause_source {
    size_t first; /* that of the clause */
    size_t a, b;
    sunder_reason reason;
    bool crowded;
    size_t choice;       /* the number of choices before it was found */
    sunder_proof *proof; /* NULL if there is none, or if proofs are not kept */
} sunder_i_clause_source;

/* What a round does. */
typedef enum sunder_i_hiding_step {
    SUNDER_I_HIDING_QUICK,    /* a layout without effort, which finds most clauses */
    SUNDER_I_HIDING_PROVE,    /* proofs with the caller's effort for the conflicts of that layout */
    SUNDER_I_HIDING_THOROUGH, /* a layout with the caller's effort */
    SUNDER_I_HIDING_END       /* the last layout remains; its conflicts are among features that may become no smaller */
} sunder_i_hiding_step;

/* The work on one layer. Features are numbered as the caller numbers them, barrier k as the number of features + k. */
typedef struct sunder_i_hiding {
    const sunder_layer *layer;  /* borrowed */
    uint32_t *level;            /* [n] the present choice ... */
    bool *hidden;               /* [n] ... which of the features are hidden ... */
    const sunder_shape **shape; /* [n] ... and the shapes of all others; NULL: no feature has smaller ones */
    sunder_i_clauses clauses;
    sunder_i_clause_source *source; /* [sources] ascending by `first` */
    size_t sources, source_room;
    bool keep_proofs;             /* of the clauses */
    uint32_t *times;              /* [n] the number of clauses that each was in since shapes are as given */
    bool smallest;                /* everything that is not hidden has its smallest shape */
    sunder_i_hiding_step step;    /* the next one */
    size_t choices;               /* the number of choices so far */
    bool *stays;                  /* [n] hidden features that are not shown again, since more conflicts remained then */
    sunder_i_list shown;          /* those that were shown again last ... */
    sunder_i_list conflict;       /* ... and a body of each conflict of the layout before */
    sunder_i_influence influence; /* of all layouts, if the models record reads */
} sunder_i_hiding;

/* Begins with nothing hidden. The caller frees it, also after a failure. */
sunder_status sunder_i_hiding_begin(const sunder_layer *layer, sunder_i_hiding *hiding, sunder_error *err);
void sunder_i_hiding_free(sunder_i_hiding *hiding);
/* Learns from the conflicts that remain in a layout with the present choice, chooses again, and sets the next step.
 *
 * number  [things of the model] the caller's numbers
 * report  the proofs that are kept are taken from it */
sunder_status sunder_i_hiding_learn(sunder_i_hiding *hiding, const sunder_i_model *model, const uint32_t *number,
                                    sunder_report *report, sunder_error *err);
/* Takes over the levels: what is hidden, and the shapes of all others. */
void sunder_i_hiding_take_levels(sunder_i_hiding *h);

/* ---- unhide.c ---------------------------------------------------------------------------------------------------- */

/* Sets the level of hidden features to 0 that would be in no conflict with the others, nor with each other, at their
 * places in the layout; the most important ones first. Sets *any to whether there are such. number: as above. */
sunder_status sunder_i_hiding_unhide(sunder_i_hiding *hiding, const sunder_i_model *model,
                                     const sunder_i_placement *placement, const uint32_t *number, bool *any,
                                     sunder_error *err);
/* Lists the conflicts of a layout, to be compared with the next one. */
sunder_status sunder_i_hiding_note_conflicts(sunder_i_hiding *hiding, const sunder_i_model *model,
                                             const sunder_report *report, sunder_error *err);
/* Hides again, for good, what was shown last in worlds of this layout with more conflicts than were noted. Sets *any to
 * whether there is such. */
sunder_status sunder_i_hiding_hide_again(sunder_i_hiding *hiding, const sunder_i_model *model, const uint32_t *number,
                                         const sunder_report *report, bool *any, sunder_error *err);
/* Is the conflict one of the layout, and not of a pair that may stay as it is? */
static inline bool sunder_i_hiding_counts(const sunder_conflict *conflict)
{
    return !conflict->inside_block && conflict->reason != SUNDER_REASON_KEPT;
}

/* ---- hiding_report.c --------------------------------------------------------------------------------------------- */

/* Writes what is hidden or smaller, and what is proved of it, to the report, which receives the proofs of the
 * clauses and the levels. */
sunder_status sunder_i_hiding_report(sunder_i_hiding *hiding, sunder_report *report, sunder_error *err);

#endif
