/* sunder_layer.h: a whole map layer: its features, barriers and rows, how they are separated, and the report of it.
 * Part of sunder.h, which states the conventions. */
#ifndef SUNDER_LAYER_H
#define SUNDER_LAYER_H

#include "sunder_shape.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- A whole layer ---------------------------------------------------------------------------------------- */

typedef struct sunder_layer sunder_layer;

typedef enum sunder_containment {
    SUNDER_CONTAINMENT_BLOCK,   /* a feature that lies in another feature joins its block */
    SUNDER_CONTAINMENT_IGNORE,  /* a feature that lies in another feature may overlap it */
    SUNDER_CONTAINMENT_SEPARATE /* a feature that lies in another feature is separated like any other */
} sunder_containment;

/* "block", "ignore", "separate"; never NULL. */
SUNDER_API const char *sunder_containment_string(sunder_containment containment);

/* Which features count as rows: neighbours that stand side by side along a line, such as the houses of a street. */
typedef enum sunder_rows {
    SUNDER_ROWS_NONE,  /* no rows are looked for */
    SUNDER_ROWS_FOUND, /* rows are found in the layer as it is given; src/displacement/rows/README has the rules */
    SUNDER_ROWS_GIVEN  /* rows are those that sunder_layer_set_rows() has set */
} sunder_rows;

/* What one stage of sunder_layer_separate() did, for developers. Experimental: the words for passes, stages, steps and
 * outcomes may change with any version (docs/trace.md). Strings and arrays are valid during the call only. */
typedef struct sunder_trace_event {
    const char *pass;               /* the part of the whole work; NULL before the first part */
    const char *stage;              /* the stage of the pass; NULL if the pass has only one */
    int round;                      /* the round of the stage, from 1 on; 0 if the stage has no rounds */
    const char *scope;              /* what the event is about: "layer", "cluster", "group" or "pair" */
    const char *step;               /* the step of the stage; NULL for the stage as a whole */
    const char *outcome;            /* never NULL */
    const uint32_t *thing;          /* [things] features, and from the number of features on barriers; ascending */
    size_t things;                  /* 0 for the scope "layer", 2 for "pair" */
    double cost_before, cost_after; /* sums of weight times squared length of the moves; NAN if not measured */
    const char *table;              /* the table that has the stage or step (docs/trace.md); NULL if none has */
} sunder_trace_event;

/* A trace callback. It is called by the thread that called sunder_layer_separate(). The events and their order are the
 * same for every number of threads. */
typedef void (*sunder_trace)(const sunder_trace_event *event, void *user);

typedef struct sunder_layer_options {
    size_t size;            /* sizeof(sunder_layer_options) */
    double gap;             /* >= 0 */
    double touch_tolerance; /* a distance or thin overlap up to this is a touch; negative (the default): gap / 10 */
    bool no_blocks;         /* features do not join blocks by touch or containment */
    bool no_touch;          /* features do not join blocks by touch */
    double thin;            /* if the tolerance is 0: count the overlaps that this tolerance would join; 0: no count */
    bool list_inside;       /* list the pairs inside blocks too */
    sunder_containment contained;
    unsigned threads;         /* 0: one for each processor; the result is the same for every number */
    sunder_progress progress; /* NULL for none */
    void *progress_user;
    bool allow_jumps; /* features may jump over others, or out of a yard: see sunder_layer_separate() */
    double effort;    /* >= 0: a factor of the number of steps, not of the time, that the search for better layouts,
                       * for proofs, and for changes that would solve a conflict may take; 0: no search */
    uint64_t seed;    /* the seed of the random search for better layouts */
    bool keep_trees;  /* keep the trees for sunder_report_bound_trees(), which takes memory */
    bool keep_pushes; /* keep the forces for sunder_report_pushes() */
    bool keep_worlds; /* keep the worlds for sunder_report_worlds() */
    bool drop_proofs; /* sunder_report_proof() returns NULL; only the features of each proof are kept, as blocked_by */
    /* The caller may leave out a barrier if no feature comes too near to it, or crosses it, by a move no longer than
     * barrier_reach. A barrier with sides may be left out only if it is also farther than sunder_side_reach() from the
     * box of every feature. INFINITY (the default): no barrier was left out. barrier_reach must be at least the longest
     * max_shift, and with rows four gaps; need_shift of a conflict is at most barrier_reach. */
    double barrier_reach;
    sunder_trace trace; /* NULL for none */
    void *trace_user;
    sunder_rows rows; /* neighbours in a row keep their order */
    double kink;      /* a kink greater than this counts in summary.kink_share; negative (the default): gap / 10 */
    /* With rows: the stiffness K of springs between neighbours in a row, across it and along it. With u the move of one
     * relative to the other, and w the lesser of their weights, a spring costs w K (u.n)^2. The default: 3 and 0.3. */
    double row_stiffness[2];
    /* 0 (the default), or pairs that remain in conflict are eased: what a pair lacks of its distance, s, costs
     * w (4 R s + ease s^2), and the cost is least with that. w is the lesser weight of the bodies of the pair that may
     * move, R the lesser max_shift above 0 of the two, or the distance that the pair has to keep. No pair is given up,
     * and no other one made worse, for it. */
    double ease;
    /* 0 (the default), or a distance greater than the gap that features are to keep if it pays: any pair may stand
     * between the two, and is then tight. What it lacks of the full gap has the price of `ease`. The tolerance, kinks
     * and rows are measured by the full gap. */
    double full_gap;
} sunder_layer_options;

