/* Applies the words of SUNDER_TUNING to constants and stages. */
#include "tuning.h"

#include "base/stage_switch.h"

#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define MOST_STAGES 256
#define LONGEST 128
#define SLOTS 1021

/* ---- Stages ------------------------------------------------------------------------------------------------------ */

/* Names of stages, "table/name". */
typedef struct stage_set {
    char name[MOST_STAGES][LONGEST];
    size_t n;
} stage_set;

static stage_set off, seen;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static bool has(const stage_set *set, const char *name)
{
    for (size_t k = 0; k < set->n; k++)
        if (strcmp(set->name[k], name) == 0) return true;
    return false;
}

/* Returns false if the set is full or the name is too long. */
static bool add(stage_set *set, const char *name)
{
    if (has(set, name)) return true;
    if (set->n == MOST_STAGES || strlen(name) >= LONGEST) return false;
    strcpy(set->name[set->n++], name);
    return true;
}

static bool look_up(const char *table, const char *stage)
{
    char name[LONGEST];
    snprintf(name, sizeof name, "%s/%s", table, stage);
    for (char *c = name; *c; c++)
        if (*c == ' ') *c = '_';
    pthread_mutex_lock(&lock);
    add(&seen, name);
    pthread_mutex_unlock(&lock);
    return !has(&off, name);
}

/* Caches call this millions of times, so answers are stored by the addresses of the two constant strings. */
bool sunder_i_stage_is_on(const char *table, const char *stage)
{
    static _Thread_local struct {
        const char *table, *stage;
        bool on;
    } answer[SLOTS], *a;
    a = &answer[((uintptr_t)table * 31 + (uintptr_t)stage) % SLOTS];
    if (a->table != table || a->stage != stage) {
        a->table = table;
        a->stage = stage;
        a->on = look_up(table, stage);
    }
    return a->on;
}

/* ---- Constants --------------------------------------------------------------------------------------------------- */

static double value_of(const tunable *t)
{
    switch (t->kind) {
    case TUNABLE_INT: return *(const int *)t->value;
    case TUNABLE_UNSIGNED: return *(const unsigned *)t->value;
    case TUNABLE_FLOAT: return (double)*(const float *)t->value;
    case TUNABLE_DOUBLE: return *(const double *)t->value;
    }
    return 0;
}

static void set(const tunable *t, double value)
{
    const double whole = fmax(1, nearbyint(value));
    switch (t->kind) {
    case TUNABLE_INT: *(int *)t->value = (int)fmin(whole, 0x1p31 - 1); break;
    case TUNABLE_UNSIGNED: *(unsigned *)t->value = (unsigned)fmin(whole, 0x1p32 - 1); break;
    case TUNABLE_FLOAT: *(float *)t->value = (float)value; break;
    case TUNABLE_DOUBLE: *(double *)t->value = value; break;
    }
}

static double times(const tunable *t, double factor)
{
    const double value = value_of(t);
    const bool share = (t->kind == TUNABLE_FLOAT || t->kind == TUNABLE_DOUBLE) && value > 0.5 && value < 1;
    return share && (1 - value) / factor < 1 ? 1 - (1 - value) / factor : value * factor;
}

/* "room.NAME=value" or "room.NAME*factor". */
static bool change_constant(const char *word)
{
    const size_t named = strcspn(word, "=*");
    char *end;
    const double number = word[named] ? strtod(word + named + 1, &end) : NAN;
    if (isnan(number) || end == word + named + 1 || *end) return false;
    for (size_t k = 0; k < tunables_n; k++) {
        const tunable *t = &tunables[k];
        const size_t room = strlen(t->room);
        if (named != room + 1 + strlen(t->name) || strncmp(word, t->room, room) != 0 || word[room] != '.' ||
            strncmp(word + room + 1, t->name, named - room - 1) != 0)
            continue;
        set(t, word[named] == '=' ? number : times(t, number));
        return true;
    }
    return false;
}

const char *tuning_change(const char *changes)
{
    static char word[LONGEST];
    for (const char *c = changes; c && *c;) {
        const size_t n = strcspn(c, " ");
        if (n >= LONGEST) return c;
        if (n) {
            memcpy(word, c, n);
            word[n] = 0;
            if (strncmp(word, "off:", 4) == 0 ? !add(&off, word + 4) : !change_constant(word)) return word;
        }
        c += n + (c[n] == ' ');
    }
    return NULL;
}

void tuning_list(FILE *to)
{
    for (size_t k = 0; k < tunables_n; k++)
        fprintf(to, "%s\t%s\t%s\t%.17g\n", tunables[k].room, tunables[k].group, tunables[k].name,
                value_of(&tunables[k]));
    for (size_t k = 0; k < seen.n; k++) fprintf(to, "stage\t%s\n", seen.name[k]);
}

void tuning_list_versions(FILE *to)
{
    for (size_t k = 0; k < tunable_rooms_n; k++)
        fprintf(to, "%s%s %d", k ? ", " : "", tunable_rooms[k].name, tunable_rooms[k].version);
}
