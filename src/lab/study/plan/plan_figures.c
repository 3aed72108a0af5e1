/* SPDX-License-Identifier: Apache-2.0 */
/* Reads and checks the figures of a plan. A figure shows points, random lines, a rendered scene, or the strata
   into which an adaptive method subdivided a pixel. */
#include <stdlib.h>
#include <string.h>

#include <koksma/adaptive.h>
#include <koksma/warp.h>

#include "core/status.h"
#include "study/plan/plan.h"
#include "study/plan/plan_read.h"
#include "study/plan/variants.h"

enum { MAX_N = 1 << 20, MAX_DRAWN = 1 << 22 };
#define MIN_EXPOSURE 1e-3
#define MAX_EXPOSURE 1e3

static koksma_status get_wholes(const koksma__json_node *node, const char *key, size_t n, long long *out)
{
    koksma__json_node list;
    size_t length;
    koksma_status status = koksma__json_member(node, key, &list);
    status = status ? status : koksma__json_length(&list, n, &length);
    KOKSMA__JSON_FAIL_IF(!status && length != n, &list, "it needs %zu numbers", n);
    for (size_t i = 0; !status && i < n; i++) {
        const koksma__json_node item = koksma__json_item(&list, i);
        status = koksma__json_whole(&item, 0, KOKSMA_MAX_IMAGE_SIDE, &out[i]);
    }
    return status;
}

static koksma_status check_words(const koksma__json_node *node, const koksma__plan_trials *trials,
                                 const koksma__figure *f)
{
    koksma_adaptive_options adaptive;
    koksma_scene *scene;
    koksma_status status = f->scene ? koksma__scene_files_open(&trials->totals->scenes, f->scene, &scene) : KOKSMA_OK;
    if (!status && f->adaptive) {
        status = koksma_adaptive_parse(f->adaptive, &adaptive);
        if (!status && adaptive.method->own_samples && !koksma__image_pattern_is_one(f->pattern)) {
            status = koksma__fail(KOKSMA_ARGUMENT, "%s: adaptive=%s: it needs one pattern for all uses", f->pattern,
                                  f->adaptive);
        }
    }
    if (status) {
        return koksma__json_fail_in(node, status);
    }
    KOKSMA__JSON_FAIL_IF(f->warp && !koksma_warp_find(f->warp), node, "no warp '%s'; 'koksma list warps' names them",
                         f->warp);
    KOKSMA__JSON_FAIL_IF(!f->scene && (f->adaptive || *f->variant || f->detail[2]), node,
                         "options, adaptive and detail need a scene");
    KOKSMA__JSON_FAIL_IF(strstr(f->variant, "adaptive="), node,
                         "a figure's method is its own field 'adaptive', not one of its options");
    KOKSMA__JSON_FAIL_IF(f->strata[0] >= 0 && !f->adaptive, node, "strata need an adaptive method");
    KOKSMA__JSON_FAIL_IF(f->spaces.n && f->strata[0] < 0, node, "spaces need strata");
    KOKSMA__JSON_FAIL_IF(f->exposure != 1 && (!f->scene || f->strata[0] >= 0), node,
                         "exposure needs the picture of a scene");
    return KOKSMA_OK;
}

/* Reads the member "lines": random lines in the square ("primal") or their dual points ("dual"). */
static koksma_status get_lines(const koksma__json_node *node, koksma__figure *f)
{
    char *word = NULL;
    koksma_status status = koksma__plan_text(node, "lines", false, &word);
    f->lines = word != NULL;
    f->dual = word && !strcmp(word, "dual");
    if (!status && word && !f->dual && strcmp(word, "primal") != 0) {
        status = koksma__json_fail(node, "lines '%s': it takes primal or dual", word);
    }
    if (!status && f->lines && (f->scene || f->warp || f->cells)) {
        status = koksma__json_fail(node, "lines can't be combined with a scene, a warp or cells");
    }
    free(word);
    return status;
}

koksma_status koksma__plan_figure(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "id",       "title",  "pattern",  "scene", "n",
                                       "cells",   "adaptive", "strata", "detail",   "warp",  "options",
                                       "lines",   "printed",  "spaces", "exposure", NULL};
    koksma__figure *f = item;
    koksma__texts variants = {0};
    f->strata[0] = f->strata[1] = -1;
    f->exposure = 1;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_id(node, true, &f->id);
    status = status ? status : koksma__plan_text(node, "title", true, &f->title);
    status = status ? status : koksma__plan_text(node, "scene", false, &f->scene);
    status = status ? status : koksma__plan_text(node, "adaptive", false, &f->adaptive);
    status = status ? status : koksma__plan_text(node, "warp", false, &f->warp);
    status = status ? status : koksma__plan_text(node, "printed", false, &f->printed);
    status = status
                 ? status
                 : koksma__plan_pattern(node, "pattern", f->scene ? koksma__image_pattern_text : koksma__pattern_text,
                                        true, trials->stored, &f->pattern);
    status = status ? status : koksma__json_get_whole(node, "n", true, 1, MAX_N, &f->n);
    status = status ? status : koksma__json_get_flag(node, "cells", false, &f->cells);
    status = status ? status : get_lines(node, f);
    if (!status && koksma__json_has(node, "strata")) {
        status = get_wholes(node, "strata", 2, f->strata);
    }
    if (!status && koksma__json_has(node, "detail")) {
        status = get_wholes(node, "detail", 4, f->detail);
    }
    if (!status && koksma__json_has(node, "spaces")) {
        status = koksma__plan_texts(node, "spaces", NULL, &f->spaces);
    }
    status =
        status ? status : koksma__json_get_number(node, "exposure", false, MIN_EXPOSURE, MAX_EXPOSURE, &f->exposure);
    status = status ? status : koksma__variants_parse(node, &variants);
    if (!status && variants.n != 1) {
        status = koksma__json_fail(node, "a figure can have only one value of each option");
    }
    if (!status) {
        f->variant = variants.at[0];
        variants.at[0] = NULL;
    }
    koksma__texts_fini(&variants);
    return status ? status : check_words(node, trials, f);
}

koksma_status koksma__plan_check_figures(const koksma__json_node *root, const koksma__plan_trials *trials,
                                         const koksma__plan *plan)
{
    long long *drawn = &trials->totals->drawn;
    for (size_t i = 0; i < plan->n_figures; i++) {
        *drawn += plan->figures[i].scene ? 0 : plan->figures[i].n;
        if (*drawn > MAX_DRAWN) {
            koksma__json_node figures;
            koksma__json_member(root, "figures", &figures);
            const koksma__json_node figure = koksma__json_item(&figures, i);
            return koksma__json_fail(&figure, "with it the figures draw more than %d points and lines together",
                                     MAX_DRAWN);
        }
    }
    return KOKSMA_OK;
}