/* Returns the distance from the box (xmin, ymin, xmax, ymax) of a feature within which barriers can decide on which
 * side of them the feature is: twice the sum of the width and the height of the box. */
SUNDER_EXPERIMENTAL double sunder_side_reach(const double box[4]);

/* Sets the defaults: gap 0, tolerance gap / 10, blocks, one thread, no jumps, effort 1, seed 0. */
SUNDER_API void sunder_layer_options_init_sized(sunder_layer_options *options, size_t size);
static inline void sunder_layer_options_init(sunder_layer_options *options)
{
    sunder_layer_options_init_sized(options, sizeof *options);
}

/* The range of weights. In this range costs, forces and their squares do not leave the range of doubles. */
#define SUNDER_LEAST_WEIGHT 1e-100
#define SUNDER_GREATEST_WEIGHT 1e100

typedef struct sunder_feature {
    const sunder_shape *shape; /* remains the caller's, and must outlive the layer. NULL or empty: no conflicts */
    double weight;             /* from SUNDER_LEAST_WEIGHT to SUNDER_GREATEST_WEIGHT */
    double max_shift;          /* the limit: the greatest length of its move; INFINITY: no limit; 0: it is fixed */
    int64_t block;             /* features with equal non-negative values move as one; -1: none */
    bool fixed;                /* the feature never moves, and the others keep their distance from it */
    bool ignored;              /* the feature never moves, and is in conflict with nothing */
    bool joins_none;           /* the feature joins no block by touch or containment */
    bool may_jump;             /* the feature may jump over all others, and they over it, as with allow_jumps */
    bool in_no_row;            /* the feature is in no row that is found */
} sunder_feature;

/* Makes a layer of n features, freed by the caller with sunder_layer_free(). The array is copied, the shapes are not.
 *
 * Fails   SUNDER_EARG  a weight is out of its range, a max_shift is negative or not a number, or there are more
 *                      features than can be numbered */
SUNDER_API sunder_status sunder_layer_new(const sunder_feature *features, size_t n, sunder_layer **out,
                                          sunder_error *err);
SUNDER_API void sunder_layer_free(sunder_layer *layer);

/* A barrier: a geometry that never moves. It is drawn with the width, with round ends and joins. Features stay at least
 * width / 2 + gap away from the geometry, exactly. */
typedef struct sunder_barrier {
    sunder_obstacle geometry; /* shape and arrays remain the caller's, and must outlive the layer; it may be empty */
    double width;             /* >= 0 and finite: the full drawn width; a polygon is drawn larger by half the width */
    double gap;               /* finite: the distance from the drawn edge; negative: the gap of the layer's options */
    bool side;                /* features may not cross its lines and boundaries: see sunder_layer_separate() */
    double full_gap; /* >= 0 and finite: options.full_gap for this barrier; 0: with a negative gap that of the options,
                      * else none */
} sunder_barrier;

