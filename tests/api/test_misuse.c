/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Every public function with every argument wrong in turn: misuse.py makes the calls from the headers. A case must end in
 * an error whose text names the argument, or, where the headers allow the value, in any answer; never in a crash, a
 * report of a sanitizer or 20 s of processor time. After an error, results are as before or zero.
 *
 * Cases run in a child, which writes what is wrong and counts it in memory that it shares. When one ends the child, that is
 * a failure, and the next child continues after it. Long because each type of an argument has a valid value here.
 */
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#include <ctype.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

static void asserted(const char *condition);
#define KOKSMA_ASSERT(condition) ((condition) ? (void)0 : asserted(#condition))

#include <koksma/adaptive.h>
#include <koksma/datasheet.h>
#include <koksma/density.h>
#include <koksma/estimate.h>
#include <koksma/identify.h>
#include <koksma/integrate.h>
#include <koksma/keys.h>
#include <koksma/mask.h>
#include <koksma/maskfile.h>
#include <koksma/optimise.h>
#include <koksma/series.h>
#include <koksma/study.h>
#include <koksma/verify.h>

#include "test.h"

/* ---- Valid arguments: fresh for each case, never freed; the heap has AddressSanitizer's marks around each ---- */

static char work[64];
static const char *only; /* a part of a function's name, from the command line: calls these alone */

static void *a_copy(const void *from, size_t size)
{
    void *copy = malloc(size);
    if (!copy) {
        abort();
    }
    memcpy(copy, from, size);
    return copy;
}

#define COPY(type, ...) a_copy(&(type)__VA_ARGS__, sizeof(type))

static void must(koksma_status status)
{
    if (status) {
        fprintf(stderr, "an argument could not be made: %s\n", koksma_error_text());
        abort();
    }
}

/* Memory for a result; what is in it before the call is recognised after it. */
static void *a_buffer(size_t size)
{
    void *bytes = malloc(size);
    if (!bytes) {
        abort();
    }
    return memset(bytes, 0xa5, size);
}

static void *a_zero(size_t size)
{
    return memset(a_buffer(size), 0, size);
}

static const char *long_text(void)
{
    char *text = a_buffer(100001);
    memset(text, 'x', 100000);
    text[100000] = '\0';
    return text;
}

/* A name in the folder of the test; a word before a colon stays in front: "file:in.npy". */
static const char *work_path(const char *name)
{
    char *text = a_buffer(256);
    const char *colon = strchr(name, ':');
    const int head = colon ? (int)(colon + 1 - name) : 0;
    snprintf(text, 256, "%.*s%s/%s", head, name, work, name + head);
    return text;
}

static bool go_on(void *context, double fraction)
{
    (void)context;
    (void)fraction;
    return true;
}

static void *a_run(void)
{
    return COPY(koksma_run, {.threads = 2, .time_limit_s = 60, .keep_going = go_on});
}

static void *points_of(size_t n)
{
    koksma_points points = test_points("jittered", n, 2, 1);
    return a_copy(&points, sizeof points);
}

static void *many_sets(void)
{
    koksma_points sets[KOKSMA_VERIFY_SETS];
    for (uint64_t s = 0; s < KOKSMA_VERIFY_SETS; s++) {
        sets[s] = test_points("jittered", 4, 2, s);
    }
    return a_copy(sets, sizeof sets);
}

static void *points_in_space(void)
{
    koksma_points points = test_points("jittered", 8, 3, 1);
    return a_copy(&points, sizeof points);
}

static void *a_pattern(const char *text)
{
    koksma_spec spec;
    must(koksma_pattern_spec(text, &spec));
    return a_copy(&spec, sizeof spec);
}

static void *a_metric(void)
{
    koksma_metric_spec *spec = a_buffer(sizeof *spec);
    if (koksma_metric_parse("hdr-flip:tone-mapper=reinhard", spec)) {
        abort();
    }
    return spec;
}

static void *a_measure(const char *text)
{
    koksma_spec spec;
    must(koksma_measure_spec(text, &spec));
    return a_copy(&spec, sizeof spec);
}

