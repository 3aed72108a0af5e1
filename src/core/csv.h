/* SPDX-License-Identifier: Apache-2.0 */
/* The one writer of CSV fields (RFC 4180). The stream is of one thread. */
#ifndef KOKSMA_CORE_CSV_H
#define KOKSMA_CORE_CSV_H

#include <stdint.h>
#include <stdio.h>

#include "core/visibility.h"

/* Writes a field: in quotes, which are doubled inside, if it has a comma, a quote or the end of a line. */
KOKSMA__LAB void koksma__csv_put(FILE *stream, const char *text);

/* Numbers, which need no quotes: digits; "%.17g" in the C locale, and nothing for NaN. */
KOKSMA__LAB void koksma__csv_put_whole(FILE *stream, uint64_t number);
KOKSMA__LAB void koksma__csv_put_number(FILE *stream, double number);

#endif
