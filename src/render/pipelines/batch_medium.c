/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The medium for blocks of rays, by the formulas of medium.c. Rays through a medium in a box, which may be endless, are cut
 * in lanes, those through other shapes one by one.
 */
#include <math.h>

#include "core/elementary.h"
#include "render/medium.h"
#include "render/pipelines/batch_kernel.h"
#include "render/pipelines/vertices.h"

typedef double numbers[KOKSMA__BLOCK];

/* The parts of rays inside the medium. */
typedef struct stretches {
    _Alignas(64) numbers first, last, length, speed;
} stretches;

/* Sets first and last; last has the ends of the rays before. */
static void cut(const koksma__medium *m, const koksma__lanes *restrict o, const koksma__lanes *restrict d, int n,
                stretches *restrict to)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        to->first[i] = 0;
    }
    for (int k = 0; k < 3; k++) {
        const float *restrict from = o[k], *restrict along = d[k];
        const double low = m->low[k], high = m->high[k];
        LANES_APART
        for (int i = 0; i < STEP(n); i++) {
            const double below = low - (double)from[i], above = high - (double)from[i], by = (double)along[i];
            const double in = (by > 0 ? below : above) / by, out = (by > 0 ? above : below) / by;
            const double first = to->first[i], last = to->last[i];
            const double outside = ((below > 0) | (above < 0)) != 0 ? 0 : last;
            to->first[i] = by == 0 ? first : first > in ? first : in;
            to->last[i] = by == 0 ? outside : last < out ? last : out;
        }
    }
}

static void stretches_of(const koksma__medium *m, const koksma__lanes *restrict o, const koksma__lanes *restrict d,
                         int n, stretches *restrict to)
{
    if (m->in_shape) {
        for (int i = 0; i < n; i++) {
            const float from[3] = {o[0][i], o[1][i], o[2][i]}, along[3] = {d[0][i], d[1][i], d[2][i]};
            const koksma__stretch s = koksma__medium_stretch(m, from, along, to->last[i]);
            to->first[i] = s.first;
            to->length[i] = s.length;
            to->speed[i] = s.speed;
        }
        return;
    }
    cut(m, o, d, n, to);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const double dx = (double)d[0][i], dy = (double)d[1][i], dz = (double)d[2][i];
        const double speed = sqrt(dx * dx + dy * dy + dz * dz), first = to->first[i], last = to->last[i];
        const double length = (last - first) * speed, finite = length < DBL_MAX ? length : DBL_MAX;
        to->speed[i] = speed;
        to->length[i] = last > first ? finite : 0;
    }
}

/* exp(-coefficient length) */
static void pass(double coefficient, const double *restrict length, int n, double *restrict out)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        out[i] = koksma__exp(-coefficient * length[i]);
    }
}

/* What a channel of a block of rays keeps. */
typedef struct channels {
    _Alignas(64) numbers share[3];
    _Alignas(64) numbers passed[3];
} channels;

/* Chooses a channel in each lane in proportion to beta: sets its coefficient, and makes u a number for the distance. */
static void choose(const koksma__medium *m, const koksma__paths *restrict p, int n, channels *restrict to,
                   double *restrict u, double *restrict coefficient)
{
    const double e0 = koksma__medium_extinction(m, 0), e1 = koksma__medium_extinction(m, 1);
    const double e2 = koksma__medium_extinction(m, 2);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const double x = (double)p->beta[0][i], y = (double)p->beta[1][i], z = (double)p->beta[2][i];
        const double sum = x + y + z, third = 1.0 / 3;
        const double sx = sum > 0 ? x / sum : third, sy = sum > 0 ? y / sum : third, sz = sum > 0 ? z / sum : third;
        const int past = u[i] >= sx;
        const double after = past ? u[i] - sx : u[i];
        const int last = past & (after >= sy);
        const double rest = last ? after - sy : after, share = last ? sz : past ? sy : sx, part = rest / share;
        const double below = part < 1 - 0x1p-30 ? part : 1 - 0x1p-30, in = 0 > below ? 0 : below;
        to->share[0][i] = sx;
        to->share[1][i] = sy;
        to->share[2][i] = sz;
        coefficient[i] = last ? e2 : past ? e1 : e0;
        u[i] = share > 0 ? in : 0;
    }
}

/* Sets the distances at which rays scatter if the medium goes on, by the random numbers u. */
static void distances(const double *restrict u, const double *restrict coefficient, int n, double *restrict out)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const double distance = -koksma__log_scaled(1 - u[i], 0) / coefficient[i];
        out[i] = coefficient[i] > 0 ? distance : (double)INFINITY;
    }
}

