/* SPDX-License-Identifier: Apache-2.0 */
/* The JSON text beside a mask, with everything that makes it again, written and read. */
#include <koksma/maskfile.h>

#include <stdlib.h>
#include <string.h>

#include "core/files.h"
#include "core/json_writer.h"
#include "core/status.h"
#include "masks/masks.h"
#include "json/json.h"

void koksma_mask_recipe_fini(koksma_mask_recipe *recipe)
{
    if (recipe) {
        free(recipe->options.state);
        memset(recipe, 0, sizeof *recipe);
    }
}

static const char *text_or_null(const char *text)
{
    return *text ? text : NULL;
}

koksma_status koksma_mask_write_recipe(const char *path, const koksma_mask_recipe *recipe)
{
    KOKSMA__REQUIRE(path, recipe);
    const koksma_mask_options *o = &recipe->options;
    const koksma_mask_result *result = &recipe->result;
    const koksma_mask_filter *f = &o->filter;
    koksma_mask_filter normalised = *f;
    const koksma_mask_space *space = o->space;
    KOKSMA__TRY(koksma__mask_check(o->width, o->height, &space, NULL));
    KOKSMA__TRY(koksma_mask_filter_check(&normalised));
    koksma__json_writer w = {0};
    char seed[32], *text;
    size_t size;
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)o->seed);
    koksma__json_begin_object(&w, NULL);
    koksma__json_write_text(&w, "format", "koksma-mask");
    koksma__json_write_text(&w, "version", koksma_version());
    koksma__json_write_whole(&w, "revision", KOKSMA_MASK_REVISION);
    koksma__json_write_whole(&w, "width", o->width);
    koksma__json_write_whole(&w, "height", o->height);
    koksma__json_write_text(&w, "space", space->name);
    koksma__json_write_flag(&w, "open", o->open);
    koksma__json_write_whole(&w, "levels", o->levels);
    koksma__json_write_text(&w, "seed", seed);
    koksma__json_write_number(&w, "swaps", o->swaps);
    koksma__json_write_number(&w, "target", o->target);
    koksma__json_write_text(&w, "from", text_or_null(recipe->from));
    koksma__json_write_whole(&w, "done", (int64_t)result->done);
    koksma__json_write_flag(&w, "finished", result->finished);
    koksma__json_write_number(&w, "first", result->first);
    koksma__json_write_number(&w, "error", result->error);
    koksma__json_write_text(&w, "filter", text_or_null(recipe->filter));
    koksma__json_begin_array(&w, "weights");
    for (int y = 0; y < f->height; y++) {
        koksma__json_begin_array(&w, NULL);
        for (int x = 0; x < f->width; x++) {
            koksma__json_write_number(&w, NULL, f->weights[y * f->width + x]);
        }
        koksma__json_end(&w);
    }
    koksma__json_end(&w);
    if (o->state && !result->finished) {
        koksma__json_begin_array(&w, "state");
        for (size_t p = 0; p < (size_t)o->width * (size_t)o->height; p++) {
            koksma__json_write_whole(&w, NULL, o->state[p]);
        }
        koksma__json_end(&w);
    }
    koksma__json_end(&w);
    KOKSMA__TRY(koksma__json_finish(&w, &text, &size));
    const koksma_status status = koksma__atomic_put(NULL, path, text, size);
    free(text);
    return status;
}

