/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The core library for a page in a browser: functions of numbers and texts that JavaScript can call (module.js does).
 * One set of points is the one that is looked at. Texts go in through explorer_text_in(), results come out as JSON or
 * as arrays; a NULL or a status other than 0 means that koksma_error_text() has the reason.
 * Long because all functions share one set of points and one text.
 */
#include <koksma/estimate.h>
#include <koksma/integrate.h>
#include <koksma/koksma.h>
#include <koksma/mask.h>
#include <koksma/optimise.h>
#include <koksma/sampler.h>
#include <koksma/series.h>
#include <koksma/spectrum.h>
#include <koksma/verify.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define EXPLORER_API __attribute__((used, visibility("default")))

EXPLORER_API char *explorer_text_in(void);
EXPLORER_API const char *explorer_error(void);
EXPLORER_API const char *explorer_tables(void);
EXPLORER_API const char *explorer_generate(uint32_t n, int dim, uint32_t seed_low, uint32_t seed_high);
EXPLORER_API double *explorer_room(uint32_t n, int dim);
EXPLORER_API double *explorer_points(void);
EXPLORER_API const char *explorer_csv(void);
EXPLORER_API const char *explorer_measure(void);
EXPLORER_API const char *explorer_verify(void);
EXPLORER_API uint32_t *explorer_mask(int size, uint32_t seed_low, uint32_t seed_high);
EXPLORER_API uint32_t *explorer_domain(int what, uint32_t low, uint32_t high, uint32_t x, uint32_t y);
EXPLORER_API double *explorer_samples(int sampler, uint32_t low, uint32_t high, uint32_t first, uint32_t count,
                                      int dim);
EXPLORER_API const char *explorer_line(uint32_t n, int dim);
EXPLORER_API double *explorer_spectrum(int half, int x, int y);
EXPLORER_API const char *explorer_rings(void);
EXPLORER_API const char *explorer_inequality(int x, int y);
EXPLORER_API const char *explorer_replicates(uint32_t n, int dim, uint32_t seed_low, uint32_t seed_high);
EXPLORER_API const char *explorer_optimise(uint32_t steps, int brief, uint32_t seed_low, uint32_t seed_high);

/* A function of the page: takes the best points after each step, and returns whether to go on. */
__attribute__((import_module("page"), import_name("step"))) bool
page_step(const double *xs, double value, double lower, double steps, double last_gain, const char *method);

static koksma_points points;
static koksma_spectrum spectrum;
static char text_in[KOKSMA_MAX_SPEC];

/* ---- JSON --------------------------------------------------------------------------------------------- */

static struct {
    char *text;
    size_t used, room;
    bool failed;
} out;

__attribute__((__format__(__printf__, 1, 2))) static void put(const char *format, ...)
{
    va_list arguments;
    for (;;) {
        va_start(arguments, format);
        const int wanted = vsnprintf(out.text ? out.text + out.used : NULL, out.room - out.used, format, arguments);
        va_end(arguments);
        if (wanted < 0 || out.failed) {
            out.failed = true;
            return;
        }
        if (out.used + (size_t)wanted < out.room) {
            out.used += (size_t)wanted;
            return;
        }
        const size_t room = 2 * out.room + (size_t)wanted + 4096;
        char *text = realloc(out.text, room);
        out.failed = !text;
        out.text = text ? text : out.text;
        out.room = text ? room : out.room;
    }
}

static void put_text(const char *text)
{
    put("\"");
    for (; *text; text++) {
        if (*text == '"' || *text == '\\') {
            put("\\%c", *text);
        } else {
            put((unsigned char)*text < 0x20 ? "\\u%04x" : "%c", (unsigned char)*text);
        }
    }
    put("\"");
}

static void put_number(double x)
{
    put(isfinite(x) ? "%.17g" : "null", x);
}

/* The number, and what `koksma measure` prints for it. */
static void put_value(const char *key, double x)
{
    put("\"%s\":", key);
    put_number(x);
    put(",\"%s_text\":\"", key);
    put(isfinite(x) ? "%.9g" : "-", x);
    put("\"");
}

static const char *finish(void)
{
    out.used = 0;
    if (out.failed) {
        out.failed = false;
        return NULL;
    }
    return out.text;
}

/* ---- The tables ---------------------------------------------------------------------------------------- */

