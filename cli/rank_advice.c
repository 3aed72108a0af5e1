/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Explains a ranking in sentences on stderr. The advice is to use the best pattern whose error is not coherent. The
 * text also names a pattern that leaves less error, but in visible bands.
 */
#include "studying.h"

#include "cli.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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

static const char *in_bands(const koksma_rank_row *row)
{
    return row->coherence.coherent ? " (in bands)" : "";
}

/* Prints the names of the patterns at `position` or, if it is 0, of the patterns with this decision, as a list such
   as "a", "a and b (in bands)" or "a, b and c". */
static void print_patterns(const koksma_rank_options *options, const koksma_rank_row *rows, size_t n,
                           koksma_rank_decision decision, size_t position)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        count += position ? rows[i].position == position : rows[i].decision == decision;
    }
    for (size_t i = 0, done = 0; i < n; i++) {
        if (position ? rows[i].position == position : rows[i].decision == decision) {
            fprintf(stderr, "%s%s%s",
                    !done              ? ""
                    : done + 1 < count ? ", "
                                       : " and ",
                    name_of(options, rows[i].pattern), in_bands(&rows[i]));
            done++;
        }
    }
}

/* Prints a number to two digits; a large number has no exponent. */
static void print_two_digits(double x)
{
    fprintf(stderr, fabs(x) < 99.5 ? "%.2g" : "%.0f", x);
}

static void print_seconds(double seconds)
{
    char text[CLI_NUMBER];
    fputs(cli_duration(seconds, text), stderr);
}

static void print_percent(double change, double low, double high, const char *direction)
{
    print_two_digits(100 * change);
    fprintf(stderr, " %% %s error", direction);
    if (isfinite(low) && isfinite(high)) {
        fprintf(stderr, " (");
        print_two_digits(100 * low);
        fprintf(stderr, " to ");
        print_two_digits(100 * high);
        fprintf(stderr, ")");
    }
}

static void print_coherence(const koksma_rank_row *row)
{
    const koksma_coherence_values *c = &row->coherence;
    fprintf(stderr, " (coherence ");
    print_two_digits(c->coherence);
    fprintf(stderr, ", the noise of %zu image%s stays below ", c->images, c->images == 1 ? "" : "s");
    print_two_digits(c->noise_high);
    fprintf(stderr, ")");
}

static bool saves_in_bands(const koksma_rank_row *row, const koksma_rank_row *best)
{
    return row->coherence.coherent && row->mean < best->mean;
}

/* Prints which patterns leave less error than row `best`, but in visible bands: how much error the first of these
   patterns saves, and the names of the others. */
static void advise_against(const koksma_rank_options *options, const koksma_rank_row *rows, size_t n, size_t best)
{
    size_t count = 0, done = 0;
    for (size_t i = 0; i < n; i++) {
        count += saves_in_bands(&rows[i], &rows[best]);
    }
    for (size_t i = 0; i < n; i++) {
        const koksma_rank_row *row = &rows[i];
        if (!saves_in_bands(row, &rows[best])) {
            continue;
        }
        if (done++) {
            fprintf(stderr, "%s%s",
                    done == 2      ? count == 2 ? ", and so does " : ", and so do "
                    : done < count ? ", "
                                   : " and ",
                    name_of(options, row->pattern));
            continue;
        }
        const double none = NAN, low = i ? none : 1 - 1 / (1 + rows[best].behind_low),
                     high = i ? none : 1 - 1 / (1 + rows[best].behind_high);
        fprintf(stderr, "; %s leaves ", name_of(options, row->pattern));
        print_percent(1 - row->mean / rows[best].mean, low, high, "less");
        fprintf(stderr, ", but in visible bands");
        print_coherence(row);
    }
}

/* Prints how much more error than row `best` two patterns leave: the next worse pattern, and the last. */
static void advise_behind(const koksma_rank_options *options, const koksma_rank_row *rows, size_t n, size_t best)
{
    size_t next = best + 1;
    const koksma_rank_row *last = &rows[n - 1];
    while (next < n && (best ? rows[next].position <= rows[best].position || !(rows[next].mean > rows[best].mean)
                             : rows[next].decision != KOKSMA_RANK_WORSE)) {
        next++;
    }
    if (next < n) {
        const double none = NAN, low = best ? none : rows[next].behind_low,
                     high = best ? none : rows[next].behind_high;
        fprintf(stderr, "; %s leaves ", name_of(options, rows[next].pattern));
        print_percent(best ? rows[next].mean / rows[best].mean - 1 : rows[next].behind, low, high, "more");
        if (next + 1 < n) {
            fprintf(stderr, ", %s ", name_of(options, last->pattern));
            print_two_digits(100 * (best ? last->mean / rows[best].mean - 1 : last->behind));
            fprintf(stderr, " %% more");
        }
    }
}

