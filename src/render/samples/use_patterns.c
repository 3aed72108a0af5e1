/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parses, checks and prints the text that assigns patterns to uses: "random;lens=sobol;pixel+time=scan-time" has a
 * common pattern, a pattern for one use and a pattern for a group of uses. The text consists of parts; a part that is
 * not for all uses begins with the names of its uses and '='. A ';' ends a part only where the next part names uses,
 * so that a path may contain a ';'. The canonical text prints each pattern in canonical form.
 */
#include "render/samples/samples.h"

#include <stdio.h>
#include <string.h>

#include "core/lookup.h"
#include "core/status.h"
#include "patterns/files/files.h"
#include "patterns/masks/tile_size.h"

/* the most points of a tile that are tried before a render */
#define MOST_TRIED ((size_t)1 << 22)

/* ---- Checks ---------------------------------------------------------------------------------------------- */

static int dimensions(const koksma_use_group *group)
{
    int dim = 0;
    for (int i = 0; i < group->n_uses; i++) {
        dim += koksma_use_at((size_t)group->uses[i])->dim;
    }
    return dim;
}

void koksma_use_group_text(const koksma_use_group *group, char *text)
{
    KOKSMA__REQUIRE_OR(, group, text);
    size_t used = 0;
    *text = '\0';
    for (int i = 0; i < group->n_uses && i < KOKSMA_N_USES; i++) {
        const koksma_use *use = koksma_use_at((size_t)group->uses[i]);
        used += (size_t)snprintf(text + used, KOKSMA_MAX_SPEC - used, "%s%s", i ? "+" : "", use ? use->name : "?");
    }
}

/* The message says, for example, that pixel+lens need 4 dimensions (pixel 2, lens 2) and that scan-time has only
   3. */
static koksma_status fail_dimensions(const koksma_use_group *group)
{
    const koksma_pattern *p = group->pattern.pattern;
    char name[KOKSMA_MAX_SPEC], parts[KOKSMA_MAX_SPEC] = "", has[64];
    koksma_use_group_text(group, name);
    for (int i = 0; i < group->n_uses; i++) {
        const koksma_use *use = koksma_use_at((size_t)group->uses[i]);
        const size_t used = strlen(parts);
        snprintf(parts + used, sizeof parts - used, "%s%s %d", i ? ", " : "", use->name, use->dim);
    }
    snprintf(has, sizeof has, p->min_dim == p->max_dim ? "%d" : "%d to %d", p->min_dim, p->max_dim);
    return koksma__fail(KOKSMA_DIM,
                        "%s=%s: these uses have %d dimensions together (%s), but the pattern has %s; choose uses "
                        "with as many dimensions, or another pattern",
                        name, p->name, dimensions(group), parts, has);
}

static koksma_status check_group(const koksma_use_group *group)
{
    char name[KOKSMA_MAX_SPEC];
    if (!group->n_uses) {
        return KOKSMA_OK;
    }
    KOKSMA__FAIL_IF(group->n_uses < 2 || group->n_uses > KOKSMA_N_USES, KOKSMA_ARGUMENT,
                    "a group of %d uses: a group must have 2 to %d", group->n_uses, KOKSMA_N_USES);
    for (int i = 0; i < group->n_uses; i++) {
        KOKSMA__FAIL_IF(group->uses[i] < 0 || group->uses[i] >= KOKSMA_N_USES, KOKSMA_ARGUMENT,
                        "use number %d in a group: the number must be 0 to %d", group->uses[i], KOKSMA_N_USES - 1);
    }
    koksma_use_group_text(group, name);
    KOKSMA__FAIL_IF(!group->pattern.pattern, KOKSMA_ARGUMENT, "the options name no pattern for '%s'", name);
    const int dim = dimensions(group);
    return dim < group->pattern.pattern->min_dim || dim > group->pattern.pattern->max_dim ? fail_dimensions(group)
                                                                                          : KOKSMA_OK;
}

