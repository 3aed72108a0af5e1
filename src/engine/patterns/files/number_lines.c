/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads files of lines of whole numbers with comments after a #: the output.txt of LatNet Builder, which has a
 * heading among its first comments; files of the collection LDData, whose first line names their kind; and the file
 * of Joe & Kuo 2008, which begins with a header of words. The first two formats are from L'Ecuyer, Marion, Godin &
 * Puchhammer 2022. The whole file is read at once, but a line is parsed only when it is requested, so that unused
 * dimensions cost little.
 */
#include "patterns/files/files.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/files.h"
#include "core/status.h"

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Looks for the heading "# Parameters ..." of LatNet Builder's output among the comments at the start of the file. */
static bool find_heading(koksma__number_lines *lines)
{
    static const struct {
        const char *heading, *kind;
    } headings[] = {{"# Parameters for a lattice rule", "lattice"},
                    {"# Parameters for a polynomial lattice rule in base ", "plattice"},
                    {"# Parameters for a digital net in base ", "dnet"},
                    {"# Parameters for Sobol points, in JK format", "soboljk"},
                    {"# Parameters m_{j", "sobol"}};
    for (const char *s = lines->text; *s == '#'; s += *s == '\n') {
        for (size_t i = 0; i < sizeof headings / sizeof *headings; i++) {
            const size_t length = strlen(headings[i].heading);
            if (!strncmp(s, headings[i].heading, length)) {
                const char *base = s + length;
                snprintf(lines->kind, sizeof lines->kind, "%s", headings[i].kind);
                lines->base = base[-1] == ' ' && *base >= '0' && *base <= '9' ? strtoull(base, NULL, 10) : 2;
                return true;
            }
        }
        s += strcspn(s, "\n");
    }
    return false;
}

/* Sets lines->kind: by the heading of LatNet Builder's output; if the first line is another comment, to its first word;
   if it is Joe & Kuo's header, to "soboljk", and skips the header. */
static void find_kind(koksma__number_lines *lines)
{
    if (find_heading(lines)) {
        return;
    }
    const char *s = lines->text + strspn(lines->text, " \t");
    if (*s == '#') {
        s += 1 + strspn(s + 1, " \t");
        const size_t length = strcspn(s, " \t\r\n");
        snprintf(lines->kind, sizeof lines->kind, "%.*s", length < sizeof lines->kind ? (int)length : 0, s);
    } else if (*s == 'd' && is_blank(s[1])) {
        snprintf(lines->kind, sizeof lines->kind, "soboljk");
        lines->at += strcspn(lines->at, "\n");
        lines->at += *lines->at == '\n';
        lines->number = 1;
    }
}

koksma_status koksma__number_lines_open(const char *pattern, const char *path, koksma__number_lines *lines)
{
    unsigned char *bytes;
    size_t size;
    *lines = (koksma__number_lines){0};
    snprintf(lines->name, sizeof lines->name, "%s:%s", pattern, path);
    KOKSMA__TRY(koksma__read_file(path, KOKSMA__FILE_PARAMETERS, KOKSMA__BY_FILE, koksma__check_text, &bytes, &size));
    lines->text = lines->at = (char *)bytes;
    if (memchr(bytes, 0, size)) {
        koksma__number_lines_close(lines);
        return koksma__fail(KOKSMA_MALFORMED, "%s: not a text file: it contains a zero byte", lines->name);
    }
    find_kind(lines);
    return KOKSMA_OK;
}

void koksma__number_lines_close(koksma__number_lines *lines)
{
    free(lines->text);
    lines->text = lines->at = NULL;
}

/* Parses the numbers of the line from `at` to `end`. */
static koksma_status split(const koksma__number_lines *lines, char *at, const char *end, size_t most,
                           uint64_t *numbers, size_t *count)
{
    while (at < end && (is_blank(*at) || *at == ',')) {
        at++;
    }
    while (at < end && *at != '#') {
        char *after = at;
        errno = 0;
        const unsigned long long value = *at >= '0' && *at <= '9' ? strtoull(at, &after, 10) : 0;
        const bool whole =
            after > at && !errno && (after == end || is_blank(*after) || *after == ',' || *after == '#');
        const size_t word = strcspn(at, " \t\r\n,");
        KOKSMA__FAIL_IF(!whole, KOKSMA_MALFORMED, "%s: line %zu: '%.*s' is not a whole number below 2^64",
                        lines->name, lines->number, (int)(word < 24 ? word : 24), at);
        KOKSMA__FAIL_IF(*count == most, KOKSMA_MALFORMED, "%s: line %zu: more than %zu numbers", lines->name,
                        lines->number, most);
        numbers[(*count)++] = value;
        for (at = after; at < end && (is_blank(*at) || *at == ',');) {
            at++;
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__number_lines_next(koksma__number_lines *lines, size_t most, uint64_t *numbers, size_t *count)
{
    koksma_status status = KOKSMA_OK;
    *count = 0;
    while (!status && !*count && *lines->at) {
        char *const at = lines->at, *const end = at + strcspn(at, "\n");
        lines->at = end + (*end == '\n');
        lines->number++;
        status = split(lines, at, end, most, numbers, count);
    }
    return status;
}

koksma_status koksma__number_lines_take(koksma__number_lines *lines, const char *what, size_t needed,
                                        uint64_t *numbers)
{
    size_t count;
    KOKSMA__TRY(koksma__number_lines_next(lines, needed, numbers, &count));
    if (count == needed) {
        return KOKSMA_OK;
    }
    return count ? koksma__fail(KOKSMA_MALFORMED, "%s: line %zu: only %zu of the %zu numbers of %s", lines->name,
                                lines->number, count, needed, what)
                 : koksma__fail(KOKSMA_MALFORMED, "%s: it ends before %s", lines->name, what);
}

koksma_status koksma__number_lines_dims(const koksma__number_lines *lines, uint64_t dims, int wanted)
{
    KOKSMA__FAIL_IF(dims < (uint64_t)wanted, KOKSMA_DIM, "%s: it has %llu dimensions, not %d", lines->name,
                    (unsigned long long)dims, wanted);
    return KOKSMA_OK;
}
