/* SPDX-License-Identifier: Apache-2.0 */
/* Stores points row by row, with the coordinates of a point adjacent, from columns of coordinates or, for a digital
   net, directly from its directions. If the upper half of a 64-bit lane has the exponent of 2^20 and the lower half a
   word w, the lane is the double 2^20 + w 2^-32. The words of an aligned group of 32 points of a net are those of the
   first group, xored with one word for each coordinate. */
#include <string.h>

#include "kernels/kernels.h"
#include "kernels/lanes64.h"

#define INLINE                                                                                                       \
    static inline __attribute__((always_inline)) /* inlined, so that there is one copy for each dim, stream
                                                               and kind of column */
#define EXPONENT 0x4130000000000000u

enum { BITS = 5, GROUP = 1 << BITS, MOST_DIM = 16, RUN = MOST_DIM * LANES64, TURN = GROUP / LANES64 };

/* group: the words of the first group. start: for each coordinate the word with which the current group is xored,
   repeated for LANES64 points. change[j]: the words that are xored into `start` on the step from group g to g + 1 if
   g + 1 ends in j zero bits. */
typedef struct net {
    uint64_t group[GROUP * MOST_DIM], start[RUN], change[32 - BITS][RUN];
} net;

/* Stores out[p dim + c] = word[c] for LANES64 points p. */
static void repeat(int dim, const uint32_t *word, uint64_t *out)
{
    for (int i = 0; i < dim * LANES64; i++) {
        out[i] = word[i % dim];
    }
}

static void make_net(size_t count, int dim, const uint32_t *const *directions, const uint32_t *starts, net *s)
{
    uint32_t word[MOST_DIM];
    for (int c = 0; c < dim; c++) {
        s->group[c] = EXPONENT;
        for (int i = 1; i < GROUP; i++) {
            s->group[i * dim + c] = s->group[(i & (i - 1)) * dim + c] ^ directions[c][__builtin_ctz((unsigned)i)];
        }
        word[c] = 0;
    }
    repeat(dim, starts, s->start);
    for (int j = 0; j < 32 - BITS && (size_t)GROUP << j < count; j++) {
        for (int c = 0; c < dim; c++) {
            word[c] ^= directions[c][BITS + j];
        }
        repeat(dim, word, s->change[j]);
    }
}

static inline lanes64_u load(const uint64_t *from)
{
    lanes64_u v;
    memcpy(&v, from, sizeof v);
    return v;
}

INLINE void store_group(const net *s, int dim, bool stream, double *out)
{
    const uint64_t *word = s->group;
    for (int turn = 0; turn < TURN; turn++) {
        for (int v = 0; v < dim; v++, word += LANES64, out += LANES64) {
            lanes64_store((lanes64_d)(load(word) ^ load(s->start + v * LANES64)) - 0x1p20, stream, out);
        }
    }
}

INLINE void rows(net *s, size_t count, int dim, bool stream, double *out)
{
    const size_t groups = count / GROUP;
    for (size_t g = 0; g < groups; g++, out += GROUP * dim) {
        store_group(s, dim, stream, out);
        const uint64_t *change = s->change[__builtin_ctzll(g + 1)];
        for (int i = 0; i < dim * LANES64 && (g + 1) * GROUP < count; i++) {
            s->start[i] ^= change[i];
        }
    }
    if (count % GROUP) {
        double last[GROUP * MOST_DIM];
        store_group(s, dim, false, last);
        memcpy(out, last, count % GROUP * (size_t)dim * sizeof *out);
    }
}

void KERNEL_NAME(digital_rows)(size_t count, int dim, const uint32_t *const *directions, const uint32_t *starts,
                               bool stream, double *out)
{
    net s;
    make_net(count, dim, directions, starts, &s);
    stream = stream && (uintptr_t)out % 16 == 0;
    if (dim == 2 && stream) {
        rows(&s, count, 2, true, out);
    } else if (dim == 4 && stream) {
        rows(&s, count, 4, true, out);
    } else if (dim == 2) {
        rows(&s, count, 2, false, out);
    } else if (dim == 4) {
        rows(&s, count, 4, false, out);
    } else {
        rows(&s, count, dim, stream, out);
    }
    if (stream) {
        lanes64_stored();
    }
}

typedef uint32_t half_lanes __attribute__((vector_size(4 * LANES64)));

/* Stores columns of doubles, or of words w that stand for w 2^-32; one of the two pointers is NULL. */
INLINE void store_columns(size_t count, int dim, const double *doubles, const uint32_t *words, size_t stride,
                          bool stream, double *out)
{
    size_t i = 0;
    for (; i + LANES64 <= count; i += LANES64) {
        lanes64_d v[4];
        for (size_t c = 0; c < (size_t)dim; c++) {
            if (doubles) {
                v[c] = lanes64_load_d(doubles + c * stride + i);
            } else {
                half_lanes w;
                memcpy(&w, words + c * stride + i, sizeof w);
                v[c] = (lanes64_d)(__builtin_convertvector(w, lanes64_u) | EXPONENT) - 0x1p20;
            }
        }
        lanes64_store_rows(v, dim, stream, out + (size_t)dim * i);
    }
    for (; i < count; i++) {
        for (size_t c = 0; c < (size_t)dim; c++) {
            out[(size_t)dim * i + c] = doubles ? doubles[c * stride + i] : words[c * stride + i] * 0x1p-32;
        }
    }
}

/* Branches on dim, 2 or 4, so that the compiler makes separate code for each. */
INLINE void rows_of(size_t count, int dim, const double *doubles, const uint32_t *words, size_t stride, bool stream,
                    double *out)
{
    stream = stream && (uintptr_t)out % 16 == 0;
    if (dim == 2 && stream) {
        store_columns(count, 2, doubles, words, stride, true, out);
    } else if (dim == 2) {
        store_columns(count, 2, doubles, words, stride, false, out);
    } else if (stream) {
        store_columns(count, 4, doubles, words, stride, true, out);
    } else {
        store_columns(count, 4, doubles, words, stride, false, out);
    }
    if (stream) {
        lanes64_stored();
    }
}

void KERNEL_NAME(rows_of_columns)(size_t count, int dim, const double *columns, size_t stride, bool stream,
                                  double *out)
{
    if (columns) { /* tells the compiler that columns is not NULL, so that the inlined rows_of drops the case of words */
        rows_of(count, dim, columns, NULL, stride, stream, out);
    }
}

void KERNEL_NAME(fraction_rows)(size_t count, int dim, const uint32_t *columns, size_t stride, bool stream,
                                double *out)
{
    rows_of(count, dim, NULL, columns, stride, stream, out);
}