/* Sets the barriers of a layer, and removes those that it had. A feature and a barrier are one pair, whatever the
 * number of the barrier's lines and pieces near the feature; the cost depends on what is near. (There is one exception
 * to exactness. If members or rings of a feature cross in places that are not doubles, the feature may have walls
 * inside, and a line that lies wholly along such a wall is treated as not meeting the feature's interior.)
 *
 * Fails   SUNDER_EARG      a width or a gap is out of its range, ends of lines do not ascend, or there are more
 *                          barriers than can be numbered
 *         SUNDER_EINVALID  a coordinate is not finite */
SUNDER_API sunder_status sunder_layer_set_barriers(sunder_layer *layer, const sunder_barrier *barriers, size_t n,
                                                   sunder_error *err);

/* Sets the side anchors of features, such as the points at which symbols are drawn: see sunder_layer_separate(). A side
 * anchor that is set is used as it is, even if it is on a line of a barrier or outside the feature.
 * xy      Two coordinates for each feature, which are copied. If they are not finite, the side anchor of that feature
 *         follows from the rule of sunder_layer_separate(). NULL: all side anchors follow from the rule.
 * Fails   SUNDER_ENOMEM */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_set_side_anchors(sunder_layer *layer, const double *xy,
                                                                sunder_error *err);

/* Gives the layer rows, for options.rows == SUNDER_ROWS_GIVEN: features with equal non-negative values are one row, in
 * the order of a path that joins the nearest ones first. A block counts once.
 * row     A value for each feature, -1 for none; copied. NULL: there are no rows.
 *
 * If features of one block have different rows, functions that use them fail with SUNDER_EINVALID, and err->polygon is
 * the number of one of these features. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_set_rows(sunder_layer *layer, const int64_t *row, sunder_error *err);

/* Gaps of pairs by the classes of the two, such as houses, symbols and roads. Tables are symmetric. */
typedef struct sunder_gaps {
    size_t classes;          /* 1 to 1024 */
    const double *gap;       /* [classes * classes] finite, >= 0 */
    const double *full_gap;  /* [classes * classes] finite, not less than the gap; NULL: as the gap */
    const uint32_t *feature; /* [features] the class of each, less than `classes` */
    const uint32_t *barrier; /* [barriers] likewise */
    /* [classes] Of a part of a layer: the classes that features of the whole layer have. NULL: those of these
     * features. */
    const bool *there;
} sunder_gaps;

/* Gives the layer gaps by classes. A pair keeps the gap of its two classes, or options.gap if that is less; a barrier
 * that has a gap of its own keeps that. With options.full_gap > 0 a pair keeps the full gap of its classes, if it pays,
 * or options.full_gap if that is less. The tolerance and kinks are measured by the gaps of the options, so these should
 * be the greatest ones of the tables. need_gap of a conflict is a value of options.gap.
 * gaps    Copied. NULL: all pairs have the gap of the options. Barriers have to be set before: setting them removes the
 *         gaps.
 * Fails   SUNDER_EARG for a number that is out of its range or a table that is not symmetric, SUNDER_ENOMEM */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_set_gaps(sunder_layer *layer, const sunder_gaps *gaps,
                                                        sunder_error *err);

/* Gives features preferred places: the cost of a feature is weight * |t - p|^2, with its move t and its preferred move
 * p, and springs of rows cost nothing if both neighbours make their preferred moves. All else is relative to where the
 * features stand in the layer: limits, sides, jumps, what may not get worse, and the moves that are reported. A block
 * prefers the weighted mean of its members' moves; what does not move prefers nothing. A preferred move is rounded to
 * one for which the moved vertices are doubles, if there is one. options.keep_worlds and keep_trees may not be set.
 * move    Two numbers for each feature, which are copied. NULL: all prefer to stay.
 * Fails   SUNDER_EINVALID for a number that is not finite, SUNDER_ENOMEM */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_set_preferred(sunder_layer *layer, const double *move,
                                                             sunder_error *err);

typedef enum sunder_feature_status {
    SUNDER_FEATURE_UNMOVED,
    SUNDER_FEATURE_MOVED,
    SUNDER_FEATURE_FIXED,
    SUNDER_FEATURE_BLOCKED, /* it could move, and still has a conflict */
    SUNDER_FEATURE_SKIPPED, /* it is ignored */
    SUNDER_FEATURE_HIDDEN   /* it is left out: sunder_layer_set_hiding() in sunder_hiding.h */
} sunder_feature_status;

