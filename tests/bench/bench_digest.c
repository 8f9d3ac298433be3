/* bench_digest FILE...: the sum's rings, degenerate segments and points with their exact coordinates, as one number per
 * file: FNV-1a of the texts. If two builds print the same number, their results are equal. Public interface only. */
#include "sunder.h"
#include "wkt_input.h"

#include <inttypes.h>

typedef struct digest {
    const sunder_sum *sum;
    uint64_t hash;
    sunder_status status;
} digest;

static void add_text(digest *d, const char *text)
{
    for (; *text; text++) d->hash = (d->hash ^ (unsigned char)*text) * 0x100000001b3u;
    d->hash = (d->hash ^ '\n') * 0x100000001b3u;
}

static void add_vertex(digest *d, uint32_t vertex)
{
    char *x = NULL, *y = NULL;
    sunder_error err = {0};
    if (d->status) return;
    d->status = sunder_sum_vertex_text(d->sum, vertex, &x, &y, &err);
    if (!d->status) {
        add_text(d, x);
        add_text(d, y);
    }
    sunder_free(x);
    sunder_free(y);
}

static void add_sum(digest *d)
{
    sunder_sum_size size;
    sunder_sum_get_size(d->sum, &size);
    for (size_t p = 0; p < size.polygons; p++, add_text(d, "polygon"))
        for (size_t r = 0; r < sunder_sum_rings(d->sum, p); r++, add_text(d, "ring")) {
            size_t n;
            const uint32_t *ring = sunder_sum_ring(d->sum, p, r, &n);
            for (size_t i = 0; i < n; i++) add_vertex(d, ring[i]);
        }
    for (size_t i = 0; i < size.degenerate_segments; i++, add_text(d, "segment")) {
        uint32_t ends[2];
        sunder_sum_segment(d->sum, i, ends);
        add_vertex(d, ends[0]);
        add_vertex(d, ends[1]);
    }
    for (size_t i = 0; i < size.degenerate_points; i++) add_vertex(d, sunder_sum_point(d->sum, i));
}

static sunder_status make_digest(const bench_set *p, const bench_set *q, uint64_t *hash, sunder_error *err)
{
    sunder_shape *a = NULL, *b = NULL;
    sunder_sum *sum = NULL;
    sunder_status status =
        sunder_shape_from_rings(p->xy, p->ring_end, p->poly_end, p->polygons, SUNDER_VALIDITY_STRICT, &a, err);
    if (!status)
        status = sunder_shape_from_rings(q->xy, q->ring_end, q->poly_end, q->polygons, SUNDER_VALIDITY_STRICT, &b, err);
    if (!status) status = sunder_minkowski_sum(a, b, NULL, &sum, err);
    if (!status) {
        digest d = {sum, 0xcbf29ce484222325u, SUNDER_OK};
        add_sum(&d);
        status = d.status;
        *hash = d.hash;
    }
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return status;
}

int main(int argc, char **argv)
{
    int failed = 0;
    for (int i = 1; i < argc; i++) {
        bench_set p, q;
        uint64_t hash = 0;
        sunder_error err = {0};
        if (!bench_pair_read(argv[i], &p, &q)) {
            fprintf(stderr, "bench_digest: %s: cannot be read\n", argv[i]);
            failed = 1;
            continue;
        }
        if (make_digest(&p, &q, &hash, &err)) {
            fprintf(stderr, "bench_digest: %s: %s\n", argv[i], err.message);
            failed = 1;
        } else {
            printf("%s %016" PRIx64 "\n", argv[i], hash);
        }
        bench_set_free(&p);
        bench_set_free(&q);
    }
    return failed;
}
