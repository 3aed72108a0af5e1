/* SPDX-License-Identifier: Apache-2.0 */
/* How the tests of koksma_identify make their statements, and the circle on which coordinates are compared. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/status.h"
#include "identify/sample.h"

double koksma__turn(double a)
{
    return a - nearbyint(a);
}

void koksma__append(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    const int length = koksma__vsnprintf(text + used, size - used, format, arguments);
    va_end(arguments);
    if (length > 0 && (size_t)length >= size - used && size > 4) {
        memcpy(text + size - 4, "...", 4);
    }
}

koksma_status koksma__say(koksma__sample *s, const char *relation, const char *what, const char *spec, uint64_t first,
                          const char *detail, ...)
{
    koksma_identities *all = s->found;
    KOKSMA__TRY(koksma__reserve(&all->items, &all->capacity, all->count + 1, sizeof *all->items));
    koksma_identity *said = &all->items[all->count++];
    *said = (koksma_identity){.relation = relation, .first = first};
    snprintf(said->what, sizeof said->what, "%s", what);
    snprintf(said->spec, sizeof said->spec, "%s", spec);
    va_list arguments;
    va_start(arguments, detail);
    koksma__vsnprintf(said->detail, sizeof said->detail, detail, arguments);
    va_end(arguments);
    s->named = s->named || koksma_identity_names(said);
    return KOKSMA_OK;
}

bool koksma_identity_names(const koksma_identity *identity)
{
    KOKSMA__REQUIRE_OR(false, identity);
    static const char *const none[] = {"scaled", "rounded", "unknown"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        if (identity->relation && !strcmp(identity->relation, none[i])) {
            return false;
        }
    }
    return identity->relation != NULL;
}