/* Prints how much worse than the best the pattern to use may be, and which patterns it is not told apart from. */
static void advise_tied(const koksma_rank_options *options, const koksma_rank_row *rows,
                        const koksma_ranking *ranking)
{
    const bool bands = ranking->n_coherent && ranking->n_coherent < ranking->n;
    size_t first = 0;
    for (size_t i = 0; i < ranking->n; i++) {
        first += rows[i].position == 1;
    }
    const char *few = ranking->without_few ? " without the 0.1 % of the pixels that err most" : "";
    const char *all = ranking->without_few ? " (all pixels leave it undecided)" : "",
               *of = bands ? " without bands" : "";
    if (ranking->within > 0) {
        fprintf(stderr, ", whose error%s exceeds that of the best%s by at most ", few, of);
        print_two_digits(100 * ranking->within);
        fprintf(stderr, " %%%s", all);
    } else {
        fprintf(stderr, ", whose error%s is the least%s%s", few, of, all);
    }
    if (first > 1) {
        fprintf(stderr, "; not told apart: ");
        print_patterns(options, rows, ranking->n, KOKSMA_RANK_UNDECIDED, 1);
    }
}

/* What the errors of all patterns have: those of pictures by other means may also come from their filter. */
static const char *in_all(const koksma_rank_options *options)
{
    return options->render || options->process ? "has visible bands, or goes over several pixels as its filter does"
                                               : "has visible bands";
}

static void advise_best(const koksma_rank_options *options, const koksma_rank_row *rows,
                        const koksma_ranking *ranking)
{
    const size_t best = ranking->use_row;
    const char *name = name_of(options, rows[best].pattern);
    const bool all_coherent = ranking->n_coherent == ranking->n;
    if (all_coherent) {
        fprintf(stderr, "the error of every pattern %s; %s leaves the least", in_all(options), name);
        print_coherence(&rows[best]);
    } else if (ranking->advised || ranking->within <= KOKSMA_RANK_TIE) {
        fprintf(stderr, options->n_patterns > 1 ? "use %s" : "%s is alone: there is nothing to rank it against",
                name);
        if (ranking->n_slow) {
            fprintf(stderr, " (the time was too short to rank %zu of %zu patterns)", ranking->n_slow,
                    options->n_patterns);
        }
    } else {
        fprintf(stderr, "undecided which pattern without bands leaves the least error; so far it is %s", name);
    }
    if (!(ranking->advised || (all_coherent && ranking->settled)) && ranking->within <= KOKSMA_RANK_TIE) {
        advise_tied(options, rows, ranking);
    }
    for (size_t i = 1; best == 0 && i < ranking->n; i++) {
        if (rows[i].decision == KOKSMA_RANK_EQUAL) {
            fprintf(stderr, "; equal to it within 2 %%: ");
            print_patterns(options, rows, ranking->n, KOKSMA_RANK_EQUAL, 0);
            break;
        }
    }
    if (ranking->n_coherent < ranking->n) {
        advise_against(options, rows, ranking->n, best);
    }
    advise_behind(options, rows, ranking->n, best);
}

/* Prints what is known about an undecided ranking, and how many trials would decide it. */
static void advise_undecided(const koksma_rank_options *options, const koksma_rank_row *rows,
                             const koksma_ranking *ranking)
{
    size_t first = 0;
    for (size_t i = 0; i < ranking->n; i++) {
        first += rows[i].position == 1;
    }
    fprintf(stderr, "undecided");
    if (first > 1) {
        fprintf(stderr, " between ");
        print_patterns(options, rows, ranking->n, KOKSMA_RANK_UNDECIDED, 1);
    }
    if (ranking->n_slow) {
        fprintf(stderr, "; the time was too short to rank %zu of %zu patterns", ranking->n_slow, options->n_patterns);
    }
    if (ranking->n) {
        size_t least = 0;
        for (size_t i = 1; i < ranking->n; i++) {
            least = rows[i].mean < rows[least].mean ? i : least;
        }
        fprintf(stderr, "; so far %s leaves the least error%s", name_of(options, rows[least].pattern),
                in_bands(&rows[least]));
    }
    if (ranking->n && ranking->n_coherent == ranking->n) {
        fprintf(stderr, "; the error of every%s pattern %s", ranking->n_slow ? " ranked" : "", in_all(options));
    } else if (ranking->n_coherent) {
        fprintf(stderr, "; of those without bands %s leaves the least%s",
                name_of(options, rows[ranking->use_row].pattern), ranking->advised ? "" : " so far");
    }
    if (!ranking->needed_trials) {
        fprintf(
            stderr, "; %s",
            ranking->undecidable
                ? "by these trials not even the largest number of them would decide it, because the reference's own "
                  "error is too large or the difference too small"
                : "these trials are too few to tell how many would decide it");
        return;
    }
    fprintf(stderr, "; about %lld trials of a pattern", ranking->needed_trials);
    if (ranking->needed_s > 0) {
        fprintf(stderr, ", ");
        print_seconds(ranking->needed_s);
        fprintf(stderr, " for this number of samples,");
    }
    fprintf(stderr, " would %s", ranking->n_slow ? "rank them" : "decide it");
}

