/* record.c: see record.h. Rings stand as they were given, so that the shape that is made of them is the very shape that
 * was put in; of one that had to be repaired that is told, and it is repaired again. */
#include "spool/record.h"

#include "base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof(gis_spool_head) % 8 == 0, "what follows a head is aligned");

static size_t padded(size_t bytes) { return (bytes + 7) & ~(size_t)7; }

static size_t coordinates_of(const gis_spool_head *head)
{
    return 2 * sizeof(double) * ((size_t)head->vertices + head->points);
}

/* Where the ends of lines are. */
static size_t line_ends_of(const gis_spool_head *head)
{
    return sizeof *head + coordinates_of(head) + sizeof(uint32_t) * ((size_t)head->rings + head->polygons);
}

static size_t id_of(const gis_spool_head *head) { return line_ends_of(head) + sizeof(uint32_t) * head->lines; }

static size_t bytes_of(const gis_spool_head *head) { return padded(id_of(head) + head->id_bytes); }

static unsigned char *put_ends(unsigned char *to, const size_t *end, size_t n)
{
    for (size_t k = 0; k < n; k++, to += sizeof(uint32_t)) {
        const uint32_t one = (uint32_t)end[k]; /* a shape has no more than 2^27 vertices */
        memcpy(to, &one, sizeof one);
    }
    return to;
}

/* Of the shape and the lines; of nothing box[0] > box[2]. Grown outward, by no less than the reach. */
static void find_box(const gis_spool_feature *feature, size_t points, double box[4])
{
    const double *xy = feature->lines.xy, nothing[4] = {1, 0, 0, 0},
                 open[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    const sunder_shape *shape = feature->demands.shape;
    memcpy(box, points ? open : nothing, 4 * sizeof *box);
    if (shape && !sunder_shape_is_empty(shape)) sunder_shape_box(shape, box);
    for (size_t k = 0; k < points; k++)
        for (int c = 0; c < 2; c++) {
            box[c] = fmin(box[c], xy[2 * k + (size_t)c]);
            box[c + 2] = fmax(box[c + 2], xy[2 * k + (size_t)c]);
        }
    for (int c = 0; c < 4 && feature->reach > 0 && box[0] <= box[2]; c++)
        box[c] = c < 2 ? nextafter(box[c] - feature->reach, -INFINITY) : nextafter(box[c] + feature->reach, INFINITY);
}

bool gis_spool_record_make(gis_spool_room *room, const gis_spool_feature *feature, gis_error *error)
{
    const sunder_feature *demands = &feature->demands;
    const double *xy = NULL;
    const size_t *ring_end = NULL, *poly_end = NULL, lines = feature->lines.lines;
    const size_t polygons = demands->shape ? sunder_shape_given(demands->shape, &xy, &ring_end, &poly_end) : 0;
    const size_t points = lines ? feature->lines.line_end[lines - 1] : 0;
    const size_t rings = polygons ? poly_end[polygons - 1] : 0, vertices = rings ? ring_end[rings - 1] : 0;
    gis_spool_head head = {.index = feature->index,
                           .fid = feature->fid,
                           .block = demands->block,
                           .weight = demands->weight,
                           .max_shift = demands->max_shift,
                           .area = feature->area,
                           .start = {feature->start[0], feature->start[1]},
                           .reach = feature->reach,
                           .polygons = (uint32_t)polygons,
                           .rings = (uint32_t)rings,
                           .vertices = (uint32_t)vertices,
                           .id_bytes = feature->id ? (uint32_t)strlen(feature->id) + 1 : 0,
                           .fixed = demands->fixed,
                           .repaired = demands->shape && sunder_shape_repaired(demands->shape),
                           .lines = (uint32_t)lines,
                           .points = (uint32_t)points};
    find_box(feature, points, head.box);
    head.bytes = bytes_of(&head);
    if (!gis_array_reserve(&room->at, &room->capacity, head.bytes, 1)) return gis_no_memory(error);
    room->used = head.bytes;
    memset(room->at + head.bytes - 8, 0, 8); /* the padding */
    memcpy(room->at, &head, sizeof head);
    unsigned char *to = room->at + sizeof head;
    if (vertices) memcpy(to, xy, 2 * vertices * sizeof *xy);
    to += 2 * vertices * sizeof *xy;
    if (points) memcpy(to, feature->lines.xy, 2 * points * sizeof *xy);
    to = put_ends(to + 2 * points * sizeof *xy, ring_end, rings);
    to = put_ends(to, poly_end, polygons);
    to = put_ends(to, feature->lines.line_end, lines);
    if (feature->id) memcpy(to, feature->id, head.id_bytes);
    return true;
}

gis_spool_head *gis_spool_record_head(unsigned char *record) { return (void *)record; }

bool gis_spool_record_feature(unsigned char *record, size_t left, gis_spool_feature *feature)
{
    const gis_spool_head *head = gis_spool_record_head(record);
    if (left < sizeof *head || head->bytes > left || head->bytes != bytes_of(head)) return false;
    const char *id = (const char *)record + head->bytes;
    if (head->id_bytes) {
        id = (const char *)record + id_of(head);
        if (id[head->id_bytes - 1] != '\0') return false;
    }
    *feature = (gis_spool_feature){.index = (size_t)head->index,
                                   .fid = head->fid,
                                   .demands = {.weight = head->weight,
                                               .max_shift = head->max_shift,
                                               .block = head->block,
                                               .fixed = head->fixed != 0},
                                   .start = {head->start[0], head->start[1]},
                                   .area = head->area,
                                   .reach = head->reach,
                                   .id = head->id_bytes ? id : NULL};
    return true;
}

static bool take_ends(size_t **end, size_t *capacity, const unsigned char **from, size_t n)
{
    if (!gis_array_reserve(end, capacity, n, sizeof **end)) return false;
    for (size_t k = 0; k < n; k++, *from += sizeof(uint32_t)) {
        uint32_t one;
        memcpy(&one, *from, sizeof one);
        (*end)[k] = one;
    }
    return true;
}

bool gis_spool_record_lines(const unsigned char *record, size_t **end, size_t *capacity, sunder_obstacle *out,
                            gis_error *error)
{
    gis_spool_head head;
    memcpy(&head, record, sizeof head);
    const unsigned char *from = record + line_ends_of(&head);
    *out = (sunder_obstacle){0};
    if (head.lines == 0) return true;
    if (!take_ends(end, capacity, &from, head.lines)) return gis_no_memory(error);
    const void *xy = record + sizeof head + 2 * sizeof(double) * head.vertices;
    *out = (sunder_obstacle){.xy = xy, .line_end = *end, .lines = head.lines};
    return true;
}

bool gis_spool_record_shape(const unsigned char *record, gis_polygons *rings, sunder_shape **out, sunder_error *why)
{
    gis_spool_head head;
    memcpy(&head, record, sizeof head);
    const unsigned char *from = record + sizeof head;
    const double *xy = (const void *)from;
    from += coordinates_of(&head);
    if (!take_ends(&rings->ring_end, &rings->ring_capacity, &from, head.rings) ||
        !take_ends(&rings->poly_end, &rings->poly_capacity, &from, head.polygons)) {
        *why = (sunder_error){.status = SUNDER_ENOMEM};
        return false;
    }
    return sunder_shape_from_rings(xy, rings->ring_end, rings->poly_end, head.polygons,
                                   head.repaired ? SUNDER_VALIDITY_EVEN_ODD : SUNDER_VALIDITY_STRICT, out,
                                   why) == SUNDER_OK;
}
