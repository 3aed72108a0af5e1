/* SPDX-License-Identifier: Apache-2.0 */
/* Maps points by a warp, and evaluates measures of the mapped points on the domain of the warp. Half-planes are treated
   as in measures/edge.c and measures/l2_edge.c, but within the domain of the warp. Disks of one radius and spherical
   caps have closed forms (measures/shared/warp_l2_disk.h, warp_caps.h). Sampled disks are those that meet the unit disk:
   the radius follows the disk law, and centres are uniform within 1 + radius of the unit disk's centre. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/warp.h>

#include "api/api.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/points.h"
#include "core/random.h"
#include "core/status.h"
#include "core/sum.h"
#include "measures/disk/disk.h"
#include "measures/shared/shared.h"
#include "measures/warped/warped.h"

enum { ROWS_PER_BLOCK = 32 };

typedef struct job {
    koksma__domain_kind kind;
    size_t n, dim;
    const double *xs;
    koksma__sum *sums; /* for each block of rows the sum over pairs, and the sum of the potentials P of l2_edge.c */
} job;

static koksma_status sum_rows(void *context, size_t block)
{
    const job *j = context;
    koksma__sum pairs = {0}, potentials = {0};
    const size_t first = block * ROWS_PER_BLOCK;
    for (size_t i = first; i < j->n && i < first + ROWS_PER_BLOCK; i++) {
        for (size_t k = 0; k < i; k++) {
            koksma__sum_add(&pairs, koksma__domain_separates(j->kind, j->xs + i * j->dim, j->xs + k * j->dim));
        }
        koksma__sum_add(&potentials, koksma__domain_potential(j->kind, j->xs + i * j->dim));
    }
    j->sums[2 * block] = pairs;
    j->sums[2 * block + 1] = potentials;
    return KOKSMA_OK;
}

static koksma_status l2_edge(job *j, const koksma_run *run, koksma_value *out)
{
    const size_t n_blocks = (j->n + ROWS_PER_BLOCK - 1) / ROWS_PER_BLOCK;
    const double n = (double)j->n;
    j->sums = malloc(2 * n_blocks * sizeof *j->sums);
    KOKSMA__REQUIRE_MEMORY(j->sums, 2 * n_blocks * sizeof *j->sums);
    const koksma_status status = koksma__parallel(run, n_blocks, sum_rows, j);
    koksma__sum square = {0};
    for (size_t block = 0; block < n_blocks && !status; block++) {
        koksma__sum_add(&square, -koksma__sum_value(&j->sums[2 * block]) / n / n);
        koksma__sum_add(&square, koksma__sum_value(&j->sums[2 * block + 1]) / n);
    }
    koksma__sum_add(&square, -koksma__domain_constant(j->kind) / 2);
    out->square = koksma__not_below_0(koksma__sum_value(&square));
    out->value = sqrt(out->square);
    free(j->sums);
    return status;
}

/* Computes the squared local discrepancy of a random disk. */
static double sample_disk(const job *j, koksma__disk_law law, double r_max, uint64_t seed, uint64_t index)
{
    double u[2], v[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_SEARCH, index, 4, u);
    koksma__random_pair(seed, KOKSMA__PURPOSE_SEARCH, index, 5, v);
    const double r = r_max * (law == KOKSMA__DISKS_FIXED ? 1 : law == KOKSMA__DISKS_AREA ? sqrt(v[0]) : v[0]);
    const double distance = (1 + r) * sqrt(u[0]), x = distance * koksma__cos(2 * M_PI * u[1]),
                 y = distance * koksma__sin(2 * M_PI * u[1]);
    double inside = 0;
    for (size_t i = 0; i < j->n; i++) {
        const double dx = j->xs[2 * i] - x, dy = j->xs[2 * i + 1] - y;
        inside += dx * dx + dy * dy <= r * r ? 1.0 : 0.0;
    }
    const double deviation = inside / (double)j->n - koksma__disks_share(r, distance) / M_PI;
    return deviation * deviation;
}

static koksma_status disk_sampled(const job *j, const koksma_spec *measure, const koksma_run *run, koksma_value *out)
{
    const koksma__disk_law law = (koksma__disk_law)measure->params[2];
    const double r = koksma__disk_radius(law, measure->params[1]);
    const size_t count = (size_t)measure->params[0];
    double *squares = malloc(count * sizeof *squares);
    KOKSMA__REQUIRE_MEMORY(squares, count * sizeof *squares);
    bool stopped = false;
    for (size_t d = 0; d < count && !stopped; d++) {
        squares[d] = sample_disk(j, law, r, (uint64_t)measure->params[3], d);
        stopped = d % 256 == 0 && !koksma__keep_going(run, (double)d / (double)count);
    }
    if (!stopped) {
        koksma__sampled_root(squares, count, out);
    }
    free(squares);
    return stopped ? koksma__fail_interrupted() : KOKSMA_OK;
}

