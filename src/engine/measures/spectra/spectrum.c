/* SPDX-License-Identifier: Apache-2.0 */
/* Power spectra and the quality numbers derived from them, defined in koksma/spectrum.h: the radial mean and the
   anisotropy after Ulichney 1987; the effective Nyquist frequency and the oscillation after Heck, Schlomer and
   Deussen 2013. Means over sets of points and their standard errors are updated set by set (Welford 1962), so that
   equal sets give an error of exactly 0. */
#include "measures/spectra/spectra.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/point_files.h"
#include "core/points.h"
#include "core/status.h"

/* Constants in the definitions of the quality numbers, which koksma/spectrum.h explains. */
#define NYQUIST_SHARE 0.1
#define SIGNAL_SHARE 0.5
#define RISEN 0.98
#define BAND 5.0

static size_t side_of(int half)
{
    return 2 * (size_t)half + 1;
}

koksma_status koksma_spectrum_init(koksma_spectrum *spectrum, int half)
{
    KOKSMA__REQUIRE(spectrum);
    *spectrum = (koksma_spectrum){0};
    KOKSMA__FAIL_IF(half < 1 || half > KOKSMA_SPECTRUM_MAX_HALF, KOKSMA_ARGUMENT,
                    "spectrum: half = %d: it takes 1 to %d", half, KOKSMA_SPECTRUM_MAX_HALF);
    const size_t rows = (size_t)half + 1, count = rows * side_of(half);
    const size_t bytes = rows * sizeof(koksma_tally) + count * sizeof(double);
    spectrum->rings = calloc(1, bytes);
    KOKSMA__REQUIRE_MEMORY(spectrum->rings, bytes);
    spectrum->power = (double *)(spectrum->rings + rows);
    spectrum->half = half;
    return KOKSMA_OK;
}

void koksma_spectrum_fini(koksma_spectrum *spectrum)
{
    if (spectrum) {
        free(spectrum->rings);
        *spectrum = (koksma_spectrum){0};
    }
}

/* A loop over the frequencies k = (kx, ky) of the rings 1 .. half, with only one of k and -k. No |k| is exactly
   between two rings, because (r + 1/2)^2 is not a whole number. */
#define FOR_EACH_FREQUENCY(half, kx, ky, ring)                                                                       \
    for (int ky = 0; ky <= (half); ky++)                                                                             \
        for (int kx = ky ? -(half) : 1; kx <= (half); kx++)                                                          \
            for (int ring = (int)(sqrt((double)(kx * kx + ky * ky)) + 0.5), once_ = 1; once_ && ring <= (half);      \
                 once_ = 0)

static double power_at(int half, const double *power, int kx, int ky)
{
    return power[(size_t)ky * side_of(half) + (size_t)(half + kx)];
}

/* Computes the mean power of each ring and its number of frequencies. */
static void find_means(int half, const double *power, double *means, double *counts)
{
    FOR_EACH_FREQUENCY(half, kx, ky, ring)
    {
        means[ring] += power_at(half, power, kx, ky);
        counts[ring] += 1;
    }
    for (int ring = 1; ring <= half; ring++) {
        means[ring] /= counts[ring];
    }
}

koksma_status koksma__spectrum_check(const koksma_spectrum *spectrum)
{
    return spectrum->power && spectrum->rings && spectrum->half >= 1 && spectrum->half <= KOKSMA_SPECTRUM_MAX_HALF
               ? KOKSMA_OK
               : koksma__fail(KOKSMA_ARGUMENT, "spectrum: call koksma_spectrum_init first");
}

koksma_status koksma_spectrum_add(koksma_spectrum *spectrum, const koksma_points *points,
                                  koksma_spectrum_method method, const koksma_run *run)
{
    KOKSMA__REQUIRE(spectrum, points);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(points->dim != 2, KOKSMA_DIM, "spectrum: it has no %d-dimensional form, only dim = 2",
                    points->dim);
    KOKSMA__TRY(koksma__spectrum_check(spectrum));
    KOKSMA__TRY(koksma__points_check(points));
    KOKSMA__FAIL_IF(method != KOKSMA_SPECTRUM_EXACT && method != KOKSMA_SPECTRUM_FAST, KOKSMA_ARGUMENT,
                    "spectrum: there is no method %d", (int)method);
    const size_t rows = (size_t)spectrum->half + 1, count = rows * side_of(spectrum->half);
    double *power = calloc(count + 2 * rows, sizeof *power), *means = power + count;
    KOKSMA__REQUIRE_MEMORY(power, (count + 2 * rows) * sizeof *power);
    const koksma_status status = (method == KOKSMA_SPECTRUM_EXACT ? koksma__power_exact : koksma__power_fast)(
        points, spectrum->half, run, power);
    if (!status) {
        spectrum->sets++;
        const double sets = (double)spectrum->sets;
        for (size_t i = 0; i < count; i++) {
            spectrum->power[i] += (power[i] - spectrum->power[i]) / sets;
        }
        find_means(spectrum->half, power, means, means + rows);
        for (size_t ring = 1; ring < rows; ring++) {
            koksma_tally_add(&spectrum->rings[ring], means[ring]);
        }
        spectrum->points += ((double)points->n - spectrum->points) / sets;
    }
    free(power);
    return status;
}

