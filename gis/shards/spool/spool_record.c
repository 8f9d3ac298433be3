/* spool_record.c: see spool_record.h. Rings are stored as they were given, so that the shape made from them is
 * identical to the original; a flag says if it had to be repaired, and then it is repaired again. */
#include "shards/spool/spool_record.h"

#include "base/array.h"
#include "base/core_error.h"
#include "disk/external_sort.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof(gis_spool_head) % 8 == 0, "what follows a head is aligned");

static size_t padded_size(size_t bytes) { return (bytes + 7) & ~(size_t)7; }

/* Optional members of a record, one bit each; their data follow the head in the order of the bits, with the sizes in
 * size_of[]. */
enum {
    FIXED = 1 << 0,
    REPAIRED = 1 << 1,
    BLOCK = 1 << 2,
    AREA = 1 << 3,
    START = 1 << 4,
    REACH = 1 << 5,
    BOX = 1 << 6, /* the box differs from that of the coordinates */
    LINES = 1 << 7,
    ID = 1 << 8,
    ROW = 1 << 9,
    HIDING = 1 << 10,
    RIGID = 1 << 11,
    GIVEN = 1 << 12,
    CLASS = 1 << 13,
    ALL = (1 << 14) - 1
};

/* Number of lines and of their points, for a record with LINES. */
typedef struct counts {
    uint32_t lines, points;
} counts;

/* Numbers of the shape before it became larger, for a record with GIVEN. */
typedef struct given_counts {
    uint32_t polygons, rings, vertices, repaired;
} given_counts;

static const size_t size_of[] = {0,
                                 0,
                                 sizeof(int64_t),
                                 sizeof(double),
                                 2 * sizeof(double),
                                 sizeof(double),
                                 4 * sizeof(double),
                                 sizeof(counts),
                                 sizeof(uint64_t),
                                 sizeof(int64_t),
                                 2 * sizeof(int64_t),
                                 0,
                                 sizeof(given_counts),
                                 sizeof(int64_t)};

/* The offset of the data of the member `flag`; for ALL + 1, the end of all optional members. */
static size_t place_of(const gis_spool_head *head, uint32_t flag)
{
    size_t at = sizeof *head;
    for (uint32_t k = 0, one = 1; one < flag && one <= ALL; k++, one <<= 1)
        if (head->has & one) at += size_of[k];
    return at;
}

/* Copies the data of the member `flag` to `to`, if the record has it. */
static void get_member(const unsigned char *record, const gis_spool_head *head, uint32_t flag, void *to, size_t bytes)
{
    if (head->has & flag) memcpy(to, record + place_of(head, flag), bytes);
}

static void put_member(unsigned char *record, const gis_spool_head *head, uint32_t flag, const void *from, size_t bytes)
{
    if (head->has & flag) memcpy(record + place_of(head, flag), from, bytes);
}

/* Offsets of what follows the optional members. */
typedef struct content {
    counts of_lines;
    given_counts of_given;
    uint64_t id_bytes; /* including the NUL */
    size_t xy, line_xy, given_xy, ring_ends, line_ends, given_ends, id, bytes;
} content;

static bool has_ends(const gis_spool_head *head) { return head->rings != 1 || head->polygons != 1; }

static void lay_out(const gis_spool_head *head, content *c)
{
    c->xy = place_of(head, ALL + 1);
    c->line_xy = c->xy + 2 * sizeof(double) * head->vertices;
    c->given_xy = c->line_xy + 2 * sizeof(double) * c->of_lines.points;
    c->ring_ends = c->given_xy + 2 * sizeof(double) * c->of_given.vertices;
    c->line_ends = c->ring_ends + (has_ends(head) ? sizeof(uint32_t) * ((size_t)head->rings + head->polygons) : 0);
    c->given_ends = c->line_ends + sizeof(uint32_t) * c->of_lines.lines;
    c->id = c->given_ends + sizeof(uint32_t) * ((size_t)c->of_given.rings + c->of_given.polygons);
    c->bytes = padded_size(c->id + c->id_bytes);
}

/* Parses a record for which `left` bytes are available. False: it is invalid. */
static bool find_content(const unsigned char *record, size_t left, gis_spool_head *head, content *c)
{
    *c = (content){0};
    if (left < sizeof *head) return false;
    memcpy(head, record, sizeof *head);
    if (head->bytes > left || head->has > ALL || place_of(head, ALL + 1) > head->bytes) return false;
    get_member(record, head, LINES, &c->of_lines, sizeof c->of_lines);
    get_member(record, head, GIVEN, &c->of_given, sizeof c->of_given);
    get_member(record, head, ID, &c->id_bytes, sizeof c->id_bytes);
    if (c->id_bytes > head->bytes) return false;
    lay_out(head, c);
    return c->bytes == head->bytes;
}

