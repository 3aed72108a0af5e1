/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes include/koksma/keys_4d_single.def: the keys of koksma_keys_4d with one sample a pixel, by simulated annealing. A
 * program of its own, run by hand; the number is that of proposals a pixel:
 *
 *     cc -O3 -march=native -std=c11 -ffp-contract=off -fno-math-errno -Iinclude tools/make_keys_single.c -lm -o /tmp/make
 *     /tmp/make 20000 > /tmp/keys.def && mv /tmp/keys.def include/koksma/keys_4d_single.def
 *
 * Pixel p of a tile of 64 x 64 that repeats takes point key(p) of the first 4,096 of Sobol's sequence in four dimensions,
 * one in each box of 1/8 in every dimension; an exclusive or with random digits moves all points within their boxes. It
 * keeps their distances nearly, as Owen's scrambling does not. The mean square error after the filter is
 *
 *     E = sum over p, q of g(p - q) K(x_p, x_q),   g(d) = exp(-|d|^2 / 9): the Gaussian of 1.5 pixels with itself
 *     K(x, y) = the mean of f(x) f(y) / variance over FUNCTIONS functions f less their means, each with random digits
 *
 * The functions are of the families of `koksma curve screen` (src/engine/integrands/screen.c), seven in ten of all four
 * coordinates, but not those that it measures. Cholesky's decomposition with pivots, stopped early, gives vectors L(x) with
 * K(x, y) = L(x).L(y) nearly. Each pixel keeps the sum of the vectors around it, weighted by g, so that a proposal costs
 * two scalar products. Annealing swaps the keys of two pixels whose points are near on a Z-curve, nearer the colder; while
 * it is hot the first FEW components do.
 */
#include <koksma/keys.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SIDE = 64,
    PIXELS = SIDE * SIDE,
    REACH = 7,
    FAMILIES = 10,
    FUNCTIONS = 8192,
    RANK = 1024,
    FEW = 256,
    LANES = 16
};

static uint32_t sobol[PIXELS][4];       /* points as fractions */
static float values[PIXELS][FUNCTIONS]; /* of the functions at the points */
static float vectors[PIXELS][RANK];     /* L */
static float fields[PIXELS][RANK];      /* sums of the vectors around each pixel */
static float weights[2 * REACH + 1][2 * REACH + 1];
static int keys[PIXELS], pixel_of[PIXELS], curve[PIXELS], place_of[PIXELS];
static int rank = FEW; /* number of components in use */
static uint64_t counter;

static uint32_t draw(void)
{
    uint32_t w[4];
    koksma_words(2027, KOKSMA_FOR_POINT, counter++, 0, w);
    return w[0];
}

static double uniform(void)
{
    return (draw() + 0.5) / 4294967296.0;
}

static double normal(void)
{
    const double radius = sqrt(-2 * log(uniform()));
    return radius * cos(6.283185307179586 * uniform());
}

/* ---- Functions --------------------------------------------------------------------------------------------- */

typedef struct function {
    int family, k, axes[4]; /* it depends on the coordinates axes[0] .. axes[k - 1] */
    double a[4], u[4], c;
} function;

static void draw_direction(function *f)
{
    for (double least = 0; least < 0.05;) {
        double square = 0;
        for (int i = 0; i < f->k; i++) {
            f->a[i] = normal();
            square += f->a[i] * f->a[i];
        }
        least = 1;
        f->c = 0;
        for (int i = 0; i < f->k; i++) {
            f->a[i] /= sqrt(square);
            f->c += f->a[i] * f->u[i];
            least = fmin(least, fabs(f->a[i]));
        }
    }
}

static function make_function(int number)
{
    static const double difficulties[] = {9, 7.25, 1.85, 7.03, 20.4, 4.3}; /* of Genz's families */
    const int tenth = number / FAMILIES % 10;
    function f = {.family = number % FAMILIES, .k = tenth < 7 ? 4 : tenth - 6};
    double sum = 0;
    int n = 0;
    for (int axis = 0; axis < 4; axis++) {
        if (uniform() * (4 - axis) < f.k - n) {
            f.axes[n] = axis;
            f.u[n] = uniform();
            f.a[n] = f.family == 2 ? 0.3 + 0.7 * uniform() : f.family == 3 ? 2 * uniform() - 1 : uniform();
            sum += f.a[n++];
        }
    }
    for (int i = 0; i < f.k && f.family >= 4; i++) {
        f.a[i] *= difficulties[f.family - 4] / sum;
    }
    if (f.family < 2) {
        draw_direction(&f);
    }
    return f;
}

