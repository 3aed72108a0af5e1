/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Operands that name points, for all commands: files, families of files, - for standard input, and
 * [pattern:]SPEC@N[@DIM], N points of a pattern. SPEC@N is a pattern if the library has a pattern of that name, or if
 * there is no such file; ./SPEC@N is always a file. -p PATTERN,.. adds operands; -n N,.. and -d DIM complete operands
 * that are patterns without @N.
 */
#include "source.h"

#include <float.h>
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <koksma/study.h>

static const char prefix[] = "pattern:";

const char *cli_spec_in(const char *text)
{
    return text + (strncmp(text, prefix, sizeof prefix - 1) ? 0 : sizeof prefix - 1);
}

bool cli_split(const char *text, char spec[KOKSMA_MAX_SPEC], size_t *n, int *dim)
{
    snprintf(spec, KOKSMA_MAX_SPEC, "%s", cli_spec_in(text));
    char *last = strrchr(spec, '@'), *end;
    if (!last) {
        return false;
    }
    *last = '\0';
    char *before = strrchr(spec, '@'), *n_text = last + 1;
    *dim = 2;
    if (before && before[1 + strspn(before + 1, "0123456789e")] == '\0') {
        const long number = strtol(last + 1, &end, 10);
        *dim = number >= 1 && number <= KOKSMA_MAX_DIM ? (int)number : 0;
        if (last[1] < '0' || last[1] > '9' || *end) {
            return false;
        }
        *before = '\0';
        n_text = before + 1;
    }
    const char *past;
    uint64_t count;
    const bool number = cli_digits(n_text, &count, &past);
    *n = number && count < SIZE_MAX ? (size_t)count : SIZE_MAX; /* where size_t has 32 bits */
    return past != n_text && !*past;
}

/* The pattern whose name a text begins with, or NULL. */
static const koksma_pattern *pattern_in(const char *text)
{
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(text, ":@"), text);
    return koksma_pattern_find(name);
}

bool cli_names_pattern(const char *text)
{
    return pattern_in(text) != NULL;
}

static bool is_counted(const char *text)
{
    char spec[KOKSMA_MAX_SPEC];
    size_t n;
    int dim;
    return cli_split(text, spec, &n, &dim);
}

bool cli_source_is_pattern(const char *text)
{
    return cli_spec_in(text) != text ||
           (is_counted(text) && (cli_names_pattern(text) || (!strchr(text, '/') && access(text, F_OK))));
}

/* Whether a text is a pattern that names no file, with an '@' that no valid numbers of points and dimensions follow. A
   wrong number of dimensions alone is not reported. */
static bool is_miscounted(const char *text)
{
    char spec[KOKSMA_MAX_SPEC];
    size_t n = 0;
    int dim;
    const koksma_pattern *pattern = pattern_in(cli_spec_in(text));
    return pattern && !pattern->operand && strchr(text, '@') &&
           (!cli_split(text, spec, &n, &dim) || n == 0 || strchr(spec, '@'));
}

static int fail_miscounted(const cli_args *args, const char *text)
{
    return cli_error(
        args, "'%s' is not of the form SPEC@N or SPEC@N@DIM; N and DIM are whole numbers from 1 on, as in sobol@16",
        text);
}

int cli_pattern_open(const cli_args *args, const char *text, cli_source *source)
{
    char spec[KOKSMA_MAX_SPEC];
    text = cli_spec_in(text);
    *source = (cli_source){.is_pattern = true};
    if (is_miscounted(text)) {
        return fail_miscounted(args, text);
    }
    const bool counted = cli_split(text, spec, &source->n, &source->dim) && source->n;
    if (counted && source->dim == 0) {
        return cli_error(args, "'%s': the number of dimensions is 1 to %d", text, KOKSMA_MAX_DIM);
    }
    source->n = counted ? source->n : 0;
    source->dim = counted ? source->dim : 0;
    const koksma_status status = koksma_pattern_spec(counted ? spec : text, &source->spec);
    return status ? cli_fail(args, status) : CLI_YES;
}

