/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Numbers as text. strtod and vsnprintf are called in the locale "C", because the host program may have chosen a decimal
 * comma. uselocale changes the locale only for this thread. The locale object is created once and exists until the process
 * ends.
 *
 * The common numbers need no libc, which takes several times as long: they are converted to doubles and back by exact
 * arithmetic in 128 bits; no power of ten is approximated, so that every rounding is decided. libc converts numbers that do
 * not fit, and all numbers if the compiler has no 128-bit integers.
 *
 * Reading w 10^-k, w < 2^64, k <= 27: 5^k fits into 64 bits. With w and 5^k shifted so that their top bits are set,
 * the quotient of w 2^63 by 5^k has 63 or 64 bits; if there is a remainder, the lowest bit of the quotient is set to
 * 1, so that rounding it to 53 bits rounds the exact value.
 *
 * Writing x = m 2^e from 1e-4 to 1 with 17 digits: choose p, 17 <= p <= 20, such that x 10^p has 17 digits; m 5^p
 * then fits into 100 bits. x 10^p = m 5^p 2^(e + p) is m 5^p shifted, and the bits that are shifted out decide the
 * rounding, with ties to even as in printf.
 */
#include "core/c_locale.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "core/platform/system.h"

/* ---- Without libc ---- */

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 wide;

/* 5^k, k <= 27 */
static uint64_t power_of_5(unsigned k)
{
    static const uint32_t low[8] = {1, 5, 25, 125, 625, 3125, 15625, 78125};
    static const uint64_t high[4] = {1, 390625, 152587890625, 59604644775390625};
    return low[k % 8] * high[k / 8];
}

static double quotient(uint64_t w, unsigned k)
{
    if (w == 0 || k == 0) {
        return (double)w;
    }
    const uint64_t five = power_of_5(k);
    const int up_w = __builtin_clzll(w), up_five = __builtin_clzll(five);
    const wide numerator = (wide)(w << up_w) << 63;
    const uint64_t divisor = five << up_five;
    uint64_t q = (uint64_t)(numerator / divisor);
    q |= numerator != (wide)q * divisor;
    const uint64_t scale = (uint64_t)(1023 + up_five - up_w - (int)k - 63) << 52;
    double power;
    memcpy(&power, &scale, sizeof power);
    return (double)q * power;
}

/* Reads a number as strtod does if it is only digits and at most one point, with at most 19 digits without leading
   zeros and at most 27 digits after the point. Returns false for any other number, which the caller leaves to strtod.
   *end: the first character after the number. */
static bool read_decimal(const char *text, char **end, double *out)
{
    enum { MOST = 19 };
    uint64_t w = 0;
    /* point: the decimal point; first: the first digit that is not 0 */
    const char *s = text, *point = NULL, *first = NULL;
    for (;; s++) {
        const unsigned digit = (unsigned)*s - '0';
        if (digit <= 9) {
            first = first || !digit ? first : s;
            w = 10 * w + digit; /* if there are too many digits, w wraps around; libc reads such a number below */
        } else if (*s == '.' && !point) {
            point = s;
        } else {
            break;
        }
    }
    const ptrdiff_t digits = s - text - (point != NULL), behind = point ? s - point - 1 : 0;
    const ptrdiff_t significant = first ? s - first - (point && point > first) : 0;
    const char next = (char)(*s | 32);
    if (digits < 1 || significant > MOST || behind > 27 || next == 'e' || next == 'x') {
        return false;
    }
    *end = (char *)s;
    *out = quotient(w, (unsigned)behind);
    return true;
}

/* Writes digits 16 .. 0 of d < 10^17 in pairs. The upper 9 and the lower 8 digits are computed independently, for
   speed. */
static void put_digits(uint64_t d, char text[17])
{
    uint32_t halves[2] = {(uint32_t)(d / 100000000), (uint32_t)(d % 100000000)};
    for (int i = 7; i > 0; i -= 2) {
        for (int half = 0; half < 2; half++) {
            const uint32_t pair = halves[half] % 100;
            halves[half] /= 100;
            text[i + 8 * half] = (char)('0' + pair / 10);
            text[i + 8 * half + 1] = (char)('0' + pair % 10);
        }
    }
    text[0] = (char)('0' + halves[0]);
}

