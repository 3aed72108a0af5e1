/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What can be said of points whose origin nobody knows: whether they are a grid's cells, a Latin hypercube, a net in
 * base 2, 3 or 5 and of which quality, whether that net is digital (an affine subspace over GF(2)), and how close
 * points are.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/verify.h>

#include "core/c_locale.h"
#include "core/elementary.h"
#include "core/points.h"
#include "core/status.h"
#include "identify/identify.h"

#define WORK 1e8 /* limit of the work for one t: points times shapes of intervals */

enum { MOST_COORDINATES = 8, BITS = 32 };

static koksma_status say(koksma__sample *s, const char *what, const char *detail)
{
    koksma_identity *said = koksma__identity(s, "property", "%s", detail);
    KOKSMA__REQUIRE_MEMORY(said, sizeof *said);
    snprintf(said->what, sizeof said->what, "%s", what);
    return KOKSMA_OK;
}

static int by_value(const void *a, const void *b)
{
    const double *u = a, *v = b;
    return (*u > *v) - (*u < *v);
}

/* Whether rounding by up to the tolerance may have moved the points of a Latin hypercube here: in order, each is then near
   its interval. Errors: MEMORY. */
static koksma_status is_nearly_latin(const koksma_points *p, double tolerance, bool *latin)
{
    double *sorted = malloc(p->n * sizeof *sorted);
    KOKSMA__REQUIRE_MEMORY(sorted, p->n * sizeof *sorted);
    *latin = true;
    for (size_t k = 0; k < (size_t)p->dim && *latin; k++) {
        for (size_t i = 0; i < p->n; i++) {
            sorted[i] = p->xs[i * (size_t)p->dim + k];
        }
        qsort(sorted, p->n, sizeof *sorted, by_value);
        for (size_t i = 0; i < p->n && *latin; i++) {
            *latin = sorted[i] >= (double)i / (double)p->n - tolerance &&
                     sorted[i] <= (double)(i + 1) / (double)p->n + tolerance;
        }
    }
    free(sorted);
    return KOKSMA_OK;
}

koksma_status koksma__find_strata(const koksma_points *p, double tolerance, bool *latin, bool *centred)
{
    const size_t dim = (size_t)p->dim;
    unsigned char *seen = malloc(p->n);
    KOKSMA__REQUIRE_MEMORY(seen, p->n);
    *latin = *centred = true;
    for (size_t k = 0; k < dim && *latin; k++) {
        memset(seen, 0, p->n);
        for (size_t i = 0; i < p->n && *latin; i++) {
            const double x = p->xs[i * dim + k] * (double)p->n;
            unsigned char *cell = &seen[koksma__stratum(p->xs[i * dim + k], p->n)];
            *latin = !*cell;
            *cell = 1;
            *centred = *centred && fabs(x - floor(x) - .5) < 1e-6 + tolerance * (double)p->n;
        }
    }
    free(seen);
    return *latin || tolerance <= 0x1p-47 ? KOKSMA_OK : is_nearly_latin(p, tolerance, latin);
}

static koksma_status look_at_strata(koksma__sample *s)
{
    bool latin, centred;
    KOKSMA__TRY(koksma__find_strata(&s->points, s->tolerance, &latin, &centred));
    for (size_t i = 0; i < s->found->count; i++) {
        latin = latin && strcmp(s->found->items[i].relation, "stratified");
    }
    return latin && s->points.n > 1
               ? say(s, centred ? "centred Latin hypercube (n-rooks)" : "Latin hypercube (n-rooks)",
                     "each of n intervals of every coordinate has one point")
               : KOKSMA_OK;
}

static double shapes(int m, int dim)
{
    double count = 1;
    for (int k = 1; k < dim; k++) {
        count *= (double)(m + k) / k;
    }
    return count;
}