/* What each domain has: coordinates, random lines or planes, random caps; and the names of its measures for messages. */
static const struct {
    int dim;
    bool lines, caps;
    koksma__domain_kind kind; /* if it has lines */
    const char *taken;
} domains[] = {
    [KOKSMA_DOMAIN_DISK] = {2, true, false, KOKSMA__DISK, "edge, l2-edge, l2-disk and disk-sampled"},
    [KOKSMA_DOMAIN_TRIANGLE] = {2, true, false, KOKSMA__TRIANGLE, "edge and l2-edge"},
    [KOKSMA_DOMAIN_HEMISPHERE] = {3, true, true, KOKSMA__HEMISPHERE, "l2-edge and l2-disk:law=area"},
    [KOKSMA_DOMAIN_HEMISPHERE_COSINE] = {3, false, true, KOKSMA__HEMISPHERE, "l2-disk:law=area"},
    [KOKSMA_DOMAIN_SPHERE] = {3, true, true, KOKSMA__SPHERE, "l2-edge and l2-disk:law=area"},
    [KOKSMA_DOMAIN_GGX_VISIBLE] = {3, false, false, KOKSMA__HEMISPHERE, "none"},
};

static koksma_status evaluate(const koksma_warp *warp, const koksma_spec *spec, size_t n, const double *xs,
                              const koksma_run *run, koksma_value *out)
{
    const char *name = spec->measure->name;
    const bool on_disk = warp->domain == KOKSMA_DOMAIN_DISK, on_plane = warp->dim == 2,
               is_disk = !strcmp(name, "l2-disk");
    job j = {.kind = domains[warp->domain].kind, .n = n, .dim = (size_t)warp->dim, .xs = xs};
    if (!strcmp(name, "edge") && on_plane) {
        return koksma__edge_sweep(&koksma__domains[j.kind], n, xs, run, out);
    }
    if (!strcmp(name, "l2-edge") && spec->params[0] == 0 && domains[warp->domain].lines) {
        return l2_edge(&j, run, out);
    }
    if (is_disk && on_disk && spec->params[1] == KOKSMA__DISKS_FIXED) {
        return koksma__warp_l2_disk(n, xs, koksma__disk_radius(KOKSMA__DISKS_FIXED, spec->params[0]), run, out);
    }
    if (is_disk && domains[warp->domain].caps && spec->params[1] == KOKSMA__DISKS_AREA) {
        return koksma__warp_caps(n, xs, warp->domain, run, out);
    }
    if (!strcmp(name, "disk-sampled") && on_disk) {
        return disk_sampled(&j, spec, run, out);
    }
    char text[KOKSMA_MAX_SPEC];
    koksma_spec_text(spec, text);
    return koksma__fail(KOKSMA_UNSUPPORTED, "%s: this measure does not support the warp %s, which accepts %s", text,
                        warp->name, domains[warp->domain].taken);
}

static koksma_status check_warp(const koksma_warp *warp)
{
    KOKSMA__FAIL_IF(!warp->name || !warp->map, KOKSMA_ARGUMENT, "the warp has no %s: koksma_warp_find has warps",
                    warp->name ? "map" : "name");
    const bool known = (unsigned)warp->domain < sizeof domains / sizeof *domains;
    KOKSMA__FAIL_IF(
        !known || warp->dim != domains[warp->domain].dim, KOKSMA_ARGUMENT,
        "warp %s: a warp maps to a domain of koksma_warp_domain, with 2 dimensions if it is plane, else 3",
        warp->name);
    return KOKSMA_OK;
}

koksma_status koksma_warp_points(const koksma_warp *warp, const koksma_points *points, koksma_points *out)
{
    KOKSMA__REQUIRE(warp, points, out);
    KOKSMA__TRY(check_warp(warp));
    KOKSMA__TRY(koksma__points_check(points));
    KOKSMA__FAIL_IF(points->dim != 2, KOKSMA_DIM, "%s: a warp maps points of 2 dimensions, not %d", warp->name,
                    points->dim);
    KOKSMA__TRY(koksma_points_init(out, points->n, warp->dim));
    for (size_t i = 0; i < points->n; i++) {
        warp->map(points->xs + 2 * i, out->xs + i * (size_t)warp->dim);
    }
    return KOKSMA_OK;
}

koksma_status koksma_warp_evaluate(const koksma_warp *warp, const koksma_spec *measure, const koksma_points *points,
                                   const koksma_run *run, koksma_value *out)
{
    KOKSMA__REQUIRE(warp, measure, points, out);
    KOKSMA__REQUIRE_RUN(run);
    koksma_value value = {.value = NAN, .square = NAN, .lower = NAN, .upper = NAN, .exact = true};
    KOKSMA__TRY(koksma__evaluate_check("koksma_warp_evaluate", measure, points));
    koksma_points mapped;
    KOKSMA__TRY(koksma_warp_points(warp, points, &mapped));
    const koksma_status status = evaluate(warp, measure, mapped.n, mapped.xs, run, &value);
    koksma_points_fini(&mapped);
    KOKSMA__TRY(status);
    if (value.exact) {
        value.lower = value.upper = value.value;
    }
    *out = value;
    return KOKSMA_OK;
}
