/* SPDX-License-Identifier: Apache-2.0 */
/* Every line of every table (the .def files): what a name, a number or a kind stands for, and that functions find it. */
#include <string.h>

#include "rendering.h"

#include <koksma/adaptive.h>
#include <koksma/image.h>

#include "image/formats.h"
#include "image/metrics/metrics.h"
#include "integrands/integrands.h"
#include "kernels/kernels.h"
#include "measures/measures.h"
#include "optimise/search.h"
#include "patterns/patterns.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/samples/adaptive/adaptive.h"
#include "render/samples/samples.h"
#include "render/shapes/shapes.h"

/* ---- Tables that are lists ---------------------------------------------------------------------------------- */

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
            assert_int_equal(koksma__image_recognises(format, (const unsigned char *)heads[k].head, 8),
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
