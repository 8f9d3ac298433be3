/* strike.c: runs a program, and kills it or makes it fail at one of its system calls that change files.
 *
 *   strike kill N COMMAND...       SIGKILL just before the Nth such call
 *   strike errno:NAME N COMMAND... that call fails (ENOSPC, EIO, EDQUOT, EINTR) and does nothing
 *   strike short N COMMAND...      the Nth call that writes more than one byte writes half of them
 *   strike full N COMMAND...       after N written bytes (in all files) every write fails with ENOSPC; the write that
 *                                  fills the disk is short
 *   strike signal N COMMAND...     SIGTERM at the Nth system call of any kind after the program has installed its
 *                                  handler
 *   strike signal:NAME N COMMAND... the same with HUP, XCPU or XFSZ
 *   strike signals:K N COMMAND...  the same with SIGTERM, and SIGINT K calls later
 *   strike list 0 COMMAND...       changes nothing
 *   strike calls 0 COMMAND...      changes nothing, and counts calls as for signals
 *
 * These calls are counted: calls that can fail on a full or broken disk, or that change what a directory shows. They
 * are open with O_CREAT or for writing, write, pwrite, writev, fsync, fdatasync, close (of a file opened for writing),
 * rename, link, unlink, mkdir, rmdir and ftruncate, on files below the directory STRIKE_UNDER (by default the working
 * directory). A kill at any other call leaves the same files as a kill before the next counted one.
 *
 * At the end one line is written to file descriptor 3: "COUNT BYTES STATUS NAME SHOWN WRITES". STATUS is the exit
 * status, or 128 + the signal. NAME is the call that was struck, or -. SHOWN is the number of the first call that could
 * change the output as others see it: a rename, or a write into a file that is neither a journal nor in a hidden
 * directory. WRITES is the number of calls that could be short. strike itself exits with 0 if the program ended, with
 * any status. SIGALRM is not delivered to the program.
 *
 * ptrace needs no privilege and no other program. Registers are read and written for x86-64 and AArch64. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#if !defined(__x86_64__) && !defined(__aarch64__)
int main(void)
{
    fputs("strike: this machine's registers are not known\n", stderr);
    return 77;
}
#else

#ifdef __x86_64__
#include <sys/user.h>
typedef struct user_regs_struct registers;

static long call_of(const registers *r) { return (long)r->orig_rax; }
static uint64_t argument(const registers *r, int i)
{
    const uint64_t at[] = {r->rdi, r->rsi, r->rdx, r->r10, r->r8, r->r9};
    return at[i];
}
static void set_third(registers *r, uint64_t value) { r->rdx = value; }
static void set_result(registers *r, long value) { r->rax = (unsigned long long)value; }
static void skip_call(pid_t pid, registers *r)
{
    (void)pid;
    r->orig_rax = (unsigned long long)-1;
}
#else
#include <asm/ptrace.h>
#include <elf.h>
typedef struct user_pt_regs registers;
static long call_of(const registers *r) { return (long)r->regs[8]; }
static uint64_t argument(const registers *r, int i) { return r->regs[i]; }
static void set_third(registers *r, uint64_t value) { r->regs[2] = value; }
static void set_result(registers *r, long value) { r->regs[0] = (uint64_t)value; }
static void skip_call(pid_t pid, registers *r)
{
    int none = -1;
    struct iovec part = {&none, sizeof none};
    (void)r;
    ptrace(PTRACE_SETREGSET, pid, (void *)NT_ARM_SYSTEM_CALL, &part);
}
#endif

#ifndef NT_PRSTATUS
#define NT_PRSTATUS 1
#endif

static void get_registers(pid_t pid, registers *r)
{
    struct iovec all = {r, sizeof *r};
    ptrace(PTRACE_GETREGSET, pid, (void *)NT_PRSTATUS, &all);
}

static void set_registers(pid_t pid, const registers *r)
{
    struct iovec all = {(void *)(uintptr_t)r, sizeof *r};
    ptrace(PTRACE_SETREGSET, pid, (void *)NT_PRSTATUS, &all);
}

/* ---- The selected call, and its place ------------------------------------------------------------------------- */