/* "unmoved", "moved", "fixed", "blocked", "skipped". */
SUNDER_API const char *sunder_feature_status_string(sunder_feature_status status);

typedef enum sunder_conflict_kind {
    SUNDER_CONFLICT_OVERLAP,
    SUNDER_CONFLICT_TOO_CLOSE,
    SUNDER_CONFLICT_BARRIER,       /* the interior of a feature meets a barrier's stored geometry */
    SUNDER_CONFLICT_BARRIER_DRAWN, /* it does not meet it, but is nearer to it than half of the barrier's width */
    SUNDER_CONFLICT_BARRIER_NEAR,  /* it is neither, but is nearer than half of the width plus the gap */
    SUNDER_CONFLICT_CONTAINED,
    SUNDER_CONFLICT_DUPLICATE,
    /* Only sunder_layer_check_moves() finds the following kinds. If b is SIZE_MAX, the conflict is about feature a. */
    SUNDER_CONFLICT_WORSE,           /* the pair is in conflict, and worse than before the moves */
    SUNDER_CONFLICT_LIMIT,           /* a moved by `distance`, and at most `required` was allowed */
    SUNDER_CONFLICT_SIDE,            /* the side anchor of a crossed a side of barrier b on its way, `from` - `to` */
    SUNDER_CONFLICT_JUMP,            /* a jumped over b; `from` - `to` is the way of its anchor, relative to b */
    SUNDER_CONFLICT_NOT_A_TRANSLATE, /* no move of a makes its coordinates what they are now */
    SUNDER_CONFLICT_ROW,             /* a and b do not keep their order in their row: b moved, relative to a and along
                                      * the row, by `distance`, and at least `required` was allowed */
    SUNDER_CONFLICT_NEEDLESS,        /* a is hidden, but would be in no conflict where it stood or where its block is */
    SUNDER_CONFLICT_ALTERED,         /* a is neither a translate of what it was nor of one of its smaller shapes */
    SUNDER_CONFLICT_TOO_SMALL,       /* ... and less than sunder_layer_set_least() demands */
    /* The pair is no conflict: it keeps the gap, but not the full gap. It has no reason, and blocks no feature. */
    SUNDER_CONFLICT_TIGHT
} sunder_conflict_kind;

/* "overlap", "too_close", "barrier", "barrier_drawn", "barrier_near", "contained", "duplicate", "worse", "limit",
 * "side", "jump", "not_a_translate", "row", "needless", "altered", "too_small", "tight". */
SUNDER_API const char *sunder_conflict_kind_string(sunder_conflict_kind kind);

typedef enum sunder_reason {
    SUNDER_REASON_NONE,       /* the report is of a check, which tries no solution */
    SUNDER_REASON_MAX_SHIFT,  /* proved: no moves within the limits of the two solve the pair, even by itself */
    SUNDER_REASON_FIXED,      /* neither of the two may move */
    SUNDER_REASON_SIDE,       /* proved: every solution of the pair and its two blocks alone crosses a side */
    SUNDER_REASON_JUMP,       /* proved: every solution of the pair and its two blocks alone crosses a side or jumps */
    SUNDER_REASON_NO_ROOM,    /* proved: no moves solve the pair and all pairs that are not listed, and leave all other
                               * listed pairs no worse than at the start */
    SUNDER_REASON_SAME_BLOCK, /* the two are in one block, and move as one */
    SUNDER_REASON_KEPT,       /* the two may overlap: one lies in the other (SUNDER_CONTAINMENT_IGNORE), or the feature
                               * is kept beside a barrier whose line crosses it at the start (SUNDER_CROSSED_KEEP) */
    SUNDER_REASON_UNRESOLVED, /* neither a solution nor one of these proofs was found; see also `crowded` */
    SUNDER_REASON_ROW         /* proved: every solution of the pair and its two blocks alone crosses a side, jumps, or
                               * breaks the rule of rows for the two */
} sunder_reason;

/* "", "max_shift", "fixed", "side", "jump", "no_room", "same_block", "kept", "unresolved", "row". */
SUNDER_API const char *sunder_reason_string(sunder_reason reason);

