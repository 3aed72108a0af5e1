/* SPDX-License-Identifier: Apache-2.0 */
/* Variants: all combinations of the options that a block of images lists. The table `known` has the options with
   their defaults. The canonical text of a variant, "name=word;...", lists the options that differ from their
   defaults, in the order of the table; it is part of the key in the store. Only options that change the exact image
   apply to references. */
#include "study/plan/variants.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/lookup.h"
#include "core/status.h"
#include "render/samples/samples.h"
#include "render/samples/uses.h"
#include "study/plan/plan.h"

enum { MAX_COMBINATIONS = 4096, MAX_WORDS = 64, MAX_WORD = KOKSMA_MAX_SPEC };

/* An option of a variant; set() checks a word and stores its value. */
typedef struct option {
    const char *name, *fallback;
    /* the option changes the exact image, so that each of its values needs its own references */
    enum { NEVER, ALWAYS, UNLESS_BOX } changes_image;
    koksma_status (*set)(koksma__variant *variant, const char *word);
} option;

typedef const char *name_at_index(int i);

static const char *name_of(const void *name_at, size_t i)
{
    return (*(name_at_index *const *)name_at)((int)i);
}

/* Finds a word among the names of name_at(), which returns NULL after the last; `what` names the option in the
   error. */
static koksma_status find(const char *what, name_at_index *name_at, const char *word, int *index)
{
    char list[MAX_WORD] = "";
    for (*index = 0; name_at(*index); (*index)++) {
        if (!strcmp(name_at(*index), word)) {
            return KOKSMA_OK;
        }
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", name_at(*index));
    }
    char meant[KOKSMA__MEANT];
    return koksma__fail(KOKSMA_ARGUMENT, "%s '%s': %sit takes %s", what, word,
                        koksma__meant(word, name_of, &name_at, meant), list);
}

#define NAMES(function, call)                                                                                        \
    static const char *function(int i)                                                                               \
    {                                                                                                                \
        return call;                                                                                                 \
    }
NAMES(pairing_at, koksma_pairing_name((koksma_pairing)i))
NAMES(scope_at, koksma_scope_name((koksma_scope)i))
NAMES(lights_at, koksma_light_selection_name((koksma_light_selection)i))
NAMES(filter_at, koksma_filter_at((size_t)i) ? koksma_filter_at((size_t)i)->name : NULL)
NAMES(integrator_at, koksma_integrator_at((size_t)i) ? koksma_integrator_at((size_t)i)->name : NULL)
NAMES(flag_at, i == 0 ? "no" : i == 1 ? "yes" : NULL)
#undef NAMES