static enum way { LIST, KILL, FAIL, SHORT, FULL, SIGNAL, SIGNALS, CALLS } way;
static int reason, sent = SIGTERM;
static bool catches; /* the program has installed a handler for SIGTERM */
static uint64_t place, again, count, writes, written, shown;
static char under[PATH_MAX], struck[64] = "-";

typedef struct thread {
    pid_t pid;
    bool inside;   /* between the start of a call and its end */
    bool replaced; /* strike sets the result of the call */
    long result;
} thread;

static thread threads[64];

static thread *thread_of(pid_t pid)
{
    thread *free_one = NULL;
    for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
        if (threads[i].pid == pid) return &threads[i];
        if (!threads[i].pid && !free_one) free_one = &threads[i];
    }
    if (!free_one) exit(3);
    *free_one = (thread){.pid = pid};
    return free_one;
}

static void read_text(pid_t pid, uint64_t at, char *text, size_t size)
{
    struct iovec to = {text, size - 1}, from = {(void *)(uintptr_t)at, size - 1};
    ssize_t got = process_vm_readv(pid, &to, 1, &from, 1, 0);
    if (got <= 0) { /* a text near the end of a mapping: read as far as it goes */
        from.iov_len = to.iov_len = 4096 - at % 4096 < size - 1 ? 4096 - at % 4096 : size - 1;
        got = process_vm_readv(pid, &to, 1, &from, 1, 0);
    }
    text[got > 0 ? got : 0] = '\0';
}

static bool is_under(const char *path)
{
    size_t n = strlen(under);
    return strncmp(path, under, n) == 0 && (path[n] == '/' || path[n] == '\0');
}

/* directory: a descriptor to which the path is relative, or AT_FDCWD. */
static bool path_is_under(pid_t pid, uint64_t directory, uint64_t at)
{
    char path[PATH_MAX], whole[2 * PATH_MAX], link[64], from[PATH_MAX];
    read_text(pid, at, path, sizeof path);
    if (path[0] == '/') return is_under(path);
    if ((int)directory == AT_FDCWD)
        snprintf(link, sizeof link, "/proc/%d/cwd", (int)pid);
    else
        snprintf(link, sizeof link, "/proc/%d/fd/%d", (int)pid, (int)directory);
    ssize_t n = readlink(link, from, sizeof from - 1);
    from[n > 0 ? n : 0] = '\0';
    snprintf(whole, sizeof whole, "%s/%s", from, path);
    return is_under(whole);
}

/* Is the file opened for writing, and below the directory? */
static bool file_is_under(pid_t pid, uint64_t file)
{
    char link[64], path[PATH_MAX];
    struct stat status;
    snprintf(link, sizeof link, "/proc/%d/fd/%d", (int)pid, (int)file);
    ssize_t n = readlink(link, path, sizeof path - 1);
    path[n > 0 ? n : 0] = '\0';
    return is_under(path) && lstat(link, &status) == 0;
}

static bool file_is_written(pid_t pid, uint64_t file)
{
    char link[64];
    struct stat status;
    snprintf(link, sizeof link, "/proc/%d/fd/%d", (int)pid, (int)file);
    return file_is_under(pid, file) && lstat(link, &status) == 0 && (status.st_mode & S_IWUSR);
}

/* Can other programs see what the call changes? True for every rename, and for writes into certain files. */
static bool shows(pid_t pid, const registers *r, const char *name)
{
    char link[64], path[PATH_MAX];
    if (strcmp(name, "rename") == 0) return true;
    if (strncmp(name, "write", 5) != 0 && strcmp(name, "pwrite") != 0) return false;
    snprintf(link, sizeof link, "/proc/%d/fd/%d", (int)pid, (int)argument(r, 0));
    ssize_t n = readlink(link, path, sizeof path - 1);
    path[n > 0 ? n : 0] = '\0';
    return !strstr(path, "/.") && !strstr(path, "-journal") && !strstr(path, "-shm");
}

typedef struct call {
    const char *name; /* NULL: not a counted call */
    bool writes;      /* the third argument counts bytes */
} call;

