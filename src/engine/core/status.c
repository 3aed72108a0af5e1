/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Statuses, and the text of the last error of each thread. The text has a fixed buffer, so that running out of memory
 * can be reported.
 */
#include "core/status.h"
#include "core/c_locale.h"

#include <stdarg.h>
#include <string.h>

enum { TEXT_SIZE = 1024, FULL_SIZE = 8 * TEXT_SIZE };

static _Thread_local char error_text[TEXT_SIZE];
static _Thread_local bool refused;

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

size_t koksma__utf8_length(const unsigned char *text)
{
    const unsigned char c = text[0];
    const size_t length = c < 0x80                ? 1
                          : c >= 0xc2 && c < 0xe0 ? 2
                          : c >= 0xe0 && c < 0xf0 ? 3
                          : c >= 0xf0 && c < 0xf5 ? 4
                                                  : 0;
    for (size_t i = 1; i < length; i++) {
        if ((text[i] & 0xc0) != 0x80) {
            return 0;
        }
    }
    const bool overlong = (c == 0xe0 && text[1] < 0xa0) || (c == 0xf0 && text[1] < 0x90);
    const bool no_character = (c == 0xed && text[1] > 0x9f) || (c == 0xf4 && text[1] > 0x8f);
    return overlong || no_character ? 0 : length;
}

/* The number of bytes of the character at `text` that stays as it is; 0: its first byte is escaped. Control characters
   are escaped, including U+0080 to U+009F, because terminals would execute them. */
static size_t kept_length(const unsigned char *text)
{
    const bool control = text[0] < 0x20 || text[0] == 0x7f || (text[0] == 0xc2 && text[1] < 0xa0);
    return control ? 0 : koksma__utf8_length(text);
}

/* As kept_length(), for the character that ends before text + end. A first byte of a character is never a later byte of
   another one, so that the characters are the same in both directions. */
static size_t kept_length_before(const unsigned char *text, size_t end)
{
    size_t length = 1;
    while (length < 4 && length < end && (text[end - length] & 0xc0) == 0x80) {
        length++;
    }
    return kept_length(text + end - length) == length ? length : 0;
}

/* The text is written from its end, so that each byte is moved once. */
void koksma_text_escape(char *text, size_t size)
{
    static const char hex[] = "0123456789abcdef";
    unsigned char *bytes = (unsigned char *)text;
    size_t from = 0, to = 0;
    if (!text || !size) {
        return;
    }
    while (bytes[from]) {
        const size_t kept = kept_length(bytes + from);
        if (to + (kept ? kept : 4) >= size) {
            break;
        }
        to += kept ? kept : 4;
        from += kept ? kept : 1;
    }
    bytes[to] = '\0';
    while (to > from) {
        const unsigned char c = bytes[from - 1];
        const size_t kept = kept_length_before(bytes, from);
        to -= kept ? kept : 4;
        from -= kept ? kept : 1;
        if (kept) {
            memmove(bytes + to, bytes + from, kept);
        } else {
            memcpy(bytes + to, (const char[]){'\\', 'x', hex[c >> 4], hex[c & 15]}, 4);
        }
    }
}

/* Copies a line of UTF-8 to error_text. Of one that is too long the first and the last characters are kept, because the
   reason comes after the name, and "..." is between them. */
static void keep(const char *text)
{
    static const char gap[] = "...";
    const size_t length = strlen(text), half = (TEXT_SIZE - sizeof gap) / 2;
    if (length < TEXT_SIZE) {
        memcpy(error_text, text, length + 1);
        return;
    }
    size_t head = half, tail = length - half;
    while (((unsigned char)text[head] & 0xc0) == 0x80) {
        head--;
    }
    while (((unsigned char)text[tail] & 0xc0) == 0x80) {
        tail++;
    }
    memcpy(error_text, text, head);
    memcpy(error_text + head, gap, sizeof gap - 1);
    memcpy(error_text + head + sizeof gap - 1, text + tail, length + 1 - tail);
}

koksma_status koksma__fail(koksma_status status, const char *format, ...)
{
    char text[FULL_SIZE]; /* not error_text itself, because arguments may point into that */
    va_list arguments;
    va_start(arguments, format);
    koksma__vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    koksma_text_escape(text, sizeof text);
    keep(text);
    refused = false;
    return status;
}

koksma_status koksma__refused(koksma_status status)
{
    refused = true;
    return status;
}

bool koksma__is_refused(void)
{
    return refused;
}

koksma_status koksma__fail_memory(size_t bytes)
{
    return koksma__fail(KOKSMA_MEMORY, "out of memory: %zu bytes could not be allocated", bytes);
}

char koksma__call_begin(void)
{
    const char kept = error_text[0];
    error_text[0] = '\0';
    return kept;
}

koksma_status koksma__call_end(char kept, koksma_status status, const char *function)
{
    if (!status) {
        error_text[0] = error_text[0] ? error_text[0] : kept;
        return KOKSMA_OK;
    }
    KOKSMA__FAIL_IF((int)status < 0 || status >= KOKSMA_STATUS_COUNT, KOKSMA_ARGUMENT,
                    "%s returned %d, which is not a koksma_status", function, (int)status);
    return error_text[0] ? status : koksma__fail(status, "%s failed: %s", function, koksma_status_text(status));
}

koksma_status koksma__fail_in(koksma_status status, const char *name)
{
    const bool was_refused = refused;
    koksma__fail(status, "%s: %s", name, error_text);
    refused = was_refused;
    return status;
}

bool koksma__missing(const char *function, const char *names, const void *const *pointers, size_t n)
{
    size_t first = 0;
    while (first < n && pointers[first]) {
        first++;
    }
    if (first == n) {
        return false;
    }
    for (size_t i = 0; i < first; i++) {
        names += strcspn(names, ",") + 1;
    }
    names += strspn(names, " ");
    koksma__fail(KOKSMA_ARGUMENT, "%s: %.*s is NULL", function, (int)strcspn(names, ","), names);
    return true;
}

koksma_status koksma__array_check(const char *what, const void *array, size_t n, size_t bytes)
{
    KOKSMA__FAIL_IF(!array && n, KOKSMA_ARGUMENT, "%s is NULL, although n = %zu", what, n);
    return n <= PTRDIFF_MAX / bytes
               ? KOKSMA_OK
               : koksma__fail(KOKSMA_ARGUMENT, "%s: n = %zu is more than memory can hold", what, n);
}

koksma_status koksma__run_check(const char *function, const koksma_run *run)
{
    KOKSMA__FAIL_IF(run && run->threads < 0, KOKSMA_ARGUMENT,
                    "%s: run->threads = %d: it takes 0 (all processors) or a positive number", function,
                    run->threads);
    KOKSMA__FAIL_IF(run && !(run->time_limit_s >= 0), KOKSMA_ARGUMENT,
                    "%s: run->time_limit_s = %g: it takes 0 (no limit) or a positive number of seconds", function,
                    run->time_limit_s);
    return KOKSMA_OK;
}
