/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A homogeneous medium in an axis-parallel box, in a ball or cube under a matrix, or everywhere. Over the length s a ray
 * keeps the fraction T(s) = exp(-(a + b) s) of its light, the transmittance, with the coefficients of absorption a and of
 * scattering b, and gains the light that the medium scatters into it (Pharr, Jakob & Humphreys, chapter 11):
 *
 *     L(o, d) = T(end) L(end)   +   integral of T(s) b (integral of p(d, w) L(o + s d, w) dw) ds
 *
 * Each path samples one of the two terms on the right. A colour channel is chosen with probability proportional to
 * the path's weights beta, and a distance s with the density (a + b) T(s) of that channel. If s is beyond the end of
 * the ray, the light comes from that end, otherwise from the medium at s. The weight is divided by the mean of the
 * channels' densities, weighted by the same probabilities (the balance heuristic), so that every channel is unbiased,
 * whichever was chosen, and the sum of the weights beta never grows. If all channels have equal coefficients, the
 * weights are exactly b / (a + b) and 1. A medium that only absorbs needs no random number.
 *
 * The phase function of Henyey & Greenstein (1941), with the mean cosine g between the directions before and after, is
 *
 *     p(c) = (1 - g^2) / (4 pi (1 + g^2 - 2 g c)^(3/2))
 *
 * Its inverse cumulative distribution samples it exactly, so that the weight of a direction is 1. exp and log are those of
 * core/elementary.h, whose bits are the same everywhere.
 */
#include "render/medium.h"

#include <float.h>
#include <math.h>

#include "core/elementary.h"
#include "core/status.h"
#include "core/vector.h"
#include "render/lights/lights.h"
#include "render/vector3.h"

void koksma__medium_init(koksma__medium *m, const double absorption[3], const double scattering[3], double g)
{
    *m = (koksma__medium){.is_there = true,
                          .low = {-INFINITY, -INFINITY, -INFINITY},
                          .high = {INFINITY, INFINITY, INFINITY},
                          .phase = {.bsdf = &koksma__phase_function, .values = {g}}};
    for (int k = 0; k < 3; k++) {
        m->absorption[k] = absorption[k];
        m->scattering[k] = scattering[k];
        m->phase.albedo[0][k] = scattering[k] > 0 ? scattering[k] / (absorption[k] + scattering[k]) : 0;
    }
}

koksma_status koksma__medium_check(const koksma_scene *scene)
{
    const koksma__medium *m = &scene->medium;
    bool endless = false;
    for (int k = 0; m->is_there && k < 3; k++) {
        endless |= !isfinite(m->low[k]) || !isfinite(m->high[k]);
    }
    KOKSMA__FAIL_IF(endless && (scene->background[0] > 0 || scene->background[1] > 0 || scene->background[2] > 0),
                    KOKSMA_MALFORMED,
                    "a medium without bounds lets no light of the background through; give it 'low' and 'high'");
    for (size_t i = 0; endless && i < scene->n_lights; i++) {
        KOKSMA__FAIL_IF(scene->lights[i].kind->distance != KOKSMA__LIGHT_NEAR, KOKSMA_MALFORMED,
                        "a medium without bounds lets no light of the %s light through; give it 'low' and 'high'",
                        scene->lights[i].kind->kind.name);
    }
    return KOKSMA_OK;
}

/* fmin and fmax of numbers that are not NaN, inline. */
static double smaller(double a, double b)
{
    return a < b ? a : b;
}

static double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Narrows [*first, *last] to where o + t d is in a box. */
static void cut_by_box(const double low[3], const double high[3], const double o[3], const double d[3], double *first,
                       double *last)
{
    for (int k = 0; k < 3; k++) {
        const double below = low[k] - o[k], above = high[k] - o[k];
        if (d[k] == 0) {
            *last = below > 0 || above < 0 ? 0 : *last;
            continue;
        }
        *first = larger(*first, (d[k] > 0 ? below : above) / d[k]);
        *last = smaller(*last, (d[k] > 0 ? above : below) / d[k]);
    }
}

/* The same for the unit ball: |q + (t - middle) d|^2 = 1, with the line's point q that is nearest to the centre. */
static void cut_by_ball(const double o[3], const double d[3], double *first, double *last)
{
    const double square = koksma__dot(d, d), middle = -koksma__dot(o, d) / square;
    double q[3];
    for (int k = 0; k < 3; k++) {
        q[k] = o[k] + middle * d[k];
    }
    const double rest = 1 - koksma__dot(q, q), reach = sqrt(larger(rest, 0) / square);
    *first = larger(*first, middle - reach);
    *last = rest > 0 ? smaller(*last, middle + reach) : 0;
}

koksma__stretch koksma__medium_stretch(const koksma__medium *m, const float origin[3], const float direction[3],
                                       double end)
{
    static const double low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    const double o[3] = {(double)origin[0], (double)origin[1], (double)origin[2]};
    const double d[3] = {(double)direction[0], (double)direction[1], (double)direction[2]};
    const double speed = sqrt(koksma__dot(d, d));
    double first = 0, last = end, from[3], along[3];
    for (int k = 0; m->in_shape && k < 3; k++) {
        from[k] = koksma__dot(m->inverse + 4 * k, o) + m->inverse[4 * k + 3];
        along[k] = koksma__dot(m->inverse + 4 * k, d);
    }
    if (!m->in_shape) {
        cut_by_box(m->low, m->high, o, d, &first, &last);
    } else if (m->is_ball) {
        cut_by_ball(from, along, &first, &last);
    } else {
        cut_by_box(low, high, from, along, &first, &last);
    }
    /* the length is limited to a finite number, so that a channel with the coefficient 0 has transmittance 1 at any
       length */
    return (koksma__stretch){first, last > first ? smaller((last - first) * speed, DBL_MAX) : 0, speed};
}

/* ---- The phase function --------------------------------------------------------------------------------------- */

static double density_of(double g, double cosine)
{
    const double square = fmax(1 + g * g - 2 * g * cosine, DBL_MIN);
    return (1 - g * g) / (4 * M_PI * square * sqrt(square));
}

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float out[3])
{
    (void)lobes;
    out[0] = out[1] = out[2] = (float)density_of((double)s->material->values[0], -(double)koksma__dot3(s->out, w));
    return out[0];
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    const double g = (double)s->material->values[0], part = (1 - g * g) / (1 - g + 2 * g * (double)u[1]);
    const double cosine =
        fabs(g) < 1e-6 ? 1 - 2 * (double)u[1] : fmax(-1, fmin((1 + g * g - part * part) / (2 * g), 1));
    const float sine = (float)sqrt(1 - cosine * cosine);
    float x, y;
    (void)lobes;
    (void)choice;
    koksma__sine_cosine_turns(u[0], &y, &x);
    const koksma__v3 forward = {-s->out[0], -s->out[1], -s->out[2]};
    koksma__v3_to(koksma__v3_about(forward, sine * x, sine * y, (float)cosine), out->w);
    out->weight[0] = out->weight[1] = out->weight[2] = 1;
    out->pdf = (float)density_of(g, cosine);
    out->lobe = KOKSMA__LOBE_DIFFUSE;
    return true;
}

const koksma__bsdf koksma__phase_function = {.kind = {.name = "henyey-greenstein",
                                                      .title = "the phase function of a medium",
                                                      .cite = "henyey1941",
                                                      .is_implied = true},
                                             .lobes = KOKSMA__LOBE_DIFFUSE,
                                             .reciprocal = true,
                                             .form = KOKSMA__FORM_RAYS,
                                             .value = value,
                                             .sample = sample};
