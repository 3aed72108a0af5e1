/* SPDX-License-Identifier: Apache-2.0 */
/* What stands in pixels without samples: in a whole picture what is around them, after an interrupt nothing; and what
   the layers say of splatted ones. */
#include <limits.h>
#include <time.h>

#include "rendering.h"

/* A floor that fades into the distance, so that rows differ. */
static koksma_scene *fading(void)
{
    return scene_of("{'camera': {'eye': [0, 1, 4], 'target': [0, 0.5, 0], 'fov_deg': 40}, 'background': "
                    "0.5,'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 0.9}], 'shapes': [{'kind': "
                    "'plane', 'centre': [0, 0, 0], 'normal': [0, 1, 0], 'material': 'm'}],'lights': [{'kind': "
                    "'rectangle', 'centre': [0, 2, 0], 'normal': [0, -1, 0],'half': [1, 1], 'radiance': 2}]}");
}

/* How many steps to any of the eight neighbours a pixel is from one with samples. */
static int steps_of(const koksma_image *samples, const int *columns, int x, int y)
{
    int least = samples->width + samples->height;
    for (int yy = 0; yy < samples->height; yy++) {
        if (columns[yy] >= 0) {
            const int across = abs(x - columns[yy]), down = abs(y - yy), far = across > down ? across : down;
            least = far < least ? far : least;
        }
    }
    return least;
}

/* One column of the picture has samples, at least one a row: the others are the means of their neighbours that are a
   step nearer to it; and it does not take for ever. */
TEST_CASE(wide_gaps_are_filled_from_their_sides)
{
    enum { WIDTH = 240, HEIGHT = 180 };
    koksma_scene *scene = fading();
    koksma_render_options options = options_of(scene, "regular:columns=1", "distribution", 1, WIDTH);
    koksma_layers layers;
    static int steps[WIDTH * HEIGHT];
    int columns[HEIGHT], widest = 0;
    options.height = HEIGHT;
    options.scope = KOKSMA_SCOPE_IMAGE;
    const clock_t start = clock();
    assert_ok(koksma_render_only(scene, &options, NULL, &layers));
    assert_true((double)(clock() - start) < 5.0 * CLOCKS_PER_SEC);
    for (int y = 0; y < HEIGHT; y++) {
        columns[y] = -1;
        for (int x = 0; x < WIDTH; x++) {
            if (layers.samples.pixels[y * WIDTH + x] > 0) {
                assert_int_equal(columns[y], -1);
                columns[y] = x;
            }
        }
    }
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        steps[i] = steps_of(&layers.samples, columns, i % WIDTH, i / WIDTH);
        widest = steps[i] > widest ? steps[i] : widest;
    }
    assert_true(widest >= WIDTH / 2);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        double sum = 0;
        int n = 0;
        for (int k = 0; k < 9; k++) {
            const int x = i % WIDTH + k % 3 - 1, y = i / WIDTH + k / 3 - 1;
            if (x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT && steps[y * WIDTH + x] == steps[i] - 1) {
                sum += (double)layers.image.pixels[y * WIDTH + x];
                n++;
            }
        }
        assert_true((n > 0) == (steps[i] > 0));
        if (n) {
            assert_near((double)layers.image.pixels[i], sum / n, 1e-6);
        }
    }
    koksma_layers_fini(&layers);
    koksma_scene_close(scene);
}

/* Stops when so much of a phase is done, or at a question. */
typedef struct patience {
    double part;
    int asked, last;
} patience;

static bool stop_in_the_middle(void *context, double fraction)
{
    patience *p = context;
    return ++p->asked < p->last && fraction < p->part;
}

/* The layers of a picture of 18 tasks, about half of which are done. One thread asks before each of them; with a
   pattern for the whole image it asks before, too. */
