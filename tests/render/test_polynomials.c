/* SPDX-License-Identifier: Apache-2.0 */
/* The polynomials of render/vector3.h against long double: their greatest errors are no more than the header says,
   over the ranges that it says. */
#include "render/vector3.h"

#include "test.h"

#define PI_L 3.141592653589793238462643383279502884L

TEST_CASE(sines_and_cosines)
{
    long double worst = 0;
    for (int32_t i = -(1 << 20); i <= 1 << 20; i++) {
        const float turns = (float)i * 0x1.8p-19f; /* -3 to 3, with all multiples of 1/8 */
        float sine, cosine;
        koksma__sine_cosine_turns(turns, &sine, &cosine);
        worst = fmaxl(worst, fabsl((long double)sine - sinl(2 * PI_L * (long double)turns)));
        worst = fmaxl(worst, fabsl((long double)cosine - cosl(2 * PI_L * (long double)turns)));
    }
    for (int32_t i = -(1 << 20); i <= 1 << 20; i++) {
        const float angle = (float)i * (float)(PI_L / 4 * 0x1p-20L);
        float sine, cosine;
        koksma__sine_cosine(angle, &sine, &cosine);
        worst = fmaxl(worst, fabsl((long double)sine - sinl((long double)angle)));
        worst = fmaxl(worst, fabsl((long double)cosine - cosl((long double)angle)));
    }
    assert_near((double)worst, 0, KOKSMA__SINE_ERROR);
    float sine, cosine;
    koksma__sine_cosine_turns(0x1p18f + 0.25f, &sine, &cosine);
    assert_near((double)sine, 1, KOKSMA__SINE_ERROR);
    assert_near((double)cosine, 0, KOKSMA__SINE_ERROR);
}

TEST_CASE(arcs)
{
    long double worst = 0;
    for (int i = 0; i < 2000; i++) {
        for (int j = 0; j < 500; j++) {
            const long double angle = 2 * PI_L * ((long double)i + (long double)j / 500) / 2000;
            const long double length = powl(10, (long double)(j % 37) - 18);
            const float x = (float)(length * cosl(angle)), y = (float)(length * sinl(angle));
            const long double exact = atan2l((long double)y, (long double)x) / (2 * PI_L);
            worst = fmaxl(worst, fabsl((long double)koksma__arc_turns(y, x) - exact));
        }
    }
    assert_near((double)worst, 0, KOKSMA__ARC_ERROR);
    assert_float_equal(koksma__arc_turns(0, 0), 0, 0);
    assert_float_equal(koksma__arc_turns(0, -1), 0.5f, 0);
    assert_float_equal(koksma__arc_turns(-1, 0), -0.25f, 0);
}

TEST_CASE(powers)
{
    long double worst = 0;
    for (int i = 0; i <= 4000; i++) {
        /* close to 1 in half of them, where large exponents are */
        const float base = i % 2 ? (float)(1 - powl(2, -24 * (long double)i / 4000)) : (float)i / 4000;
        for (int j = -20; base > 0 && j <= 200; j++) {
            const float exponent = j == -20 ? 0 : powf(10, (float)j / 28.6f);
            const long double exact = powl((long double)base, (long double)exponent);
            const long double value = (long double)koksma__power(base, exponent);
            if (exact > 0x1p-125L) {
                worst = fmaxl(worst, fabsl(value / exact - 1));
            } else if (!(value <= 0x1.01p-125L)) {
                fail_msg("%g^%g is %Lg", (double)base, (double)exponent, value);
            }
        }
    }
    assert_near((double)worst, 0, KOKSMA__POWER_ERROR);
    assert_float_equal(koksma__power(1, 1e6f), 1, 0);
    assert_float_equal(koksma__power(0, 0), 1, 0);
    assert_float_equal(koksma__power(0, 1), 0, 0);
}