static void put_params(const koksma_param *params)
{
    put("\"params\":[");
    for (const koksma_param *p = params; p && p->name; p++) {
        put("%s{\"name\":\"%s\",\"help\":", p == params ? "" : ",", p->name);
        put_text(p->help);
        put(",\"fallback\":%.17g,\"min\":%.17g,\"max\":%.17g,\"whole\":%s,\"choices\":", p->fallback, p->min, p->max,
            p->whole ? "true" : "false");
        put(p->choices ? "[" : "null");
        for (size_t i = 0; p->choices && p->choices[i]; i++) {
            put("%s\"%s\"", i ? "," : "", p->choices[i]);
        }
        put(p->choices ? "]}" : "}");
    }
    put("]");
}

static void put_head(const char *name, const char *title, const char *cite, int min_dim, int max_dim)
{
    put("{\"name\":\"%s\",\"title\":", name);
    put_text(title);
    put(",\"cite\":\"%s\",\"min_dim\":%d,\"max_dim\":%d,", cite, min_dim, max_dim);
}

/* Names and meanings. */
static void put_claims(unsigned claims)
{
    bool any = false;
    put("\"claims\":[");
#define KOKSMA_CLAIM(id, bit, name, meaning)                                                                         \
    if (claims & KOKSMA_CLAIM_##id) {                                                                                \
        put("%s[\"%s\",", any ? "," : "", name);                                                                     \
        put_text(meaning);                                                                                           \
        put("]");                                                                                                    \
        any = true;                                                                                                  \
    }
#include <koksma/claims.def>
#undef KOKSMA_CLAIM
    put("],");
}

const char *explorer_tables(void)
{
    put("{\"version\":\"%s\",\"max_spec\":%d,\"patterns\":[", koksma_version(), KOKSMA_MAX_SPEC);
    const koksma_pattern *p;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        put(i ? "," : "");
        put_head(p->name, p->title, p->cite, p->min_dim, p->max_dim);
        put_claims(p->claims);
        put("\"takes_path\":%s,\"alias_of\":\"%s\",", p->operand ? "true" : "false", p->alias_of ? p->alias_of : "");
        put_params(p->params);
        put("}");
    }
    put("],\"measures\":[");
    const koksma_measure *m;
    for (size_t i = 0; (m = koksma_measure_at(i)); i++) {
        put(i ? "," : "");
        put_head(m->name, m->title, m->cite, m->min_dim, m->max_dim);
        put("\"family\":%d,\"exact\":%s,\"larger_is_better\":%s,\"cost\":", (int)m->family,
            m->answer == KOKSMA_ANSWER_EXACT ? "true" : "false", m->larger_is_better ? "true" : "false");
        put_text(m->cost);
        put(",");
        put_params(m->params);
        put("}");
    }
    put("],\"integrands\":[");
    const koksma_integrand *f;
    for (size_t i = 0, known = 0; (f = koksma_integrand_at(i)); i++) {
        if (f->axes == 2) {
            put("%s{\"name\":\"%s\",\"title\":", known++ ? "," : "", f->name);
            put_text(f->title);
            put("}");
        }
    }
    put("]}");
    return finish();
}

/* ---- Points and measures ------------------------------------------------------------------------------- */

char *explorer_text_in(void)
{
    return text_in;
}

const char *explorer_error(void)
{
    return koksma_error_text();
}

double *explorer_room(uint32_t n, int dim)
{
    koksma_points_fini(&points);
    points = (koksma_points){0};
    return koksma_points_init(&points, n, dim) ? NULL : points.xs;
}

double *explorer_points(void)
{
    return points.xs;
}

/* One thread: a page has others in other workers. */
static const koksma_run one_thread = {.threads = 1};

/* Makes the set of the pattern whose spec is the text in; gives its canonical spec. */
const char *explorer_generate(uint32_t n, int dim, uint32_t seed_low, uint32_t seed_high)
{
    koksma_spec spec;
    char canonical[KOKSMA_MAX_SPEC];
    if (koksma_pattern_spec(text_in, &spec) || !explorer_room(n, dim) ||
        koksma_generate(&spec, (uint64_t)seed_high << 32 | seed_low, &one_thread, &points)) {
        return NULL;
    }
    koksma_spec_text(&spec, canonical);
    put("{\"spec\":");
    put_text(canonical);
    put("}");
    return finish();
}

