/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Mutations of texts for libFuzzer, by words and lines: one is removed, replaced by another one of the text or of another
 * input, by a number or by mutated bytes, or another one is put before it. Most changes of single bytes make a word
 * unknown, or the syntax wrong. One input in three, and those with a zero byte, are mutated by bytes.
 */
#include <ctype.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "mutate.h"

enum { MAX_PARTS = 4096, MAX_WORD = 256 };

/* The parts of a text: words, or lines with their ends. */
typedef struct part {
    size_t begin, end;
} part;

typedef struct text {
    const uint8_t *bytes;
    size_t size, n;
    part parts[MAX_PARTS];
} text;

static bool in_word(uint8_t byte)
{
    return isalnum(byte) || (byte && strchr("+-._", byte)) || byte > 127;
}

/* Splits a text into lines, or into words: each is a run of letters, digits and the signs of numbers, or one other
   character. */
static void split(text *t, const uint8_t *bytes, size_t size, bool lines)
{
    t->bytes = bytes;
    t->size = size;
    t->n = 0;
    for (size_t at = 0, end; at < size && t->n < MAX_PARTS; at = end) {
        end = at + 1;
        if (lines) {
            const uint8_t *next = memchr(bytes + at, '\n', size - at);
            end = next ? (size_t)(next - bytes) + 1 : size;
        } else if (in_word(bytes[at])) {
            while (end < size && in_word(bytes[end])) {
                end++;
            }
        } else if (isspace(bytes[at])) {
            continue;
        }
        t->parts[t->n++] = (part){at, end};
    }
}

/* Writes the text to `out` with a part replaced. 0: it is too long. */
static size_t put(const text *t, part at, const uint8_t *with, size_t length, uint8_t *out, size_t max_size)
{
    const size_t size = t->size - (at.end - at.begin) + length;
    if (size > max_size) {
        return 0;
    }
    memcpy(out, t->bytes, at.begin);
    memcpy(out + at.begin, with, length);
    memcpy(out + at.begin + length, t->bytes + at.end, t->size - at.end);
    return size;
}

static size_t put_other(const text *t, part at, uint8_t *out, size_t max_size)
{
    static const char *const numbers[] = {"0",    "1",     "-1",         "2",           "0.5",
                                          "1e30", "-1e30", "2147483648", "-2147483649", "18446744073709551616",
                                          "nan",  "1e-30", "16777216"};
    uint8_t word[MAX_WORD];
    if (below(2)) {
        const char *number = numbers[below(sizeof numbers / sizeof *numbers)];
        return put(t, at, (const uint8_t *)number, strlen(number), out, max_size);
    }
    const size_t length = at.end - at.begin < MAX_WORD ? at.end - at.begin : MAX_WORD;
    memcpy(word, t->bytes + at.begin, length);
    return put(t, at, word, LLVMFuzzerMutate(word, length, MAX_WORD), out, max_size);
}

/* Changes one part of t, a text of words or lines, with parts of `from`. 0: it is too long, or there is none. */
static size_t change(const text *t, const text *from, uint8_t *out, size_t max_size)
{
    if (t->n == 0 || from->n == 0) {
        return 0;
    }
    const part at = t->parts[below(t->n)], like = from->parts[below(from->n)];
    switch (below(4)) {
    case 0:
        return put(t, at, t->bytes, 0, out, max_size);
    case 1:
        return put(t, at, from->bytes + like.begin, like.end - like.begin, out, max_size);
    case 2:
        return put(t, (part){at.begin, at.begin}, from->bytes + like.begin, like.end - like.begin, out, max_size);
    default:
        return put_other(t, at, out, max_size);
    }
}

/* Makes up to four changes of the first text, with parts of the second. */
static size_t mutate(const uint8_t *first, size_t first_size, const uint8_t *second, size_t second_size, uint8_t *out,
                     size_t max_size)
{
    static text t, from;
    uint8_t *work = malloc(max_size + 1);
    size_t size = first_size;
    if (!work || first_size == 0 || second_size == 0 || first_size > max_size) {
        free(work);
        return 0;
    }
    memcpy(out, first, first_size);
    for (size_t i = below(4) + 1; i > 0; i--) {
        const bool lines = below(3) == 0;
        memcpy(work, out, size);
        split(&t, work, size, lines);
        split(&from, second, second_size, lines);
        const size_t changed = change(&t, &from, out, max_size);
        if (changed == 0) {
            memcpy(out, work, size);
        }
        size = changed ? changed : size;
    }
    free(work);
    return size;
}

size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size, size_t max_size, unsigned seed)
{
    *mutate_state() = seed;
    uint8_t *copy = below(3) && !memchr(bytes, 0, size) ? malloc(size + 1) : NULL;
    if (copy) {
        memcpy(copy, bytes, size);
        const size_t length = mutate(copy, size, copy, size, bytes, max_size);
        free(copy);
        if (length) {
            return length;
        }
    }
    return LLVMFuzzerMutate(bytes, size, max_size);
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *first, size_t first_size, const uint8_t *second, size_t second_size,
                                 uint8_t *out, size_t max_size, unsigned seed)
{
    *mutate_state() = seed;
    return mutate(first, first_size, second, second_size, out, max_size);
}
