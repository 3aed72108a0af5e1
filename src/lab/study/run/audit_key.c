/* SPDX-License-Identifier: Apache-2.0 */
/* Compares the key of a series or reference with the one that a run writes for the same results. A value that is computed
   again proves the columns that it depends on, and only these: rows may also have spellings that mean the same
   ("filter=box", which is the default) and columns that nothing reads (the dimension of an image). They would be other
   rows in an export, or copies that hide the real ones. So every text is parsed and written again, and every column
   without a use must be empty. */
#include "study/run/audit_key.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/warp.h>

#include "core/status.h"
#include "study/plan/image_patterns.h"
#include "study/plan/made_by.h"
#include "study/plan/plan_section.h"
#include "study/plan/variants.h"
#include "study/run/references.h"

static koksma_status same_text(const char *column, const char *stored, const char *written)
{
    KOKSMA__FAIL_IF(strcmp(stored, written) != 0, KOKSMA_MALFORMED,
                    "no run writes such a key: %s = '%.200s', where runs write '%.200s'", column, stored, written);
    return KOKSMA_OK;
}

static koksma_status is_zero(const char *column, long long stored)
{
    KOKSMA__FAIL_IF(stored, KOKSMA_MALFORMED, "no run writes such a key: %s = %lld, where runs write 0", column,
                    stored);
    return KOKSMA_OK;
}

koksma_status koksma__audit_unused(const koksma__series *key, bool is_reference)
{
    const bool points = !strcmp(key->kind, "discrepancy"), metric = !strcmp(key->kind, "metric");
    KOKSMA__FAIL_IF(!points && !metric && strcmp(key->kind, "image") && strcmp(key->kind, "coherence"),
                    KOKSMA_MALFORMED, "no run writes such a key: kind = '%.64s'", key->kind);
    koksma_status status = metric ? KOKSMA_OK : same_text("metric", key->metric, "");
    if (points) {
        status = status ? status : same_text("scene", key->scene, "");
        status = status ? status : is_zero("width", key->width);
        return status ? status : is_zero("height", key->height);
    }
    KOKSMA__FAIL_IF(!status && !is_reference && key->id % KOKSMA__RESULT_VALUES, KOKSMA_MALFORMED,
                    "no run writes such a key: the series of an image has the id %lld, which is no multiple of %d",
                    key->id, KOKSMA__RESULT_VALUES);
    return status ? status : is_zero("dim", key->dim);
}

static koksma_status texts_of_points(const koksma__series *key)
{
    char text[KOKSMA_MAX_SPEC];
    const char *integrand = koksma__integrand_of(key->what);
    const koksma_warp *warp = integrand || !key->options[0] ? NULL : koksma_warp_find(key->options);
    koksma_status status = same_text("options", key->options, warp ? warp->name : "");
    status = status ? status : koksma__pattern_text(key->pattern, text);
    status = status ? status : same_text("pattern", key->pattern, text);
    if (!status) {
        status = integrand ? koksma__error_text(integrand, text) : koksma__measure_text(key->what, text);
    }
    return status ? status : same_text("what", key->what, text);
}

static koksma_status reference_text(const char *what)
{
    char name[KOKSMA_MAX_SPEC], stored[KOKSMA_MAX_SPEC], pattern[KOKSMA_MAX_SPEC], text[KOKSMA__REFERENCE_NAME];
    koksma__reference reference = {.name = name, .pattern = pattern};
    KOKSMA__TRY(koksma__reference_parse(what, name, stored, &reference.spp, &reference.replicates));
    KOKSMA__TRY(koksma__image_pattern_text(stored, pattern));
    koksma__reference_name(&reference, text);
    return same_text("reference", what, text);
}

koksma_status koksma__audit_texts(const koksma__series *key, bool is_reference)
{
    char pattern[KOKSMA_MAX_SPEC], metric[KOKSMA_MAX_SPEC], options[KOKSMA__VARIANT_TEXT];
    if (!strcmp(key->kind, "discrepancy")) {
        return texts_of_points(key);
    }
    koksma_status status = koksma__variant_canonical(key->options, options);
    status = status ? status : same_text("options", key->options, options);
    status = status ? status : reference_text(key->what);
    if (!status && !is_reference) {
        status = koksma__image_pattern_text(key->pattern, pattern);
        status = status ? status : same_text("pattern", key->pattern, pattern);
    }
    if (!status && key->metric[0]) {
        status = koksma__metric_text(key->metric, metric);
        status = status ? status : same_text("metric", key->metric, metric);
    }
    return status;
}

/* ---- Revisions ------------------------------------------------------------------------------------------------ */

/* Reads a revision as runs write it, without sign or leading zeros; returns the position behind it, or NULL. */
static const char *read_revision(const char *text, long *revision)
{
    const size_t digits = strspn(text, "0123456789");
    if (!digits || digits > 10 || (text[0] == '0' && digits > 1)) {
        return NULL;
    }
    *revision = strtol(text, NULL, 10);
    return *revision <= INT_MAX ? text + digits : NULL;
}

/* Whether the text "name revision, name revision" has the names of `here`. *difference: sets a bit for a revision below
   that of `here`, and the next for one above. */
static bool have_names_of(const char *here, const char *stored, unsigned *difference)
{
    while (*here) {
        const size_t item = strcspn(here, ",");
        size_t name = item;
        while (name > 0 && here[name - 1] != ' ') {
            name--;
        }
        long of_here, of_stored;
        const char *rest = strncmp(stored, here, name) ? NULL : read_revision(stored + name, &of_stored);
        if (!rest || !read_revision(here + name, &of_here)) {
            return false;
        }
        *difference |= of_stored < of_here ? 1 : of_stored > of_here ? 2 : 0;
        const bool more = here[item] == ',';
        if (more != !strncmp(rest, ", ", 2)) {
            return false;
        }
        here += item + (more ? 2 : 0);
        stored = rest + (more ? 2 : 0);
    }
    return !*stored;
}

koksma_status koksma__audit_revisions(const koksma__series *key, const koksma__made_by *here, bool *other,
                                      bool *newer)
{
    unsigned difference = 0;
    KOKSMA__FAIL_IF(!have_names_of(here->points, key->made_by, &difference) ||
                        !have_names_of(here->value, key->measured_by, &difference),
                    KOKSMA_MALFORMED, "no version makes it by '%.200s; %.200s', which would be '%.200s; %.200s' here",
                    key->made_by, key->measured_by, here->points, here->value);
    *other = difference != 0;
    *newer = difference & 2;
    return KOKSMA_OK;
}
