/* SPDX-License-Identifier: Apache-2.0 */
/* Reads the values of options: choices, numbers, sizes and lists. */
#include "cli.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/image.h>
#include <koksma/render.h>

const char *cli_alternatives(const char *argument, char *text, size_t size)
{
    *text = '\0';
    for (const char *at = argument; *at; at += *at == '|') {
        const size_t length = strcspn(at, "|");
        CLI_APPEND(text, size, "%s%.*s", !*text ? "" : at[length] ? ", " : " or ", (int)length, at);
        at += length;
    }
    return text;
}

bool cli_choice(const cli_args *args, const char *name, int *choice)
{
    const char *text = cli_text(args, name, NULL), *at = cli_option_of(args->command->options, name)->argument;
    char all[256], meant[96];
    cli_alternatives(at, all, sizeof all);
    for (int i = 0; text && *at; i++, at += strcspn(at, "|"), at += *at == '|') {
        if (strlen(text) == strcspn(at, "|") && !strncmp(text, at, strlen(text))) {
            *choice = i;
            return true;
        }
    }
    if (text && cli_option_of(args->command->options, text)) {
        cli_error(args, "--%s %s: it takes %s; did you mean --%s?", name, text, all, text);
    } else if (text) {
        cli_error(args, "--%s %s: %sit takes %s", name, text, cli_meant_of(text, all, meant), all);
    }
    return !text;
}

bool cli_refuse(const cli_args *args, const char *names, const char *why, ...)
{
    char name[32], text[256];
    va_list list;
    for (const char *at = names; *at; at += strcspn(at, " "), at += *at == ' ') {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, " "), at);
        if (cli_flag(args, name)) {
            va_start(list, why);
            vsnprintf(text, sizeof text, why, list);
            va_end(list);
            return !cli_error(args, "--%s %s", name, text);
        }
    }
    return true;
}

bool cli_digits(const char *text, uint64_t *out, const char **end)
{
    char *after;
    errno = 0;
    *out = text[0] >= '0' && text[0] <= '9' ? strtoull(text, &after, 10) : 0;
    *end = text[0] >= '0' && text[0] <= '9' ? after : text;
    if (*end != text && **end == 'e' && (*end)[1] >= '0' && (*end)[1] <= '9') {
        const unsigned long zeros = strtoul(*end + 1, &after, 10);
        *end = after;
        for (unsigned long k = 0; k<zeros && * out> 0 && !errno; k++) {
            errno = *out > UINT64_MAX / 10 ? ERANGE : 0;
            *out *= 10;
        }
    }
    return *end != text && !errno;
}

bool cli_is_whole(const cli_args *args, const char *name, const char *text, uint64_t min, uint64_t max, uint64_t *out)
{
    const char *end;
    uint64_t value;
    if (!cli_digits(text, &value, &end) || *end || value < min || value > max) {
        return !cli_error(
            args, "%s%s %s: it takes %s from %llu to %llu", name[1] ? "--" : "-", name, cli_text(args, name, text),
            strchr(cli_text(args, name, text), ',') ? "one whole number, without commas," : "a whole number",
            (unsigned long long)min, (unsigned long long)max);
    }
    *out = value;
    return true;
}

bool cli_whole(const cli_args *args, const char *name, uint64_t fallback, uint64_t min, uint64_t max, uint64_t *out)
{
    const char *text = cli_text(args, name, NULL);
    *out = fallback;
    return !text || cli_is_whole(args, name, text, min, max, out);
}

bool cli_trials(const cli_args *args, uint64_t fallback, uint64_t max, uint64_t *seed, uint64_t *trials)
{
    if (!cli_whole(args, "seed", 0, 0, UINT64_MAX, seed) || !cli_whole(args, "trials", fallback, 1, max, trials)) {
        return false;
    }
    return !cli_text(args, "trials", NULL) || cli_seeds_fit(args, *seed, *trials);
}

bool cli_seeds_fit(const cli_args *args, uint64_t seed, uint64_t trials)
{
    const uint64_t more = trials - 1;
    if (more > UINT64_MAX - seed) {
        return !cli_error(
            args,
            "--seed %llu: %llu trials end at this seed + %llu, but seeds end at %llu; --seed %llu or less would do",
            (unsigned long long)seed, (unsigned long long)trials, (unsigned long long)more,
            (unsigned long long)UINT64_MAX, (unsigned long long)(UINT64_MAX - more));
    }
    return true;
}

