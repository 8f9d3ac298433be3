/* Chains of pushes from one limit to another, where limits leave each pair only one half-plane; see chain.c. */
#ifndef SUNDER_I_CHAIN_H
#define SUNDER_I_CHAIN_H

#include "displacement/prove/proofs/branching.h"
#include "sunder_proof.h"

/* A link: two pieces of two bodies that limits leave only one half-plane, or several half-planes that imply one
 * line. */
typedef struct sunder_i_chain_link {
    uint32_t i, j; /* bodies: i can move; one that cannot is j */
    const sunder_i_body_piece *a, *b;
    double clearance;
    double n[2], d; /* the link is n.(t_j - t_i) >= d */
    double spare;   /* n.(t_j - t_i) - d at the present positions; not negative, unless all pairs have to keep their
                     * full distance */
} sunder_i_chain_link;

/* The links of one body as i. */
typedef struct sunder_i_chain_links {
    size_t first, n;
    bool known;
} sunder_i_chain_links;

/* The cheapest path of links from the beginning of a search to one link; valid if `search` is the number of the present
 * search. */
typedef struct sunder_i_chain_step {
    double cost;
    uint32_t from; /* the previous link; SUNDER_I_NO_LINK: it is the first */
    uint32_t search;
} sunder_i_chain_step;

#define SUNDER_I_NO_LINK UINT32_MAX

typedef struct sunder_i_chain_entry {
    double cost;
    uint32_t link;
} sunder_i_chain_entry;

/* The links of a cluster's bodies, found when needed, and kept for all conflicts of the cluster. */
struct sunder_i_chains {
    sunder_i_subproblem of; /* the cluster; no pair is in question */
    bool all;               /* listed pairs have to keep their full distance, too, and all bodies are at their original
                             * positions (chain_fewest.c) */
    sunder_i_branching branching;
    sunder_i_chain_links *body; /* [of.reserves] the links of each */
    sunder_i_chain_link *link;
    sunder_i_chain_step *step; /* [links] the state of the search for each */
    size_t links, link_capacity, step_capacity;
    uint32_t search;
    sunder_i_chain_entry *heap;
    size_t heap_n, heap_capacity;
    uint64_t work; /* in addition to the work of `branching` */
};

/* The links for one half-plane of the pair in question, on both sides of the pair. */
typedef struct sunder_i_pushing {
    size_t half_plane; /* the number of the half-plane among those of the pair's pieces */
    uint32_t *link;    /* first the links on the side of the pair's j, from the pair on, then those on the side of its
                      * i */
    size_t right, n;   /* right: the number of links on the side of j; n: the number of all */
} sunder_i_pushing;

/* ---- chain_links.c ----------------------------------------------------------------------------------------------- */

/* Sets t to the present move of a body; to 0 if it is fixed or not in the cluster, or if all pairs have to keep their
 * full distance (chains->all). */
void sunder_i_chains_stand(const sunder_i_chains *chains, uint32_t body, double t[2]);
/* Returns the links of a body; none if it is not in the cluster. Returns NULL if memory is out. Pointers to links
 * become invalid. */
const sunder_i_chain_links *sunder_i_chains_find(sunder_i_chains *chains, uint32_t body);
/* Looks for a half-plane such that, behind its line, limits leave none of the others; puts it first and returns true.
 * Returns false if there is none. */
bool sunder_i_chain_only_half_plane(sunder_i_half_plane *half_plane, size_t n, double reach);
/* Puts the half-plane that sunder_i_chain_only_half_plane() finds first, for n half-planes in branching->scratch. If
 * there is none, a line that all half-planes open to the pair (sunder_i_chain_is_open()) imply may be added as a
 * further half-plane, put first. Returns their number; 0 if neither works, or if memory is out (branching->failed). */
size_t sunder_i_chain_half_planes(sunder_i_branching *branching, size_t n, double reach);
/* Can two bodies whose relative move is at most `reach` be in this half-plane? The second function: and behind
 * the line of `behind`? */
bool sunder_i_chain_is_open(const sunder_i_half_plane *half_plane, double reach);
bool sunder_i_chain_is_open_behind(const sunder_i_half_plane *half_plane, const sunder_i_half_plane *behind,
                                   double reach);

/* ---- chain_fewest.c ---------------------------------------------------------------------------------------------- */

/* If all pairs have to keep their full distance: finds the chain of fewest links that leaves a half-plane of the pair
 * no room; *found. Returns false if memory is out. */
bool sunder_i_chain_fewest(sunder_i_chains *chains, const sunder_i_chain_link *pair,
                           const sunder_i_half_plane *half_plane, sunder_i_pushing *chain, bool *found);

/* ---- chain_proof.c ----------------------------------------------------------------------------------------------- */

/* Builds the proof that all half-planes of the pair are closed. Each half-plane that the limits leave open has one of
 * the n chains, in the order of half-planes; chain[n] belongs to none. Returns NULL if a chain fails because of
 * rounding, or memory is out (*failed). */
sunder_proof *sunder_i_chain_prove(sunder_i_chains *chains, const sunder_i_subproblem *subproblem,
                                   const sunder_i_chain_link *pair, const sunder_i_half_plane *half_plane,
                                   size_t half_planes, const sunder_i_pushing *chain, size_t n, bool *failed);

#endif
