/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Files of masks: what is written reads back, floats exactly and levels in the middle of their interval; recipes make the
 * same mask again; filters have the weights of their definitions; the power spectrum is that of a direct sum.
 */
#include <koksma/image.h>
#include <koksma/maskfile.h>

#include <string.h>

#include "test.h"

#define assert_error(call, status, text)                                                                             \
    do {                                                                                                             \
        assert_int_equal(call, status);                                                                              \
        if (!strstr(koksma_error_text(), text)) {                                                                    \
            fail_msg("'%s' is not in: %s", text, koksma_error_text());                                               \
        }                                                                                                            \
    } while (0)

enum { W = 12, H = 9, N = W * H };

static koksma_mask mask_of(const char *space, float *values)
{
    koksma_mask_options o = {.width = W, .height = H, .space = koksma_mask_space_find(space), .swaps = 5};
    assert_ok(koksma_mask_filter_parse("box:size=3", &o.filter));
    assert_ok(koksma_mask_optimise(&o, NULL, values, NULL));
    return (koksma_mask){W, H, o.space, values};
}

static bool has(const char *ending)
{
    if (koksma_image_check_path(ending)) {
        print_message("%s\n", koksma_error_text());
        return false;
    }
    return true;
}

TEST_CASE(floats_read_back_exactly)
{
    float values[4 * N];
    for (size_t s = 0; koksma_mask_space_at(s); s++) {
        const koksma_mask mask = mask_of(koksma_mask_space_at(s)->name, values);
        const char *const names[] = {"a.npy", "a.exr"};
        for (size_t f = 0; f < 2; f++) {
            koksma_mask again;
            if ((f && mask.space->dim == 4) || (f && !has("a.exr"))) {
                continue;
            }
            assert_ok(koksma_mask_check_path(names[f], mask.space, 0));
            assert_ok(koksma_mask_write(names[f], &mask, 0));
            assert_ok(koksma_mask_read(names[f], mask.space, &again));
            assert_true(again.width == W && again.height == H && again.space == mask.space);
            assert_memory_equal(again.values, values, (size_t)(N * mask.space->dim) * sizeof *values);
            koksma_mask_fini(&again);
        }
    }
}

TEST_CASE(levels_read_back_in_the_middle)
{
    float values[4 * N];
    for (size_t s = 0; koksma_mask_space_at(s) && has("a.png"); s++) {
        const koksma_mask mask = mask_of(koksma_mask_space_at(s)->name, values);
        for (int bits = 8; bits <= 16; bits += 8) {
            koksma_mask again;
            const double range = mask.space->high - mask.space->low, step = ldexp(range, -bits);
            assert_ok(koksma_mask_write("a.png", &mask, bits));
            assert_ok(koksma_mask_read("a.png", mask.space, &again));
            for (int i = 0; i < N * mask.space->dim; i++) {
                const double level = fmin(floor(((double)values[i] - mask.space->low) / step), ldexp(1, bits) - 1);
                assert_near((double)again.values[i], mask.space->low + (level + 0.5) * step, 1e-6);
            }
            koksma_mask_fini(&again);
        }
    }
}

/* The order of scalars survives 16 bits, so a mask of up to 65,536 pixels is the same one. */
TEST_CASE(the_space_follows_from_the_channels)
{
    static const char *const names[] = {"scalar", "vector2", "vector3", "vector4"};
    float values[4 * N];
    for (size_t s = 0; s < 4 && has("a.png"); s++) {
        const koksma_mask mask = mask_of(names[s], values);
        koksma_mask again;
        assert_ok(koksma_mask_write("a.png", &mask, 16));
        assert_ok(koksma_mask_read("a.png", NULL, &again));
        assert_string_equal(again.space->name, names[s]);
        koksma_mask_fini(&again);
    }
}

