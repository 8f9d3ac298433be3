/* merge.c: the command sunder merge. It joins the shards of a plan and writes the result as the command separate
 * does. */
#include "base/message.h"
#include "base/resources.h"
#include "commands/commands.h"
#include "commands/planned.h"
#include "commands/separate_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Looking for missing shards ---------------------------------------------------------------------------------- */

/* Writes the numbers of the missing shards to `text`, consecutive ones as a range: 2, 5-7. If `size` does not suffice
 * the list ends with "...". */
static void list_missing(const bool *missing, unsigned shards, char *text, size_t size)
{
    enum { ROOM_FOR_ONE = 32 };
    size_t n = 0;
    text[0] = '\0';
    for (unsigned k = 0; k < shards; k++) {
        if (!missing[k]) continue;
        unsigned last = k;
        while (last + 1 < shards && missing[last + 1]) last++;
        if (n + ROOM_FOR_ONE > size) {
            snprintf(text + n, size - n, ", ...");
            return;
        }
        n += (size_t)snprintf(text + n, size - n, k == last ? "%s%u" : "%s%u-%u", n ? ", " : "", k + 1, last + 1);
        k = last;
    }
}

static bool find_missing(const gis_shard_run *parts, const gis_plan *plan, bool *missing, bool *any, gis_error *error)
{
    *any = false;
    for (unsigned k = 0; k < plan->shards; k++) {
        gis_shard_state state;
        gis_error why;
        if (!gis_shard_run_state(parts, k + 1, plan->stamp, &state, &why, error)) return false;
        missing[k] = state != GIS_SHARD_DONE;
        *any = *any || missing[k];
        if (state == GIS_SHARD_WRONG) gis_say_warning(GIS_MESSAGE_REMAINS, "%s", why.message);
    }
    return true;
}

static bool all_there(const gis_shard_run *parts, const gis_plan *plan, gis_error *error)
{
    char list[400];
    bool *missing = calloc(plan->shards, sizeof *missing), any;
    if (!missing) return gis_no_memory(error);
    bool done = find_missing(parts, plan, missing, &any, error);
    if (done && any) {
        list_missing(missing, plan->shards, list, sizeof list);
        done =
            gis_fail(error, "%s: it has %u shards, and these are missing: %s; sunder separate --shard K %s makes them",
                     parts->directory, plan->shards, list, parts->directory);
    }
    free(missing);
    return done;
}

/* ---- Joining the shards ------------------------------------------------------------------------------------------ */

static bool resume_run(gis_separate_run *run, const gis_planned *planned, const char *directory, gis_error *error)
{
    const gis_plan *plan = &planned->plan;
    return gis_planned_rules(&planned->options, &run->request.rules, error) &&
           gis_shard_run_resume(&run->request, directory, &plan->facts, plan->shards, plan->memory, &run->parts,
                                error) &&
           gis_plan_check(plan, &run->parts, true, error) && all_there(&run->parts, plan, error) &&
           gis_shard_run_open_source(&run->parts, false, &run->input, error) &&
           gis_shard_run_compare_barriers(&run->parts, &run->input, error) &&
           gis_destinations_spare(&run->to, run->input.source, error);
}

int gis_command_merge(const gis_options *options)
{
    gis_error error;
    gis_separate_run run = {0};
    gis_planned planned;
    const char *directory = options->operand[0];
    bool ok = gis_planned_open(directory, options, options->operand[1], &planned, &error) &&
              gis_separate_begin(&planned.options, &run, &error);
    run.options = &planned.options;
    run.stamp = planned.plan.stamp;
    ok = ok && resume_run(&run, &planned, directory, &error);
    if (ok) gis_shard_run_warn_of_group(&run.parts);
    run.read = gis_clock() - run.start;
    ok = ok && gis_separate_in_parts_begin(&run, &error) && gis_separate_in_parts_end(&run, &error) &&
         gis_separate_deliver(&run, &error);
    const int status = gis_separate_end(&run, ok, &error);
    gis_planned_clear(&planned);
    return status;
}