static void render_half(const koksma_scene *scene, koksma_render_options *options, int threads, koksma_layers *out)
{
    const bool image = options->scope == KOKSMA_SCOPE_IMAGE;
    patience p = {2, 0, INT_MAX};
    koksma_run run = {.threads = threads, .keep_going = stop_in_the_middle, .context = &p};
    if (image) {
        assert_ok(koksma_render_layers(scene, options, &run, out));
        koksma_layers_fini(out);
    }
    p = (patience){image ? 2 : 0.4, 0, image ? p.asked - 9 : INT_MAX};
    const koksma_status status = koksma_render_layers(scene, options, &run, out);
    assert_true(status == KOKSMA_INTERRUPTED || (!status && threads > 1)); /* others may be done before one asks */
}

/* Pixels that are done have their colour, the sky's, those that are not are black and have no samples; however the
   samples come to the pixels. */
TEST_CASE(what_is_not_rendered_stays_black)
{
    koksma_scene *scene = scene_of(SKY_ALONE("0.75"));
    static const struct {
        bool image, splat;
        int threads;
    } cases[] = {{false, false, 1}, {true, false, 1},  {false, true, 1},
                 {true, true, 1},   {false, false, 3}, {false, true, 3}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        koksma_render_options options = options_of(scene, "random", "distribution", 64, 90);
        koksma_layers layers;
        int done = 0;
        options.scope = cases[c].image ? KOKSMA_SCOPE_IMAGE : KOKSMA_SCOPE_PIXEL;
        options.splat = cases[c].splat;
        options.filter = koksma_filter_find(options.splat ? "mitchell" : "box");
        render_half(scene, &options, cases[c].threads, &layers);
        assert_non_null(layers.image.pixels);
        for (int i = 0; i < 90 * 90; i++) {
            assert_near((double)layers.image.pixels[i], layers.samples.pixels[i] > 0 ? 0.75 : 0, 1e-5);
            done += layers.samples.pixels[i] > 0;
        }
        assert_true(done > 0 && (done < 90 * 90 || cases[c].threads > 1));
        koksma_layers_fini(&layers);
    }
    koksma_scene_close(scene);
}

/* A ball that is before everything half of the time makes every sample 0 or 1, wherever it lies; then pixels have the
   variance that their layer says, by every filter, splatted or not, down to a sample a pixel; borders apart, where
   splatted pixels have fewer. */
TEST_CASE(variance_is_told)
{
    enum { SIDE = 64, EDGE = 3, SEEDS = 8 };
    static const struct {
        const char *filter;
        int spp;
        bool splat;
    } cases[] = {{"box", 4, false},      {"gaussian", 4, false}, {"box", 4, true},       {"tent", 2, true},
                 {"gaussian", 1, true},  {"gaussian", 4, true},  {"mitchell", 4, true},  {"b-spline", 4, true},
                 {"mitchell", 2, false}, {"mitchell", 4, false}, {"mitchell", 16, false}};
    koksma_scene *scene =
        scene_of("{'camera': {'eye': [0, 0, 50], 'target': [0, 0, 0], 'fov_deg': 0.01}, 'ambient': 1,'materials': "
                 "[{'name': 'm', 'kind': 'lambert', 'albedo': 1}], 'shapes': [{'kind': 'sphere', 'centre': [-2, 0, "
                 "0], 'radius': 1, 'motion': [4, 0, 0],'material': 'm'}]}");
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        koksma_render_options options = options_of(scene, "random", "distribution", cases[c].spp, SIDE);
        options.filter = koksma_filter_find(cases[c].filter);
        options.splat = cases[c].splat;
        double told = 0, seen = 0, n = 0;
        for (options.seed = 0; options.seed < SEEDS; options.seed++) {
            koksma_layers layers;
            assert_ok(koksma_render_layers(scene, &options, NULL, &layers));
            for (int y = EDGE; y < SIDE - EDGE; y++) {
                for (int x = EDGE; x < SIDE - EDGE; x++, n++) {
                    told += (double)layers.variance.pixels[y * SIDE + x];
                    seen += pow((double)layers.image.pixels[y * SIDE + x] - 0.5, 2);
                }
            }
            koksma_layers_fini(&layers);
        }
        assert_that(fabs(told / seen - 1) <= 0.06, "%s, %d samples%s: told %.5f, seen %.5f", cases[c].filter,
                    cases[c].spp, cases[c].splat ? ", splatted" : "", told / n, seen / n);
    }
    koksma_scene_close(scene);
}
