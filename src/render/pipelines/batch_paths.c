/* SPDX-License-Identifier: Apache-2.0 */
/* Operations on blocks of paths: camera rays, the sample pairs of paths, the light that they carry, Russian
   roulette, and the compaction of paths that continue to the next bounce, which keeps lanes full. */
#include <string.h>

#include "render/pipelines/batch_kernel.h"
#include "render/pipelines/vertices.h"

void BATCH_NAME(pairs)(const float *restrict pairs, const uint32_t *restrict sample, int n, float *restrict x,
                       float *restrict y)
{
#ifdef __AVX512F__
    const __m512i odd = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
    for (int i = 0; i < STEP(n); i += 16) { /* pairs are gathered as doubles, 8 at once */
        const __m512d low = _mm512_i32gather_pd(_mm256_load_si256((const void *)(sample + i)), pairs, 8);
        const __m512d high = _mm512_i32gather_pd(_mm256_load_si256((const void *)(sample + i + 8)), pairs, 8);
        const __m512 first = _mm512_castpd_ps(low), second = _mm512_castpd_ps(high);
        _mm512_store_ps(x + i, _mm512_permutex2var_ps(first, _mm512_sub_epi32(odd, _mm512_set1_epi32(1)), second));
        if (y) {
            _mm512_store_ps(y + i, _mm512_permutex2var_ps(first, odd, second));
        }
    }
#else
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        x[i] = pairs[2 * (size_t)sample[i]];
    }
    if (y) {
        LANES_APART
        for (int i = 0; i < STEP(n); i++) {
            y[i] = pairs[2 * (size_t)sample[i] + 1];
        }
    }
#endif
}

void BATCH_NAME(to_disk)(int n, float *restrict x, float *restrict y)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        float a, b;
        koksma__concentric(x[i], y[i], &a, &b);
        x[i] = a;
        y[i] = b;
    }
}

/* The time of a ray, clamped to [0, 1]: before time 0 and after time 1 nothing moves. */
INLINE float time_of(const koksma__batch_camera *c, float u)
{
    const float time = c->open + c->interval * u, late = time < 1 ? time : 1;
    return late > 0 ? late : 0;
}

void BATCH_NAME(start)(const koksma__batch_camera *camera, const float *restrict xy, const float *x, const float *y,
                       const float *u, int n, struct koksma__paths *restrict to)
{
    static const koksma__lanes none;
    const koksma__batch_camera c = *camera;
    const float *restrict lens_x = x ? x : none, *restrict lens_y = x ? y : none, *restrict times = u ? u : none;
    const float inverse = x ? 1 / c.focus : 0;
    for (int k = 0; k < 3; k++) {
        float *restrict ok = to->rays.o[k], *restrict dk = to->rays.d[k];
        LANES_APART
        for (int i = 0; i < STEP(n); i++) {
            const float shift = c.radius * (lens_x[i] * c.right[k] + lens_y[i] * c.down[k]);
            const float time = time_of(&c, times[i]);
            ok[i] = c.eye[k] + time * c.motion[k] + shift;
            dk[i] = c.base[k] + xy[2 * i] * c.step_x[k] + xy[2 * i + 1] * c.step_y[k] - shift * inverse;
            to->beta[k][i] = 1;
            to->n[k][i] = 0;
        }
    }
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        to->rays.time[i] = time_of(&c, times[i]);
        to->pdf[i] = 0;
        to->from[i] = -1;
    }
}

void BATCH_NAME(background)(const float *background, struct koksma__vertices *restrict v)
{
    const koksma__paths *restrict p = v->paths;
    const koksma__v3 light = koksma__v3_of(background), none = {0, 0, 0};
    LANES_APART
    for (int i = 0; i < STEP(v->whole); i++) {
        const koksma__v3 seen = koksma__v3_times(AT(p->beta, i), light);
        koksma__put(v->light, i, 1, koksma__either(v->hits.primitive[i] < 0, seen, none));
    }
}

void BATCH_NAME(collect)(const koksma__shadows *restrict shadows, const float (*restrict reflected)[KOKSMA__BLOCK],
                         struct koksma__vertices *restrict v)
{
    const koksma__paths *restrict p = v->paths;
    LANES_APART
    for (int i = 0; i < STEP(v->whole); i++) {
        const koksma__v3 light = koksma__v3_times(AT(p->beta, i), AT(reflected, i));
        koksma__put(v->light, i, shadows->light[i] > 0, koksma__v3_add(AT(v->light, i), light));
    }
}

INLINE float largest(koksma__v3 v)
{
    return koksma__larger(koksma__larger(v.x, v.y), v.z);
}

int BATCH_NAME(weigh)(const koksma__paths *restrict p, int n, struct koksma__directions *restrict to)
{
    int dim = 0;
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const koksma__v3 weight = koksma__v3_times(AT(p->beta, i), AT(to->weight, i));
        const float most = largest(weight);
        koksma__put(to->weight, i, 1, weight);
        to->kept[i] = (to->kept[i] != 0) & (most > 0);
        dim += to->kept[i] & (most < 1);
    }
    return dim;
}

void BATCH_NAME(roulette)(const float *restrict u, int n, struct koksma__directions *restrict to)
{
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        const float most = largest(AT(to->weight, i));
        const int plays = (to->kept[i] != 0) & (most < 1);
        const float scale = 1 / (plays ? most : 1);
        to->kept[i] = (to->kept[i] != 0) & (!plays | (u[i] < most));
        koksma__put(to->weight, i, 1, koksma__v3_scale(AT(to->weight, i), scale));
    }
}

/* Copies the picked lanes to an array of the block to[0], from lane `at` on, and the rest to that of the block to[1]. */
static void move(const void *from, const koksma__picks *p, int at, void *to)
{
    KOKSMA__LANES(uint32_t, moved);
    const int room = KOKSMA__BLOCK - at, n = p->n < room ? p->n : room;
    koksma__batch_pull(from, p, moved);
    memcpy((uint32_t *)to + at, moved, (size_t)n * sizeof *moved);
    if (n < p->n) {
        memcpy((char *)to + sizeof(koksma__paths), moved + n, (size_t)(p->n - n) * sizeof *moved);
    }
}

/* Times and normals are copied only if later kernels read them. */
int BATCH_NAME(close_up)(const struct koksma__vertices *restrict v, const struct koksma__directions *restrict d,
                         struct koksma__paths *restrict to, int at)
{
    const koksma__hits *h = &v->hits;
    KOKSMA__LANES(int32_t, kept);
    koksma__picks p;
    memcpy(kept, d->kept, sizeof kept);
    memset(kept + v->n, 0, (size_t)(v->whole - v->n) * sizeof *kept);
    koksma__batch_pick(kept, v->whole, &p);
    for (int k = 0; k < 3; k++) {
        move(h->p[k], &p, at, to->rays.o[k]);
        move(d->w[k], &p, at, to->rays.d[k]);
        move(d->weight[k], &p, at, to->beta[k]);
    }
    move(d->pdf, &p, at, to->pdf);
    move(h->primitive, &p, at, to->from);
    move(v->paths->sample, &p, at, to->sample);
    if (v->moves) {
        move(v->paths->rays.time, &p, at, to->rays.time);
    }
    for (int k = 0; v->chooses && k < 3; k++) {
        move(h->n[k], &p, at, to->n[k]);
    }
    return p.n;
}
