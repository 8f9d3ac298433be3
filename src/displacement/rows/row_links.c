/* Does a line of a barrier lie between two neighbours? */
#include "displacement/layer/reads.h"
#include "displacement/rows/row_pairs.h"

#include "predicate/passage.h"
#include "shape/of_pieces.h"

/* Returns whether the path meets a line of the part of a barrier, or an edge of its area. */
static bool meets_part(const sunder_i_model *model, uint32_t part, const sunder_i_passage *path)
{
    const sunder_i_barriers *b = model->barriers;
    for (uint32_t k = part ? b->piece_end[part - 1] : 0; k < b->piece_end[part]; k++) {
        const sunder_i_piece_of *piece = &b->piece[k];
        const double *xy = piece->shape ? piece->shape->xy : piece->xy;
        for (uint32_t e = 0, v[2]; e < sunder_i_piece_corners(piece); e++)
            if (sunder_i_piece_edge(piece, e, v) &&
                sunder_i_passage_meets(path, xy + 2 * (size_t)v[0], xy + 2 * (size_t)v[1]))
                return true;
    }
    return false;
}

bool sunder_i_row_link_is_crossed(const sunder_i_model *model, double link[2][2], sunder_i_list *near, bool *crossed)
{
    const double *p = link[0], *q = link[1];
    const sunder_i_passage path = {{p[0], p[1]}, {q[0], q[1]}, {p[0], p[1]}};
    double box[4];
    *crossed = false;
    sunder_i_passage_box(&path, box);
    near->n = 0;
    if (!sunder_i_look_about(model, &model->tree, box, near)) return false;
    for (size_t k = 0; k < near->n && !*crossed; k++)
        *crossed = sunder_i_is_barrier(model, near->item[k]) &&
                   meets_part(model, near->item[k] - (uint32_t)model->features, &path);
    return true;
}