/* The points as koksma_points_write puts them into a .csv file. */
const char *explorer_csv(void)
{
    for (int k = 0; k < points.dim; k++) {
        put("%sx%d", k ? "," : "", k);
    }
    for (size_t i = 0; i < points.n * (size_t)points.dim; i++) {
        put("%s%.17g", i % (size_t)points.dim ? "," : "\n", points.xs[i]);
    }
    put("\n");
    return finish();
}

static void put_corner(const char *key, const double *xs, int dim)
{
    put(",\"%s\":[", key);
    for (int k = 0; k < dim; k++) {
        put("%s%.17g", k ? "," : "", xs[k]);
    }
    put("]");
}

static void put_witness(const koksma_witness *w)
{
    static const char *const kinds[] = {"none", "box", "half-plane", "disk"};
    put(",\"witness\":");
    if (w->kind == KOKSMA_WITNESS_NONE) {
        put("null");
        return;
    }
    const bool box = w->kind == KOKSMA_WITNESS_BOX, disk = w->kind == KOKSMA_WITNESS_DISK;
    put("{\"kind\":\"%s\",\"closed\":%s,\"count\":%lu,\"volume\":%.17g", kinds[w->kind], w->closed ? "true" : "false",
        (unsigned long)w->count, w->volume);
    put_corner("lo", w->lo, disk ? 2 : w->dim);
    put_corner("hi", w->hi, box ? w->dim : 1);
    put("}");
}

/* The measure whose spec is the text in, of the points. */
const char *explorer_measure(void)
{
    koksma_spec spec;
    koksma_value value;
    char canonical[KOKSMA_MAX_SPEC];
    if (koksma_measure_spec(text_in, &spec) || koksma_evaluate(&spec, &points, &one_thread, &value)) {
        return NULL;
    }
    koksma_spec_text(&spec, canonical);
    put("{\"measure\":");
    put_text(canonical);
    put(",");
    put_value("value", value.value);
    put(",");
    put_value("standard_error", value.standard_error);
    put(",\"exact\":%s", value.exact ? "true" : "false");
    put_witness(&value.witness);
    put("}");
    return finish();
}

/* The properties of the points: an array of findings. */
const char *explorer_verify(void)
{
    koksma_findings findings;
    if (koksma_verify(&points, &one_thread, &findings)) {
        return NULL;
    }
    put("[");
    for (size_t i = 0; i < findings.count; i++) {
        const koksma_finding *f = &findings.items[i];
        put("%s{\"property\":\"%s\",\"subject\":", i ? "," : "", f->property);
        put_text(f->subject);
        put(",\"holds\":%s,", f->holds ? "true" : "false");
        put_value("value", f->value);
        put(",\"detail\":");
        put_text(f->detail);
        put("}");
    }
    put("]");
    koksma_findings_fini(&findings);
    return finish();
}

/* A void-and-cluster mask: size * size ranks, which stay until the next mask. */
uint32_t *explorer_mask(int size, uint32_t seed_low, uint32_t seed_high)
{
    static uint32_t *ranks;
    const bool fits = size >= KOKSMA_MASK_MIN && size <= KOKSMA_MASK_MAX;
    uint32_t *more = realloc(ranks, fits ? (size_t)size * (size_t)size * sizeof *ranks : sizeof *ranks);
    ranks = more ? more : ranks;
    return !more || koksma_mask_void_and_cluster(size, (uint64_t)seed_high << 32 | seed_low, &one_thread, ranks)
               ? NULL
               : ranks;
}

/* ---- Samples for renderers (koksma/sampler.h) ------------------------------------------------------------ */

/* The key of a domain, low and high half. what: 0: of pixel (x, y) with the seed (low, high); 1: of use x of the domain;
   2: of sample x of the domain; 3: the seed of frame x. */
uint32_t *explorer_domain(int what, uint32_t low, uint32_t high, uint32_t x, uint32_t y)
{
    static uint32_t halves[2];
    const uint64_t key = (uint64_t)high << 32 | low;
    const koksma_domain domain = {key};
    const uint64_t made = what == 0   ? koksma_domain_of_pixel(key, x, y).key
                          : what == 1 ? koksma_domain_of_use(domain, x).key
                          : what == 2 ? koksma_domain_of_sample(domain, x).key
                                      : koksma_seed_of_frame(key, x);
    halves[0] = (uint32_t)made;
    halves[1] = (uint32_t)(made >> 32);
    return halves;
}

/* Samples first .. first + count - 1 of a domain, in the room of the points. sampler: 0: Sobol, 1 to 4 dimensions;
   1: PMJ02, 2 dimensions; 2: independent numbers, 1 to 4 dimensions. */
