/* SPDX-License-Identifier: Apache-2.0 */
/* Every measure asks whether to go on, also where the points lie so that one cell or shape holds all the work; and
   sooner than after a second. A file whose writing is stopped is as it was. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <koksma/render.h>
#include <koksma/spectrum.h>

#include "sets.h"

enum { N = 2048 };

static bool stop_at_once(void *context, double fraction)
{
    assert_true(fraction >= 0 && fraction <= 1);
    ++*(int *)context;
    return false;
}

/* A cluster, whose points are in one cell of any grid. */
static koksma_points cluster(size_t n, int dim)
{
    koksma_points p = sets_points(n, dim, 0, 3);
    for (size_t c = 0; c < n * (size_t)dim; c++) {
        p.xs[c] = 0.3 + 1e-5 * p.xs[c];
    }
    return p;
}

TEST_CASE(every_measure_asks)
{
    for (size_t i = 0; koksma_measure_at(i); i++) {
        const koksma_measure *m = koksma_measure_at(i);
        const int last = m->max_dim < 4 ? m->max_dim : 4;
        for (int dim = m->min_dim; dim <= last; dim++) {
            koksma_points p =
                cluster((!strcmp(m->name, "extreme") || !strcmp(m->name, "edge")) && dim > 2 ? 64 : N, dim);
            koksma_spec spec;
            koksma_value v;
            int asked = 0;
            assert_ok(koksma_measure_spec(m->name, &spec));
            const koksma_run run = {.threads = 1, .keep_going = stop_at_once, .context = &asked};
            const koksma_status status = koksma_evaluate(&spec, &p, &run, &v);
            assert_that(status == KOKSMA_INTERRUPTED && asked != 0, "%s in %d dimensions: status %d, asked %d times",
                        m->name, dim, (int)status, asked);
            koksma_points_fini(&p);
        }
    }
}

/* Asks for the processor time that has passed since it was asked last. */
typedef struct watch {
    clock_t last;
    double longest_s;
    int asked;
} watch;

static bool look(void *context, double fraction)
{
    watch *w = context;
    (void)fraction;
    const clock_t now = clock();
    w->longest_s = fmax(w->longest_s, w->asked++ ? (double)(now - w->last) / CLOCKS_PER_SEC : 0);
    w->last = now;
    return w->asked < 20;
}

/* Measures that would take seconds to minutes, told to stop at the 20th question. */
TEST_CASE(questions_are_near)
{
    static const struct {
        const char *measure;
        size_t n;
        int dim;
    } cases[] = {{"t-value", 4096, 12},
                 {"extreme:grid=1024", 100, 2},
                 {"extreme", 128, 3},
                 {"edge", 1024, 3},
                 {"star-lower:steps=1000000", 2000, 5}};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        const bool net = !strcmp(cases[c].measure, "t-value");
        koksma_points p = net ? test_points("sobol", cases[c].n, cases[c].dim, 0) : cluster(cases[c].n, cases[c].dim);
        koksma_spec spec;
        koksma_value v;
        watch w = {.asked = 0};
        assert_ok(koksma_measure_spec(cases[c].measure, &spec));
        const koksma_run run = {.threads = 1, .keep_going = look, .context = &w};
        assert_int_equal(koksma_evaluate(&spec, &p, &run, &v), KOKSMA_INTERRUPTED);
        assert_true(w.asked == 20 && w.longest_s < 1);
        koksma_points_fini(&p);
    }
    koksma_points p = test_points("random", 20000, 2, 1);
    koksma_spectrum s;
    watch w = {.asked = 0};
    assert_ok(koksma_spectrum_init(&s, 280));
    const koksma_run run = {.threads = 1, .keep_going = look, .context = &w};
    assert_int_equal(koksma_spectrum_add(&s, &p, KOKSMA_SPECTRUM_EXACT, &run), KOKSMA_INTERRUPTED);
    assert_true(w.longest_s < 1);
    double values[10];
    w = (watch){.asked = 0};
    assert_int_equal(koksma_pair_correlation(&p, 0.5, 10, &run, values), KOKSMA_INTERRUPTED);
    assert_true(w.asked == 20 && w.longest_s < 1);
    koksma_spectrum_fini(&s);
    koksma_points_fini(&p);
}

/* One false is enough: what is asked later is not whether to go on after all. */
static bool stop_once(void *context, double fraction)
{
    (void)fraction;
    return ++*(int *)context != 2;
}

TEST_CASE(one_false_stops)
{
    koksma_points p;
    koksma_spec spec;
    int asked = 0;
    const koksma_run run = {.threads = 1, .keep_going = stop_once, .context = &asked};
    assert_ok(koksma_points_init(&p, 20000, 2));
    assert_ok(koksma_pattern_spec("poisson-disk:d=0.0056", &spec));
    assert_int_equal(koksma_generate(&spec, 0, &run, &p), KOKSMA_INTERRUPTED);
    koksma_points_fini(&p);
}

static bool stop_at_third(void *context, double fraction)
{
    assert_true(fraction >= 0 && fraction < 1);
    return ++*(int *)context < 3;
}

