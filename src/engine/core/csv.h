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

/* Write a number as a field, which needs no quotes: whole numbers as digits, others as "%.17g" in the C locale, NaN as an
   empty field. `text` has KOKSMA__CSV_NUMBER bytes. They return the number of characters, and write no terminating 0. */
enum { KOKSMA__CSV_NUMBER = 32 };
KOKSMA__LAB size_t koksma__csv_whole(uint64_t number, char text[KOKSMA__CSV_NUMBER]);
KOKSMA__LAB size_t koksma__csv_number(double number, char text[KOKSMA__CSV_NUMBER]);

#endif
