/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Explains a ranking in sentences on stderr. The advice is to use the best pattern whose error is not coherent. The
 * text also names a pattern that leaves less error, but in visible bands.
 */
#include "studying.h"

#include "cli.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* What is explained. best: the row of the pattern to use. */
typedef struct advice {
    const koksma_rank_options *options;
    const koksma_rank_row *rows, *best;
    const koksma_ranking *ranking;
} advice;

static void say(const char *format, ...) KOKSMA_PRINTF(1, 2);
static void say(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vfprintf(stderr, format, list);
    va_end(list);
}

static const char *base_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Returns a pattern's name for the advice (cli_one_line). A file is shown without its folder if no other has the same
   name. */
static const char *name_of(const koksma_rank_options *options, size_t pattern)
{
    const char *base = base_of(options->patterns[pattern]);
    for (size_t i = 0; i < options->n_patterns; i++) {
        if (i != pattern && !strcmp(base_of(options->patterns[i]), base)) {
            return cli_one_line(options->patterns[pattern]);
        }
    }
    return cli_one_line(base);
}

static const char *name(const advice *a, const koksma_rank_row *row)
{
    return name_of(a->options, row->pattern);
}

static const char *in_bands(bool coherent)
{
    return coherent ? " (in bands)" : "";
}

const char *cli_between(size_t i, size_t n)
{
    return !i ? "" : i + 1 < n ? ", " : " and ";
}

/* Groups of rows that are named together. */
typedef enum group { FIRST, EQUAL, BIASED, SAVING } group;

/* Whether a row is in a group; SAVING: it leaves less error than the best one, but in bands. */
static bool is_in(const advice *a, const koksma_rank_row *row, group of)
{
    return of == FIRST    ? row->position == 1
           : of == EQUAL  ? row->decision == KOKSMA_RANK_EQUAL
           : of == BIASED ? row->biased && !a->options->adaptive
                          : row->coherence.coherent && row->mean < a->best->mean;
}

static size_t count_of(const advice *a, group of)
{
    size_t count = 0;
    for (size_t i = 0; i < a->ranking->n; i++) {
        count += is_in(a, &a->rows[i], of);
    }
    return count;
}

/* Prints `begin` and the names of a group, as a list such as "a, b (in bands) and c"; nothing if it is empty. */
static void say_group(const advice *a, group of, const char *begin)
{
    const size_t count = count_of(a, of);
    say("%s", count ? begin : "");
    for (size_t i = 0, done = 0; i < a->ranking->n; i++) {
        if (is_in(a, &a->rows[i], of)) {
            say("%s%s%s", cli_between(done++, count), name(a, &a->rows[i]),
                of == BIASED ? "" : in_bands(a->rows[i].coherence.coherent));
        }
    }
}

/* A number to two digits, without an exponent if it is large. The text is valid until the fourth next call. */
static const char *two(double x)
{
    static char texts[4][CLI_NUMBER];
    static size_t next;
    char *text = texts[next++ % 4];
    snprintf(text, CLI_NUMBER, fabs(x) < 99.5 ? "%.2g" : "%.0f", x);
    return text;
}

static void say_percent(double change, double low, double high, const char *direction)
{
    say("%s %% %s error", two(100 * change), direction);
    if (isfinite(low) && isfinite(high)) {
        say(" (%s to %s)", two(100 * low), two(100 * high));
    }
}

static void say_coherence(const koksma_coherence_values *c)
{
    say(" (coherence %s, the noise of %zu image%s stays below %s)", two(c->coherence), c->images,
        c->images == 1 ? "" : "s", two(c->noise_high));
}

/* Prints which patterns leave less error than the best row, but in visible bands: how much error the first of these
   patterns saves, and the names of the others. */
static void advise_against(const advice *a)
{
    const size_t count = count_of(a, SAVING);
    for (size_t i = 0, done = 0; i < a->ranking->n; i++) {
        const koksma_rank_row *row = &a->rows[i];
        if (is_in(a, row, SAVING) && !done++) {
            const double none = NAN, low = i ? none : 1 - 1 / (1 + a->best->behind_low),
                         high = i ? none : 1 - 1 / (1 + a->best->behind_high);
            say("; %s leaves ", name(a, row));
            say_percent(1 - row->mean / a->best->mean, low, high, "less");
            say(", but in visible bands");
            say_coherence(&row->coherence);
        } else if (is_in(a, row, SAVING)) {
            const char *verb = count == 2 ? ", and so does " : ", and so do ";
            say("%s%s", done++ == 1 ? verb : cli_between(done - 1, count), name(a, row));
        }
    }
}

