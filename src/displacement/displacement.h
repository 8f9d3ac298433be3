/* A whole layer: the structures that the stages of displacement share. README.md beside this file tells the story;
 * the order of this header is the order of the stages. */
#ifndef SUNDER_I_DISPLACEMENT_H
#define SUNDER_I_DISPLACEMENT_H

#include "base/parallel.h"
#include "base/watch.h"
#include "separation/separation.h"
#include "spatial/rtree.h"

/* ---- The layer ---------------------------------------------------------------------------------------------- */

struct sunder_layer {
    sunder_feature *feature;
    size_t n;
};

/* The options with every default filled in. */
typedef struct sunder_i_rules {
    double gap, tolerance;
    bool joins, list_inside; /* joins: touch and containment make blocks */
    sunder_containment contained;
    unsigned threads;
    sunder_progress progress;     /* NULL: nobody asks how far it is */
    void *progress_user;
} sunder_i_rules;

sunder_status sunder_i_rules_of(const sunder_layer_options *options, sunder_i_rules *rules, sunder_error *err);
/* Tells how far it is; false when the caller asked to stop. */
bool sunder_i_progress(const sunder_i_rules *rules, double fraction);

/* A copy of the layer in the order that it is worked on in: number[k] is what feature k was. Failure leaves what
 * sunder_i_free() takes. */
sunder_status sunder_i_order_layer(const sunder_layer *layer, sunder_layer *out, size_t **number, sunder_error *err);

/* Is the feature there at all (not ignored, not empty)? */
static inline bool sunder_i_is_present(const sunder_feature *feature)
{
    return !feature->ignored && feature->shape && !sunder_shape_is_empty(feature->shape);
}

/* ---- Exact relations of pairs ------------------------------------------------------------------------------------ */

/* A feature as it stands: its shape, exactly translated. A feature whose translate does not fit doubles stands as the
 * shape that is written, with no translation. */
typedef struct sunder_i_stand {
    const sunder_shape *shape;
    double t[2];
} sunder_i_stand;

typedef struct sunder_i_relation {
    uint32_t a, b;  /* features, a < b */
    bool near;      /* not the gap apart */
    bool overlap;   /* interiors meet */
    bool contained; /* one lies in the other, up to the tolerance */
    bool a_in_b;    /* which: a in b */
    bool duplicate; /* equal sets */
    bool touch;     /* they touch, or gape or overlap by no more than the tolerance */
    bool kept;      /* contained, and the rules let such pairs overlap */
} sunder_i_relation;

/* All questions about one pair, exact. */
sunder_status sunder_i_relate(const sunder_i_rules *rules, const sunder_i_stand *a, const sunder_i_stand *b,
                              sunder_i_relation *relation, sunder_error *err);

/* Q + D as a shape, where D is a polygon of 16 corners in the disc whose radius is the tolerance (> 0); its corners are
 * the nearest doubles. */
sunder_status sunder_i_grow_by_tolerance(const sunder_shape *q, double tolerance, sunder_shape **out,
                                         sunder_error *err);

typedef struct sunder_i_relations {
    sunder_i_relation *pair; /* sorted by (a, b); only pairs that are near, touch or are kept */
    size_t n, tested;        /* tested: pairs of boxes that were looked at */
} sunder_i_relations;

/* ---- Blocks --------------------------------------------------------------------------------------------------------
 */

/* A body is what moves as one: a block, or a feature that stands alone. Bodies are numbered by their first members. */
typedef struct sunder_i_body {
    uint32_t member, members; /* its features: members of them in sunder_i_town.member from there */
    uint32_t piece, pieces;   /* its convex pieces in sunder_i_town.piece */
    uint32_t wall, walls;     /* the edges of its members that keep others inside, in sunder_i_town.wall */
    double weight;            /* the sum of its members' */
    double limit;             /* the strictest of its members' */
    bool fixed;               /* limit 0 counts too */
    bool pinned;              /* stays where it came from: rounding would make a pair of it stand worse (uphold.c) */
    double origin[2];         /* its corners are stored relative to this */
    double box[4];            /* of its pieces, relative to the origin */
} sunder_i_body;

