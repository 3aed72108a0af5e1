/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Kernels for blocks of rays (the camera, albedos, and light from rectangles) and for sample sets (conversion to
 * floats, shuffling, means). The light at a hit from one position on a light is power cos cos' / distance^2
 * (description.h), computed without square roots as power (n.d) (-n'.d) / (d.d)^2.
 */
#include <math.h>
#include <string.h>

#include "core/random.h"
#include "render/pipelines/batch_kernel.h"

void BATCH_NAME(camera)(const koksma__batch_camera *camera, const float *xy, int n, koksma__rays *rays)
{
    const koksma__batch_camera c = *camera;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < STEP(n); i++) {
            rays->o[k][i] = c.eye[k];
            rays->d[k][i] = c.base[k] + xy[2 * i] * c.step_x[k] + xy[2 * i + 1] * c.step_y[k];
        }
    }
}

static void albedo_constant(float value, int32_t id, const koksma__hits *h, int n, float *albedo)
{
    for (int i = 0; i < STEP(n); i++) {
        albedo[i] = h->material[i] == id ? value : albedo[i];
    }
}

static void albedo_checker(const koksma__batch_material *material, int32_t id, const koksma__hits *h, int n,
                           float *albedo)
{
    const koksma__batch_material m = *material;
    for (int i = 0; i < STEP(n); i++) {
        const float u = h->u[i], v = h->v[i];
        const float half = 0.5f * (floorf(m.su * u + m.sv * v + m.s0) + floorf(m.tu * u + m.tv * v + m.t0));
        const float value = half == floorf(half) ? m.albedo[0] : m.albedo[1];
        albedo[i] = h->material[i] == id ? value : albedo[i];
    }
}

void BATCH_NAME(albedo)(const koksma__batch_material *materials, const koksma__hits *hits, int n, float *albedo)
{
    int32_t most = -1;
    uint32_t least = UINT32_MAX; /* material -1, converted to an unsigned number, is larger than every index */
    for (int i = 0; i < STEP(n); i++) {
        const int32_t m = hits->material[i];
        albedo[i] = 0;
        most = m > most ? m : most;
        least = (uint32_t)m < least ? (uint32_t)m : least;
    }
    for (int32_t m = (int32_t)least; m >= 0 && m <= most; m++) {
        if (materials[m].checker) {
            albedo_checker(&materials[m], m, hits, n, albedo);
        } else {
            albedo_constant(materials[m].albedo[0], m, hits, n, albedo);
        }
    }
}

/* The loop that two kernels share: `aim`, which makes shadow rays, and `light`, which adds to `sum`. */
INLINE int send(const koksma__batch_light *light, const koksma__hits *restrict h, const float *restrict xy, int n,
                bool rays, koksma__shadows *restrict s, float *restrict sum)
{
    const koksma__v3 corner = koksma__v3_of(light->corner), normal = koksma__v3_of(light->normal);
    const koksma__v3 edge_x = koksma__v3_of(light->edge_x), edge_y = koksma__v3_of(light->edge_y);
    const float power = light->power;
    int lit = 0;
    for (int i = 0; i < STEP(n); i++) {
        const koksma__v3 on = koksma__v3_add(koksma__v3_add(corner, koksma__v3_scale(edge_x, xy[2 * i])),
                                             koksma__v3_scale(edge_y, xy[2 * i + 1]));
        const koksma__v3 d = koksma__v3_subtract(on, AT(h->p, i));
        const float square = koksma__v3_dot(d, d), at_hit = koksma__v3_dot(AT(h->n, i), d);
        const float at_light = -koksma__v3_dot(normal, d), value = power * at_hit * at_light / (square * square);
        const int facing = (at_hit > 0) & (at_light > 0);
        s->light[i] = facing ? value : 0;
        lit += facing;
        if (rays) {
            koksma__put(s->d, i, 1, d);
        } else {
            sum[i] += facing ? value : 0;
        }
    }
    return lit;
}

int BATCH_NAME(aim)(const koksma__batch_light *light, const koksma__hits *h, const float *xy, int n,
                    koksma__shadows *s)
{
    return send(light, h, xy, n, true, s, NULL);
}

int BATCH_NAME(light)(const koksma__batch_light *light, const koksma__hits *h, const float *xy, int n,
                      koksma__shadows *s, float *sum)
{
    return send(light, h, xy, n, false, s, sum);
}

void BATCH_NAME(add)(const koksma__shadows *shadows, int n, float *sum)
{
    for (int i = 0; i < STEP(n); i++) {
        sum[i] += shadows->light[i];
    }
}

void BATCH_NAME(shade)(const koksma__hits *hits, const float *albedo, const float *sum, float background, float clamp,
                       int n, float *out)
{
    for (int i = 0; i < STEP(n); i++) {
        const float value = hits->primitive[i] >= 0 ? albedo[i] * sum[i] : background;
        out[i] = value < clamp ? value : clamp;
    }
}

void BATCH_NAME(place)(const double *xs, size_t n, const float offset[2], float *to)
{
    const float last = 1 - 0x1p-24f, ox = offset[0], oy = offset[1];
    for (size_t i = 0; i < n; i++) {
        const float x = (float)xs[2 * i], y = (float)xs[2 * i + 1];
        to[2 * i] = (x < last ? x : last) + ox;
        to[2 * i + 1] = (y < last ? y : last) + oy;
    }
}

typedef struct pair {
    float x, y;
} pair;

void BATCH_NAME(shuffle)(const float *pairs, const uint32_t *words, size_t n, float *to)
{
    const pair *from = (const pair *)(const void *)pairs;
    pair *order = (pair *)(void *)to;
    for (size_t i = 0; i < n; i++) {
        const uint32_t j = koksma__below(words[i], (uint32_t)i + 1);
        order[i] = order[j];
        order[j] = from[i];
    }
}

#if defined(__AVX512F__)
enum { DOUBLES = 8 };
#elif defined(__AVX2__)
enum { DOUBLES = 4 };
#else
enum { DOUBLES = 2 };
#endif

double BATCH_NAME(mean)(const float *x, size_t n)
{
    typedef float floats __attribute__((vector_size(4 * DOUBLES)));
    typedef double doubles __attribute__((vector_size(8 * DOUBLES)));
    typedef double two __attribute__((vector_size(16)));
    doubles lanes[8 / DOUBLES] = {{0}};
    two p[4];
    const size_t whole = n / 8 * 8;
    for (size_t i = 0; i < whole; i += 8) {
        for (size_t k = 0; k < 8 / DOUBLES; k++) {
            floats some;
            memcpy(&some, x + i + k * DOUBLES, sizeof some);
            lanes[k] += __builtin_convertvector(some, doubles);
        }
    }
    for (int k = 0; k < 4; k++) {
        p[k] = (two){lanes[2 * k / DOUBLES][2 * k % DOUBLES], lanes[2 * k / DOUBLES][2 * k % DOUBLES + 1]};
    }
    for (size_t i = whole; i < n; i++) {
        p[i % 8 / 2][i % 2] += (double)x[i];
    }
    const two sum = (p[0] + p[2]) + (p[1] + p[3]);
    return (sum[0] + sum[1]) / (double)n;
}