/* A pair in conflict: in the result of a run, or in the layer as it stands in a check. */
typedef struct sunder_conflict {
    size_t a, b; /* a < b: a is a feature; b is a feature, or the number of features + k for barrier k */
    sunder_conflict_kind kind;
    sunder_reason reason;
    double distance; /* the distance in the result; 0 if the two overlap */
    double before;   /* the distance at the start */
    double depth;    /* the length of the least translation that makes the interiors disjoint in the result; 0 if they
                      * are disjoint */
    double required; /* the gap, or the full gap; for a barrier this plus half of its width */
    /* The length that is missing: required - distance, or required + depth if the interiors meet. NAN if the pair has
     * to keep no distance: inside a block, if the two may overlap, and for kinds that are not about a distance. */
    double missing;
    double from[2], to[2];    /* the shortest link, or the least translation drawn from inside the overlap */
    const size_t *blocked_by; /* [n_blocked_by] features and barriers, as b, that are in the way; owned by the report */
    size_t n_blocked_by;
    bool inside_block; /* both are in one block; the conflict is counted in inside_blocks only */
    /* Changes that would solve the pair, one at a time, with its neighbours keeping their distances and all other
     * features as in the result: a longer limit of moves (NAN if none is known), a smaller gap (NAN likewise), or the
     * removal of one feature or barrier (SIZE_MAX if none is known). A smaller change may suffice. The search takes a
     * few steps for each conflict; with effort 0 there is none. In a cluster in which no limit was found for single
     * pairs, need_shift is the longest move of a layout that solves the whole cluster, if one is known. */
    double need_shift, need_gap;
    size_t need_gone;
    /* A proved upper bound of the gaps with which the pair and its neighbours have a solution: the requested gap if
     * nothing less is proved, and NAN if need_gap is NAN. For most conflicts it exceeds need_gap by at most a hundredth
     * of the requested gap. */
    double need_gap_most;
    /* True only with SUNDER_REASON_UNRESOLVED. It is then proved that a, b and the features and barriers in blocked_by
     * cannot all keep their distances from one another, even if every other pair is left in conflict. So at least one
     * pair among them stays in conflict, though not necessarily this one. */
    bool crowded;
    bool by_row; /* true only with SUNDER_REASON_NO_ROOM: the proof uses the rule of rows, and none was found without */
} sunder_conflict;

/* The number of conflicts of each kind between blocks, and the number of all conflicts inside blocks. */
typedef struct sunder_conflict_counts {
    size_t overlap, too_close, barrier, barrier_drawn, barrier_near, contained, duplicate, inside_blocks;
} sunder_conflict_counts;

typedef struct sunder_report sunder_report;

