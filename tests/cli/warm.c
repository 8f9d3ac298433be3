/* warm.c: a start of a program without the time that it takes to load GDAL.
 *
 * The dynamic loader takes 0.1 to 0.2 s of processor time for libgdal and its hundred libraries, longer than most
 * calls of the tests take for their question, and the tests of the command make thousands of calls. This client stands
 * in for sunder, ogr2ogr and ogrinfo: symbolic links with these names lead to it. It asks a process that has loaded the
 * program, but not called its main(), for a fork that does so (warm_server.c), hands over its arguments, environment,
 * folder, open files, umask and signals, and ends as that process ends. The first call starts that process; it ends
 * with the test, whose process is named by SUNDER_WARM_OWNER.
 *
 * What a fork would not share with a process of its own starts the program itself: variables that the loader or the
 * allocator read when they start, another limit, priority or set of processors than the test has, many open files. */
#define _GNU_SOURCE
#include "warm.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static pid_t process;

static void pass_on(int signal) { kill(process, signal); }

/* The program that this client stands in for: the next one of its name in PATH; for sunder that of the build. */
static void find_program(const char *name, char *path, size_t size)
{
    const char *build = getenv("SUNDER_BUILD"), *from = getenv("PATH");
    struct stat self, other;
    if (strcmp(name, "sunder") == 0) from = build;
    if (stat("/proc/self/exe", &self)) from = NULL;
    for (const char *end; from; from = *end ? end + 1 : NULL) {
        end = strchrnul(from, ':');
        snprintf(path, size, "%.*s/%s", (int)(end - from), from, name);
        if (access(path, X_OK) == 0 && stat(path, &other) == 0 && other.st_ino != self.st_ino) return;
    }
    fprintf(stderr, "%s: not found\n", name);
    exit(127);
}

static bool starts(const char *text, const char *with) { return strncmp(text, with, strlen(with)) == 0; }

static bool fork_would_differ(pid_t owner)
{
    const int file = (int)syscall(SYS_pidfd_open, owner, 0); /* the server needs one, too */
    if (file < 0) return true;
    close(file);
    for (char **v = environ; *v; v++)
        if (starts(*v, "LD_") || starts(*v, "MALLOC_") || starts(*v, "GLIBC_TUNABLES")) return true;
    for (unsigned k = 0; k < RLIM_NLIMITS; k++) {
        struct rlimit mine, test;
        if (getrlimit(k, &mine) || prlimit(owner, k, NULL, &test)) return true;
        if (mine.rlim_cur != test.rlim_cur || mine.rlim_max != test.rlim_max) return true;
    }
    cpu_set_t mine, test;
    if (sched_getaffinity(0, sizeof mine, &mine) || sched_getaffinity(owner, sizeof test, &test)) return true;
    return !CPU_EQUAL(&mine, &test) || getpriority(PRIO_PROCESS, 0) != getpriority(PRIO_PROCESS, (id_t)owner);
}

/* Loads the program in a process of its own, which nothing waits for. */
static void start_server(const char *path, const char *name)
{
    const pid_t child = fork();
    if (child > 0) waitpid(child, NULL, 0);
    if (child != 0) return;
    setsid();
    if (fork() != 0) _exit(0);
    char library[4096];
    snprintf(library, sizeof library, "%s/tests/libwarm_server.so", getenv("SUNDER_BUILD"));
    setenv("LD_PRELOAD", library, 1), setenv("LD_BIND_NOW", "1", 1), setenv("SUNDER_WARM_NAME", name, 1);
    const int nothing = open("/dev/null", O_RDWR);
    for (int k = 0; k < 3; k++) dup2(nothing, k);
    for (int k = 3; k < 1024; k++) close(k);
    if (chdir("/") == 0) execl(path, name, (char *)NULL);
    _exit(1);
}

/* A connection to the server; negative: there is none. */
static int connected(const char *path, const char *name)
{
    struct sockaddr_un address;
    const socklen_t length = warm_address(&address, name);
    for (int tries = 0; tries < 1000; tries++) {
        const int server = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
        if (server < 0) return -1;
        if (connect(server, (struct sockaddr *)&address, length) == 0) return server;
        close(server);
        if (tries == 0) start_server(path, name);
        nanosleep(&(struct timespec){.tv_nsec = 10 * 1000 * 1000}, NULL);
    }
    return -1;
}