double *explorer_samples(int sampler, uint32_t low, uint32_t high, uint32_t first, uint32_t count, int dim)
{
    const koksma_domain domain = {(uint64_t)high << 32 | low};
    double *xs = dim < 1 || dim > 4 || (sampler == 1 && dim != 2) ? NULL : explorer_room(count, dim);
    for (uint32_t i = 0; xs && i < count; i++) {
        double four[4];
        if (sampler == 0) {
            koksma_sobol_4d(domain, first + i, four);
        } else if (sampler == 1) {
            koksma_pmj02_2d(domain, first + i, four);
        } else {
            koksma_white_4d(domain, first + i, four);
        }
        memcpy(xs + (size_t)i * (size_t)dim, four, (size_t)dim * sizeof *four);
    }
    return xs;
}

/* The slope of log value over log n, n pairs in the room as (number of points, value), and the exponents of theory:
   the text in is the measure's spec, a newline and the pattern's. */
const char *explorer_line(uint32_t n, int dim)
{
    koksma_spec measure, pattern;
    koksma_line line;
    char *border = strchr(text_in, '\n');
    double *columns = n <= points.n ? malloc(2 * sizeof *columns * n) : NULL;
    if (!border || !columns) {
        free(columns);
        return NULL;
    }
    *border = '\0';
    for (size_t i = 0; i < n; i++) {
        columns[i] = points.xs[2 * i];
        columns[n + i] = points.xs[2 * i + 1];
    }
    const bool fits = koksma_log_line(n, columns, columns + n, &line);
    free(columns);
    if (koksma_measure_spec(text_in, &measure) || koksma_pattern_spec(border + 1, &pattern)) {
        return NULL;
    }
    put("{");
    put_value("slope", fits ? line.slope : (double)NAN);
    put(",");
    put_value("slope_error", fits ? line.slope_error : (double)NAN);
    put(",");
    put_value("intercept", fits ? line.intercept : (double)NAN);
    put(",");
    put_value("theory", -koksma_rate(&pattern, measure.measure, dim));
    put(",");
    put_value("best", -koksma_best_rate(measure.measure, dim));
    put("}");
    return finish();
}

/* ---- The power spectrum -------------------------------------------------------------------------------- */

/* Of coordinates x and y of the points, both the same for a set on a line; (half + 1) x (2 half + 1) powers. */
double *explorer_spectrum(int half, int x, int y)
{
    koksma_points plane;
    koksma_spectrum_fini(&spectrum);
    spectrum = (koksma_spectrum){0};
    if (koksma_points_init(&plane, points.n, 2)) {
        return NULL;
    }
    for (size_t i = 0; i < points.n; i++) {
        plane.xs[2 * i] = points.xs[i * (size_t)points.dim + (size_t)x];
        plane.xs[2 * i + 1] = points.xs[i * (size_t)points.dim + (size_t)y];
    }
    const koksma_status status = koksma_spectrum_init(&spectrum, half);
    const bool good = !status && !koksma_spectrum_add(&spectrum, &plane, KOKSMA_SPECTRUM_FAST, &one_thread);
    koksma_points_fini(&plane);
    return good ? spectrum.power : NULL;
}

/* Of the spectrum that was made last: the rings, and the numbers that sum it up. */
const char *explorer_rings(void)
{
    koksma_ring *rings = malloc((size_t)spectrum.half * sizeof *rings);
    koksma_spectrum_quality_values quality;
    if (!rings || koksma_spectrum_rings(&spectrum, rings)) {
        free(rings);
        return NULL;
    }
    put("{\"rings\":[");
    for (int i = 0; i < spectrum.half; i++) {
        put("%s{\"frequency\":%.17g,", i ? "," : "", rings[i].frequency);
        put_value("power", rings[i].power);
        put(",");
        put_value("anisotropy_db", rings[i].anisotropy_db);
        put("}");
    }
    free(rings);
    koksma_spectrum_quality(&spectrum, &quality);
    put("],");
    put_value("effective_nyquist", quality.effective_nyquist);
    put(",");
    put_value("relative_nyquist", quality.relative_nyquist);
    put(",");
    put_value("oscillation", quality.oscillation);
    put("}");
    return finish();
}

/* ---- Koksma's inequality ------------------------------------------------------------------------------- */

