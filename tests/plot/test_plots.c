/* SPDX-License-Identifier: Apache-2.0 */
/* What plots refuse (sizes, grids, formats, points that can't be drawn), and what is in them: marks, dashes, colours, and
   the same bytes each time. tests/plot/pictures.py looks at those of the program. */
#include <stdlib.h>
#include <string.h>

#include <koksma/plot.h>

#include "test.h"

enum { COLOURS = 8 };

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

TEST_CASE(sizes_and_grids)
{
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

TEST_CASE(points_of_the_unit_square)
{
    double nan[] = {0.5, NAN};
    assert_int_equal(scatter(&(koksma_points){1, 2, nan}, NULL, 0), KOKSMA_ARGUMENT);
    assert_int_equal(scatter(&(koksma_points){0, 2, xs}, NULL, 0), KOKSMA_ARGUMENT);
    assert_int_equal(scatter(&(koksma_points){1, 1, xs}, NULL, 0), KOKSMA_DIM);
    unsigned char *bytes;
    size_t size;
    const koksma_panel nothing = {0};
    const koksma_figure empty = {.cells = &(koksma_cell){.panel = &nothing}, .n_cells = 1};
    assert_int_equal(koksma_plot_figure(&empty, KOKSMA_PLOT_SVG, NULL, &bytes, &size), KOKSMA_ARGUMENT);
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
TEST_CASE(splits_are_marked)
{
    static const char black[] = "fill=\"#000000\"", green[] = "stroke=\"#008033\"";
    const koksma_stratum strata[] = {{0, 0, 0.5, 1, {0.2, 0.2}, 0.3, 0}, {0.5, 0, 0.5, 1, {0.7, 0.2}, 0.9, 0}};
    const koksma_split splits[] = {{0, 0, 0.5, 1, 0, true}, {0.5, 0, 0.5, 1, 0, false}, {0.5, 0, 0.1, 0.1, 1, false}};
    const koksma_strata_panel panels[] = {{strata, 2, splits, 3, "a"}, {strata, 2, NULL, 0, NULL}};
    for (size_t first = 0; first < 2; first++) {
        unsigned char *bytes;
        size_t size;
        assert_ok(koksma_plot_strata(panels + first, 2 - first, 0, KOKSMA_PLOT_SVG, &bytes, &size));
        char *text = calloc(size + 1, 1);
        assert_non_null(text);
        memcpy(text, bytes, size);
        assert_int_equal(count(text, black), first ? 0 : 1);
        assert_int_equal(count(text, green), first ? 0 : 2);
        free(text);
        free(bytes);
    }
}

static koksma_status plot_chart(const koksma_chart *chart, double width, unsigned char **bytes, size_t *size)
{
    const koksma_figure figure = {.cells = &(koksma_cell){.chart = chart}, .n_cells = 1, .width = width};
    return koksma_plot_figure(&figure, KOKSMA_PLOT_SVG, NULL, bytes, size);
}

TEST_CASE(charts_without_labels)
{
    unsigned char *bytes;
    size_t size;
    koksma_chart chart = {0};
    assert_int_equal(plot_chart(&chart, 0, &bytes, &size), KOKSMA_ARGUMENT);
    assert_null(strstr(koksma_error_text(), "null"));
    const koksma_curve curve = {.n = 2, .xs = xs, .ys = xs};
    chart = (koksma_chart){.curves = &curve, .n_curves = 1};
    assert_ok(plot_chart(&chart, 0, &bytes, &size));
    free(bytes);
    assert_int_equal(plot_chart(&chart, NAN, &bytes, &size), KOKSMA_ARGUMENT);
}

/* An SVG file as a text, to be freed. */
static char *chart_text(const koksma_chart *chart)
{
    unsigned char *bytes;
    size_t size;
    assert_ok(plot_chart(chart, 0, &bytes, &size));
    char *text = calloc(size + 1, 1);
    assert_non_null(text);
    memcpy(text, bytes, size);
    free(bytes);
    return text;
}

/* A title's lines end within no equation. */
TEST_CASE(equations_stay_whole)
{
    const koksma_curve curve = {.n = 2, .xs = xs, .ys = xs};
    for (int i = 0; i < 9; i++) {
        char title[96];
        snprintf(title, sizeof title, "%.*s: n = 256 n = 256 n = 256 n = 256 n = 256 n = 256 n = 256 n = 256", i,
                 "abcdefgh");
        char *svg = chart_text(&(koksma_chart){.title = title, .curves = &curve, .n_curves = 1});
        assert_int_equal(count(svg, "n</text>") + count(svg, "n =</text>"), 0);
        assert_true(count(svg, "n = 256</text>") > 1);
        free(svg);
    }
}

/* The colour and the dashes of the last <g> of lines: of the legend's last entry. */
static void last_style(const char *svg, char *out, size_t size)
{
    const char *last = NULL;
    for (const char *at = svg; (at = strstr(at, "<g stroke=")) != NULL; at++) {
        last = at;
    }
    assert_non_null(last);
    const size_t n = strcspn(last, ">");
    assert_true(n < size);
    memcpy(out, last, n);
    out[n] = 0;
}

/* Each of 32 curves has its own colour or its own dashes. */
TEST_CASE(thirty_two_curves_differ)
{
    enum { CURVES = 32 };
    char styles[CURVES][256];
    for (size_t c = 0; c < CURVES; c++) {
        const koksma_curve curve = {.label = "a", .n = 4, .xs = (double[]){1, 2, 3, 4}, .ys = xs, .colour = c};
        char *svg = chart_text(&(koksma_chart){.curves = &curve, .n_curves = 1});
        last_style(svg, styles[c], sizeof styles[c]);
        for (size_t other = 0; other < c; other++) {
            assert_string_not_equal(styles[c], styles[other]);
        }
        assert_int_equal(count(svg, "stroke-dasharray") > 0, c >= COLOURS);
        free(svg);
    }
}

/* Every pattern has a colour of the palette, the same alone and beside any other family; up to COLOURS specs of a picture
   have different colours, and no two look alike as long as there are styles. */
TEST_CASE(patterns_have_colours)
{
    const koksma_pattern *pattern;
    const char *names[64];
    size_t all[64], n = 0;
    for (; (pattern = koksma_pattern_at(n)); n++) {
        size_t alone, beside[2];
        names[n] = pattern->name;
        assert_ok(koksma_plot_colours(&names[n], 1, &alone));
        assert_true(alone < COLOURS);
        for (size_t other = 0; other < n; other++) {
            assert_ok(koksma_plot_colours((const char *const[]){names[other], names[n]}, 2, beside));
            assert_true(beside[1] == alone || beside[0] == alone);
            assert_int_not_equal(beside[0] % COLOURS, beside[1] % COLOURS);
        }
    }
    assert_ok(koksma_plot_colours(names, n, all));
    for (size_t first = 0; first + COLOURS <= n; first++) { /* any neighbours in the table, many of one family */
        size_t eight[COLOURS], seen[COLOURS] = {0};
        assert_ok(koksma_plot_colours(&names[first], COLOURS, eight));
        for (size_t i = 0; i < COLOURS; i++) {
            assert_true(eight[i] < COLOURS);
            assert_int_equal(seen[eight[i]]++, 0);
        }
    }
    const char *const own[] = {"random", "file:my_{n}_{seed}.npy", "exec:./mine"}; /* one's own beside the usual */
    assert_ok(koksma_plot_colours(own, 3, all));
    assert_true(all[0] != all[1] && all[1] != all[2] && all[0] != all[2]);
    const char *const specs[] = {"sobol", "sobol:scramble=owen", "points.txt", "sobol@16", "", "other.txt"};
    assert_ok(koksma_plot_colours(specs, 6, all));
    for (size_t i = 0; i < 6; i++) {
        for (size_t j = 0; j < i; j++) {
            assert_int_not_equal(all[i], all[j]);
        }
    }
}

/* A name in the palette that no pattern has would be of no use: the words of palette.def are the table's names. */
TEST_CASE(the_palette_names_patterns)
{
    static const char *const lists[] = {
#define COLOUR(light, dark, patterns) patterns,
#include "plot/palette.def"
#undef COLOUR
    };
    size_t n = 0, n_patterns = 0;
    for (size_t c = 0; c < sizeof lists / sizeof *lists; c++) {
        for (const char *at = lists[c]; *at; at += strspn(at, " ")) {
            char name[64] = "";
            memcpy(name, at, strcspn(at, " "));
            assert_non_null(koksma_pattern_find(name));
            at += strlen(name);
            n++;
        }
    }
    while (koksma_pattern_at(n_patterns)) {
        n_patterns++;
    }
    assert_int_equal(n, n_patterns);
    assert_int_equal(sizeof lists / sizeof *lists, COLOURS);
}

static bool stop(void *context, double fraction)
{
    (void)fraction;
    return --*(int *)context > 0;
}

/* A figure asks whether to go on in every panel of many points, and leaves no bytes when it is stopped. */
TEST_CASE(figures_can_be_stopped)
{
    koksma_points points = test_points("random", 20000, 3, 7);
    const koksma_panel panel = {.points = &points};
    const koksma_cell cells[] = {{.panel = &panel}, {.panel = &panel}};
    const koksma_figure figure = {.cells = cells, .n_cells = 2};
    for (int format = 0; format < (koksma_plot_library() ? 3 : 1); format++) {
        for (int questions = 1; questions <= 16; questions += 15) {
            unsigned char *bytes = NULL;
            size_t size = 0;
            int left = questions;
            const koksma_run run = {.keep_going = stop, .context = &left};
            assert_int_equal(koksma_plot_figure(&figure, (koksma_plot_format)format, &run, &bytes, &size),
                             KOKSMA_INTERRUPTED);
            assert_null(bytes);
            assert_int_equal(left, 0);
        }
    }
    koksma_points_fini(&points);
}

/* A figure of everything, in each format, twice in a process: the same bytes. */
TEST_CASE(bytes_are_the_same_again)
{
    koksma_points points = test_points("random", 9, 2, 7), solid = test_points("sobol", 8, 5, 7);
    const koksma_value value = test_measure("star", &points);
    koksma_spectrum spectrum;
    assert_ok(koksma_spectrum_init(&spectrum, 4));
    assert_ok(koksma_spectrum_add(&spectrum, &points, KOKSMA_SPECTRUM_EXACT, NULL));
    const koksma_curve curve = {.label = "a", .n = 3, .xs = (double[]){1, 2, 3}, .ys = xs, .marks = true};
    const koksma_chart chart = {.title = "chart", .curves = &curve, .n_curves = 1};
    const koksma_panel panels[] = {
        {.points = &points, .scatter = {.witness = &value.witness, .columns = 3}, .title = "<a & b>", .swatch = 2},
        {.points = &points, .scatter = {.local_discrepancy = true}, .caption = "\xff\x01"},
        {.points = &solid},
        {.spectrum = &spectrum}};
    const koksma_cell cells[] = {{&panels[0], NULL, 0},
                                 {&panels[1], NULL, 0},
                                 {&panels[2], NULL, 0},
                                 {&panels[3], NULL, 1},
                                 {NULL, &chart, 1}};
    for (int k = 0; k < (koksma_plot_library() ? 6 : 2); k++) {
        const koksma_figure figure = {"title", cells, 5, 400, 0, true, k % 2};
        unsigned char *bytes[2];
        size_t sizes[2];
        for (int again = 0; again < 2; again++) {
            assert_ok(koksma_plot_figure(&figure, (koksma_plot_format)(k / 2), NULL, &bytes[again], &sizes[again]));
        }
        assert_int_equal(sizes[0], sizes[1]);
        assert_memory_equal(bytes[0], bytes[1], sizes[0]);
        free(bytes[0]);
        free(bytes[1]);
    }
    koksma_spectrum_fini(&spectrum);
    koksma_points_fini(&points);
    koksma_points_fini(&solid);
}