/* Prints how much more error than the best row two patterns leave: the next worse pattern, and the last. */
static void advise_behind(const advice *a)
{
    const koksma_rank_row *best = a->best, *next = best + 1, *end = a->rows + a->ranking->n, *last = end - 1;
    const bool first = best == a->rows;
    while (next < end && (first ? next->decision != KOKSMA_RANK_WORSE
                                : next->position <= best->position || !(next->mean > best->mean))) {
        next++;
    }
    if (next < end) {
        const double none = NAN;
        say("; %s leaves ", name(a, next));
        say_percent(first ? next->behind : next->mean / best->mean - 1, first ? next->behind_low : none,
                    first ? next->behind_high : none, "more");
        if (next < last) {
            say(", %s %s %% more", name(a, last), two(100 * (first ? last->behind : last->mean / best->mean - 1)));
        }
    }
}

/* Prints how much worse than the best the pattern to use may be, and which patterns it is not told apart from. */
static void advise_tied(const advice *a)
{
    const koksma_ranking *r = a->ranking;
    const char *few = r->without_few ? " without the 0.1 % of the pixels that err most" : "",
               *all = r->without_few ? " (all pixels leave it undecided)" : "",
               *of = r->n_coherent && r->n_coherent < r->n ? " without bands" : "";
    if (r->within > 0) {
        say(", whose error%s exceeds that of the best%s by at most %s %%%s", few, of, two(100 * r->within), all);
    } else {
        say(", whose error%s is the least%s%s", few, of, all);
    }
    if (count_of(a, FIRST) > 1) {
        say_group(a, FIRST, "; not told apart: ");
    }
}

/* What the errors of all patterns have: those of pictures by other means may also come from their filter. */
static const char *in_all(const koksma_rank_options *options)
{
    return options->render || options->process ? "has visible bands, or goes over several pixels as its filter does"
                                               : "has visible bands";
}

static void advise_best(const advice *a)
{
    const koksma_ranking *r = a->ranking;
    const char *best = name(a, a->best);
    const bool all_coherent = r->n_coherent == r->n;
    if (all_coherent) {
        say("the error of every pattern %s; %s leaves the least", in_all(a->options), best);
        say_coherence(&a->best->coherence);
    } else if (r->advised || r->within <= KOKSMA_RANK_TIE) {
        say(a->options->n_patterns > 1 ? "use %s" : "%s is alone: there is nothing to rank it against", best);
        if (r->n_slow) {
            say(" (the time was too short to rank %zu of %zu patterns)", r->n_slow, a->options->n_patterns);
        }
    } else {
        say("undecided which pattern without bands leaves the least error; so far it is %s", best);
    }
    if (!(r->advised || (all_coherent && r->settled)) && r->within <= KOKSMA_RANK_TIE) {
        advise_tied(a);
    }
    if (a->best == a->rows) {
        say_group(a, EQUAL, "; equal to it within 2 %: ");
    }
    if (r->n_coherent < r->n) {
        advise_against(a);
    }
    advise_behind(a);
}

/* Prints what is known about an undecided ranking, and how many trials would decide it. */
static void advise_undecided(const advice *a)
{
    const koksma_ranking *r = a->ranking;
    const koksma_rank_row *least = a->rows;
    char time[CLI_NUMBER];
    say("undecided");
    if (count_of(a, FIRST) > 1) {
        say_group(a, FIRST, " between ");
    }
    if (r->n_slow) {
        say("; the time was too short to rank %zu of %zu patterns", r->n_slow, a->options->n_patterns);
    }
    for (size_t i = 1; i < r->n; i++) {
        least = a->rows[i].mean < least->mean ? &a->rows[i] : least;
    }
    if (r->n) {
        say("; so far %s leaves the least error%s", name(a, least), in_bands(least->coherence.coherent));
    }
    if (r->n && r->n_coherent == r->n) {
        say("; the error of every%s pattern %s", r->n_slow ? " ranked" : "", in_all(a->options));
    } else if (r->n_coherent) {
        say("; of those without bands %s leaves the least%s", name(a, a->best), r->advised ? "" : " so far");
    }
    if (!r->needed_trials) {
        say("; %s",
            r->undecidable
                ? "by these trials not even the largest number of them would decide it, because the reference's own "
                  "error is too large or the difference too small"
                : "these trials are too few to tell how many would decide it");
        return;
    }
    say("; about %lld trials of a pattern", r->needed_trials);
    if (r->needed_s > 0) {
        say(", %s for this number of samples,", cli_duration(r->needed_s, time));
    }
    say(" would %s", r->n_slow ? "rank them" : "decide it");
}