/* One convex piece of a body, counter-clockwise; a wall is one without area, of two corners. */
typedef struct sunder_i_piece {
    uint32_t corner, corners; /* in sunder_i_town.corner */
    uint32_t feature;
    double box[4]; /* relative to the body's origin */
} sunder_i_piece;

/* How far the body may go. */
static inline double sunder_i_limit_of(const sunder_i_body *body) { return body->fixed ? 0 : body->limit; }

/* A pair of features, a < b, that is left in conflict, and what is demanded of it instead of peace: that b + shift keep
 * `gap` from a; or that the one stay inside the other. See truce.c. */
typedef struct sunder_i_truce {
    uint32_t a, b;
    double shift[2], gap;
    bool inside;
    bool hopeless; /* no moves within the limits make peace, which was proved; else the search gave up */
} sunder_i_truce;

/* Bodies i < j with n truces between members of theirs; no shift is longer than `reach`. */
typedef struct sunder_i_torn {
    uint32_t i, j;
    double reach;
    size_t n;
} sunder_i_torn;

/* A truce that does not count any longer: of these bodies, i < j, and these features, a < b. */
typedef struct sunder_i_ended {
    sunder_i_couple body, feature;
} sunder_i_ended;

typedef struct sunder_i_truces {
    sunder_i_truce *item; /* sorted, as `torn` is, by sunder_i_truces_index() */
    size_t n, capacity;
    sunder_i_torn *torn;
    size_t torn_n, torn_capacity;
} sunder_i_truces;

/* Everything that the search looks at, in doubles. It decides nothing: what it finds is checked exactly afterwards. */
typedef struct sunder_i_town {
    const sunder_layer *layer;
    sunder_i_rules rules;
    size_t bodies, features, pieces;
    uint32_t *body_of; /* [features] */
    uint32_t *member;  /* [features] features by body */
    sunder_i_body *body;
    sunder_i_piece *piece;
    sunder_i_piece *outline; /* [features] the convex hull of each: stands in for its pieces where they are too many */
    double *corner;          /* [2 * corners] relative to the body's origin */
    size_t corners;
    sunder_shape *
        *whole;    /* [bodies] the union of a block's members where it is wanted; NULL for one that stands alone */
    double *box;   /* [4 * features] as they stood at the start */
    bool *present; /* [features] */
    sunder_i_index tree;             /* as they stood at the start */
    const sunder_i_index *standing;  /* as they stand now: the scene's; lent */
    sunder_i_piece *wall; /* edges of features that hold others; see keep.c */
    size_t walls;
    sunder_i_couple *kept;  /* pairs that may overlap, because one lies in the other; sorted */
    bool *a_in_b;           /* [kept_n] which of the two lies in the other */
    bool *enters;           /* [kept_n] it did not at the start, but is to get there (enter.c) */
    unsigned char *keeping; /* [kept_n] a sunder_i_keeping */
    sunder_i_couple *held;  /* bodies: a holds b, which therefore goes where a goes; sorted */
    size_t held_n;
    size_t kept_n;
    sunder_i_couple *lying; /* features in conflict of which the one lies in the other at the start; sorted */
    bool *lying_a;          /* [lying_n] it is the first */
    size_t lying_n;
    sunder_i_truces truces;
    sunder_i_couple *given; /* bodies given up: no solution was found in which this pair, too, is at peace; sorted */
    size_t given_n;
    double *move;  /* [2 * bodies] where each stands now, relative to the start */
    bool *inexact; /* [features] the translate was rounded */
} sunder_i_town;

/* The features' boxes and the tree over them as they were. On failure the town can be given to sunder_i_town_free() all
 * the same. */
sunder_status sunder_i_town_init(const sunder_layer *layer, const sunder_i_rules *rules, sunder_i_town *town,
                                 sunder_error *err);
/* How the features stand at one moment. */
typedef struct sunder_i_scene {
    sunder_i_stand *stand;  /* [features] */
    sunder_shape **rounded; /* [features] owned shapes of those whose translate was rounded; else NULL */
    bool *was_rounded;      /* [features] at any time */
    double *box;            /* [4 * features] */
    sunder_i_index tree;
} sunder_i_scene;

/* All pairs that are near, touch or are kept, as the features stand; exact. before and changed, or both NULL: the
 * relations when all but the features with changed[] stood as now; what cannot have changed is taken from there, and
 * costs nothing but the copy. */
