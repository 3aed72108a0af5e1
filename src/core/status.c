/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Statuses and the text of the last error, which each thread has for itself: a fixed buffer, so that running out of
 * memory can be reported.
 */
#include "core/status.h"
#include "core/c_locale.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { TEXT_SIZE = 1024 };

static _Thread_local char error_text[TEXT_SIZE];

static const struct {
    int exit_code;
    const char *text;
} statuses[] = {
#define KOKSMA_STATUS(name, number, exit_code, text) [KOKSMA_##name] = {exit_code, text},
#include <koksma/status.def>
#undef KOKSMA_STATUS
};

_Static_assert(sizeof statuses / sizeof *statuses == KOKSMA_STATUS_COUNT,
               "the numbers of status.def count up from 0");

const char *koksma_status_text(koksma_status status)
{
    return (unsigned)status < KOKSMA_STATUS_COUNT ? statuses[status].text : "unknown status";
}

int koksma_status_exit_code(koksma_status status)
{
    return (unsigned)status < KOKSMA_STATUS_COUNT ? statuses[status].exit_code : 4;
}

const char *koksma_error_text(void)
{
    return error_text;
}

const char *koksma_version(void)
{
    return KOKSMA_VERSION;
}

void koksma__make_printable(char *text)
{
    for (; *text; text++) {
        if ((unsigned char)*text < 0x20 || *text == 0x7f) {
            *text = '?';
        }
    }
}

koksma_status koksma__fail(koksma_status status, const char *format, ...)
{
    char text[TEXT_SIZE]; /* arguments may point into error_text */
    va_list arguments;
    va_start(arguments, format);
    koksma__vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    koksma__make_printable(text);
    memcpy(error_text, text, sizeof text);
    return status;
}

koksma_status koksma__fail_memory(size_t bytes)
{
    return koksma__fail(KOKSMA_MEMORY, "out of memory: %zu bytes could not be had", bytes);
}

koksma_status koksma__fail_in(koksma_status status, const char *name)
{
    return koksma__fail(status, "%s: %s", name, error_text);
}

bool koksma__missing(const char *function, const char *names, const void *const *pointers, size_t n)
{
    for (size_t i = 0; i < n; i++, names += strcspn(names, ",")) {
        names += strspn(names, ", ");
        if (!pointers[i]) {
            koksma__fail(KOKSMA_ARGUMENT, "%s: %.*s is NULL", function, (int)strcspn(names, ","), names);
            return true;
        }
    }
    return false;
}

koksma_status koksma__array_check(const char *what, const void *array, size_t n, size_t bytes)
{
    if (!array && n) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s is NULL, and n = %zu", what, n);
    }
    return n <= PTRDIFF_MAX / bytes ? KOKSMA_OK
                                    : koksma__fail(KOKSMA_ARGUMENT, "%s: n = %zu is more than memory has", what, n);
}

koksma_status koksma__run_check(const char *function, const koksma_run *run)
{
    if (run && run->threads < 0) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: run->threads = %d: it is 0, for all, or more", function,
                            run->threads);
    }
    if (run && !(run->time_limit_s >= 0)) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: run->time_limit_s = %g: it is 0, for none, or a number of seconds",
                            function, run->time_limit_s);
    }
    return KOKSMA_OK;
}
