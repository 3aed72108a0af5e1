/* SPDX-License-Identifier: Apache-2.0 */
/* Reads the file names of images that another renderer made. A path is matched with a template, in which names in
   braces, such as {spp} and {trial}, stand for digits or text. {spp} and {trial} are numbers; all other names
   together identify the image's group. The matching backtracks, and remembers failures so that its time is
   bounded. */
#include "study/images/images.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"

enum { MAX_PLACES = 16 };

static bool takes_digits(const char *place)
{
    return !strncmp(place, "{spp}", 5) || !strncmp(place, "{trial}", 7);
}

static void keep(koksma__image_name *p, const char *place, const char *text, size_t length)
{
    if (!strncmp(place, "{spp}", 5)) {
        p->spp = strtoll(text, NULL, 10);
    } else if (!strncmp(place, "{trial}", 7)) {
        p->trial = strtoll(text, NULL, 10);
    } else {
        const size_t used = strlen(p->group);
        snprintf(p->group + used, sizeof p->group - used, "%s%.*s=%.*s", used ? " " : "",
                 (int)strcspn(place + 1, "}"), place + 1, (int)length, text);
    }
}

/* The state of a match. A flag in `failed` tells that the rest of the template, from a certain placeholder (a name
   in braces) on, does not match the rest of the path, from a certain position on; it is not tried there twice. */
typedef struct trial_fit {
    const char *path;
    size_t length;
    unsigned char *failed;      /* (MAX_PLACES + 1) x (length + 1) flags */
    size_t lengths[MAX_PLACES]; /* length of the text that matches each placeholder */
} trial_fit;

/* Whether the path from `at` on matches `places`, the rest of the template. For each placeholder longer texts are
   tried first. The depth of recursion is the number of placeholders. */
static bool fit_from(trial_fit *t, const char *places, int place, size_t at)
{
    while (*places && *places != '{') {
        if (*places++ != t->path[at++]) {
            return false;
        }
    }
    if (!*places) {
        return !t->path[at];
    }
    unsigned char *failed = &t->failed[(size_t)place * (t->length + 1) + at];
    const char *path = t->path + at, *after = strchr(places, '}') + 1;
    for (size_t length = takes_digits(places) ? strspn(path, "0123456789") : strcspn(path, "/");
         length > 0 && !*failed; length--) {
        t->lengths[place] = length;
        if (fit_from(t, after, place + 1, at + length)) {
            return true;
        }
    }
    *failed = 1;
    return false;
}

static void keep_all(const trial_fit *t, const char *places, koksma__image_name *out)
{
    const char *path = t->path;
    for (int place = 0; *places; path++) {
        if (*places == '{') {
            keep(out, places, path, t->lengths[place]);
            path += t->lengths[place++] - 1;
            places = strchr(places, '}');
        }
        places++;
    }
}

koksma_status koksma__image_name_read(const char *places, const char *path, koksma__image_name *out, bool *fits)
{
    trial_fit t = {.path = path, .length = strlen(path)};
    *out = (koksma__image_name){0};
    *fits = false;
    t.failed = calloc(MAX_PLACES + 1, t.length + 1);
    KOKSMA__REQUIRE_MEMORY(t.failed, (MAX_PLACES + 1) * (t.length + 1));
    *fits = fit_from(&t, places, 0, 0);
    free(t.failed);
    if (*fits) {
        keep_all(&t, places, out);
    }
    return KOKSMA_OK;
}

/* Makes a pattern for glob(): replaces each placeholder in braces by a star and escapes all other characters. */
koksma_status koksma__image_names_pattern(const char *places, char *pattern, size_t size)
{
    size_t used = 0;
    int n = 0;
    KOKSMA__FAIL_IF(2 * strlen(places) + 4 > size, KOKSMA_ARGUMENT, "the path is longer than %zu characters",
                    size / 2);
    for (const char *at = places; *at; at++) {
        if (*at == '{') {
            const char *inner = strpbrk(at + 1, "{}");
            at = inner && *inner == '}' ? inner : NULL;
            KOKSMA__FAIL_IF(++n > MAX_PLACES, KOKSMA_ARGUMENT, "'%s': more than %d places", places, MAX_PLACES);
            KOKSMA__FAIL_IF(!at, KOKSMA_ARGUMENT, "'%s': a brace is not closed", places);
            pattern[used++] = '*';
        } else {
            if (strchr("*?[]\\", *at)) {
                pattern[used++] = '\\';
            }
            pattern[used++] = *at;
        }
    }
    pattern[used] = '\0';
    return KOKSMA_OK;
}
