/* warm_server.c: starts a program many times and loads it once; warm.c has the other half, and the reason.
 *
 * A library that is preloaded. The dynamic loader loads the program with its libraries and runs their constructors,
 * and then calls __libc_start_main with the program's main(): here this function waits for calls. Each is a fork,
 * which takes the arguments, environment, folder and files of the call and goes on to main(). The server ends with the
 * process SUNDER_WARM_OWNER, and so do its calls; a call whose client has gone is killed. */
#define _GNU_SOURCE
#include "warm.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

enum { CALLS = 64, FIRST_FREE = 300 /* received files wait above this number */ };

typedef int main_function(int, char **, char **);
typedef int start_function(main_function *, int, char **, void (*)(void), void (*)(void), void (*)(void), void *);

static char **words; /* of the call that this process became */

static int process_file(pid_t process) { return (int)syscall(SYS_pidfd_open, process, 0); }

static void read_all(int from, void *to, size_t bytes)
{
    for (char *at = to; bytes > 0;) {
        const ssize_t n = read(from, at, bytes);
        if (n <= 0) _exit(127);
        at += n, bytes -= (size_t)n;
    }
}

/* Receives the call and its files, whose new numbers are above FIRST_FREE. */
static warm_call receive(int client, int *file)
{
    warm_call call;
    union {
        struct cmsghdr header;
        char space[CMSG_SPACE(sizeof(int) * WARM_FDS)];
    } control;
    struct iovec part = {&call, sizeof call};
    struct msghdr message = {
        .msg_iov = &part, .msg_iovlen = 1, .msg_control = &control, .msg_controllen = sizeof control};
    if (recvmsg(client, &message, 0) != sizeof call || !CMSG_FIRSTHDR(&message) || call.files > WARM_FDS) _exit(127);
    int received[WARM_FDS];
    memcpy(received, CMSG_DATA(CMSG_FIRSTHDR(&message)), sizeof(int) * call.files);
    for (uint32_t k = 0; k < call.files; k++) file[k] = fcntl(received[k], F_DUPFD, FIRST_FREE);
    return call;
}

/* The process of a call takes over what the client had. */
static int become(int client)
{
    int file[WARM_FDS];
    warm_call call = receive(client, file);
    char *text = malloc(call.bytes);
    words = calloc(call.arguments + call.variables + 2, sizeof *words);
    if (!text || !words) _exit(127);
    read_all(client, text, call.bytes);
    for (uint32_t k = 0; k < call.arguments + call.variables; k++, text += strlen(text) + 1)
        words[k + (k >= call.arguments)] = text; /* the environment follows the null pointer after the arguments */
    environ = words + call.arguments + 1;
    for (int k = 0; k < FIRST_FREE; k++) close(k);
    if (fchdir(file[0])) _exit(127);
    for (uint32_t k = 1; k < call.files; k++)
        if (dup2(file[k], call.number[k]) < 0) _exit(127);
    for (uint32_t k = 0; k < call.files; k++) close(file[k]);
    umask(call.mask);
    for (int k = 1; k < NSIG && k < 64; k++) signal(k, call.ignored >> k & 1 ? SIG_IGN : SIG_DFL);
    sigprocmask(SIG_SETMASK, &call.blocked, NULL);
    return (int)call.arguments;
}

/* Waits for calls; returns in the process of each, with the number of its arguments. */
static int serve(const char *name, pid_t owner)
{
    struct pollfd at[2 + 2 * CALLS] = {{.fd = socket(AF_UNIX, SOCK_STREAM, 0), .events = POLLIN},
                                       {.fd = process_file(owner), .events = POLLIN}};
    pid_t process[CALLS];
    int calls = 0;
    struct sockaddr_un address;
    const socklen_t length = warm_address(&address, name);
    if (at[0].fd < 0 || at[1].fd < 0 || bind(at[0].fd, (struct sockaddr *)&address, length) || listen(at[0].fd, CALLS))
        _exit(1);
    for (;;) {
        const nfds_t n = (nfds_t)(2 + 2 * calls);
        if (calls == CALLS) at[0].events = 0;
        if (poll(at, n, -1) < 0) _exit(1);
        for (int k = calls; k-- > 0;) { /* from the last, since the last takes the place of one that is done */
            struct pollfd *client = at + 2 + 2 * k, *ended = client + 1;
            int status = 0;
            if (client->revents) kill(process[k], SIGKILL);
            if (!client->revents && !ended->revents) continue;
            waitpid(process[k], &status, 0);
            send(client->fd, &status, sizeof status, MSG_NOSIGNAL);
            close(client->fd), close(ended->fd);
            calls--;
            client[0] = at[2 + 2 * calls], client[1] = at[3 + 2 * calls], process[k] = process[calls];
            at[0].events = POLLIN;
        }
        if (at[1].revents) break;
        if (!(at[0].revents & POLLIN)) continue;
        const int client = accept(at[0].fd, NULL, NULL);
        if (client < 0) continue;
        process[calls] = fork();
        if (process[calls] == 0) return become(client);
        if (process[calls] < 0) _exit(1);
        send(client, process + calls, sizeof *process, MSG_NOSIGNAL);
        at[2 + 2 * calls] = (struct pollfd){.fd = client, .events = POLLRDHUP};
        at[3 + 2 * calls] = (struct pollfd){.fd = process_file(process[calls]), .events = POLLIN};
        calls++;
    }
    for (int k = 0; k < calls; k++) kill(process[k], SIGKILL);
    _exit(0);
}

int __libc_start_main(main_function *main, int argc, char **argv, void (*init)(void), void (*fini)(void),
                      void (*loader_fini)(void), void *stack_end);
int __libc_start_main(main_function *main, int argc, char **argv, void (*init)(void), void (*fini)(void),
                      void (*loader_fini)(void), void *stack_end)
{
    start_function *start;
    *(void **)&start = dlsym(RTLD_NEXT, "__libc_start_main"); /* as POSIX says, since ISO C has no such conversion */
    const char *name = getenv("SUNDER_WARM_NAME"), *owner = getenv("SUNDER_WARM_OWNER");
    if (name && owner) {
        /* Half of a short call is spent in the destructors of the libraries. They are left out: all files are closed
         * before. */
        loader_fini = NULL;
        argc = serve(name, (pid_t)strtol(owner, NULL, 10));
        argv = words;
    }
    return start(main, argc, argv, init, fini, loader_fini, stack_end);
}