TEST_CASE(raw_files_have_the_levels_alone)
{
    float values[2 * N];
    unsigned char bytes[4 * N + 1];
    const koksma_mask mask = mask_of("scalar", values);
    for (int bits = 8; bits <= 32; bits *= 2) {
        assert_ok(koksma_mask_write("a.raw", &mask, bits));
        FILE *file = fopen("a.raw", "rb");
        assert_int_equal(fread(bytes, 1, sizeof bytes, file), N * bits / 8);
        fclose(file);
        for (int i = 0; i < N; i++) {
            const double share = bits == 8    ? bytes[i] / 256.0
                                 : bits == 16 ? (bytes[2 * i] + 256 * bytes[2 * i + 1]) / 65536.0
                                              : (double)values[i];
            assert_true((double)values[i] >= share && (double)values[i] < share + ldexp(1, -bits) + 1e-9);
        }
    }
}

TEST_CASE(recipes_make_the_mask_again)
{
    float first[2 * N], second[2 * N];
    koksma_mask_options o = {.width = W,
                             .height = H,
                             .space = koksma_mask_space_find("vector2"),
                             .swaps = 7.5,
                             .open = true,
                             .seed = UINT64_MAX - 1};
    koksma_mask_result r;
    static koksma_mask_recipe recipe, again;
    uint32_t stands[N];
    recipe = (koksma_mask_recipe){.options = o, .filter = "gaussian:sigma=0.6", .from = "m.png"};
    recipe.options.state = stands;
    assert_ok(koksma_mask_filter_parse(recipe.filter, &recipe.options.filter));
    assert_ok(koksma_mask_optimise(&recipe.options, NULL, first, &recipe.result));
    assert_ok(koksma_mask_write_recipe("a.json", &recipe));
    assert_ok(koksma_mask_read_recipe("a.json", &again));
    assert_true(again.options.done == again.result.done && again.result.done == (uint64_t)(7.5 * N));
    assert_true(again.result.first == recipe.result.first && again.result.error == recipe.result.error);
    assert_true(again.result.finished && !again.options.state); /* a finished search stands nowhere */
    assert_string_equal(again.filter, recipe.filter);
    assert_string_equal(again.from, recipe.from);
    again.options.done = 0;
    assert_ok(koksma_mask_optimise(&again.options, NULL, second, &r));
    assert_memory_equal(first, second, sizeof first);
    recipe.result.finished = false;
    *recipe.filter = *recipe.from = '\0';
    assert_ok(koksma_mask_write_recipe("a.json", &recipe));
    assert_ok(koksma_mask_read_recipe("a.json", &again));
    assert_memory_equal(again.options.state, stands, sizeof stands);
    assert_true(!*again.filter && !*again.from);
    koksma_mask_recipe_fini(&again);
    test_write("b.json", "{\"revision\": 1}");
    assert_error(koksma_mask_read_recipe("b.json", &again), KOKSMA_MALFORMED, "width");
    assert_error(koksma_mask_read_recipe("absent.json", &again), KOKSMA_MISSING, "absent.json");
}

/* Without a space a file is read in that of the recipe beside it; other JSON tells nothing. */
TEST_CASE(the_space_follows_from_the_recipe)
{
    float values[4 * N];
    static koksma_mask_recipe recipe;
    koksma_mask again;
    const koksma_mask_space *found;
    for (size_t s = 0; koksma_mask_space_at(s); s++) {
        const koksma_mask mask = mask_of(koksma_mask_space_at(s)->name, values);
        recipe.options =
            (koksma_mask_options){.width = W, .height = H, .space = mask.space, .filter = {2, 1, {1, 1}}};
        assert_ok(koksma_mask_write("r.npy", &mask, 0));
        assert_ok(koksma_mask_write_recipe("r.npy.json", &recipe));
        assert_ok(koksma_mask_read("r.npy", NULL, &again));
        assert_ptr_equal(again.space, mask.space);
        assert_memory_equal(again.values, values, (size_t)(N * mask.space->dim) * sizeof *values);
        koksma_mask_fini(&again);
    }
    assert_ok(koksma_mask_recipe_space("absent.npy", &found));
    assert_null(found);
    test_write("r.npy.json", "{\"space\": \"tent\"}");
    assert_ok(koksma_mask_recipe_space("r.npy", &found));
    assert_null(found);
    test_write("r.npy.json", "{\"format\": \"koksma-mask\", \"space\": \"tents\"}");
    assert_error(koksma_mask_recipe_space("r.npy", &found), KOKSMA_MALFORMED, "tents");
    const koksma_mask mask = mask_of("gaussian", values);
    assert_ok(koksma_mask_write("g.npy", &mask, 0));
    assert_error(koksma_mask_read("g.npy", NULL, &again), KOKSMA_MALFORMED, "of tent -1 to 1, of gaussian -6 to 6");
}