sunder_status sunder_i_scene_relate(const sunder_i_town *town, const sunder_i_scene *scene, const bool *changed,
                                    const sunder_i_relations *before, sunder_i_relations *relations, sunder_error *err);
/* The scene at the start, and after bodies moved: every feature f with changed[f] is placed anew by town->move. Failure
 * leaves a scene that can be freed. */
sunder_status sunder_i_scene_init(const sunder_i_town *town, sunder_i_scene *scene, sunder_error *err);
sunder_status sunder_i_scene_move(sunder_i_town *town, sunder_i_scene *scene, const bool *changed, sunder_error *err);
/* The same for one body. */
sunder_status sunder_i_scene_place(sunder_i_town *town, sunder_i_scene *scene, uint32_t body, sunder_error *err);
void sunder_i_scene_free(const sunder_i_town *town, sunder_i_scene *scene);
/* Called for the relations of one body's members to those of others, as they stand, until *on is false; near: scratch. */
typedef sunder_status (*sunder_i_visit_relation)(void *context, const sunder_i_relation *r, bool *on, sunder_error *err);
sunder_status sunder_i_scene_about(const sunder_i_town *town, const sunder_i_scene *scene, uint32_t body,
                                   sunder_i_list *near, sunder_i_visit_relation visit, void *context, sunder_error *err);
const sunder_i_relation *sunder_i_relations_find(const sunder_i_relations *relations, uint32_t a, uint32_t b);
/* Joins what the rules join. */
sunder_status sunder_i_town_join(sunder_i_town *town, const sunder_i_relations *relations, sunder_error *err);
/* The convex pieces, for the search. */
sunder_status sunder_i_town_cut(sunder_i_town *town, sunder_error *err);
/* Unites the members of these bodies, those that are blocks and have not been. */
sunder_status sunder_i_town_unite(sunder_i_town *town, const uint32_t *body, size_t n, sunder_error *err);
/* The shape of a body: its only member's, or the union. NULL if it was not united or is empty. */
const sunder_shape *sunder_i_town_shape(const sunder_i_town *town, uint32_t body);
void sunder_i_town_free(sunder_i_town *town);

/* ---- Pairs left in conflict ----------------------------------------------------------------------------------------
 */

void sunder_i_truces_free(sunder_i_truces *truces);
/* Appends one; to be indexed before anything is looked up. False if memory is out. */
bool sunder_i_truces_add(sunder_i_truces *truces, const sunder_i_truce *truce);
bool sunder_i_truces_index(sunder_i_truces *truces, const sunder_i_town *town);
/* The truce of two features, or between members of two bodies; NULL: there is none. */
const sunder_i_truce *sunder_i_truces_find(const sunder_i_truces *truces, uint32_t f, uint32_t g);
const sunder_i_torn *sunder_i_truces_between(const sunder_i_truces *truces, uint32_t body, uint32_t other);
/* One more, or one less, of truces that stay indexed. */
bool sunder_i_truces_insert(sunder_i_truces *truces, const sunder_i_town *town, const sunder_i_truce *truce);
void sunder_i_truces_remove(sunder_i_truces *truces, const sunder_i_town *town, const sunder_i_truce *truce);
/* Those that were ended, n of them, sorted, are no more; to be indexed again. */
void sunder_i_truces_end(sunder_i_truces *truces, const sunder_i_town *town, const sunder_i_ended *ended, size_t n);
/* Where it is, or belongs, among n of them, sorted. */
size_t sunder_i_ended_at(const sunder_i_ended *list, size_t n, const sunder_i_ended *wanted);
int sunder_i_by_ended(const void *a, const void *b);
sunder_i_ended sunder_i_ended_of(const sunder_i_town *town, const sunder_i_truce *truce);
/* A truce for two features, by how they stood at the start. */
sunder_status sunder_i_truce_of(const sunder_i_town *town, uint32_t f, uint32_t g, sunder_i_truce *out,
                                sunder_error *err);
/* Appends truces for all members of two bodies that stood within reach of each other. */
sunder_status sunder_i_truces_make(const sunder_i_town *town, uint32_t body, uint32_t other, double reach,
                                   sunder_i_truces *out, sunder_error *err);
