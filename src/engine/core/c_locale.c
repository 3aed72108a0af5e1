/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Calls strtod and vsnprintf in the locale "C", because the host program may have chosen a decimal comma. uselocale
 * changes the locale only for this thread. The locale object is created once and exists until the process ends.
 */
#include "core/c_locale.h"

#include <locale.h>
#include <pthread.h>
#include <stdlib.h>

#include "core/decimal.h"

static locale_t c_locale;

/* This locale is never freed. glibc and musl create it without allocating memory. If another libc cannot create it,
   uselocale(0) below does not change the caller's locale. */
static void make_c_locale(void)
{
    c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

/* Switches this thread to the "C" locale; returns the locale to restore. */
static locale_t enter(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, make_c_locale);
    return uselocale(c_locale);
}

double koksma__strtod(const char *text, char **end)
{
    double quick;
    char *stop;
    if (koksma__decimal_read(text, &stop, &quick)) {
        if (end) {
            *end = stop;
        }
        return quick;
    }
    const locale_t before = enter();
    const double value = strtod(text, end);
    uselocale(before);
    return value;
}

float koksma__strtof(const char *text, char **end)
{
    const locale_t before = enter();
    const float value = strtof(text, end);
    uselocale(before);
    return value;
}

int koksma__vsnprintf(char *text, size_t size, const char *format, va_list arguments)
{
    const locale_t before = enter();
    const int length = vsnprintf(text, size, format, arguments);
    uselocale(before);
    return length;
}

int koksma__snprintf(char *text, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = koksma__vsnprintf(text, size, format, arguments);
    va_end(arguments);
    return length;
}