static void *open_integral(void)
{
    koksma_integral *integral;
    must(koksma_integral_open("bilinear", 2, &integral));
    return integral;
}

static double first_coordinate(const double *x, int dim, void *context)
{
    (void)dim;
    (void)context;
    return x[0];
}

static void *a_function(void)
{
    return COPY(koksma_function,
                {.name = "first", .min_dim = 1, .max_dim = 4, .at = first_coordinate, .integral = 0.5});
}

static void *integration_options(void)
{
    return COPY(koksma_integration_options, {.sizes = {4, 9, 16}, .n_sizes = 3, .seed = 1, .trials = 1});
}

static void *screen_options(void)
{
    return COPY(koksma_screen_options,
                {.dim = 2, .side = 8, .spp = 1, .filter = {.width = 2, .height = 1, .weights = {1, 1}}, .trials = 1});
}

static koksma_status first_coordinates(void *context, const koksma_points *points, double *values)
{
    (void)context;
    for (size_t i = 0; i < points->n; i++) {
        values[i] = points->xs[i * (size_t)points->dim];
    }
    return KOKSMA_OK;
}

static void *values_command(void)
{
    return COPY(koksma_values_command, {.command = "cut -d' ' -f1", .seconds = 10});
}

static void *tolerance_options(void)
{
    return COPY(koksma_tolerance_options, {.absolute = 0.1, .replicates = 10, .first_n = 16, .most_points = 640});
}

static void *mask_options(void)
{
    static float values[64];
    koksma_mask_options *o = COPY(koksma_mask_options, {.width = 8, .height = 8, .swaps = 2, .seed = 1});
    o->space = koksma_mask_space_find("scalar");
    o->from = a_copy(values, sizeof values);
    must(koksma_mask_filter_parse("box:size=3", &o->filter));
    return o;
}

static void *a_mask_filter(void)
{
    koksma_mask_filter filter;
    must(koksma_mask_filter_parse("box:size=3", &filter));
    return a_copy(&filter, sizeof filter);
}

static void *a_mask(void)
{
    float *values = a_zero(64 * sizeof *values);
    values[9] = 0.5f; /* equal pixels have no spectrum */
    return COPY(koksma_mask, {8, 8, koksma_mask_space_at(0), values});
}

static void *a_circle_mask(void)
{
    koksma_mask *mask = a_mask(); /* which its datasheet dithers no picture with */
    mask->width = 4;
    mask->space = koksma_mask_space_find("circle");
    return mask;
}

static const char **a_text_list(const char *text)
{
    static const char *list[1];
    list[0] = text;
    return list;
}

static const char *mask_file(void)
{
    const char *path = work_path("in_mask.npy");
    must(koksma_mask_write(path, a_mask(), 0));
    return path;
}

static const char *mask_recipe(void)
{
    const char *path = work_path("in_mask.json");
    must(koksma_mask_write_recipe(path, mask_options(), NULL, NULL, a_zero(sizeof(koksma_mask_result))));
    return path;
}

static void *two_axes(void)
{
    return a_copy((const int[]){0, 1}, 2 * sizeof(int));
}

static void *a_tally(void)
{
    koksma_tally tally = {0};
    koksma_tally_add(&tally, 1);
    koksma_tally_add(&tally, 2);
    return a_copy(&tally, sizeof tally);
}

static void *a_spectrum(void)
{
    koksma_spectrum spectrum;
    must(koksma_spectrum_init(&spectrum, 4));
    must(koksma_spectrum_add(&spectrum, points_of(16), KOKSMA_SPECTRUM_FAST, NULL));
    return a_copy(&spectrum, sizeof spectrum);
}

static const double *three_numbers(void)
{
    static const double numbers[] = {0.25, 0.5, 1};
    return a_copy(numbers, sizeof numbers);
}

static void *two_sizes(void)
{
    static const size_t sizes[] = {16, 4};
    return a_copy(sizes, sizeof sizes);
}

