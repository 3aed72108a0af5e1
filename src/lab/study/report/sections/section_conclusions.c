/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a paper concludes, and whether the rows of the study bear it out: one paragraph for each conclusion of the plan,
 * with which the page begins. A conclusion holds if it passes all its tests, in part if it passes some, and not if it
 * passes none; it is undecided while rows are missing.
 */
#include <string.h>

#include "study/report/conclusions/conclusion.h"
#include "study/report/report.h"

typedef koksma_status (*conclude)(koksma_study *study, koksma__document *words, const koksma__conclusion *c,
                                  koksma__tested *tested);

/* The functions that test conclusions, in the order of koksma__conclusion_kinds. */
static const conclude functions[] = {
#define CONCLUSION(name, fields) koksma__conclude_##name,
#include "study/plan/conclusions.def"
#undef CONCLUSION
};

static bool is_here(const koksma__report_scope *scope, size_t i)
{
    return scope->study->plan.conclusions[i].part == scope->plan;
}

static bool is_shown(const koksma__report_scope *scope)
{
    bool found = false;
    for (size_t i = 0; i < scope->study->plan.n_conclusions; i++) {
        found |= is_here(scope, i);
    }
    return found;
}

static koksma__answer_kind answer_of(const koksma__tested *t)
{
    return t->open || !t->tests    ? KOKSMA__ANSWER_UNDECIDED
           : t->passed == t->tests ? KOKSMA__ANSWER_HOLDS
           : t->passed             ? KOKSMA__ANSWER_PARTLY
                                   : KOKSMA__ANSWER_FAILS;
}

static koksma_status add(koksma_study *study, koksma__document *d, const koksma__conclusion *c)
{
    static const char *const verdicts[] = {[KOKSMA__ANSWER_UNDECIDED] = "Not decided: rows are missing",
                                           [KOKSMA__ANSWER_HOLDS] = "Holds",
                                           [KOKSMA__ANSWER_PARTLY] = "Holds in part",
                                           [KOKSMA__ANSWER_FAILS] = "Does not hold"};
    koksma__tested tested = {0};
    koksma__document words = {0};
    koksma__doc_words_begin(&words);
    const koksma_status status = functions[c->kind - koksma__conclusion_kinds](study, &words, c, &tested);
    const koksma__answer_kind answer = answer_of(&tested);
    koksma__doc_verdict_begin(d, answer);
    koksma__doc_say(d, "*%s* _%s._ ", c->says, verdicts[answer]);
    koksma__doc_words_append(d, &words);
    if (c->remark) {
        koksma__doc_say(d, " %s", c->remark);
    }
    koksma__doc_paragraph_end(d);
    return status;
}

static koksma_status write(const koksma__report_scope *scope, koksma__document *d)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < scope->study->plan.n_conclusions; i++) {
        if (is_here(scope, i)) {
            status = add(scope->study, d, &scope->study->plan.conclusions[i]);
        }
    }
    return status;
}

const koksma__section koksma__section_conclusions = {"What the paper concludes, and whether it holds", true, is_shown,
                                                     write};