/* Prints which pattern leaves the least error at another size, with or without bands, if that is not the pattern of
   row 0. Prints that it is undecided, unless the advice has said so. */
static void advise_first(const koksma_rank_options *options, const koksma_rank_row *rows,
                         const koksma_rank_check *check)
{
    const koksma_rank_check_result *first = &check->first;
    switch (first->state) {
    case KOKSMA_RANK_OVERTURNED:
        fprintf(stderr, "; %s%s leaves the least error, not %s, which leaves ", name_of(options, first->pattern),
                first->coherent ? " (in bands)" : "", name_of(options, rows[0].pattern));
        print_percent(first->behind, first->behind_low, first->behind_high, "more");
        break;
    case KOKSMA_RANK_UNSETTLED:
        if (check->advice.state != KOKSMA_RANK_UNSETTLED) {
            fprintf(stderr, "; after %lld trials it is undecided which of all patterns leaves the least error",
                    check->trials);
        }
        break;
    case KOKSMA_RANK_UNCHECKED:
        fprintf(stderr, "; the time was up before it was decided which of all patterns leaves the least error");
        break;
    default:;
    }
}

static void advise_sizes(const koksma_rank_options *options, const koksma_rank_row *rows,
                         const koksma_ranking *ranking)
{
    for (int i = 0; i < KOKSMA_RANK_CHECKS; i++) {
        const koksma_rank_check *check = &ranking->checks[i];
        const koksma_rank_check_result *advice = &check->advice;
        fprintf(stderr, "  at %d x %d: ", check->width, check->height);
        switch (advice->state) {
        case KOKSMA_RANK_CONFIRMED:
            fprintf(stderr, "the same advice%s",
                    advice->coherent && ranking->n_coherent < ranking->n ? ", but in visible bands" : "");
            break;
        case KOKSMA_RANK_OVERTURNED:
            fprintf(stderr, "the order changes: %s is the best%s, and %s leaves ", name_of(options, advice->pattern),
                    advice->coherent ? " (in bands)" : "", name_of(options, rows[ranking->use_row].pattern));
            print_percent(advice->behind, advice->behind_low, advice->behind_high, "more");
            break;
        case KOKSMA_RANK_UNSETTLED:
            fprintf(stderr, "undecided after %lld trials", check->trials);
            break;
        case KOKSMA_RANK_FAILED:
            fprintf(stderr, "not checked: there was no picture of this size; --one-size leaves that out%s",
                    options->render ? ", {width} and {height} in the command choose the size" : "");
            break;
        default:
            fprintf(stderr, "not checked%s", ranking->cut_short ? ", the time was up" : "");
        }
        if (advice->state && advice->state != KOKSMA_RANK_FAILED && ranking->n_coherent &&
            ranking->n_coherent < ranking->n) {
            advise_first(options, rows, check);
        }
        fprintf(stderr, "\n");
    }
}

/* Prints a sentence on the ranked patterns that are not known to be unbiased, if there are any. */
static void warn_of_bias(const koksma_rank_options *options, const koksma_rank_row *rows, size_t n)
{
    size_t count = 0, done = 0;
    for (size_t i = 0; i < n; i++) {
        count += rows[i].biased && !options->adaptive;
    }
    for (size_t i = 0; i < n && count; i++) {
        if (rows[i].biased) {
            fprintf(stderr, "%s%s",
                    !done              ? "  not known to be unbiased: "
                    : done + 1 < count ? ", "
                                       : " and ",
                    name_of(options, rows[i].pattern));
            done++;
        }
    }
    if (count) {
        fprintf(stderr,
                "; part of %s error may be bias, the same in every trial, which no number of images averages "
                "away (modifiers such as shift=1 make patterns unbiased)\n",
                count > 1 ? "their" : "its");
    }
}

/* Prints in words whether an adaptive method leaves bands, and where its bias is from. */
static void say_of_method(const koksma_rank_options *options, const koksma_ranking *ranking)
{
    if (!options->adaptive || !ranking->n) {
        return;
    }
    fprintf(stderr, "  adaptive by %s: ", options->adaptive);
    if (ranking->n_coherent == 0) {
        fprintf(stderr, "no visible bands in the error");
    } else if (ranking->n == 1) {
        fprintf(stderr, "visible bands in the error");
    } else {
        fprintf(stderr, "visible bands in the errors of %zu of %zu patterns", ranking->n_coherent, ranking->n);
    }
    fprintf(stderr, "; samples that decide where more are taken may bias a pixel\n");
}