static double value(const function *f, const double *x)
{
    double sum = 0, squares = 0, distance = 0, product = 1, linear = 1;
    bool inside = true;
    for (int i = 0; i < f->k; i++) {
        const double y = x[f->axes[i]], t = f->a[i] * (y - f->u[i]);
        sum += f->a[i] * y;
        squares += t * t;
        distance += fabs(t);
        product *= 1 + t * t;
        linear *= 2 * y - 1 + f->a[i];
        inside = inside && (f->family == 2 ? y < f->a[i] : i > 1 || y <= f->u[i]);
    }
    switch (f->family) {
    case 0:
        return sum < f->c;
    case 1:
        return fmax(f->c - sum, 0);
    case 2:
        return inside;
    case 3:
        return linear;
    case 4:
        return cos(6.283185307179586 * f->u[0] + sum);
    case 5:
        return 1 / product;
    case 6:
        return pow(1 + sum, -(f->k + 1));
    case 7:
        return exp(-squares);
    case 8:
        return exp(-distance);
    default:
        return inside ? exp(sum) : 0;
    }
}

/* Fills a column of `values`, of mean 0 and mean square 1 / FUNCTIONS. */
static void evaluate(int number)
{
    const function f = make_function(number);
    uint32_t digits[4];
    double mean = 0, square = 0;
    for (int k = 0; k < 4; k++) {
        digits[k] = draw();
        digits[k] = digits[k] >> 3 | (0u - (digits[k] & 1)) << 29;
    }
    for (int i = 0; i < PIXELS; i++) {
        double x[4];
        for (int k = 0; k < 4; k++) {
            x[k] = (sobol[i][k] ^ digits[k]) * 0x1p-32;
        }
        const double y = value(&f, x);
        values[i][number] = (float)y;
        mean += y / PIXELS;
    }
    for (int i = 0; i < PIXELS; i++) {
        square += ((double)values[i][number] - mean) * ((double)values[i][number] - mean) / PIXELS;
    }
    for (int i = 0; i < PIXELS; i++) { /* a function may be 0 at all points */
        values[i][number] = square > 0 ? (float)(((double)values[i][number] - mean) / sqrt(square * FUNCTIONS)) : 0;
    }
}

/* ---- Vectors ----------------------------------------------------------------------------------------------- */

/* The scalar product, in an order that compilers may keep in vector registers. */
static double product(const float *a, const float *b, int n)
{
    float sums[LANES] = {0};
    double sum = 0;
    for (int k = 0; k < n; k += LANES) {
        for (int l = 0; l < LANES; l++) {
            sums[l] += a[k + l] * b[k + l];
        }
    }
    for (int l = 0; l < LANES; l++) {
        sum += (double)sums[l];
    }
    return sum;
}

static void decompose(void)
{
    static double left[PIXELS];
    double sum = 0;
    for (int i = 0; i < PIXELS; i++) {
        left[i] = product(values[i], values[i], FUNCTIONS);
    }
    for (int r = 0; r < RANK; r++) {
        int pivot = 0;
        for (int i = 1; i < PIXELS; i++) {
            pivot = left[i] > left[pivot] ? i : pivot;
        }
        const double root = sqrt(left[pivot]);
        for (int i = 0; i < PIXELS; i++) { /* components from r on are still 0 */
            const double k = product(values[i], values[pivot], FUNCTIONS) - product(vectors[i], vectors[pivot], RANK);
            vectors[i][r] = i == pivot ? 0 : (float)(k / root);
            left[i] -= (double)(vectors[i][r] * vectors[i][r]);
        }
        vectors[pivot][r] = (float)root;
        left[pivot] = 0;
    }
    for (int i = 0; i < PIXELS; i++) {
        sum += left[i] / PIXELS;
    }
    fprintf(stderr, "%d components, %.3f left\n", RANK, sum);
}

/* ---- Annealing --------------------------------------------------------------------------------------------- */

static void add(int pixel, const float *vector, float sign)
{
    for (int v = -REACH; v <= REACH; v++) {
        for (int u = -REACH; u <= REACH; u++) {
            const float w = sign * weights[v + REACH][u + REACH];
            float *field = fields[(pixel / SIDE + v + SIDE) % SIDE * SIDE + (pixel + u + SIDE) % SIDE];
            for (int k = 0; k < rank && (u || v); k++) {
                field[k] += w * vector[k];
            }
        }
    }
}

/* Makes the fields anew: rounding errors of their changes add up. Returns the error after the filter beside that of white
   noise. */
