/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes include/koksma/keys_4d_four.def: the points of koksma_keys_4d with three or four samples a pixel, by simulated
 * annealing. A program of its own, run by hand; the numbers are those of samples a pixel and of proposals a point, and a
 * table is the one to begin with:
 *
 *     cc -O3 -march=native -std=c11 -ffp-contract=off -fno-math-errno -Iinclude tools/make_keys_tile.c -lm -o /tmp/make
 *     /tmp/make 4 1500 > /tmp/a && /tmp/make 4 4000 /tmp/a > /tmp/b && /tmp/make 4 2000 /tmp/b > /tmp/keys.def
 *
 * The table took such runs by other schedules, with WITHIN 1.075, 1.1 and 1.2. `/tmp/make 1` makes tables for one sample;
 * keys_4d_single.def is older, of PLACES = 1 and 16,000 proposals. Long because it is a program of its own.
 *
 * Each of the 4,096 boxes of 1/8 in every dimension has PLACES of the first points of Sobol's sequence in four dimensions.
 * One of them goes to a pixel of a tile that repeats, of 64 x 64 pixels with one sample or 32 x 32 with four. An exclusive
 * or with random digits moves all points within their boxes. It keeps their distances nearly, as Owen's scrambling does
 * not. The four points of a pixel are in different quarters of every coordinate. The mean square error after the filter is
 *
 *     E = sum over points x of pixel p, y of q of g(p - q) K(x, y)
 *     g(d) = exp(-|d|^2 / 9): the Gaussian of 1.5 pixels with itself
 *     K(x, y) = the mean of f(x) f(y) / P over FUNCTIONS functions f less their means, each with random digits
 *
 * where P is the mean square error of f in a pixel with Owen-scrambled points, but at least LEAST of that with random ones:
 * else steps at a quarter would count for all others. The functions are of the families of `koksma curve screen`
 * (src/engine/integrands/screen.c), seven in ten of all four coordinates, but not those that it measures. Cholesky's
 * decomposition with pivots, stopped early, gives vectors L(x) with K(x, y) = L(x).L(y) nearly; they are turned such that
 * the first components have most of it. Each pixel keeps the sum of the vectors around it, weighted by g, so that a
 * proposal costs a few scalar products. Annealing swaps the points of two pixels that are near on a Z-curve, nearer the
 * colder, single points of one stratum, and pairs of points whose strata cover the same quarters, or takes another point
 * of a box. While it is hot the first FEW components do, which later refuse most proposals. Pairs of points within a pixel
 * have the weight WITHIN: more than 1 makes pixels better and their errors a little less blue. Last, each pixel orders its
 * points such that E is small of one, two and three of them, too; points 0 and 1, 2 and 3 are in different halves of every
 * coordinate.
 */
#include <koksma/keys.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* In temperatures: no proposal is taken that lets the error grow by more. */
static const double HOPELESS = 25;

enum {
    BOXES = 4096,
    PLACES = 4,
    POINTS = BOXES * PLACES,
    STRATUM = 16,
    REACH = 7,
    FAMILIES = 10,
    FUNCTIONS = 8192,
    RANK = 1024,
    FEW = 128,
    LANES = 16,
    SETS = 1024
};

static const float WITHIN = 1.2f;
static const double LEAST = 0.25;

static uint32_t sobol[POINTS][4];                   /* points as fractions */
static double alone[SETS][4][4];                    /* samples of pixels with Owen-scrambled points */
static float values[POINTS][FUNCTIONS];             /* of the functions at the points */
static float vectors[POINTS][RANK];                 /* L */
static float fields[BOXES][RANK];                   /* sums of the vectors around each pixel */
static float sums[BOXES][RANK];                     /* of the vectors of each pixel */
static float weights[2 * REACH + 1][2 * REACH + 1]; /* g; 0 at the centre */
static int points_in[BOXES][PLACES];                /* a box has the number of its first point */
static int taken[BOXES];                            /* the point of each box in use */
static int boxes[BOXES], slot_of[BOXES];  /* the box of each slot: sample i of pixel p is slot samples p + i */
static int inside[256][STRATUM];          /* boxes of each stratum */
static int curve[BOXES], place_of[BOXES]; /* boxes along the Z-curve */
static int samples, side, pixels, rank;   /* rank: number of components in use */
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

