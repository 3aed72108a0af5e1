/* SPDX-License-Identifier: Apache-2.0 */
/* What plots refuse: sizes, grids, formats and points that can't be drawn. */
#include <stdlib.h>
#include <string.h>

#include <koksma/plot.h>

#include "test.h"

static double xs[] = {0.5, 0.25, 0.75, 0.125};

static koksma_status scatter(const koksma_points *points, const koksma_scatter_options *options, int format)
{
    unsigned char *bytes = NULL;
    size_t size = 0;
    const koksma_status status = koksma_plot_scatter(points, options, (koksma_plot_format)format, &bytes, &size);
    assert_true(status || (bytes && size > 100));
    free(bytes);
    return status;
}

static void sizes_and_grids(void **state)
{
    (void)state;
    const koksma_points p = {2, 2, xs};
    static const double odd[] = {-5, NAN, INFINITY, 1e9, 1e-9, 15};
    assert_ok(scatter(&p, NULL, KOKSMA_PLOT_SVG));
    assert_ok(scatter(&p, &(koksma_scatter_options){.size = 16}, KOKSMA_PLOT_PNG));
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        for (int format = 0; format < 3; format++) {
            assert_int_equal(scatter(&p, &(koksma_scatter_options){.size = odd[i]}, format), KOKSMA_ARGUMENT);
        }
    }
    assert_int_equal(scatter(&p, &(koksma_scatter_options){.columns = (size_t)1 << 40}, 0), KOKSMA_ARGUMENT);
    assert_int_equal(scatter(&p, &(koksma_scatter_options){.rows = KOKSMA_PLOT_MAX_CELLS + 1}, 0), KOKSMA_ARGUMENT);
    assert_int_equal(scatter(&p, NULL, 77), KOKSMA_ARGUMENT);
}

static void points_of_the_unit_square(void **state)
{
    (void)state;
    double nan[] = {0.5, NAN};
    assert_int_equal(scatter(&(koksma_points){1, 2, nan}, NULL, 0), KOKSMA_ARGUMENT);
    assert_int_equal(scatter(&(koksma_points){0, 2, xs}, NULL, 0), KOKSMA_ARGUMENT);
    assert_int_equal(scatter(&(koksma_points){1, 1, xs}, NULL, 0), KOKSMA_DIM);
    unsigned char *bytes;
    size_t size;
    const koksma_panel nothing = {0};
    assert_int_equal(koksma_plot_panels(&nothing, 1, 0, KOKSMA_PLOT_SVG, &bytes, &size), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_plot_strata(NULL, 0, -1, KOKSMA_PLOT_SVG, &bytes, &size), KOKSMA_ARGUMENT);
}

static int count(const char *text, const char *what)
{
    int n = 0;
    for (; (text = strstr(text, what)); text++) {
        n++;
    }
    return n;
}

/* Needless splits are black boxes and needed ones circles; without splits there is neither. */
static void splits_are_marked(void **state)
{
    (void)state;
    static const char black[] = "rgb(0%,0%,0%)", green[] = "rgb(0%,50%,20%)";
    const koksma_stratum strata[] = {{0, 0, 0.5, 1, {0.2, 0.2}, 0.3, 0}, {0.5, 0, 0.5, 1, {0.7, 0.2}, 0.9, 0}};
    const koksma_split splits[] = {{0, 0, 0.5, 1, 0, true}, {0.5, 0, 0.5, 1, 0, false}, {0.5, 0, 0.1, 0.1, 1, false}};
    const koksma_strata_panel panels[] = {{strata, 2, splits, 3, "a"}, {strata, 2, NULL, 0, NULL}};
    for (size_t first = 0; first < 2; first++) {
        unsigned char *bytes;
        size_t size;
        assert_ok(koksma_plot_strata(panels + first, 2 - first, 0, KOKSMA_PLOT_SVG, &bytes, &size));
        char *text = calloc(size + 1, 1);
        assert_non_null(text);
        for (size_t i = 0, n = 0; i < size; i++) { /* versions of cairo put spaces into colours, or none */
            text[n] = (char)bytes[i];
            n += bytes[i] != ' ';
        }
        assert_int_equal(count(text, black), first ? 0 : 1);
        assert_int_equal(count(text, green), first ? 0 : 2);
        free(text);
        free(bytes);
    }
}

static void charts_without_labels(void **state)
{
    (void)state;
    unsigned char *bytes;
    size_t size;
    koksma_chart chart = {0};
    assert_int_equal(koksma_plot_chart(&chart, KOKSMA_PLOT_SVG, &bytes, &size), KOKSMA_ARGUMENT);
    assert_null(strstr(koksma_error_text(), "null"));
    const koksma_curve curve = {.n = 2, .xs = xs, .ys = xs};
    chart = (koksma_chart){.curves = &curve, .n_curves = 1};
    assert_ok(koksma_plot_chart(&chart, KOKSMA_PLOT_SVG, &bytes, &size));
    free(bytes);
    chart.size = NAN;
    assert_int_equal(koksma_plot_chart(&chart, KOKSMA_PLOT_SVG, &bytes, &size), KOKSMA_ARGUMENT);
}

/* The stroke and the dashes of the last line drawn: of the legend's last entry. */
static void last_style(const char *svg, char *out, size_t size)
{
    const char *last = NULL; /* versions of cairo write stroke-width:1.8 or stroke-width="1.8" */
    for (const char *at = svg; (at = strstr(at, "stroke-width")) != NULL; at++) {
        const char *wide = strstr(at, "1.8");
        last = wide && wide - at <= 14 ? at : last;
    }
    assert_non_null(last);
    const char *end = strstr(last, " d=\"");
    const size_t n = (size_t)(end - last);
    assert_true(end && n < size);
    memcpy(out, last, n);
    out[n] = 0;
}

/* Each of 18 curves has its own colour or its own dashes; those of a curve of many points go on from one to the next.
 */
static void eighteen_curves_differ(void **state)
{
    enum { CURVES = 18, POINTS = 200 };
    double line_xs[POINTS], line_ys[POINTS];
    char styles[CURVES][256];
    (void)state;
    for (int i = 0; i < POINTS; i++) {
        line_xs[i] = line_ys[i] = i;
    }
    for (size_t c = 0; c < CURVES; c++) {
        unsigned char *bytes;
        size_t size;
        const koksma_curve curve = {.label = "a", .n = POINTS, .xs = line_xs, .ys = line_ys, .colour = c};
        const koksma_chart chart = {.curves = &curve, .n_curves = 1};
        assert_int_equal(koksma_plot_chart(&chart, KOKSMA_PLOT_SVG, &bytes, &size), KOKSMA_OK);
        char *svg = calloc(size + 1, 1);
        assert_non_null(svg);
        memcpy(svg, bytes, size);
        last_style(svg, styles[c], sizeof styles[c]);
        for (size_t other = 0; other < c; other++) {
            assert_string_not_equal(styles[c], styles[other]);
        }
        assert_int_equal(strstr(svg, "stroke-dashoffset") != NULL, c >= 6);
        free(svg);
        free(bytes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_and_grids),        cmocka_unit_test(points_of_the_unit_square),
        cmocka_unit_test(splits_are_marked),      cmocka_unit_test(charts_without_labels),
        cmocka_unit_test(eighteen_curves_differ),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