/* Sets the weights of the channels of rays that scatter, or not, after the distance `along`. */
static void weigh(const koksma__medium *m, const double *restrict along, const int32_t *restrict scatters, int n,
                  channels *restrict c, koksma__lanes *restrict weight)
{
    const double e0 = koksma__medium_extinction(m, 0), e1 = koksma__medium_extinction(m, 1);
    const double e2 = koksma__medium_extinction(m, 2);
    const double s0 = m->scattering[0], s1 = m->scattering[1], s2 = m->scattering[2];
    pass(e0, along, n, c->passed[0]);
    pass(e1, along, n, c->passed[1]);
    pass(e2, along, n, c->passed[2]);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const double x = c->passed[0][i], y = c->passed[1][i], z = c->passed[2][i];
        const int in = scatters[i];
        const double density = c->share[0][i] * (in ? e0 : 1) * x + c->share[1][i] * (in ? e1 : 1) * y +
                               c->share[2][i] * (in ? e2 : 1) * z;
        weight[0][i] = (float)((in ? s0 : 1) * x / density);
        weight[1][i] = (float)((in ? s1 : 1) * y / density);
        weight[2][i] = (float)((in ? s2 : 1) * z / density);
    }
}

/* Puts the hits of rays that scatter into the medium. */
static void enter(const koksma__rays *restrict r, const int32_t *restrict scatters, const float *restrict t,
                  int32_t material, int n, koksma__hits *restrict h)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const int in = scatters[i];
        h->t[i] = in ? t[i] : h->t[i];
        koksma__put(h->p, i, in, koksma__v3_add(AT(r->o, i), koksma__v3_scale(AT(r->d, i), t[i])));
        koksma__put(h->n, i, in, (koksma__v3){0, 0, 0});
        h->u[i] = in ? 0 : h->u[i];
        h->v[i] = in ? 0 : h->v[i];
        h->back[i] = in ? 1 : h->back[i]; /* counts as a back, because the back of a surface emits no light */
        h->primitive[i] = in ? 0 : h->primitive[i];
        h->material[i] = in ? material : h->material[i];
    }
}

void BATCH_NAME(travel)(const struct koksma__medium *m, const float *restrict us, int32_t material, int n,
                        struct koksma__paths *paths, koksma__hits *h)
{
    const bool dark = m->scattering[0] == 0 && m->scattering[1] == 0 && m->scattering[2] == 0;
    const bool grey = koksma__medium_is_grey(m);
    const double coefficient = koksma__medium_extinction(m, 0);
    stretches s;
    channels c;
    _Alignas(64) numbers u, by, distance;
    _Alignas(64) koksma__lanes weight[3], t;
    KOKSMA__LANES(int32_t, scatters);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        s.last[i] = h->primitive[i] < 0 ? (double)INFINITY : (double)h->t[i];
        u[i] = (double)us[i];
        by[i] = coefficient;
    }
    stretches_of(m, paths->rays.o, paths->rays.d, n, &s);
    if (!dark && !grey) {
        choose(m, paths, n, &c, u, by);
    }
    distances(u, by, n, distance);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        scatters[i] = !dark & (distance[i] < s.length[i]);
        t[i] = (float)(s.first[i] + distance[i] / s.speed[i]);
        distance[i] = scatters[i] ? distance[i] : s.length[i];
    }
    for (int k = 0; k < 3; k++) {
        const double part = m->scattering[k] / coefficient;
        if (dark) {
            pass(koksma__medium_extinction(m, k), s.length, n, c.passed[k]);
        }
        for (int i = 0; (dark || grey) && i < STEP(n); i++) {
            weight[k][i] = (float)(dark ? c.passed[k][i] : scatters[i] ? part : 1);
        }
    }
    if (!dark && !grey) {
        weigh(m, distance, scatters, n, &c, weight);
    }
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < STEP(n); i++) {
            paths->beta[k][i] *= weight[k][i];
        }
    }
    enter(&paths->rays, scatters, t, material, n, h);
}

void BATCH_NAME(attenuate)(const struct koksma__medium *m, const koksma__hits *h, const koksma__shadows *shadows,
                           int n, float (*restrict light)[KOKSMA__BLOCK])
{
    stretches s;
    _Alignas(64) numbers passed;
    for (int i = 0; i < STEP(n); i++) {
        s.last[i] = 1;
    }
    stretches_of(m, h->p, shadows->d, n, &s);
    for (int k = 0; k < 3; k++) {
        if (!k || koksma__medium_extinction(m, k) != koksma__medium_extinction(m, k - 1)) {
            pass(koksma__medium_extinction(m, k), s.length, n, passed);
        }
        for (int i = 0; i < STEP(n); i++) {
            light[k][i] *= (float)passed[i];
        }
    }
}