/* Fills a column of `values`, of mean 0; a pixel with independent points has the mean square 1 / FUNCTIONS. */
static void evaluate(int number)
{
    const function f = make_function(number);
    uint32_t digits[4];
    double mean = 0, variance = 0, square = 0;
    for (int k = 0; k < 4; k++) {
        digits[k] = draw();
        digits[k] = digits[k] >> 3 | (0u - (digits[k] & 1)) << 29;
    }
    for (int i = 0; i < POINTS; i++) {
        double x[4];
        for (int k = 0; k < 4; k++) {
            x[k] = (sobol[i][k] ^ digits[k]) * 0x1p-32;
        }
        const double y = value(&f, x);
        values[i][number] = (float)y;
        mean += y / POINTS;
    }
    for (int i = 0; i < POINTS; i++) {
        variance += ((double)values[i][number] - mean) * ((double)values[i][number] - mean) / POINTS;
    }
    for (int b = 0; b < SETS && samples > 1; b++) {
        double error = -mean;
        for (int i = 0; i < samples; i++) {
            error += value(&f, alone[b][i]) / samples;
        }
        square += error * error / SETS;
    }
    square = samples > 1 ? fmax(square, LEAST * variance / samples) : variance;
    const double divisor = samples * sqrt(square * FUNCTIONS);
    for (int i = 0; i < POINTS; i++) { /* a function may be 0 at nearly all points */
        values[i][number] = square > 1e-9 ? (float)(((double)values[i][number] - mean) / divisor) : 0;
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
    static double left[POINTS];
    double sum = 0;
    for (int i = 0; i < POINTS; i++) {
        left[i] = product(values[i], values[i], FUNCTIONS);
    }
    for (int r = 0; r < RANK; r++) {
        int pivot = 0;
        for (int i = 1; i < POINTS; i++) {
            pivot = left[i] > left[pivot] ? i : pivot;
        }
        const double root = sqrt(left[pivot]);
        for (int i = 0; i < POINTS; i++) { /* components from r on are still 0 */
            const double k = product(values[i], values[pivot], FUNCTIONS) - product(vectors[i], vectors[pivot], RANK);
            vectors[i][r] = i == pivot ? 0 : (float)(k / root);
            left[i] -= (double)(vectors[i][r] * vectors[i][r]);
        }
        vectors[pivot][r] = (float)root;
        left[pivot] = 0;
    }
    for (int i = 0; i < POINTS; i++) {
        sum += left[i] / POINTS;
    }
    fprintf(stderr, "%d components, %.3f left\n", RANK, sum);
}

/* Turns the vectors to nearly the axes of their mean square, the largest first, by orthogonal iteration. */
static void turn_vectors(void)
{
    enum { SWEEPS = 6 };
    static float squares[RANK][RANK], axes[RANK][RANK], next[RANK][RANK];
    float vector[RANK];
    for (int r = 0; r < RANK; r++) {
        axes[r][r] = 1;
        for (int i = 0; i < POINTS; i++) {
            for (int k = 0; k < RANK; k++) {
                squares[r][k] += vectors[i][r] * vectors[i][k];
            }
        }
    }
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        for (int r = 0; r < RANK; r++) {
            for (int k = 0; k < RANK; k++) {
                next[r][k] = (float)product(axes[r], squares[k], RANK);
            }
        }
        for (int r = 0; r < RANK; r++) {
            for (int q = 0; q < 2 * r; q++) { /* twice, since rounding leaves a part */
                const float along = (float)product(next[r], axes[q % r], RANK);
                for (int k = 0; k < RANK; k++) {
                    next[r][k] -= along * axes[q % r][k];
                }
            }
            const float size = (float)sqrt(product(next[r], next[r], RANK));
            for (int k = 0; k < RANK; k++) {
                axes[r][k] = next[r][k] / size;
            }
        }
    }
    for (int i = 0; i < POINTS; i++) {
        memcpy(vector, vectors[i], sizeof vector);
        for (int r = 0; r < RANK; r++) {
            vectors[i][r] = (float)product(axes[r], vector, RANK);
        }
    }
}

/* ---- Annealing --------------------------------------------------------------------------------------------- */

static void add(int pixel, const float *vector, float sign)
{
    for (int v = -REACH; v <= REACH; v++) {
        for (int u = -REACH; u <= REACH; u++) {
            const float w = sign * weights[v + REACH][u + REACH];
            float *field = fields[(pixel / side + v + side) % side * side + (pixel + u + side) % side];
            for (int k = 0; k < rank && w != 0; k++) {
                field[k] += w * vector[k];
            }
        }
    }
    for (int k = 0; k < rank; k++) {
        sums[pixel][k] += sign * vector[k];
    }
}

