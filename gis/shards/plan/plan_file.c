/* plan_file.c: see plan.h. The file holds, in the machine's byte order: a head with the file type and the version that
 * wrote it, so that another version can say so; numbers; facts about the layer; texts, each with its length before it;
 * and a checksum of everything. */
#include "shards/plan/plan.h"

#include "base/padding.h"
#include "base/path.h"
#include "base/text.h"
#include "disk/checksum.h"
#include "disk/file.h"

#include <cpl_conv.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define NAME "plan"
/* The largest size of the file: longer than any command line that a shell passes on. */
enum { MOST_BYTES = 1 << 26 };

typedef struct plan_head {
    char what[8];
    char version[24]; /* the version of the program */
} plan_head;

static plan_head head_of_ours(void)
{
    plan_head head = {.what = "SunderP"};
    snprintf(head.version, sizeof head.version, "%s", sunder_version());
    return head;
}

typedef struct plan_numbers {
    uint64_t arguments, facts_size, spool, status;
    double memory;
    uint32_t shards, unused;
} plan_numbers;

/* ---- Arguments --------------------------------------------------------------------------------------------------- */

bool gis_plan_add_argument(gis_plan *plan, const char *name, const char *value, gis_error *error)
{
    char **more = realloc(plan->argument, (plan->arguments + 1) * sizeof *more);
    if (!more) return gis_no_memory(error);
    plan->argument = more;
    const size_t n = strlen(name), size = n + 1 + (value ? strlen(value) + 1 : 0);
    char *text = malloc(size);
    if (!text) return gis_no_memory(error);
    snprintf(text, size, value ? "%s=%s" : "%s", name, value);
    plan->argument[plan->arguments++] = text;
    return true;
}

void gis_plan_clear(gis_plan *plan)
{
    for (size_t k = 0; k < plan->arguments; k++) free(plan->argument[k]);
    free(plan->argument);
    CPLFree(plan->gaps);
    CPLFree(plan->sheet);
    gis_layer_facts_clear(&plan->facts);
    *plan = (gis_plan){0};
}

bool gis_plan_same_call(const gis_plan *a, const gis_plan *b)
{
    bool same = a->arguments == b->arguments && a->shards == b->shards && a->memory == b->memory &&
                strcmp(a->gaps ? a->gaps : "", b->gaps ? b->gaps : "") == 0 &&
                strcmp(a->sheet ? a->sheet : "", b->sheet ? b->sheet : "") == 0;
    for (size_t k = 0; same && k < a->arguments; k++) same = strcmp(a->argument[k], b->argument[k]) == 0;
    return same;
}

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

static void add_text(gis_text *to, const char *text)
{
    const uint64_t n = strlen(text);
    gis_text_add_bytes(to, (const char *)&n, sizeof n);
    gis_text_add_bytes(to, text, n);
}

static const gis_padding holes_of_facts[] = {GIS_PADDING_BETWEEN(gis_layer_facts, source.multipolygons, units),
                                             GIS_PADDING_BETWEEN(gis_layer_facts, units.geographic, units.unit_metres),
                                             GIS_PADDING_BETWEEN(gis_layer_facts, has_id, id_type),
                                             GIS_PADDING_BETWEEN(gis_layer_facts, id_type, invalid),
                                             GIS_PADDING_BETWEEN(gis_layer_facts, multi, checksum)};

static void fill_bytes(const gis_plan *plan, gis_text *to)
{
    const plan_head head = head_of_ours();
    const plan_numbers numbers = {.arguments = plan->arguments,
                                  .facts_size = sizeof plan->facts,
                                  .spool = plan->spool,
                                  .status = plan->status,
                                  .memory = plan->memory,
                                  .shards = plan->shards};
    gis_layer_facts facts = plan->facts;
    facts.name = NULL;
    gis_clear_padding(&facts, 1, sizeof facts, holes_of_facts, sizeof holes_of_facts / sizeof *holes_of_facts);
    gis_text_add_bytes(to, (const char *)&head, sizeof head);
    gis_text_add_bytes(to, (const char *)&numbers, sizeof numbers);
    gis_text_add_bytes(to, (const char *)&facts, sizeof facts);
    add_text(to, plan->facts.name);
    add_text(to, plan->gaps ? plan->gaps : "");
    add_text(to, plan->sheet ? plan->sheet : "");
    for (size_t k = 0; k < plan->arguments; k++) add_text(to, plan->argument[k]);
    const uint64_t checksum = to->failed ? 0 : gis_checksum_of(0, to->at, to->length);
    gis_text_add_bytes(to, (const char *)&checksum, sizeof checksum);
}

