/* SPDX-License-Identifier: Apache-2.0 */
/* Functions that read all sections of a plan. An array of JSON objects becomes an array of structs, one item at a
   time, through the parse function of its section; texts, numbers and lists of specs are read and checked here. */
#include "study/plan/plan_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/integrate.h>
#include <koksma/study.h>

#include "core/platform/system.h"
#include "core/status.h"
#include "patterns/files/files.h"
#include "render/samples/samples.h"
#include "study/plan/variants.h"

enum { MAX_ITEMS = 4096 };

static koksma_status copy(const char *text, char **out)
{
    *out = strdup(text);
    return *out ? KOKSMA_OK : koksma__fail_memory(strlen(text));
}

koksma_status koksma__pattern_text(const char *text, char out[KOKSMA_MAX_SPEC])
{
    koksma_spec spec;
    KOKSMA__TRY(koksma_pattern_spec(text, &spec));
    koksma_spec_text(&spec, out);
    return KOKSMA_OK;
}

koksma_status koksma__measure_text(const char *text, char out[KOKSMA_MAX_SPEC])
{
    koksma_spec spec;
    KOKSMA__TRY(koksma_measure_spec(text, &spec));
    koksma_spec_text(&spec, out);
    return KOKSMA_OK;
}

koksma_status koksma__metric_text(const char *text, char out[KOKSMA_MAX_SPEC])
{
    koksma_metric_spec spec;
    KOKSMA__TRY(koksma_metric_parse(text, &spec));
    koksma_metric_text(&spec, out);
    return KOKSMA_OK;
}

/* An integrand is parsed in the first dimension that it supports, because its canonical text does not depend on the
   dimension. */
koksma_status koksma__error_text(const char *text, char out[KOKSMA_MAX_SPEC])
{
    koksma_integral *integral;
    koksma_integral_facts facts;
    koksma_status status = KOKSMA_DIM;
    for (int dim = 1; dim <= KOKSMA_MAX_DIM && status == KOKSMA_DIM; dim *= 2) {
        status = koksma_integral_open(text, dim, &integral);
    }
    KOKSMA__TRY(status);
    koksma_integral_about(integral, &facts);
    koksma_integral_close(integral);
    const int length = snprintf(out, KOKSMA_MAX_SPEC, "error of %s", facts.text);
    return length < KOKSMA_MAX_SPEC ? KOKSMA_OK : koksma__fail(KOKSMA_ARGUMENT, "%.64s...: too long", text);
}

/* Returns where the path in "NAME:PATH" begins, or NULL if the text before `end` names no pattern whose operand is a
   path. */
static const char *path_of(const char *pattern, const char *end)
{
    char name[KOKSMA_MAX_SPEC];
    const size_t length = strcspn(pattern, ":");
    if (pattern + length >= end || length >= sizeof name) {
        return NULL;
    }
    snprintf(name, sizeof name, "%.*s", (int)length, pattern);
    return koksma__names_path(koksma_pattern_find(name)) ? pattern + length + 1 : NULL;
}

size_t koksma__plan_path(const char *text, size_t from)
{
    for (const char *part = text; *part;) {
        const char *pattern, *end = koksma__use_part(part, &pattern), *path = path_of(pattern, end);
        if (path && path > text + from) {
            return (size_t)(path - text);
        }
        part = end + (*end == ';');
        part += strspn(part, " ");
    }
    return 0;
}

/* What a text is, which decides where its paths begin: a scene is a path, a spec begins with at most one, and the text of
   an image's patterns may have one for each use. */
typedef enum text_kind { SCENE, SPEC, USES } text_kind;

static koksma_status read_patterns(const char *text, text_kind kind, koksma_render_options *options)
{
    return kind == USES ? koksma_render_patterns(text, options) : koksma_pattern_spec(text, &options->pattern);
}

/* Whether `joined` still names the patterns of `text`, with the folder before their relative paths. The name of a folder
   may end a pattern, as "x;lens=y/" does; with {n} or {seed} it would make a file a family. */