static void assert_weights(const char *text, int width, int height, const double *weights)
{
    koksma_mask_filter f;
    assert_ok(koksma_mask_filter_parse(text, &f));
    assert_true(f.width == width && f.height == height);
    for (int i = 0; i < width * height; i++) {
        assert_near(f.weights[i], weights[i], 1e-7);
    }
}

TEST_CASE(filters_have_their_weights)
{
    koksma_mask_filter f;
    const double binomial[] = {1 / 16., 2 / 16., 1 / 16., 2 / 16., 4 / 16., 2 / 16., 1 / 16., 2 / 16., 1 / 16.};
    const double box[] = {0.25, 0.25, 0.25, 0.25};
    const double file[] = {0.1, 0.2, 0.3, -0.2, 0, 0.6};
    /* a tent of width 2 has 3/4 of its area over the middle pixel */
    const double tent[] = {1 / 64., 6 / 64., 1 / 64., 6 / 64., 36 / 64., 6 / 64., 1 / 64., 6 / 64., 1 / 64.};
    assert_weights("binomial", 3, 3, binomial);
    assert_weights("box:size=2", 2, 2, box);
    assert_weights("tent", 3, 3, tent);
    test_write("k.txt", "# a filter\n 1, 2 3\n\n-2 0 6 # its last row\n");
    assert_weights("file:k.txt", 3, 2, file);
    assert_ok(
        koksma_mask_filter_parse("gaussian:sigma=1", &f)); /* radius 4: the normal distribution at whole numbers */
    assert_int_equal(f.width, 9);
    assert_near(f.weights[4 * 9 + 4] / f.weights[4 * 9 + 6], exp(2), 1e-9);
    assert_ok(koksma_mask_filter_parse("mitchell", &f));
    assert_true(f.weights[0] > 0 && f.weights[f.width / 2] < 0);
}

TEST_CASE(bad_files_are_refused)
{
    float values[4 * N];
    koksma_mask out;
    const koksma_mask mask = mask_of("vector4", values);
    assert_error(koksma_mask_write("a.dds", &mask, 0), KOKSMA_ARGUMENT, ".png, .exr, .npy, .raw or .h");
    assert_error(koksma_mask_write("a.exr", &mask, 0), KOKSMA_ARGUMENT, "up to 3 numbers");
    assert_error(koksma_mask_write("a.npy", &mask, 8), KOKSMA_ARGUMENT, "8 bits");
    assert_ok(koksma_mask_write("a.npy", &mask, 0));
    assert_error(koksma_mask_read("a.npy", koksma_mask_space_find("scalar"), &out), KOKSMA_MALFORMED, "4 numbers");
    test_write("cut.npy", "\x93NUMPY");
    assert_error(koksma_mask_read("cut.npy", NULL, &out), KOKSMA_MALFORMED, "npy header");
    test_write("a.txt", "no image");
    assert_error(koksma_mask_read("a.txt", NULL, &out), KOKSMA_MALFORMED, "a.txt");
    values[5] = 7;
    assert_error(koksma_mask_write("a.npy", &mask, 0), KOKSMA_ARGUMENT, "(1, 0)");
}

