/* sunder.h: exact Minkowski sums of polygonal sets, least separating translations, and the displacement of
 * whole map layers.
 *
 * Conventions. Every function that can fail returns a sunder_status (SUNDER_OK is 0) and takes a caller-owned
 * sunder_error, which may be NULL. Unless a function says otherwise, all outputs are untouched on failure. The caller
 * frees what it receives through **out with the _free function of its type; _free(NULL) is fine. The object owns what
 * its getters return by pointer; it is valid until the object is freed. Objects do not change once they are built, so
 * threads may share them (a layer is built until its barriers and side anchors are set). The only global state is the
 * allocation hooks, which are set once, before any other call; each thread also has a watch of its own.
 *
 * Lengths are in the units of the input. Every finite double is taken as the dyadic rational that it is. Inputs are
 * never rounded; results are rounded only where a function says so.
 *
 * Functions that are declared SUNDER_API are stable: a program that is compiled with this header runs with every later
 * library of the same soname. Those that are declared SUNDER_EXPERIMENTAL may change in any version that is not a mere
 * correction. docs/api.md says what is promised in detail, and how structs of options grow.
 *
 * This header includes the five headers that it consists of. Each can be included alone, with those that it needs.
 * Four more headers belong to the interface: sunder_proof.h for proofs, sunder_parts.h for layers that are separated
 * in parts, sunder_hiding.h for features that may be left out or become smaller, and sunder_legible.h for what is too
 * small to be read.
 *
 * Keys such as [GRS83] resolve in REFERENCES.md. It is installed with the documentation (share/doc/sunder), and so is
 * api.md; paths that begin with src/ are those of the source code. */
#ifndef SUNDER_H
#define SUNDER_H

#include "sunder_base.h"
#include "sunder_layer.h"
#include "sunder_route.h"
#include "sunder_shape.h"
#include "sunder_sum.h"

#define SUNDER_VERSION "0.1.0"

#endif
