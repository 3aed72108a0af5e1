/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of curves (curves.def): finds curves by name, checks the options that each curve takes, and computes the
 * means over sets that curves consist of.
 */
#include "curves.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "source.h"

static const cli_curve *const curves[] = {
#define CURVE(name) &cli_curve_##name,
#include "curves.def"
#undef CURVE
};

const cli_curve *cli_curve_at(size_t i)
{
    return i < sizeof curves / sizeof *curves ? curves[i] : NULL;
}

static const char *options_of(const cli_curve *curve, cli_curve_list list)
{
    return list == CLI_PRINTED ? curve->print.options : curve->plot.options;
}

const cli_curve *cli_curve_find(cli_curve_list list, const char *name)
{
    const cli_curve *curve;
    for (size_t i = 0; (curve = cli_curve_at(i)); i++) {
        if (options_of(curve, list) && !strcmp(name, curve->name)) {
            return curve;
        }
    }
    return !strcmp(name, "radial")     ? cli_curve_find(list, "rings") /* what others call them */
           : !strcmp(name, "spectrum") ? cli_curve_find(list, "power")
                                       : NULL;
}

/* Returns whether `word` is one of the words in `words`, which have blanks between them. */
static bool has_word(const char *words, const char *word)
{
    for (const char *at = words; *at; at += strcspn(at, " ")) {
        at += strspn(at, " ");
        if (strlen(word) == strcspn(at, " ") && !strncmp(at, word, strlen(word))) {
            return true;
        }
    }
    return false;
}

const char *cli_curve_names(cli_curve_list list, const char *option, const char *comma, const char *last, char *text,
                            size_t size)
{
    const cli_curve *curve, *before = NULL;
    size_t n = 0;
    *text = '\0';
    for (size_t i = 0; (curve = cli_curve_at(i)) || before; i++) {
        const bool wanted =
            curve && options_of(curve, list) && (!option || has_word(options_of(curve, list), option));
        if (before && (wanted || !curve)) {
            const size_t used = strlen(text);
            snprintf(text + used, size - used, "%s%s", n == 0 ? "" : curve ? comma : last, before->name);
            n++;
            before = NULL;
        }
        before = wanted ? curve : before;
        if (!curve) {
            break;
        }
    }
    return text;
}

/* Returns false, after an error, if an option is given that other curves take but this one does not. */
static bool options_fit(const cli_arguments *arguments, const cli_curve *curve, cli_curve_list list,
                        const char *before)
{
    for (const cli_option *o = arguments->command->options; o->name; o++) {
        char names[256];
        cli_curve_names(list, o->name, ", ", " or ", names, sizeof names);
        if (cli_flag(arguments, o->name) && *names && !has_word(options_of(curve, list), o->name)) {
            cli_usage_error(arguments, "--%s goes with %s%s", o->name, before, names);
            return false;
        }
    }
    return true;
}

bool cli_curves_begin(const cli_arguments *arguments, const cli_curve *curve, cli_curve_list list, const char *before,
                      cli_curves *c)
{
    *c = (cli_curves){.arguments = arguments, .curve = curve, .output = cli_text(arguments, "output", NULL)};
    c->method = cli_flag(arguments, "exact") ? KOKSMA_SPECTRUM_EXACT : KOKSMA_SPECTRUM_FAST;
    return options_fit(arguments, curve, list, before) &&
           cli_trials(arguments, 1, 1000000000, &c->seed, &c->trials) &&
           cli_whole(arguments, "half", 0, 1, KOKSMA_SPECTRUM_MAX_HALF, &c->half) &&
           cli_whole(arguments, "bins", 100, 1, 1000000, &c->bins) &&
           cli_real(arguments, "r-max", 0, 1e-6, 0.5, &c->r_max) && cli_work_begin(arguments, "curves", &c->work);
}

int cli_curves_each_set(cli_curves *c, const char *source,
                        koksma_status (*add)(cli_curves *c, const koksma_points *points, void *context),
                        void *context)
{
    cli_source opened;
    int code = cli_source_open(c->arguments, source, &opened);
    const uint64_t sets = code || opened.is_pattern ? c->trials : 1; /* a file has only one set */
    const size_t all = (size_t)c->arguments->n_operands * c->trials;
    for (uint64_t t = 0; t < sets && !code; t++) {
        koksma_points points;
        cli_work_unknown(&c->work, "points");
        code = cli_source_points(c->arguments, source, c->seed + t, &c->work.run, &points);
        if (!code) {
            c->work.what = "curves";
            cli_work_part(&c->work, c->n_sets < all ? c->n_sets : all - 1, all);
            c->n_sets++;
            const koksma_status status = add(c, &points, context);
            cli_work_end();
            code = status              ? cli_fail(c->arguments, status)
                   : cli_interrupted() ? koksma_status_exit_code(KOKSMA_INTERRUPTED)
                                       : CLI_YES;
        }
        koksma_points_fini(&points);
    }
    return code;
}

typedef struct spectrum_sum {
    koksma_spectrum *spectrum;
    double per_root;
} spectrum_sum;

static koksma_status add_spectrum(cli_curves *c, const koksma_points *points, void *context)
{
    const spectrum_sum *s = context;
    koksma_status status = KOKSMA_OK;
    if (s->spectrum->sets == 0) {
        const double wish = fmin(ceil(s->per_root * sqrt((double)points->n)), CLI_DEFAULT_HALF);
        status = koksma_spectrum_init(s->spectrum, c->half ? (int)c->half : (int)wish);
    }
    return status ? status : koksma_spectrum_add(s->spectrum, points, c->method, &c->work.run);
}

int cli_curves_spectrum(cli_curves *c, const char *source, double per_root, koksma_spectrum *out)
{
    *out = (koksma_spectrum){0};
    spectrum_sum s = {out, per_root};
    return cli_curves_each_set(c, source, add_spectrum, &s);
}