/* Returns how many patterns are assigned to a use, alone or in groups. */
static int patterns_of(const koksma_render_options *options, int u)
{
    int n = options->patterns[u].pattern != NULL;
    for (int g = 0; g < KOKSMA_MAX_USE_GROUPS; g++) {
        for (int i = 0; i < options->groups[g].n_uses && i < KOKSMA_N_USES; i++) {
            n += options->groups[g].uses[i] == u;
        }
    }
    return n;
}

/* Fails if a use or group has its own pattern although native pairing uses one pattern for all uses. */
static koksma_status check_native(const koksma_render_options *options)
{
    char name[KOKSMA_MAX_SPEC] = "";
    for (int u = 0; !*name && u < KOKSMA_N_USES; u++) {
        const int group = koksma__place_of_use_at(options, u).group;
        if (group >= 0) {
            koksma_use_group_text(&options->groups[group], name);
        } else if (options->patterns[u].pattern) {
            snprintf(name, sizeof name, "%s", koksma_use_at((size_t)u)->name);
        }
    }
    return *name ? koksma__fail(KOKSMA_ARGUMENT,
                                "native pairing has one pattern for all uses, and '%s' has another; choose shuffled "
                                "or aligned pairing",
                                name)
                 : KOKSMA_OK;
}

koksma_status koksma__check_use_patterns(const koksma_render_options *options)
{
    koksma_status status = KOKSMA_OK;
    KOKSMA__FAIL_IF(!options->pattern.pattern, KOKSMA_ARGUMENT, "the options name no pattern");
    for (int g = 0; !status && g < KOKSMA_MAX_USE_GROUPS; g++) {
        status = check_group(&options->groups[g]);
    }
    for (int u = 0; !status && u < KOKSMA_N_USES; u++) {
        const char *name = koksma_use_at((size_t)u)->name;
        KOKSMA__FAIL_IF(!options->patterns[u].pattern && options->patterns[u].measure, KOKSMA_ARGUMENT,
                        "the options name a measure for the use '%s'; it must be a pattern", name);
        KOKSMA__FAIL_IF(patterns_of(options, u) > 1, KOKSMA_ARGUMENT,
                        "use %s has two patterns: a use takes one, alone or in one group", name);
    }
    return !status && options->pairing == KOKSMA_PAIRING_NATIVE ? check_native(options) : status;
}

koksma_status koksma__check_single_use(const koksma_spec *spec)
{
    const koksma_pattern *p = spec->pattern;
    char has[64];
    snprintf(has, sizeof has, p->min_dim == p->max_dim ? "%d" : "%d to %d", p->min_dim, p->max_dim);
    return p->min_dim > 2 ? koksma__fail(KOKSMA_DIM,
                                         "%s: a single use has 1 or 2 dimensions, but the pattern has %s; give it to "
                                         "a group of uses, such as pixel+time=PATTERN",
                                         p->name, has)
                          : KOKSMA_OK;
}

koksma_status koksma__try_set(const koksma_spec *spec, size_t n, int dim, const koksma_run *run)
{
    koksma_points points;
    koksma_status status = koksma_points_init(&points, n, dim);
    if (!status) {
        status = koksma__file_gap(spec, n, koksma_generate(spec, koksma__first_seed(spec, n), run, &points));
        koksma_points_fini(&points);
    }
    return status;
}

/* Tries the set of a use or group; in the scope pixel an image of one pixel, where the pattern makes images. */
static koksma_status try_pixel(const koksma_render_options *options, const koksma_spec *spec, size_t n, int dim,
                               const koksma_run *run)
{
    koksma_spec one = *spec;
    if (options->scope == KOKSMA_SCOPE_PIXEL && koksma_has_ranges(spec)) {
        koksma__fit_image(&one, 1);
    }
    return koksma__try_set(&one, n, dim, run);
}

/* Tries the set of a use that is in no group. In the scope pixel a mask has n samples in each pixel of its tile; tiles too
   large to try are left to the renderer, which refuses those that do not fit. */
