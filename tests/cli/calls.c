/* calls.c: calls the program many times in one process. Loading GDAL takes longer than most tests of arguments; here it
 * is loaded once, and each call runs in a fork.
 *
 * Calls are lines on stdin, arguments separated by blanks, without the program's name. For each call a line is printed
 * on stdout: the exit status, a tab, and the output on stderr with blanks for its line ends. The call's output on
 * stdout is dropped. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

int sunder_main(int argc, char **argv); /* main() of gis/main.c, which is compiled under this name */

enum { WORDS = 64 };

static void fail(const char *what)
{
    perror(what);
    exit(1);
}

static int split(char *line, char *words[WORDS])
{
    int n = 0;
    words[n++] = "sunder";
    for (char *word = strtok(line, " \n"); word; word = strtok(NULL, " \n")) {
        if (n == WORDS - 1) fail("words of a call");
        words[n++] = word;
    }
    words[n] = NULL;
    return n;
}

static void call(char *line, int errors)
{
    char *words[WORDS];
    int n = split(line, words), nothing = open("/dev/null", O_RDWR);
    if (nothing < 0 || dup2(nothing, 0) < 0 || dup2(nothing, 1) < 0 || dup2(errors, 2) < 0) fail("standard streams");
    close(nothing), close(errors);
    const int status = sunder_main(n, words);
#ifdef SUNDER_ENDS_AS_EVER /* sanitizers and counters report at the end */
    exit(status);
#else /* the destructors of the libraries take three quarters of a call's time */
    fflush(NULL);
    _exit(status);
#endif
}

/* Reads until all processes have closed the other end. */
static void pass_on(int from)
{
    char said[4096];
    for (ssize_t n; (n = read(from, said, sizeof said)) > 0;)
        for (ssize_t i = 0; i < n; i++) putchar(said[i] == '\n' ? ' ' : said[i]);
}

int main(void)
{
    char *line = NULL;
    size_t size = 0;
    while (getline(&line, &size, stdin) >= 0) {
        int ends[2], status;
        if (pipe(ends)) fail("pipe");
        pid_t child = fork();
        if (child < 0) fail("fork");
        if (child == 0) close(ends[0]), call(line, ends[1]);
        close(ends[1]);
        /* The status is printed first. The child's messages wait in the pipe, which none of these calls fills. */
        if (waitpid(child, &status, 0) != child) fail("waitpid");
        printf("%d\t", WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
        pass_on(ends[0]);
        close(ends[0]);
        putchar('\n'), fflush(stdout); /* otherwise a child would inherit the buffered line and print it again */
    }
    free(line);
    return 0;
}
