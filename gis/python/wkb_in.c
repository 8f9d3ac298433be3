/* wkb_in.c: reads well-known binary: ISO, with or without Z and M, and the extended form of PostGIS (flags for Z and M,
 * SRID); each part in its own byte order. Every length is compared with the bytes that are left before memory is
 * allocated for it. */
#include "python/features_in.h"

#include <math.h>
#include <string.h>

enum {
    POINT = 1,
    LINE_STRING,
    POLYGON,
    MULTI_POINT,
    MULTI_LINE_STRING,
    MULTI_POLYGON,
    COLLECTION,
    SURFACE = 15,
    TIN,
    TRIANGLE
};

/* Flags of the extended form. */
static const uint32_t with_z = 0x80000000u, with_m = 0x40000000u, with_srid = 0x20000000u;

/* A place in the bytes. If `moved` is set nothing is stored: each x and y is changed. */
typedef struct reader {
    const unsigned char *at, *end;
    bool swapped;
    size_t dimensions;
    gis_py_features *to;
    const char *who;
    unsigned char *moved;
    double dx, dy;
} reader;

static bool short_of_bytes(const reader *r)
{
    gis_py_wrong(r->who, "its well-known binary ends too early");
    return false;
}

static bool read_count(reader *r, uint32_t *number)
{
    if (r->end - r->at < 4) return short_of_bytes(r);
    memcpy(number, r->at, 4);
    if (r->swapped) *number = __builtin_bswap32(*number);
    r->at += 4;
    return true;
}

static double load(const unsigned char *from, bool swapped)
{
    uint64_t bits;
    double number;
    memcpy(&bits, from, sizeof bits);
    if (swapped) bits = __builtin_bswap64(bits);
    memcpy(&number, &bits, sizeof number);
    return number;
}

static void store(unsigned char *to, bool swapped, double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    if (swapped) bits = __builtin_bswap64(bits);
    memcpy(to, &bits, sizeof bits);
}

/* Reads n points to a ring or line, or changes them. */
static bool read_points(reader *r, size_t n, gis_polygons *to)
{
    const size_t size = 8 * r->dimensions;
    if ((size_t)(r->end - r->at) / size < n) return short_of_bytes(r);
    for (; n; n--, r->at += size) {
        const double x = load(r->at, r->swapped), y = load(r->at + 8, r->swapped);
        if (r->moved) {
            unsigned char *place = r->moved + (r->at - r->moved);
            store(place, r->swapped, x + r->dx);
            store(place + 8, r->swapped, y + r->dy);
        } else if (!gis_py_vertex(to, x, y)) {
            return false;
        }
    }
    return true;
}

/* A point whose coordinates are not numbers is an empty one. */
static bool read_point(reader *r)
{
    if ((size_t)(r->end - r->at) < 8 * r->dimensions) return short_of_bytes(r);
    if (isnan(load(r->at, r->swapped)) && isnan(load(r->at + 8, r->swapped))) {
        r->at += 8 * r->dimensions;
        return true;
    }
    return read_points(r, 1, r->moved ? NULL : &r->to->lines) && (r->moved || gis_py_end_line(r->to));
}

static bool read_line(reader *r)
{
    uint32_t n;
    if (!read_count(r, &n) || !read_points(r, n, r->moved ? NULL : &r->to->lines)) return false;
    return n == 0 || r->moved || gis_py_end_line(r->to);
}

static bool read_polygon(reader *r)
{
    uint32_t rings, n;
    if (!read_count(r, &rings)) return false;
    if (rings == 0) return true;
    for (uint32_t k = 0; k < rings; k++)
        if (!read_count(r, &n) || !read_points(r, n, r->moved ? NULL : &r->to->areas) ||
            !(r->moved || gis_py_end_ring(r->to)))
            return false;
    return r->moved || gis_py_end_polygon(r->to);
}

/* Reads byte order and type. */
static bool read_head(reader *r, uint32_t *type)
{
    if (r->end - r->at < 5) return short_of_bytes(r);
    const unsigned char order = *r->at++;
    if (order > 1) return gis_py_wrong(r->who, "not well-known binary: the byte order is %u", order);
    r->swapped = order != (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
    if (!read_count(r, type)) return false;
    const uint32_t flags = *type & (with_z | with_m | with_srid), iso = *type & ~flags, thousands = iso / 1000;
    uint32_t srid;
    if (thousands > 3) return gis_py_wrong(r->who, "not well-known binary: the type is %u", (unsigned)*type);
    const bool has_z = (flags & with_z) || thousands == 1 || thousands == 3,
               has_m = (flags & with_m) || thousands == 2 || thousands == 3;
    r->dimensions = 2u + has_z + has_m;
    *type = iso % 1000;
    return !(flags & with_srid) || read_count(r, &srid);
}

static bool read_geometry(reader *r, int depth)
{
    uint32_t type = 0, parts;
    if (depth > GIS_PY_DEEPEST) return gis_py_wrong(r->who, "collections are nested too deeply");
    if (!read_head(r, &type)) return false;
    switch (type) {
    case POINT: return read_point(r);
    case LINE_STRING: return read_line(r);
    case POLYGON:
    case TRIANGLE: return read_polygon(r);
    case MULTI_POINT:
    case MULTI_LINE_STRING:
    case MULTI_POLYGON:
    case COLLECTION:
    case SURFACE:
    case TIN:
        if (!read_count(r, &parts)) return false;
        for (uint32_t k = 0; k < parts; k++)
            if (!read_geometry(r, depth + 1)) return false;
        return true;
    default: return gis_py_wrong(r->who, "well-known binary of the type %u, which is not supported", (unsigned)type);
    }
}

bool gis_py_wkb_add(gis_py_features *to, const unsigned char *bytes, size_t n, const char *who)
{
    reader r = {.at = bytes, .end = bytes + n, .to = to, .who = who};
    if (!read_geometry(&r, 0)) return false;
    return r.at == r.end || gis_py_wrong(who, "%zu bytes follow its well-known binary", (size_t)(r.end - r.at));
}

void gis_py_wkb_move(unsigned char *bytes, size_t n, double dx, double dy)
{
    reader r = {.at = bytes, .end = bytes + n, .moved = bytes, .who = "", .dx = dx, .dy = dy};
    read_geometry(&r, 0);
}
