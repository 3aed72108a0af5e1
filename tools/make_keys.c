/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes include/koksma/keys.def: the ranking and scrambling keys of koksma/keys.h, by simulated annealing after Heitz
 * & others (2019). A program of its own, run by hand, some minutes; the same bits on every machine:
 *
 *     cc -O3 -std=c11 -ffp-contract=off -Iinclude tools/make_keys.c -lm -o /tmp/make_keys
 *     /tmp/make_keys > /tmp/keys.def && mv /tmp/keys.def include/koksma/
 *
 * For each table of TARGETS samples a pixel:
 * 1. The shared sequence: of CANDIDATES Owen scramblings that for which the keys below give the smallest mean square
 *    errors of smooth functions (four exponentials, twelve random waves), in units of those of independent scramblings: the
 *    largest such ratio, up to the target, or up to 256 samples in the last table, is made small. Heaviside steps have
 *    about the same error in all.
 * 2. Scrambling keys: 4,096 points of Sobol' in three dimensions, so that each value comes equally often: 8 digits of x, 8
 *    of y, and 256 pairings of strata. Pixels swap theirs so as to make E small: e_t(p) is the error of pixel p for step t,
 *    one of STEPS Heaviside functions whose edges pass through random points, in random directions or (every other one)
 *    along an axis,
 *        E = sum over t, p, q of e_t(p) e_t(q) exp(-|p - q|^2 / (2 s^2)),   s = 1.5 pixels, on the torus:
 *    the power of the errors at the frequencies that this Gaussian lets pass.
 * 3. Ranking keys, from the most significant bit on: which half of the samples so far comes first, again by E.
 */
#include <koksma/keys.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = KOKSMA_KEYS_SIZE, PIXELS = SIZE * SIZE, STEPS = 128, REACH = 5, CANDIDATES = 30000, TABLES = 3 };
enum { LANES = 16 };

static const uint32_t targets[TABLES] = {1, 4, 16};

static uint64_t counter;

static uint32_t draw(void)
{
    uint32_t w[4];
    koksma_words(2019, KOKSMA_FOR_POINT, counter++, 0, w);
    return w[0];
}

static double uniform(void)
{
    return draw() / 4294967296.0;
}

/* ---- Steps ------------------------------------------------------------------------------------------------- */

static double edges[STEPS][3], means[STEPS]; /* the step is 1 where edges[0] x + edges[1] y < edges[2] */

static void make_steps(void)
{
    for (int t = 0; t < STEPS; t++) {
        const double random = uniform(), angle = 1.5707963267948966 * (t % 2 ? 4 * random : t / 2 % 4);
        const double x = uniform(), y = uniform();
        edges[t][0] = cos(angle);
        edges[t][1] = sin(angle);
        edges[t][2] = edges[t][0] * x + edges[t][1] * y;
        int inside = 0;
        for (int i = 0; i < 512 * 512; i++) {
            inside += edges[t][0] * (i % 512 + 0.5) + edges[t][1] * (i / 512 + 0.5) < 512 * edges[t][2];
        }
        means[t] = inside / 262144.0;
    }
}

/* ---- Points of a key --------------------------------------------------------------------------------------- */

static uint32_t log2_of(uint32_t target)
{
    return target == 1 ? 0 : 1 + log2_of(target / 2);
}

static koksma_keys keys_of(uint64_t sequence, uint32_t word, uint32_t target, uint32_t salt)
{
    koksma_keys keys;
    memset(&keys, 0, sizeof keys);
    koksma__keys_of_word(word, log2_of(target), &keys);
    for (int k = 0; k < 2; k++) {
        keys.sequence[k] = koksma_seed_of(sequence, (uint32_t)k);
        keys.below[k] = koksma_seed_of(salt, (uint32_t)k);
    }
    return keys;
}

