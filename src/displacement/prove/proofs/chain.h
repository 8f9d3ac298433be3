/* Chains of pushes, from end to end, where limits leave no other way; see chain.c. */
#ifndef SUNDER_I_CHAIN_H
#define SUNDER_I_CHAIN_H

#include "displacement/prove/proofs/branching.h"
#include "sunder_proof.h"

/* What the limits of two bodies leave of two of their pieces: one way past each other, or what all ways have in
 * common. */
typedef struct sunder_i_chain_link {
    uint32_t i, j; /* bodies: i may move; what does not is j */
    const sunder_i_body_piece *a, *b;
    double clearance;
    double n[2], d; /* n.(t_j - t_i) >= d */
    double spare;   /* by how much more they are apart, where they stand; not negative, unless all is owed */
} sunder_i_chain_link;

/* The links of a body, as it looks from there. */
typedef struct sunder_i_chain_links {
    size_t first, n;
    bool known;
} sunder_i_chain_links;

/* The cheapest way by links from where it began to one of them; of the search that is under way if `search` says so. */
typedef struct sunder_i_chain_step {
    double cost;
    uint32_t from; /* the link before; SUNDER_I_NO_LINK: it is the first */
    uint32_t search;
} sunder_i_chain_step;

#define SUNDER_I_NO_LINK UINT32_MAX

typedef struct sunder_i_chain_entry {
    double cost;
    uint32_t link;
} sunder_i_chain_entry;

/* Links of a cluster's bodies, found as they are asked for, and kept from conflict to conflict of it. */
struct sunder_i_chains {
    sunder_i_subproblem of; /* the cluster; no pair is in question */
    bool all;               /* listed pairs owe all, too, and everybody stands at home (chain_fewest.c) */
    sunder_i_branching branching;
    sunder_i_chain_links *body; /* [of.reserves] */
    sunder_i_chain_link *link;
    sunder_i_chain_step *step; /* [links] */
    size_t links, link_capacity, step_capacity;
    uint32_t search;
    sunder_i_chain_entry *heap;
    size_t heap_n, heap_capacity;
    uint64_t work; /* besides the branching's */
};

/* The links of one way of the pair that is asked about, from either end of it. */
typedef struct sunder_i_pushing {
    size_t way;      /* among those of the pair's pieces */
    uint32_t *link;  /* those that the pair's j pushes, one after the other, then those that its i does */
    size_t right, n; /* so many of the former; all */
} sunder_i_pushing;

/* ---- chain_links.c ----------------------------------------------------------------------------------------------- */

/* The move of a body in the result; no member of the cluster: none. */
void sunder_i_chains_stand(const sunder_i_chains *chains, uint32_t body, double t[2]);
/* The links of a body; none, if it is not of the cluster. NULL if memory is out. Pointers to links are void then. */
const sunder_i_chain_links *sunder_i_chains_find(sunder_i_chains *chains, uint32_t body);
/* Which of n ways can be put first so that, behind its line, limits leave no other? Puts that way first and returns
 * true; false if there is none. */
bool sunder_i_chain_only_way(sunder_i_half_plane *way, size_t n, double reach);
/* The same for n ways in scratch; a line that several of them imply may be added as the first of one more. Returns
 * their number then; 0: neither works, or memory is out (branching->failed). */
size_t sunder_i_chain_ways(sunder_i_branching *branching, size_t n, double reach);
/* May the two, no farther from each other's places than reach, go this way? And if they do not go the other way? */
bool sunder_i_chain_is_open(const sunder_i_half_plane *way, double reach);
bool sunder_i_chain_is_open_behind(const sunder_i_half_plane *way, const sunder_i_half_plane *behind, double reach);

/* ---- chain_fewest.c ---------------------------------------------------------------------------------------------- */

/* Where all is owed, the chain of fewest links that leaves a way of the pair no room: *found, if there is one. False if
 * memory is out. */
bool sunder_i_chain_fewest(sunder_i_chains *chains, const sunder_i_chain_link *pair, const sunder_i_half_plane *way,
                           sunder_i_pushing *chain, bool *found);

/* ---- chain_proof.c ----------------------------------------------------------------------------------------------- */

/* Builds the proof that all ways of the pair are closed. Each way that the limits leave open has one of the n
 * chains, in the order of ways; chain[n] belongs to no way. NULL: a chain fails by a hair, or memory is out
 * (*failed). */
sunder_proof *sunder_i_chain_prove(sunder_i_chains *chains, const sunder_i_subproblem *subproblem,
                                   const sunder_i_chain_link *pair, const sunder_i_half_plane *way, size_t ways,
                                   const sunder_i_pushing *chain, size_t n, bool *failed);

#endif