static koksma_status try_single(const koksma_render_options *options, const koksma_spec *spec, size_t n, int dim,
                                const koksma_run *run)
{
    size_t tile[2], pixels = 1;
    KOKSMA__TRY(koksma__check_single_use(spec));
    KOKSMA__TRY(koksma__tile_size(spec, tile));
    if (options->scope == KOKSMA_SCOPE_PIXEL && tile[0]) {
        pixels = tile[0] * tile[1];
    }
    return n <= MOST_TRIED / pixels || pixels == 1 ? try_pixel(options, spec, n * pixels, dim, run) : KOKSMA_OK;
}

koksma_status koksma__try_use_patterns(const koksma_render_options *options, size_t n, const koksma_run *run)
{
    koksma_status status = try_single(options, &options->pattern, n, 2, run);
    for (int u = 0; (!status || status == KOKSMA_INTERRUPTED) && u < KOKSMA_N_USES; u++) {
        const koksma_spec *own = &options->patterns[u];
        status = own->pattern ? try_single(options, own, n, koksma__use_set_dim(own, u), run) : status;
    }
    for (int g = 0; (!status || status == KOKSMA_INTERRUPTED) && g < KOKSMA_MAX_USE_GROUPS; g++) {
        const koksma_use_group *group = &options->groups[g];
        status = group->n_uses ? try_pixel(options, &group->pattern, n, dimensions(group), run) : status;
    }
    return status;
}

/* ---- Texts ----------------------------------------------------------------------------------------------- */

static bool is_of_names(char c)
{
    return (c >= 'a' && c <= 'z') || c == '-' || c == '+';
}

/* Returns the length of the names of uses before '='; 0 if the part names no use. */
static size_t length_of_uses(const char *part)
{
    size_t n = 0;
    while (is_of_names(part[n])) {
        n++;
    }
    return part[n] == '=' ? n : 0;
}

const char *koksma__use_part(const char *part, const char **pattern)
{
    const char *end = strchr(part, ';');
    const size_t uses = length_of_uses(part);
    *pattern = part + uses + (uses > 0);
    while (end && !length_of_uses(end + 1 + strspn(end + 1, " "))) {
        end = strchr(end + 1, ';');
    }
    return end ? end : part + strlen(part);
}

static int find_use(const char *name, size_t length)
{
    for (int i = 0; i < KOKSMA_N_USES; i++) {
        const char *known = koksma_use_at((size_t)i)->name;
        if (strlen(known) == length && !strncmp(known, name, length)) {
            return i;
        }
    }
    return -1;
}

static const char *use_name(const void *table, size_t i)
{
    (void)table;
    return koksma_use_at(i) ? koksma_use_at(i)->name : NULL;
}

static koksma_status fail_unknown_use(const char *part, const char *name, size_t length)
{
    char word[64], meant[KOKSMA__MEANT];
    snprintf(word, sizeof word, "%.*s", (int)(length < sizeof word ? length : sizeof word - 1), name);
    return koksma__fail(KOKSMA_UNKNOWN,
                        "%s: no such use; %sthe uses are pixel, lens, time, light-choice, light, lobe, lobe-choice, "
                        "roulette and distance",
                        part, koksma__meant(word, use_name, NULL, meant));
}

static koksma_status parse_uses(const char *part, const char *text, size_t length, koksma_use_group *group)
{
    *group = (koksma_use_group){0};
    for (const char *at = text, *end = text + length; at <= end; at++) {
        const size_t name = strcspn(at, "+=");
        const int use = find_use(at, name);
        if (use < 0) {
            return fail_unknown_use(part, at, name);
        }
        for (int i = 0; i < group->n_uses; i++) {
            KOKSMA__FAIL_IF(group->uses[i] == use, KOKSMA_ARGUMENT,
                            "%s: use %s occurs twice; a group takes each use once", part,
                            koksma_use_at((size_t)use)->name);
        }
        group->uses[group->n_uses++] = use;
        at += name;
    }
    return KOKSMA_OK;
}

