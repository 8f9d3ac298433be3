/* plan_description.c: see plan.h. plan.json is for people and scripts; the program never reads it. */
#include "shards/plan/plan.h"

#include "disk/file.h"

#include <stdlib.h>

static void put_estimate(gis_json *out, gis_plan_estimate estimate)
{
    gis_json_put_size(out, "memory_bytes", (uint64_t)estimate.bytes);
    gis_json_put_size(out, "seconds", (uint64_t)estimate.seconds);
}

static void put_shards(gis_json *out, const gis_plan *plan, const gis_plan_load *load, const gis_layer_rules *rules)
{
    gis_json_key(out, "shards");
    gis_json_open(out, '[');
    for (unsigned k = 0; k < plan->shards; k++) {
        gis_json_line(out);
        gis_json_open(out, '{');
        gis_json_put_size(out, "shard", k + 1);
        gis_json_put_size(out, "features", load[k].features);
        gis_json_put_size(out, "vertices", load[k].vertices);
        put_estimate(out, gis_plan_estimate_shard(plan, &load[k], rules));
        gis_json_close(out, '}');
    }
    gis_json_close(out, ']');
}

/* The largest needs of any shard, for a scheduler that gives all shards the same resources. */
static void put_most(gis_json *out, const gis_plan *plan, const gis_plan_load *load, const gis_layer_rules *rules)
{
    gis_plan_estimate most = {0, 0};
    for (unsigned k = 0; k < plan->shards; k++) {
        const gis_plan_estimate one = gis_plan_estimate_shard(plan, &load[k], rules);
        if (one.bytes > most.bytes) most.bytes = one.bytes;
        if (one.seconds > most.seconds) most.seconds = one.seconds;
    }
    gis_json_key(out, "each_shard");
    gis_json_open(out, '{');
    put_estimate(out, most);
    gis_json_close(out, '}');
    gis_json_line(out);
}

/* The largest contact group, which is one piece of work: that of the shard that contains it, or else the merge's. */
static void put_group(gis_json *out, const gis_shard_run *parts)
{
    gis_json_key(out, "largest_group");
    gis_json_open(out, '{');
    gis_json_put_size(out, "features", parts->facts.group.features);
    gis_json_put_size(out, "vertices", parts->facts.group.vertices);
    put_estimate(out, gis_plan_estimate_group(parts));
    gis_json_close(out, '}');
    gis_json_line(out);
}

static void describe_plan(gis_json *out, const gis_plan *plan, const gis_plan_load *load, const gis_shard_run *parts)
{
    const gis_layer_rules *rules = &parts->request->rules;
    gis_json_open(out, '{');
    gis_json_put_string(out, "command", "plan");
    gis_json_put_string(out, "version", sunder_version());
    gis_json_key(out, "arguments");
    gis_json_open(out, '[');
    for (size_t k = 0; k < plan->arguments; k++) gis_json_string(out, plan->argument[k]);
    gis_json_close(out, ']');
    gis_json_line(out);
    if (plan->gaps && *plan->gaps) {
        gis_json_key(out, "gaps");
        gis_json_raw(out, plan->gaps);
        gis_json_line(out);
    }
    if (plan->sheet && *plan->sheet) {
        gis_json_key(out, "spec");
        gis_json_raw(out, plan->sheet);
        gis_json_line(out);
    }
    gis_json_put_string(out, "layer", plan->facts.name);
    gis_json_put_size(out, "features", plan->facts.source.features);
    gis_json_put_size(out, "vertices", plan->facts.vertices);
    gis_json_put_size(out, "skipped", plan->facts.skipped);
    gis_json_put_size(out, "max_memory_bytes", (uint64_t)plan->memory);
    gis_json_put_size(out, "shard_count", plan->shards);
    gis_json_line(out);
    put_most(out, plan, load, rules);
    put_group(out, parts);
    gis_json_key(out, "merge");
    gis_json_open(out, '{');
    put_estimate(out, gis_plan_estimate_merge(plan, parts));
    gis_json_close(out, '}');
    gis_json_line(out);
    put_shards(out, plan, load, rules);
    gis_json_close(out, '}');
    gis_json_raw(out, "\n");
}

static void weigh_shards(const gis_plan *plan, const gis_spool *spool, gis_plan_load *load)
{
    const unsigned parts_each = gis_spool_parts(spool) / plan->shards;
    for (size_t k = 0; k < gis_spool_cells(spool); k++) {
        const gis_spool_cell *cell = gis_spool_cell_at(spool, k);
        gis_plan_load *to = &load[cell->part / parts_each];
        to->features += cell->features;
        to->vertices += cell->vertices;
    }
}

bool gis_plan_describe(const gis_plan *plan, const gis_shard_run *parts, const char *directory, gis_error *error)
{
    gis_json json = {0};
    gis_disk_file file = {0};
    gis_plan_load *load = calloc(plan->shards, sizeof *load);
    if (!load) return gis_no_memory(error);
    weigh_shards(plan, parts->spool, load);
    describe_plan(&json, plan, load, parts);
    free(load);
    const bool done = (gis_json_text(&json) || gis_no_memory(error)) &&
                      gis_disk_file_create(&file, directory, "plan.json.part", error) &&
                      gis_disk_file_write(&file, json.text.at, json.text.length, error) &&
                      gis_disk_file_place(&file, directory, "plan.json", error);
    gis_disk_file_close(&file);
    gis_json_clear(&json);
    return done;
}