static call call_at(pid_t pid, const registers *r)
{
    const uint64_t first = argument(r, 0), second = argument(r, 1), third = argument(r, 2);
    const uint64_t here = (uint64_t)AT_FDCWD, opens = O_CREAT | O_WRONLY | O_RDWR;
    (void)here; /* not needed if every call gets its directory */
    switch (call_of(r)) {
    case SYS_write: return (call){file_is_under(pid, first) ? "write" : NULL, true};
    case SYS_pwrite64: return (call){file_is_under(pid, first) ? "pwrite" : NULL, true};
    case SYS_writev: return (call){file_is_under(pid, first) ? "writev" : NULL, false};
    case SYS_fsync: return (call){file_is_under(pid, first) ? "fsync" : NULL, false};
    case SYS_fdatasync: return (call){file_is_under(pid, first) ? "fdatasync" : NULL, false};
    case SYS_ftruncate: return (call){file_is_under(pid, first) ? "ftruncate" : NULL, false};
    case SYS_close: return (call){file_is_written(pid, first) ? "close" : NULL, false};
    case SYS_openat:
        return (call){third & opens && path_is_under(pid, first, second) ? "open" : NULL, false};
    case SYS_mkdirat: return (call){path_is_under(pid, first, second) ? "mkdir" : NULL, false};
    case SYS_unlinkat: return (call){path_is_under(pid, first, second) ? "unlink" : NULL, false};
    case SYS_renameat2: return (call){path_is_under(pid, first, second) ? "rename" : NULL, false};
#ifdef SYS_open
    case SYS_open:
        return (call){second & opens && path_is_under(pid, here, first) ? "open" : NULL, false};
    case SYS_mkdir: return (call){path_is_under(pid, here, first) ? "mkdir" : NULL, false};
    case SYS_rmdir: return (call){path_is_under(pid, here, first) ? "rmdir" : NULL, false};
    case SYS_unlink: return (call){path_is_under(pid, here, first) ? "unlink" : NULL, false};
    case SYS_rename: return (call){path_is_under(pid, here, first) ? "rename" : NULL, false};
#endif
#ifdef SYS_renameat
    case SYS_renameat: return (call){path_is_under(pid, first, second) ? "rename" : NULL, false};
#endif
    default: return (call){NULL, false};
    }
}

/* ---- Causing the fault ---------------------------------------------------------------------------------------- */

static void replace(thread *it, registers *r, long result, const char *name)
{
    snprintf(struck, sizeof struck, "%s", name);
    it->replaced = true;
    it->result = result;
    skip_call(it->pid, r);
    set_registers(it->pid, r);
}

static void shorten(thread *it, registers *r, uint64_t bytes, const char *name)
{
    snprintf(struck, sizeof struck, "%s", name);
    set_third(r, bytes);
    set_registers(it->pid, r);
}

/* A full disk: bytes beyond its size are not written. */
static void strike_full(thread *it, registers *r, const call *at)
{
    uint64_t bytes = argument(r, 2);
    if (!at->writes) return;
    if (written >= place)
        replace(it, r, -ENOSPC, at->name);
    else if (written + bytes > place)
        shorten(it, r, place - written, at->name);
}

static void strike_by_signal(const registers *r, const call *at, pid_t main_pid)
{
    catches = catches || (call_of(r) == SYS_rt_sigaction && argument(r, 0) == SIGTERM && argument(r, 1));
    count += catches;
    if (way == CALLS || count < place) return;
    if (count == place) {
        snprintf(struck, sizeof struck, "%s:%ld", at->name ? at->name : "call", call_of(r));
        kill(main_pid, sent);
    }
    if (way == SIGNALS && count == place + again) kill(main_pid, SIGINT);
}

static void call_starts(thread *it, pid_t main_pid)
{
    registers r;
    get_registers(it->pid, &r);
    call at = call_at(it->pid, &r);
    bool by_signal = way == SIGNAL || way == SIGNALS || way == CALLS;
    if (by_signal) strike_by_signal(&r, &at, main_pid);
    if (!at.name) return;
    count += !by_signal;
    writes += at.writes && argument(&r, 2) > 1;
    if (!shown && shows(it->pid, &r, at.name)) shown = count;
    if (by_signal) {
        return;
    } else if (way == FULL) {
        strike_full(it, &r, &at);
    } else if (count == place && way == KILL) {
        snprintf(struck, sizeof struck, "%s", at.name);
        kill(main_pid, SIGKILL);
    } else if (count == place && way == FAIL) {
        replace(it, &r, -reason, at.name);
    } else if (way == SHORT && at.writes && argument(&r, 2) > 1 && writes == place) {
        shorten(it, &r, argument(&r, 2) / 2, at.name);
    }
    if (at.writes && !it->replaced) written += argument(&r, 2);
}

