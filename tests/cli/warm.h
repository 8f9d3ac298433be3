/* warm.h: what the two halves of a warm start send each other (warm.c, warm_server.c). */
#ifndef SUNDER_TEST_WARM_H
#define SUNDER_TEST_WARM_H

#include <signal.h>
#include <stdint.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/un.h>

enum { WARM_FDS = 64 /* files that a call may have open, its folder included */ };

/* A call. Its files are sent along with it, the folder first; then come its arguments and its environment, as texts
 * that each end with a zero. */
typedef struct warm_call {
    uint32_t arguments, variables, bytes, files;
    int32_t number[WARM_FDS]; /* which of its descriptors each file is; the folder has none */
    sigset_t blocked;
    uint64_t ignored; /* a bit for each signal */
    mode_t mask;
} warm_call;

/* The address of the server of a program: an abstract name. Returns its length. */
socklen_t warm_address(struct sockaddr_un *address, const char *name);

#endif