/* The number of patterns whose robust errors the warning prints, the best first. */
enum { MOST_ROBUST = 8 };

/* Prints a warning if few pixels carry most of the error of some patterns, and the errors without these pixels. */
static void warn_of_few_pixels(const koksma_rank_options *options, const koksma_rank_row *rows, size_t n)
{
    size_t count = 0, most = 0;
    for (size_t i = 0; i < n; i++) {
        count += rows[i].top_share >= KOKSMA_FEW_PIXELS;
        most = rows[i].top_share > rows[most].top_share ? i : most;
    }
    if (count) {
        fprintf(stderr,
                "  warning: 0.1 %% of the pixels carry most of the error of %zu of %zu patterns (%s: %.0f %%), and "
                "decide this order; a metric that weighs them less, such as smape, may give another order\n"
                "  without these pixels the errors are",
                count, n, name_of(options, rows[most].pattern), 100 * rows[most].top_share);
        for (size_t i = 0; i < n && i < MOST_ROBUST; i++) {
            char robust[CLI_NUMBER];
            fprintf(stderr, "%s %s %s", i ? "," : "", name_of(options, rows[i].pattern),
                    cli_number(rows[i].robust, robust));
        }
        if (n > MOST_ROBUST) {
            fprintf(stderr, " (--json has all)");
        }
        fprintf(stderr, "\n");
    }
}

/* Prints what the best pattern saves: how many random samples its samples are worth. */
static void say_worth(const koksma_rank_options *options, const koksma_rank_row *rows, const koksma_ranking *ranking)
{
    const size_t best = ranking->use_row;
    if (isfinite(ranking->random_spp) && strcmp(options->patterns[rows[best].pattern], "random") != 0) {
        fprintf(stderr, "  %d samples of %s are as good as %.0f random samples", options->spp,
                name_of(options, rows[best].pattern), ranking->random_spp);
        if (isfinite(ranking->random_spp_low) && isfinite(ranking->random_spp_high)) {
            fprintf(stderr, " (%.0f to %.0f)", ranking->random_spp_low, ranking->random_spp_high);
        }
        fputs("\n", stderr);
    }
}

bool cli_rank_decided(const koksma_ranking *ranking)
{
    return ranking->settled || ranking->within <= KOKSMA_RANK_TIE;
}

void cli_rank_advise(const koksma_rank_options *options, const koksma_rank_row *rows, const koksma_ranking *ranking)
{
    fprintf(stderr, "%s at %d samples a pixel, %d x %d pixels: ", base_of(options->scene), options->spp,
            ranking->width, ranking->height);
    const bool decided = cli_rank_decided(ranking);
    double most = 0;
    for (size_t i = 0; i < ranking->n; i++) {
        most = fmax(most, fabs(rows[i].mean));
    }
    if (ranking->n && most == 0) {
        fputs("every picture is the reference, and no pattern leaves an error; is the scene in view, and lit?\n",
              stderr);
        return;
    }
    if (decided) {
        advise_best(options, rows, ranking);
    } else {
        advise_undecided(options, rows, ranking);
    }
    fprintf(stderr, ".\n  %lld trial%s (", ranking->trials, ranking->trials == 1 ? "" : "s");
    char metric[KOKSMA_MAX_SPEC];
    koksma_metric_text(options->metric, metric);
    if (options->render) {
        fprintf(stderr, "by the command, error by %s", metric);
    } else {
        fprintf(stderr, "%s, %s filter, error by %s", options->integrator->name, options->filter->name, metric);
    }
    if (options->process) {
        char text[CLI_PROCESS_TEXT];
        fprintf(stderr, " after %s", cli_one_line(cli_process_text(options, text)));
    }
    fputs(") in ", stderr);
    print_seconds(ranking->seconds);
    if (isfinite(ranking->reference_error)) {
        fprintf(stderr, "; the reference's own error is %.1g", ranking->reference_error);
    }
    fprintf(stderr, "%s\n",
            ranking->complete    ? ""
            : ranking->cut_short ? "; the time was up before every pair was decided"
                                 : "; the trials were too few to decide every pair");
    warn_of_few_pixels(options, rows, ranking->n);
    warn_of_bias(options, rows, ranking->n);
    say_of_method(options, ranking);
    if (decided && ranking->n > 1 && !options->one_size && !options->reference_image &&
        (!options->render || options->width)) {
        advise_sizes(options, rows, ranking);
    }
    say_worth(options, rows, ranking);
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
                fprintf(stderr, "  %-10.3g %s\n", errors[i], name_of(options, i));
            } else if (isinf(next) && isnan(errors[i])) {
                fprintf(stderr, "  not known  %s\n", name_of(options, i));
            }
        }
        below = next;
    } while (isfinite(next));
}