/* The star discrepancy of `dim` coordinates of the points, from the one in `axes` on; NaN: it failed. */
static double star_of(const int *axes, int dim, koksma_points *made)
{
    koksma_spec spec;
    koksma_value value;
    if (koksma_points_init(made, points.n, dim)) {
        return NAN;
    }
    for (size_t i = 0; i < points.n; i++) {
        for (int k = 0; k < dim; k++) {
            made->xs[i * (size_t)dim + (size_t)k] = points.xs[i * (size_t)points.dim + (size_t)axes[k]];
        }
    }
    return koksma_measure_spec("star", &spec) || koksma_evaluate(&spec, made, &one_thread, &value) ? (double)NAN
                                                                                                   : value.value;
}

/* What is known of integrand f, and its error over points of as many dimensions as it has axes. NaN when it fails. */
static double error_of(const koksma_integrand *f, const koksma_points *of, koksma_integral_facts *facts)
{
    koksma_integral *integral;
    double mean = NAN;
    *facts = (koksma_integral_facts){.variation = NAN};
    if (!koksma_integral_open(f->name, f->axes, &integral)) {
        koksma_integral_about(integral, facts);
        mean = koksma_integrate(integral, of, NULL, &mean) ? NAN : mean;
        koksma_integral_close(integral);
    }
    return fabs(mean - facts->value);
}

/* The error of every function of known variation over coordinates x and y of the points, beside V(f) D*; functions of
   x alone over x. A set on a line has those only. */
const char *explorer_inequality(int x, int y)
{
    koksma_points of[2] = {{0}, {0}};
    const int axes[] = {x, y}, dims = points.dim < 2 ? 1 : 2;
    double star[2];
    for (int d = 0; d < dims; d++) {
        star[d] = star_of(axes, d + 1, &of[d]);
    }
    const bool good = !isnan(star[0]) && (dims == 1 || !isnan(star[1]));
    const koksma_integrand *f;
    put("{\"functions\":[");
    for (size_t i = 0, n = 0; good && (f = koksma_integrand_at(i)); i++) {
        koksma_integral_facts facts;
        if (f->axes && f->axes <= dims) {
            const double error = error_of(f, &of[f->axes - 1], &facts);
            put("%s{\"title\":\"%s\",\"dim\":%d,\"range\":%.17g,", n++ ? "," : "", f->title, f->axes,
                facts.highest - facts.lowest);
            put_value("variation", facts.variation);
            put(",");
            put_value("error", error);
            put(",");
            put_value("bound", facts.variation * star[f->axes - 1]);
            put("}");
        }
    }
    put("]}");
    koksma_points_fini(&of[0]);
    koksma_points_fini(&of[1]);
    const char *text = finish();
    return good ? text : NULL;
}

/* ---- Replicates ----------------------------------------------------------------------------------------- */

enum { REPLICATES = 15 }; /* as many as `koksma integrate` takes */

static void put_estimate(const char *estimator, const double *values)
{
    koksma_integral_estimate e;
    const koksma_estimate_options o = {.estimator = estimator};
    if (koksma_estimate_integral(&o, values, REPLICATES, &one_thread, &e)) {
        out.failed = true;
        return;
    }
    put("{\"estimator\":\"%s\",\"interval\":\"%s\",\"value\":%.17g,\"low\":%.17g,\"high\":%.17g}", e.estimator,
        e.interval, e.value, e.low, e.high);
}

/* Estimates of an integral by sets with the seeds from this one on; the text in is the integrand's spec, a newline and the
   pattern's. Mean and median with their intervals are those of koksma_integrate_to. */
const char *explorer_replicates(uint32_t n, int dim, uint32_t seed_low, uint32_t seed_high)
{
    char *border = strchr(text_in, '\n');
    koksma_spec spec;
    koksma_integral *integral = NULL;
    koksma_integral_facts facts;
    double values[REPLICATES];
    koksma_status status = border && dim > 1 ? KOKSMA_OK : KOKSMA_ARGUMENT;
    if (border) {
        *border = '\0';
    }
    status = status ? status : koksma_pattern_spec(border + 1, &spec);
    if (!status && (koksma_has_one_set(&spec) || !koksma_is_unbiased(&spec))) {
        put("{\"error\":\"%s\"}",
            koksma_has_one_set(&spec)
                ? "The pattern has one set, whose error no interval knows; shift or scramble it."
                : "The pattern is not known to be unbiased: its estimates may be around another value.");
        return finish();
    }
    status = status ? status : koksma_integral_open(text_in, dim, &integral);
    for (uint32_t r = 0; r < REPLICATES && !status; r++) {
        const uint64_t seed = ((uint64_t)seed_high << 32 | seed_low) + r;
        status = explorer_room(n, dim) ? koksma_generate(&spec, seed, &one_thread, &points) : KOKSMA_MEMORY;
        status = status ? status : koksma_integrate(integral, &points, &one_thread, &values[r]);
    }
    if (!status) {
        koksma_integral_about(integral, &facts);
        put("{\"truth\":%.17g,\"values\":[", facts.value);
        for (int r = 0; r < REPLICATES; r++) {
            put("%s%.17g", r ? "," : "", values[r]);
        }
        put("],\"estimates\":[");
        put_estimate("mean", values);
        put(",");
        put_estimate("median", values);
        put("]}");
    }
    koksma_integral_close(integral);
    return status ? NULL : finish();
}

