/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Writes the sentence on the slopes of one measure or scene. It names the pattern whose values fall fastest. A pattern
 * surely falls faster than another if the interval of the difference of their slopes excludes 0. A pattern is a
 * candidate if no other surely falls faster. If there are several candidates, the sentence names those whose slopes
 * have the narrowest intervals, and how many trials would separate two of them, so that a pattern with a wide interval
 * hides no order among patterns with narrow ones. The sentence also gives the number of patterns that fall faster than
 * random points (or the power of theory), the number that follow no power law, and the patterns with means of 0. For
 * measures of quality or distance, for which a fast fall is not better, it does not compare the patterns.
 */
#include "study/report/slope_words.h"

#include <math.h>

#include <koksma/koksma.h>

#include "study/run/tasks.h"

enum { NAMED = 4, NAMED_ZEROS = 12, MOST_TRIALS = 1000 };

/* The result for all patterns that have a slope; `counted`, `tied`, `faster` and `off_line` are numbers of
   patterns. */
typedef struct standing {
    size_t counted, best, tied, faster, off_line; /* tied: the patterns that may fall fastest */
    size_t random;                                /* index of a pattern of random points, or n if there is none */
} standing;

static double half(const koksma__estimate *e)
{
    return e->high - e->value;
}

/* Whether two slopes are tied: the interval of the difference of the slopes, taken as independent, contains 0, or
   the slopes are equal, or one of them has no interval. */
static bool are_tied(const koksma__estimate *a, const koksma__estimate *b)
{
    return !koksma__compare(a->value, b->value) || !(fabs(a->value - b->value) > hypot(half(a), half(b)));
}

/* Whether pattern i may be the one that falls fastest: it has a slope, and none surely falls faster. */
static bool may_be_fastest(const koksma__slopes *of, size_t i)
{
    const koksma__estimate *e = &of->trends[i].slope;
    bool may = !isnan(e->value);
    for (size_t j = 0; may && j < of->n; j++) {
        const koksma__estimate *other = &of->trends[j].slope;
        may = isnan(other->value) || other->value >= e->value || are_tied(e, other);
    }
    return may;
}

/* Whether a pattern consists of independent points without strata. */
static bool is_random(const char *pattern)
{
    koksma_spec spec;
    const unsigned both = KOKSMA_CLAIM_INDEPENDENT | KOKSMA_CLAIM_STRATIFIED;
    return !koksma_pattern_spec(pattern, &spec) && (spec.pattern->claims & both) == KOKSMA_CLAIM_INDEPENDENT;
}

static standing stand(const koksma__slopes *of)
{
    standing s = {.random = of->n};
    for (size_t i = 0; i < of->n; i++) {
        const koksma__estimate *e = &of->trends[i].slope, *best = &of->trends[s.best].slope;
        if (!isnan(e->value)) {
            s.best = isnan(best->value) || e->value < best->value ? i : s.best;
            s.random = s.random == of->n && is_random(of->patterns[i]) ? i : s.random;
            s.counted++;
            s.off_line += of->trends[i].off_line;
        }
    }
    const koksma__estimate power = {of->random_slope, of->random_slope, of->random_slope};
    const koksma__estimate *random = s.random < of->n ? &of->trends[s.random].slope : &power;
    for (size_t i = 0; i < of->n; i++) {
        const koksma__estimate *e = &of->trends[i].slope;
        s.tied += may_be_fastest(of, i);
        s.faster += e->value < random->value && !are_tied(e, random);
    }
    return s;
}

static void say_power(koksma__document *d, const koksma__estimate *e)
{
    koksma__doc_say(d, "N^%.3f^", e->value);
    if (!isnan(e->low) && e->low < e->high) {
        koksma__doc_say(d, " (%.3f to %.3f)", e->low, e->high);
    }
}

/* Whether pattern i is named before pattern j: those with narrower intervals first, those without an interval
   last. */
static bool is_known_better(const koksma__slopes *of, size_t i, size_t j)
{
    const double x = half(&of->trends[i].slope), y = half(&of->trends[j].slope);
    return x < y || (isnan(y) && !isnan(x)) || (!(y < x) && isnan(x) == isnan(y) && i < j);
}

/* The next pattern to name after pattern `after`, among the patterns that may fall fastest; with after = n, the
   first one. Returns n if there is none. */
static size_t next_tied(const koksma__slopes *of, size_t after)
{
    size_t next = of->n;
    for (size_t i = 0; i < of->n; i++) {
        if (may_be_fastest(of, i) && (after == of->n || is_known_better(of, after, i)) &&
            (next == of->n || is_known_better(of, i, next))) {
            next = i;
        }
    }
    return next;
}

/* Writes what would separate two slopes: more trials, or more sizes if a pattern is deterministic and so has a
   single set of each size. */
