/* SPDX-License-Identifier: Apache-2.0 */
/* Charts of reports: numbers along every axis, and bars that say where they go on. */
#include <stdlib.h>
#include <string.h>

#include "study/report/report_chart.h"
#include "test.h"

/* The chart of two means at x = 1 and 2, 10 and `top`, with bars of low to high. */
static char *chart_of(bool log_y, double top, double low, double high)
{
    koksma__chart_series series = {
        .label = "s", .n = 2, .x = {1, 2}, .y = {10, top}, .low = {low, low}, .high = {high, high}};
    koksma__html html = {0};
    koksma__html_chart(
        &html,
        &(koksma__chart){.title = "t", .x_title = "x", .y_title = "y", .log_y = log_y, .n = 1, .series = &series});
    assert_false(html.failed);
    return html.text;
}

static size_t count(const char *text, const char *word)
{
    size_t n = 0;
    for (const char *at = text; (at = strstr(at, word)) != NULL; at++) {
        n++;
    }
    return n;
}

static void axes_have_three_numbers(void **state)
{
    (void)state;
    for (double top = 10.001; top < 1e5; top *= 1.17) {
        for (int log_y = 0; log_y < 2; log_y++) {
            char *text = chart_of(log_y, top, NAN, NAN);
            const size_t n = count(text, "text-anchor=\"end\"");
            assert_in_range(n, 3, 14);
            free(text);
        }
    }
}

/* On a logarithmic axis one to 0 has no end. */
static void only_bars_beyond_the_axis_have_arrowheads(void **state)
{
    (void)state;
    const struct {
        double low, high;
        size_t arrows;
    } cases[] = {{9, 21, 0}, {0, 21, 2}, {-5, 1e9, 4}, {NAN, NAN, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = chart_of(true, 20, cases[i].low, cases[i].high);
        assert_int_equal(count(text, "l3 ") + count(text, "l-3 "), 2 * cases[i].arrows);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_have_three_numbers),
        cmocka_unit_test(only_bars_beyond_the_axis_have_arrowheads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