int cli_source_open(const cli_args *args, const char *text, cli_source *source)
{
    *source = (cli_source){.is_pattern = cli_source_is_pattern(text)};
    if (source->is_pattern && cli_spec_in(text) == text && !access(text, F_OK)) {
        return cli_error(args, "%s is both a file and a pattern; write ./%s for the file, %s%s for the points", text,
                         text, prefix, text);
    }
    const int code = source->is_pattern ? cli_pattern_open(args, text, source) : CLI_YES;
    return !code && source->is_pattern && !source->n
               ? cli_error(args, "'%s' is not of the form SPEC@N or SPEC@N@DIM", text)
               : code;
}

/* Returns a hint for the end of an error about a missing file: what the operand probably is, or "". */
static const char *probable(const cli_args *args, const char *operand, char text[CLI_KNOWN])
{
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(operand, ":"), operand);
    text[0] = 0;
    if (strlen(operand) + 32 < CLI_KNOWN && cli_names_pattern(operand) && !strpbrk(operand, "\n\r\t\033")) {
        snprintf(text, CLI_KNOWN, "; did you mean %s@N?", operand);
    } else if (strchr(operand, ',')) {
        snprintf(text, CLI_KNOWN, "; it takes one name, and is given again for another");
    } else if (koksma_measure_find(name)) {
        snprintf(text, CLI_KNOWN, "; measures follow -m, with commas between them");
    } else if (strpbrk(operand, "*?{")) {
        snprintf(text, CLI_KNOWN, "; no file matches it");
    } else if (access(operand, F_OK)) {
        cli_known_as(args, operand, text);
    }
    return text;
}

/* Reads a file and divides its coordinates by the numbers of --scale. Returns the exit code. */
static int read_scaled(const cli_args *args, const char *path, const char *scale, koksma_points *points)
{
    double divisors[64];
    const size_t n = cli_reals(scale, DBL_MIN, DBL_MAX, divisors, sizeof divisors / sizeof *divisors);
    if (!n) {
        return cli_error(args, "--scale %s: it takes positive numbers, as in 512 or 640,480", scale);
    }
    const koksma_status status = koksma_points_read_mapped(path, points);
    if (status) {
        return cli_fail(args, status);
    }
    if (n != 1 && n != (size_t)points->dim) {
        return cli_error(args, "--scale %s: it takes one number, or one for each of the %d coordinates of %s", scale,
                         points->dim, path);
    }
    char said[CLI_ODDITIES];
    koksma_points_oddities(points, said, sizeof said);
    cli_warn_points(args, path, points, NULL);
    for (size_t i = 0; i < points->n * (size_t)points->dim; i++) {
        const double divisor = divisors[n == 1 ? 0 : i % (size_t)points->dim], x = points->xs[i];
        if (!(x >= 0 && x <= divisor)) {
            cli_error(args, "%s: coordinate %.9g is outside 0 to %g of --scale", path, x, divisor);
            return koksma_status_exit_code(KOKSMA_MALFORMED);
        }
        points->xs[i] = x / divisor;
    }
    cli_warn_points(args, path, points, said);
    return CLI_YES;
}

int cli_source_points(const cli_args *args, const char *text, uint64_t seed, const koksma_run *run,
                      koksma_points *points)
{
    cli_source source;
    *points = (koksma_points){0};
    const int code = cli_source_open(args, text, &source);
    if (code) {
        return code;
    }
    koksma_status status;
    const char *scale = cli_given(args, "scale");
    if (scale && !source.is_pattern) {
        const int scaled = read_scaled(args, text, scale, points);
        if (scaled) {
            koksma_points_fini(points);
        }
        return scaled;
    }
    if (source.is_pattern) {
        status = koksma_points_init(points, source.n, source.dim);
        status = status ? status : koksma_generate(&source.spec, seed, run, points);
    } else {
        status = koksma_points_read(text, points);
    }
    if (status == KOKSMA_MISSING && !source.is_pattern) {
        char meant[CLI_KNOWN];
        cli_error(args, "%s%s", koksma_error_text(), probable(args, text, meant));
        return koksma_status_exit_code(status);
    }
    if (status == KOKSMA_MALFORMED && cli_option_of(args->command->options, "scale") &&
        strstr(koksma_error_text(), "outside [0,1]") && !strstr(koksma_error_text(), "nan") &&
        !strstr(koksma_error_text(), "coordinate -") &&
        (!strchr(koksma_error_text(), ';') || strstr(koksma_error_text(), "# n 64"))) {
        cli_error(args, "%s; --scale W,H divides coordinates, such as pixels", koksma_error_text());
        return koksma_status_exit_code(status);
    }
    if (!status && !source.is_pattern) {
        cli_warn_points(args, text, points, NULL);
    }
    return status ? cli_fail(args, status) : CLI_YES;
}

