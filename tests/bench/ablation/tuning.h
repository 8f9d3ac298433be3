/* Constants and stages of a library that is built so that they can be changed when a program starts.
 *
 * Each src/<room>/tuning.h holds the constants of a room. tunable.cmake makes of it another header of the same name, in
 * which each constant whose value is a number is a member of `struct sunder_i_<room>_tuning`, a variable of the program
 * with the value of the source at first; the names stand for the members. So the sources of the library are the same,
 * and only this library has variables where the ordinary one has constants. */
#ifndef SUNDER_ABLATION_TUNING_H
#define SUNDER_ABLATION_TUNING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef enum tunable_kind { TUNABLE_INT, TUNABLE_UNSIGNED, TUNABLE_FLOAT, TUNABLE_DOUBLE } tunable_kind;

typedef struct tunable {
    const char *room;
    const char *group; /* the heading in tuning.h that the constant stands below: the constants of one stage */
    const char *name;
    tunable_kind kind;
    void *value;
} tunable;

typedef struct tunable_room {
    const char *name;
    int version; /* of its struct, and so of all of its values */
} tunable_room;

/* clang-format off */
#define TUNABLE_KIND(value) \
    _Generic(value, int: TUNABLE_INT, unsigned: TUNABLE_UNSIGNED, float: TUNABLE_FLOAT, double: TUNABLE_DOUBLE)
#define TUNABLE(room, group, name) \
    {#room, group, #name, TUNABLE_KIND(sunder_i_##room##_tuning.name), &sunder_i_##room##_tuning.name}
/* clang-format on */

/* Made by tunable.cmake. */
extern const tunable tunables[];
extern const size_t tunables_n;
extern const tunable_room tunable_rooms[];
extern const size_t tunable_rooms_n;

/* Changes what `changes` names, words with blanks between them; NULL: nothing. Called once, before the library is used:
 *
 *     search.MOST_ROUNDS=20     a constant has this value
 *     search.MOST_ROUNDS*2      ... or this many times its value
 *     off:cluster/descend       a stage is switched off; blanks of its name are written as '_'
 *
 * A share above one half is not multiplied, since it would leave its range; what it leaves of 1 is divided instead. An
 * integer is rounded, to no less than 1.
 * Returns NULL, or the first word that names nothing or has no value. */
const char *tuning_change(const char *changes);

/* One line for each constant, "room TAB group TAB name TAB value", and for each stage that was asked for since the
 * start, "stage TAB table/name". */
void tuning_list(FILE *to);
/* "report 1, search 1, ...": the versions of the rooms' structs. */
void tuning_list_versions(FILE *to);

#endif
