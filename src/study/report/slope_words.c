/* SPDX-License-Identifier: Apache-2.0 */
#include "study/report/slope_words.h"

#include <math.h>

#include <koksma/koksma.h>

enum { NAMED = 4, NAMED_ZEROS = 12 };

/* The patterns that have a slope. */
typedef struct standing {
    size_t counted, best, tied, faster, off_line; /* tied: the best and those that are not told apart from it */
    size_t random;                                /* n: none */
} standing;

static double half(const koksma__estimate *e)
{
    return e->high - e->value;
}

/* Not told apart: the interval of the difference of two slopes, as independent as their trials, has 0; or they are
   equal; or one has no interval. */
static bool are_tied(const koksma__estimate *a, const koksma__estimate *b)
{
    return !koksma__compare(a->value, b->value) || !(fabs(a->value - b->value) > hypot(half(a), half(b)));
}

/* Independent points without strata. */
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
    const koksma__estimate half_power = {-0.5, -0.5, -0.5};
    const koksma__estimate *random = s.random < of->n ? &of->trends[s.random].slope : &half_power;
    for (size_t i = 0; i < of->n; i++) {
        const koksma__estimate *e = &of->trends[i].slope;
        s.tied += !isnan(e->value) && are_tied(e, &of->trends[s.best].slope);
        s.faster += e->value < random->value && !are_tied(e, random);
    }
    return s;
}

static void add_power(koksma__html *h, const koksma__estimate *e)
{
    koksma__html_add(h, "N<sup>%.3f</sup>", e->value);
    if (!isnan(e->low) && e->low < e->high) {
        koksma__html_add(h, " (%.3f to %.3f)", e->low, e->high);
    }
}

/* The best and the others of its rank in their order, no more than NAMED by name. */
static void add_tied(koksma__html *h, const koksma__slopes *of, const standing *s)
{
    koksma__html_text(h, of->patterns[s->best]);
    koksma__html_add(h, " falls as ");
    add_power(h, &of->trends[s->best].slope);
    koksma__html_add(h, "; not told apart from it: ");
    size_t named = 0;
    for (size_t i = 0; i < of->n && named < NAMED; i++) {
        const koksma__estimate *e = &of->trends[i].slope;
        if (i != s->best && !isnan(e->value) && are_tied(e, &of->trends[s->best].slope)) {
            koksma__html_add(h, named++ ? ", " : "");
            koksma__html_text(h, of->patterns[i]);
            koksma__html_add(h, " as ");
            add_power(h, e);
        }
    }
    if (s->tied - 1 > named) {
        koksma__html_add(h, ", and %zu more", s->tied - 1 - named);
    }
}

static void add_fastest(koksma__html *h, const koksma__slopes *of, const standing *s)
{
    if (s->tied > 1) {
        add_tied(h, of, s);
    } else {
        koksma__html_text(h, of->patterns[s->best]);
        koksma__html_add(h, s->counted > 1 ? " falls fastest, as " : " falls as ");
        add_power(h, &of->trends[s->best].slope);
    }
    if (s->random == of->n) {
        koksma__html_add(h, "; %zu of %zu patterns surely fall faster than N<sup>&#8722;1/2</sup>", s->faster,
                         s->counted);
    } else if (s->counted > 1) {
        koksma__html_add(h, "; %zu of %zu other patterns surely fall faster than ", s->faster, s->counted - 1);
        koksma__html_text(h, of->patterns[s->random]);
        koksma__html_add(h, ", which falls as ");
        add_power(h, &of->trends[s->random].slope);
    }
}

/* Those with a mean of 0, no more than NAMED_ZEROS by name. */
static void add_zeros(koksma__html *h, const koksma__slopes *of)
{
    size_t with = 0;
    for (size_t i = 0; i < of->n; i++) {
        if (of->zeros[i] && with++ < NAMED_ZEROS) {
            koksma__html_add(h, with == 1 ? "; a mean of 0 has no logarithm, and is left out: of " : ", of ");
            koksma__html_text(h, of->patterns[i]);
            koksma__html_add(h, of->zeros[i] == of->sizes ? " all %zu" : " %zu", of->zeros[i]);
        }
    }
    if (with > NAMED_ZEROS) {
        koksma__html_add(h, ", and of %zu more patterns", with - NAMED_ZEROS);
    }
}

void koksma__slopes_sentence(koksma__html *h, const koksma__slopes *of)
{
    const standing s = stand(of);
    bool zeros = false;
    for (size_t i = 0; i < of->n; i++) {
        zeros |= of->zeros[i] > 0;
    }
    if (!s.counted && !zeros) {
        return;
    }
    koksma__html_add(h, "<p><strong>");
    koksma__html_text(h, of->name);
    koksma__html_add(h, ":</strong> ");
    if (of->sense != KOKSMA__FALLS) {
        koksma__html_add(h, of->sense == KOKSMA__LARGER ? "larger is better, and no slope is the best"
                                                        : "no power of N, and no slope is the best");
    } else if (s.counted) {
        add_fastest(h, of, &s);
    } else {
        koksma__html_add(h, "no pattern has a slope");
    }
    if (s.off_line) {
        koksma__html_add(h, "; in %zu of %zu the means lie on no line, and the slope is an average one", s.off_line,
                         s.counted);
    }
    add_zeros(h, of);
    koksma__html_add(h, ".</p>\n");
}