void cli_warn_one_set(const cli_args *args, const char *source)
{
    cli_say(args->command->name,
            "warning: %s has one set, whatever the seed; a random modifier, such as shift=1, gives others", source);
}

bool cli_sources_check(const cli_args *args, int first, uint64_t trials, size_t n_warps)
{
    size_t n_stdin = 0;
    const char *one_set = NULL; /* a pattern, if all of them have but one set */
    bool all = (trials > 1 || cli_given(args, "seed")) && !cli_given(args, "quiet");
    for (int i = first; i < args->n_operands; i++) {
        const char *text = args->operands[i];
        n_stdin += strcmp(text, "-") ? 0 : n_warps > 1 ? n_warps : 1;
        if (n_stdin > 1) {
            return !cli_error(args, "-: stdin can be read only once");
        }
        if (trials > 1 && !cli_source_is_pattern(text)) {
            char meant[CLI_KNOWN] = "";
            return !cli_error(args, "--trials: '%s' is one set; it takes patterns, SPEC@N%s", text,
                              access(text, R_OK) ? probable(args, text, meant) : meant);
        }
        cli_source source = {0};
        if (all && cli_source_is_pattern(text) && cli_source_open(args, text, &source)) {
            return false;
        }
        all = all && (!source.is_pattern || koksma_has_one_set(&source.spec));
        one_set = text;
    }
    if (all && one_set) {
        cli_warn_one_set(args, one_set);
    }
    return true;
}

/* ---- What in points looks like a mistake, but can be measured ------------------------------------------------------ */

void cli_warn_points(const cli_args *args, const char *path, const koksma_points *points, const char *said)
{
    char text[CLI_ODDITIES];
    if (!cli_given(args, "quiet") && koksma_points_oddities(points, text, sizeof text)) {
        for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
            if (!said || !strstr(said, line)) {
                cli_say(args->command->name, "%s: warning: %s", path, line);
            }
        }
    }
}

bool cli_warn_unbalanced(const cli_args *args, const koksma_spec *spec, uint64_t n)
{
    const unsigned in_twos = KOKSMA_CLAIM_NET2_PREFIXES | KOKSMA_CLAIM_LATTICE_PREFIXES;
    uint64_t below = 1;
    while (below <= n / 2) {
        below *= 2;
    }
    const bool is_so = spec->pattern && spec->pattern->claims & in_twos && below != n;
    if (is_so) {
        cli_note(args, "note: %s is balanced at powers of 2: %llu or %llu points, not %llu", spec->pattern->name,
                 (unsigned long long)below, 2 * (unsigned long long)below, (unsigned long long)n);
    }
    return is_so;
}

void cli_warn_file(const cli_args *args, const char *pattern, uint64_t n)
{
    const char *use = strstr(pattern, "=file:"), *path = use ? use + 6 : pattern + 5;
    char name[KOKSMA_MAX_SPEC];
    koksma_points points;
    struct stat info;
    if (use || !strncmp(pattern, "file:", 5)) {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(path, ",;@\n"), path);
        const bool plain = !stat(name, &info) && S_ISREG(info.st_mode); /* a pipe is refused, without reading it */
        if (plain && !koksma_points_read(name, &points)) {
            cli_warn_points(args, name, &points, NULL);
            if (n && n < points.n) {
                cli_note(args,
                         "note: %s: the first %llu of its %zu points; only a sequence is balanced at each number",
                         name, (unsigned long long)n, points.n);
            }
            koksma_points_fini(&points);
        }
    }
}

