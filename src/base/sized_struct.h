/* sized_struct.h: structs that grow between versions: they begin with their size, or come with it, so that callers and
 * the library may have different versions. Members that both know are copied, and members that one of them does not
 * know have their defaults. */
#ifndef SUNDER_I_SIZED_STRUCT_H
#define SUNDER_I_SIZED_STRUCT_H

#include "sunder_base.h"

/* Writes `own`, with own_size bytes, to the caller's struct of `size` bytes: as much as fits, and zeros after it. */
void sunder_i_sized_struct_write(void *given, size_t size, const void *own, size_t own_size);
/* The same for a struct that begins with its size. */
void sunder_i_options_write(void *given, size_t size, const void *own, size_t own_size);

/* Reads the caller's options, which begin with their size, over the defaults in `own`; given == NULL: the defaults
 * remain. Fails with SUNDER_EARG if the size is no multiple of that of size_t, 0 or above SUNDER_OPTIONS_MAX; or if a
 * byte beyond own_size is not 0, since it sets an option that this version does not know. */
sunder_status sunder_i_options_read(void *own, size_t own_size, const void *given, sunder_error *err);

/* True if there is no padding after the struct's last member, so that an additional member makes the struct larger. */
#define SUNDER_I_ENDS_WITH(type, last) (offsetof(type, last) + sizeof(((type *)0)->last) == sizeof(type))

#endif