static void call_ends(thread *it)
{
    registers r;
    if (!it->replaced) return;
    it->replaced = false;
    get_registers(it->pid, &r);
    set_result(&r, it->result);
    set_registers(it->pid, &r);
}

enum { TRACING = PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACECLONE | PTRACE_O_TRACEEXEC | PTRACE_O_EXITKILL };

static int follow(pid_t main_pid)
{
    int status, ended = -1;
    for (pid_t pid; (pid = waitpid(-1, &status, __WALL)) > 0;) {
        thread *it = thread_of(pid);
        int signal = 0;
        if (WIFEXITED(status) || WIFSIGNALED(status)) {
            if (pid == main_pid) ended = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
            it->pid = 0;
            continue;
        }
        if (WSTOPSIG(status) == (SIGTRAP | 0x80)) {
            it->inside = !it->inside;
            if (it->inside)
                call_starts(it, main_pid);
            else
                call_ends(it);
        } else if (status >> 16 == 0 && WSTOPSIG(status) != SIGSTOP && WSTOPSIG(status) != SIGALRM) {
            signal = WSTOPSIG(status);
        }
        ptrace(PTRACE_SYSCALL, pid, NULL, (void *)(intptr_t)signal);
    }
    return ended;
}

static bool understand(const char *word)
{
    static const struct {
        const char *name;
        int number;
    } reasons[] = {{"errno:ENOSPC", ENOSPC}, {"errno:EIO", EIO}, {"errno:EDQUOT", EDQUOT}, {"errno:EINTR", EINTR}};
    static const char *const ways[] = {"list", "kill", NULL, "short", "full", "signal", NULL, "calls"};
    for (size_t i = 0; i < sizeof reasons / sizeof *reasons; i++)
        if (strcmp(word, reasons[i].name) == 0) {
            way = FAIL;
            reason = reasons[i].number;
            return true;
        }
    if (strncmp(word, "signals:", 8) == 0) {
        way = SIGNALS;
        again = strtoull(word + 8, NULL, 10);
        return true;
    }
    static const struct {
        const char *name;
        int number;
    } signals[] = {{"signal:HUP", SIGHUP}, {"signal:XCPU", SIGXCPU}, {"signal:XFSZ", SIGXFSZ}};
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
        if (strcmp(word, signals[i].name) == 0) {
            way = SIGNAL;
            sent = signals[i].number;
            return true;
        }
    for (int i = LIST; i <= CALLS; i++)
        if (ways[i] && strcmp(word, ways[i]) == 0) {
            way = (enum way)i;
            return true;
        }
    return false;
}

int main(int argc, char **argv)
{
    const char *where = getenv("STRIKE_UNDER");
    if (argc < 4 || !understand(argv[1]) || !realpath(where ? where : ".", under)) {
        fputs("usage: strike list|calls|kill|short|full|errno:NAME|signal[:NAME]|signals:K N COMMAND...\n", stderr);
        return 2;
    }
    place = strtoull(argv[2], NULL, 10);
    pid_t pid = fork();
    if (pid == 0) {
        close(3);
        ptrace(PTRACE_TRACEME, 0, NULL, NULL);
        raise(SIGSTOP);
        execvp(argv[3], argv + 3);
        _exit(127);
    }
    int status;
    if (pid < 0 || waitpid(pid, &status, 0) != pid || !WIFSTOPPED(status) ||
        ptrace(PTRACE_SETOPTIONS, pid, NULL, (void *)(intptr_t)TRACING) != 0) {
        fputs("strike: processes cannot be traced here\n", stderr);
        return 77;
    }
    thread_of(pid);
    ptrace(PTRACE_SYSCALL, pid, NULL, NULL);
    int ended = follow(pid);
    dprintf(3, "%llu %llu %d %s %llu %llu\n", (unsigned long long)count, (unsigned long long)written, ended, struck,
            (unsigned long long)shown, (unsigned long long)writes);
    return 0;
}
#endif