/* With a witness, or with a warp: not both together. */
static void *scatter_options(bool warped)
{
    koksma_value value = test_measure("star", points_of(16));
    return COPY(koksma_scatter_options, {.size = 64,
                                         .columns = 4,
                                         .rows = 4,
                                         .local_discrepancy = !warped,
                                         .warp = warped ? koksma_warp_find("triangle") : NULL,
                                         .witness = warped ? NULL : a_copy(&value.witness, sizeof value.witness),
                                         .caption = "a caption"});
}

static void *two_panels(void)
{
    const koksma_panel panels[2] = {{.points = points_of(16), .caption = "points"},
                                    {.spectrum = a_spectrum(), .white = 2}};
    return a_copy(panels, sizeof panels);
}

static void *a_chart(void)
{
    static const double xs[] = {1, 2, 4}, ys[] = {1, 0.5, 0.25}, errors[] = {0.1, 0.1, 0.1};
    koksma_curve *curves = COPY(koksma_curve, {.label = "a curve",
                                               .n = 3,
                                               .xs = a_copy(xs, sizeof xs),
                                               .ys = a_copy(ys, sizeof ys),
                                               .errors = a_copy(errors, sizeof errors)});
    return COPY(koksma_chart, {.x_label = "x", .y_label = "y", .log_x = true, .curves = curves, .n_curves = 1});
}

static void *a_figure(void)
{
    const koksma_cell cells[] = {{.panel = two_panels()}, {.chart = a_chart(), .row = 1}};
    return COPY(koksma_figure,
                {.title = "a figure", .cells = a_copy(cells, sizeof cells), .n_cells = 2, .width = 300});
}

static void *two_specs(void)
{
    const char *const specs[] = {a_copy("jittered", 9), a_copy("sobol:scramble=owen", 20)};
    return a_copy(specs, sizeof specs);
}

static void *a_strata_panel(void)
{
    const koksma_stratum stratum = {0, 0, 1, 1, {0.5, 0.5}, 0.5, 0};
    const koksma_split split = {0, 0, 1, 1, 0, false};
    return COPY(koksma_strata_panel, {.strata = a_copy(&stratum, sizeof stratum),
                                      .n = 1,
                                      .splits = a_copy(&split, sizeof split),
                                      .n_splits = 1,
                                      .caption = "strata"});
}

static void *an_image(void)
{
    koksma_image image;
    must(koksma_image_init(&image, 8, 4, 1));
    for (size_t i = 0; i < 32; i++) {
        image.pixels[i] = (float)(i * 7 % 5) / 5;
    }
    return a_copy(&image, sizeof image);
}

static void *two_layers(void)
{
    const koksma_layer layers[2] = {{"", an_image()}, {"depth", an_image()}};
    return a_copy(layers, sizeof layers);
}

static void *a_coherence(void)
{
    koksma_coherence coherence;
    koksma_image *white = an_image();
    memset(white->pixels, 0, 32 * sizeof *white->pixels);
    must(koksma_coherence_init(&coherence, 8, 4));
    must(koksma_coherence_add(&coherence, an_image(), white));
    return a_copy(&coherence, sizeof coherence);
}

static void *open_scene(void)
{
    koksma_scene *scene;
    must(koksma_scene_open("ball", &scene));
    return scene;
}

/* A scene is read-only. */
static void *a_scene(void)
{
    static koksma_scene *scene;
    scene = scene ? scene : open_scene();
    return scene;
}

static void *render_options(const char *patterns)
{
    koksma_render_options options;
    koksma_render_options_init(&options, a_scene());
    must(koksma_render_patterns(patterns, &options));
    options.width = 8;
    options.height = 4;
    options.spp = 4;
    return a_copy(&options, sizeof options);
}

static void *a_group(void)
{
    const koksma_render_options *options = render_options("random;pixel+time=scan-time");
    return a_copy(&options->groups[0], sizeof options->groups[0]);
}

static void *adaptive_options(void)
{
    koksma_adaptive_options options;
    must(koksma_adaptive_parse("contrast", &options));
    options.budget = 8;
    return a_copy(&options, sizeof options);
}

