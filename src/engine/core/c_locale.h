/* SPDX-License-Identifier: Apache-2.0 */
/* Converts between numbers and text in the same way under every locale of the host program. After a program in
   Germany has called setlocale(LC_ALL, ""), as Qt and GTK do, the functions of libc write 0,5 and read 0.5 as 0. All
   conversions of numbers with a decimal point use these functions (tests/lint/locale.sh); whole numbers may use the
   functions of libc. The locale is switched for the duration of the call and in its thread only, so that the host
   program's code never runs under a locale that it did not choose. */
#ifndef KOKSMA_CORE_C_LOCALE_H
#define KOKSMA_CORE_C_LOCALE_H

#include <koksma/koksma.h>

#include <stdarg.h>
#include <stdio.h>

#include "core/visibility.h"

/* strtod and vsnprintf in the "C" locale. */
KOKSMA__LAB double koksma__strtod(const char *text, char **end);
KOKSMA__LAB float koksma__strtof(const char *text, char **end);
KOKSMA__LAB int koksma__snprintf(char *text, size_t size, const char *format, ...) KOKSMA_PRINTF(3, 4);
KOKSMA__LAB int koksma__vsnprintf(char *text, size_t size, const char *format, va_list arguments) KOKSMA_PRINTF(3, 0);

#endif