TEST_CASE(a_file_that_is_stopped_is_as_before)
{
    static const char *const endings[] = {"txt", "csv", "npy"};
    koksma_points p = test_points("random", 400000, 2, 1), few = test_points("random", 3, 2, 1), back;
    for (int e = 0; e < 3; e++) {
        char folder[] = "interruption-XXXXXX", path[sizeof folder + 16];
        int asked = 0;
        const koksma_run run = {.keep_going = stop_at_third, .context = &asked};
        assert_non_null(mkdtemp(folder));
        snprintf(path, sizeof path, "%s/points.%s", folder, endings[e]);
        assert_int_equal(koksma_points_write(path, &p, NULL, &run), KOKSMA_INTERRUPTED);
        assert_int_equal(asked, 3);
        assert_int_equal(koksma_points_read(path, &back), KOKSMA_MISSING);
        assert_ok(koksma_points_write(path, &few, NULL, NULL));
        asked = 0;
        assert_int_equal(koksma_points_write(path, &p, NULL, &run), KOKSMA_INTERRUPTED);
        assert_ok(koksma_points_read(path, &back));
        assert_int_equal(back.n, 3);
        koksma_points_fini(&back);
        assert_int_equal(remove(path), 0);
        assert_int_equal(rmdir(folder), 0); /* nothing else was left in it */
    }
    koksma_points_fini(&few);
    koksma_points_fini(&p);
}

static bool stop_at_hundredth(void *context, double fraction)
{
    (void)fraction;
    return ++*(int *)context < 100;
}

/* Renders the scene ball with side x side pixels until the run stops it. */
static void render_until_stopped(const char *pattern, int side, int spp, const koksma_run *run)
{
    koksma_scene *scene;
    koksma_render_options options;
    koksma_image image = {0};
    assert_ok(koksma_scene_open("ball", &scene));
    koksma_render_options_init(&options, scene);
    assert_ok(koksma_pattern_spec(pattern, &options.pattern));
    options.width = options.height = side;
    options.spp = spp;
    assert_int_equal(koksma_render(scene, &options, run, &image), KOKSMA_INTERRUPTED);
    koksma_image_fini(&image);
    koksma_scene_close(scene);
}

/* Patterns take seconds for a set of one pixel: they ask while they make it, on any thread but through the caller's.
   A picture of four pixels is one task, and asked a few times before. */
TEST_CASE(pictures_ask_within_a_set)
{
    int asked = 0;
    const koksma_run run = {.threads = 2, .keep_going = stop_at_hundredth, .context = &asked};
    render_until_stopped("gaussian-blue-noise:steps=1000", 2, 16, &run);
    assert_true(asked >= 100 && asked < 200);
}

/* Sets that take seconds to minutes, in 1, 2, 3 and 8 dimensions or a pattern's own, told to stop at the 20th question. */
TEST_CASE(every_pattern_asks_often)
{
    const koksma_pattern *pattern;
    for (size_t i = 0; (pattern = koksma_pattern_at(i)); i++) {
        const int last = pattern->max_dim < 8 ? pattern->max_dim : 8;
        for (int dim = pattern->min_dim; dim <= last; dim = dim < 3 || dim == last ? dim + 1 : last) {
            koksma_points p;
            koksma_spec spec;
            watch w = {.asked = 0};
            const koksma_run run = {.threads = 1, .keep_going = look, .context = &w};
            if (koksma_pattern_spec(pattern->name, &spec)) { /* it needs a file or a program */
                continue;
            }
            assert_ok(koksma_points_init(&p, (size_t)test_repeats(16384, 256), dim));
            const clock_t start = clock();
            const koksma_status status = koksma_generate(&spec, 0, &run, &p);
            const double all_s = (double)(clock() - start) / CLOCKS_PER_SEC;
            assert_that(w.longest_s <= 1 && (all_s <= 2 || w.asked >= 2),
                        "%s in %d dimensions: status %d, asked %d times in %g s, longest %g s", pattern->name, dim,
                        (int)status, w.asked, all_s, w.longest_s);
            koksma_points_fini(&p);
        }
    }
}

/* The first set of each pattern, which is made to check it, is made under the caller's run too. */
TEST_CASE(pictures_ask_within_the_first_set)
{
    watch w = {.asked = 0};
    const koksma_run run = {.threads = 2, .keep_going = look, .context = &w};
    render_until_stopped("best-candidate", 1, 65536, &run);
    assert_true(w.asked == 20 && w.longest_s < 1);
}

/* Counts the questions of the first half, in which a spectrum takes the points one by one. */
static bool count_early(void *context, double fraction)
{
    *(int *)context += fraction > 0 && fraction < 0.5;
    return true;
}

TEST_CASE(spectra_ask_at_each_few_thousand_points)
{
    koksma_points p = sets_points(1 << 16, 2, 0, 3);
    koksma_spectrum spectrum;
    int asked = 0;
    const koksma_run counting = {.threads = 1, .keep_going = count_early, .context = &asked};
    const koksma_run stopping = {.threads = 1, .keep_going = stop_at_once, .context = &asked};
    assert_ok(koksma_spectrum_init(&spectrum, 8));
    assert_ok(koksma_spectrum_add(&spectrum, &p, KOKSMA_SPECTRUM_FAST, &counting));
    assert_true(asked >= 15);
    assert_int_equal(koksma_spectrum_add(&spectrum, &p, KOKSMA_SPECTRUM_FAST, &stopping), KOKSMA_INTERRUPTED);
    koksma_spectrum_fini(&spectrum);
    koksma_points_fini(&p);
}
