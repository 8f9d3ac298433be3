/* shard.c: the command line sunder separate --shard K PLAN. It separates one shard of a plan and writes the result into
 * the directory of the plan. */
#include "base/exit_status.h"
#include "base/json.h"
#include "base/message.h"
#include "base/resources.h"
#include "commands/command_stats.h"
#include "commands/commands.h"
#include "commands/planned.h"
#include "commands/resolve.h"

#include <stdio.h>

typedef struct shard_run {
    const char *directory;
    unsigned k, shards;
    bool quiet, there; /* there: the shard was done already */
    double start;
} shard_run;

static void json_shard(gis_json *out, const shard_run *run)
{
    gis_json_open(out, '{');
    gis_json_put_string(out, "command", "separate");
    gis_json_put_size(out, "shard", run->k);
    gis_json_put_size(out, "shards", run->shards);
    gis_json_put_bool(out, "done_already", run->there);
    gis_json_seconds(out, "seconds", gis_clock() - run->start);
    gis_json_put_size(out, "peak_rss_bytes", gis_peak_rss());
    gis_json_close(out, '}');
    gis_json_raw(out, "\n");
}

static bool print_shard(const void *done, gis_error *error)
{
    const shard_run *run = done;
    (void)error; /* an error of stdio is found when stdout is flushed */
    if (run->there)
        printf("%s: shard %u of %u was done already\n", run->directory, run->k, run->shards);
    else
        printf("%s: shard %u of %u; %.3g s\n", run->directory, run->k, run->shards, gis_clock() - run->start);
    return true;
}

static bool deliver_shard(const shard_run *run, const gis_destinations *to, bool taken, gis_error *error)
{
    gis_json stats = {0};
    if (to->stats) json_shard(&stats, run);
    const gis_delivery delivery = {
        .to = to, .stats = &stats, .print = taken || run->quiet ? NULL : print_shard, .run = run};
    const bool done = gis_deliver(&delivery, error);
    gis_json_clear(&stats);
    return done;
}

/* Sets run->there if the shard is done already. An unusable file of it causes a warning; the shard is then made
 * again. */
static bool find_state(shard_run *run, const gis_shard_run *parts, uint64_t stamp, gis_error *error)
{
    gis_shard_state state;
    gis_error why;
    if (!gis_shard_run_state(parts, run->k, stamp, &state, &why, error)) return false;
    run->there = state == GIS_SHARD_DONE;
    if (state == GIS_SHARD_WRONG) gis_say_warning(GIS_MESSAGE_REMAINS, "%s; it is made again", why.message);
    return true;
}

static bool separate_shard(shard_run *run, const gis_planned *planned, gis_progress *progress, gis_error *error)
{
    const gis_plan *plan = &planned->plan;
    gis_layer_input_request request = {0};
    gis_shard_run parts = {0};
    const bool done =
        gis_resolve_layer(&planned->options, &request, error) &&
        gis_planned_rules(&planned->options, &request.rules, error) &&
        gis_shard_run_resume(&request, run->directory, &plan->facts, plan->shards, plan->memory, &parts, error) &&
        gis_plan_check(plan, &parts, false, error) && find_state(run, &parts, plan->stamp, error) &&
        (run->there || gis_shard_run_separate(&parts, run->k, plan->stamp, progress, error));
    gis_shard_run_clear(&parts);
    gis_layer_input_request_clear(&request);
    return done;
}

int gis_command_shard(const gis_options *options)
{
    gis_error error;
    bool taken;
    gis_planned planned = {0};
    const gis_destinations to = {.stats = options->text[OPT_STATS], .input = {options->operand[0], NULL}};
    gis_progress progress = gis_resolve_progress(options);
    shard_run run = {.directory = options->operand[0], .quiet = options->given[OPT_QUIET], .start = gis_clock()};
    bool ok = gis_destinations_check(&to, &taken, &error) &&
              gis_planned_open(run.directory, options, run.directory, &planned, &error);
    run.shards = planned.plan.shards;
    const double k = options->number[OPT_SHARD];
    if (ok && !(k >= 1 && k <= run.shards))
        ok = gis_fail_usage(&error, "--shard %.0f: the shards of %s are 1 to %u", k, run.directory, run.shards);
    if (ok) run.k = (unsigned)k;
    gis_progress_stage(&progress, 0, 1);
    ok = ok && separate_shard(&run, &planned, &progress, &error);
    if (ok) gis_progress_done(&progress);
    ok = ok && deliver_shard(&run, &to, taken, &error);
    gis_planned_clear(&planned);
    return ok ? GIS_DONE : gis_say_failure(&error);
}
