/* SPDX-License-Identifier: Apache-2.0 */
/*
 * file: points from a .txt, .csv or .npy file; the spec is file:PATH. A set of n points in dim dimensions has the
 * first n points of the file, and their first dim coordinates. The file has to be a regular file, not a pipe, because
 * each call reads it again.
 *
 *     x_i = row i of the file, cut to dim columns
 *
 * {n} and {seed} in the path stand for the number of points and the seed: file:my_{n}_{seed}.npy gives the sets of a
 * sampler whose files are my_16_0.npy, my_16_1.npy, my_64_0.npy, ... With {n} the file has exactly n points.
 */
#include <string.h>

#include "core/point_files.h"
#include "core/status.h"
#include "patterns/files/files.h"
#include "patterns/patterns.h"

/* Reads the file for n points (0: any number of points) and a seed, cut to the dimensions of `out`. */
static koksma_status read_set(size_t n, uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const int dim = out->dim;
    char path[KOKSMA_MAX_SPEC];
    KOKSMA__FAIL_IF(!n && koksma__file_has(args->path, "{n}"), KOKSMA_N, "file:%s: the number of points is missing",
                    args->path);
    koksma_status status = koksma__file_name(args->path, n, seed, path);
    status = status ? status : koksma__points_read(path, KOKSMA__BY_FILE, false, out);
    if (status == KOKSMA_MISSING && strcmp(path, args->path) != 0) {
        status = koksma__fail(KOKSMA_MISSING, "file:%s: there is no file %s", args->path, path);
    }
    if (!status && out->dim < dim) {
        status = koksma__fail(KOKSMA_DIM, "file:%s: its points have %d dimension%s, not %d", path, out->dim,
                              out->dim == 1 ? "" : "s", dim);
    }
    if (!status && n && out->n != n && koksma__file_has(args->path, "{n}")) {
        status = koksma__fail(KOKSMA_MALFORMED, "file:%s: %s has %zu points, but its name says %zu", args->path, path,
                              out->n, n);
    }
    if (!status && dim && dim < out->dim) {
        for (size_t i = 0; i < out->n * (size_t)dim; i++) { /* copied within one array: no number is overwritten
                                                               before it is read */
            out->xs[i] = out->xs[i / (size_t)dim * (size_t)out->dim + i % (size_t)dim];
        }
        out->dim = dim;
    }
    for (size_t i = 0; !status && i < out->n * (size_t)out->dim; i++) {
        if (out->xs[i] >= 1) {
            status = koksma__fail(KOKSMA_MALFORMED,
                                  "file:%s: point %zu has a coordinate of 1; a pattern's points are in [0,1)", path,
                                  i / (size_t)out->dim);
        }
    }
    if (status) {
        koksma_points_fini(out);
    }
    return status;
}

static koksma_status whole(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    return read_set(0, seed, args, out);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    koksma_points all = {.dim = out->dim};
    KOKSMA__TRY(read_set(out->n, seed, args, &all));
    koksma_status status = KOKSMA_OK;
    if (all.n < out->n) {
        status = koksma__fail(KOKSMA_N, "file:%s: it has %zu points, not %zu; n = %zu or less would do", args->path,
                              all.n, out->n, all.n);
    } else {
        memcpy(out->xs, all.xs, out->n * (size_t)out->dim * sizeof *out->xs);
    }
    koksma_points_fini(&all);
    return status;
}

const koksma_pattern koksma__pattern_file = {
    .name = "file",
    .title = "points read from a file: file:PATH (.txt, .csv, .npy); with {n} or {seed} in PATH there is a file for "
             "each n and seed",
    .cite = "-",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_SEQUENCE,
    .generate = generate,
    .operand = "PATH",
    .whole = whole,
};
