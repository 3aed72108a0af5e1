/* SPDX-License-Identifier: Apache-2.0 */
/* The reference kernels that generate points: plain loops, without intrinsics or blocking. Tests compare fast_*.c
   with them. */
#define KOKSMA_ISA ref
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/sampler.h>

#include "core/elementary.h"
#include "core/random.h"
#include "kernels/kernels.h"

void KERNEL_NAME(nested_bits)(uint64_t seed, uint32_t lane, const koksma__nested_node *first, size_t count,
                              uint64_t *x)
{
    enum { DIGITS = KOKSMA__NESTED_DIGITS, LEVELS = KOKSMA__NESTED_LEVELS, SPARE = KOKSMA__NESTED_SPARE };
    for (size_t i = 0; i < count; i++) {
        const koksma__nested_node *node = &first[x[i] >> (DIGITS - LEVELS)];
        uint64_t flips = node->flips << LEVELS | koksma__nested_flips(*node, x[i] >> (DIGITS - 2 * LEVELS));
        for (int top = 2 * LEVELS; top < DIGITS; top += LEVELS) { /* the last LEVELS digits are padded by 0s */
            flips = flips << LEVELS |
                    koksma__nested_flips(koksma__nested_node_of(koksma__nested_words(seed, x[i], top, lane)),
                                         x[i] << SPARE >> (DIGITS + SPARE - LEVELS - top));
        }
        x[i] ^= flips >> SPARE;
    }
}

void KERNEL_NAME(quotients)(size_t count, const double *xs, double add, double whole, double *out)
{
    for (size_t i = 0; i < count; i++) {
        out[i] = (xs[i] + add) / whole;
    }
}

void KERNEL_NAME(steps)(size_t count, double first, double add, double whole, double *out)
{
    for (size_t i = 0; i < count; i++) {
        out[i] = (first + (double)i + add) / whole;
    }
}

void KERNEL_NAME(fractions)(size_t count, const uint32_t *v, double *out)
{
    for (size_t i = 0; i < count; i++) {
        out[i] = ldexp(v[i], -32);
    }
}

void KERNEL_NAME(rows_of_columns)(size_t count, int dim, const double *columns, size_t stride, bool stream,
                                  double *out)
{
    (void)stream;
    for (size_t i = 0; i < count; i++) {
        for (size_t c = 0; c < (size_t)dim; c++) {
            out[(size_t)dim * i + c] = columns[c * stride + i];
        }
    }
}

void KERNEL_NAME(fraction_rows)(size_t count, int dim, const uint32_t *columns, size_t stride, bool stream,
                                double *out)
{
    (void)stream;
    for (size_t i = 0; i < count; i++) {
        for (size_t c = 0; c < (size_t)dim; c++) {
            out[(size_t)dim * i + c] = ldexp(columns[c * stride + i], -32);
        }
    }
}

static uint32_t sum_of_directions(uint32_t i, const uint32_t *directions)
{
    uint32_t x = 0;
    for (int b = 0; b < 32; b++) {
        x ^= i >> b & 1 ? directions[b] : 0;
    }
    return x;
}

void KERNEL_NAME(digital)(size_t count, const uint32_t *directions, uint32_t start, uint32_t *out)
{
    for (size_t i = 0; i < count; i++) {
        out[i] = start ^ sum_of_directions((uint32_t)i, directions);
    }
}

void KERNEL_NAME(digital_rows)(size_t count, int dim, const uint32_t *const *directions, const uint32_t *starts,
                               bool stream, double *out)
{
    (void)stream;
    for (size_t i = 0; i < count; i++) {
        for (size_t c = 0; c < (size_t)dim; c++) {
            out[i * (size_t)dim + c] = ldexp(starts[c] ^ sum_of_directions((uint32_t)i, directions[c]), -32);
        }
    }
}

void KERNEL_NAME(permute)(uint32_t first, size_t count, uint32_t n, uint64_t key, uint32_t *out)
{
    for (size_t i = 0; i < count; i++) {
        out[i] = koksma_permute(first + (uint32_t)i, n, key);
    }
}

void KERNEL_NAME(owen_hash)(size_t count, const uint32_t *v, bool mirror_in, bool mirror_out, uint32_t seed,
                            uint32_t *out)
{
    for (size_t i = 0; i < count; i++) {
        const uint32_t x = koksma_owen_hash(mirror_in ? koksma_mirror(v[i]) : v[i], seed);
        out[i] = mirror_out ? koksma_mirror(x) : x;
    }
}

/* Column c of the Pascal matrix has the binomial coefficients "c over r" modulo 2. They are odd if all bits that are
   set in r are also set in c. */
void KERNEL_NAME(pascal)(size_t count, const uint32_t *v, uint32_t *out)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t x = 0;
        for (uint32_t c = 0; c < 32; c++) {
            for (uint32_t r = 0; r < 32 && (v[i] >> c & 1); r++) {
                x ^= (r & ~c) == 0 ? 1u << r : 0;
            }
        }
        out[i] = x;
    }
}