static unsigned char *put_ends(unsigned char *to, const size_t *end, size_t n)
{
    for (size_t k = 0; k < n; k++, to += sizeof(uint32_t)) {
        const uint32_t one = (uint32_t)end[k]; /* a shape has at most 2^27 vertices */
        memcpy(to, &one, sizeof one);
    }
    return to;
}

void gis_spool_feature_box(const gis_spool_feature *feature, double box[4])
{
    const gis_spool_rings *given = &feature->given;
    const size_t rings = given->polygons ? given->poly_end[given->polygons - 1] : 0,
                 vertices = rings ? given->ring_end[rings - 1] : 0;
    sunder_shape_box(feature->demands.shape, box);
    for (size_t k = 0; k < vertices; k++)
        for (int c = 0; c < 2; c++) {
            box[c] = fmin(box[c], given->xy[2 * k + (size_t)c]);
            box[c + 2] = fmax(box[c + 2], given->xy[2 * k + (size_t)c]);
        }
}

gis_spool_rings gis_spool_rings_of(const sunder_shape *shape)
{
    gis_spool_rings out = {.repaired = sunder_shape_repaired(shape)};
    out.polygons = sunder_shape_given(shape, &out.xy, &out.ring_end, &out.poly_end);
    return out;
}

bool gis_spool_rings_shape(const gis_spool_rings *rings, sunder_shape **out, gis_error *error)
{
    sunder_error why;
    return sunder_shape_from_rings(rings->xy, rings->ring_end, rings->poly_end, rings->polygons,
                                   rings->repaired ? SUNDER_VALIDITY_EVEN_ODD : SUNDER_VALIDITY_STRICT, out,
                                   &why) == SUNDER_OK ||
           gis_core_failed(error, "a shape before it became larger", &why);
}

/* The box of the shape (with the start of its arrow) and the lines, enlarged by the reach and rounded outward; box[0] >
 * box[2] if there is neither. */
static void find_box(const gis_spool_feature *feature, size_t points, double box[4])
{
    const double *xy = feature->lines.xy, nothing[4] = {1, 0, 0, 0},
                 open[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    const sunder_shape *shape = feature->demands.shape;
    memcpy(box, points ? open : nothing, 4 * sizeof *box);
    if (shape && !sunder_shape_is_empty(shape)) {
        gis_spool_feature_box(feature, box);
        for (int c = 0; c < 4; c++)
            box[c] = c < 2 ? fmin(box[c], feature->start[c]) : fmax(box[c], feature->start[c - 2]);
    }
    for (size_t k = 0; k < points; k++)
        for (int c = 0; c < 2; c++) {
            box[c] = fmin(box[c], xy[2 * k + (size_t)c]);
            box[c + 2] = fmax(box[c + 2], xy[2 * k + (size_t)c]);
        }
    for (int c = 0; c < 4 && feature->reach > 0 && box[0] <= box[2]; c++)
        box[c] = c < 2 ? nextafter(box[c] - feature->reach, -INFINITY) : nextafter(box[c] + feature->reach, INFINITY);
}

/* The box of n vertices; box[0] > box[2] if n is 0. */
static void box_of_vertices(const double *xy, size_t n, double box[4])
{
    const double nothing[4] = {1, 0, 0, 0};
    memcpy(box, nothing, sizeof nothing);
    for (size_t k = 0; k < n; k++) {
        const double x = xy[2 * k], y = xy[2 * k + 1];
        if (k == 0 || x < box[0]) box[0] = x;
        if (k == 0 || y < box[1]) box[1] = y;
        if (k == 0 || x > box[2]) box[2] = x;
        if (k == 0 || y > box[3]) box[3] = y;
    }
}

static bool same_box(const double a[4], const double b[4])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2] && a[3] == b[3];
}

static given_counts count_given(const gis_spool_rings *given)
{
    given_counts out = {.polygons = (uint32_t)given->polygons, .repaired = given->repaired};
    if (given->polygons) out.rings = (uint32_t)given->poly_end[given->polygons - 1];
    if (out.rings) out.vertices = (uint32_t)given->ring_end[out.rings - 1];
    return out;
}

static void put_given(unsigned char *record, const content *c, const gis_spool_rings *given)
{
    const given_counts *n = &c->of_given;
    if (n->polygons == 0) return;
    memcpy(record + c->given_xy, given->xy, 2 * (size_t)n->vertices * sizeof *given->xy);
    put_ends(put_ends(record + c->given_ends, given->ring_end, n->rings), given->poly_end, n->polygons);
}