/* ---- Families of files -------------------------------------------------------------------------------------- */

/* The length of the placeholder {n} or {seed} at the start of a text; 0: there is none. */
static size_t placeholder(const char *text)
{
    return !strncmp(text, "{n}", 3) ? 3 : !strncmp(text, "{seed}", 6) ? 6 : 0;
}

/* Whether a path is that of a family of files, whose name has digits in place of each placeholder. */
static bool is_of(const char *family, const char *path)
{
    while (*family && !placeholder(family)) {
        if (*family++ != *path++) {
            return false;
        }
    }
    bool is = !*family && !*path;
    for (size_t digits = *family ? strspn(path, "0123456789") : 0; !is && digits > 0; digits--) {
        is = is_of(family + placeholder(family), path + digits);
    }
    return is;
}

bool cli_is_family(const char *text)
{
    return (strstr(text, "{n}") || strstr(text, "{seed}")) && !cli_source_is_pattern(text);
}

size_t cli_family_files(const char *family, glob_t *found)
{
    char names[2 * KOKSMA_MAX_SPEC];
    size_t used = 0, n = 0;
    *found = (glob_t){0};
    for (const char *at = family; *at && used + 8 < sizeof names; at += placeholder(at) ? placeholder(at) : 1) {
        used += (size_t)(placeholder(at)        ? snprintf(names + used, 8, "*")
                         : strchr("*?[\\", *at) ? snprintf(names + used, 8, "\\%c", *at)
                                                : snprintf(names + used, 8, "%c", *at));
    }
    if (!used || glob(names, 0, NULL, found)) {
        return 0;
    }
    for (size_t i = 0; i < found->gl_pathc; i++) {
        char *path = found->gl_pathv[i];
        if (is_of(family, path)) {
            found->gl_pathv[i] = found->gl_pathv[n];
            found->gl_pathv[n++] = path;
        }
    }
    return n;
}

bool cli_reads(const char *text, const char *output)
{
    koksma_spec spec;
    const char *path = koksma_pattern_spec(text, &spec) || !*spec.path ? text : spec.path;
    glob_t found = {0};
    bool same = false;
    for (size_t i = cli_family_files(path, &found); i-- > 0;) {
        same |= cli_is_same_file(found.gl_pathv[i], output);
    }
    globfree(&found);
    return same;
}

/* ---- -p and -n --------------------------------------------------------------------------------------------- */

bool cli_pattern_item(const char *list, size_t i, char spec[KOKSMA_MAX_SPEC])
{
    if (strcmp(list, "all") != 0) {
        return cli_list_item(list, i, spec, KOKSMA_MAX_SPEC);
    }
    const koksma_pattern *pattern = koksma_pattern_at(0);
    for (size_t at = 0; pattern && (pattern->operand || i > 0); pattern = koksma_pattern_at(++at)) {
        i -= !pattern->operand;
    }
    snprintf(spec, KOKSMA_MAX_SPEC, "%s", pattern ? pattern->name : "");
    return pattern;
}

static int add_operand(cli_args *args, const char *text)
{
    char *copy = strdup(text);
    char **operands = realloc(args->made, ((size_t)args->n_made + 1) * sizeof *operands);
    args->made = operands ? operands : args->made;
    if (!operands || !copy) {
        free(copy);
        return cli_no_memory();
    }
    args->made[args->n_made++] = copy;
    return CLI_YES;
}

/* The values of -n and -d, and a list of the operands that -p all leaves out. */
typedef struct counts {
    const char *list; /* the list of -n, or NULL */
    uint64_t dim;
    bool all, used;
    bool any_bare;     /* whether there is a pattern without a size */
    const char *other; /* the first operand that names other points, or NULL */
    char left_out[1024];
} counts;

/* Adds an operand as it is, or once for each size of -n if it is a pattern without a size or a family of files with {n}.
   Returns the exit code. */