static koksma_status read_weights(const koksma__json_node *root, koksma_mask_filter *f)
{
    koksma__json_node rows;
    size_t height, width;
    KOKSMA__TRY(koksma__json_member(root, "weights", &rows));
    KOKSMA__TRY(koksma__json_length(&rows, KOKSMA_MASK_MAX_SIDE, &height));
    f->height = (int)height;
    for (size_t y = 0; y < height; y++) {
        const koksma__json_node row = koksma__json_item(&rows, y);
        KOKSMA__TRY(koksma__json_length(&row, KOKSMA_MASK_MAX_SIDE, &width));
        KOKSMA__JSON_FAIL_IF(y && (int)width != f->width, &row, "its length differs from that of the rows before");
        f->width = (int)width;
        for (size_t x = 0; x < width; x++) {
            const koksma__json_node item = koksma__json_item(&row, x);
            KOKSMA__TRY(koksma__json_number(&item, -1e100, 1e100, &f->weights[y * width + x]));
        }
    }
    koksma_mask_filter normalised = *f; /* f keeps its bits: they make the same mask */
    const koksma_status status = koksma_mask_filter_check(&normalised);
    return status ? koksma__json_fail_in(&rows, status) : KOKSMA_OK;
}

/* Reads a text that may be null. */
static koksma_status read_text(const koksma__json_node *root, const char *key, char out[KOKSMA_MASK_MAX_TEXT])
{
    koksma__json_node node;
    const char *text;
    KOKSMA__TRY(koksma__json_member(root, key, &node));
    if (koksma__json_is_text(&node)) {
        KOKSMA__TRY(koksma__json_text(&node, &text));
        const int length = snprintf(out, KOKSMA_MASK_MAX_TEXT, "%s", text);
        KOKSMA__JSON_FAIL_IF(length >= KOKSMA_MASK_MAX_TEXT, &node, "the text is longer than %d bytes",
                             KOKSMA_MASK_MAX_TEXT - 1);
    }
    return KOKSMA_OK;
}

/* Reads the state of the search, if the text has it; koksma_mask_optimise checks that it is a permutation. */
static koksma_status read_state(const koksma__json_node *root, koksma_mask_options *out)
{
    const size_t n = (size_t)out->width * (size_t)out->height;
    if (!koksma__json_has(root, "state")) {
        return KOKSMA_OK;
    }
    double *numbers = malloc(n * sizeof *numbers);
    out->state = malloc(n * sizeof *out->state);
    koksma_status status =
        numbers && out->state ? KOKSMA_OK : koksma__fail_memory(n * (sizeof *numbers + sizeof *out->state));
    status = status ? status : koksma__json_get_numbers(root, "state", true, 0, (double)n - 1, n, numbers);
    for (size_t p = 0; p < n && !status; p++) {
        out->state[p] = (uint32_t)numbers[p];
    }
    free(numbers);
    return status;
}

static koksma_status read_space(const koksma__json_node *root, const koksma_mask_space **out)
{
    koksma__json_node node;
    const char *text;
    KOKSMA__TRY(koksma__json_member(root, "space", &node));
    KOKSMA__TRY(koksma__json_text(&node, &text));
    *out = koksma_mask_space_find(text);
    KOKSMA__JSON_FAIL_IF(!*out, &node, "no space '%s'", text);
    return KOKSMA_OK;
}

static koksma_status read_texts(const koksma__json_node *root, koksma_mask_options *out)
{
    koksma__json_node node;
    const char *text;
    KOKSMA__TRY(read_space(root, &out->space));
    KOKSMA__TRY(koksma__json_member(root, "seed", &node));
    KOKSMA__TRY(koksma__json_text(&node, &text));
    char *end;
    out->seed = strtoull(text, &end, 10);
    KOKSMA__JSON_FAIL_IF(end == text || *end, &node, "a text of a whole number is expected");
    return koksma__json_get_flag(root, "open", true, &out->open);
}

