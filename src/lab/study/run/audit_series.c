/* SPDX-License-Identifier: Apache-2.0 */
/* Builds a plan from the series of a store: one block for each row of table `result` (up to four measures of one
   point set), and one for each image with one reference, whose error, coherence and metrics are rows. The jobs of this
   plan are those of a run, except that an image with several references is rendered once for each reference. A block
   of images without trials stands for each row of table `reference`, so that all references are rendered, also those
   whose images have no rows. */
#include "study/run/audit_series.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/warp.h>

#include "core/capacity.h"
#include "core/status.h"
#include "study/plan/made_by.h"
#include "study/plan/plan_read.h"
#include "study/plan/variants.h"
#include "study/run/references.h"
#include "study/run/run.h"

/* ---- The list ------------------------------------------------------------------------------------------ */

/* KEY_TEXTS: the number of texts up to `what`. An image's key consists of these without the kind, and of numbers. */
enum { N_TEXTS = 9, KEY_TEXTS = 6 };

/* Stores the addresses of a key's strings, so that the caller can copy or free them. */
static void texts_of(koksma__series *key, const char **texts[N_TEXTS])
{
    const char **const all[N_TEXTS] = {&key->kind, &key->scene,  &key->scene_hash, &key->options,    &key->pattern,
                                       &key->what, &key->metric, &key->made_by,    &key->measured_by};
    memcpy(texts, all, sizeof all);
}

/* Replaces the strings of the key by copies. */
static koksma_status copy_texts(koksma__series *key)
{
    const char **texts[N_TEXTS];
    bool copied = true;
    texts_of(key, texts);
    for (int i = 0; i < N_TEXTS; i++) {
        *texts[i] = strdup(*texts[i]);
        copied = copied && *texts[i];
    }
    return copied ? KOKSMA_OK : koksma__fail_memory(1);
}

static koksma_status add_series(void *context, const koksma__series *key, long long id)
{
    koksma__audit_list *list = context;
    koksma__audit_series *at = koksma__add_one(&list->at, &list->n, sizeof *at);
    KOKSMA__TRY(at ? KOKSMA_OK : KOKSMA_MEMORY);
    *at = (koksma__audit_series){.key = *key, .id = id};
    return copy_texts(&at->key);
}

/* The revisions in the row of a reference are those of its image, which a series of image errors has as measured_by. */
static koksma_status add_reference(void *context, const koksma__series *key, const koksma__reference_row *row)
{
    koksma__audit_list *list = context;
    koksma__audit_series *at = koksma__add_one(&list->references, &list->n_references, sizeof *at);
    (void)row;
    KOKSMA__TRY(at ? KOKSMA_OK : KOKSMA_MEMORY);
    *at = (koksma__audit_series){.key = *key, .is_reference = true};
    at->key.metric = at->key.made_by = "";
    at->key.measured_by = key->made_by;
    return copy_texts(&at->key);
}

static int compare_ids(const void *a, const void *b)
{
    const koksma__audit_series *s = a, *t = b;
    return s->id < t->id ? -1 : s->id > t->id;
}

koksma__audit_series *koksma__audit_find(const koksma__audit_list *list, long long id)
{
    const koksma__audit_series wanted = {.id = id};
    return list->n ? bsearch(&wanted, list->at, list->n, sizeof wanted, compare_ids) : NULL;
}

static void see_row(void *context, long long id, long long trial)
{
    koksma__audit_list *list = context;
    koksma__audit_series *s = koksma__audit_find(list, id);
    if (s) {
        s->rows++;
        s->end = trial >= s->end ? trial + 1 : s->end;
    } else {
        list->strangers++;
    }
}

koksma_status koksma__audit_list_read(koksma__store *store, koksma__audit_list *list)
{
    koksma_status status = koksma__store_visit_series(store, add_series, list);
    if (list->n) {
        qsort(list->at, list->n, sizeof *list->at, compare_ids);
    }
    status = status ? status : koksma__store_visit_references(store, add_reference, list);
    return status ? status : koksma__store_scan_rows(store, see_row, list);
}

static void fini_series(koksma__audit_series *series, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const char **texts[N_TEXTS];
        texts_of(&series[i].key, texts);
        for (int k = 0; k < N_TEXTS; k++) {
            free((char *)*texts[k]);
        }
        free(series[i].drawn);
    }
    free(series);
}

void koksma__audit_list_fini(koksma__audit_list *list)
{
    fini_series(list->at, list->n);
    fini_series(list->references, list->n_references);
    KOKSMA__FREE(list->discrepancies, list->images);
    koksma__point_files_fini(&list->files);
}

