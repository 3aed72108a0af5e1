/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A distribution ray tracer on koksma/sampler.h alone: a sphere on a floor under a square light, seen through a lens.
 *
 *     cc -O2 -Iinclude examples/tiny_renderer.c -lm -o tiny && ./tiny 16 > tiny.ppm
 *
 * Each use of random numbers has a domain of its own, made from the pixel's; sample i of each use is well spread, and
 * no counter of dimensions runs along.
 */
#include <koksma/sampler.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct vec {
    double x, y, z;
} vec;

typedef struct hit {
    double t;
    vec at, normal, colour;
} hit;

enum { WIDTH = 160, HEIGHT = 120 };
enum { USE_FILM, USE_LENS, USE_LIGHT }; /* what samples are for */

static vec add(vec a, vec b)
{
    vec v = {a.x + b.x, a.y + b.y, a.z + b.z};
    return v;
}

static vec mul(vec a, double s)
{
    vec v = {a.x * s, a.y * s, a.z * s};
    return v;
}

static double dot(vec a, vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vec unit(vec a)
{
    return mul(a, 1 / sqrt(dot(a, a)));
}

/* The nearest of the floor (y = 0) and the unit sphere at (0, 1, 0). */
static int trace(vec from, vec way, hit *h)
{
    const vec centre = {0, 1, 0}, white = {0.7, 0.7, 0.7}, red = {0.7, 0.2, 0.1}, up = {0, 1, 0};
    const vec to = add(from, mul(centre, -1));
    const double b = dot(to, way), c = dot(to, to) - 1, discriminant = b * b - c;
    h->t = INFINITY;
    h->at = from;
    if (way.y < 0) {
        h->t = -from.y / way.y;
        h->at = add(from, mul(way, h->t));
        h->normal = up;
        h->colour = white;
    }
    if (discriminant > 0 && -b - sqrt(discriminant) > 1e-6 && -b - sqrt(discriminant) < h->t) {
        h->t = -b - sqrt(discriminant);
        h->at = add(from, mul(way, h->t));
        h->normal = add(h->at, mul(centre, -1));
        h->colour = red;
    }
    return h->t > 1e-6 && h->t < 1e9;
}

/* Light from the square [-1,1]^2 at height 4, through one shadow ray. */
static vec shade(const hit *h, const double u[2])
{
    const vec lamp = {2 * u[0] - 1, 4, 2 * u[1] - 1}, dark = {0, 0, 0};
    const vec to = add(lamp, mul(h->at, -1)), way = unit(to);
    const double cosine = dot(h->normal, way);
    hit between;
    if (cosine <= 0 || (trace(add(h->at, mul(h->normal, 1e-6)), way, &between) && between.t < sqrt(dot(to, to)))) {
        return dark;
    }
    return mul(h->colour, 12 * cosine * way.y / dot(to, to));
}

static vec sample(koksma_domain pixel, uint32_t i, int x, int y)
{
    const vec eye = {0, 1.5, -5}, none = {0, 0, 0};
    double film[2], lens[2], light[2];
    koksma_sobol_2d(koksma_domain_of_use(pixel, USE_FILM), i, film);
    koksma_sobol_2d(koksma_domain_of_use(pixel, USE_LENS), i, lens);
    koksma_sobol_2d(koksma_domain_of_use(pixel, USE_LIGHT), i, light);
    const double r = 0.1 * sqrt(lens[0]), angle = 6.283185307179586 * lens[1];
    const vec on_lens = {r * cos(angle), r * sin(angle), 0};
    const vec way = {(x + film[0] - WIDTH / 2) / HEIGHT, (HEIGHT / 2 - y - film[1]) / HEIGHT - 0.1, 1};
    const vec focus = mul(way, 4.2);
    hit h;
    if (!trace(add(eye, on_lens), unit(add(focus, mul(on_lens, -1))), &h)) {
        return none;
    }
    return shade(&h, light);
}

static int level(double x)
{
    return (int)(255.999 * pow(x < 1 ? x : 1, 1 / 2.2));
}

int main(int argc, char **argv)
{
    const uint32_t spp = argc > 1 ? (uint32_t)atoi(argv[1]) : 16;
    int x, y;
    printf("P3\n%d %d\n255\n", WIDTH, HEIGHT);
    for (y = 0; y < HEIGHT; y++) {
        for (x = 0; x < WIDTH; x++) {
            const koksma_domain pixel = koksma_domain_of_pixel(7, (uint32_t)x, (uint32_t)y);
            vec sum = {0, 0, 0};
            uint32_t i;
            for (i = 0; i < spp; i++) {
                sum = add(sum, sample(pixel, i, x, y));
            }
            sum = mul(sum, 1.0 / spp);
            printf("%d %d %d\n", level(sum.x), level(sum.y), level(sum.z));
        }
    }
    return 0;
}
