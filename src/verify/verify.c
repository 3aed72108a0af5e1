/* SPDX-License-Identifier: Apache-2.0 */
#include "verify/verify.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/net.h"
#include "core/points_io.h"
#include "core/status.h"

enum { PREFIX_LEAST = 16, PREFIX_MOST_DIM = 12 };

static const char *const names[KOKSMA__N_PROPERTIES] = {
#define PROPERTY(id, name) name,
#include "verify/properties.def"
#undef PROPERTY
};

const char *koksma_property_name_at(size_t i)
{
    return i < KOKSMA__N_PROPERTIES ? names[i] : NULL;
}

koksma_finding *koksma__finding(koksma_findings *findings, koksma__property property)
{
    koksma_finding *items =
        koksma__room_for_one(findings->items, findings->count, &findings->room, 64, sizeof *items);
    if (!items) {
        return NULL;
    }
    findings->items = items;
    koksma_finding *f = &findings->items[findings->count++];
    *f = (koksma_finding){.property = names[property], .subject = "-", .detail = "-"};
    return f;
}

void koksma_findings_fini(koksma_findings *findings)
{
    if (findings) {
        free(findings->items);
        *findings = (koksma_findings){0};
    }
}

/* How many points each of the n cells holds that m[k] strata along each of the first dim coordinates of `use` make.
 */
static void count_cells(const koksma_points *points, const int *use, const size_t *m, int dim, uint32_t *counts)
{
    memset(counts, 0, points->n * sizeof *counts);
    for (size_t i = 0; i < points->n; i++) {
        size_t cell = 0;
        for (int k = 0; k < dim; k++) {
            cell = cell * m[k] + koksma__stratum(points->xs[i * (size_t)points->dim + (size_t)use[k]], m[k]);
        }
        counts[cell]++;
    }
}

static koksma_status add_strata(const koksma_points *points, const int *use, const size_t *m, int dim,
                                const char *subject, uint32_t *counts, koksma_findings *findings)
{
    koksma_finding *f = koksma__finding(findings, dim == 1 ? KOKSMA__PROPERTY_LATIN : KOKSMA__PROPERTY_STRATIFIED);
    if (!f) {
        return KOKSMA_MEMORY;
    }
    count_cells(points, use, m, dim, counts);
    size_t empty = 0;
    for (size_t c = 0; c < points->n; c++) {
        empty += counts[c] == 0;
    }
    snprintf(f->subject, sizeof f->subject, "%s", subject);
    snprintf(f->detail, sizeof f->detail, "%zu of %zu strata are empty", empty, points->n);
    f->value = (double)empty;
    f->holds = empty == 0;
    return KOKSMA_OK;
}

koksma_status koksma__verify_strata(const koksma_points *points, uint32_t *counts, koksma_findings *findings)
{
    const size_t n = points->n;
    char subject[48];
    koksma_status status = KOKSMA_OK;
    for (int k = 0; k < points->dim && !status; k++) {
        snprintf(subject, sizeof subject, "%d", k);
        status = add_strata(points, &k, &n, 1, subject, counts, findings);
    }
    const int use[4] = {0, 1, 2, 3};
    for (size_t m = 2; points->dim >= 2 && m * m <= n && !status; m++) {
        const size_t sides[2] = {m, n / m}, other[2] = {n / m, m};
        if (n % m) {
            continue;
        }
        snprintf(subject, sizeof subject, "%zu x %zu", m, n / m);
        status = add_strata(points, use, sides, 2, subject, counts, findings);
        if (m * m < n && !status) {
            snprintf(subject, sizeof subject, "%zu x %zu", n / m, m);
            status = add_strata(points, use, other, 2, subject, counts, findings);
        }
    }
    if (points->dim == 3 || points->dim == 4) {
        const size_t m = (size_t)(pow((double)n, 1.0 / points->dim) + 0.5), sides[4] = {m, m, m, m};
        if (m >= 2 && (points->dim == 3 ? m * m * m : m * m * m * m) == n && !status) {
            snprintf(subject, sizeof subject, "%zu^%d", m, points->dim);
            status = add_strata(points, use, sides, points->dim, subject, counts, findings);
        }
    }
    return status;
}

static size_t at_origin(const koksma_points *points)
{
    size_t count = 0;
    for (size_t i = 0; i < points->n; i++) {
        bool zero = true;
        for (int k = 0; k < points->dim; k++) {
            zero = zero && points->xs[i * (size_t)points->dim + (size_t)k] == 0;
        }
        count += zero;
    }
    return count;
}

/* Points 1 .. n of a sequence like Sobol's: in each coordinate different multiples of 2^-m, 2^m > n, none of them 0.
   Grids share coordinates, and those of centres are odd multiples all. `seen` has room for a bit each. */