/* ---- Keys ---------------------------------------------------------------------------------------------------- */

/* Compares the key of a series or reference with the one that a run writes for the same results. A value that is computed
   again proves the columns that it depends on, and only these: rows may also have spellings that mean the same
   ("filter=box", which is the default) and columns that nothing reads (the dimension of an image). They would be other
   rows in an export, or copies that hide the real ones. So every text is parsed and written again, and every column
   without a use must be empty. */

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

static koksma_status check_unused(const koksma__series *key, bool is_reference)
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

static koksma_status check_texts(const koksma__series *key, bool is_reference)
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

static koksma_status check_revisions(const koksma__series *key, const koksma__made_by *here, bool *other, bool *newer)
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

/* ---- Checks of series ---------------------------------------------------------------------------------- */

/* Checks that the renderer accepts the options of an image and of its reference. A reference of its own must have only
   options that apply to references. */
static koksma_status check_image(const koksma__study_scene *scene, const koksma__audit_series *series)
{
    const koksma__series *key = &series->key;
    char name[KOKSMA_MAX_SPEC], pattern[KOKSMA_MAX_SPEC], options[KOKSMA__VARIANT_TEXT];
    long long spp, replicates;
    koksma__variant variant;
    const int width = (int)key->width, height = (int)key->height;
    koksma_status status = koksma__reference_parse(key->what, name, pattern, &spp, &replicates);
    if (!status && (key->n > INT_MAX || spp > INT_MAX || key->width < 1 || key->height < 1 ||
                    key->width > KOKSMA_MAX_IMAGE_SIDE || key->height > KOKSMA_MAX_IMAGE_SIDE)) {
        status = koksma__fail(KOKSMA_ARGUMENT, "the image is too large or empty: %lld x %lld pixels, %lld samples",
                              key->width, key->height, key->n);
    }
    if (!status && series->is_reference) {
        koksma__variant_of_reference(key->options, options);
        status = strcmp(options, key->options)
                     ? koksma__fail(KOKSMA_MALFORMED, "no reference has the options '%.100s'", key->options)
                     : KOKSMA_OK;
    } else if (!status) {
        const koksma__picture row = {key->pattern, key->options, false, key->n, width, height, 0};
        status = koksma__picture_set(scene, &row, &variant);
    }
    if (!status) {
        const koksma__picture of_reference = {pattern, key->options, true, spp, width, height, 0};
        status = koksma__picture_set(scene, &of_reference, &variant);
    }
    return status;
}

