/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The measure l2-disk for points on a hemisphere or the sphere, with law=area: spherical caps with a random direction and a
 * uniform area. By Stolarsky's invariance principle the mean square follows from mean distances between points, and
 * between points and the domain (the formula is in warp_caps.h): O(n^2).
 */
#include "measures/warped/warped.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "measures/shared/shared.h"

enum { BLOCK = 32 };

typedef struct rows {
    size_t n;
    const double *xs;
    koksma_warp_domain domain;
    koksma__sum *pairs, *linear; /* the sum of each block */
} rows;

typedef struct ring {
    double angle; /* angle of the point from the pole */
    bool cosine;
} ring;

/* Returns the integral of the distance from the point over the circle at angle b from the pole, weighted by the
   density of the measure; it is a complete elliptic integral. */
static double ring_distance(double b, const void *context)
{
    const ring *r = context;
    const double far = koksma__sin((r->angle + b) / 2), near = fabs(koksma__sin((r->angle - b) / 2));
    double first, second;
    koksma__elliptic(far > 0 ? fmin(near / far, 1) : 1, &first, &second);
    return 4 / M_PI * far * second * koksma__sin(b) * (r->cosine ? 2 * koksma__cos(b) : 1);
}

double koksma__cap_potential(const double *x, koksma_warp_domain domain)
{
    if (domain == KOKSMA_DOMAIN_SPHERE) {
        return 4.0 / 3;
    }
    const ring r = {.angle = koksma__atan2(koksma__hypot(x[0], x[1]), x[2]),
                    .cosine = domain == KOKSMA_DOMAIN_HEMISPHERE_COSINE};
    return koksma__integral(ring_distance, &r, 0, r.angle) + koksma__integral(ring_distance, &r, r.angle, M_PI / 2);
}

double koksma__cap_constant(koksma_warp_domain domain)
{
    if (domain == KOKSMA_DOMAIN_SPHERE) {
        return 4.0 / 3;
    }
    return domain == KOKSMA_DOMAIN_HEMISPHERE_COSINE ? 2048 / (675 * M_PI) : 32 / (9 * M_PI);
}

static koksma_status block(void *context, size_t index)
{
    rows *r = context;
    for (size_t i = index * BLOCK; i < r->n && i < (index + 1) * BLOCK; i++) {
        const double *x = r->xs + 3 * i;
        koksma__sum_add(&r->linear[index], koksma__cap_potential(x, r->domain));
        for (size_t j = 0; j < i; j++) {
            const double *y = r->xs + 3 * j, a = x[0] - y[0], b = x[1] - y[1], c = x[2] - y[2];
            koksma__sum_add(&r->pairs[index], sqrt(a * a + b * b + c * c));
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__warp_caps(size_t n, const double *xs, koksma_warp_domain domain, const koksma_run *run,
                                koksma_value *out)
{
    const size_t n_blocks = (n + BLOCK - 1) / BLOCK;
    rows r = {.n = n, .xs = xs, .domain = domain, .pairs = calloc(2 * n_blocks, sizeof *r.pairs)};
    KOKSMA__REQUIRE_MEMORY(r.pairs, 2 * n_blocks * sizeof *r.pairs);
    r.linear = r.pairs + n_blocks;
    const koksma_status status = koksma__parallel(run, n_blocks, block, &r);
    if (!status) {
        const double count = (double)n;
        koksma__sum total = {0};
        for (size_t b = 0; b < n_blocks; b++) {
            koksma__sum_add(&total, koksma__sum_value(&r.linear[b]) / count);
            koksma__sum_add(&total, -koksma__sum_value(&r.pairs[b]) / count / count);
        }
        koksma__sum_add(&total, -koksma__cap_constant(domain) / 2);
        out->square = koksma__not_below_0(koksma__sum_value(&total) / 4);
        out->value = sqrt(out->square);
    }
    free(r.pairs);
    return status;
}
