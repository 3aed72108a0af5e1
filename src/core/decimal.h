/* SPDX-License-Identifier: Apache-2.0 */
/* Decimal numbers to doubles and back, rounded once, without libc where that is quick. */
#ifndef KOKSMA_CORE_DECIMAL_H
#define KOKSMA_CORE_DECIMAL_H

#include <stdbool.h>
#include <stddef.h>

/* Digits with at most one point among them, at most 19 without leading zeros and at most 27 behind the point, as strtod
   reads them; false for any other number, which strtod then takes. *end: behind them. */
bool koksma__decimal_read(const char *text, char **end, double *out);

enum { KOKSMA__DECIMAL_ROOM = 32 };

/* "%.17g" in the C locale, without a 0 at the end; the number of characters, or 0 where printf has to do it. */
size_t koksma__decimal_write(double x, char text[KOKSMA__DECIMAL_ROOM]);

#endif