/* Makes the sums anew: rounding errors of their changes add up. Returns the error after the filter beside that of white
   noise. */
static double restart(void)
{
    double within = 0, others = 0;
    memset(fields, 0, sizeof fields);
    memset(sums, 0, sizeof sums);
    for (int s = 0; s < BOXES; s++) {
        add(s / samples, vectors[taken[boxes[s]]], 1);
    }
    for (int p = 0; p < pixels; p++) {
        within += product(sums[p], sums[p], rank);
        others += product(fields[p], sums[p], rank);
    }
    fprintf(stderr, "in a pixel %.4f, ", sqrt(within / pixels));
    return sqrt(1 + others / within);
}

/* The weight of two pixels; 0 beyond REACH. */
static double between(int p, int q)
{
    const int u = abs(p % side - q % side), v = abs(p / side - q / side);
    const int x = u < side - u ? u : side - u, y = v < side - v ? v : side - v;
    return x > REACH || y > REACH ? 0 : (double)weights[y + REACH][x + REACH];
}

static void put(int slot, int box)
{
    boxes[slot] = box;
    slot_of[box] = slot;
}

/* Whether chance lets the error grow. */
static bool accepted(double growth, double temperature)
{
    return growth <= 0 || uniform() < exp(-growth / temperature);
}

/* Swaps the points of n slots of two pixels, if chance lets it. Most proposals are hopeless by the first components. */
static void propose(int n, const int *of_p, const int *of_q, double temperature)
{
    const int p = of_p[0] / samples, q = of_q[0] / samples;
    const double weight = between(p, q);
    float change[RANK] = {0}, field[RANK];
    double growth = 0;
    for (int from = 0, end = FEW; from < rank && growth < HOPELESS * temperature; from = end, end = rank) {
        for (int i = 0; i < n; i++) {
            const float *a = vectors[taken[boxes[of_q[i]]]], *b = vectors[taken[boxes[of_p[i]]]];
            for (int k = from; k < end; k++) {
                change[k] += a[k] - b[k];
            }
        }
        for (int k = from; k < end; k++) {
            const float own = n < samples ? WITHIN * (sums[p][k] - sums[q][k] + change[k]) : 0;
            field[k] = fields[p][k] - fields[q][k] + own;
        }
        growth += product(change + from, field + from, end - from) -
                  weight * product(change + from, change + from, end - from);
    }
    if (growth < HOPELESS * temperature && accepted(growth, temperature)) {
        for (int i = 0; i < n; i++) {
            const int box = boxes[of_p[i]];
            put(of_p[i], boxes[of_q[i]]);
            put(of_q[i], box);
        }
        add(p, change, 1);
        add(q, change, -1);
    }
}

/* Takes another point of the box of a slot, if chance lets it. */
static void move(int slot, int point, double temperature)
{
    const int p = slot / samples;
    const float *a = vectors[point], *b = vectors[taken[boxes[slot]]];
    float change[RANK], field[RANK];
    double growth = 0;
    for (int from = 0, end = FEW; from < rank && growth < HOPELESS * temperature; from = end, end = rank) {
        for (int k = from; k < end; k++) {
            change[k] = a[k] - b[k];
            field[k] = fields[p][k] + (samples > 1 ? WITHIN : 1) * (sums[p][k] + change[k] / 2);
        }
        growth += product(change + from, field + from, end - from);
    }
    if (a != b && growth < HOPELESS * temperature && accepted(growth, temperature)) {
        taken[boxes[slot]] = point;
        add(p, change, 1);
    }
}

/* The stratum of the points of a box, which is any in a coordinate: two bits each. */
static uint32_t stratum(int box)
{
    return sobol[box][0] >> 30 | sobol[box][1] >> 30 << 2 | sobol[box][2] >> 30 << 4 | sobol[box][3] >> 30 << 6;
}

/* Whether the points of two boxes are in different halves of every coordinate. */
static bool opposite(int a, int b)
{
    return ((stratum(a) ^ stratum(b)) & 0xaa) == 0xaa;
}

/* A random box of a stratum. */
static int box_of(uint32_t strata)
{
    return inside[strata][(int)(uniform() * STRATUM)];
}

