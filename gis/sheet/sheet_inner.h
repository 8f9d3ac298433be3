/* sheet_inner.h: what the files of this folder share. A place is a path within the sheet, such as "layers[1].width". */
#ifndef GIS_SHEET_INNER_H
#define GIS_SHEET_INNER_H

#include "sheet/sheet.h"

#include <json-c/json.h>

enum { GIS_PLACE_SIZE = 160 };

/* Fails with "SHEET.json: PLACE: MESSAGE", as wrong usage. */
bool gis_sheet_fail(const gis_sheet *sheet, gis_error *error, const char *place, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* The member of an object; NULL if it has none. */
struct json_object *gis_sheet_member(struct json_object *object, const char *key);
/* The member as text, which it has to be; NULL if there is none. */
bool gis_sheet_text(const gis_sheet *sheet, struct json_object *object, const char *place, const char *key,
                    const char **out, gis_error *error);
/* A text, or a number as it is written in the file; NULL if it is neither. */
const char *gis_sheet_scalar(struct json_object *value);
bool gis_sheet_length(const gis_sheet *sheet, struct json_object *value, const char *place, gis_optional_length *out,
                      gis_error *error);
/* ---- rule_keys.c: options as keys, such as max_shift for --max-shift --------------------------------------------- */

/* The option of a rule with that key; NULL if there is none. */
const gis_option *gis_rule_of_key(const char *key);
/* Is the option a rule that a sheet can give? Then its key is written to `key`. */
bool gis_rule_key(const gis_option *option, char *key, size_t size);
/* Fails if an object has a key that is not in the list, which ends with NULL; `rules`: keys of rules are allowed,
 * too. */
bool gis_sheet_check_keys(const gis_sheet *sheet, struct json_object *object, const char *place,
                          const char *const *keys, bool rules, gis_error *error);
/* Sets the options for the rules in an object that are not given yet. */
bool gis_rules_set(const gis_sheet *sheet, struct json_object *object, const char *place, gis_options *options,
                   gis_error *error);

/* ---- sheet_gaps.c ------------------------------------------------------------------------------------------------ */

/* Reads the rules of gaps and the names of classes. Leading rules for all classes become --gap and --least-gap. */
bool gis_sheet_read_gaps(gis_sheet *sheet, gis_options *options, gis_error *error);
/* The number of the class with that name; 0 if no rule has it. */
uint32_t gis_sheet_class(const gis_sheet *sheet, const char *name);
/* Reads "class" of a layer: a name (unless given that of the layer), or a field. Sets the other to NULL. */
bool gis_sheet_read_class(const gis_sheet *sheet, struct json_object *layer, const char *place, const char **name,
                          const char **field, gis_error *error);
/* Is the rule about all classes? */
bool gis_sheet_is_for_all(struct json_object *rule);
/* Fails if a rule has a class that no layer has, unless a layer has its classes in a field. */
bool gis_sheet_check_classes(const gis_sheet *sheet, gis_error *error);

/* Makes the options borrow the gaps by classes, once they are read. */
void gis_sheet_lend_gaps(gis_sheet *sheet, gis_options *options);

/* ---- sheet_barriers.c -------------------------------------------------------------------------------------------- */

/* Adds the values of --barrier for a layer that does not move. */
bool gis_sheet_add_barriers(gis_sheet *sheet, struct json_object *layer, const char *place, gis_options *options,
                            gis_error *error);
/* The path of a dataset in the sheet, freed with CPLFree(). */
char *gis_sheet_dataset(const gis_sheet *sheet, const char *source);

/* ---- sheet_legible.c --------------------------------------------------------------------------------------------- */

/* Sets the rules of "legible" in an object that are not given yet. */
bool gis_sheet_read_legible(const gis_sheet *sheet, struct json_object *of, const char *place, gis_legible_rules *rules,
                            gis_error *error);
/* What each of its keys means. */
extern const char *const gis_sheet_legible_about[SUNDER_ILLEGIBLE_KINDS];

/* ---- sheet_moving.c ---------------------------------------------------------------------------------------------- */

/* Applies the n layers that move: the first to the options, each other one to a copy of them (options->more). */
bool gis_sheet_apply_moving(gis_sheet *sheet, size_t n, gis_options *options, gis_error *error);
/* Gives the options of each layer that moves the gaps of classes and least sizes, if there are some. */
void gis_sheet_lend_rules(gis_sheet *sheet, gis_options *options);
/* Does the rule hold for all layers that move, so that no layer has a value of its own? */
bool gis_sheet_is_common(gis_option_id id);
/* Is it a layer that moves? */
bool gis_sheet_is_moving(struct json_object *layer);

/* ---- sheet_follow.c ---------------------------------------------------------------------------------------------- */

/* Reads a layer that goes along with those that move. */
bool gis_sheet_add_follower(gis_sheet *sheet, struct json_object *layer, const char *place, gis_options *options,
                            gis_error *error);
/* Checks what such layers say of those that move, once these are known, and lends them to the options. */
bool gis_sheet_lend_followers(gis_sheet *sheet, gis_options *options, gis_error *error);
extern const char *const gis_sheet_follower_keys[];

/* ---- sheet_print.c ----------------------------------------------------------------------------------------------- */

/* Puts the options of the command line into a copy of the sheet. */
bool gis_sheet_make_effective(gis_sheet *sheet, const gis_options *options, gis_error *error);

/* The keys of layers, by role; each list ends with NULL. */
extern const char *const gis_sheet_moving_keys[];
extern const char *const gis_sheet_barrier_keys[];

#endif
