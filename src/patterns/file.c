/* SPDX-License-Identifier: Apache-2.0 */
/*
 * file: points from elsewhere: file:PATH, a .txt, .csv or .npy file. Asked for n points it gives the file's first n;
 * asked for fewer dimensions than the file's, the first of them. The file is read anew at each call, and a
 * plan may name it, so that it is a plain file.
 *
 *     x_i = row i of the file, cut to dim columns
 */
#include <string.h>

#include "core/points_io.h"
#include "core/status.h"
#include "patterns/patterns.h"

static koksma_status whole(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    const int dim = out->dim;
    koksma_status status = koksma__points_read(args->path, KOKSMA__BY_FILE, out);
    if (!status && out->dim < dim) {
        status =
            koksma__fail(KOKSMA_DIM, "file:%s: its points have %d dimensions, not %d", args->path, out->dim, dim);
    }
    if (!status && dim && dim < out->dim) {
        for (size_t i = 0; i < out->n * (size_t)dim; i++) { /* never before what is still to be read */
            out->xs[i] = out->xs[i / (size_t)dim * (size_t)out->dim + i % (size_t)dim];
        }
        out->dim = dim;
    }
    for (size_t i = 0; !status && i < out->n * (size_t)out->dim; i++) {
        if (out->xs[i] >= 1) {
            status = koksma__fail(KOKSMA_MALFORMED,
                                  "file:%s: point %zu has a coordinate of 1; a pattern's points are in [0,1)",
                                  args->path, i / (size_t)out->dim);
        }
    }
    if (status) {
        koksma_points_fini(out);
    }
    return status;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    koksma_points all = {.dim = out->dim};
    KOKSMA__TRY(whole(seed, args, &all));
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
    .title = "the points of a file: file:PATH (.txt, .csv, .npy)",
    .cite = "-",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_SEQUENCE,
    .generate = generate,
    .takes_path = true,
    .whole = whole,
};
