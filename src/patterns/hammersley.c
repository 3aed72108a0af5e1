/* SPDX-License-Identifier: Apache-2.0 */
/*
 * hammersley: the Halton sequence of one dimension less, behind the equidistant coordinate (i + offset)/n.
 *
 *     x_0 = (i + offset) / n,   x_k = phi_b(i), b the k-th prime
 *
 * Source: Hammersley 1960. offset=0.5 has the lower star discrepancy. In 2D with n = 2^m a (0,m,2)-net.
 * Known exactly, 2D, n = 16: D* = 0.171875 with offset 0, 0.15234375 with offset 1/2.
 */
#include "kernels/kernels.h"
#include "patterns/parts/columns.h"
#include "patterns/parts/radical.h"
#include "patterns/patterns.h"

typedef struct job {
    double n, offset;
    koksma__radicals radicals;
} job;

static void column(const void *context, int k, size_t first, size_t count, double *xs)
{
    const job *j = context;
    if (k == 0) {
        koksma__kernels()->steps(count, (double)first, j->offset, j->n, xs);
    } else {
        koksma__radical_column(&j->radicals.columns[k - 1], first, count, xs);
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    job j;
    j.n = (double)out->n;
    j.offset = args->params[0];
    koksma_status status = koksma__radicals_init(&j.radicals, out->dim - 1, out->n, NULL, NULL);
    if (!status) {
        status = koksma__fill_columns(args->run, out, column, &j);
        koksma__radicals_fini(&j.radicals);
    }
    return status;
}

static const koksma_param params[] = {
    {"offset", "of the first coordinate, in steps of 1/n", 0, 0, 0.999, NULL, false},
    {0},
};

const koksma_pattern koksma__pattern_hammersley = {
    .name = "hammersley",
    .title = "equidistant first coordinate, radical inverses for the others",
    .cite = "hammersley1960",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET2,
    .params = params,
    .generate = generate,
};