void KERNEL_NAME(digital_at)(size_t count, const uint32_t *index, const uint32_t *directions, uint32_t *out)
{
    for (size_t i = 0; i < count; i++) {
        out[i] = sum_of_directions(index[i], directions);
    }
}

void KERNEL_NAME(grow)(uint32_t *v, int level, size_t first, size_t count, uint32_t partner, const uint32_t *word)
{
    const double n = ldexp(1, level);
    for (size_t i = first; i < first + count; i++) {
        const double stratum = floor(ldexp(v[i ^ partner], -32) * 2 * n);
        const double other = fmod(stratum, 2) == 0 ? stratum + 1 : stratum - 1;
        v[((size_t)1 << level) + i] = (uint32_t)ldexp(other / (2 * n), 32) + (word[i - first] >> level >> 1);
    }
}

void KERNEL_NAME(nested_digits)(uint32_t base, uint32_t relatives, size_t count, double width, const double *xs,
                                double *const *v)
{
    for (size_t r = 0; r < count; r++) {
        const double upper = floor(xs[r] / width), prefix = floor(upper / base) * base;
        uint32_t order[13];
        for (uint32_t d = 0; d < base; d++) {
            order[d] = base == 3 ? ((uint32_t)(upper - prefix) + d) % 3 : d;
        }
        if (base > 3) {
            order[(uint32_t)(upper - prefix)] = 0;
            order[0] = (uint32_t)(upper - prefix);
        }
        for (uint32_t d = 1; d <= relatives; d++) {
            uint32_t word[2];
            memcpy(word, &v[d - 1][r], sizeof word);
            const uint32_t pick = d + koksma__below(word[0], base - d), digit = order[pick];
            order[pick] = order[d];
            order[d] = digit;
            v[d - 1][r] = (prefix + digit) * width + floor(width * ldexp(word[1], -32));
        }
    }
}

/* Returns the same as koksma__in_cell of patterns/grids/grids.h. */
static double in_cell(double cell, double u, double m)
{
    const double x = (cell + u) / m, end = (cell + 1) / m;
    return x < end ? x : end * (1 - 0x1p-53);
}

void KERNEL_NAME(cells_2d)(double start, double width, size_t nx, size_t ny, double *xs)
{
    for (size_t i = 0; i < nx * ny; i++) {
        xs[2 * i] = in_cell((double)(i / ny), start + width * xs[2 * i], (double)nx);
        xs[2 * i + 1] = in_cell((double)(i % ny), start + width * xs[2 * i + 1], (double)ny);
    }
}

void KERNEL_NAME(truncated_normals)(double reach, double scale, size_t count, double *xs)
{
    for (size_t i = 0; i < count; i++) {
        const double u = 0.5 + scale * koksma__inverse_erf((2 * xs[i] - 1) * reach);
        xs[i] = u < 0 ? 0 : u > 1 ? 1 : u;
    }
}

void KERNEL_NAME(rooks_2d)(uint64_t seed, const uint32_t *rows, size_t first, size_t count, size_t n, double *xs)
{
    for (size_t i = 0; i < count; i++) {
        const koksma__words r = koksma__random(seed, KOKSMA__PURPOSE_POINT, (first + i) / 2, 0);
        const uint32_t *words = r.w + (first + i) % 2 * 2;
        xs[2 * i] = in_cell((double)(first + i), ldexp(words[0], -32), (double)n);
        xs[2 * i + 1] = in_cell((double)rows[i], ldexp(words[1], -32), (double)n);
    }
}

int32_t KERNEL_NAME(nearest_place)(const uint32_t *cells, size_t stride, uint32_t place)
{
    int32_t least = INT32_MAX;
    for (size_t r = 0; r < 5; r++) {
        for (size_t c = 0; c < 8; c++) {
            const int32_t distance = koksma__place_distance(place, cells[r * stride + c]);
            least = distance < least ? distance : least;
        }
    }
    return least;
}

size_t KERNEL_NAME(far_darts)(const koksma__dart_cells *c, int32_t low, size_t count, const uint32_t *words,
                              uint32_t *far)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t square = c->squares[koksma__below(words[4 * i], c->count)];
        const uint32_t *cells = c->places + koksma__dart_corner(c, square);
        if (KERNEL_NAME(nearest_place)(cells, c->stride, koksma__dart_place(c, square, words + 4 * i)) >= low) {
            far[found++] = (uint32_t)i;
        }
    }
    return found;
}

/* Returns the difference of two places (see kernels.h) in one coordinate. */
static int32_t from_to(uint32_t a, uint32_t b)
{
    const uint32_t steps = (b - a) & 0xffff;
    return steps < 0x8000 ? (int32_t)steps : (int32_t)steps - 0x10000;
}

