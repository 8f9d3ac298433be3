#define _GNU_SOURCE
#include "warm.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

socklen_t warm_address(struct sockaddr_un *address, const char *name)
{
    const char *owner = getenv("SUNDER_WARM_OWNER");
    *address = (struct sockaddr_un){.sun_family = AF_UNIX};
    const int n = snprintf(address->sun_path + 1, sizeof address->sun_path - 1, "sunder-warm-%u-%s-%s", geteuid(),
                           owner ? owner : "", name);
    return (socklen_t)(offsetof(struct sockaddr_un, sun_path) + 1 + (size_t)n);
}