static koksma_status look_at_net(koksma__sample *s, size_t base)
{
    const koksma_points *p = &s->points;
    koksma__net net;
    KOKSMA__TRY(koksma__net_init(p, base, &net));
    const int dim = p->dim < MOST_COORDINATES ? p->dim : MOST_COORDINATES;
    int use[MOST_COORDINATES], t = 0, m = net.digits, used = dim;
    koksma_status status = KOKSMA_OK;
    while (used > 1 && shapes(m, used) * (double)net.powers[m] * (1 + m / 4.) > WORK) {
        used--;
    }
    for (int k = 0; k < used; k++) {
        use[k] = k;
    }
    if (m >= 2) {
        status = koksma__net_quality(&net, m, use, used, s->run, &t);
    }
    char what[160], detail[200];
    snprintf(what, sizeof what, "(%d,%d,%d)-net in base %zu", t, m, used, base);
    snprintf(detail, sizeof detail, "the first %u points%s", net.powers[m],
             used < p->dim ? "; only the first coordinates were tested" : "");
    koksma__net_fini(&net);
    return status || m < 2 || t >= m - 1 || (t == 0 && used == 1) ? status : say(s, what, detail);
}

/* Whether 2^m distinct points are an affine space over GF(2): the differences of all to the first have rank m. */
static koksma_status look_at_affinity(koksma__sample *s)
{
    const koksma_points *p = &s->points;
    const size_t dim = (size_t)p->dim, words = dim;
    if (p->n < 16 || (p->n & (p->n - 1))) {
        return KOKSMA_OK;
    }
    int m = 0, rank = 0;
    while ((size_t)1 << m < p->n) {
        m++;
    }
    uint32_t *rows = calloc(((size_t)m + 1) * words, sizeof *rows);
    size_t *pivots = calloc((size_t)m + 1, sizeof *pivots); /* the bit of each row that the others lack */
    if (!rows || !pivots) {
        free(rows);
        free(pivots);
        return koksma__fail_memory(((size_t)m + 1) * words * sizeof *rows);
    }
    for (size_t i = 1; i < p->n && rank <= m; i++) {
        uint32_t *row = rows + (size_t)rank * words;
        size_t bit = SIZE_MAX;
        for (size_t k = 0; k < dim; k++) {
            row[k] = (uint32_t)(uint64_t)fmin(p->xs[i * dim + k] * 0x1p32, 0x1p32 - 1) ^
                     (uint32_t)(uint64_t)fmin(p->xs[k] * 0x1p32, 0x1p32 - 1);
        }
        for (int r = 0; r < rank; r++) {
            if (row[pivots[r] / BITS] >> pivots[r] % BITS & 1) {
                for (size_t k = 0; k < words; k++) {
                    row[k] ^= rows[(size_t)r * words + k];
                }
            }
        }
        for (size_t k = 0; k < words && bit == SIZE_MAX; k++) {
            bit = row[k] ? k * BITS + (size_t)__builtin_ctz(row[k]) : bit;
        }
        if (bit != SIZE_MAX) {
            pivots[rank++] = bit;
        }
    }
    free(rows);
    free(pivots);
    return rank == m ? say(s, "digital net in base 2 under a digital shift",
                           "as binary digits the differences of the points are a linear space")
                     : KOKSMA_OK;
}

static koksma_status look_at_distances(koksma__sample *s)
{
    double distance;
    char detail[200];
    const koksma_points *p = &s->points;
    if (p->n < 2 || p->n > (p->dim <= 3 ? 1 << 17 : 1 << 12)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma_smallest_distance(p, true, s->run, &distance));
    koksma__snprintf(detail, sizeof detail, "smallest distance on the torus %.6g, times n^(1/dim): %.4g", distance,
                     distance * koksma__pow((double)p->n, 1. / p->dim));
    return say(s, distance > 0 ? "distances" : "repeated points", detail);
}

koksma_status koksma__identify_properties(koksma__sample *s)
{
    static const size_t bases[] = {2, 3, 5};
    KOKSMA__TRY(look_at_strata(s));
    for (size_t b = 0; b < sizeof bases / sizeof *bases; b++) {
        KOKSMA__TRY(look_at_net(s, bases[b]));
    }
    KOKSMA__TRY(look_at_affinity(s));
    return look_at_distances(s);
}
