/* SPDX-License-Identifier: Apache-2.0 */
/* Decimal numbers against libc's strtod and printf, which round once: every fraction of 2^16, every decimal of 6 digits,
   neighbours of powers of ten, ties, random numbers of every kind of pattern, and what the quick road refuses. */

#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/random.h"
#include "test.h"

static void assert_reads(const char *text)
{
    char *end = NULL, *expected_end;
    const double expected = strtod(text, &expected_end);
    const double found = koksma__strtod(text, &end);
    assert_that(end == expected_end && memcmp(&found, &expected, sizeof found) == 0,
                "'%s' is read as %.17g up to '%s', not %.17g up to '%s'", text, found, end, expected, expected_end);
}

static void assert_writes(double x)
{
    char text[KOKSMA__DECIMAL_ROOM], expected[64];
    const size_t length = koksma__decimal_write(x, text);
    snprintf(expected, sizeof expected, "%.17g", x);
    if (!length) {
        assert_false(x >= 1e-4 && x <= 1 - 0x1p-53 && sizeof(void *) == 8); /* what the quick road is for */
    } else if (length != strlen(expected) || memcmp(text, expected, length) != 0) {
        fail_msg("%s is written as '%.*s'", expected, (int)length, text);
    }
    assert_reads(expected);
}

static uint64_t random_bits(uint64_t i)
{
    const koksma__words r = koksma__random(1, KOKSMA__PURPOSE_TEST, i, 0);
    return (uint64_t)r.w[0] << 32 | r.w[1];
}

TEST_CASE(numbers_go_there_and_back)
{
    for (uint32_t i = 0; i <= 65536; i++) {
        assert_writes(i / 65536.0);
        assert_writes(nextafter(i / 65536.0, 0));
        assert_writes(i / 3e5);
    }
    for (uint64_t i = 0; i < 300000; i++) {
        const uint64_t bits = random_bits(i);
        double any;
        memcpy(&any, &bits, sizeof any);
        assert_writes((double)(bits >> 11) * 0x1p-53);
        assert_writes((double)(bits >> 32) * 0x1p-32);
        assert_writes(exp2(-(double)(bits >> 32) * 0x1p-27));
        if (!isnan(any)) {
            assert_writes(any);
        }
    }
    for (int e = -30; e <= 30; e++) {
        double x = nextafter(nextafter(nextafter(pow(10, e), 0), 0), 0);
        for (int i = 0; i < 7; i++, x = nextafter(x, INFINITY)) {
            assert_writes(x);
            assert_writes(-x);
        }
    }
}

TEST_CASE(decimals_are_rounded_once)
{
    char text[64];
    for (int i = 0; i < 1000000; i++) {
        snprintf(text, sizeof text, "0.%06d", i);
        assert_reads(text);
    }
    for (uint64_t i = 0; i < 300000; i++) {
        const uint64_t w = random_bits(i), digits = w >> (w % 61), behind = random_bits(~i) % 30;
        snprintf(text, sizeof text, "%030llu,", (unsigned long long)digits);
        memmove(text + 31 - behind, text + 30 - behind, behind + 2);
        text[30 - behind] = '.';
        assert_reads(text);
        assert_reads(text + i % 30);
        /* halfway between two doubles, and next to it */
        const unsigned long long odd = 2 * (((uint64_t)1 << 53) / 2 + (w >> 13)) + 1;
        for (int k = -1; k <= 1; k++) {
            snprintf(text, sizeof text, "%llu.%s", odd - (k < 0), k < 0 ? "99" : k ? "01" : "00");
            assert_reads(text);
        }
    }
}

TEST_CASE(other_numbers_are_strtods)
{
    static const char *const texts[] = {"",
                                        ".",
                                        "0",
                                        "00",
                                        "1.",
                                        ".5",
                                        "1e5",
                                        "1E-3",
                                        "0x1p-2",
                                        "0X1",
                                        "1e",
                                        "1.5.2",
                                        "inf",
                                        "nan",
                                        "-0.5",
                                        "+1",
                                        " 2",
                                        "1x",
                                        "1,5",
                                        "0.5e",
                                        "1..2",
                                        "12345678901234567890",
                                        "18446744073709551616",
                                        "0.0000000000000000000000000001",
                                        "0.00000000000000000000000000000000000000001",
                                        "9999999999999999999",
                                        "0.9999999999999999999",
                                        "1.7976931348623157e308",
                                        "000000000000000000000000000000.5",
                                        "36893488147419103233.0"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        assert_reads(texts[i]);
    }
}