static int add_sizes(cli_args *args, const char *text, counts *of)
{
    char item[32], operand[KOKSMA_MAX_SPEC + 64];
    const char *spec = cli_spec_in(text);
    const bool bare = (cli_names_pattern(spec) || spec != text) && !is_counted(text);
    const char *place = !bare && cli_is_family(text) ? strstr(text, "{n}") : NULL;
    const bool sized = of->list && (bare || place);
    of->any_bare |= bare;
    of->other = bare || of->other ? of->other : text;
    int code = is_miscounted(text) && (spec != text || access(text, F_OK)) ? fail_miscounted(args, text)
               : sized                                                     ? CLI_YES
                                                                           : add_operand(args, text);
    for (size_t k = 0; sized && !code && cli_list_item(of->list, k, item, sizeof item); k++) {
        uint64_t n;
        of->used = true;
        if (!cli_is_whole(args, "n", item, 1, KOKSMA_MAX_INDEX, &n)) {
            return CLI_USAGE;
        }
        if (place) {
            snprintf(operand, sizeof operand, "%.*s%s%s", (int)(place - text), text, item, place + 3);
        } else {
            snprintf(operand, sizeof operand, of->dim == 2 ? "%s@%s" : "%s@%s@%d", text, item, (int)of->dim);
        }
        if (!of->all || !koksma_plan_try(spec, (size_t)n, (int)of->dim)) {
            code = add_operand(args, operand);
        } else {
            CLI_APPEND(of->left_out, sizeof of->left_out, "%s%s", *of->left_out ? ", " : "", operand);
        }
    }
    return code;
}

/* Checks an item of -p: a pattern, which has @N unless there is -n, or a file. `generate` makes some patterns without a
   number of points, and `integrate --tolerance` chooses it. Returns the exit code. */
static int check_item(const cli_args *args, const char *item, bool counted)
{
    const char *spec = cli_spec_in(item);
    koksma_spec known;
    const bool chosen = !strcmp(args->command->name, "integrate") && cli_text(args, "tolerance", NULL) != NULL;
    if (is_counted(item) || is_miscounted(item) || !strcmp(args->command->name, "generate") ||
        (spec == item && !access(item, F_OK))) {
        return CLI_YES;
    }
    const koksma_status status = koksma_pattern_spec(spec, &known);
    return status              ? cli_fail(args, status)
           : counted || chosen ? CLI_YES
                               : cli_error(args, "-n N, the number of points, is missing; -p %s has no @N", item);
}

/* Whether the first operand names no points, but an integrand or a curve. */
static bool takes_name_first(const cli_args *args)
{
    return !strcmp(args->command->name, "integrate") || !strcmp(args->command->name, "curve");
}

/* Says so of the first pattern with a number of points at which it is not balanced, unless there are several numbers. */
static void warn_of_count(const cli_args *args)
{
    const char *list = cli_text(args, "n", "");
    bool said = strchr(list, ',');
    for (int i = 0; i < args->n_made && !said; i++) {
        char text[KOKSMA_MAX_SPEC];
        koksma_spec spec;
        size_t n;
        int dim;
        if (cli_source_is_pattern(args->made[i]) && cli_split(args->made[i], text, &n, &dim) &&
            !koksma_pattern_spec(text, &spec)) {
            cli_warn_file(args, text, n);
            said = cli_warn_unbalanced(args, &spec, n);
        }
    }
}