static void say_trials(koksma__document *d, const koksma__slopes *of, size_t a, size_t b)
{
    const koksma__estimate *x = &of->trends[a].slope, *y = &of->trends[b].slope;
    const double factor = koksma__trials_factor(x->value - y->value, hypot(half(x), half(y)));
    if (!koksma__compare(x->value, y->value)) {
        koksma__doc_say(d, "; the slopes of %s and %s are equal", of->patterns[a], of->patterns[b]);
    } else if (koksma__has_one_set(of->patterns[a]) || koksma__has_one_set(of->patterns[b])) {
        koksma__doc_say(d, "; more sizes might tell %s from %s, more trials would not", of->patterns[a],
                        of->patterns[b]);
    } else if (factor > MOST_TRIALS) {
        koksma__doc_say(d, "; more than %d times as many trials would be needed to tell %s from %s", MOST_TRIALS,
                        of->patterns[a], of->patterns[b]);
    } else if (isfinite(factor)) {
        koksma__doc_say(d, "; about %.0f times as many trials would tell %s from %s", ceil(factor), of->patterns[a],
                        of->patterns[b]);
    }
}

/* Writes the patterns that may fall fastest, narrow intervals first; names at most NAMED of them. */
static void say_tied(koksma__document *d, const koksma__slopes *of, const standing *s)
{
    size_t named = 0, at = of->n, first = of->n, second = of->n;
    koksma__doc_say(d, "undecided between %zu of %zu patterns: ", s->tied, s->counted);
    while (named < NAMED && named < s->tied && (at = next_tied(of, at)) < of->n) {
        koksma__doc_say(d, "%s%s%s as ", named ? ", " : "", of->patterns[at], named ? "" : " falls");
        say_power(d, &of->trends[at].slope);
        first = named == 0 ? at : first;
        second = named == 1 ? at : second;
        named++;
    }
    if (s->tied > named) {
        koksma__doc_say(d, ", and %zu more", s->tied - named);
    }
    say_trials(d, of, first, first == s->best ? second : s->best);
}

static void say_fastest(koksma__document *d, const koksma__slopes *of, const standing *s)
{
    if (s->tied > 1) {
        say_tied(d, of, s);
    } else {
        koksma__doc_say(d, "%s falls %sas ", of->patterns[s->best], s->counted > 1 ? "fastest, " : "");
        say_power(d, &of->trends[s->best].slope);
    }
    if (s->random == of->n && !isnan(of->random_slope)) {
        koksma__doc_say(d, "; %zu of %zu patterns surely fall faster than N^%.1f^", s->faster, s->counted,
                        of->random_slope);
    } else if (s->random < of->n && s->counted > 1) {
        koksma__doc_say(d, "; %zu of %zu other patterns surely fall faster than %s, which falls as ", s->faster,
                        s->counted - 1, of->patterns[s->random]);
        say_power(d, &of->trends[s->random].slope);
    }
}

/* Writes the patterns that have means of 0; names at most NAMED_ZEROS of them. */
static void say_zeros(koksma__document *d, const koksma__slopes *of)
{
    size_t with = 0;
    for (size_t i = 0; i < of->n; i++) {
        if (of->zeros[i] && with++ < NAMED_ZEROS) {
            koksma__doc_say(d, with == 1 ? "; means of 0 have no logarithm and are left out: " : ", ");
            if (of->zeros[i] == of->sizes) {
                koksma__doc_say(d, "all %zu of %s", of->zeros[i], of->patterns[i]);
            } else {
                koksma__doc_say(d, "%zu of %s", of->zeros[i], of->patterns[i]);
            }
        }
    }
    if (with > NAMED_ZEROS) {
        koksma__doc_say(d, ", and those of %zu more patterns", with - NAMED_ZEROS);
    }
}

void koksma__slopes_sentence(koksma__document *d, const koksma__slopes *of)
{
    const standing s = stand(of);
    bool zeros = false;
    for (size_t i = 0; i < of->n; i++) {
        zeros |= of->zeros[i] > 0;
    }
    if (!s.counted && !zeros) {
        return;
    }
    if (of->sense == KOKSMA__FALLS) {
        koksma__doc_answer_begin(d, s.tied == 1);
    } else {
        koksma__doc_paragraph_begin(d);
    }
    koksma__doc_say(d, "*%s:* ", of->name);
    if (of->sense != KOKSMA__FALLS) {
        koksma__doc_say(d, of->sense == KOKSMA__LARGER
                               ? "larger values are better, so patterns are not compared by how fast values fall"
                               : "values follow no power law in N, so patterns are not compared by their slopes");
    } else if (s.counted) {
        say_fastest(d, of, &s);
    } else {
        koksma__doc_say(d, "no pattern has a slope");
    }
    if (s.off_line) {
        koksma__doc_say(d, "; %zu of %zu patterns %s", s.off_line, s.counted,
                        s.off_line == 1 ? "does not follow a power law; its slope is an average"
                                        : "do not follow a power law; their slope is an average");
    }
    say_zeros(d, of);
    koksma__doc_say(d, ".");
    koksma__doc_paragraph_end(d);
}
