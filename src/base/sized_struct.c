/* sized_struct.c: structs that grow between versions, copied from a caller of another version and back. The rules are
 * those of copy_struct_from_user() in Linux: a shorter struct comes from an older caller, and a longer one is accepted
 * if all bytes that this version does not know are zero. */
#include "base/sized_struct.h"

#include "base/error.h"
#include "sunder_layer.h"
#include "sunder_route.h"
#include "sunder_sum.h"

#include <string.h>

_Static_assert(SUNDER_I_ENDS_WITH(sunder_sum_options, threads), "an added member must not fill padding");
_Static_assert(SUNDER_I_ENDS_WITH(sunder_layer_options, full_gap), "an added member must not fill padding");
_Static_assert(SUNDER_I_ENDS_WITH(sunder_route_options, progress_user), "an added member must not fill padding");
_Static_assert(SUNDER_I_ENDS_WITH(sunder_layer_summary, tight), "an added member must not fill padding");

void sunder_i_sized_struct_write(void *given, size_t size, const void *own, size_t own_size)
{
    const size_t known = size < own_size ? size : own_size;
    memcpy(given, own, known);
    memset((char *)given + known, 0, size - known);
}

void sunder_i_options_write(void *given, size_t size, const void *own, size_t own_size)
{
    if (size < sizeof size) return; /* the struct has no room for the size itself */
    sunder_i_sized_struct_write(given, size, own, own_size);
    memcpy(given, &size, sizeof size);
}

sunder_status sunder_i_options_read(void *own, size_t own_size, const void *given, sunder_error *err)
{
    size_t size;
    if (!given) return SUNDER_OK;
    memcpy(&size, given, sizeof size);
    if (size == 0 || size % sizeof size != 0 || size > SUNDER_OPTIONS_MAX)
        return sunder_i_fail(err, SUNDER_EARG,
                             "the options begin with the size %zu, which no struct of options has: call its _init "
                             "function, or set `size` to sizeof of the struct",
                             size);
    const unsigned char *byte = given;
    for (size_t k = own_size; k < size; k++)
        if (byte[k] != 0)
            return sunder_i_fail(err, SUNDER_EARG,
                                 "the options set something that version %s of the library does not know: they have "
                                 "%zu bytes, of which it knows %zu",
                                 sunder_version(), size, own_size);
    memcpy(own, given, size < own_size ? size : own_size);
    memcpy(own, &own_size, sizeof own_size);
    return SUNDER_OK;
}
