#include "generated.h"

#include <stdlib.h>
#include <sys/wait.h>

static char *program(void)
{
    const char *build = getenv("SUNDER_BUILD");
    return test_format("%s/sunder-families", build ? build : ".");
}

bool generated_available(void)
{
    char *path = program();
    FILE *there = fopen(path, "rb");
    if (!there) printf("%s is not there: skipped\n", path);
    if (there) fclose(there);
    free(path);
    return there != NULL;
}

static char *read_all(FILE *pipe)
{
    size_t n = 0, room = 1 << 16;
    char *text = test_alloc(room, 1);
    for (size_t got; (got = fread(text + n, 1, room - n - 1, pipe)) > 0; n += got)
        if (room - n - got < 1024) text = test_resize(text, room *= 2, 1);
    text[n] = '\0';
    return text;
}

char *generated_text(const char *arguments, int *status)
{
    char *path = program(), *command = test_format("'%s' %s%s", path, arguments, status ? " 2>/dev/null" : "");
    FILE *pipe = popen(command, "r");
    char *text = pipe ? read_all(pipe) : NULL;
    const int ended = pipe ? pclose(pipe) : -1, code = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    if (status) *status = code;
    if (!text || (!status && code != 0)) {
        fprintf(stderr, "%s: failed\n", command);
        exit(1);
    }
    free(path);
    free(command);
    return text;
}

void generated_pair(polyset *p, polyset *q, const char *arguments)
{
    char *text = generated_text(arguments, NULL);
    const char *end;
    if (!polyset_read_wkt(p, text, &end) || !polyset_read_wkt(q, end, NULL)) {
        fprintf(stderr, "sunder-families %s: not two polygonal sets\n", arguments);
        exit(1);
    }
    free(text);
}
