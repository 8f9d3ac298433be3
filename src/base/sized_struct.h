/* Structs that grow: they begin with their size, or come with it, so that callers and the library may be of different
 * versions. What both know is copied, and what one of them does not know has its default. */
#ifndef SUNDER_I_SIZED_STRUCT_H
#define SUNDER_I_SIZED_STRUCT_H

#include "sunder.h"

/* Writes `own`, of own_size bytes, to the caller's struct of `size` bytes: as much as fits, zeros beyond. */
void sunder_i_sized_struct_write(void *given, size_t size, const void *own, size_t own_size);
/* The same to a struct that begins with its size. */
void sunder_i_options_write(void *given, size_t size, const void *own, size_t own_size);

/* Reads the caller's options, which begin with their size, over the defaults in `own`; NULL leaves these.
 * Fails  SUNDER_EARG  the size is no multiple of that of size_t, 0 or above SUNDER_OPTIONS_MAX; or a byte beyond
 *                     own_size is not 0, so that something was asked for that this version cannot do */
sunder_status sunder_i_options_read(void *own, size_t own_size, const void *given, sunder_error *err);

/* True if nothing follows the struct's last member, so that a member which is added grows the struct. */
#define SUNDER_I_ENDS_WITH(type, last) (offsetof(type, last) + sizeof(((type *)0)->last) == sizeof(type))

#endif