/* By how much `of_j`, one of its features, is shifted before it is measured; returns the distance it then keeps. */
double sunder_i_truce_shift(const sunder_i_truce *truce, uint32_t of_j, double shift[2]);

/* ---- What stays inside ---------------------------------------------------------------------------------------------
 */

/* A pair of which one lies in the other, where the rules let that overlap: how the search treats it. */
typedef enum sunder_i_keeping {
    SUNDER_I_LENIENT, /* the one stays inside; it may touch or overstep walls as far as it did at the start */
    SUNDER_I_STRICT,  /* it stays clear of the walls: rounding ate up what leniency left */
    SUNDER_I_LAPSED   /* there is no keeping it inside: the two have to part like any others */
} sunder_i_keeping;

sunder_status sunder_i_keep_init(sunder_i_town *town, const sunder_i_relations *relations, sunder_error *err);
/* One more: a, or else b, is to get inside the other. Before the walls are made. */
sunder_status sunder_i_keep_add(sunder_i_town *town, uint32_t a, uint32_t b, bool a_in_b, sunder_error *err);
/* Notes the pairs in conflict of which the one lies in the other, and that limits may leave so. */
sunder_status sunder_i_keep_note(sunder_i_town *town, const sunder_i_relations *relations, sunder_error *err);
/* The walls, for the search; after the pieces are cut. */
sunder_status sunder_i_keep_walls(sunder_i_town *town, sunder_error *err);
/* Where the pair is in town->kept; kept_n if it never was. */
size_t sunder_i_kept_at(const sunder_i_town *town, uint32_t f, uint32_t g);
/* Is it, and has it not lapsed? */
bool sunder_i_is_kept(const sunder_i_town *town, uint32_t f, uint32_t g);
/* What lies in two that have to part cannot stay in both: lets it go from the one whose edge is nearer. conflict[k]:
 * the relation of pair k keeps two bodies from standing as they do. */
sunder_status sunder_i_keep_choose(sunder_i_town *town, const sunder_i_relations *relations, const bool *conflict,
                                   sunder_error *err);
/* The bodies that body b holds: *n of them, side b of each couple. */
const sunder_i_couple *sunder_i_held_by(const sunder_i_town *town, uint32_t b, size_t *n);
/* Does `inner` lie in `holder`, by town->kept or town->lying? */
bool sunder_i_is_inner(const sunder_i_town *town, uint32_t inner, uint32_t holder);
/* Does `holder` keep `inner` inside? Then *keeping tells how. */
bool sunder_i_holds(const sunder_i_town *town, uint32_t holder, uint32_t inner, sunder_i_keeping *keeping);

/* ---- Conflicts as they are reported
 * ------------------------------------------------------------------------------------- */

/* Fills the report's conflicts from the relations as the features stand. start: the relations and scene before anything
 * moved (equal to the others in a check). reasons: fill the reason of what remains between blocks, as far as it shows
 * in the pair by itself. */
sunder_status sunder_i_report_conflicts(sunder_report *report, const sunder_i_town *town, const sunder_i_scene *scene,
                                        const sunder_i_relations *relations, bool reasons, sunder_error *err);
/* Counts what the relations amount to, without listing it. */
void sunder_i_count_relations(const sunder_i_town *town, const sunder_i_relations *relations,
                              sunder_conflict_counts *counts);

/* ---- Contact of convex pieces
 * ---------------------------------------------------------------------------------------- */

/* Scratch memory of one thread; grows, and remembers a failure. */
typedef struct sunder_i_scratch {
    double *xy;
    size_t capacity;
    bool failed;
} sunder_i_scratch;

/* The obstacle A + (-B) of two convex polygons: corners counter-clockwise in scratch->xy. Returns how many, 0 if memory
 * is out. */
size_t sunder_i_difference(const double *a, size_t na, const double *b, size_t nb, const double offset[2],
                           sunder_i_scratch *scratch);

/* A support constraint n.u >= support + gap, valid for every u outside the obstacle on that side. */
typedef struct sunder_i_support {
    double n[2], support;
    double distance; /* of u to the obstacle: negative inside, then of the shallowest side */
} sunder_i_support;

/* An edge of an obstacle: where it begins, its outer normal, its length. */
typedef struct sunder_i_edge {
    double from[2], n[2], length;
} sunder_i_edge;