#define SETTER(name, field, value)                                                                                   \
    static koksma_status set_##name(koksma__variant *variant, const char *word)                                      \
    {                                                                                                                \
        int i;                                                                                                       \
        const koksma_status status = find(#name, name##_at, word, &i);                                               \
        if (!status) {                                                                                               \
            variant->render.field = value;                                                                           \
        }                                                                                                            \
        return status;                                                                                               \
    }
#define splat_at flag_at
SETTER(pairing, pairing, (koksma_pairing)i)
SETTER(scope, scope, (koksma_scope)i)
SETTER(lights, lights, (koksma_light_selection)i)
SETTER(filter, filter, koksma_filter_at((size_t)i))
SETTER(integrator, integrator, koksma_integrator_at((size_t)i))
SETTER(splat, splat, i == 1)
#undef SETTER

static koksma_status set_adaptive(koksma__variant *variant, const char *word)
{
    variant->adaptive.method = NULL;
    return strcmp(word, "none") != 0 ? koksma_adaptive_parse(word, &variant->adaptive) : KOKSMA_OK;
}

static koksma_status set_depth(koksma__variant *variant, const char *word)
{
    char *end;
    const long depth = strtol(word, &end, 10);
    if (strcmp(word, "default") != 0) {
        KOKSMA__FAIL_IF(end == word || *end || depth < 0 || depth > KOKSMA_MAX_DEPTH, KOKSMA_ARGUMENT,
                        "depth '%s': it takes default, or a number of bounces from 0 to %d", word, KOKSMA_MAX_DEPTH);
        variant->render.depth = (int)depth;
    }
    return KOKSMA_OK;
}

/* The options that studies may vary, one a line. Splatting comes before the filter, so that the rows of older
   versions are not found: these wrote "filter=...;splat=yes", and compared such images with references that were not
   splatted. */
static const option known[] = {
    {"pairing", "shuffled", NEVER, set_pairing}, {"scope", "pixel", NEVER, set_scope},
    {"lights", "all", NEVER, set_lights},        {"splat", "no", UNLESS_BOX, set_splat},
    {"filter", "box", ALWAYS, set_filter},       {"integrator", "distribution", ALWAYS, set_integrator},
    {"adaptive", "none", NEVER, set_adaptive},   {"depth", "default", ALWAYS, set_depth},
};

enum { N_KNOWN = sizeof known / sizeof *known };

/* ---- Canonical texts ----------------------------------------------------------------------------------- */

/* Appends "name=word" unless the word is the option's default. */
static void append(char *text, const option *o, const char *word)
{
    const size_t used = strlen(text);
    if (strcmp(word, o->fallback) != 0) {
        snprintf(text + used, KOKSMA__VARIANT_TEXT - used, "%s%s=%s", used ? ";" : "", o->name, word);
    }
}

/* Copies the word of an option from a canonical text, or its default if the text does not have it. */
static void word_of(const char *text, const option *o, char word[MAX_WORD])
{
    const size_t length = strlen(o->name);
    snprintf(word, MAX_WORD, "%s", o->fallback);
    for (const char *at = text; *at; at += strcspn(at, ";"), at += *at == ';') {
        if (!strncmp(at, o->name, length) && at[length] == '=') {
            snprintf(word, MAX_WORD, "%.*s", (int)strcspn(at + length + 1, ";"), at + length + 1);
        }
    }
}

/* Whether an option of the text changes the exact image. Splatting with a filter wider than a pixel changes it,
   because pixels at the edge of the frame then lack samples from beyond the edge. */
static bool changes_image(const char *text, const option *o)
{
    char filter[MAX_WORD] = "box";
    for (int i = 0; i < N_KNOWN && o->changes_image == UNLESS_BOX; i++) {
        if (known[i].set == set_filter) {
            word_of(text, &known[i], filter);
        }
    }
    return o->changes_image == ALWAYS || strcmp(filter, "box") != 0;
}

koksma_status koksma__variant_apply(const char *text, bool of_reference, koksma__variant *variant)
{
    variant->adaptive.method = NULL;
    for (int i = 0; i < N_KNOWN; i++) {
        char word[MAX_WORD];
        word_of(text, &known[i], word);
        if (!of_reference || changes_image(text, &known[i])) {
            KOKSMA__TRY(known[i].set(variant, word));
        }
    }
    return KOKSMA_OK;
}

void koksma__variant_of_reference(const char *text, char *out)
{
    out[0] = '\0';
    for (int i = 0; i < N_KNOWN; i++) {
        char word[MAX_WORD];
        word_of(text, &known[i], word);
        if (changes_image(text, &known[i])) {
            append(out, &known[i], word);
        }
    }
}

koksma_status koksma__variant_check_names(const char *text)
{
    for (const char *at = text; *at; at += strcspn(at, ";"), at += *at == ';') {
        const size_t length = strcspn(at, "=;");
        int i = 0;
        while (i < N_KNOWN && (strlen(known[i].name) != length || strncmp(at, known[i].name, length) != 0)) {
            i++;
        }
        KOKSMA__FAIL_IF(i == N_KNOWN || at[length] != '=', KOKSMA_ARGUMENT,
                        "'%.40s': it takes options of a plan's images, as in scope=image;depth=4", at);
    }
    return KOKSMA_OK;
}

/* ---- Rendering ----------------------------------------------------------------------------------------- */

/* In the first round an adaptive method takes a quarter of the budget, divided by the number of sets with which it
   begins. */
int koksma__variant_first_spp(const koksma__variant *variant, int spp)
{
    const koksma_adaptive_options *adaptive = &variant->adaptive;
    double sets = 1;
    for (size_t i = 0; adaptive->method && adaptive->method->params[i].name; i++) {
        sets = strcmp(adaptive->method->params[i].name, "first") == 0 ? adaptive->params[i] : sets;
    }
    return adaptive->method ? (int)fmax(spp / (4 * sets), 1) : spp;
}

koksma_status koksma__variant_render(const koksma_scene *scene, const koksma__variant *variant, const koksma_run *run,
                                     koksma_image *out)
{
    if (!variant->adaptive.method) {
        return koksma_render(scene, &variant->render, run, out);
    }
    koksma_render_options options = variant->render;
    koksma_adaptive_options adaptive = variant->adaptive;
    koksma_layers layers;
    adaptive.budget = options.spp;
    options.spp = koksma__variant_first_spp(variant, options.spp);
    KOKSMA__TRY(koksma_render_adaptive(scene, &options, &adaptive, run, &layers, NULL));
    *out = layers.image;
    layers.image = (koksma_image){0};
    koksma_layers_fini(&layers);
    return KOKSMA_OK;
}

/* ---- Parsing ------------------------------------------------------------------------------------------- */

/* Checks a word and adds its canonical form: that of a method whose parameters are spelt otherwise becomes equal. */
static koksma_status add_word(const koksma__json_node *item, const option *o, koksma__texts *words)
{
    koksma__variant scratch = {0};
    const char *word;
    char method[KOKSMA_MAX_SPEC];
    KOKSMA__TRY(koksma__json_text(item, &word));
    const koksma_status status = o->set(&scratch, word);
    if (status) {
        return koksma__json_fail_in(item, status);
    }
    if (scratch.adaptive.method) {
        koksma_adaptive_text(&scratch.adaptive, method);
        word = method;
    }
    KOKSMA__JSON_FAIL_IF(koksma__texts_have(words, word), item, "'%s' is listed twice", word);
    return koksma__texts_add(words, word);
}

/* Reads the words of one option; words stays empty if the plan does not name it. */
static koksma_status parse_words(const koksma__json_node *node, const option *o, koksma__texts *words)
{
    koksma__json_node list;
    size_t n;
    if (!koksma__json_has(node, o->name)) {
        return KOKSMA_OK;
    }
    koksma_status status = koksma__json_member(node, o->name, &list);
    status = status ? status : koksma__json_length(&list, MAX_COMBINATIONS, &n);
    KOKSMA__JSON_FAIL_IF(!status && !n, &list, "an empty list");
    for (size_t i = 0; !status && i < n; i++) {
        const koksma__json_node item = koksma__json_item(&list, i);
        status = add_word(&item, o, words);
    }
    return status;
}

/* Rejects adaptive sampling with splatting or with patterns over the whole image. */
static koksma_status check_together(const char *text)
{
    koksma__variant v = {0};
    const koksma_status status = koksma__variant_apply(text, false, &v);
    return !status && v.adaptive.method && (v.render.splat || v.render.scope != KOKSMA_SCOPE_PIXEL)
               ? koksma__fail(KOKSMA_ARGUMENT, "'%s': adaptive can't be combined with splat or with scope image",
                              text)
               : status;
}

koksma_status koksma__variant_canonical(const char *text, char out[KOKSMA__VARIANT_TEXT])
{
    out[0] = '\0';
    for (int i = 0; i < N_KNOWN; i++) {
        char word[MAX_WORD];
        koksma__variant scratch = {0};
        word_of(text, &known[i], word);
        KOKSMA__TRY(known[i].set(&scratch, word));
        if (scratch.adaptive.method) {
            koksma_adaptive_text(&scratch.adaptive, word);
        }
        append(out, &known[i], word);
    }
    return check_together(out);
}

static koksma_status combine(const koksma__texts words[N_KNOWN], koksma__texts *out)
{
    size_t total = 1;
    for (int i = 0; i < N_KNOWN; i++) {
        total *= words[i].n ? words[i].n : 1;
        KOKSMA__FAIL_IF(total > MAX_COMBINATIONS, KOKSMA_ARGUMENT, "more than %d combinations of options",
                        MAX_COMBINATIONS);
    }
    out->at = calloc(total, sizeof *out->at);
    KOKSMA__REQUIRE_MEMORY(out->at, total * sizeof *out->at);
    for (; out->n < total; out->n++) {
        char text[KOKSMA__VARIANT_TEXT] = "";
        size_t below = total, rest = out->n;
        for (int i = 0; i < N_KNOWN; i++) {
            if (words[i].n) {
                below /= words[i].n;
                append(text, &known[i], words[i].at[rest / below]);
                rest %= below;
            }
        }
        out->at[out->n] = strdup(text);
        KOKSMA__REQUIRE_MEMORY(out->at[out->n], strlen(text));
        const koksma_status status = check_together(text);
        if (status) {
            out->n++; /* count the new text, so that it is freed, too */
            return status;
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__variants_parse(const koksma__json_node *node, koksma__texts *out)
{
    koksma__texts words[N_KNOWN] = {{0}};
    const char *keys[N_KNOWN + 2] = {"comment"};
    koksma__json_node options;
    koksma_status status = KOKSMA_OK;
    if (koksma__json_has(node, "options")) {
        for (int i = 0; i < N_KNOWN; i++) {
            keys[i + 1] = known[i].name;
        }
        status = koksma__json_member(node, "options", &options);
        status = status ? status : koksma__json_only(&options, keys);
        for (int i = 0; !status && i < N_KNOWN; i++) {
            status = parse_words(&options, &known[i], &words[i]);
        }
    }
    if (!status && (status = combine(words, out))) {
        status = koksma__json_fail_in(node, status);
    }
    for (int i = 0; i < N_KNOWN; i++) {
        koksma__texts_fini(&words[i]);
    }
    return status;
}

/* ---- The patterns of an image -------------------------------------------------------------------------------- */

/* The sampling patterns of a block of images in a plan. One text either names a single pattern for all sample
   dimensions or lists "use=pattern" pairs, as on the command line; uses that the text leaves out get the pattern
   n-rooks. Plans keep the text in its canonical form, which is part of a row's key in the store. */

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
