/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Prints what must have equal bits on every system: the hash of each pattern's set for several n and dimensions, the bits
 * of each measure of some of these sets, and the hash of each warp's points. Patterns without a set of such n or dim print
 * nothing. scripts/same-bits compares the lines of many systems. The kernels that were used go to stderr.
 */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include <koksma/koksma.h>
#include <koksma/warp.h>

enum { EVERY = 5, LARGE = 256 };

static const size_t sizes[] = {16, 49, 64, LARGE};
static const int dims[] = {2, 3, 5};

/* FNV-1a of the bits. */
static uint64_t hash_of(const koksma_points *points)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < points->n * (size_t)points->dim; i++) {
        uint64_t bits;
        memcpy(&bits, &points->xs[i], sizeof bits);
        for (int byte = 0; byte < 8; byte++) {
            hash = (hash ^ (bits >> 8 * byte & 255)) * UINT64_C(0x100000001b3);
        }
    }
    return hash;
}

static void print_measures(const char *name, const koksma_points *points)
{
    const koksma_measure *measure;
    for (size_t i = 0; (measure = koksma_measure_at(i)); i++) {
        koksma_spec spec;
        koksma_value value;
        uint64_t bits;
        if (!koksma_measure_spec(measure->name, &spec) && !koksma_evaluate(&spec, points, NULL, &value)) {
            memcpy(&bits, &value.value, sizeof bits);
            printf("%s n=%zu dim=%d %s %016" PRIx64 "\n", name, points->n, points->dim, measure->name, bits);
        }
    }
}

static void print_warps(const koksma_points *points)
{
    const koksma_warp *warp;
    for (size_t i = 0; (warp = koksma_warp_at(i)); i++) {
        koksma_points warped;
        if (!koksma_warp_points(warp, points, &warped)) {
            printf("warp %s %016" PRIx64 "\n", warp->name, hash_of(&warped));
            koksma_points_fini(&warped);
        }
    }
}

static void print_pattern(const koksma_pattern *pattern, bool measured)
{
    koksma_spec spec;
    if (koksma_pattern_spec(pattern->name, &spec)) {
        return;
    }
    for (size_t i = 0; i < sizeof dims / sizeof *dims; i++) {
        for (size_t j = 0; j < sizeof sizes / sizeof *sizes; j++) {
            koksma_points points;
            if ((sizes[j] == LARGE && dims[i] > 2) || koksma_points_init(&points, sizes[j], dims[i])) {
                continue; /* searches of large sets in many dimensions take long where a processor is emulated */
            }
            if (!koksma_generate(&spec, 7, NULL, &points)) {
                printf("%s n=%zu dim=%d %016" PRIx64 "\n", pattern->name, points.n, points.dim, hash_of(&points));
                if (measured && j % 2 == 0) {
                    print_measures(pattern->name, &points);
                }
            }
            koksma_points_fini(&points);
        }
    }
}

int main(void)
{
    const koksma_pattern *pattern;
    koksma_spec spec;
    koksma_points points;
    fprintf(stderr, "%s\n", koksma_instruction_set());
    for (size_t i = 0; (pattern = koksma_pattern_at(i)); i++) {
        print_pattern(pattern, i % EVERY == 0);
    }
    if (!koksma_pattern_spec("random", &spec) && !koksma_points_init(&points, 4096, 2)) {
        if (!koksma_generate(&spec, 5, NULL, &points)) {
            print_warps(&points);
        }
        koksma_points_fini(&points);
    }
    return 0;
}