/* A folder that no study is in yet. */
static const char *study_folder(void)
{
    static int n;
    char name[32];
    snprintf(name, sizeof name, "study-%d-%d", (int)getpid(), n++);
    return work_path(name);
}

static const char *a_plan(void)
{
    return "{\"name\": \"f\", \"title\": \"f\", \"discrepancies\": [{\"id\": \"d\", \"patterns\": [\"random\"], "
           "\"measures\": [\"star\"], \"n\": [4], \"trials\": 2}], \"questions\": [{\"id\": \"5.1\", \"kind\": "
           "\"table\", "
           "\"title\": \"t\", \"discrepancies\": \"d\"}], \"tables\": [{\"id\": \"5.1\", \"title\": \"t\", \"n\": "
           "[4], "
           "\"measure\": \"star\", \"rows\": [{\"pattern\": \"random\", \"label\": \"r\", \"published\": "
           "[\"0.5\"]}]}]}";
}

static void *study_options(void)
{
    const char *const plans[] = {work_path("plan.json")};
    return COPY(koksma_study_options,
                {.plans = a_copy(plans, sizeof plans), .n_plans = 1, .folder = study_folder(), .trials = 2});
}

static void *a_study(void)
{
    koksma_study *study;
    must(koksma_study_open(study_options(), &study));
    return study;
}

static void *audit_options(void)
{
    return COPY(koksma_audit_options, {.folder = work_path("done"), .rows = 1});
}

static bool first_is_enough(void *context, const koksma_optimum *best)
{
    (void)context;
    (void)best;
    return false;
}

static void *digital_points(void)
{
    koksma_points points = test_points("sobol", 16, 2, 0);
    return a_copy(&points, sizeof points);
}

static void *optimise_options(void)
{
    return COPY(koksma_optimise_options, {.n = 8, .dim = 2, .steps = 1, .progress = first_is_enough});
}

static const char *a_name(const void *table, size_t i)
{
    (void)table;
    return i < 2 ? (const char *const[]){"jittered", "random"}[i] : NULL;
}

static void *a_sequence(void)
{
    const koksma_sobol sequence = koksma_sobol_of((koksma_domain){7});
    return a_copy(&sequence, sizeof sequence);
}

static void *some_keys(void)
{
    const koksma_keys keys = koksma_keys_of(7, 1, 2, 1, 4);
    return a_copy(&keys, sizeof keys);
}

static koksma_rank_picture *a_rank_picture(void)
{
    koksma_rank_picture *picture = a_zero(sizeof *picture);
    *picture = (koksma_rank_picture){.scene = "ball", .pattern = "jittered", .spp = 4, .width = 1, .height = 1};
    return picture;
}

static void *rank_options(void)
{
    const char *const patterns[] = {"random", "jittered"};
    return COPY(koksma_rank_options, {.scene = "ball",
                                      .patterns = a_copy(patterns, sizeof patterns),
                                      .n_patterns = 2,
                                      .spp = 1,
                                      .width = 2,
                                      .height = 2,
                                      .max_trials = 8,
                                      .one_size = true});
}

static void *scene_search(void)
{
    const char *const against[] = {"random"}, *const held_out[] = {"checker"};
    return COPY(koksma_scene_search, {.scene = "ball",
                                      .spp = 1,
                                      .width = 2,
                                      .height = 2,
                                      .candidates = 1,
                                      .phases = 1,
                                      .max_trials = 8,
                                      .held_out = a_copy(held_out, sizeof held_out),
                                      .n_held_out = 1,
                                      .against = a_copy(against, sizeof against),
                                      .n_against = 1});
}

/* A set of more points than a pixel has samples: no scene is rendered. */
static void *datasheet_options(void)
{
    static char sampler[128];
    const char *const beside[] = {"random"}, *const scenes[] = {"checker"};
    const koksma_points *points = points_of(289);
    snprintf(sampler, sizeof sampler, "%s", work_path("sheet.npy"));
    must(koksma_points_write(sampler, points, NULL, NULL));
    return COPY(koksma_datasheet_options, {.sampler = sampler,
                                           .metric = "smape",
                                           .beside = a_copy(beside, sizeof beside),
                                           .n_beside = 1,
                                           .scenes = a_copy(scenes, sizeof scenes),
                                           .n_scenes = 1,
                                           .quick = true});
}

