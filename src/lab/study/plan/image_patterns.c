/* SPDX-License-Identifier: Apache-2.0 */
/* The sampling patterns of a block of images in a plan. One text either names a single pattern for all sample
   dimensions or lists "use=pattern" pairs, as on the command line; uses that the text leaves out get the pattern
   n-rooks. Plans keep the text in its canonical form, which is part of a row's key in the store. */
#include "study/plan/image_patterns.h"

#include <string.h>

#include "core/status.h"
#include "render/samples/use_patterns.h"
#include "render/samples/uses.h"

koksma_status koksma__image_pattern_set(const char *text, koksma_render_options *options)
{
    memset(&options->pattern, 0, sizeof options->pattern);
    memset(options->patterns, 0, sizeof options->patterns);
    memset(options->groups, 0, sizeof options->groups);
    const koksma_status status = koksma_pattern_spec("n-rooks", &options->pattern);
    return status ? status : koksma_render_patterns(text, options);
}

koksma_status koksma__image_pattern_text(const char *text, char out[KOKSMA_MAX_SPEC])
{
    koksma_render_options options = {0};
    char all[KOKSMA_MAX_PATTERNS_TEXT];
    KOKSMA__TRY(koksma__image_pattern_set(text, &options));
    koksma_render_patterns_text(&options, all);
    KOKSMA__FAIL_IF(strlen(all) >= KOKSMA_MAX_SPEC, KOKSMA_ARGUMENT,
                    "'%.40s...': the text of an image's patterns may have at most %d characters", all,
                    KOKSMA_MAX_SPEC - 1);
    memcpy(out, all, strlen(all) + 1);
    return KOKSMA_OK;
}

const koksma_spec *koksma__image_pattern_at(const koksma_render_options *options, size_t i)
{
    enum { GROUPS = 1 + KOKSMA_N_USES };
    return i == 0                               ? &options->pattern
           : i < GROUPS                         ? &options->patterns[i - 1]
           : i < GROUPS + KOKSMA_MAX_USE_GROUPS ? &options->groups[i - GROUPS].pattern
                                                : NULL;
}

bool koksma__image_pattern_is_one(const char *text)
{
    koksma_render_options options = {0};
    const koksma_spec *spec;
    bool one = !koksma__image_pattern_set(text, &options);
    for (size_t i = 1; (spec = koksma__image_pattern_at(&options, i)); i++) {
        one = one && !spec->pattern;
    }
    return one;
}

bool koksma__image_pattern_is_biased(const char *text)
{
    koksma_render_options options = {0};
    bool biased = false;
    const bool read = !koksma__image_pattern_set(text, &options);
    for (int u = 0; read && u < KOKSMA_N_USES; u++) {
        const int group = koksma__place_of_use_at(&options, u).group;
        const koksma_spec *own = group < 0 ? &options.patterns[u] : &options.groups[group].pattern;
        biased = biased || !koksma_is_unbiased(own->pattern ? own : &options.pattern);
    }
    return biased;
}

koksma_status koksma__image_pattern_try(const char *text, size_t n, const koksma_run *run)
{
    koksma_render_options options = {0};
    const koksma_status status = koksma__image_pattern_set(text, &options);
    return status ? status : koksma__try_use_patterns(&options, n, run);
}
