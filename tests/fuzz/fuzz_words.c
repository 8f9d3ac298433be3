/* Hostile command lines: the words of a command, a line each, and the parts of a --barrier. */
#include "layer/barriers/barrier.h"
#include "options/options.h"

#include "bytes.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_WORDS = 40 };

static void ask_words(unsigned which, char *text)
{
    char *word[MOST_WORDS];
    int n = 0;
    for (char *line = text; line && n < MOST_WORDS; n++) {
        word[n] = line;
        line = strchr(line, '\n');
        if (line) *line++ = 0;
    }
    const gis_command command = {1u << which % 6, "command", "A [B [C]]", 0, 3, "", "", NULL};
    gis_options options;
    gis_error error = {0};
    if (gis_options_parse(&command, n, word, &options, &error)) {
        FUZZ_DEMAND(options.n_operands <= 3);
        for (int i = 0; i < OPT_N; i++) FUZZ_DEMAND(!options.given[i] || gis_option_table[i].commands & command.bit);
    } else {
        FUZZ_DEMAND(error.message[0] != 0);
    }
    gis_options_clear(&options);
}

static void ask_barrier(const char *text)
{
    gis_barrier_request request = {0};
    gis_error error = {0};
    if (gis_barrier_parse(text, &request, &error)) {
        FUZZ_DEMAND(request.dataset && request.dataset[0]);
        gis_barrier_request_clear(&request);
    } else {
        FUZZ_DEMAND(error.message[0] != 0);
    }
}

/* The program's table of commands is used by --help only, which is not called here. */
const gis_command gis_commands[1];
const size_t gis_n_commands = 0;

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size == 0) return 0;
    char *text = malloc(size);
    if (!text) return 0;
    memcpy(text, data + 1, size - 1);
    text[size - 1] = 0;
    ask_barrier(text);
    ask_words(data[0], text);
    free(text);
    return 0;
}