bool cli_sizes(const cli_args *args, const char *name, const char *list, const char *also, uint64_t max,
               size_t sizes[KOKSMA_MAX_SIZES], size_t *n)
{
    const char *item = list;
    for (*n = 0; item;) {
        const char *end;
        uint64_t k;
        if (!cli_digits(item, &k, &end) || k == 0 || k > max || (*end && *end != ',') || *n == KOKSMA_MAX_SIZES) {
            return !cli_error(args, "--%s %s: it takes %sup to %d numbers from 1 to %llu, as in 16,64,256", name,
                              list, also, KOKSMA_MAX_SIZES, (unsigned long long)max);
        }
        for (size_t i = 0; i < *n; i++) {
            if (sizes[i] == k) {
                return !cli_error(args, "--%s: %llu is given twice", name, (unsigned long long)k);
            }
        }
        sizes[(*n)++] = k;
        item = *end ? end + 1 : NULL;
    }
    return true;
}

bool cli_size(const cli_args *args, int *width, int *height)
{
    const char *text = cli_text(args, "size", NULL);
    int used = 0;
    if (text && (sscanf(text, "%6dx%6d%n", width, height, &used) != 2 || text[used] || *width < 1 || *height < 1)) {
        return !cli_error(args, "--size %s: it takes WIDTHxHEIGHT, such as 512x384, each 1 to 65536", text);
    }
    if (text && (*width > KOKSMA_MAX_IMAGE_SIDE || *height > KOKSMA_MAX_IMAGE_SIDE ||
                 (size_t)*width * (size_t)*height > KOKSMA_MAX_PIXELS)) {
        return !cli_error(args, "--size %s: each side must be 1 to %d, and the number of pixels at most %zu", text,
                          KOKSMA_MAX_IMAGE_SIDE, (size_t)KOKSMA_MAX_PIXELS);
    }
    return true;
}

bool cli_real(const cli_args *args, const char *name, double fallback, double min, double max, double *out)
{
    const char *text = cli_text(args, name, NULL);
    *out = fallback;
    if (!text) {
        return true;
    }
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end || !(value >= min && value <= max)) {
        char percent[64];
        const bool is_percent = strchr(text, '%') || (max <= 1 && value > 1 && value <= 100);
        snprintf(percent, sizeof percent, "; %.4g %% is %.4g", value, value / 100);
        return !cli_error(args, "--%s %s: it takes a number from %g to %g%s", name, text, min, max,
                          is_percent           ? percent
                          : end > text && *end ? ", without a unit"
                                               : "");
    }
    *out = value;
    return true;
}

size_t cli_reals(const char *list, double min, double max, double *out, size_t most)
{
    char item[64], *end;
    size_t n = 0;
    while (cli_list_item(list, n, item, sizeof item)) {
        const double value = strtod(item, &end);
        if (n == most || end == item || *end || !(value >= min && value <= max)) {
            return 0;
        }
        out[n++] = value;
    }
    return n;
}

static bool is_use(const char *name, size_t length)
{
    size_t i = 0;
    while (koksma_use_at(i) &&
           (strlen(koksma_use_at(i)->name) != length || strncmp(koksma_use_at(i)->name, name, length) != 0)) {
        i++;
    }
    return koksma_use_at(i) != NULL;
}

/* Returns the end of the list item that starts at s. "a:x=1,y=2,b" has the items "a:x=1,y=2" and "b": a comma separates
   parameters of one spec if a ':' is before it in the item and a parameter's "key=" follows. So it ends the item before
   a spec with parameters of its own, "b:x=1", in which the ':' comes before the '='; before patterns joined by '+' or
   ';', if that comes before any '='; and before "USE=PATTERN", because no parameter has the name of a use. */
static const char *item_end(const char *s)
{
    bool has_parameters = false;
    for (;; s++) {
        has_parameters |= *s == ':';
        if (!*s) {
            return s;
        }
        if (*s == ',') {
            const size_t stop = strcspn(s + 1, ",:=+;");
            if (!has_parameters || s[1 + stop] != '=' || is_use(s + 1, stop)) {
                return s;
            }
        }
    }
}

bool cli_list_item(const char *list, size_t i, char *item, size_t size)
{
    const char *start = list;
    for (;; i--) {
        const char *end = item_end(start);
        if (i == 0) {
            snprintf(item, size, "%.*s", (int)(end - start), start);
            return true;
        }
        if (!*end) {
            return false;
        }
        start = end + 1;
    }
}
