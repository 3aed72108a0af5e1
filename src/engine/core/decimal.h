/* SPDX-License-Identifier: Apache-2.0 */
/* Converts decimal numbers to doubles and back with correct rounding, without libc in the common cases. */
#ifndef KOKSMA_CORE_DECIMAL_H
#define KOKSMA_CORE_DECIMAL_H

#include <stdbool.h>
#include <stddef.h>

/* Reads a number as strtod does if it is only digits and at most one point, with at most 19 digits without leading
   zeros and at most 27 digits after the point. Returns false for any other number, which the caller leaves to strtod.
   *end: the first character after the number. */
bool koksma__decimal_read(const char *text, char **end, double *out);

enum { KOKSMA__DECIMAL_ROOM = 32 };

/* Writes x as "%.17g" does in the C locale, without a terminating 0. Returns the number of characters, or 0 where the
   caller has to use printf. */
size_t koksma__decimal_write(double x, char text[KOKSMA__DECIMAL_ROOM]);

#endif