size_t KERNEL_NAME(open_quarters)(const koksma__dart_cells *c, int32_t low, uint32_t *out)
{
    const int32_t half = KOKSMA__PLACE_UNITS / 4 >> c->level; /* half of the side of a quarter */
    size_t kept = 0;
    for (uint32_t i = 0; i < 4 * c->count; i++) {
        const uint32_t whole_x = c->squares[i / 4] & 0xffff, whole_y = c->squares[i / 4] >> 16;
        const uint32_t cell_x = whole_x >> c->level, cell_y = whole_y >> c->level;
        const uint32_t own_x = 2 * whole_x + i % 2, own_y = 2 * whole_y + i / 2 % 2;
        const uint32_t x = (2 * own_x + 1) * (uint32_t)half, y = (2 * own_y + 1) * (uint32_t)half;
        bool covered = false;
        for (uint32_t cell = 0; cell < 25; cell++) {
            const uint32_t u = cell % 5, v = cell / 5, place = c->places[(cell_y + v) * c->stride + cell_x + u];
            const bool inner = v >= 1 && v <= 3 && u >= 1, corner = (u == 0 || u == 4) && (v == 0 || v == 4);
            if ((c->level < 2 ? inner : !corner) && place != koksma__no_place(cell_x + u - 2, cell_y + v - 2)) {
                const int32_t a = abs(from_to(x, place)) + half, b = abs(from_to(y, place >> 16)) + half;
                covered = covered || cell == 12 || a * a + b * b < low;
            }
        }
        out[kept] = koksma__place(own_x, own_y);
        kept += !covered;
    }
    return kept;
}

unsigned KERNEL_NAME(covers)(size_t count, const double *xs, const double *ys, double x, double y, double step,
                             double h, double d2)
{
    unsigned found = 0;
    for (size_t i = 0; i < count; i++) {
        for (unsigned q = 0; q < 4; q++) {
            const double a = fabs(xs[i] - (q & 1 ? x + step : x - step)) + h;
            const double b = fabs(ys[i] - (q & 2 ? y + step : y - step)) + h;
            found |= (unsigned)(a * a + b * b < d2) << q;
        }
    }
    return found;
}

void KERNEL_NAME(nearest_offset)(size_t near, const double *dx, const double *dy, size_t count, const double *pairs,
                                 double scale, double *least)
{
    for (size_t c = 0; c < count; c++) {
        least[c] = 1;
        for (size_t j = 0; j < near; j++) {
            const double a = dx[j] - scale * pairs[2 * c], b = dy[j] - scale * pairs[2 * c + 1];
            least[c] = a * a + b * b < least[c] ? a * a + b * b : least[c];
        }
    }
}

/* Returns exp(z) for -50 <= z <= 0, with the same roundings as in fast_gauss.c. */
static double fall(double z)
{
    const double k = nearbyint(z * 0x1.71547652b82fep+0), r = (z - k * 0x1.62e42feep-1) - k * 0x1.a39ef35793c76p-33;
    const double low = (1 + r) + (1.0 / 2 + r * (1.0 / 6)) * (r * r);
    const double middle = (1.0 / 24 + r * (1.0 / 120)) + (1.0 / 720 + r * (1.0 / 5040)) * (r * r);
    const double high = 1.0 / 40320 + r * (1.0 / 362880), r4 = (r * r) * (r * r);
    return ldexp((low + middle * r4) + high * (r4 * r4), (int)k);
}

static double short_way(double t)
{
    return t > 0.5 ? t - 1 : t < -0.5 ? t + 1 : t;
}

void KERNEL_NAME(gauss_force)(size_t runs, const uint32_t *run, const double *xs, const double *ys, double x,
                              double y, double scale, double cut2, double force[2])
{
    double sum[2][8] = {{0}, {0}};
    for (size_t r = 0; r < runs; r++) {
        for (uint32_t i = run[2 * r]; i < run[2 * r + 1]; i++) {
            const double a = short_way(xs[i] - x), b = short_way(ys[i] - y), square = a * a + b * b;
            const double w = square <= cut2 ? fall(square * scale) : 0;
            sum[0][(i - run[2 * r]) % 8] -= w * a;
            sum[1][(i - run[2 * r]) % 8] -= w * b;
        }
    }
    for (int k = 0; k < 2; k++) {
        const double *s = sum[k];
        force[k] = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
    }
}

static float distance_of(int dim, const float *a, const float *values, size_t plane)
{
    float square = 0;
    for (int k = 0; k < dim; k++) {
        const float d = a[k] - values[(size_t)k * plane];
        square += d * d;
    }
    return dim == 1 ? fabsf(*a - *values) : sqrtf(square);
}

float KERNEL_NAME(mask_growth)(size_t rows, size_t span, size_t stride, size_t plane, int dim, const float *weights,
                               const float *values, const float *from, const float *to)
{
    float s[8] = {0};
    for (size_t i = 0; i < rows * span; i++) {
        const float *value = values + i / span * stride + i % span;
        s[i % 8] += weights[i] * (distance_of(dim, from, value, plane) - distance_of(dim, to, value, plane));
    }
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}