static bool reads_as_meant(const char *joined, const char *text, const char *folder, text_kind kind)
{
    koksma_render_options before = {0}, after = {0};
    const koksma_spec *a, *b;
    bool same = !read_patterns(text, kind, &before) && !read_patterns(joined, kind, &after);
    for (size_t i = 0; same && (a = koksma__image_pattern_at(&before, i)); i++) {
        const bool relative = koksma__names_path(a->pattern) && !koksma__path_is_absolute(a->path);
        const size_t length = relative ? strlen(folder) : 0;
        b = koksma__image_pattern_at(&after, i);
        same = a->pattern == b->pattern && !strncmp(b->path, folder, length) && !strcmp(b->path + length, a->path) &&
               !(relative && koksma__reads_points(a->pattern) &&
                 (koksma__file_has(folder, "{n}") || koksma__file_has(folder, "{seed}")));
    }
    return same;
}

/* Changes the paths in *text from relative to the plan's folder to relative to the current folder, by writing the plan's
   folder before them. Names of scenes in the library have neither '/' nor '.'. Those of a stored plan are read as its run
   read them, whatever its folder's name is. */
static koksma_status from_plan(const koksma__json_node *node, text_kind kind, bool stored, char **text)
{
    const bool is_scene = kind == SCENE;
    const char *name = koksma__json_document(node), *slash = strrchr(name, '/');
    /* whether the plan is in the current folder, as in "./plan.json" */
    const bool is_here = slash == name + 1 && *name == '.';
    const size_t folder = slash && !is_here ? (size_t)(slash + 1 - name) : 0;
    const bool is_path = is_scene ? strpbrk(*text, "/.") != NULL : strchr(*text, ':') != NULL;
    if (!folder || !is_path) {
        return KOKSMA_OK;
    }
    const size_t length = strlen(*text);
    char *joined = calloc(length + (length / 5 + 1) * folder + 1, 1), *to = joined;
    if (!joined) {
        return koksma__fail_memory(length);
    }
    size_t path = is_scene ? 0 : koksma__plan_path(*text, 0);
    for (size_t i = 0; i < length; i++) {
        if (i == path && (is_scene || path)) {
            if (!koksma__path_is_absolute(*text + i)) {
                memcpy(to, name, folder);
                to += folder;
            }
            path = kind == USES ? koksma__plan_path(*text, i) : 0;
        }
        *to++ = (*text)[i];
    }
    koksma_status status = KOKSMA_OK;
    if ((size_t)(to - joined) >= KOKSMA_MAX_SPEC) {
        status =
            koksma__json_fail(node, "'%.60s...': the path, with the plan's folder before it, is too long", *text);
    } else if (!is_scene && !stored && (size_t)(to - joined) > length) {
        char before[KOKSMA_MAX_SPEC];
        snprintf(before, sizeof before, "%.*s", (int)folder, name);
        status = reads_as_meant(joined, *text, before, kind)
                     ? KOKSMA_OK
                     : koksma__json_fail(node,
                                         "'%.60s': with the plan's folder '%.100s' before its path, it would be read "
                                         "as something else; rename the folder, or start in it, with ./%.60s",
                                         *text, before, slash + 1);
    }
    free(status ? joined : *text);
    *text = status ? *text : joined;
    return status;
}

static koksma_status canonical(const koksma__json_node *node, koksma__spec_parser parser, bool stored, char **out)
{
    const char *text;
    char name[KOKSMA_MAX_SPEC];
    KOKSMA__TRY(koksma__json_text(node, &text));
    const koksma_status status = parser(text, name);
    KOKSMA__TRY(status ? koksma__json_fail_in(node, status) : copy(name, out));
    return from_plan(node, parser == koksma__image_pattern_text ? USES : SPEC, stored, out);
}

koksma_status koksma__plan_text(const koksma__json_node *node, const char *key, bool needed, char **out)
{
    const char *text = NULL;
    koksma_status status = koksma__json_get_text(node, key, needed, &text);
    status = status || !text ? status : copy(text, out);
    return status || !text || strcmp(key, "scene") != 0 ? status : from_plan(node, SCENE, false, out);
}