/* The edges of the convex polygon d of n corners, those without length left out, in edge[n]; returns how many. */
size_t sunder_i_edges_of(const double *d, size_t n, sunder_i_edge *edge);
/* The support line of the convex polygon of these edges that is farthest below u. */
sunder_i_support sunder_i_support_at(const sunder_i_edge *edge, size_t n, const double u[2]);

/* Obstacles by key, for those that are asked for again and again; bounded, so what was put there may be gone. */
typedef struct sunder_i_shelf {
    struct sunder_i_shelved *slot; /* [slots] open addressing; slots is a power of two, or 0 */
    size_t slots, used;
    sunder_i_edge *edge;
    size_t edges, capacity;
} sunder_i_shelf;

void sunder_i_shelf_free(sunder_i_shelf *shelf);
/* The edges put there with that key (not 0), *n of them; NULL: none are there. */
const sunder_i_edge *sunder_i_shelf_find(const sunder_i_shelf *shelf, uint64_t key, size_t *n);
/* Puts the edges of the polygon d of n corners there, of whose key there are none; NULL: memory is out. They stay until
 * something else is put there. */
const sunder_i_edge *sunder_i_shelf_add(sunder_i_shelf *shelf, uint64_t key, const double *d, size_t *n);

/* ---- Free places
 * --------------------------------------------------------------------------------------------------------- */

typedef struct sunder_i_wall {
    double n[2], h; /* the obstacle lies in n.x <= h */
    double from[2], to[2];
    double distance; /* from the target */
    uint32_t obstacle;
} sunder_i_wall;

typedef struct sunder_i_obstacle {
    uint32_t wall, walls;
    double box[4];
} sunder_i_obstacle;

/* A union of open convex polygons. */
typedef struct sunder_i_obstacles {
    sunder_i_obstacle *obstacle;
    size_t n, obstacle_capacity;
    sunder_i_wall *wall;
    size_t walls, wall_capacity;
    bool failed;
} sunder_i_obstacles;

void sunder_i_obstacles_free(sunder_i_obstacles *obstacles);
/* Adds the convex polygon d grown by gap; its round corners are replaced by tangents that contain them. */
void sunder_i_obstacles_add(sunder_i_obstacles *obstacles, const double *d, size_t n, double gap);
/* Local minima of the distance from target on the boundary of the free space, nearest first, at most `most` of them,
 * none beyond limit, no two nearer than `spread`. Returns how many; *steps grows by the work done, in constraints looked
 * at; *failed is set if memory is out. */
size_t sunder_i_free_places(const sunder_i_obstacles *obstacles, const double target[2], double limit, double spread,
                            size_t most, double (*places)[2], uint64_t *steps, bool *failed);

/* ---- The quadratic program
 * --------------------------------------------------------------------------------------------------- */

#define SUNDER_I_NOBODY UINT32_MAX

/* n.(t_j - t_i) >= d; i or j may be SUNDER_I_NOBODY, which stands at zero. */
typedef struct sunder_i_constraint {
    uint32_t i, j;
    double n[2], d;
    double force; /* its multiplier */
    uint64_t key; /* what it stands for, to find it again in the next round */
} sunder_i_constraint;

typedef struct sunder_i_quadratic {
    size_t bodies;
    const double *mass; /* [bodies] inverse: 1 / (2 w); 0 for what is fixed */
    sunder_i_constraint *constraint;
    size_t n, capacity;
    double *t;                   /* [2 * bodies] out */
    uint64_t work;               /* done so far, roughly in constraints looked at */
    uint64_t most_work;          /* 0, or how much may be: then what is done by then is the solution, such as it is */
} sunder_i_quadratic;

/* min sum w |t|^2 under the constraints, starting from their forces. softness > 0 lets every constraint yield in
 * proportion to its force (relative to what the force moves), so that contradictions end in a compromise. Returns the
 * worst violation; negative if memory is out. scale: a length such as bodies move by. */
double sunder_i_quadratic_solve(sunder_i_quadratic *program, double softness, double tolerance, double scale);

/* ---- Clusters
 * ----------------------------------------------------------------------------------------------------------------------
 */