/* The errors of all steps at samples first .. first + count - 1 of the sequence, first a multiple of count. */
static void errors_of(const koksma_keys *keys, uint32_t first, uint32_t count, float *errors)
{
    int inside[STEPS] = {0};
    for (uint32_t i = 0; i < count; i++) {
        uint32_t w[2];
        koksma__keyed(keys, first + i, w);
        const double x = koksma_fraction(w[0]), y = koksma_fraction(w[1]);
        for (int t = 0; t < STEPS; t++) {
            inside[t] += edges[t][0] * x + edges[t][1] * y < edges[t][2];
        }
    }
    for (int t = 0; t < STEPS; t++) {
        errors[t] = (float)(inside[t] / (double)count - means[t]);
    }
}

/* ---- The shared sequence ----------------------------------------------------------------------------------- */

enum { SMOOTH = 16, SIZES = 12 };

static const uint32_t sizes[SIZES] = {1, 2, 3, 4, 6, 8, 12, 16, 32, 64, 128, 256};
static double waves[SMOOTH][3], exact[SMOOTH];

/* exp(x), exp(y), exp(x + y), exp(x - y), and cos(a x + b y + c), a and b to 2 pi. */
static double smooth(int f, double x, double y)
{
    return f < 4 ? exp((f != 1) * x + (f == 3 ? -y : (f > 0) * y))
                 : cos(waves[f][0] * x + waves[f][1] * y + waves[f][2]);
}

static void make_smooth(void)
{
    enum { SIDE = 256 };
    for (int f = 0; f < SMOOTH; f++) {
        waves[f][0] = 6.283185307179586 * uniform();
        waves[f][1] = 6.283185307179586 * (2 * uniform() - 1);
        waves[f][2] = 6.283185307179586 * uniform();
        for (int i = 0; i < SIDE * SIDE; i++) {
            exact[f] += smooth(f, (i % SIDE + 0.5) / SIDE, (i / SIDE + 0.5) / SIDE) / (SIDE * SIDE);
        }
    }
}

static void smooth_errors(const koksma_keys *keys, uint32_t first, uint32_t count, double *squares)
{
    double sums[SMOOTH] = {0};
    for (uint32_t i = 0; i < count; i++) {
        uint32_t w[2];
        koksma__keyed(keys, first + i, w);
        for (int f = 0; f < SMOOTH; f++) {
            sums[f] += smooth(f, koksma_fraction(w[0]), koksma_fraction(w[1]));
        }
    }
    for (int f = 0; f < SMOOTH; f++) {
        const double error = sums[f] / count - exact[f];
        squares[f] += error * error;
    }
}

/* The largest mean square error over functions and sizes, in units of those of independent scramblings. */
static double badness(uint64_t sequence, const uint32_t *words, uint32_t target, double reference[SIZES][SMOOTH],
                      double bound)
{
    enum { SAMPLED = 128 };
    double worst = 0;
    for (int n = 0; n < SIZES && (sizes[n] <= target || target == 16) && worst < bound; n++) {
        const uint32_t count = sizes[n];
        double squares[SMOOTH] = {0};
        for (uint32_t s = 0; s < SAMPLED; s++) {
            const koksma_keys keys =
                keys_of(sequence, words[(s * 1367 + 11) % PIXELS], count > target ? count : target, s);
            const uint32_t blocks = target > count && !(count & (count - 1)) ? target / count : 1;
            smooth_errors(&keys, s % blocks * count, count, squares);
        }
        for (int f = 0; f < SMOOTH; f++) {
            worst = fmax(worst, squares[f] / SAMPLED / reference[n][f]);
        }
    }
    return worst;
}

