/* decomposition.c: the six decompositions: polygon by polygon, or, for the mixed one, both operands together. */
#include "base/counts.h"
#include "decomposition/maker.h"

static void make_optimal(sunder_i_maker *m, const sunder_i_member *member)
{
    uint32_t diagonals;
    double length;
    if (!sunder_i_has_program(member)) {
        m->fallbacks++;
        sunder_i_mesh mesh;
        if (sunder_i_triangulate(&m->rings, member->ring_lo, member->ring_hi, &m->scratch, &mesh)) {
            sunder_i_mesh_merge(&m->rings, &mesh);
            sunder_i_maker_add_faces(m, &mesh);
        }
        return;
    }
    sunder_i_program *program = sunder_i_program_new(m, member);
    if (program && sunder_i_program_solve(program, 1, 0, &diagonals, &length)) sunder_i_program_emit(program, m);
    sunder_i_program_free(program);
}

static void make_pieces(sunder_i_maker *m, sunder_decomposition kind)
{
    if (kind == SUNDER_DECOMPOSITION_HERTEL_MEHLHORN) {
        sunder_i_make_shape_pieces(m);
        return;
    }
    for (; m->polygon < m->rings.polygons && !sunder_i_maker_failed(m); m->polygon++) {
        const sunder_i_mark mark = sunder_i_arena_mark(&m->scratch);
        const sunder_i_member member = sunder_i_maker_member(m, m->polygon);
        if (kind == SUNDER_DECOMPOSITION_TRIANGULATION && member.n > 3)
            sunder_i_make_triangles(m, &member);
        else if (member.reflex == 0)
            sunder_i_maker_add_whole(m, &member);
        else if (kind == SUNDER_DECOMPOSITION_VERTICAL)
            sunder_i_make_vertical(m, &member);
        else if (kind == SUNDER_DECOMPOSITION_ANGLE_BISECTOR)
            sunder_i_make_bisector(m, &member);
        else
            make_optimal(m, &member);
        if (!m->scratch.failed) sunder_i_arena_release(&m->scratch, mark);
    }
}

static void sign_result(const sunder_i_maker *m, sunder_decomposition kind, const sunder_counts *before,
                        sunder_i_decomposition *out)
{
    out->used = m->fallbacks ? SUNDER_DECOMPOSITION_HERTEL_MEHLHORN : kind;
    out->counts = sunder_i_counts_since(&m->lattice->counts, before);
}

sunder_status sunder_i_decompose(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                                 sunder_decomposition kind, sunder_i_decomposition *out, sunder_error *err)
{
    if (kind == SUNDER_DECOMPOSITION_AUTO) kind = SUNDER_DECOMPOSITION_ANGLE_BISECTOR;
    if (kind == SUNDER_DECOMPOSITION_MIXED) kind = SUNDER_DECOMPOSITION_OPTIMAL;
    const sunder_counts before = lattice->counts;
    sunder_i_maker m;
    sunder_i_decomposition made;
    bool ok = sunder_i_maker_init(&m, lattice, shape, at);
    if (ok) make_pieces(&m, kind);
    ok = ok && sunder_i_maker_finish(&m, &made);
    if (ok) {
        sign_result(&m, kind, &before, &made);
        *out = made;
    }
    sunder_i_maker_free(&m);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Decomposes both operands together; the operation counts of both are stored for p. */
static sunder_status decompose_mixed(sunder_i_lattice *lattice, const sunder_shape *const shape[2],
                                     const sunder_i_point *const at[2], sunder_i_decomposition *const out[2],
                                     sunder_error *err)
{
    const sunder_counts before = lattice->counts;
    sunder_i_maker m[2];
    sunder_i_decomposition made[2];
    bool ok = sunder_i_maker_init(&m[0], lattice, shape[0], at[0]);
    ok &= sunder_i_maker_init(&m[1], lattice, shape[1], at[1]);
    if (ok) sunder_i_make_mixed(&m[0], &m[1]);
    ok = ok && !sunder_i_maker_failed(&m[0]) && !sunder_i_maker_failed(&m[1]);
    ok = ok && sunder_i_maker_finish(&m[0], &made[0]);
    if (ok && !sunder_i_maker_finish(&m[1], &made[1])) {
        sunder_i_decomposition_clear(&made[0]);
        ok = false;
    }
    for (int i = 0; i < 2 && ok; i++) {
        sunder_counts now = lattice->counts;
        sign_result(&m[i], SUNDER_DECOMPOSITION_MIXED, i ? &now : &before, &made[i]);
        *out[i] = made[i];
    }
    sunder_i_maker_free(&m[0]);
    sunder_i_maker_free(&m[1]);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

sunder_status sunder_i_decompose_pair(sunder_i_lattice *lattice, const sunder_shape *p, const sunder_i_point *at_p,
                                      const sunder_shape *q, const sunder_i_point *at_q, sunder_decomposition kind,
                                      sunder_i_decomposition *out_p, sunder_i_decomposition *out_q, sunder_error *err)
{
    if (kind == SUNDER_DECOMPOSITION_MIXED) {
        const sunder_shape *const shape[2] = {p, q};
        const sunder_i_point *const at[2] = {at_p, at_q};
        sunder_i_decomposition *const out[2] = {out_p, out_q};
        return decompose_mixed(lattice, shape, at, out, err);
    }
    sunder_i_decomposition first, second;
    sunder_status status = sunder_i_decompose(lattice, p, at_p, kind, &first, err);
    if (status) return status;
    status = sunder_i_decompose(lattice, q, at_q, kind, &second, err);
    if (status) {
        sunder_i_decomposition_clear(&first);
        return status;
    }
    *out_p = first;
    *out_q = second;
    return SUNDER_OK;
}