/* Finds two slots of another pixel whose points are in the strata of the points of two slots of a pixel, exchanged in some
   of the coordinates, so that both pixels keep a point in each quarter, and opposite pairs. */
static bool find_pair(const int of_p[2], int of_q[2])
{
    const uint32_t a = stratum(boxes[of_p[0]]), b = stratum(boxes[of_p[1]]), word = draw();
    const uint32_t mask = (word & 1 ? 3u : 0) | (word & 2 ? 12u : 0) | (word & 4 ? 48u : 0) | (word & 8 ? 192u : 0);
    of_q[0] = slot_of[box_of((a & ~mask) | (b & mask))];
    of_q[1] = of_q[0];
    for (int i = 0, first = of_q[0] / 4 * 4; i < 4; i++) {
        of_q[1] = stratum(boxes[first + i]) == ((b & ~mask) | (a & mask)) ? first + i : of_q[1];
    }
    if (of_q[0] == of_q[1] || of_p[0] / 4 == of_q[0] / 4) {
        return false;
    }
    bool good = true;
    for (int i = 0; i < 2; i++) { /* the points that would stand beside each other */
        const int beside_p = of_p[i] ^ 1, beside_q = of_q[i] ^ 1;
        const int to_p = beside_p == of_p[1 - i] ? boxes[of_q[1 - i]] : boxes[beside_p];
        const int to_q = beside_q == of_q[1 - i] ? boxes[of_p[1 - i]] : boxes[beside_q];
        good = good && opposite(boxes[of_q[i]], to_p) && opposite(boxes[of_p[i]], to_q);
    }
    return good;
}

static int turned(int i, int turn)
{
    return i ^ (turn & 3) ^ (turn >> 2 & i >> 1);
}

/* Lets each pixel choose, again and again, among the eight orders in which points 0 and 1, 2 and 3 are opposite. Each of
   the errors of one point, of a pair and of three has the same weight: 9, 5 and 2 twelfths come to a pair of points. */
