/* SPDX-License-Identifier: Apache-2.0 */
/* Numbers as text, in the same way under every locale of the host program. After a program in Germany has called
   setlocale(LC_ALL, ""), as Qt and GTK do, the functions of libc write 0,5 and read 0.5 as 0. All conversions of
   numbers with a decimal point use these functions (tests/lint/locale.sh); whole numbers may use the functions of libc.
   The locale is switched for the duration of the call and in its thread only, so that the host program's code never
   runs under a locale that it did not choose. */
#ifndef KOKSMA_CORE_C_LOCALE_H
#define KOKSMA_CORE_C_LOCALE_H

#include <koksma/koksma.h>

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "core/visibility.h"

/* strtod and vsnprintf in the "C" locale. */
KOKSMA__LAB double koksma__strtod(const char *text, char **end);
KOKSMA__LAB float koksma__strtof(const char *text, char **end);
KOKSMA__LAB int koksma__snprintf(char *text, size_t size, const char *format, ...) KOKSMA_PRINTF(3, 4);
KOKSMA__LAB int koksma__vsnprintf(char *text, size_t size, const char *format, va_list arguments) KOKSMA_PRINTF(3, 0);

enum { KOKSMA__DECIMAL_ROOM = 32 };

/* Writes x as "%.17g" does in the C locale, without a terminating 0. Returns the number of characters, or 0 where the
   caller has to use printf. */
size_t koksma__decimal_write(double x, char text[KOKSMA__DECIMAL_ROOM]);

/* ---- CSV (RFC 4180), of which this is the only writer; one thread at a time may use a stream ---- */

/* Writes a field. A field with a comma, a quote or the end of a line is put in quotes, and quotes inside it are
   doubled. A text that a spreadsheet would run as a formula, as it begins with =, +, @, - or a tab, gets an apostrophe
   before it, inside quotes; a lone "-", which stands for nothing, does not. */
KOKSMA__LAB void koksma__csv_put(FILE *stream, const char *text);

/* Write a number as a field, which needs no quotes: whole numbers as digits, others as "%.17g" in the C locale, NaN as an
   empty field. `text` has KOKSMA__CSV_NUMBER bytes. They return the number of characters, and write no terminating 0. */
enum { KOKSMA__CSV_NUMBER = KOKSMA__DECIMAL_ROOM };
KOKSMA__LAB size_t koksma__csv_whole(uint64_t number, char text[KOKSMA__CSV_NUMBER]);
KOKSMA__LAB size_t koksma__csv_number(double number, char text[KOKSMA__CSV_NUMBER]);

#endif
