/* help.c: prints --help, generated from the table of options. It fits on a screen: options that are specific to sunder
 * have a line each; those known from ogr2ogr are listed by name, wrapped, with their defaults. */
#include "options/options.h"

#include <stdio.h>
#include <string.h>

/* SCREEN_WIDTH: lists of names are wrapped before this column. HELP_COLUMN: the
 * description of an option begins there, or after the option if that is longer. */
enum { SCREEN_WIDTH = 118, HELP_COLUMN = 37 };

static const char *const group_titles[GIS_N_GROUPS] = {
    [GIS_GROUP_OWN] = "Options [default]:",
    [GIS_GROUP_PLACES] = "Preferred places:",
    [GIS_GROUP_ROOM] = "Features without room:",
    [GIS_GROUP_INPUT] = "Which features, as in ogr2ogr:",
    [GIS_GROUP_OUTPUT] = "Output, as in ogr2ogr:",
    [GIS_GROUP_TROUBLE] = "Trouble:",
    [GIS_GROUP_RUNNING] = "Running:",
};

/* Writes "--gap LENGTH" to `text`, with the other spellings and the default if `spellings` is true. Returns the length
 * of the text. */
static size_t describe_option(const gis_option *option, bool spellings, char *text, size_t size)
{
    size_t n = strcspn(option->names, " ");
    const char *joint = option->type == GIS_TYPE_OPTIONAL ? "[=" : " ";
    int length = snprintf(text, size, "%.*s%s%s%s", (int)n, option->names, option->metavar ? joint : "",
                          option->metavar ? option->metavar : "",
                          option->metavar && option->type == GIS_TYPE_OPTIONAL ? "]" : "");
    const char *others = option->names + n;
    if (spellings && *others) {
        length += snprintf(text + length, size - (size_t)length, " (");
        for (const char *c = others + 1; *c; c++)
            length += snprintf(text + length, size - (size_t)length, *c == ' ' ? ", " : "%c", *c);
        length += snprintf(text + length, size - (size_t)length, ")");
    }
    if (spellings && option->fallback)
        length += snprintf(text + length, size - (size_t)length, " [%s]", option->fallback);
    return (size_t)length;
}

static void print_own(unsigned command)
{
    for (int i = 0; i < OPT_N; i++) {
        const gis_option *option = &gis_option_table[i];
        if (option->group > GIS_GROUP_IDENTITY || !(option->commands & command)) continue;
        char name[256];
        describe_option(option, false, name, sizeof name);
        printf("  %-*s %s", HELP_COLUMN - 3, name, option->help);
        if (option->fallback) printf(" [%s]", option->fallback);
        printf("\n");
    }
}

/* Prints the title of a group and its options, on as many lines as needed. */
static void print_packed(unsigned command, gis_option_group group)
{
    size_t column = (size_t)printf("%s", group_titles[group]);
    const char *joint = " ";
    for (int i = 0; i < OPT_N; i++) {
        const gis_option *option = &gis_option_table[i];
        if (option->group != group || !(option->commands & command)) continue;
        char name[256];
        size_t length = describe_option(option, true, name, sizeof name);
        if (column + strlen(joint) + length > (size_t)SCREEN_WIDTH) {
            joint = *joint == ',' ? ",\n  " : "\n  ";
            column = 0;
        }
        column += (size_t)printf("%s%s", joint, name);
        joint = ", ";
    }
    printf("\n");
}

static bool has_any(unsigned command, int group)
{
    for (int i = 0; i < OPT_N; i++) {
        const int of = gis_option_table[i].group == GIS_GROUP_IDENTITY ? GIS_GROUP_OWN : (int)gis_option_table[i].group;
        if (of == group && (gis_option_table[i].commands & command)) return true;
    }
    return false;
}

void gis_help_command(const gis_command *command)
{
    printf("Usage: sunder %s [options] %s\n%s.\n", command->name, command->operands, command->summary);
    for (int group = 0; group < GIS_GROUP_HIDDEN; group++) {
        if (group == GIS_GROUP_IDENTITY || !has_any(command->bit, group)) continue;
        if (group == GIS_GROUP_OWN) {
            printf("%s\n", group_titles[group]);
            print_own(command->bit);
        } else {
            print_packed(command->bit, (gis_option_group)group);
        }
    }
    if (command->bit & GIS_SHAPES)
        printf("P, Q: WKT (MULTI)POLYGON, @FILE or @- that holds it, disc:R[:N], inside-disc:R[:N], square:SIDE,\n"
               "rectangle:WxH, or a data source. ");
    if (command->bit & GIS_ROUTE)
        printf("OBSTACLES, SHAPE: a data source, WKT, @FILE or @- that holds it, disc:R[:N], inside-disc:R[:N],\n"
               "square:SIDE, rectangle:WxH. ");
    if (command->bit & GIS_BUFFER)
        printf("SHAPE: WKT (MULTI)POLYGON, @FILE or @- that holds it, disc:R[:N] (around the disc), "
               "inside-disc:R[:N],\nsquare:SIDE or rectangle:WxH. ");
    if (command->bit & GIS_ALL)
        printf("Lengths: 3 (the layer's unit), 3m, 10ft, 10us-ft, 0.2mm (on the sheet, with --scale).\n");
    printf("Exit status: 0 done, 1 failed, 2 wrong usage%s. See also man sunder-%s.\n"
           "Example: sunder %s %s\n",
           command->bit & (GIS_SEPARATE | GIS_CHECK | GIS_MERGE) ? ", 3 conflicts"
           : command->bit & GIS_ROUTE                            ? ", 3 no route"
                                                                 : "",
           command->name, command->name, command->example);
}

void gis_help_program(void)
{
    printf("Usage: sunder COMMAND [options] OPERANDS\n"
           "Exact Minkowski sums, and map features moved apart by the least amount.\n\nCommands:\n");
    for (size_t i = 0; i < gis_n_commands; i++)
        printf("  %-10s %-18s %s\n", gis_commands[i].name, gis_commands[i].operands, gis_commands[i].summary);
    printf("\n`sunder COMMAND --help` lists the options of a command; `sunder --version` prints the version.\n"
           "`sunder --options-json` prints all of them for other programs, `sunder --spec-schema` the keys\n"
           "of --spec.\n"
           "Exit status: 0 done, 1 failed, 2 wrong usage, 3 conflicts remain or were found, or no route.\n"
           "SIGINT, SIGTERM and SIGHUP end a run and leave the former output; a second one ends it at once.\n");
}