/* Prints which pattern leaves the least error at another size, with or without bands, if that is not the pattern of
   row 0. Prints that it is undecided, unless the advice has said so. */
static void advise_first(const advice *a, const koksma_rank_check *check)
{
    const koksma_rank_check_result *first = &check->first;
    if (first->state == KOKSMA_RANK_OVERTURNED) {
        say("; %s%s leaves the least error, not %s, which leaves ", name_of(a->options, first->pattern),
            in_bands(first->coherent), name(a, a->rows));
        say_percent(first->behind, first->behind_low, first->behind_high, "more");
    } else if (first->state == KOKSMA_RANK_UNSETTLED && check->advice.state != KOKSMA_RANK_UNSETTLED) {
        say("; after %lld trials it is undecided which of all patterns leaves the least error", check->trials);
    } else if (first->state == KOKSMA_RANK_UNCHECKED) {
        say("; the time was up before it was decided which of all patterns leaves the least error");
    }
}

static void advise_sizes(const advice *a)
{
    const bool some = a->ranking->n_coherent < a->ranking->n; /* some pattern has no bands */
    for (int i = 0; i < KOKSMA_RANK_CHECKS; i++) {
        const koksma_rank_check *check = &a->ranking->checks[i];
        const koksma_rank_check_result *found = &check->advice;
        say("  at %d x %d: ", check->width, check->height);
        switch (found->state) {
        case KOKSMA_RANK_CONFIRMED:
            say("the same advice%s", found->coherent && some ? ", but in visible bands" : "");
            break;
        case KOKSMA_RANK_OVERTURNED:
            say("the order changes: %s is the best%s, and %s leaves ", name_of(a->options, found->pattern),
                in_bands(found->coherent), name(a, a->best));
            say_percent(found->behind, found->behind_low, found->behind_high, "more");
            break;
        case KOKSMA_RANK_UNSETTLED:
            say("undecided after %lld trials", check->trials);
            break;
        case KOKSMA_RANK_FAILED:
            say("not checked: there was no picture of this size; --one-size leaves that out%s",
                a->options->render ? ", {width} and {height} in the command choose the size" : "");
            break;
        default:
            say("not checked%s", a->ranking->cut_short ? ", the time was up" : "");
        }
        if (found->state && found->state != KOKSMA_RANK_FAILED && a->ranking->n_coherent && some) {
            advise_first(a, check);
        }
        say("\n");
    }
}

/* Prints a sentence on the ranked patterns that are not known to be unbiased, if there are any. */
static void warn_of_bias(const advice *a)
{
    const size_t count = count_of(a, BIASED);
    say_group(a, BIASED, "  not known to be unbiased: ");
    if (count) {
        say("; part of %s error may be bias, the same in every trial, which no number of images averages "
            "away (modifiers such as shift=1 make patterns unbiased)\n",
            count > 1 ? "their" : "its");
    }
}

/* Prints in words whether an adaptive method leaves bands, and where its bias is from. */
static void say_of_method(const advice *a)
{
    const koksma_ranking *r = a->ranking;
    if (a->options->adaptive && r->n) {
        say("  adaptive by %s: ", a->options->adaptive);
        if (r->n_coherent && r->n > 1) {
            say("visible bands in the errors of %zu of %zu patterns", r->n_coherent, r->n);
        } else {
            say("%s in the error", r->n_coherent ? "visible bands" : "no visible bands");
        }
        say("; samples that decide where more are taken may bias a pixel\n");
    }
}

/* The number of patterns whose robust errors the warning prints, the best first. */
enum { MOST_ROBUST = 8 };