/* ---- One case ------------------------------------------------------------------------------------------------ */

static struct {
    size_t function, k, failures, cases;
} * shared; /* between the child and its parent */

static struct {
    enum { VALID, REFUSED, ANY } expected;
    const char *function, *place, *value, *argument;
    bool absent;
} now;

enum { MAX_WATCHED = 4 };
static struct {
    const char *name;
    const void *at;
    size_t size;
    unsigned char before[sizeof(koksma_render_options)];
} watched[MAX_WATCHED];
static size_t n_watched;

static void wrong(const char *what)
{
    fprintf(stderr, "%s: %s = %s: %s (\"%s\")\n", now.function, now.place, now.value, what, koksma_error_text());
    shared->failures++;
}

/* A member that these arguments don't have: nothing was made wrong. */
static void absent(void)
{
    now.absent = true;
}

static void start(int expected, const char *function, const char *place, const char *value, const char *argument)
{
    now.expected = expected;
    now.function = function;
    now.place = place;
    now.value = value;
    now.argument = argument;
    shared->cases++;
    (void)koksma_image_check_path("stale"); /* its text is not what this call says */
}

static void valid_call(const char *function, const char *with)
{
    start(VALID, function, "valid arguments", with, "");
}

static void wrong_call(const char *function, const char *place, const char *value, const char *argument)
{
    start(REFUSED, function, place, value, argument);
}

static void any_call(const char *function, const char *place, const char *value)
{
    start(ANY, function, place, value, "");
}

/* Keeps what a result is before the call. */
static void watch(const char *name, const void *at, size_t size)
{
    if (at && n_watched < MAX_WATCHED && size <= sizeof watched->before) {
        watched[n_watched].name = name;
        watched[n_watched].at = at;
        watched[n_watched].size = size;
        memcpy(watched[n_watched++].before, at, size);
    }
}

/* Whether a text has one of the words, which '|' separates. */
static bool names(const char *text, const char *words)
{
    char value[12] = ""; /* a text that is wrong may stand for its name, and its first word for it */
    if (now.value[0] == '\'' || !strcmp(now.value, "long_text()")) {
        snprintf(value, sizeof value, "%.*s", (int)strcspn(now.value + 1, "':\\"), now.value + 1);
        if (strstr(text, now.value[0] == '\'' ? value : "xxxxxxxx")) {
            return true;
        }
    }
    while (*words) {
        const size_t length = strcspn(words, "|");
        for (const char *at = text; *at; at++) {
            if (!strncmp(at, words, length) && (at == text || !isalnum((unsigned char)at[-1])) &&
                !isalnum((unsigned char)at[length])) {
                return true;
            }
        }
        words += length + (words[length] == '|');
    }
    return false;
}

static void check_text(void)
{
    const char *text = koksma_error_text();
    if (!*text || strchr(text, '\n')) {
        wrong("the error has no text of one line");
    } else if (now.expected == REFUSED && !names(text, now.argument)) {
        wrong("the error does not name the argument");
    }
}

static void status_returned(koksma_status status)
{
    static const unsigned char zero[sizeof watched->before];
    if (now.expected == VALID && status) {
        wrong("refused");
    } else if (now.expected == REFUSED && !status && !now.absent) {
        wrong("accepted");
    }
    if (status) {
        check_text();
    }
    for (size_t i = 0; status && i < n_watched; i++) {
        if (memcmp(watched[i].at, watched[i].before, watched[i].size) != 0 &&
            memcmp(watched[i].at, zero, watched[i].size) != 0) {
            fprintf(stderr, "%s ", watched[i].name);
            wrong("a result is neither as before nor zero");
        }
    }
}

/* A function that returns no status says what is wrong by NULL, NaN, 0 or false, and leaves a text. */
static void neutral_returned(bool neutral)
{
    if (now.expected == REFUSED && !now.absent) {
        if (!neutral) {
            wrong("accepted");
        }
        check_text();
    }
}