static bool is_sequence_from_one(const koksma_points *points, uint32_t *seen)
{
    size_t cells = 1;
    while (cells <= points->n) {
        cells *= 2;
    }
    for (int k = 0; k < points->dim; k++) {
        bool odd = true;
        memset(seen, 0, (cells / 32 + 1) * sizeof *seen);
        for (size_t i = 0; i < points->n; i++) {
            const double place = points->xs[i * (size_t)points->dim + (size_t)k] * (double)cells;
            const size_t cell = (size_t)place;
            if (place != (double)cell || cell == 0 || seen[cell / 32] >> cell % 32 & 1) {
                return false;
            }
            seen[cell / 32] |= 1u << cell % 32;
            odd = odd && cell % 2;
        }
        if (odd) {
            return false;
        }
    }
    return true;
}

static koksma_status verify_origin(const koksma_points *points, uint32_t *counts, koksma_findings *findings)
{
    const size_t count = at_origin(points);
    koksma_finding *f = koksma__finding(findings, KOKSMA__PROPERTY_ORIGIN_UNIQUE);
    if (!f) {
        return KOKSMA_MEMORY;
    }
    f->value = (double)count;
    f->holds = count <= 1;
    snprintf(f->detail, sizeof f->detail, "%zu at the origin", count);
    f = koksma__finding(findings, KOKSMA__PROPERTY_ORIGIN_PRESENT);
    if (!f) {
        return KOKSMA_MEMORY;
    }
    f->value = (double)count;
    f->holds = count > 0 || !is_sequence_from_one(points, counts);
    snprintf(f->detail, sizeof f->detail, "%zu at the origin%s", count,
             count > 0  ? ""
             : f->holds ? ", where only unscrambled sequences need one"
                        : ": different multiples of 2^-m in each coordinate, as a sequence without its first point");
    return KOKSMA_OK;
}

static koksma_status verify_floats(const koksma_points *points, koksma_findings *findings)
{
    size_t count = 0, first = 0;
    for (size_t i = points->n * (size_t)points->dim; i-- > 0;) {
        if ((float)points->xs[i] >= 1) {
            count++;
            first = i / (size_t)points->dim;
        }
    }
    koksma_finding *f = koksma__finding(findings, KOKSMA__PROPERTY_BELOW_ONE_AS_FLOAT);
    if (!f) {
        return KOKSMA_MEMORY;
    }
    f->value = (double)count;
    f->holds = count == 0;
    const size_t all = points->n * (size_t)points->dim;
    int used = snprintf(f->detail, sizeof f->detail, "%zu of %zu coordinates become 1", count, all);
    if (count) {
        snprintf(f->detail + used, sizeof f->detail - (size_t)used, ", first of point %zu", first);
    }
    return KOKSMA_OK;
}

/* The longest prefix that is measured, in a second or so. */
static size_t longest_prefix(const koksma_points *points)
{
    const size_t most = points->dim <= 2 ? (size_t)1 << 22 : points->dim == 3 ? (size_t)1 << 18 : (size_t)1 << 12;
    size_t n = PREFIX_LEAST;
    while (n <= points->n / 2 && n < most) {
        n *= 2;
    }
    return n;
}

static koksma_status verify_progress(const koksma_points *points, const koksma_run *run, koksma_findings *findings)
{
    size_t worst = 0;
    double value = 0;
    koksma_spec l2_star;
    koksma_status status = koksma_measure_spec("l2-star", &l2_star);
    const size_t last = longest_prefix(points);
    for (size_t n = PREFIX_LEAST; n <= points->n && n <= last && points->dim <= PREFIX_MOST_DIM && !status; n *= 2) {
        const koksma_points prefix = {n, points->dim, points->xs};
        const double random = (pow(2, -points->dim) - pow(3, -points->dim)) / (double)n;
        koksma_value found;
        status = koksma_evaluate(&l2_star, &prefix, run, &found);
        const double ratio = status ? 0 : found.value / sqrt(random);
        if (ratio > value) {
            value = ratio;
            worst = n;
        }
    }
    if (status || worst == 0) {
        return status;
    }
    koksma_finding *f = koksma__finding(findings, KOKSMA__PROPERTY_PROGRESSIVE);
    if (!f) {
        return KOKSMA_MEMORY;
    }
    f->value = value;
    f->holds = value <= 2;
    snprintf(f->detail, sizeof f->detail, "the worst of the prefixes up to %zu points has %zu", last, worst);
    return KOKSMA_OK;
}

koksma_status koksma_verify(const koksma_points *points, const koksma_run *run, koksma_findings *findings)
{
    *findings = (koksma_findings){0};
    koksma_status status = koksma__points_check(points);
    if (status) {
        return status;
    }
    uint32_t *counts = malloc((points->n + 1) * sizeof *counts);
    status = counts ? KOKSMA_OK : koksma__fail_memory((points->n + 1) * sizeof *counts);
    if (!status) {
        status = koksma__verify_nets(points, run, findings);
    }
    if (!status) {
        status = koksma__verify_strata(points, counts, findings);
    }
    if (!status) {
        status = koksma__verify_distances(points, run, findings);
    }
    if (!status) {
        status = verify_origin(points, counts, findings);
    }
    free(counts);
    if (!status) {
        status = verify_floats(points, findings);
    }
    if (!status) {
        status = verify_progress(points, run, findings);
    }
    if (status) {
        koksma_findings_fini(findings);
    }
    return status;
}
