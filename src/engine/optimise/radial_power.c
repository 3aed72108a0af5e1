/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The measure that a search minimises to find 2D points whose power spectrum has a given radial mean. With the power
 * P(k) = (1/n) |sum_j exp(-2 pi i k.x_j)|^2, its mean p_r over the N_r frequencies k of ring r (as in
 * koksma/spectrum.h) and a target t_r, the search minimises
 *
 *     D^2 = sum_(r = 1 .. R) r (p_r - t_r)^2 / sum_r r,
 *
 * the mean square of the difference over the plane of frequencies. With sum_j exp(-2 pi i k.x_j) = C - i S,
 *
 *     d P(k) / d x_j = (4 pi k / n) (S cos(2 pi k.x_j) - C sin(2 pi k.x_j)).
 *
 * One gradient takes O(n R^2): two passes over the points for each frequency of a half plane, with the powers of
 * exp(-2 pi i x) and exp(-2 pi i y) of each point in tables. Sums are in fixed order.
 *
 * A named target is the lowest curve of its form that a stationary point set can have: the pair correlation, which is
 * 1 plus the Fourier transform of p - 1, is 0 at distance 0. For a step from 0 to 1 at the frequency f this means pi
 * f^2 = n (Heck, Schlomer & Deussen 2013), for 1 - exp(-f^2 / (2 s^2)) it means 2 pi s^2 = n, the spectrum of the
 * Ginibre process.
 */
#include "optimise/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <unistd.h>

#include "core/c_locale.h"
#include "core/elementary.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/status.h"

#include <koksma/spectrum.h>

enum { LANES = 8, SETS = 16 };

static koksma_status only_in_searches(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    (void)points, (void)args, (void)out;
    return koksma__fail(KOKSMA_ARGUMENT, "radial power: only a search can compute it (koksma_optimise)");
}

const koksma_measure koksma__measure_radial_power = {
    .name = "radial-power",
    .title = "distance of the radial power from a target",
    .min_dim = 2,
    .max_dim = 2,
    .eval = only_in_searches,
    .on_torus = true,
};

koksma_status koksma__radial_power_check(const koksma_optimise_options *o)
{
    KOKSMA__FAIL_IF(!o->power && o->rings, KOKSMA_ARGUMENT, "options->power is NULL, but rings = %d", o->rings);
    KOKSMA__FAIL_IF(o->power && (o->rings < 1 || o->rings > KOKSMA_SPECTRUM_MAX_HALF), KOKSMA_ARGUMENT,
                    "rings = %d: a target power takes 1 to %d", o->rings, KOKSMA_SPECTRUM_MAX_HALF);
    KOKSMA__FAIL_IF(o->power && o->dim != 2, KOKSMA_DIM, "dim = %d: a target power needs 2 dimensions", o->dim);
    KOKSMA__FAIL_IF(o->power && (o->n_projections || koksma__search_of_prefixes(o)), KOKSMA_ARGUMENT,
                    "a target power takes neither projections nor keep=sequence nor keep=every-prefix");
    for (int r = 0; o->power && r < o->rings; r++) {
        KOKSMA__FAIL_IF(!(o->power[r] >= 0 && o->power[r] <= KOKSMA__MOST_POWER), KOKSMA_ARGUMENT,
                        "power[%d] = %g: powers are 0 to 1e100", r, o->power[r]);
    }
    return KOKSMA_OK;
}

double koksma__radial_power_cost(const koksma_optimise_options *o)
{
    return M_PI * o->rings * o->rings * (double)o->n;
}

typedef struct job {
    size_t n, stride, rings;
    double *tables[4]; /* cos and sin of 2 pi k x, then of 2 pi k y: [k stride + point], k = 0 .. rings */
    double *c, *s;     /* cos and sin of 2 pi (kx x + ky y) of all points, for one frequency (kx, ky) */
    double *sums;      /* C and S of each frequency, in the order of find_powers */
    double *means, *counts, *slopes;
    double *moves; /* the derivatives by x of all points, then by y */
    void *memory;
    const koksma_run *run;
    size_t terms; /* summed since run was asked last */
} job;

/* Asks the run again if enough terms, of which so many come next, have been summed. */
static koksma_status ask(job *j, size_t terms)
{
    j->terms += terms;
    if (j->terms < KOKSMA__ASKED) {
        return KOKSMA_OK;
    }
    j->terms = 0;
    return koksma__ask(j->run);
}

static koksma_status job_init(job *j, const koksma_points *points, const koksma_run *run, size_t rings)
{
    const size_t n = points->n, stride = (n + LANES - 1) / LANES * LANES, table = (rings + 1) * stride;
    const size_t bytes = (4 * table + 4 * stride + 4 * (rings + 1) * (rings + 1) + 3 * (rings + 1)) * sizeof(double);
    *j = (job){.n = n, .stride = stride, .rings = rings, .memory = calloc(1, bytes), .run = run};
    KOKSMA__REQUIRE_MEMORY(j->memory, bytes);
    double *at = j->memory;
    for (int t = 0; t < 4; t++, at += table) {
        j->tables[t] = at;
    }
    j->c = at;
    j->s = j->c + stride;
    j->moves = j->s + stride;
    j->means = j->moves + 2 * stride;
    j->counts = j->means + rings + 1;
    j->slopes = j->counts + rings + 1;
    j->sums = j->slopes + rings + 1;
    return KOKSMA_OK;
}

