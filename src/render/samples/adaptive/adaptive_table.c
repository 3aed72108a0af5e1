/* SPDX-License-Identifier: Apache-2.0 */
/* The table of adaptive methods, and the parser and printer of their specs. */
#include <stdio.h>
#include <string.h>

#include "core/lookup.h"
#include "core/spec.h"
#include "core/status.h"
#include "render/samples/adaptive/adaptive.h"

static const koksma_adaptive *const table[] = {
#define ADAPTIVE(name) &koksma__adaptive_##name,
#include "render/samples/adaptive/adaptive.def"
#undef ADAPTIVE
};

KOKSMA__LOOKUP(koksma_adaptive, table)
KOKSMA__NAME_AT(koksma_adaptive)

koksma_status koksma_adaptive_parse(const char *text, koksma_adaptive_options *out)
{
    KOKSMA__REQUIRE(text, out);
    char name[64];
    *out = (koksma_adaptive_options){0};
    const size_t length = strcspn(text, ":");
    snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name - 1), text);
    out->method = koksma_adaptive_find(name);
    if (!out->method) {
        return koksma__fail_unknown("adaptive method", name, koksma_adaptive_name_at, NULL,
                                    "'koksma list adaptive' names them");
    }
    return koksma__params_parse(name, out->method->params, text[length] ? text + length + 1 : "", out->params);
}

void koksma_adaptive_text(const koksma_adaptive_options *options, char *text)
{
    KOKSMA__REQUIRE_OR(, options, text);
    KOKSMA__REQUIRE_OR(, options->method);
    KOKSMA__REQUIRE_OR(, options->method->name);
    snprintf(text, KOKSMA_MAX_SPEC, "%s", options->method->name);
    koksma__params_text(options->method->params, options->params, text, KOKSMA_MAX_SPEC);
}