typedef struct sunder_layer_summary {
    size_t features, vertices, blocks, clusters, pairs_tested;
    size_t clusters_optimal;              /* contact groups whose cost is proved to be least */
    sunder_conflict_counts before, after; /* at the start and in the result; equal in a check */
    size_t thin;                    /* pairs between blocks that overlapped by at most options.thin at the start */
    size_t inside_overlaps;         /* pairs inside blocks that are listed as overlaps in the result */
    size_t moved, blocked, skipped; /* the numbers of features with these statuses */
    size_t blocked_moved;           /* blocked features that moved, because of other conflicts */
    size_t rounded;                 /* moved features with a coordinate that had to be rounded to a double */
    double total, mean, max;        /* lengths of moves; the mean is over all features that moved, blocked or not */
    size_t max_feature;             /* the first feature with the longest move; SIZE_MAX if nothing moved */
    /* cost is the sum of weight * length^2 over the moves (sunder_layer_set_preferred()), of the springs of rows, and
     * of the prices of what pairs lack (cost_shortfall). lower_bound is proved: no placement costs less that solves
     * every pair that is not listed, leaves no listed pair worse than at the start, and leaves no pair in overlap that
     * is listed as too close. */
    double cost, lower_bound;
    /* The bound that the pairs of sunder_report_bound_pairs() prove by their least translations alone. It holds if no
     * feature of these pairs comes to lie in the other. It is not part of lower_bound, which trees prove: they prove a
     * little less for a pair, and nothing for two features of which one may come to lie in the other. */
    double pair_bound;
    /* True if every pair that is neither listed nor inside a block was proved to keep its distance (or to lie inside,
     * if it may overlap then), and no listed pair is worse than at the start. */
    bool verified;
    /* Seconds until the last move; seconds for the statements about the result (the list of conflicts, reasons and
     * needs, bounds and pushes); and seconds for the exact checks of all pairs after the last move. A check has only
     * seconds_verify. */
    double seconds_solve, seconds_explain, seconds_verify;
    /* Rows, blocks and single features in them, and the pairs of neighbours in them. The kink of a pair is the length
     * of its relative move at right angles to the row: its mean, the value that 95 % do not exceed, and the share of
     * pairs with a kink above options.kink. */
    size_t rows, row_features, row_pairs;
    double kink_mean, kink_p95, kink_share;
    double cost_moves, cost_rows; /* the parts of cost: moves, and springs of rows ... */
    double cost_shortfall;        /* ... and the prices of pairs that remain in conflict */
    double cost_alone; /* the part of these that each pair has to pay wherever the others go; part of lower_bound */
    /* With options.ease: the pairs of bodies, or of a body and a barrier, that remain in conflict though one of the two
     * may move; and the sum of what they lack, the most of the conflicts of each. */
    size_t short_pairs;
    double shortfall;
    /* Neighbours in rows: the length of their relative move along the row, the change of their spacing; and the angle,
     * in degrees, by which the line from one to the other turns. Of each the mean, and the value that 95 % of the pairs
     * do not exceed. */
    double spacing_mean, spacing_p95, turn_mean, turn_p95;
    size_t tight; /* the pairs that are tight in the result: see options.full_gap. They are in no other count. With
                   * options.ease short_pairs and shortfall include them. */
} sunder_layer_summary;

/* Lists the conflicts of a layer as it stands, exactly. The caller frees the report with sunder_report_free().
 *
 * Fails   SUNDER_EARG for an option out of its range, such as a gap that is negative or not finite, or a tolerance that
 *         is not less than a gap above 0; SUNDER_ENOMEM, SUNDER_ECANCEL */
SUNDER_API sunder_status sunder_layer_check(const sunder_layer *layer, const sunder_layer_options *options,
                                            sunder_report **out, sunder_error *err);

/* Lists the rules that the moves from `before` to `after` broke, whatever program made them. The two layers have the
 * same features in the same order. Each broken rule is a conflict of the report, of one of the kinds from
 * SUNDER_CONFLICT_WORSE to SUNDER_CONFLICT_TOO_SMALL; summary.verified is true if there is none. Limits, blocks, and
 * fixed and ignored features are those of `before`. What is ignored in `after` alone is hidden: it owes nothing, and
 * nothing is owed to it. The options should be those of the run that made the moves. Two things are not checked:
 * whether the features of a block moved together, and the move of a repaired shape that was written in its repaired
 * form, which is not known.
 *
 * Fails   as sunder_layer_check(), and with SUNDER_EARG for layers of different sizes */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_check_moves(const sunder_layer *before, const sunder_layer *after,
                                                           const sunder_layer_options *options, sunder_report **out,
                                                           sunder_error *err);

/* The stages of sunder_layer_separate(), by the fraction that its progress callback receives: it solves until
 * SUNDER_PROGRESS_SOLVED, explains the result until SUNDER_PROGRESS_EXPLAINED, and verifies from then on. */
#define SUNDER_PROGRESS_SOLVED 0.8
#define SUNDER_PROGRESS_EXPLAINED 0.98