static koksma_status find_tables(job *j, const koksma_points *points)
{
    const size_t n = j->n, stride = j->stride, rings = j->rings;
    for (int axis = 0; axis < 2; axis++) {
        double *c = j->tables[2 * axis], *s = j->tables[2 * axis + 1];
        for (size_t i = 0; i < n; i++) {
            KOKSMA__TRY(ask(j, 8 * rings)); /* a sine and a cosine take as long as some terms */
            const double angle = 2 * M_PI * points->xs[2 * i + (size_t)axis];
            for (size_t k = 0; k <= rings; k++) {
                c[k * stride + i] = koksma__cos((double)k * angle);
                s[k * stride + i] = koksma__sin((double)k * angle);
            }
        }
    }
    return KOKSMA_OK;
}

/* Returns the ring of a frequency, or 0 if it is in none of the rings. */
static size_t ring_of(const job *j, int kx, int ky)
{
    const size_t ring = (size_t)floor(koksma__hypot(kx, ky) + 0.5);
    return ring <= j->rings ? ring : 0;
}

/* Computes j->c and j->s for the frequency (kx, ky), ky >= 0. */
static void waves(const job *j, int kx, int ky)
{
    const size_t row = (size_t)abs(kx) * j->stride, column = (size_t)ky * j->stride;
    const double sign = kx < 0 ? -1 : 1;
    const double *restrict cx = j->tables[0] + row, *restrict sx = j->tables[1] + row;
    const double *restrict cy = j->tables[2] + column, *restrict sy = j->tables[3] + column;
    double *restrict c = j->c, *restrict s = j->s;
    for (size_t i = 0; i < j->stride; i++) {
        c[i] = cx[i] * cy[i] - sign * sx[i] * sy[i];
        s[i] = sign * sx[i] * cy[i] + cx[i] * sy[i];
    }
}

static double sum(const job *j, const double *xs)
{
    double lanes[LANES] = {0}, all = 0;
    for (size_t i = 0; i < j->stride; i += LANES) {
        for (size_t l = 0; l < LANES; l++) {
            lanes[l] += xs[i + l];
        }
    }
    for (size_t l = 0; l < LANES; l++) {
        all += lanes[l];
    }
    return all;
}

/* Computes C and S of all frequencies, and the mean power of each ring. */
static koksma_status find_powers(job *j)
{
    double *sums = j->sums;
    for (int ky = 0; ky <= (int)j->rings; ky++) {
        for (int kx = ky ? -(int)j->rings : 1; kx <= (int)j->rings; kx++) {
            const size_t ring = ring_of(j, kx, ky);
            if (ring) {
                KOKSMA__TRY(ask(j, j->n));
                waves(j, kx, ky);
                sums[0] = sum(j, j->c);
                sums[1] = sum(j, j->s);
                j->means[ring] += (sums[0] * sums[0] + sums[1] * sums[1]) / (double)j->n;
                j->counts[ring]++;
                sums += 2;
            }
        }
    }
    for (size_t r = 1; r <= j->rings; r++) {
        j->means[r] /= j->counts[r];
    }
    return KOKSMA_OK;
}

/* Adds the derivatives of D^2 by the coordinates of all points to j->moves. j->slopes holds the derivatives of D^2 by
   the mean power of each ring. */