static koksma_status read_options(const koksma__json_node *root, koksma_mask_options *out)
{
    const koksma_mask_space *space = NULL;
    long long revision, width, height, levels, done;
    KOKSMA__TRY(koksma__json_get_whole(root, "revision", true, 0, 1000000, &revision));
    KOKSMA__JSON_FAIL_IF(revision != KOKSMA_MASK_REVISION, root,
                         "made by revision %lld of the search; this library has %d and makes other masks", revision,
                         KOKSMA_MASK_REVISION);
    KOKSMA__TRY(koksma__json_get_whole(root, "width", true, 0, KOKSMA_MASK_MAX, &width));
    KOKSMA__TRY(koksma__json_get_whole(root, "height", true, 0, KOKSMA_MASK_MAX, &height));
    KOKSMA__TRY(koksma__json_get_whole(root, "levels", true, 0, KOKSMA_MASK_MAX * KOKSMA_MASK_MAX, &levels));
    KOKSMA__TRY(koksma__json_get_whole(root, "done", true, 0, (long long)1 << 53, &done));
    KOKSMA__TRY(koksma__json_get_number(root, "swaps", true, 0, 1e6, &out->swaps));
    KOKSMA__TRY(koksma__json_get_number(root, "target", true, 0, 1e100, &out->target));
    out->width = (int)width;
    out->height = (int)height;
    out->levels = (int)levels;
    out->done = (uint64_t)done;
    const koksma_status status = koksma__mask_check(out->width, out->height, &space, NULL);
    KOKSMA__TRY(status ? koksma__json_fail_in(root, status) : KOKSMA_OK);
    KOKSMA__TRY(read_texts(root, out));
    KOKSMA__TRY(read_state(root, out));
    return read_weights(root, &out->filter);
}

static koksma_status read_recipe(const koksma__json_node *root, koksma_mask_recipe *out)
{
    koksma_mask_result *r = &out->result;
    KOKSMA__TRY(read_options(root, &out->options));
    KOKSMA__TRY(read_text(root, "filter", out->filter));
    KOKSMA__TRY(read_text(root, "from", out->from));
    KOKSMA__TRY(koksma__json_get_number(root, "first", true, 0, 1e100, &r->first));
    KOKSMA__TRY(koksma__json_get_number(root, "error", true, 0, 1e100, &r->error));
    KOKSMA__TRY(koksma__json_get_flag(root, "finished", true, &r->finished));
    r->done = out->options.done;
    out->options.first = r->first;
    return KOKSMA_OK;
}

/* Opens a recipe; the caller closes *out. */
static koksma_status open_recipe(const char *path, koksma__json **out)
{
    unsigned char *bytes;
    size_t size;
    KOKSMA__TRY(koksma__read_file(path, KOKSMA__FILE_PARAMETERS, KOKSMA__BY_USER, koksma__check_text, &bytes, &size));
    const koksma_status status = koksma__json_open("mask", path, (const char *)bytes, size, out);
    free(bytes);
    return status;
}

koksma_status koksma_mask_read_recipe(const char *path, koksma_mask_recipe *out)
{
    KOKSMA__REQUIRE(path, out);
    koksma__json *document = NULL;
    memset(out, 0, sizeof *out);
    KOKSMA__TRY(open_recipe(path, &document));
    const koksma__json_node root = koksma__json_root(document);
    const koksma_status status = read_recipe(&root, out);
    koksma__json_close(document);
    if (status) {
        koksma_mask_recipe_fini(out);
    }
    return status;
}

koksma_status koksma_mask_recipe_space(const char *path, const koksma_mask_space **out)
{
    KOKSMA__REQUIRE(path, out);
    koksma__json *document = NULL;
    char beside[KOKSMA__MAX_PATH];
    *out = NULL;
    if (snprintf(beside, sizeof beside, "%s.json", path) >= (int)sizeof beside) {
        return KOKSMA_OK; /* no recipe has so long a path */
    }
    koksma_status status = open_recipe(beside, &document);
    if (status) {
        return status == KOKSMA_MISSING ? KOKSMA_OK : status;
    }
    const koksma__json_node root = koksma__json_root(document);
    if (koksma__json_has(&root, "format")) {
        const char *format = "";
        status = koksma__json_get_text(&root, "format", true, &format);
        status = status || strcmp(format, "koksma-mask") != 0 ? status : read_space(&root, out);
    }
    koksma__json_close(document);
    return status;
}