bool gis_plan_write(const gis_plan *plan, const char *directory, gis_error *error)
{
    gis_text bytes = {0};
    gis_disk_file file = {0};
    fill_bytes(plan, &bytes);
    const bool done =
        (gis_text_get(&bytes) || gis_no_memory(error)) && gis_disk_file_create(&file, directory, NAME ".part", error) &&
        gis_disk_file_write(&file, bytes.at, bytes.length, error) && gis_disk_file_place(&file, directory, NAME, error);
    gis_disk_file_close(&file);
    gis_text_clear(&bytes);
    return done;
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

typedef struct plan_bytes {
    const char *at;
    size_t left;
} plan_bytes;

static bool take_bytes(plan_bytes *from, void *to, size_t n)
{
    if (from->left < n) return false;
    memcpy(to, from->at, n);
    from->at += n;
    from->left -= n;
    return true;
}

/* Takes a length and a text from the bytes. Returns NULL if they end too early, or if out of memory. */
static char *take_text(plan_bytes *from)
{
    uint64_t n;
    if (!take_bytes(from, &n, sizeof n) || n > from->left) return NULL;
    char *text = CPLCalloc(1, (size_t)n + 1);
    if (text) take_bytes(from, text, (size_t)n);
    return text;
}

static bool take_plan(plan_bytes *from, gis_plan *plan, gis_error *error)
{
    plan_numbers numbers;
    if (!take_bytes(from, &numbers, sizeof numbers) || numbers.facts_size != sizeof plan->facts ||
        !take_bytes(from, &plan->facts, sizeof plan->facts))
        return false;
    plan->shards = numbers.shards;
    plan->memory = numbers.memory;
    plan->spool = numbers.spool;
    plan->status = numbers.status;
    plan->facts.name = take_text(from);
    plan->gaps = plan->facts.name ? take_text(from) : NULL;
    plan->sheet = plan->gaps ? take_text(from) : NULL;
    for (uint64_t k = 0; plan->sheet && k < numbers.arguments; k++) {
        char *text = take_text(from);
        const bool added = text && gis_plan_add_argument(plan, text, NULL, error);
        CPLFree(text);
        if (!added) return false;
    }
    const OGRFieldType id = plan->facts.id_type;
    return plan->sheet && plan->shards > 0 && plan->shards <= GIS_PLAN_MOST_SHARDS && from->left == 0 &&
           (!plan->facts.has_id || id == OFTInteger64 || id == OFTReal || id == OFTString);
}

static bool fail_altered(const char *directory, gis_error *error)
{
    return gis_fail(error, "%s/" NAME ": it was altered or cut off; make the plan anew", directory);
}

static bool read_bytes(const char *directory, char *bytes, size_t n, gis_plan *plan, gis_error *error)
{
    plan_bytes from = {bytes, n};
    plan_head head;
    const plan_head ours = head_of_ours();
    if (!take_bytes(&from, &head, sizeof head) || memcmp(head.what, ours.what, sizeof head.what) != 0)
        return gis_fail(error, "%s/" NAME ": this is no plan of sunder plan", directory);
    head.version[sizeof head.version - 1] = '\0';
    if (strcmp(head.version, ours.version) != 0)
        return gis_fail(error, "%s: the plan was made by sunder %s, and this is %s; make it anew", directory,
                        head.version, ours.version);
    uint64_t checksum;
    if (from.left < sizeof checksum) return fail_altered(directory, error);
    from.left -= sizeof checksum;
    memcpy(&checksum, from.at + from.left, sizeof checksum);
    if (checksum != gis_checksum_of(0, bytes, n - sizeof checksum) || !take_plan(&from, plan, error))
        return fail_altered(directory, error);
    plan->stamp = checksum;
    return true;
}

/* Fails if the directory belongs to a user other than this one or root, or if all users may write into it. A plan is a
 * call of `separate` and names files that are read and written, so a plan that anybody may have written is not used. */
static bool may_be_believed(const char *directory, gis_error *error)
{
    struct stat status;
    if (stat(directory, &status) != 0 || (status.st_uid != geteuid() && status.st_uid != 0))
        return gis_fail(error,
                        "%s: it belongs to another user (%lu), and a plan can make this program read and replace any "
                        "file; if you trust that user, make a copy of your own (cp -r)",
                        directory, (unsigned long)status.st_uid);
    return !(status.st_mode & S_IWOTH) ||
           gis_fail(error, "%s: all users may write into it, so it cannot be trusted; make the plan anew", directory);
}

bool gis_plan_read(const char *directory, gis_plan *plan, gis_error *error)
{
    gis_disk_file file = {0};
    *plan = (gis_plan){0};
    if (access(directory, F_OK) != 0) return gis_fail(error, "%s: no such directory; sunder plan makes one", directory);
    if (!may_be_believed(directory, error)) return false;
    char *path = gis_path_join(directory, NAME);
    const bool there = access(path, F_OK) == 0;
    CPLFree(path);
    if (!there) return gis_fail(error, "%s: there is no plan in it; sunder plan makes a directory with one", directory);
    char *bytes = NULL;
    bool done = gis_disk_file_open(&file, directory, NAME, error);
    if (done && file.size > MOST_BYTES) done = fail_altered(directory, error);
    done = done && ((bytes = malloc((size_t)file.size + 1)) || gis_no_memory(error)) &&
           gis_disk_file_read(&file, 0, bytes, (size_t)file.size, error) &&
           read_bytes(directory, bytes, (size_t)file.size, plan, error);
    free(bytes);
    gis_disk_file_close(&file);
    return done;
}