size_t koksma__decimal_write(double x, char text[KOKSMA__DECIMAL_ROOM])
{
    if (x >= 1e-4 && x < 1) {
        const unsigned zeros = (x < 1e-1) + (x < 1e-2) + (x < 1e-3), p = 17 + zeros;
        uint64_t bits;
        memcpy(&bits, &x, sizeof bits);
        const wide product = (wide)((bits & 0xfffffffffffffu) | 0x10000000000000u) * power_of_5(p);
        const int shift = 1075 - (int)(bits >> 52) - (int)p; /* 33 to 50 */
        const uint64_t rest = (uint64_t)product & (((uint64_t)1 << shift) - 1), half = (uint64_t)1 << (shift - 1);
        uint64_t digits = (uint64_t)(product >> shift);
        digits += rest > half || (rest == half && digits % 2);
        if (digits < 100000000000000000u) {
            memcpy(text, "0.000", 5);
            put_digits(digits, text + 2 + zeros);
            size_t length = 2 + zeros + 17;
            while (text[length - 1] == '0') {
                length--;
            }
            return length;
        }
    }
    return 0;
}
#else
static bool read_decimal(const char *text, char **end, double *out)
{
    (void)text, (void)end, (void)out;
    return false;
}

size_t koksma__decimal_write(double x, char text[KOKSMA__DECIMAL_ROOM])
{
    (void)x, (void)text;
    return 0;
}
#endif

/* ---- By libc ---- */

double koksma__strtod(const char *text, char **end)
{
    double quick;
    char *stop;
    if (read_decimal(text, &stop, &quick)) {
        if (end) {
            *end = stop;
        }
        return quick;
    }
    const koksma__locale before = koksma__locale_enter();
    const double value = strtod(text, end);
    koksma__locale_leave(before);
    return value;
}

float koksma__strtof(const char *text, char **end)
{
    const koksma__locale before = koksma__locale_enter();
    const float value = strtof(text, end);
    koksma__locale_leave(before);
    return value;
}

int koksma__vsnprintf(char *text, size_t size, const char *format, va_list arguments)
{
    const koksma__locale before = koksma__locale_enter();
    const int length = vsnprintf(text, size, format, arguments);
    koksma__locale_leave(before);
    return length;
}

int koksma__snprintf(char *text, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = koksma__vsnprintf(text, size, format, arguments);
    va_end(arguments);
    return length;
}

/* ---- CSV; a field gets quotes only if readers need them ---- */

void koksma__csv_put(FILE *stream, const char *text)
{
    const bool formula = *text && strchr("=+@-\t", *text) && !(*text == '-' && !text[1]);
    if (!formula && !strpbrk(text, ",\"\r\n")) {
        fputs(text, stream);
        return;
    }
    putc_unlocked('"', stream);
    if (formula) {
        putc_unlocked('\'', stream);
    }
    for (; *text; text++) {
        if (*text == '"') {
            putc_unlocked('"', stream);
        }
        putc_unlocked(*text, stream);
    }
    putc_unlocked('"', stream);
}

size_t koksma__csv_whole(uint64_t number, char text[KOKSMA__CSV_NUMBER])
{
    char digits[KOKSMA__CSV_NUMBER];
    size_t first = sizeof digits;
    do {
        digits[--first] = (char)('0' + number % 10);
        number /= 10;
    } while (number);
    memcpy(text, digits + first, sizeof digits - first);
    return sizeof digits - first;
}

size_t koksma__csv_number(double number, char text[KOKSMA__CSV_NUMBER])
{
    const size_t length = isnan(number) ? 0 : koksma__decimal_write(number, text);
    return length || isnan(number) ? length : (size_t)koksma__snprintf(text, KOKSMA__CSV_NUMBER, "%.17g", number);
}