static double restart(void)
{
    double sum = 1;
    memset(fields, 0, sizeof fields);
    for (int p = 0; p < PIXELS; p++) {
        add(p, vectors[keys[p]], 1);
    }
    for (int p = 0; p < PIXELS; p++) {
        sum += product(fields[p], vectors[keys[p]], rank) / PIXELS;
    }
    return sqrt(sum);
}

/* The weight of two pixels; 0 beyond REACH. */
static double between(int p, int q)
{
    const int u = abs(p % SIDE - q % SIDE), v = abs(p / SIDE - q / SIDE);
    const int x = u < SIDE - u ? u : SIDE - u, y = v < SIDE - v ? v : SIDE - v;
    return x > REACH || y > REACH ? 0 : (double)weights[y + REACH][x + REACH];
}

/* Swaps the keys of pixels p and q, if chance lets it. */
static void propose(int p, int q, double temperature)
{
    float change[RANK], field[RANK];
    for (int k = 0; k < rank; k++) {
        change[k] = vectors[keys[q]][k] - vectors[keys[p]][k];
        field[k] = fields[p][k] - fields[q][k];
    }
    const double growth = product(change, field, rank) - between(p, q) * product(change, change, rank);
    if (growth <= 0 || uniform() < exp(-growth / temperature)) {
        const int key = keys[p];
        keys[p] = keys[q];
        keys[q] = key;
        pixel_of[keys[p]] = p;
        pixel_of[key] = q;
        add(p, change, 1);
        add(q, change, -1);
    }
}

static int on_curve(const void *a, const void *b)
{
    uint32_t codes[2] = {0, 0};
    for (int bit = 31; bit > 24; bit--) {
        for (int k = 0; k < 4; k++) {
            codes[0] = codes[0] << 1 | (sobol[*(const int *)a][k] >> bit & 1);
            codes[1] = codes[1] << 1 | (sobol[*(const int *)b][k] >> bit & 1);
        }
    }
    return codes[0] != codes[1] ? (codes[0] < codes[1] ? -1 : 1) : *(const int *)a - *(const int *)b;
}

static void prepare(void)
{
    for (int i = 0; i < PIXELS; i++) {
        uint32_t words[4];
        koksma__sobol_quadruple((uint32_t)i, words);
        for (int k = 0; k < 4; k++) {
            sobol[i][k] = koksma_mirror(words[k]);
        }
        curve[i] = keys[i] = i;
    }
    for (int i = 0; i < FUNCTIONS; i++) {
        evaluate(i);
    }
    decompose();
    for (int v = -REACH; v <= REACH; v++) {
        for (int u = -REACH; u <= REACH; u++) {
            weights[v + REACH][u + REACH] = u * u + v * v <= REACH * REACH ? (float)exp(-(u * u + v * v) / 9.0) : 0;
        }
    }
    qsort(curve, PIXELS, sizeof *curve, on_curve);
    for (int i = 0; i < PIXELS; i++) {
        const int j = i + (int)(uniform() * (PIXELS - i)), other = keys[j];
        place_of[curve[i]] = i;
        keys[j] = keys[i];
        keys[i] = other;
        pixel_of[other] = i;
    }
}

int main(int argc, char **argv)
{
    enum { PHASES = 50 };
    const double hot = 0.03, cold = 0.0002, near = 0.015;
    const long long proposals = (argc > 1 ? atoll(argv[1]) : 20000) * PIXELS, phase = proposals / PHASES;
    prepare();
    for (long long i = 0; i < proposals; i++) {
        const double done = (double)i / (double)proposals;
        if (i % phase == 0) {
            rank = done < 0.75 ? FEW : RANK;
            fprintf(stderr, "%.0f %%: %.4f of white noise\n", 100 * done, restart());
        }
        const int p = (int)(uniform() * PIXELS);
        const int step = (int)((2 * uniform() - 1) * (PIXELS * pow(near, done) + 1));
        const int q = pixel_of[curve[(place_of[keys[p]] + step + 2 * PIXELS) % PIXELS]];
        if (p != q) {
            propose(p, q, hot * pow(cold / hot, done));
        }
    }
    fprintf(stderr, "%.4f of white noise\n", restart());
    puts("/* SPDX-License-Identifier: Apache-2.0 */\n/* The keys of koksma/keys.h for quadruples with one sample a "
         "pixel. Made by "
         "tools/make_keys_single.c. */");
    for (int i = 0; i < PIXELS; i++) {
        printf("%d,%s", keys[i], i % 16 == 15 ? "\n" : " ");
    }
    return 0;
}