/* Separates the features of a layer at low cost; src/displacement/README describes the method. The caller frees the
 * report with sunder_report_free(). It fails like sunder_layer_check().
 *
 * Every move is such that the moved vertices of its feature are doubles exactly, if there is such a move. Otherwise
 * summary.rounded counts the feature, and the rounded vertices are verified. Pairs that remain in conflict are listed,
 * and are no worse than at the start: they are no nearer, and the least translation that separates them is no longer.
 * Features move to make a remaining conflict smaller as far as the price of `ease` pays for it; none with ease 0.
 *
 * Unless allow_jumps is set, no feature jumps over another. Let A be a feature with the anchor a
 * (sunder_shape_anchor()) and the move t. Let B be another feature with the move s that is not ignored, is not in the
 * block of A, and does not contain a. Let neither have may_jump. Then the closed segment from a to a + t - s, not
 * rounded, does not meet B at its original place. So a feature in a yard that has no room for it keeps its conflict,
 * whatever its limit.
 *
 * No feature crosses a barrier that has sides. Let c be the side anchor of the feature, and t its move. Then the closed
 * segment from c to c + t meets no line of the barrier, except lines on which c lies, and no edge of its areas that has
 * c strictly on the outer side. So a feature inside an area may leave it, but not enter it again.
 *
 * The side anchor of a feature is the one that sunder_layer_set_side_anchors() has set, for example the point at which
 * a symbol is drawn. Otherwise it is the anchor, if no such line or edge meets the interior of the feature. Otherwise
 * it is an interior point of the largest part into which these lines and edges divide the feature; if several parts are
 * equal within the tolerance, of the one with the most room. src/displacement/layer/side_anchor.c has the rule. */
SUNDER_API sunder_status sunder_layer_separate(const sunder_layer *layer, const sunder_layer_options *options,
                                               sunder_report **out, sunder_error *err);
SUNDER_API void sunder_report_free(sunder_report *report);

/* Copies the summary to `summary`. A later version may add members at its end: members that do not fit in the caller's
 * `size` bytes are left out, and bytes beyond the members that the library knows are set to 0. */
SUNDER_API void sunder_report_summary_sized(const sunder_report *report, sunder_layer_summary *summary, size_t size);
static inline void sunder_report_summary(const sunder_report *report, sunder_layer_summary *summary)
{
    sunder_report_summary_sized(report, summary, sizeof *summary);
}
/* Sets *dx and *dy to the move of a feature. A moved coordinate is the double nearest to x + dx, or y + dy. */
SUNDER_API void sunder_report_move(const sunder_report *report, size_t feature, double *dx, double *dy);
/* Returns the status of a feature. */
SUNDER_API sunder_feature_status sunder_report_status(const sunder_report *report, size_t feature);
/* Returns the number of the block of a feature, which is the number of its first member; -1 if it is in none. */
SUNDER_API int64_t sunder_report_block(const sunder_report *report, size_t feature);
/* Returns the conflicts that remain, sorted by (a, b), and sets *n to their number. They are the conflicts between
 * blocks, the overlaps inside blocks that exceed the tolerance and, with list_inside, all conflicts inside blocks. */
SUNDER_API const sunder_conflict *sunder_report_conflicts(const sunder_report *report, size_t *n);
/* A force between two features that are in contact in the result: a multiplier of the quadratic program whose optimum
 * the result is. The sum of force * n over the pushes on a block, with a minus where the block is that of a, is twice
 * its weight times its move, if the result is an optimum and the move is shorter than the limit. Forces are computed in
 * doubles, for display. */
typedef struct sunder_push {
    size_t a, b; /* a is a feature; b is a feature, or the number of features + k for barrier k */
    double force;
    double n[2]; /* the direction, of length 1, in which b is pushed; a is pushed in the opposite direction */
} sunder_push;

/* Returns the pushes, sorted by (a, b), and sets *n to their number; there are none unless keep_pushes was set. */
SUNDER_EXPERIMENTAL const sunder_push *sunder_report_pushes(const sunder_report *report, size_t *n);

/* A row of neighbours. */
typedef struct sunder_row {
    /* The features of the row in order, from the end with the smaller number on; a row in the form of a ring begins at
     * its smallest number. A block appears with the member nearest to the block before it and the one nearest to the
     * block after it, once if these are the same. Owned by the report. */
    const size_t *feature; /* [features] */
    size_t features;
    size_t bodies; /* the number of blocks and single features */
    bool ring;     /* the last one is a neighbour of the first one */
    /* The greatest offset of two neighbours, at the start and in the result. An offset is that of their fronts, backs
     * or middle lines, whichever is the least at the start. */
    double kink_before, kink_after;
} sunder_row;

/* Returns the rows, in the order of their features, and sets *n to their number; there are none unless options.rows was
 * set. */
SUNDER_EXPERIMENTAL const sunder_row *sunder_report_rows(const sunder_report *report, size_t *n);

#ifdef __cplusplus
}
#endif
#endif