/* Prints a warning if few pixels carry most of the error of some patterns, and the errors without these pixels. */
static void warn_of_few_pixels(const advice *a)
{
    const size_t n = a->ranking->n;
    const koksma_rank_row *most = a->rows;
    size_t count = 0;
    char robust[CLI_NUMBER];
    for (size_t i = 0; i < n; i++) {
        count += a->rows[i].top_share >= KOKSMA_FEW_PIXELS;
        most = a->rows[i].top_share > most->top_share ? &a->rows[i] : most;
    }
    if (!count) {
        return;
    }
    say("  warning: 0.1 %% of the pixels carry most of the error of %zu of %zu patterns (%s: %.0f %%), and "
        "decide this order; a metric that weighs them less, such as smape, may give another order\n"
        "  without these pixels the errors are",
        count, n, name(a, most), 100 * most->top_share);
    for (size_t i = 0; i < n && i < MOST_ROBUST; i++) {
        say("%s %s %s", i ? "," : "", name(a, &a->rows[i]), cli_number(a->rows[i].robust, robust));
    }
    say("%s\n", n > MOST_ROBUST ? " (--json has all)" : "");
}

/* Prints what the best pattern saves: how many random samples its samples are worth. */
static void say_worth(const advice *a)
{
    const koksma_ranking *r = a->ranking;
    if (isfinite(r->random_spp) && strcmp(a->options->patterns[a->best->pattern], "random") != 0) {
        say("  %d samples of %s are as good as %.0f random samples", a->options->spp, name(a, a->best),
            r->random_spp);
        if (isfinite(r->random_spp_low) && isfinite(r->random_spp_high)) {
            say(" (%.0f to %.0f)", r->random_spp_low, r->random_spp_high);
        }
        say("\n");
    }
}

bool cli_rank_decided(const koksma_ranking *ranking)
{
    return ranking->settled || ranking->within <= KOKSMA_RANK_TIE;
}

void cli_rank_advise(const koksma_rank_options *options, const koksma_rank_row *rows, const koksma_ranking *ranking,
                     const char *process)
{
    const advice a = {options, rows, rows + ranking->use_row, ranking};
    char metric[KOKSMA_MAX_SPEC], time[CLI_NUMBER];
    double most = 0;
    say("%s at %d samples a pixel, %d x %d pixels: ", base_of(options->scene), options->spp, ranking->width,
        ranking->height);
    for (size_t i = 0; i < ranking->n; i++) {
        most = fmax(most, fabs(rows[i].mean));
    }
    if (ranking->n && most == 0) {
        say("every picture is the reference, and no pattern leaves an error; is the scene in view, and lit?\n");
        return;
    }
    const bool decided = cli_rank_decided(ranking);
    (decided ? advise_best : advise_undecided)(&a);
    koksma_metric_text(options->metric, metric);
    say(".\n  %lld trial%s (", ranking->trials, ranking->trials == 1 ? "" : "s");
    if (options->render) {
        say("by the command, error by %s", metric);
    } else {
        say("%s, %s filter, error by %s", options->integrator->name, options->filter->name, metric);
    }
    if (process) {
        say(" after %s", cli_one_line(process));
    }
    say(") in %s", cli_duration(ranking->seconds, time));
    if (isfinite(ranking->reference_error)) {
        say("; the reference's own error is %.1g", ranking->reference_error);
    }
    say("%s\n", ranking->complete    ? ""
                : ranking->cut_short ? "; the time was up before every pair was decided"
                                     : "; the trials were too few to decide every pair");
    warn_of_few_pixels(&a);
    warn_of_bias(&a);
    say_of_method(&a);
    if (decided && ranking->n > 1 && !options->one_size && !options->reference_image &&
        (!options->render || options->width)) {
        advise_sizes(&a);
    }
    say_worth(&a);
}

void cli_rank_say_look(const koksma_rank_options *options, const double *errors)
{
    double below = -1, next;
    fprintf(stderr,
            "%s at %d samples a pixel, a first look: root mean square errors by two images of each pattern, "
            "without bias\n",
            base_of(options->scene), options->spp);
    do { /* patterns of equal errors stand together */
        next = INFINITY;
        for (size_t i = 0; i < options->n_patterns; i++) {
            next = errors[i] > below && errors[i] < next ? errors[i] : next;
        }
        for (size_t i = 0; i < options->n_patterns; i++) {
            if (errors[i] == next) {
                say("  %-10.3g %s\n", errors[i], name_of(options, i));
            } else if (isinf(next) && isnan(errors[i])) {
                say("  not known  %s\n", name_of(options, i));
            }
        }
        below = next;
    } while (isfinite(next));
}