static uint64_t choose_sequence(const uint32_t *words, uint32_t target)
{
    enum { SCRAMBLINGS = 3000 };
    double reference[SIZES][SMOOTH] = {{0}}, least = INFINITY;
    uint64_t chosen = 0;
    for (int n = 0; n < SIZES; n++) {
        for (uint32_t s = 0; s < SCRAMBLINGS; s++) {
            const koksma_keys keys = keys_of(1000000 + s, 0, 1, s);
            smooth_errors(&keys, 0, sizes[n], reference[n]);
        }
        for (int f = 0; f < SMOOTH; f++) {
            reference[n][f] /= SCRAMBLINGS;
        }
    }
    for (uint64_t sequence = 1; sequence <= CANDIDATES; sequence++) {
        const double bad = badness(sequence, words, target, reference, least);
        if (bad < least) {
            least = bad;
            chosen = sequence;
        }
    }
    fprintf(stderr, "target %u: sequence %d, at most %.3f times the mean square errors\n", target, (int)chosen,
            least);
    return chosen;
}

/* ---- Annealing --------------------------------------------------------------------------------------------- */

static float errors[PIXELS][STEPS], others[PIXELS][STEPS], field[PIXELS][STEPS];
static float gauss[2 * REACH + 1][2 * REACH + 1];

static float weight(int p, int q)
{
    int x = abs(p % SIZE - q % SIZE), y = abs(p / SIZE - q / SIZE);
    x = x < SIZE - x ? x : SIZE - x;
    y = y < SIZE - y ? y : SIZE - y;
    return x <= REACH && y <= REACH ? gauss[y + REACH][x + REACH] : 0;
}

/* Adds a change of the error at a pixel to the field, the errors about each pixel weighted by the Gaussian. */
static void spread(int p, const float *change)
{
    for (int v = -REACH; v <= REACH; v++) {
        for (int u = -REACH; u <= REACH; u++) {
            float *at = field[(p / SIZE + v + SIZE) % SIZE * SIZE + (p % SIZE + u + SIZE) % SIZE];
            const float w = gauss[v + REACH][u + REACH];
            for (int t = 0; t < STEPS; t++) {
                at[t] += w * change[t];
            }
        }
    }
}

static void begin_field(void)
{
    memset(field, 0, sizeof field);
    for (int p = 0; p < PIXELS; p++) {
        spread(p, errors[p]);
    }
}

static double energy(void)
{
    double sum = 0;
    for (int p = 0; p < PIXELS; p++) {
        for (int t = 0; t < STEPS; t++) {
            sum += (double)errors[p][t] * field[p][t];
        }
    }
    return sum;
}

/* 2 d.(S + self d), d = to - from, S = field at p less that at q, in a fixed order of additions. */
static double gain(const float *from, const float *to, const float *at_p, const float *at_q, float self)
{
    float sums[LANES] = {0}, total = 0;
    for (int t = 0; t < STEPS; t += LANES) {
        for (int l = 0; l < LANES; l++) {
            const float d = to[t + l] - from[t + l], s = at_q ? at_p[t + l] - at_q[t + l] : at_p[t + l];
            sums[l] += d * (2 * s + self * d);
        }
    }
    for (int l = 0; l < LANES; l++) {
        total += sums[l];
    }
    return total;
}

static void exchange(float *a, float *b)
{
    for (int t = 0; t < STEPS; t++) {
        const float kept = a[t];
        a[t] = b[t];
        b[t] = kept;
    }
}

static void difference(const float *a, const float *b, float *out)
{
    for (int t = 0; t < STEPS; t++) {
        out[t] = a[t] - b[t];
    }
}

/* Swaps keys of two pixels (words), or takes the other half at one pixel (bits). The temperature falls from the mean of
   the first losses by a factor of 2000. */
