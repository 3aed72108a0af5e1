/* SPDX-License-Identifier: Apache-2.0 */
/* The only writer of CSV fields (RFC 4180). One thread at a time may use a stream. */
#ifndef KOKSMA_CORE_CSV_H
#define KOKSMA_CORE_CSV_H

#include <stdint.h>
#include <stdio.h>

#include "core/visibility.h"

/* Writes a field. A field with a comma, a quote or the end of a line is put in quotes, and quotes inside it are
   doubled. */
KOKSMA__LAB void koksma__csv_put(FILE *stream, const char *text);

/* Write numbers, which need no quotes: whole ones as digits, others as "%.17g" in the C locale; NaN is an empty
   field. */
KOKSMA__LAB void koksma__csv_put_whole(FILE *stream, uint64_t number);
KOKSMA__LAB void koksma__csv_put_number(FILE *stream, double number);

#endif