/* Checks that the hash in a key, of the scene and of the files of points, is that of the present files. */
static koksma_status check_hash(koksma_study *study, koksma__audit_list *list, const koksma__audit_series *series,
                                const char *scene)
{
    const koksma__series *key = &series->key;
    const bool image = strcmp(key->kind, "discrepancy") != 0;
    const koksma__row_texts texts = {image, key->pattern, image ? key->what : ""};
    char hash[KOKSMA__HASH_TEXT];
    koksma__hash_with_points(&list->files, scene, &texts, hash);
    if (!strcmp(hash, key->scene_hash)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__points_can_be_read(&texts);
    if (status) {
        koksma__study_fail_here(study, status);
        return koksma__fail_in(status == KOKSMA_MEMORY ? status : KOKSMA_MISSING, "a file that its pattern names");
    }
    if (strncmp(key->scene_hash, scene, strlen(scene)) != 0) {
        return koksma__fail(KOKSMA_MALFORMED, "its scene has changed since");
    }
    /* the key has one hash of all files, which does not tell which of them differs */
    return koksma__fail(KOKSMA_MALFORMED, "%s",
                        koksma__points_have_family(&texts)
                            ? "a file of its points has changed since, or their family has other files"
                            : "a file that its pattern names has changed since");
}

koksma_status koksma__audit_check(koksma_study *study, koksma__audit_list *list, koksma__audit_series *series,
                                  koksma__made_by *here)
{
    const koksma__series *key = &series->key;
    const bool image = strcmp(key->kind, "discrepancy") != 0;
    series->state = KOKSMA__AUDIT_WRONG;
    koksma_status status = koksma__find_made_by(image, key->pattern, key->options, key->what, key->metric, here);
    status = status ? status : check_unused(key, series->is_reference);
    bool other = false;
    status = status ? status : check_revisions(key, here, &other, &series->newer);
    if (!status && other) {
        series->state = KOKSMA__AUDIT_OTHER;
        return KOKSMA_OK;
    }
    status = status ? status : check_texts(key, series->is_reference);
    if (!status && !image && (key->dim < 1 || key->dim > KOKSMA_MAX_DIM)) {
        status = koksma__fail(KOKSMA_DIM, "point sets of %lld dimensions are not supported", key->dim);
    }
    if (!status && image) {
        status = koksma__study_open_scene(study, key->scene);
        status = status ? koksma__study_fail_here(study, status) : KOKSMA_OK;
    }
    const koksma__study_scene *scene = !status && image ? koksma__study_scene_of(study, key->scene) : NULL;
    status = status ? status : check_hash(study, list, series, scene ? scene->hash : "");
    status = !status && scene ? check_image(scene, series) : status;
    series->state = status ? KOKSMA__AUDIT_WRONG : KOKSMA__AUDIT_OURS;
    return status;
}

/* ---- The plan ------------------------------------------------------------------------------------------ */

static koksma_status set_whole(koksma__wholes *wholes, long long value)
{
    wholes->at = malloc(sizeof *wholes->at);
    KOKSMA__REQUIRE_MEMORY(wholes->at, sizeof *wholes->at);
    wholes->at[0] = value;
    wholes->n = 1;
    return KOKSMA_OK;
}

/* Adds a zeroed block to the plan, and a group for its series; returns the block, or NULL without memory. */
static void *add_block(void **blocks, size_t *n, size_t size, koksma__audit_group **groups)
{
    size_t n_groups = *n;
    return koksma__add_one(groups, &n_groups, sizeof **groups) ? koksma__add_one(blocks, n, size) : NULL;
}

static bool has_points_of(const koksma__series *a, const koksma__series *b)
{
    return !strcmp(a->pattern, b->pattern) && !strcmp(a->options, b->options) && a->n == b->n && a->dim == b->dim;
}

/* Adds a measure to the block of its row in the store; begins the block unless the previous series did. */
static koksma_status add_measure(koksma__plan *plan, koksma__audit_list *list, koksma__audit_series *s,
                                 long long *row)
{
    const koksma__series *key = &s->key;
    const long long place = s->id % KOKSMA__RESULT_VALUES;
    koksma__discrepancy_block *b = plan->n_discrepancies ? &plan->discrepancies[plan->n_discrepancies - 1] : NULL;
    koksma_status status = KOKSMA_OK;
    if (*row != s->id - place || b->measures.n == KOKSMA__RESULT_VALUES ||
        !has_points_of(&list->discrepancies[plan->n_discrepancies - 1].members[0]->key, key)) {
        b = add_block((void **)&plan->discrepancies, &plan->n_discrepancies, sizeof *b, &list->discrepancies);
        *row = s->id - place;
        status = b ? koksma__texts_add(&b->patterns, key->pattern) : KOKSMA_MEMORY;
        status = status || !key->options[0] ? status : koksma__texts_add(&b->warps, key->options);
        status = status ? status : set_whole(&b->n, key->n);
    }
    KOKSMA__TRY(status);
    koksma__audit_group *group = &list->discrepancies[plan->n_discrepancies - 1];
    group->members[b->measures.n] = s;
    b->dim = (int)key->dim;
    b->trials = s->end > b->trials ? s->end : b->trials;
    return koksma__texts_add(&b->measures, key->what);
}

/* Adds a block for an image, or for a reference, whose block has the reference's own pattern and no trials. */
static koksma_status add_image(koksma__plan *plan, koksma__audit_list *list, const koksma__audit_series *series)
{
    const koksma__series *key = &series->key;
    koksma__image_block *b = add_block((void **)&plan->images, &plan->n_images, sizeof *b, &list->images);
    char name[KOKSMA_MAX_SPEC], pattern[KOKSMA_MAX_SPEC];
    KOKSMA__TRY(b ? KOKSMA_OK : KOKSMA_MEMORY);
    b->width = (int)key->width;
    b->height = (int)key->height;
    koksma__reference made = {0};
    koksma_status status = koksma__reference_parse(key->what, name, pattern, &made.spp, &made.replicates);
    status = status ? status : koksma__texts_add(&b->scenes, key->scene);
    status = status ? status : koksma__texts_add(&b->patterns, series->is_reference ? pattern : key->pattern);
    status = status ? status : koksma__texts_add(&b->variants, key->options);
    status = status ? status : set_whole(&b->spp, series->is_reference ? made.spp : key->n);
    b->references = status ? NULL : calloc(1, sizeof *b->references);
    if (!b->references) {
        return status ? status : koksma__fail_memory(sizeof *b->references);
    }
    b->n_references = 1;
    koksma__reference *r = &b->references[0];
    *r = made;
    r->name = strdup(name);
    r->pattern = strdup(pattern);
    return status ? status : r->name && r->pattern ? KOKSMA_OK : koksma__fail_memory(strlen(pattern));
}

/* Orders images by their keys; series of one image (of its error, coherence and metrics) compare as equal. The
   revisions need no comparison, because all rows are of this program's. */
static int compare_images(const void *a, const void *b)
{
    koksma__series s = (*(koksma__audit_series *const *)a)->key, t = (*(koksma__audit_series *const *)b)->key;
    const long long numbers[3][2] = {{s.n, t.n}, {s.width, t.width}, {s.height, t.height}};
    const char **of_s[N_TEXTS], **of_t[N_TEXTS];
    int order = 0;
    texts_of(&s, of_s);
    texts_of(&t, of_t);
    for (int i = 0; !order && i < 3; i++) {
        order = numbers[i][0] < numbers[i][1] ? -1 : numbers[i][0] > numbers[i][1];
    }
    for (int i = 1; !order && i < KEY_TEXTS; i++) {
        order = strcmp(*of_s[i], *of_t[i]);
    }
    return order;
}

/* The index of a series among the members of the group of an image block to which it would be added. */
static size_t place_of(const koksma__image_block *b, const koksma__audit_series *s)
{
    return !strcmp(s->key.kind, "metric") ? 2 + b->metrics.n : strcmp(s->key.kind, "coherence") ? 0 : 1;
}

/* Whether a series may be added to the last image block: its images have the same key, and no other series has its place.
   One could in a forged file; it then gets a block of its own, so that both are compared. */
static bool fits(const koksma__plan *plan, const koksma__audit_list *list, koksma__audit_series *const *images,
                 size_t i)
{
    return i > 0 && !compare_images(&images[i - 1], &images[i]) &&
           plan->images[plan->n_images - 1].metrics.n < KOKSMA__MOST_METRICS &&
           !list->images[plan->n_images - 1].members[place_of(&plan->images[plan->n_images - 1], images[i])];
}

/* Adds a series to the last image block, whose key it has. */
static koksma_status add_member(koksma__plan *plan, koksma__audit_list *list, koksma__audit_series *s)
{
    koksma__image_block *b = &plan->images[plan->n_images - 1];
    const size_t place = place_of(b, s);
    KOKSMA__TRY(!strcmp(s->key.kind, "metric") ? koksma__texts_add(&b->metrics, s->key.metric) : KOKSMA_OK);
    list->images[plan->n_images - 1].members[place] = s;
    b->trials = s->end > b->trials ? s->end : b->trials;
    return KOKSMA_OK;
}

static koksma_status add_images(koksma__plan *plan, koksma__audit_list *list, koksma__audit_series **images, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        KOKSMA__TRY(fits(plan, list, images, i) ? KOKSMA_OK : add_image(plan, list, images[i]));
        KOKSMA__TRY(add_member(plan, list, images[i]));
    }
    return KOKSMA_OK;
}