/* The open files of this process, the folder first; false: too many. */
static bool open_files(warm_call *call, int *file)
{
    DIR *folder = opendir("/proc/self/fd");
    file[0] = open(".", O_PATH | O_DIRECTORY);
    call->files = 1;
    if (!folder || file[0] < 0) return false;
    for (struct dirent *entry; (entry = readdir(folder));) {
        const int number = atoi(entry->d_name);
        if (entry->d_name[0] == '.' || number == dirfd(folder) || number == file[0]) continue;
        if (call->files == WARM_FDS || number >= 256) return false;
        call->number[call->files] = number;
        file[call->files++] = number;
    }
    closedir(folder);
    return true;
}

static bool send_call(int server, warm_call *call, const int *file, char **argv)
{
    size_t bytes = 0;
    for (char **word = argv; *word; word++, call->arguments++) bytes += strlen(*word) + 1;
    for (char **word = environ; *word; word++, call->variables++) bytes += strlen(*word) + 1;
    call->bytes = (uint32_t)bytes;
    union {
        struct cmsghdr header;
        char space[CMSG_SPACE(sizeof(int) * WARM_FDS)];
    } control = {
        .header = {.cmsg_len = CMSG_LEN(sizeof(int) * call->files), .cmsg_level = SOL_SOCKET, .cmsg_type = SCM_RIGHTS}};
    memcpy(CMSG_DATA(&control.header), file, sizeof(int) * call->files);
    struct iovec part = {call, sizeof *call};
    struct msghdr message = {.msg_iov = &part,
                             .msg_iovlen = 1,
                             .msg_control = &control,
                             .msg_controllen = CMSG_SPACE(sizeof(int) * call->files)};
    if (sendmsg(server, &message, MSG_NOSIGNAL) != sizeof *call) return false;
    FILE *texts = fdopen(dup(server), "w");
    if (!texts) return false;
    for (char **word = argv; *word; word++) fwrite(*word, 1, strlen(*word) + 1, texts);
    for (char **word = environ; *word; word++) fwrite(*word, 1, strlen(*word) + 1, texts);
    return fclose(texts) == 0;
}

static void note_signals(warm_call *call)
{
    struct sigaction action;
    sigprocmask(SIG_SETMASK, NULL, &call->blocked);
    for (int k = 1; k < NSIG && k < 64; k++)
        if (sigaction(k, NULL, &action) == 0 && action.sa_handler == SIG_IGN) call->ignored |= UINT64_C(1) << k;
    umask(call->mask = umask(0));
}

static void end_as(int status)
{
    if (!WIFSIGNALED(status)) exit(WEXITSTATUS(status));
    signal(WTERMSIG(status), SIG_DFL);
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    raise(WTERMSIG(status));
    exit(128 + WTERMSIG(status));
}

int main(int argc, char **argv)
{
    (void)argc;
    const char *slash = strrchr(argv[0], '/'), *name = slash ? slash + 1 : argv[0],
               *owner = getenv("SUNDER_WARM_OWNER");
    char path[4096];
    find_program(name, path, sizeof path);
    warm_call call = {0};
    int file[WARM_FDS], status = 0;
    note_signals(&call);
    if (!owner || fork_would_differ((pid_t)atoi(owner)) || !open_files(&call, file)) goto alone;
    const int server = connected(path, name);
    if (server < 0 || recv(server, &process, sizeof process, MSG_WAITALL) != sizeof process) goto alone;
    static const int passed_on[] = {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGCONT};
    for (size_t k = 0; k < sizeof passed_on / sizeof *passed_on; k++)
        if (!(call.ignored >> passed_on[k] & 1)) signal(passed_on[k], pass_on);
    if (!send_call(server, &call, file, argv)) return 127;
    for (uint32_t k = 1; k < call.files; k++)
        close(file[k]); /* a reader of the output sees its end with the program's */
    ssize_t n;
    while ((n = recv(server, &status, sizeof status, MSG_WAITALL)) < 0 && errno == EINTR) {
    }
    if (n == sizeof status) end_as(status);
    return 127;
alone:
    execv(path, argv);
    return 127;
}