static uint32_t flags_of(const gis_spool_feature *feature, const content *c, bool other_box)
{
    const sunder_feature *demands = &feature->demands;
    const bool started = !isnan(feature->start[0]) || !isnan(feature->start[1]),
               repaired = demands->shape && sunder_shape_repaired(demands->shape);
    return (demands->fixed ? FIXED : 0) | (repaired ? REPAIRED : 0) | (demands->block != -1 ? BLOCK : 0) |
           (feature->area != 0 ? AREA : 0) | (started ? START : 0) | (feature->reach != 0 ? REACH : 0) |
           (other_box ? BOX : 0) | (c->of_lines.lines ? LINES : 0) | (feature->id ? ID : 0) | (feature->row ? ROW : 0) |
           (feature->hiding.weight ? HIDING : 0) | (feature->rigid ? RIGID : 0) | (c->of_given.polygons ? GIVEN : 0) |
           (feature->gap_class ? CLASS : 0);
}

bool gis_spool_record_make(gis_spool_room *room, const gis_spool_feature *feature, gis_error *error)
{
    const sunder_feature *demands = &feature->demands;
    const double *xy = NULL;
    const size_t *ring_end = NULL, *poly_end = NULL, lines = feature->lines.lines;
    const size_t polygons = demands->shape ? sunder_shape_given(demands->shape, &xy, &ring_end, &poly_end) : 0;
    const size_t points = lines ? feature->lines.line_end[lines - 1] : 0;
    const size_t rings = polygons ? poly_end[polygons - 1] : 0, vertices = rings ? ring_end[rings - 1] : 0;
    content c = {.of_lines = {(uint32_t)lines, (uint32_t)points},
                 .of_given = count_given(&feature->given),
                 .id_bytes = feature->id ? strlen(feature->id) + 1 : 0};
    gis_spool_head head = {.index = feature->index,
                           .fid = feature->fid,
                           .weight = demands->weight,
                           .max_shift = demands->max_shift,
                           .polygons = (uint32_t)polygons,
                           .rings = (uint32_t)rings,
                           .vertices = (uint32_t)vertices};
    double box[4], own[4];
    find_box(feature, points, box);
    box_of_vertices(xy, vertices, own);
    head.has = flags_of(feature, &c, !same_box(box, own));
    lay_out(&head, &c);
    head.bytes = c.bytes;
    if (!gis_array_reserve(&room->at, &room->capacity, c.bytes, 1)) return gis_no_memory(error);
    room->used = c.bytes;
    memset(room->at + c.bytes - 8, 0, 8); /* clears the padding */
    memcpy(room->at, &head, sizeof head);
    put_member(room->at, &head, BLOCK, &demands->block, sizeof demands->block);
    put_member(room->at, &head, AREA, &feature->area, sizeof feature->area);
    put_member(room->at, &head, START, feature->start, sizeof feature->start);
    put_member(room->at, &head, REACH, &feature->reach, sizeof feature->reach);
    put_member(room->at, &head, BOX, box, sizeof box);
    put_member(room->at, &head, LINES, &c.of_lines, sizeof c.of_lines);
    put_member(room->at, &head, ID, &c.id_bytes, sizeof c.id_bytes);
    put_member(room->at, &head, ROW, &feature->row, sizeof feature->row);
    put_member(room->at, &head, HIDING, (int64_t[2]){feature->hiding.hierarchy, feature->hiding.weight},
               2 * sizeof(int64_t));
    put_member(room->at, &head, GIVEN, &c.of_given, sizeof c.of_given);
    put_member(room->at, &head, CLASS, &(int64_t){feature->gap_class}, sizeof(int64_t));
    put_given(room->at, &c, &feature->given);
    if (vertices) memcpy(room->at + c.xy, xy, 2 * vertices * sizeof *xy);
    if (points) memcpy(room->at + c.line_xy, feature->lines.xy, 2 * points * sizeof *xy);
    if (has_ends(&head)) put_ends(put_ends(room->at + c.ring_ends, ring_end, rings), poly_end, polygons);
    put_ends(room->at + c.line_ends, feature->lines.line_end, lines);
    if (feature->id) memcpy(room->at + c.id, feature->id, c.id_bytes);
    return true;
}

gis_spool_head *gis_spool_record_head(unsigned char *record) { return (void *)record; }

void gis_spool_record_box(const unsigned char *record, double box[4])
{
    gis_spool_head head;
    memcpy(&head, record, sizeof head);
    if (head.has & BOX)
        get_member(record, &head, BOX, box, 4 * sizeof *box);
    else
        box_of_vertices((const void *)(record + place_of(&head, ALL + 1)), head.vertices, box);
}

size_t gis_spool_record_vertices(const unsigned char *record)
{
    gis_spool_head head;
    counts lines = {0};
    memcpy(&head, record, sizeof head);
    get_member(record, &head, LINES, &lines, sizeof lines);
    return (size_t)head.vertices + lines.points;
}

