/* SPDX-License-Identifier: Apache-2.0 */
/* Every line of every table (the .def files): what a name, a number or a kind stands for, and that functions find it.
   tests/lint/tables.sh looks whether the order of lines matters. */
#include <string.h>

#include "rendering.h"

#include <koksma/adaptive.h>
#include <koksma/image.h>

#include "image/formats.h"
#include "image/metrics/metrics.h"
#include "integrands/integrands.h"
#include "kernels/kernels.h"
#include "measures/measures.h"
#include "optimise/optimise.h"
#include "patterns/patterns.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/samples/adaptive/adaptive.h"
#include "render/samples/samples.h"
#include "render/shapes/shapes.h"

/* ---- Tables that are lists ---------------------------------------------------------------------------------- */

/* The member is called as its file, with - for _; and found by that name. */
static void expect_name(const char *file, const char *name, const void *member, const void *found)
{
    char text[64];
    snprintf(text, sizeof text, "%s", file);
    for (char *at = text; *at; at++) {
        *at = *at == '_' ? '-' : *at;
    }
    if (strcmp(text, name) != 0 || member != found) {
        fail_msg("the line %s is '%s', found as another: %d", file, name, member != found);
    }
}

TEST_CASE(names_are_those_of_files)
{
    size_t n[11] = {0};
#define PATTERN(line)                                                                                                \
    expect_name(#line, koksma__pattern_##line.name, &koksma__pattern_##line,                                         \
                koksma_pattern_find(koksma__pattern_##line.name));                                                   \
    n[0]++;
#include "patterns/patterns.def"
#define MEASURE(line)                                                                                                \
    expect_name(#line, koksma__measure_##line.name, &koksma__measure_##line,                                         \
                koksma_measure_find(koksma__measure_##line.name));                                                   \
    n[1]++;
#include "measures/measures.def"
#define METHOD(line)                                                                                                 \
    expect_name(#line, koksma__method_##line.name, &koksma__method_##line,                                           \
                koksma_method_find(koksma__method_##line.name));                                                     \
    n[9]++;
#include "optimise/methods.def"
#define INTEGRAND(line)                                                                                              \
    expect_name(#line, koksma__integrand_##line.name, &koksma__integrand_##line,                                     \
                koksma_integrand_find(koksma__integrand_##line.name));                                               \
    n[2]++;
#include "integrands/integrands.def"
    for (; koksma_filter_at(n[3]); n[3]++) {
        const char *name = koksma_filter_at(n[3])->name;
        expect_name(name, name, koksma_filter_at(n[3]), koksma_filter_find(name));
    }
#define MATERIAL(line)                                                                                               \
    expect_name(#line, koksma__bsdf_##line.kind.name, &koksma__bsdf_##line, koksma__bsdfs[n[4]]);                    \
    n[4]++;
#include "render/materials/materials.def"
#define LIGHT(line)                                                                                                  \
    expect_name(#line, koksma__light_##line.kind.name, &koksma__light_##line, koksma__light_types[n[7]]);            \
    n[7]++;
#include "render/lights/lights.def"
#define SHAPE(line)                                                                                                  \
    expect_name(#line, KOKSMA__SHAPE(line).kind.name, &KOKSMA__SHAPE(line), koksma__shape_types[n[8]]);              \
    n[8]++;
#define COMPOUND(line)                                                                                               \
    expect_name(#line, koksma__shape_##line.kind.name, &koksma__shape_##line, koksma__shape_types[n[8]]);            \
    n[8]++;
#include "render/shapes/shapes.def"
#define ADAPTIVE(line)                                                                                               \
    expect_name(#line, koksma__adaptive_##line.name, &koksma__adaptive_##line,                                       \
                koksma_adaptive_find(koksma__adaptive_##line.name));                                                 \
    n[5]++;
#include "render/samples/adaptive/adaptive.def"
#define FORMAT(line)                                                                                                 \
    expect_name(#line, koksma__format_##line.name, NULL, NULL);                                                      \
    n[6]++;
#include "image/formats.def"
#define METRIC(line)                                                                                                 \
    expect_name(#line, koksma__metric_##line.name, &koksma__metric_##line,                                           \
                koksma_metric_find(koksma__metric_##line.name));                                                     \
    n[10]++;
#include "image/metrics/metrics.def"
    assert_null(koksma_metric_at(n[10]));
    assert_null(koksma_pattern_at(n[0]));
    assert_null(koksma_measure_at(n[1]));
    assert_null(koksma_integrand_at(n[2]));
    assert_null(koksma__bsdfs[n[4]]);
    assert_null(koksma__light_types[n[7]]);
    assert_null(koksma__shape_types[n[8]]);
    assert_null(koksma_method_at(n[9]));
    assert_null(koksma_adaptive_at(n[5]));
    assert_null(koksma__image_format_at(n[6]));
    for (int i = 0; i < 11; i++) {
        assert_true(n[i] > 0);
    }
}

/* A file is of one format: whichever is asked first. */
TEST_CASE(formats_know_their_files_only)
{
    static const struct {
        const char *format, *head;
    } heads[] = {{"exr", "\x76\x2f\x31\x01\2\0\0\0"},
                 {"png", "\x89PNG\r\n\x1a\n"},
                 {"pfm", "Pf\n1 1\n-1\n...."},
                 {"jpg", "\xff\xd8\xff\xe0\0\x10JF"}};
    for (size_t i = 0; koksma__image_format_at(i); i++) {
        const koksma__image_format *format = koksma__image_format_at(i);
        for (size_t k = 0; k < 4 && !format->left_out; k++) {
            assert_int_equal(format->recognises((const unsigned char *)heads[k].head, 8),
                             !strcmp(format->name, heads[k].format));
        }
    }
}

/* ---- Tables with numbers ------------------------------------------------------------------------------------ */

/* By koksma/koksma.h's ABI (docs/abi.md): numbers and exit codes that other programs have compiled in. */
TEST_CASE(statuses_keep_their_numbers)
{
    static const struct {
        koksma_status status;
        int number, exit_code;
        const char *word;
    } all[] = {{KOKSMA_OK, 0, 0, "done"},
               {KOKSMA_ARGUMENT, 1, 2, "argument"},
               {KOKSMA_UNKNOWN, 2, 2, "no member"},
               {KOKSMA_N, 3, 2, "number of points"},
               {KOKSMA_DIM, 4, 2, "dimensions"},
               {KOKSMA_IMPOSSIBLE, 5, 2, "no set"},
               {KOKSMA_MISSING, 6, 3, "missing"},
               {KOKSMA_MALFORMED, 7, 3, "malformed"},
               {KOKSMA_MEMORY, 8, 4, "memory"},
               {KOKSMA_IO, 9, 4, "writing"},
               {KOKSMA_SYSTEM, 10, 4, "system"},
               {KOKSMA_UNSUPPORTED, 11, 2, "build"},
               {KOKSMA_INTERRUPTED, 12, 130, "interrupted"},
               {KOKSMA_FORBIDDEN, 13, 2, "code"}};
    assert_int_equal(sizeof all / sizeof *all, KOKSMA_STATUS_COUNT);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        assert_int_equal((int)all[i].status, all[i].number);
        assert_int_equal(koksma_status_exit_code(all[i].status), all[i].exit_code);
        assert_non_null(strstr(koksma_status_text(all[i].status), all[i].word));
    }
}

/* In the order of koksma/render.h, with the numbers that keys have had from the first; at every vertex. */
TEST_CASE(uses_keep_their_numbers)
{
    static const struct {
        const char *name;
        uint32_t number;
        int dim;
    } all[] = {{"pixel", 0, 2},       {"lens", 1, 2},     {"time", 2, 1},     {"light-choice", 3, 1}, {"lobe", 4, 2},
               {"lobe-choice", 5, 1}, {"roulette", 6, 1}, {"distance", 7, 1}, {"light", 1024, 2}};
    assert_int_equal(sizeof all / sizeof *all, KOKSMA_N_USES);
    for (size_t i = 0; i < KOKSMA_N_USES; i++) {
        assert_string_equal(koksma_use_at(i)->name, all[i].name);
        assert_int_equal(koksma_use_at(i)->dim, all[i].dim);
        for (uint32_t bounce = 0; bounce < 3; bounce++) {
            assert_int_equal(koksma__use_index(all[i].number + bounce * KOKSMA__USES_A_BOUNCE), i);
        }
    }
    assert_int_equal(koksma__use_index(KOKSMA__USE_LIGHT + KOKSMA__MAX_LIGHTS - 1), KOKSMA_N_USES - 1);
    assert_null(koksma_use_at(KOKSMA_N_USES));
}

/* ---- Tables of functions ------------------------------------------------------------------------------------ */

TEST_CASE(every_kernel_is_there)
{
    for (size_t i = 0; i < sizeof isas / sizeof *isas; i++) {
        const koksma__kernel_table *table = koksma__kernels_find(isas[i]);
        if (table) {
            assert_string_equal(table->isa, isas[i]);
#define KERNEL(result, name, arguments) assert_true(table->name != NULL);
#include "kernels/kernels.def"
#undef KERNEL
        }
    }
    const koksma__batch_table *batch = koksma__batch();
#define KERNEL(result, name, arguments) assert_true(batch->name != NULL);
#include "render/pipelines/batch.def"
#undef KERNEL
}