/* ---- Optimisation --------------------------------------------------------------------------------------- */

static bool show_step(void *context, const koksma_optimum *best)
{
    (void)context;
    return page_step(best->points.xs, best->value, best->lower, (double)best->steps, (double)best->last_gain,
                     best->method);
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* A step of koksma_optimise takes the best methods through whole searches: seconds, after which the value is often the
   best one known. Here a reader sees the value fall: step k is k walks of two hundred small moves, or as many
   as fit into an eighth of a second, from the best set so far. The result depends on the machine's speed: no command
   repeats it. */
static koksma_status optimise_briefly(const koksma_spec *spec, const koksma_optimise_options *o)
{
    const koksma_method *witness = koksma_method_find("witness"), *perturb = koksma_method_find("perturb");
    const koksma_method *method = witness->serves(spec, o) > perturb->serves(spec, o) ? witness : perturb;
    const double sign = spec->measure->larger_is_better ? -1 : 1;
    koksma_optimum best = {.points = points, .lower = (double)NAN, .method = method->name};
    koksma_value value;
    koksma_points trial;
    uint64_t walks = 0;
    koksma_status status = koksma_points_init(&trial, points.n, points.dim);
    status = status ? status : koksma_evaluate(spec, &points, &one_thread, &value);
    best.value = status ? 0 : value.value;
    while (!status && show_step(NULL, &best) && (o->steps == 0 || best.steps < o->steps)) {
        const double start_s = seconds();
        best.steps++;
        for (uint64_t i = 0; !status && (i == 0 || seconds() - start_s < 0.125); i++) {
            if (i >= best.steps) {
                continue; /* the first steps gain much by few walks: the reader sees them one after the other */
            }
            memcpy(trial.xs, points.xs, points.n * (size_t)points.dim * sizeof(double));
            status = method->search(spec, o, o->seed + ++walks, sign * best.value, &one_thread, &trial);
            status = status ? status : koksma_evaluate(spec, &trial, &one_thread, &value);
            if (!status && sign * value.value < sign * best.value) {
                memcpy(points.xs, trial.xs, points.n * (size_t)points.dim * sizeof(double));
                best.value = value.value;
                best.last_gain = best.steps;
            }
        }
    }
    koksma_points_fini(&trial);
    if (!status) {
        put("{\"steps\":%lu}", (unsigned long)best.steps);
    }
    return status;
}

/* Searches for points with a small value of the measure whose spec is the text in, beginning with the points: so many
   steps, or, with 0, until page_step returns false. The points are the best set afterwards. */
const char *explorer_optimise(uint32_t steps, int brief, uint32_t seed_low, uint32_t seed_high)
{
    koksma_spec spec;
    koksma_optimum best;
    const koksma_optimise_options options = {.n = points.n,
                                             .dim = points.dim,
                                             .first = &points,
                                             .seed = (uint64_t)seed_high << 32 | seed_low,
                                             .steps = steps,
                                             .progress = show_step};
    if (koksma_measure_spec(text_in, &spec)) {
        return NULL;
    }
    if (brief && spec.measure->answer == KOKSMA_ANSWER_EXACT) {
        return optimise_briefly(&spec, &options) ? NULL : finish();
    }
    if (koksma_optimise(&spec, &options, &one_thread, &best)) {
        return NULL;
    }
    memcpy(points.xs, best.points.xs, points.n * (size_t)points.dim * sizeof(double));
    put("{\"steps\":%lu}", (unsigned long)best.steps);
    koksma_optimum_fini(&best);
    return finish();
}
