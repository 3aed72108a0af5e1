/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Point sets of patterns that read files are read once by a process: a pattern of this test whose operand is the path of
 * a file counts how often it is asked, for any number of sets, threads and pixels, behind a random modifier; and it is
 * asked again when its file has changed.
 */
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "rendering.h"

static const char path[] = "file-sets.txt";
static atomic_size_t asked;

/* The points of a file with one number: (x, x) and its multiples on the torus. */
static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    double x = 0;
    FILE *file = fopen(args->path, "r");
    asked++;
    if (!file || fscanf(file, "%lf", &x) != 1) {
        return KOKSMA_MISSING;
    }
    fclose(file);
    for (size_t c = 0; c < out->n * (size_t)out->dim; c++) {
        out->xs[c] = fmod(x * (double)(c / (size_t)out->dim + 1), 1);
    }
    return KOKSMA_OK;
}

static const koksma_pattern counting = {.name = "counting",
                                        .title = "counts how often it is asked",
                                        .cite = "-",
                                        .min_dim = 1,
                                        .max_dim = 8,
                                        .claims = KOKSMA_CLAIM_DETERMINISTIC,
                                        .generate = generate,
                                        .operand = "PATH"};

/* Writes the file as of `age` seconds ago. */
static void write_file(double x, time_t age)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%.3f\n", x);
    assert_int_equal(fclose(file), 0);
    const struct timespec times[2] = {{.tv_sec = time(NULL) - age}, {.tv_sec = time(NULL) - age}};
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
}

static koksma_spec spec_of(bool shifted)
{
    koksma_spec spec;
    assert_ok(koksma_pattern_spec(shifted ? "regular:shift=1" : "regular", &spec));
    spec.pattern = &counting;
    memset(spec.params, 0, sizeof spec.params);
    memcpy(spec.path, path, sizeof path);
    return spec;
}

static void *many_sets(void *unused)
{
    const koksma_spec spec = spec_of(true);
    double xs[32];
    koksma_points points = {16, 2, xs};
    for (uint64_t seed = 0; seed < 500; seed++) {
        if (koksma_generate(&spec, seed, NULL, &points)) {
            return &asked;
        }
    }
    return unused;
}

TEST_CASE(threads_share_the_sets)
{
    enum { THREADS = 4 };
    pthread_t threads[THREADS];
    write_file(0.125, 1000);
    asked = 0;
    for (int t = 0; t < THREADS; t++) {
        assert_int_equal(pthread_create(&threads[t], NULL, many_sets, NULL), 0);
    }
    for (int t = 0; t < THREADS; t++) {
        void *failed;
        assert_int_equal(pthread_join(threads[t], &failed), 0);
        assert_null(failed);
    }
    assert_true(asked >= 1 && asked <= THREADS); /* all may begin before the first has read */
}

/* A file that has changed is read anew, of equal size and name, too; other n and dimensions are other sets. */
TEST_CASE(changed_files_are_read_anew)
{
    const koksma_spec spec = spec_of(false);
    double xs[64];
    for (int k = 1; k < 5; k++) {
        const double x = k / 8.0;
        write_file(x, 1000 - k);
        asked = 0;
        for (int again = 0; again < 3; again++) {
            for (size_t n = 1; n <= 8; n++) {
                for (int dim = 1; dim <= 8; dim += 7) {
                    koksma_points points = {n, dim, xs};
                    assert_ok(koksma_generate(&spec, 0, NULL, &points));
                    assert_true(xs[0] == x && xs[n * (size_t)dim - 1] == fmod(x * (double)n, 1));
                }
            }
        }
        assert_int_equal(asked, 16);
    }
    write_file(0.75, -1000); /* written so late that a later change could have the same time */
    koksma_points points = {1, 1, xs};
    for (asked = 0; asked < 3;) {
        const size_t before = asked;
        assert_ok(koksma_generate(&spec, 0, NULL, &points));
        assert_true(asked == before + 1 && xs[0] == 0.75);
    }
    assert_int_equal(remove(path), 0);
    assert_int_equal(koksma_generate(&spec, 0, NULL, &points), KOKSMA_MISSING);
}
