/* SPDX-License-Identifier: Apache-2.0 */
/* koksma__paced by a clock of the test's: a question is passed on once in an interval, and a no stays one. */
#include "test.h"

#include "core/clock.h"
#include "core/parallel.h"

static double now_s;

static double clock_of_test(void)
{
    return now_s;
}

typedef struct {
    int asked;
    double fraction;
    bool answer;
} listener;

static bool listen(void *context, double fraction_done)
{
    listener *l = context;
    l->asked++;
    l->fraction = fraction_done;
    return l->answer;
}

TEST_CASE(test_paced)
{
    listener l = {.answer = true};
    koksma__pacing pacing = {.keep_going = listen, .context = &l, .interval_s = 0.25};
    koksma__set_clock(clock_of_test);
    for (int i = 0; i < 64; i++) { /* 16 s, a quarter of an interval apart: asked at every fourth but the first */
        now_s = 100 + i / 16.0;
        assert_true(koksma__paced(&pacing, i));
        assert_int_equal(l.asked, i / 4);
        if (i % 4 == 0 && i > 0) {
            assert_true(l.fraction == i);
        }
    }
    l.answer = false;
    now_s += 1;
    assert_false(koksma__paced(&pacing, 64));
    l.answer = true;
    for (int i = 0; i < 3; i++) {
        now_s += 1;
        assert_false(koksma__paced(&pacing, 65));
    }
    assert_int_equal(l.asked, 16);
    koksma__set_clock(NULL);
}