static void anneal(uint32_t *words, unsigned char *bits, long proposals)
{
    double temperature = 0;
    float change[STEPS];
    begin_field();
    const double before = energy();
    for (long i = -1000; i < proposals; i++) {
        const int p = (int)(draw() % PIXELS);
        const int q = words ? (int)(draw() % PIXELS) : -1;
        if (p == q) {
            continue;
        }
        const double loss = words ? gain(errors[p], errors[q], field[p], field[q], 2 * (1 - weight(p, q)))
                                  : gain(errors[p], others[p], field[p], NULL, 1);
        if (i < 0) {
            temperature += fabs(loss) / 1000 / 2;
            continue;
        }
        const double now = temperature * pow(1.0 / 2000, (double)i / (double)proposals);
        if (loss > 0 && (loss > 20 * now || uniform() >= exp(-loss / now))) {
            continue;
        }
        float *instead = words ? errors[q] : others[p];
        difference(instead, errors[p], change);
        spread(p, change);
        if (words) {
            for (int t = 0; t < STEPS; t++) {
                change[t] = -change[t];
            }
            spread(q, change);
            const uint32_t kept = words[p];
            words[p] = words[q];
            words[q] = kept;
        } else {
            bits[p] ^= 1;
        }
        exchange(errors[p], instead);
        if (i % (1 << 20) == 0) {
            begin_field(); /* against the growth of rounding errors */
        }
    }
    begin_field();
    fprintf(stderr, "  energy %.4g to %.4g\n", before, energy());
}

/* ---- Tables ------------------------------------------------------------------------------------------------ */

static void make_table(uint32_t target, long proposals, uint64_t *sequence, uint32_t *words)
{
    const koksma_domain domain = {0x6b657973u + target};
    for (uint32_t p = 0; p < PIXELS; p++) {
        double xs[3];
        koksma_sobol_3d(domain, p, xs);
        words[p] = (uint32_t)(xs[0] * 256) | (uint32_t)(xs[1] * 256) << KOKSMA_KEYS_DIGITS |
                   (uint32_t)(xs[2] * 256) << 2 * KOKSMA_KEYS_DIGITS;
    }
    *sequence = choose_sequence(words, target);
    for (int p = 0; p < PIXELS; p++) {
        const koksma_keys keys = keys_of(*sequence, words[p], target, (uint32_t)p);
        errors_of(&keys, 0, target, errors[p]);
    }
    anneal(words, NULL, proposals);
    uint32_t first[PIXELS] = {0};
    for (uint32_t count = target / 2; count >= 1; count /= 2) {
        unsigned char bits[PIXELS];
        for (uint32_t p = 0; p < PIXELS; p++) {
            const koksma_keys keys = keys_of(*sequence, words[p], target, p);
            bits[p] = draw() & 1;
            errors_of(&keys, first[p] + (bits[p] ? count : 0), count, errors[p]);
            errors_of(&keys, first[p] + (bits[p] ? 0 : count), count, others[p]);
        }
        anneal(NULL, bits, proposals / 4);
        for (int p = 0; p < PIXELS; p++) {
            first[p] += bits[p] ? count : 0;
        }
    }
    for (int p = 0; p < PIXELS; p++) {
        words[p] |= first[p] << 3 * KOKSMA_KEYS_DIGITS;
    }
}

int main(int argc, char **argv)
{
    static uint32_t words[TABLES][PIXELS];
    uint64_t sequences[TABLES];
    const long proposals = argc > 1 ? atol(argv[1]) : 6000000;
    make_steps();
    make_smooth();
    for (int v = -REACH; v <= REACH; v++) {
        for (int u = -REACH; u <= REACH; u++) {
            gauss[v + REACH][u + REACH] = (float)exp(-(u * u + v * v) / (2 * 1.5 * 1.5));
        }
    }
    for (int table = 0; table < TABLES; table++) {
        make_table(targets[table], proposals, &sequences[table], words[table]);
    }
    printf("/* SPDX-License-Identifier: Apache-2.0 */\n"
           "/* The tables of koksma/keys.h, for 1, 4 and 16 samples a pixel: the sequence, then a word a pixel.\n"
           "   Made by tools/make_keys.c. */\n");
    for (int table = 0; table < TABLES; table++) {
        printf("{%d", (int)sequences[table]);
        for (int p = 0; p < PIXELS; p++) {
            printf("%s0x%x", p % 12 ? ", " : ",\n", words[table][p]);
        }
        printf(table < TABLES - 1 ? "},\n" : "}\n");
    }
    return 0;
}