koksma_status koksma__plan_id(const koksma__json_node *node, bool needed, char **out)
{
    static const char allowed[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_";
    KOKSMA__TRY(koksma__plan_text(node, "id", needed, out));
    KOKSMA__JSON_FAIL_IF(*out && (!**out || (*out)[strspn(*out, allowed)]), node,
                         "id '%.40s': it takes letters, digits, '.', '-' and '_'", *out);
    return KOKSMA_OK;
}

koksma_status koksma__plan_spec(const koksma__json_node *node, const char *key, koksma__spec_parser parser,
                                bool needed, bool stored, char **out)
{
    koksma__json_node member;
    if (!needed && !koksma__json_has(node, key)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__json_member(node, key, &member);
    return status ? status : canonical(&member, parser, stored, out);
}

/* Opens the list `key`, fails if it is empty, and allocates an array for its items, which is freed with the plan. */
static koksma_status open_list(const koksma__json_node *node, const char *key, size_t item_size,
                               koksma__json_node *list, size_t *length, void **items)
{
    koksma_status status = koksma__json_member(node, key, list);
    if (!status) {
        status = koksma__json_length(list, MAX_ITEMS, length);
    }
    if (!status && *length == 0) {
        status = koksma__json_fail(list, "an empty list");
    }
    if (!status && !(*items = calloc(*length, item_size))) {
        status = koksma__fail_memory(*length * item_size);
    }
    return status;
}

koksma_status koksma__plan_texts(const koksma__json_node *node, const char *key, koksma__spec_parser parser,
                                 bool needed, bool stored, koksma__texts *out)
{
    koksma__json_node list;
    size_t length;
    void *items = NULL;
    if (!needed && !koksma__json_has(node, key)) {
        return KOKSMA_OK;
    }
    koksma_status status = open_list(node, key, sizeof *out->at, &list, &length, &items);
    out->at = items;
    for (; !status && out->n < length; out->n++) {
        const koksma__json_node item = koksma__json_item(&list, out->n);
        const char *text;
        if (parser) {
            status = canonical(&item, parser, stored, &out->at[out->n]);
        } else if (!(status = koksma__json_text(&item, &text))) {
            status = copy(text, &out->at[out->n]);
            status = status || strcmp(key, "scenes") != 0 ? status : from_plan(&item, SCENE, false, &out->at[out->n]);
        }
        for (size_t i = 0; !status && i < out->n; i++) {
            if (!strcmp(out->at[i], out->at[out->n])) {
                status = koksma__json_fail(&item, "'%s' is listed twice", out->at[i]);
            }
        }
    }
    return status;
}

koksma_status koksma__plan_join(koksma__texts *to, koksma__texts *more)
{
    char **at = realloc(to->at, (to->n + more->n + 1) * sizeof *at);
    KOKSMA__REQUIRE_MEMORY(at, (to->n + more->n + 1) * sizeof *at);
    to->at = at;
    memcpy(at + to->n, more->at, more->n * sizeof *at);
    to->n += more->n;
    free(more->at);
    *more = (koksma__texts){0};
    return KOKSMA_OK;
}

koksma_status koksma__plan_wholes(const koksma__json_node *node, const char *key, long long min, long long max,
                                  koksma__wholes *out)
{
    koksma__json_node list;
    size_t length;
    void *items = NULL;
    koksma_status status = open_list(node, key, sizeof *out->at, &list, &length, &items);
    out->at = items;
    for (; !status && out->n < length; out->n++) {
        const koksma__json_node item = koksma__json_item(&list, out->n);
        status = koksma__json_whole(&item, min, max, &out->at[out->n]);
        for (size_t i = 0; !status && i < out->n; i++) {
            if (out->at[i] == out->at[out->n]) {
                status = koksma__json_fail(&item, "%lld is listed twice", out->at[i]);
            }
        }
    }
    return status;
}

static int compare_wholes(const void *a, const void *b)
{
    const long long x = *(const long long *)a, y = *(const long long *)b;
    return (x > y) - (x < y);
}

void koksma__plan_sort(koksma__wholes *wholes)
{
    if (wholes->n) {
        qsort(wholes->at, wholes->n, sizeof *wholes->at, compare_wholes);
    }
}

koksma_status koksma__plan_list(const koksma__json_node *node, const char *key, bool needed, size_t item_size,
                                koksma__item_parser parser, const koksma__plan_trials *trials, void **items,
                                size_t *n)
{
    koksma__json_node list;
    size_t length;
    if (!needed && !koksma__json_has(node, key)) {
        return KOKSMA_OK;
    }
    koksma_status status = open_list(node, key, item_size, &list, &length, items);
    while (!status && *n < length) {
        const koksma__json_node item = koksma__json_item(&list, *n);
        status = parser(&item, trials, (char *)*items + (*n)++ * item_size);
    }
    return status;
}