/* Adds a parsed part to the options. There is always space for one more group, because each group takes at least
   two uses and no use is in two groups. */
static koksma_status add_group(const char *part, const koksma_use_group *group, koksma_render_options *options)
{
    int g = 0;
    for (int i = 0; i < group->n_uses; i++) {
        KOKSMA__FAIL_IF(patterns_of(options, group->uses[i]), KOKSMA_ARGUMENT,
                        "%s: use %s already has a pattern; a use takes one, alone or in one group", part,
                        koksma_use_at((size_t)group->uses[i])->name);
    }
    if (group->n_uses == 1) {
        options->patterns[group->uses[0]] = group->pattern;
        return koksma__check_single_use(&group->pattern);
    }
    while (g < KOKSMA_MAX_USE_GROUPS - 1 && options->groups[g].n_uses) {
        g++;
    }
    options->groups[g] = *group;
    return check_group(group);
}

static koksma_status parse_part(const char *part, koksma_render_options *options)
{
    const char *pattern;
    koksma_use_group group = {0};
    koksma__use_part(part, &pattern);
    for (const char *comma = strchr(part, ','); comma; comma = strchr(comma + 1, ',')) {
        KOKSMA__FAIL_IF(find_use(comma + 1, strcspn(comma + 1, "+=")) >= 0, KOKSMA_ARGUMENT,
                        "%s: a semicolon separates uses, as in 'lens=random;time=sobol'", part);
    }
    if (pattern == part) {
        koksma_spec spec;
        const koksma_status status = koksma_pattern_spec(part, &spec);
        if (!status) {
            options->pattern = spec;
        }
        return status;
    }
    koksma_status status = parse_uses(part, part, (size_t)(pattern - part) - 1, &group);
    status = status ? status : koksma_pattern_spec(pattern, &group.pattern);
    return status ? status : add_group(part, &group, options);
}

koksma_status koksma_render_patterns(const char *text, koksma_render_options *options)
{
    KOKSMA__REQUIRE(text, options);
    koksma_render_options changed = *options;
    for (bool first = true; first || *text; first = false) {
        char part[2 * KOKSMA_MAX_SPEC];
        const char *pattern, *end = koksma__use_part(text, &pattern);
        size_t length = (size_t)(end - text);
        KOKSMA__FAIL_IF(length >= sizeof part, KOKSMA_ARGUMENT, "'%.20s...' is longer than %zu characters", text,
                        sizeof part - 1);
        memcpy(part, text, length);
        while (*end && length && part[length - 1] == ' ') { /* skip blanks before a ';' */
            length--;
        }
        part[length] = '\0';
        KOKSMA__TRY(parse_part(part, &changed));
        text = end + (*end == ';');
        text += strspn(text, " ");
    }
    *options = changed;
    return KOKSMA_OK;
}

/* Appends ";name=pattern" to the text. */
static void append(char *text, const char *name, const koksma_spec *spec)
{
    const size_t used = strlen(text);
    char pattern[KOKSMA_MAX_SPEC];
    koksma_spec_text(spec, pattern);
    snprintf(text + used, KOKSMA_MAX_PATTERNS_TEXT - used, ";%s=%s", name, pattern);
}

void koksma_render_patterns_text(const koksma_render_options *options, char *text)
{
    KOKSMA__REQUIRE_OR(, options, text);
    bool done[KOKSMA_MAX_USE_GROUPS] = {false};
    koksma_spec_text(&options->pattern, text);
    for (int u = 0; u < KOKSMA_N_USES; u++) {
        const int g = koksma__place_of_use_at(options, u).group;
        if (g < 0 && options->patterns[u].pattern) {
            append(text, koksma_use_at((size_t)u)->name, &options->patterns[u]);
        } else if (g >= 0 && !done[g]) {
            char name[KOKSMA_MAX_SPEC];
            done[g] = true;
            koksma_use_group_text(&options->groups[g], name);
            append(text, name, &options->groups[g].pattern);
        }
    }
}
