/* SPDX-License-Identifier: Apache-2.0 */
/* Whether patterns can make the numbers of points that a plan asks of them, and measures take their dimensions: a
   study must not fail in its middle. */
#include "core/status.h"
#include "study/plan/image_patterns.h"
#include "study/plan/plan_section.h"
#include "study/plan/variants.h"

/* Larger sets are not tried: they would take time, and the rules for n show at small ones. */
enum { MOST_TRIED = 1 << 16 };

/* Patterns look at their arguments before they begin; who asks whether to go on has begun. */
static bool stop_at_once(void *context, double fraction)
{
    (void)context;
    (void)fraction;
    return false;
}

static koksma_status try_set(const char *pattern, long long n, int dim)
{
    const koksma_run briefly = {.threads = 1, .keep_going = stop_at_once};
    koksma_spec spec;
    koksma_points points;
    koksma_status status = koksma_pattern_spec(pattern, &spec);
    status = status ? status : koksma_points_init(&points, (size_t)n, dim);
    if (!status) {
        status = koksma_generate(&spec, 0, &briefly, &points);
        koksma_points_fini(&points);
    }
    return status == KOKSMA_INTERRUPTED ? KOKSMA_OK : status;
}

koksma_status koksma__plan_check_sets(const koksma__json_node *node, const koksma__texts *patterns,
                                      const char *counts, const koksma__wholes *n, int dim)
{
    koksma__json_node list;
    koksma_status status = koksma__json_member(node, counts, &list);
    for (size_t k = 0; !status && k < n->n; k++) {
        for (size_t p = 0; !status && p < patterns->n && n->at[k] <= MOST_TRIED; p++) {
            status = try_set(patterns->at[p], n->at[k], dim);
            if (status) {
                const koksma__json_node item = koksma__json_item(&list, k);
                status = koksma__json_fail_in(&item, status);
            }
        }
    }
    return status;
}

/* Whether each measure serves the block's dim: that shows at one point. */
koksma_status koksma__plan_check_measures(const koksma__json_node *node, const koksma__discrepancy_block *block)
{
    const koksma_run briefly = {.threads = 1, .keep_going = stop_at_once};
    koksma__json_node list;
    koksma_points point;
    koksma_status status = koksma__json_member(node, "measures", &list);
    if (status || (status = koksma_points_init(&point, 1, block->dim))) {
        return status;
    }
    for (int k = 0; k < block->dim; k++) {
        point.xs[k] = 0.5;
    }
    for (size_t m = 0; !status && m < block->measures.n; m++) {
        koksma_spec spec;
        koksma_value value;
        status = koksma_measure_spec(block->measures.at[m], &spec);
        if (!status && koksma_evaluate(&spec, &point, &briefly, &value) == KOKSMA_DIM) {
            const koksma__json_node item = koksma__json_item(&list, m);
            status = koksma__json_fail_in(&item, KOKSMA_DIM);
        }
    }
    koksma_points_fini(&point);
    return status;
}

/* With other options the pattern has other numbers of points, or of dimensions. */
static bool takes_spp_points(const char *variant)
{
    koksma__variant v = {0};
    return !koksma__variant_apply(variant, false, &v) && v.render.scope == KOKSMA_SCOPE_PIXEL &&
           v.render.pairing != KOKSMA_PAIRING_NATIVE && !v.adaptive.method;
}

static koksma_status try_image_set(const char *pattern, long long n)
{
    const koksma_run briefly = {.threads = 1, .keep_going = stop_at_once};
    const koksma_status status = koksma__image_pattern_try(pattern, (size_t)n, &briefly);
    return status == KOKSMA_INTERRUPTED ? KOKSMA_OK : status;
}

/* Native pairing, and methods that draw strata of their own, have no place for patterns of single uses and groups. */
static koksma_status check_variant(const char *variant, const koksma__texts *patterns)
{
    koksma__variant v = {0};
    const koksma_status status = koksma__variant_apply(variant, false, &v);
    const bool native = v.render.pairing == KOKSMA_PAIRING_NATIVE;
    const bool takes_one = native || (v.adaptive.method && v.adaptive.method->own_samples);
    for (size_t p = 0; !status && takes_one && p < patterns->n; p++) {
        KOKSMA__FAIL_IF(!koksma__image_pattern_is_one(patterns->at[p]), KOKSMA_ARGUMENT,
                        "%s: %s: it takes one pattern for all uses", patterns->at[p], variant);
    }
    return status;
}

koksma_status koksma__plan_check_spp(const koksma__json_node *node, const koksma__image_block *block)
{
    koksma__json_node list;
    koksma_status status = koksma__json_member(node, "spp", &list);
    bool takes_spp = false;
    for (size_t v = 0; !status && v < block->variants.n; v++) {
        takes_spp |= takes_spp_points(block->variants.at[v]);
        status = check_variant(block->variants.at[v], &block->patterns);
        status = status ? koksma__json_fail_in(node, status) : KOKSMA_OK;
    }
    for (size_t k = 0; !status && takes_spp && k < block->spp.n; k++) {
        for (size_t p = 0; !status && p < block->patterns.n && block->spp.at[k] <= MOST_TRIED; p++) {
            status = try_image_set(block->patterns.at[p], block->spp.at[k]);
            if (status) {
                const koksma__json_node item = koksma__json_item(&list, k);
                status = koksma__json_fail_in(&item, status);
            }
        }
    }
    return status;
}

koksma_status koksma__plan_check_reference(const koksma__json_node *node, const koksma__reference *reference)
{
    const koksma_status status =
        reference->spp > MOST_TRIED ? KOKSMA_OK : try_image_set(reference->pattern, reference->spp);
    return status ? koksma__json_fail_in(node, status) : KOKSMA_OK;
}