static koksma_status find_gradient(job *j)
{
    const double *sums = j->sums;
    for (int ky = 0; ky <= (int)j->rings; ky++) {
        for (int kx = ky ? -(int)j->rings : 1; kx <= (int)j->rings; kx++) {
            const size_t ring = ring_of(j, kx, ky);
            if (ring) {
                KOKSMA__TRY(ask(j, j->n));
                const double scale = j->slopes[ring] / j->counts[ring] * 4 * M_PI / (double)j->n;
                const double c = scale * sums[0], s = scale * sums[1];
                waves(j, kx, ky);
                for (size_t i = 0; i < j->n; i++) {
                    const double by = s * j->c[i] - c * j->s[i];
                    j->moves[i] += kx * by;
                    j->moves[j->stride + i] += ky * by;
                }
                sums += 2;
            }
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__radial_power_square(const koksma_optimise_options *o, const koksma_points *points,
                                          const koksma_run *run, double *square, double *gradient)
{
    job j;
    const double weights = o->rings * (o->rings + 1.0) / 2;
    KOKSMA__TRY(job_init(&j, points, run, (size_t)o->rings));
    koksma_status status = find_tables(&j, points);
    status = status ? status : find_powers(&j);
    *square = 0;
    for (size_t r = 1; r <= j.rings; r++) {
        const double off = j.means[r] - o->power[r - 1];
        *square += (double)r / weights * off * off;
        j.slopes[r] = 2 * (double)r / weights * off;
    }
    if (gradient) {
        status = status ? status : find_gradient(&j);
        for (size_t i = 0; i < j.n; i++) {
            gradient[2 * i] = j.moves[i];
            gradient[2 * i + 1] = j.moves[j.stride + i];
        }
    }
    free(j.memory);
    return status;
}

/* Reads a target from a file: each line has a frequency, in units of sqrt n and higher than the one before, and a
   power. Between the frequencies of two lines the power is interpolated linearly. Below the first frequency the power
   is that of the first line; above the last frequency it is that of the last line. */
static koksma_status read_profile(const char *path, double root, int rings, double *power)
{
    unsigned char *bytes;
    size_t size;
    KOKSMA__TRY(koksma__read_file(path, KOKSMA__FILE_PARAMETERS, KOKSMA__BY_USER, koksma__check_text, &bytes, &size));
    double from = 0, to = 0, before = 0, after = 0;
    int ring = 1, line = 1, rows = 0;
    koksma_status status = KOKSMA_OK;
    for (char *at = (char *)bytes; *at && !status; line++) {
        char *end = at + strcspn(at, "\n"), *rest = at;
        at = end + (*end == '\n');
        *end = 0;
        rest[strcspn(rest, "#")] = 0;
        if (rest[strspn(rest, " \t\r,")]) {
            char *second, *last;
            from = to;
            before = after;
            to = koksma__strtod(rest, &second);
            second += strspn(second, " \t,");
            after = koksma__strtod(second, &last);
            if (second == rest || last == second || last[strspn(last, " \t\r")] || !(rows ? to > from : to >= 0) ||
                !isfinite(to) || !(after >= 0 && after <= KOKSMA__MOST_POWER)) {
                status = koksma__fail(KOKSMA_MALFORMED,
                                      "%s:%d: a line must have a frequency, in units of sqrt(n) and above the one "
                                      "before, and a power of 0 to 1e100",
                                      path, line);
            }
            for (; !status && ring <= rings && ring / root <= to; ring++) {
                power[ring - 1] = rows ? before + (after - before) * (ring / root - from) / (to - from) : after;
            }
            rows++;
        }
    }
    if (!status && !rows) {
        status = koksma__fail(KOKSMA_MALFORMED, "%s: the file has no line with a frequency and a power", path);
    }
    for (; !status && ring <= rings; ring++) {
        power[ring - 1] = after;
    }
    free(bytes);
    return status;
}

/* Computes the target from a pattern: the radial power, averaged over SETS sets of n points. */
static koksma_status power_of_pattern(const koksma_spec *pattern, size_t n, int rings, const koksma_run *run,
                                      double *power)
{
    koksma_points points;
    koksma_spectrum spectrum;
    koksma_ring *found = malloc((size_t)rings * sizeof *found);
    KOKSMA__REQUIRE_MEMORY(found, (size_t)rings * sizeof *found);
    koksma_status status = koksma_spectrum_init(&spectrum, rings);
    status = status ? status : koksma_points_init(&points, n, 2);
    if (!status) {
        for (uint64_t seed = 0; seed < SETS && !status; seed++) {
            status = koksma_generate(pattern, seed, run, &points);
            status = status ? status : koksma_spectrum_add(&spectrum, &points, KOKSMA_SPECTRUM_EXACT, run);
        }
        status = status ? status : koksma_spectrum_rings(&spectrum, found);
        koksma_points_fini(&points);
    }
    for (int r = 0; r < rings && !status; r++) {
        power[r] = found[r].power;
    }
    koksma_spectrum_fini(&spectrum);
    free(found);
    return status;
}

koksma_status koksma_radial_power(const char *text, size_t n, int rings, const koksma_run *run, double *power)
{
    KOKSMA__REQUIRE(text, power);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(n < 1 || n > KOKSMA_MAX_COORDINATES / 2, KOKSMA_N,
                    "n = %zu: a radial power needs 1 to %zu points", n, (size_t)KOKSMA_MAX_COORDINATES / 2);
    KOKSMA__FAIL_IF(rings < 1 || rings > KOKSMA_SPECTRUM_MAX_HALF, KOKSMA_ARGUMENT,
                    "rings = %d: a radial power needs 1 to %d", rings, KOKSMA_SPECTRUM_MAX_HALF);
    const bool step = !strcmp(text, "step");
    koksma_spec pattern;
    if (step || !strcmp(text, "gaussian")) {
        for (int r = 1; r <= rings; r++) {
            const double area = M_PI * r * r / (double)n;
            power[r - 1] = step ? area >= 1 : 1 - koksma__exp(-area);
        }
        return KOKSMA_OK;
    }
    const koksma_status status = koksma_pattern_spec(text, &pattern);
    if (status == KOKSMA_UNKNOWN) {
        KOKSMA__FAIL_IF(access(text, F_OK) && strcmp(text, "-") != 0, KOKSMA_MISSING,
                        "%s: it is not step, gaussian, a pattern or a file of frequencies and powers", text);
        return read_profile(text, sqrt((double)n), rings, power);
    }
    return status ? status : power_of_pattern(&pattern, n, rings, run, power);
}