double koksma_spectrum_power(const koksma_spectrum *spectrum, int kx, int ky)
{
    KOKSMA__REQUIRE_OR(NAN, spectrum);
    const int half = spectrum->half;
    if (koksma__spectrum_check(spectrum) || kx < -half || kx > half || ky < -half || ky > half) {
        return NAN;
    }
    return power_at(half, spectrum->power, ky < 0 ? -kx : kx, abs(ky));
}

koksma_status koksma_spectrum_write(const char *path, const koksma_spectrum *spectrum)
{
    KOKSMA__REQUIRE(path, spectrum);
    const int half = spectrum->half;
    const size_t side = side_of(half);
    KOKSMA__TRY(koksma__spectrum_check(spectrum));
    double *grid = malloc(side * side * sizeof *grid);
    KOKSMA__REQUIRE_MEMORY(grid, side * side * sizeof *grid);
    for (int ky = -half; ky <= half; ky++) {
        for (int kx = -half; kx <= half; kx++) {
            grid[(size_t)(half + ky) * side + (size_t)(half + kx)] = koksma_spectrum_power(spectrum, kx, ky);
        }
    }
    const koksma_points rows = {side, (int)side, grid};
    const koksma_status written =
        koksma__numbers_write(path, &rows, "power, one row for each ky, from -half up; one column for each kx", NULL);
    free(grid);
    return written;
}

/* The sums over n points from the method FAST have errors of up to AMPLITUDE n. A power below AMPLITUDE^2 n can thus
   not be distinguished from 0, and powers that differ by less than their errors can not be distinguished from each
   other. */
#define AMPLITUDE 1e-9

static double anisotropy_db(double points, double power, double variance)
{
    const double rounding = 2 * AMPLITUDE * sqrt(points / power), relative = variance / (power * power);
    if (!(power > AMPLITUDE * AMPLITUDE * points)) {
        return NAN;
    }
    return relative > rounding * rounding ? 10 * koksma__log10(relative) : -(double)INFINITY;
}

koksma_status koksma_spectrum_rings(const koksma_spectrum *spectrum, koksma_ring *rings)
{
    KOKSMA__REQUIRE(spectrum, rings);
    KOKSMA__TRY(koksma__spectrum_check(spectrum));
    const int half = spectrum->half;
    const size_t rows = (size_t)half + 1;
    double *means = calloc(3 * rows, sizeof *means), *counts = means + rows, *spreads = counts + rows;
    KOKSMA__REQUIRE_MEMORY(means, 3 * rows * sizeof *means);
    find_means(half, spectrum->power, means, counts);
    FOR_EACH_FREQUENCY(half, kx, ky, ring)
    {
        const double off = power_at(half, spectrum->power, kx, ky) - means[ring];
        spreads[ring] += off * off;
    }
    for (int ring = 1; ring <= half; ring++) {
        const koksma_tally *t = &spectrum->rings[ring];
        const double variance = spreads[ring] / (counts[ring] - 1);
        rings[ring - 1] = (koksma_ring){ring, t->mean, koksma_tally_error(t),
                                        anisotropy_db(spectrum->points, means[ring], variance)};
    }
    free(means);
    return KOKSMA_OK;
}

/* Returns the oscillation over a band of rings: the band begins at the first ring whose mean exceeds RISEN (about 1)
   and is BAND sqrt(n) rings wide, for any size of the spectrum. The result is NaN if the band ends beyond the
   spectrum. */
static double oscillation(const koksma_spectrum *s)
{
    int from = 1;
    while (from <= s->half && s->rings[from].mean < RISEN) {
        from++;
    }
    const double to = from + BAND * sqrt(s->points);
    double waves = 0, area = 0;
    for (int ring = from; ring <= s->half && ring <= to; ring++) {
        const double off = s->rings[ring].mean - 1;
        waves += ring * off * off;
        area += ring;
    }
    return to <= s->half ? 10 * sqrt(waves / area) : (double)NAN;
}

void koksma_spectrum_quality(const koksma_spectrum *spectrum, koksma_spectrum_quality_values *out)
{
    KOKSMA__REQUIRE_OR(, spectrum, out);
    if (koksma__spectrum_check(spectrum)) {
        return;
    }
    const double lattice = sqrt(spectrum->points) / 2;
    double energy = 0, area = 0;
    int last = 0;
    bool ended = false;
    for (int ring = 1; ring <= spectrum->half && !ended; ring++) {
        energy += ring * spectrum->rings[ring].mean;
        area += ring;
        last = energy <= NYQUIST_SHARE * area ? ring : last;
        ended = ring >= lattice && energy > SIGNAL_SHARE * area;
    }
    const double effective = ended ? last / 2.0 : (double)NAN;
    *out = (koksma_spectrum_quality_values){effective, effective / lattice, oscillation(spectrum)};
}