koksma_status koksma__audit_plan(koksma_study *study, koksma__audit_list *list)
{
    koksma__plan *plan = &study->plan;
    koksma__audit_series **images = calloc(list->n + 1, sizeof *images);
    size_t n_images = 0;
    long long row = -1;
    plan->name = strdup(study->folder);
    koksma_status status = images && plan->name ? KOKSMA_OK : koksma__fail_memory(list->n * sizeof *images);
    for (size_t i = 0; !status && i < list->n; i++) {
        koksma__audit_series *s = &list->at[i];
        if (s->state != KOKSMA__AUDIT_OURS || !s->rows) {
            continue;
        }
        s->drawn = calloc((size_t)s->end / 8 + 1, 1);
        if (!s->drawn) {
            status = koksma__fail_memory((size_t)s->end / 8);
        } else if (!strcmp(s->key.kind, "discrepancy")) {
            status = add_measure(plan, list, s, &row);
        } else {
            images[n_images++] = s;
        }
    }
    if (!status && n_images) {
        qsort(images, n_images, sizeof *images, compare_images);
        status = add_images(plan, list, images, n_images);
    }
    for (size_t i = 0; !status && i < list->n_references; i++) {
        if (list->references[i].state == KOKSMA__AUDIT_OURS) {
            status = add_image(plan, list, &list->references[i]);
        }
    }
    free(images);
    return status;
}
