/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lines, words and numbers of text in memory, for the readers of OBJ, MTL and PLY.
 *
 * A decimal number w 10^e of up to 19 digits, w below 2^53 and |e| <= 18, is computed by one correctly rounded
 * operation on two exact doubles (Clinger, "How to read floating point numbers accurately", 1990). Rounding that
 * double to a float is a second rounding, which can be wrong only when the double lies halfway between two floats.
 * Such numbers, and all numbers outside these limits, are read by strtof, which takes about ten times as long.
 */
#include "meshes/mesh_text.h"

#include <math.h>

#include "core/c_locale.h"

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

koksma__text koksma__text_open(const char *path, const unsigned char *file, size_t size)
{
    const bool marked = size >= 3 && !memcmp(file, "\357\273\277", 3);
    const char *text = (const char *)file;
    return (koksma__text){.path = path, .next = text + (marked ? 3 : 0), .end = text + size};
}

bool koksma__text_line(koksma__text *t)
{
    if (t->next >= t->end) {
        return false;
    }
    const char *stop = memchr(t->next, '\n', (size_t)(t->end - t->next));
    t->number++;
    t->at = t->next;
    t->stop = stop ? stop : t->end;
    t->next = stop ? stop + 1 : t->end;
    t->stop -= t->stop > t->at && t->stop[-1] == '\r';
    return true;
}

koksma_status koksma__text_full_line(koksma__text *t)
{
    const char *rest;
    while (koksma__text_line(t)) {
        koksma__text span = *t;
        if (koksma__text_rest(&span, &rest)) {
            return KOKSMA_OK;
        }
    }
    t->number++;
    return koksma__text_wrong(t, "the file ends before all data that it claims");
}

koksma_status koksma__text_wrong(const koksma__text *t, const char *reason)
{
    return koksma__fail(KOKSMA_MALFORMED, "%s: line %zu: %s", t->path, t->number, reason);
}

bool koksma__text_word(koksma__text *t, const char **word, size_t *length)
{
    while (t->at < t->stop && is_blank(*t->at)) {
        t->at++;
    }
    *word = t->at;
    while (t->at < t->stop && !is_blank(*t->at)) {
        t->at++;
    }
    *length = (size_t)(t->at - *word);
    return *length > 0;
}

size_t koksma__text_rest(koksma__text *t, const char **rest)
{
    const char *stop = t->stop;
    while (t->at < stop && is_blank(*t->at)) {
        t->at++;
    }
    while (stop > t->at && is_blank(stop[-1])) {
        stop--;
    }
    *rest = t->at;
    t->at = t->stop;
    return (size_t)(stop - *rest);
}

/* Appends digits to *w until it has 19; the number of the remaining digits is added to *left, and *lossy is set if
   one of them is not 0. Returns the number of all digits read. */
static size_t take_digits(const char **at, const char *end, uint64_t *w, int *left, bool *lossy)
{
    const char *first = *at;
    for (; *at < end && is_digit(**at); ++*at) {
        if (*w < 1000000000000000000u) {
            *w = 10 * *w + (uint64_t)(**at - '0');
        } else {
            ++*left;
            *lossy |= **at != '0';
        }
    }
    return (size_t)(*at - first);
}

/* Computes w 10^e if one correct rounding is certain; else returns false. */
static bool scale(uint64_t w, int e, float *out)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                    1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};
    if (w >> 53 || e < -18 || e > 18) {
        return false;
    }
    const double value = e < 0 ? (double)w / powers[-e] : (double)w * powers[e];
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    *out = (float)value;
    return (bits & 0x1fffffff) != 0x10000000 && (!w || value > 1e-30) && value < 1e38;
}

bool koksma__text_float(const char **at, const char *end, float *out)
{
    const char *from = *at;
    const bool negative = from < end && *from == '-';
    uint64_t w = 0;
    int e = 0, left = 0;
    bool lossy = false;
    from += negative || (from < end && *from == '+');
    size_t digits = take_digits(&from, end, &w, &left, &lossy);
    e = left;
    if (from < end && *from == '.') {
        from++;
        left = 0;
        const size_t more = take_digits(&from, end, &w, &left, &lossy);
        e -= (int)more - left;
        digits += more;
    }
    if (!digits) {
        return false;
    }
    if (from < end && (*from == 'e' || *from == 'E')) {
        const char *power = from + 1;
        const bool down = power < end && *power == '-';
        int exponent = 0;
        power += down || (power < end && *power == '+');
        const char *first = power;
        for (; power < end && is_digit(*power); power++) {
            exponent = exponent < 100000 ? 10 * exponent + (*power - '0') : exponent;
        }
        if (power > first) {
            e += down ? -exponent : exponent;
            from = power;
        }
    }
    if (lossy || !scale(w, e, out)) {
        *out = fabsf(koksma__strtof(*at, NULL));
    }
    *out = negative ? -*out : *out;
    *at = from;
    return true;
}

bool koksma__text_whole(const char **at, const char *end, long long *out)
{
    const long long most = 1ll << 62;
    const char *first = *at;
    *out = 0;
    for (; *at < end && is_digit(**at); ++*at) {
        *out = *out < most / 10 ? 10 * *out + (**at - '0') : most;
    }
    return *at > first;
}
