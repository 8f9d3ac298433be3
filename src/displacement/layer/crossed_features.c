/* Features that a barrier's line crosses at home, such as a house above a passage. If the layer keeps them, such a pair
 * owes no distance: it may not stand worse than at home, like a pair that is left in conflict. Lines and points of a
 * barrier count, and areas do not. The line has to meet the interior of the shape as read, before it grew. */
#include "displacement/layer/model.h"

#include "separation/separation.h"

/* Sets *out to a shape made of the lines and points of a part of a barrier; NULL if the part has none. */
static sunder_status lines_of_part(const sunder_i_barriers *barriers, uint32_t part, sunder_shape **out,
                                   sunder_error *err)
{
    const uint32_t first = part ? barriers->piece_end[part - 1] : 0, end = barriers->piece_end[part];
    sunder_i_piece_of *line = sunder_i_alloc(end - first, sizeof *line);
    size_t n = 0;
    *out = NULL;
    if (!line) return sunder_i_failure_cause(err);
    for (uint32_t k = first; k < end; k++)
        if (!sunder_i_piece_has_area(&barriers->piece[k])) line[n++] = barriers->piece[k];
    const sunder_status status = n ? sunder_i_shape_of_pieces(line, n, out, err) : SUNDER_OK;
    sunder_i_free(line);
    return status;
}

/* Sets *crosses to whether the line meets the interior of the feature. */
static sunder_status meets_interior(const sunder_i_model *model, uint32_t f, const sunder_shape *line, bool *crosses,
                                    sunder_error *err)
{
    const sunder_i_translate home = sunder_i_at_home(model, f);
    const sunder_shape *original = sunder_i_original_shape(model->layer->given, model->layer->number[f]);
    sunder_i_interior_cover cover = {0};
    if (original == sunder_i_given_shape(model, f))
        return sunder_i_overlap(line, NULL, home.interior_cover ? home.interior_cover : home.shape, NULL, crosses, err);
    sunder_status status = sunder_i_interior_cover_make(original, &cover, err);
    if (!status) status = sunder_i_overlap(line, NULL, cover.shape ? cover.shape : original, NULL, crosses, err);
    sunder_i_interior_cover_free(&cover);
    return status;
}

/* Sets *crosses to whether a line or point of a part of a barrier meets the interior of the feature. The relation is
 * that of all pieces of the part, so it answers unless some have an area. */
static sunder_status crosses_feature(const sunder_i_model *model, const sunder_i_relation *r, bool *crosses,
                                     sunder_error *err)
{
    *crosses = r->overlap && sunder_i_is_barrier(model, r->b) && sunder_i_thing_shape(model, r->b)->flat;
    if (!*crosses) return SUNDER_OK;
    sunder_shape *line;
    sunder_status status = lines_of_part(model->barriers, r->b - (uint32_t)model->features, &line, err);
    *crosses = line != NULL;
    if (!status && line) status = meets_interior(model, r->a, line, crosses, err);
    sunder_shape_free(line);
    return status;
}

sunder_status sunder_i_model_note_crossed(sunder_i_model *model, const sunder_i_relations *start, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    size_t room = 0;
    if (model->layer->given->crossed != SUNDER_CROSSED_KEEP) return SUNDER_OK;
    for (size_t k = 0; k < start->n && !status; k++) {
        const sunder_i_relation *r = &start->pair[k];
        const sunder_i_id_pair pair = {r->a, sunder_i_whole_of(model, r->b)};
        bool crosses;
        status = crosses_feature(model, r, &crosses, err);
        if (status || !crosses) continue;
        /* Relations are sorted, and the parts of a barrier follow one another. */
        if (model->crossed_n && sunder_i_by_id_pair(&model->crossed[model->crossed_n - 1], &pair) == 0) continue;
        if (!sunder_i_reserve(&model->crossed, &room, model->crossed_n + 1, sizeof *model->crossed))
            return sunder_i_failure_cause(err);
        model->crossed[model->crossed_n++] = pair;
    }
    return status;
}

bool sunder_i_is_crossed(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    if (!model->crossed_n) return false;
    const sunder_i_id_pair pair = {f < g ? f : g, sunder_i_whole_of(model, f < g ? g : f)};
    return bsearch(&pair, model->crossed, model->crossed_n, sizeof pair, sunder_i_by_id_pair);
}
