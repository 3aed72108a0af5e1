/* SPDX-License-Identifier: Apache-2.0 */
/* Digital sequences in base 2 beyond point 2^32 (parts.h): cuts ranges at multiples of 2^32, and adds the digits that
   all points of a part share. Within a part the loops for 32-bit words do the work. */
#include "patterns/nets/nets.h"

#include "core/status.h"

enum { FEW = 256 };

koksma_status koksma__range_parts(const koksma_args *args, koksma_points *out, koksma__part f, const void *context)
{
    const uint64_t length = (uint64_t)1 << 32;
    koksma_args part_args = *args;
    koksma_points part = {0, out->dim, out->xs};
    koksma_status status = KOKSMA_OK;
    for (size_t done = 0; done < out->n && !status; done += part.n) {
        const uint64_t at = args->first + done, left = out->n - done, room = length - at % length;
        part.n = (size_t)(left < room ? left : room);
        part.xs = out->xs + done * (size_t)out->dim;
        part_args.first = at % length;
        status = f(context, at / length, &part_args, &part);
    }
    return status;
}

uint64_t koksma__part_sum(const uint64_t columns[KOKSMA__DIGITS], uint64_t part)
{
    uint64_t sum = 0;
    for (int b = 32; part && b < KOKSMA__DIGITS; b++, part >>= 1) {
        sum ^= part & 1 ? columns[b] : 0;
    }
    return sum;
}

uint64_t koksma__mirror_digits(uint64_t rows)
{
    uint64_t column = 0;
    for (int r = 0; r < KOKSMA__DIGITS; r++, rows >>= 1) {
        column = column << 1 | (rows & 1);
    }
    return column;
}

/* Adds to several rows at once, so that the loop can be vectorised for few dimensions. */
static void add_digits(const void *context, size_t first, size_t count, bool stream, koksma_points *out)
{
    (void)stream;
    const uint64_t *sums = context;
    const size_t dim = (size_t)out->dim, rows = dim < FEW ? FEW / dim : 1;
    double *xs = out->xs + first * dim, adds[KOKSMA_MAX_DIM];
    for (size_t k = 0; k < rows * dim; k++) {
        adds[k] = (double)(int64_t)(sums[k % dim] & KOKSMA__LATE_MASK) * 0x1p-53;
    }
    for (size_t done = 0; done < count; done += rows) {
        const size_t some = (count - done < rows ? count - done : rows) * dim;
        for (size_t k = 0; k < some; k++) {
            xs[done * dim + k] += adds[k];
        }
    }
}

koksma_status koksma__add_late_digits(const koksma_run *run, const uint64_t *sums, koksma_points *out)
{
    return koksma__fill_rows(run, out, add_digits, sums);
}

void koksma__late_partners(const uint64_t columns[KOKSMA__DIGITS], uint64_t partners[KOKSMA__LATE_DIGITS])
{
    for (int l = 32; l < KOKSMA__DIGITS; l++) {
        uint64_t rest = columns[l], partner = 0;
        for (int c = l - 1; c >= 0; c--) {
            if (rest >> (KOKSMA__DIGITS - 1 - c) & 1) {
                rest ^= columns[c];
                partner |= (uint64_t)1 << c;
            }
        }
        partners[l - 32] = partner;
    }
}
