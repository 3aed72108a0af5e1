/* SPDX-License-Identifier: Apache-2.0 */
/* Adaptive methods that split strata (adaptive_place.h). */
#ifndef KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_STRATA_H
#define KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_STRATA_H

#include "render/samples/adaptive/adaptive_place.h"

/* The parameters of every method that splits strata begin with the three that this enumeration names. */
enum { KOKSMA__STRATA_LEVELS, KOKSMA__STRATA_THRESHOLD, KOKSMA__STRATA_REUSE };
extern const char *const koksma__reuse_names[];
#define KOKSMA__STRATA_PARAMS                                                                                        \
    {"levels", "largest number of times that a stratum is split", 2, 0, KOKSMA__MAX_LEVELS, NULL, true},             \
        {"threshold", "difference of two values beyond which their strata are split", 0.05, 0, 1e30, NULL, false},   \
    {                                                                                                                \
        "reuse", "which samples the parts of a split stratum get", KOKSMA__REUSE_KEPT, 0, 2, koksma__reuse_names,    \
            true                                                                                                     \
    }

/* The members of a method that stand for the functions of all methods with strata. */
#define KOKSMA__STRATA_METHOD                                                                                        \
    .close = koksma__strata_close, .prepare = koksma__strata_prepare, .draw = koksma__strata_draw,                   \
    .take = koksma__strata_take, .last = koksma__strata_last, .probes = koksma__strata_probes,                       \
    .result = koksma__strata_result, .part = koksma__strata_part, .show = koksma__strata_show

koksma_status koksma__strata_open(koksma__adaptive *run);
void koksma__strata_close(koksma__adaptive *run);
koksma_status koksma__strata_prepare(koksma__adaptive *run, size_t pixel);
koksma_status koksma__strata_draw(const koksma__adaptive *run, size_t pixel, uint32_t use, const float offset[2],
                                  koksma__sample_scratch *room, float *pairs);
void koksma__strata_take(koksma__adaptive *run, size_t pixel, const koksma__sample_values *values);
void koksma__strata_decide(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand);
void koksma__strata_last(koksma__adaptive *run);
size_t koksma__strata_probes(const koksma__adaptive *run, size_t pixel);
double koksma__strata_result(const koksma__adaptive *run, size_t pixel, double rgb[3]);
void koksma__strata_part(const koksma__adaptive *run, size_t pixel, size_t a, double rgb[3]);

#endif