typedef struct sunder_i_cluster {
    uint32_t *body; /* members, ascending; fixed ones too */
    size_t n;
    double margin;          /* what is demanded beyond the gap, to cover rounding */
    bool limited;           /* a limit or a fixed body is in it: it may have no solution */
    sunder_i_truces truces; /* new ones, of pairs that its solution gave up, or in place of older ones; owned */
    sunder_i_ended *ended;  /* [ended_n] truces of the town that no longer count: these are at peace; owned */
    size_t ended_n;
    sunder_i_couple *guest; /* [guests] one of its bodies, and one that is in its way and might join it; owned */
    size_t guests, guest_capacity;
} sunder_i_cluster;

/* Two bodies of a cluster under a truce, and what is to be asked for them. */
typedef struct sunder_i_suit {
    uint32_t root; /* of the cluster */
    sunder_i_couple body;
    const uint32_t *truce; /* [truces] between members of theirs: places in the town's */
    size_t truces;
    size_t part;    /* 0: all of theirs, which are asked together; else which of them, by itself, from 1 on */
    bool overlap;   /* do members overlap? */
    bool peace;     /* ask for peace, those that are not hopeless */
    bool disjoint;  /* ask, at least, that they do not overlap, those that can be parted so far */
    double missing; /* what it would take */
} sunder_i_suit;

/* Least moves of a cluster's bodies from where they stand, others disregarded; rounded. Where limits leave no solution,
 * pairs are given up, and the rest is solved. */
sunder_status sunder_i_cluster_solve(const sunder_i_town *town, sunder_i_cluster *cluster, double *move,
                                     sunder_error *err);
/* Pairs given up are asked for peace once more, and keep it where there is a solution, the first ones first. All others
 * keep theirs, and neighbours outside the cluster stay where they are. */
sunder_status sunder_i_cluster_retry(const sunder_i_town *town, sunder_i_cluster *cluster, const sunder_i_suit *suit,
                                     size_t suits, double *move, sunder_error *err);
/* Better sides: the same from a free start, never dearer; neighbours outside the cluster stay where they are. */
sunder_status sunder_i_cluster_improve(const sunder_i_town *town, const sunder_i_cluster *cluster, double *move,
                                       sunder_error *err);

/* Bodies of the cluster that would have a nearer place but for strangers who might move: pairs of the two go to
 * cluster->guest. False if memory is out. */
bool sunder_i_cluster_invite(const sunder_i_town *town, sunder_i_cluster *cluster, const double *move);

/* ---- Rounding
 * ------------------------------------------------------------------------------------------------------------------------
 */

/* Rounds the move of a body so that the coordinates of its members plus the move are doubles, if any near move does;
 * false if none. Never longer than the body's limit. The coarsest unit of a coordinate goes to *unit. */
bool sunder_i_round_move(const sunder_i_town *town, uint32_t body, const double move[2], double out[2], double *unit);
/* |t| <= limit? Exact. limit may be infinite. */
bool sunder_i_within(const double t[2], double limit);

/* ---- The lower bound
 * -------------------------------------------------------------------------------------------------------------------
 */

/* Multipliers for the pairs (blocks by number in body_of), and the bound proved by them. Pairs with least = 0 get none.
 */
sunder_status sunder_i_bound(const sunder_i_town *town, sunder_bound_pair *pairs, size_t n, double *bound,
                             sunder_error *err);

/* ---- The report
 * --------------------------------------------------------------------------------------------------------------------------
 */

struct sunder_report {
    size_t n;
    double *move;                  /* [2 * n] */
    sunder_feature_status *status; /* [n] */
    int64_t *block;                /* [n] */
    sunder_conflict *conflict;
    size_t conflicts;
    size_t *blocker;      /* what all blocked_by point into */
    sunder_proof **proof; /* [conflicts] NULL: there is none; the array too */
    sunder_bound_pair *bound_pair;
    size_t bound_pairs;
    sunder_layer_summary summary;
};

sunder_status sunder_i_report_new(const sunder_i_town *town, sunder_report **out, sunder_error *err);
/* The report on a layer in the order of work, as one on the layer as it was given: number[k] is what feature k was. */
sunder_status sunder_i_report_renumber(sunder_report *report, const size_t *number, sunder_error *err);

/* Adds one to the count of the conflict's kind. */
void sunder_i_count(sunder_conflict_counts *counts, const sunder_conflict *conflict);

#endif
