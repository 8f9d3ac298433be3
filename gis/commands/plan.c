/* plan.c: the command sunder plan. It copies the layer to disk and cuts it into shards; the directory of the plan
 * contains all data that the shards and their merge need. */
#include "base/exit_status.h"
#include "base/message.h"
#include "commands/commands.h"
#include "commands/planned.h"
#include "commands/resolve.h"
#include "layer/layer_checksum.h"

#include <stdio.h>
#include <unistd.h>

/* The limit in bytes for the memory of a process, unless --max-memory gives one. */
static const double usual_memory = 1e9;

typedef struct plan_run {
    const char *directory;
    gis_planned planned;
    gis_layer_input_request request;
    gis_plan_place place;
    gis_shard_run parts;
    bool quiet, there; /* there: the same plan existed already, and nothing was done */
} plan_run;

static bool read_call(plan_run *run, const gis_options *options, gis_error *error)
{
    gis_plan *plan = &run->planned.plan;
    if (!options->given[OPT_SHARDS]) return gis_fail_usage(error, "--shards N is missing: the number of shards");
    if (!(options->number[OPT_SHARDS] >= 1 && options->number[OPT_SHARDS] <= GIS_PLAN_MOST_SHARDS))
        return gis_fail_usage(error, "--shards: 1 to %d", GIS_PLAN_MOST_SHARDS);
    plan->shards = (unsigned)options->number[OPT_SHARDS];
    if (!gis_resolve_memory(options, &plan->memory, error)) return false;
    if (plan->memory == 0) plan->memory = usual_memory;
    const gis_options nothing = {0};
    return gis_planned_arguments(options, plan, error) &&
           gis_planned_parse(&run->planned, &nothing, run->directory, error) &&
           gis_resolve_layer(&run->planned.options, &run->request, error) &&
           gis_planned_rules(&run->planned.options, &run->request.rules, error);
}

/* Compares the plan that exists already with the requested one. If they are equal run->there is set; else it fails. */
static bool compare_with_former(plan_run *run, gis_error *error)
{
    gis_plan former;
    uint64_t checksum;
    bool done = gis_plan_read(run->directory, &former, error);
    if (done && !gis_plan_same_call(&former, &run->planned.plan))
        done = gis_fail(error, "%s: a plan of another command line exists already; remove it, or give another name",
                        run->directory);
    done = done && gis_layer_checksum(&run->request, &former.facts.source, &checksum, error);
    if (done && checksum != former.facts.checksum)
        done = gis_fail(
            error,
            "%s: a plan exists already, but %s has changed since it was made; remove the plan, or give another name",
            run->directory, run->request.source.path);
    gis_plan_clear(&former);
    run->there = done;
    return done;
}

static bool make_plan(plan_run *run, gis_error *error)
{
    gis_plan *plan = &run->planned.plan;
    gis_layer_facts *facts = &run->parts.facts;
    bool taken = false;
    if (!gis_plan_place_begin(run->directory, &run->place, error)) return false;
    const char *place = run->place.path;
    if (!gis_shard_run_begin(&run->request, place, plan->shards, plan->memory, &run->parts, error)) return false;
    plan->facts = *facts; /* a shallow copy: run->parts owns the facts */
    plan->spool = gis_spool_checksum(run->parts.spool);
    const bool written = gis_plan_status_checksum(place, &plan->status, error) &&
                         gis_plan_describe(plan, &run->parts, place, error) && gis_plan_write(plan, place, error);
    plan->facts = (gis_layer_facts){0};
    if (!written || !gis_go_on(error) || !gis_plan_place_end(&run->place, run->directory, &taken, error)) return false;
    return !taken || compare_with_former(run, error);
}

static void print_plan(const plan_run *run)
{
    if (run->quiet) return;
    if (run->there) {
        printf("%s: done already\n", run->directory);
        return;
    }
    printf("%s: %zu features in %u shard%s\n", run->directory, run->parts.facts.source.features,
           run->planned.plan.shards, run->planned.plan.shards == 1 ? "" : "s");
    printf("next: sunder separate --shard K %s for K from 1 to %u, then sunder merge %s OUTPUT\n", run->directory,
           run->planned.plan.shards, run->directory);
}

int gis_command_plan(const gis_options *options)
{
    gis_error error;
    plan_run run = {.directory = options->operand[1], .quiet = options->given[OPT_QUIET]};
    gis_progress progress = gis_resolve_progress(options);
    bool ok = read_call(&run, options, &error);
    ok = ok && (access(run.directory, F_OK) == 0 ? compare_with_former(&run, &error) : make_plan(&run, &error));
    if (ok) {
        gis_progress_done(&progress);
        print_plan(&run);
    }
    const int status = ok ? GIS_DONE : gis_say_failure(&error);
    gis_shard_run_clear(&run.parts);
    gis_plan_place_clear(&run.place);
    gis_layer_input_request_clear(&run.request);
    gis_planned_clear(&run.planned);
    return status;
}