/* Power, correlation and histogram by the sums of their definitions. */
TEST_CASE(relations_are_those_of_direct_sums)
{
    float values[2][2 * N];
    koksma_mask a = mask_of("vector2", values[0]), b = a;
    double power[N], correlation[N], mean[2][2] = {{0}}, squares[2] = {0}, all = 0, direct[N];
    size_t counts[2 * 5], expected[2 * 5] = {0};
    b.values = values[1];
    for (int i = 0; i < 2 * N; i++) {
        values[1][i] = (float)((i * 7 % 31 + 0.5) / 31) * values[0][(i + 6) % (2 * N)];
        expected[i % 2 * 5 + (int)(values[0][i] * 5)]++;
        for (int m = 0; m < 2; m++) {
            mean[m][i % 2] += (double)values[m][i] / N;
        }
    }
    for (int i = 0; i < 4 * N; i++) {
        const int m = i / (2 * N), k = i % 2;
        squares[m] += pow((double)values[m][i % (2 * N)] - mean[m][k], 2);
    }
    assert_ok(koksma_mask_power(&a, power));
    assert_ok(koksma_mask_correlation(&a, &b, correlation));
    assert_ok(koksma_mask_histogram(&a, 5, counts));
    assert_memory_equal(counts, expected, sizeof counts);
    for (int v = 0; v < H; v++) {
        for (int u = 0; u < W; u++) {
            double product = 0;
            direct[v * W + u] = 0;
            for (int k = 0; k < 2; k++) {
                double re = 0, im = 0;
                for (int p = 0; p < N; p++) {
                    const double angle = 2 * M_PI * ((double)u * (p % W) / W + (double)v * (p / W) / H);
                    const double x = (double)values[0][2 * p + k];
                    const int q = (p / W + v) % H * W + (p % W + u) % W;
                    re += x * cos(angle);
                    im += x * sin(angle);
                    product += (x - mean[0][k]) * ((double)values[1][2 * q + k] - mean[1][k]);
                }
                direct[v * W + u] += re * re + im * im;
            }
            assert_near(correlation[v * W + u], product / sqrt(squares[0] * squares[1]), 1e-12);
            all += u + v ? direct[v * W + u] : 0;
        }
    }
    assert_true(power[0] == 0);
    for (int i = 1; i < N; i++) {
        assert_near(power[i], direct[i] * (N - 1) / all, 1e-10);
    }
    b.width = H, b.height = W;
    assert_error(koksma_mask_correlation(&a, &b, correlation), KOKSMA_ARGUMENT, "12 x 9");
    memset(values, 0, sizeof values);
    b = a;
    assert_error(koksma_mask_correlation(&a, &b, correlation), KOKSMA_ARGUMENT, "equal");
    assert_error(koksma_mask_power(&a, power), KOKSMA_ARGUMENT, "equal");
    assert_error(koksma_mask_rings(&a, 3, power, NULL), KOKSMA_ARGUMENT, "equal");
}

TEST_CASE(rings_are_those_of_a_direct_sum)
{
    enum { RINGS = 5 };
    float values[2 * N];
    double power[RINGS], sums[RINGS + 1] = {0}, counts[RINGS + 1] = {0}, all = 0;
    const koksma_mask mask = mask_of("vector2", values);
    assert_ok(koksma_mask_rings(&mask, RINGS, power, NULL));
    for (int f = 1; f < N; f++) {
        const int u = f % W, v = f / W;
        double sum = 0;
        for (int k = 0; k < 2; k++) {
            double re = 0, im = 0;
            for (int p = 0; p < N; p++) {
                const double angle = 2 * M_PI * ((double)(u * (p % W)) / W + (double)(v * (p / W)) / H);
                re += (double)values[2 * p + k] * cos(angle);
                im += (double)values[2 * p + k] * sin(angle);
            }
            sum += re * re + im * im;
        }
        const double x = fmin(u, W - u) / W, y = fmin(v, H - v) / H;
        const int ring = (int)fmin(sqrt(x * x + y * y) * 2 * RINGS, RINGS);
        sums[ring] += sum;
        counts[ring]++;
        all += sum / (N - 1);
    }
    for (int r = 0; r < RINGS; r++) {
        assert_near(power[r], sums[r] / counts[r] / all, 1e-9);
    }
}