int cli_sources_expand(cli_args *args)
{
    const char *patterns = cli_text(args, "patterns", NULL);
    char spec[KOKSMA_MAX_SPEC];
    counts of = {.list = cli_text(args, "n", NULL)};
    int code = cli_whole(args, "dim", 2, 1, KOKSMA_MAX_DIM, &of.dim) ? CLI_YES : CLI_USAGE;
    for (int i = 0; i < args->n_operands && !code; i++) {
        code = add_sizes(args, args->operands[i], &of);
        of.other = i > 0 || !takes_name_first(args) ? of.other : NULL;
    }
    if (!code && of.list && !patterns && !strcmp(args->command->name, "integrate") &&
        args->n_operands == !cli_text(args, "with", NULL)) {
        code = add_sizes(args, CLI_USUAL_PATTERN, &of);
    }
    of.all = patterns && !strcmp(patterns, "all");
    if (!code && of.all && !of.list) {
        code = cli_error(args, "-p all takes -n N, the number of points");
    }
    for (size_t i = 0; !code && patterns && cli_pattern_item(patterns, i, spec); i++) {
        code = check_item(args, spec, of.list != NULL);
        code = code ? code : add_sizes(args, spec, &of);
    }
    if (!code && of.all && *of.left_out && !args->n_made) {
        code = cli_error(args, "-p all: no pattern has such a set: %s", koksma_error_text());
    }
    if (!code && of.list && !of.used && !args->n_made) {
        code = cli_error(args, "-n %s: the pattern is missing, as in sobol -n %s", of.list, of.list);
    }
    if (!code && of.list && !of.used) {
        const char *last = args->n_made ? args->made[args->n_made - 1] : "-";
        koksma_spec unknown;
        code =
            strcmp(last, "-") && access(last, F_OK) && !cli_source_is_pattern(last) &&
                    koksma_pattern_spec(last, &unknown)
                ? cli_fail(args, KOKSMA_ARGUMENT)
                : cli_error(args, "-n %s: it needs a pattern without @N, and %s has its own number", of.list, last);
    }
    bool any_file = false;
    for (int i = 0; i < args->n_made; i++) {
        any_file |= (i > 0 || !takes_name_first(args)) && !cli_source_is_pattern(args->made[i]);
    }
    if (!code && cli_given(args, "scale") && args->n_made && !any_file) {
        code = cli_error(args, "--scale has no effect: no operand is a file");
    }
    const char *dim = cli_text(args, "dim", NULL);
    if (!code && dim && of.other && !of.any_bare) {
        const bool is_file = !strcmp(of.other, "-") || (!cli_source_is_pattern(of.other) && !access(of.other, F_OK));
        code = is_file ? cli_error(args, "-d %s: it needs a pattern without @N; %s has its own number of dimensions",
                                   dim, strcmp(of.other, "-") ? of.other : "standard input")
                       : cli_error(args, "-d %s: it needs a pattern without @N; write SPEC@N@%s", dim, dim);
    }
    if (!code && *of.left_out) {
        cli_note(args, "-p all leaves out patterns without such a set: %s", of.left_out);
    }
    if (!code && !cli_given(args, "first")) {
        warn_of_count(args);
    }
    args->operands = args->made;
    args->n_operands = args->n_made;
    return code;
}

void cli_sources_free(cli_args *args)
{
    for (int i = 0; i < args->n_made; i++) {
        free(args->made[i]);
    }
    free(args->made);
}

bool cli_take_counts(const cli_args *args, char *text, uint64_t *n)
{
    for (char *item = text, *next; item; item = next) {
        next = strchr(item, ';');
        char *end = next ? next : item + strlen(item), *spec = item + strcspn(item, "=:;");
        spec = *spec == '=' ? spec + 1 : item;
        char *at = end;
        while (at > spec && ((at[-1] >= '0' && at[-1] <= '9') || at[-1] == 'e')) {
            at--;
        }
        char whole[KOKSMA_MAX_SPEC];
        snprintf(whole, sizeof whole, "%.*s", (int)(end - spec), spec);
        if (is_miscounted(whole)) {
            fail_miscounted(args, whole);
            return false;
        }
        const char *past;
        uint64_t count = 0;
        if (at > spec && at[-1] == '@') {
            cli_digits(at, &count, &past);
        }
        if (count && *n && *n != count) {
            return !cli_error(args,
                              "-p: @%llu and @%llu differ; all patterns need the same number of samples a pixel",
                              (unsigned long long)*n, (unsigned long long)count);
        }
        *n = count ? count : *n;
        const size_t skip = (size_t)(cli_spec_in(spec) - spec);
        const size_t length = (size_t)((count ? at - 1 : end) - spec) - skip;
        memmove(spec, spec + skip, length);
        memmove(spec + length, end, strlen(end) + 1);
        next = spec[length] ? spec + length + 1 : NULL;
    }
    return true;
}
