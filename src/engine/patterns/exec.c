/* SPDX-License-Identifier: Apache-2.0 */
/*
 * exec: the points that a program prints; the spec is exec:PROGRAM. To generate a set, the program is run as
 *
 *     PROGRAM n dim seed          three whole numbers, in decimal
 *
 * without a shell and without a search path. The program must print n points of dim coordinates in [0,1) to standard
 * output: text with one point on each line, or a .npy file. The program is run twice, and the points of both runs
 * have to be equal. All of Koksma assumes that a set is a pure function of its arguments; results of a sampler that
 * is seeded by the clock could not be reproduced.
 *
 * Limits: the time limit set by koksma_allow_exec, 8 GiB of data for each process, and 64 bytes of output for each
 * coordinate plus 64 KiB. core/child.c documents how all processes of the program are ended.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/platform/processes.h"
#include "core/point_files.h"
#include "core/status.h"
#include "patterns/patterns.h"

enum { NAME = KOKSMA_MAX_SPEC + 8, BYTES_A_COORDINATE = 64, BYTES_BESIDE = 1 << 16 };

static const uint64_t MOST_MEMORY = UINT64_C(8) << 30;

/* Parses the program's output, which must be n points of dim coordinates, each less than 1. */
static koksma_status parse(const char *name, char *text, size_t size, const koksma_points *wanted, koksma_points *out)
{
    KOKSMA__FAIL_IF(!size, KOKSMA_MALFORMED, "%s: it printed nothing", name);
    FILE *stream = fmemopen(text, size, "rb");
    KOKSMA__REQUIRE_MEMORY(stream, size);
    koksma_status status = size > 6 && !memcmp(text, "\x93NUMPY", 6)
                               ? koksma__points_read_npy(stream, name, false, out)
                               : koksma__points_read_text(stream, name, false, out);
    fclose(stream);
    KOKSMA__TRY(status);
    if (out->n != wanted->n || out->dim != wanted->dim) {
        status = koksma__fail(KOKSMA_MALFORMED, "%s: it printed %zu points of %d dimensions, not %zu of %d", name,
                              out->n, out->dim, wanted->n, wanted->dim);
    }
    for (size_t i = 0; !status && i < out->n * (size_t)out->dim; i++) {
        if (out->xs[i] >= 1) {
            status =
                koksma__fail(KOKSMA_MALFORMED, "%s: point %zu has a coordinate of 1; a pattern's points are in [0,1)",
                             name, i / (size_t)out->dim);
        }
    }
    if (status) {
        koksma_points_fini(out);
    }
    return status;
}

static koksma_status run_once(const char *name, uint64_t seed, const koksma_args *args, const koksma_points *wanted,
                              koksma_points *out)
{
    char path[KOKSMA_MAX_SPEC], n[24], dim[24], number[24], *text = NULL;
    size_t size = 0;
    snprintf(path, sizeof path, "%s", args->path);
    snprintf(n, sizeof n, "%zu", wanted->n);
    snprintf(dim, sizeof dim, "%d", wanted->dim);
    snprintf(number, sizeof number, "%" PRIu64, seed);
    const koksma__child child = {
        .name = name,
        .arguments = (char *const[]){path, n, dim, number, NULL},
        .seconds = koksma__exec_seconds(),
        .most_output = wanted->n * (size_t)wanted->dim * BYTES_A_COORDINATE + BYTES_BESIDE,
        .most_memory = MOST_MEMORY,
    };
    KOKSMA__TRY(koksma__child_run(&child, args->run, &text, &size));
    const koksma_status status = parse(name, text, size, wanted, out);
    free(text);
    return status;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    char name[NAME];
    koksma_points first = {0}, second = {0};
    snprintf(name, sizeof name, "exec:%s", args->path);
    koksma_status status = run_once(name, seed, args, out, &first);
    status = status ? status : run_once(name, seed, args, out, &second);
    const size_t bytes = out->n * (size_t)out->dim * sizeof *out->xs;
    if (!status && memcmp(first.xs, second.xs, bytes) != 0) {
        status = koksma__fail(KOKSMA_MALFORMED,
                              "%s: when run twice with n = %zu, dim = %d, seed = %" PRIu64
                              ", it printed different points; they may depend only on n, dim and seed",
                              name, out->n, out->dim, seed);
    }
    if (!status) {
        memcpy(out->xs, first.xs, bytes);
    }
    koksma_points_fini(&first);
    koksma_points_fini(&second);
    return status;
}

const koksma_pattern koksma__pattern_exec = {
    .name = "exec",
    .title = "points printed by a program: exec:PROGRAM is run with n, dim and seed; needs --allow-exec",
    .cite = "-",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = 0,
    .generate = generate,
    .operand = "PROGRAM",
    .runs_code = true,
};
