/* message.c: one line a message. Texts from elsewhere (a driver, a broken file) may hold line breaks and other control
 * characters; a script that reads stderr line by line must still see one message as one line, and a terminal must not
 * be told what to do by a file. */
#include "base/message.h"

#include "base/interrupt.h"

#include <stdarg.h>
#include <stdio.h>

static void print_line(const char *kind, const char *text)
{
    fflush(stdout); /* so that the order is right where both go to one terminal */
    fprintf(stderr, "sunder: %s: ", kind);
    for (const char *c = text; *c; c++) fputc((unsigned char)*c < ' ' || *c == 0x7f ? ' ' : *c, stderr);
    fputc('\n', stderr);
}

void gis_say_warning(const char *format, ...)
{
    char text[2048]; /* longer ones are cut */
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    print_line("warning", text);
}

int gis_say_failure(const gis_error *error)
{
    gis_failure_told(error->exit_status);
    print_line("error", error->message);
    return error->exit_status;
}

void gis_say_warnings(const gis_sentences *list)
{
    for (size_t i = 0; i < list->n && !gis_interrupted(); i++) /* once a signal has come they tell of calls cut short */
        print_line("warning", list->items[i]);
}