void gis_spool_record_settle(unsigned char *record, const sunder_feature *demands)
{
    gis_spool_head *head = gis_spool_record_head(record);
    head->weight = demands->weight;
    head->max_shift = demands->max_shift;
    put_member(record, head, BLOCK, &demands->block, sizeof demands->block);
}

bool gis_spool_record_feature(unsigned char *record, size_t left, gis_spool_feature *feature)
{
    gis_spool_head head;
    content c;
    if (!find_content(record, left, &head, &c)) return false;
    const char *id = (head.has & ID) ? (const char *)record + c.id : NULL;
    if (id && (c.id_bytes == 0 || id[c.id_bytes - 1] != '\0')) return false;
    *feature = (gis_spool_feature){
        .index = (size_t)head.index,
        .fid = head.fid,
        .demands = {.weight = head.weight, .max_shift = head.max_shift, .block = -1, .fixed = (head.has & FIXED) != 0},
        .start = {NAN, NAN},
        .id = id,
        .rigid = (head.has & RIGID) != 0};
    get_member(record, &head, BLOCK, &feature->demands.block, sizeof feature->demands.block);
    get_member(record, &head, AREA, &feature->area, sizeof feature->area);
    get_member(record, &head, START, feature->start, sizeof feature->start);
    get_member(record, &head, REACH, &feature->reach, sizeof feature->reach);
    get_member(record, &head, ROW, &feature->row, sizeof feature->row);
    int64_t hiding[2] = {0}, gap_class = 0;
    get_member(record, &head, HIDING, hiding, sizeof hiding);
    get_member(record, &head, CLASS, &gap_class, sizeof gap_class);
    feature->gap_class = (uint32_t)gap_class;
    feature->hiding = (sunder_hiding_cost){(uint32_t)hiding[0], hiding[1]};
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
    content c;
    *out = (sunder_obstacle){0};
    if (!find_content(record, (size_t)((const gis_sort_head *)(const void *)record)->bytes, &head, &c)) return true;
    if (c.of_lines.lines == 0) return true;
    const unsigned char *from = record + c.line_ends;
    if (!take_ends(end, capacity, &from, c.of_lines.lines)) return gis_no_memory(error);
    const void *xy = record + c.line_xy;
    *out = (sunder_obstacle){.xy = xy, .line_end = *end, .lines = c.of_lines.lines};
    return true;
}

bool gis_spool_record_given(const unsigned char *record, gis_polygons *rings, gis_spool_rings *out, gis_error *error)
{
    gis_spool_head head;
    content c;
    *out = (gis_spool_rings){0};
    if (!find_content(record, (size_t)((const gis_sort_head *)(const void *)record)->bytes, &head, &c)) return true;
    if (c.of_given.polygons == 0) return true;
    const unsigned char *from = record + c.given_ends;
    if (!take_ends(&rings->ring_end, &rings->ring_capacity, &from, c.of_given.rings) ||
        !take_ends(&rings->poly_end, &rings->poly_capacity, &from, c.of_given.polygons))
        return gis_no_memory(error);
    const void *xy = record + c.given_xy;
    *out = (gis_spool_rings){xy, rings->ring_end, rings->poly_end, c.of_given.polygons, c.of_given.repaired != 0};
    return true;
}

bool gis_spool_record_shape(const unsigned char *record, gis_polygons *rings, sunder_shape **out, sunder_error *why)
{
    gis_spool_head head;
    content c;
    memcpy(&head, record, sizeof head);
    if (!find_content(record, (size_t)head.bytes, &head, &c)) head = (gis_spool_head){0};
    const unsigned char *from = record + c.ring_ends;
    const double *xy = (const void *)(record + c.xy);
    if (!gis_array_reserve(&rings->ring_end, &rings->ring_capacity, head.rings + 1, sizeof *rings->ring_end) ||
        !gis_array_reserve(&rings->poly_end, &rings->poly_capacity, head.polygons + 1, sizeof *rings->poly_end) ||
        (has_ends(&head) && (!take_ends(&rings->ring_end, &rings->ring_capacity, &from, head.rings) ||
                             !take_ends(&rings->poly_end, &rings->poly_capacity, &from, head.polygons)))) {
        *why = (sunder_error){.status = SUNDER_ENOMEM};
        return false;
    }
    if (!has_ends(&head)) {
        rings->ring_end[0] = head.vertices;
        rings->poly_end[0] = 1;
    }
    return sunder_shape_from_rings(xy, rings->ring_end, rings->poly_end, head.polygons,
                                   (head.has & REPAIRED) ? SUNDER_VALIDITY_EVEN_ODD : SUNDER_VALIDITY_STRICT, out,
                                   why) == SUNDER_OK;
}