static void void_returned(void)
{
    neutral_returned(true);
}

static void struct_returned(const void *result, size_t size)
{
    bool zero = true;
    for (size_t i = 0; i < size; i++) {
        zero = zero && ((const unsigned char *)result)[i] == 0;
    }
    neutral_returned(zero);
}

static void pointer_returned(const void *result)
{
    neutral_returned(!result);
}

static void number_returned(double result)
{
    neutral_returned(isnan(result) || result == 0);
}

static jmp_buf after_assertion;

/* An inline function's precondition does not hold. */
static void asserted(const char *condition)
{
    if (now.expected == VALID) {
        wrong(condition);
    }
    longjmp(after_assertion, 1);
}

#include "misuse_calls.h"

/* ---- All cases ------------------------------------------------------------------------------------------------- */

static void make_inputs(void)
{
    FILE *f = fopen(work_path("plan.json"), "w");
    if (!f || fputs(a_plan(), f) < 0 || fclose(f)) {
        abort();
    }
    koksma_study *study;
    koksma_study_options *options = study_options();
    options->folder = work_path("done");
    must(koksma_study_open(options, &study));
    must(koksma_study_run(study, NULL, NULL));
    must(koksma_study_close(study));
    must(koksma_points_write(work_path("in.npy"), points_of(16), NULL, NULL));
    must(koksma_image_write(work_path("in.pfm"), an_image(), NULL));
    FILE *off = fopen(work_path("in.off"), "w");
    if (!off || fputs("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", off) < 0 || fclose(off)) {
        abort();
    }
    must(koksma_image_write(work_path("in_1.pfm"), an_image(), NULL));
}

/* Runs cases until there is none left. */
static void run_cases(void)
{
    const struct itimerval limit = {.it_value = {.tv_sec = 20}};
    for (; shared->function < sizeof calls / sizeof *calls; shared->function++, shared->k = 0) {
        for (; !only || strstr(calls[shared->function].name, only); shared->k++) {
            n_watched = 0;
            now.absent = false;
            setitimer(ITIMER_PROF, &limit, NULL);
            if (!setjmp(after_assertion) && !calls[shared->function].call(shared->k)) {
                break;
            }
        }
    }
    fflush(stderr);
    _exit(0);
}

static void every_argument_is_checked(void **state)
{
    (void)state;
    snprintf(work, sizeof work, "/tmp/koksma-misuse-XXXXXX");
    shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(shared != MAP_FAILED && mkdtemp(work));
    int status;
    const pid_t maker = fork(); /* what is never freed is a child's */
    assert_true(maker >= 0);
    if (maker == 0) {
        make_inputs();
        _exit(0);
    }
    assert_true(waitpid(maker, &status, 0) == maker && WIFEXITED(status) && WEXITSTATUS(status) == 0);
    while (shared->function < sizeof calls / sizeof *calls) {
        fflush(NULL);
        const pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            assert_true(freopen("/dev/null", "r", stdin) && freopen("/dev/null", "w", stdout));
            assert_true(chdir(work) == 0);
            signal(SIGSEGV, SIG_DFL); /* cmocka's would go on after it */
            signal(SIGFPE, SIG_DFL);
            signal(SIGBUS, SIG_DFL);
            run_cases();
        }
        assert_true(waitpid(child, &status, 0) == child);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
            fprintf(stderr, "%s, case %zu: it ended the process (%s %d)\n", calls[shared->function].name, shared->k,
                    WIFSIGNALED(status) ? "signal" : "exit code",
                    WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
            shared->failures++;
            shared->k++;
        }
    }
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", work);
    assert_int_equal(system(command), 0);
    fprintf(stderr, "%zu calls of %zu functions\n", shared->cases, sizeof calls / sizeof *calls);
    assert_int_equal(shared->failures, 0);
}

int main(int argc, char **argv)
{
    only = argc > 1 ? argv[1] : NULL;
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_argument_is_checked)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