static void order(void)
{
    enum { SWEEPS = 12 };
    for (int step = 0; step < SWEEPS * pixels; step++) {
        const int p = step % pixels;
        int own[4], best = 0;
        double with[4][4], least = HUGE_VAL;
        for (int j = 0; j < 4; j++) {
            float field[RANK] = {0};
            for (int q = 0; q < pixels; q++) {
                const float w = (float)between(p, q);
                const float *vector = vectors[taken[boxes[4 * q + j]]];
                for (int k = 0; k < RANK && w > 0; k++) {
                    field[k] += w * vector[k];
                }
            }
            for (int i = 0; i < 4; i++) {
                own[i] = boxes[4 * p + i];
                with[i][j] = product(vectors[taken[own[i]]], field, RANK);
            }
        }
        for (int turn = 0; turn < 8; turn++) {
            double energy = 0;
            for (int i = 0; i < 4; i++) {
                for (int j = 0; j < 4; j++) {
                    energy += (i == j ? 9 : i == (j ^ 1) ? 5 : 2) * with[turned(i, turn)][j];
                }
            }
            best = energy < least ? turn : best;
            least = fmin(energy, least);
        }
        for (int i = 0; i < 4; i++) {
            put(4 * p + i, own[turned(i, best)]);
        }
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
    static int found[BOXES], number_of[BOXES];
    for (uint32_t b = 0; b < SETS; b++) {
        const koksma_keys set = koksma_keys_of_4d(b, 0, 0, 0, 64);
        for (uint32_t i = 0; i < 4; i++) {
            koksma_keys_4d(&set, i, alone[b][i]);
        }
    }
    for (int i = 0; i < POINTS; i++) {
        uint32_t words[4], box = 0;
        koksma__sobol_quadruple((uint32_t)i, words);
        for (int k = 0; k < 4; k++) {
            sobol[i][k] = koksma_mirror(words[k]);
            box = box << 3 | sobol[i][k] >> 29;
        }
        if (i < BOXES) {
            number_of[box] = curve[i] = boxes[i] = taken[i] = i;
        }
        points_in[number_of[box]][found[box]++] = i;
    }
    for (int i = 0; i < FUNCTIONS; i++) {
        evaluate(i);
    }
    decompose();
    turn_vectors();
    for (int v = -REACH; v <= REACH; v++) {
        for (int u = -REACH; u <= REACH; u++) {
            const int square = u * u + v * v;
            weights[v + REACH][u + REACH] = square && square <= REACH * REACH ? (float)exp(-square / 9.0) : 0;
        }
    }
    qsort(curve, BOXES, sizeof *curve, on_curve);
    for (int i = 0; i < BOXES; i++) { /* the boxes of a stratum follow each other on the curve */
        inside[stratum(curve[i])][i % STRATUM] = curve[i];
    }
    for (int i = 0; i < BOXES; i++) { /* pixels in a random order */
        place_of[curve[i]] = i;
        const int p = i / samples, other = p + (int)(uniform() * (pixels - p));
        for (int k = 0; k < samples && i % samples == 0; k++) {
            const int box = boxes[other * samples + k];
            put(other * samples + k, boxes[i + k]);
            put(i + k, box);
        }
    }
}

/* Reads a table that this program printed. */
static bool read_table(const char *name)
{
    static int box_of[POINTS];
    char line[256];
    int n = 0;
    FILE *file = fopen(name, "r");
    for (int i = 0; i < POINTS; i++) {
        box_of[points_in[i / PLACES][i % PLACES]] = i / PLACES;
    }
    while (file && fgets(line, sizeof line, file)) {
        for (char *at = line, *end = line; *line != '/' && n < BOXES; at = end + 1, n++) {
            const long point = strtol(at, &end, 10);
            if (end == at || point < 0 || point >= POINTS) {
                break;
            }
            taken[box_of[point]] = (int)point;
            put(n, box_of[point]);
        }
    }
    return file && fclose(file) == 0 && n == BOXES;
}

/* Proposes one of four: another point of a box; all points of two pixels, two points of one stratum, or pairs. */
static void step(double temperature, double distance)
{
    const int slot = (int)(uniform() * BOXES), first = slot - slot % samples;
    if (uniform() < 0.25) {
        move(slot, points_in[boxes[slot]][(int)(uniform() * PLACES)], temperature);
        return;
    }
    const int kind = samples == 1 ? 0 : (int)(uniform() * 3);
    int of_p[4] = {slot}, of_q[4];
    if (kind == 2) {
        of_p[1] = first + (slot + 1 + (int)(uniform() * 3)) % 4;
        if (find_pair(of_p, of_q)) {
            propose(2, of_p, of_q, temperature);
        }
        return;
    }
    const int to = place_of[boxes[slot]] + (int)((2 * uniform() - 1) * distance);
    of_q[0] = slot_of[kind ? box_of(stratum(boxes[slot])) : curve[(to + 2 * BOXES) % BOXES]];
    if (of_q[0] / samples == slot / samples) {
        return;
    }
    for (int i = 0, q = of_q[0] - of_q[0] % samples; kind == 0 && i < samples; i++) {
        of_p[i] = first + i;
        of_q[i] = q + i;
    }
    propose(kind ? 1 : samples, of_p, of_q, temperature);
}

int main(int argc, char **argv)
{
    enum { PHASES = 50 };
    const bool again = argc > 3;
    const double hot = again ? 0.003 : 0.02, cold = 0.0003, far = again ? 0.05 : 1, near = 0.015;
    samples = argc > 1 && atoi(argv[1]) == 4 ? 4 : 1;
    side = samples == 1 ? 64 : 32;
    pixels = side * side;
    const long long proposals = (argc > 2 ? atoll(argv[2]) : 6000) * BOXES, phase = proposals / PHASES;
    prepare();
    if (again && !read_table(argv[3])) {
        fprintf(stderr, "%s: not a table of this program\n", argv[3]);
        return 2;
    }
    for (long long i = 0; i < proposals; i++) {
        const double done = (double)i / (double)proposals;
        if (i % phase == 0) {
            rank = done < 0.25 && !again ? FEW : RANK;
            fprintf(stderr, "%.0f %%: %.4f of white noise\n", 100 * done, restart());
        }
        step(hot * pow(cold / hot, done), BOXES * far * pow(near / far, done) + 1);
    }
    fprintf(stderr, "%.4f of white noise\n", restart());
    if (samples == 4) {
        order();
    }
    printf("/* SPDX-License-Identifier: Apache-2.0 */\n/* The points of koksma/keys.h for quadruples with %s a "
           "pixel. Made "
           "by tools/make_keys_tile.c. */\n",
           samples == 1 ? "one sample" : "three or four samples");
    for (int i = 0; i < BOXES; i++) {
        printf("%d,%s", taken[boxes[i]], i % 16 == 15 ? "\n" : " ");
    }
    return 0;
}
