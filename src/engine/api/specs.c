/* SPDX-License-Identifier: Apache-2.0 */
/* koksma_pattern_spec and koksma_measure_spec: parse a text into a pattern or measure with its parameters. Every
   pattern also accepts the modifiers; an alias is replaced by the pattern that it stands for. */
#include <stdio.h>
#include <string.h>

#include "core/lookup.h"
#include "core/spec.h"
#include "core/status.h"

KOKSMA__NAME_AT(koksma_pattern)
KOKSMA__NAME_AT(koksma_measure)

/* Names that others use, and what differs there. */
typedef struct foreign {
    const char *name, *ours, *there;
} foreign;

static const foreign foreign_measures[] = {
    {"CD", "l2-centered", "scipy's CD is its square"},
    {"WD", "l2-wraparound", "scipy's WD is its square"},
    {"MD", "l2-mixture", "scipy's MD is its square"},
    {"L2-star", "l2-star", "scipy's L2-star is the same"},
    {"discrepancy", "star", "l2-centered has scipy's default CD as its square"},
    {NULL, NULL, NULL},
};

static const foreign foreign_patterns[] = {
    {"independent", "random", "pbrt and Mitsuba call it so"},
    {"mt19937", "random", "its numbers are hashes of seed and index"},
    {"stratified", "jittered", "pbrt and Mitsuba call it so"},
    {"grid", "regular", "'jittered' has a random point in each cell"},
    {"multijitter", "correlated-multi-jittered", "Mitsuba calls it so"},
    {"cmj", "correlated-multi-jittered", "Kensler 2013"},
    {"ldsampler", "sobol:scramble=digital-shift", "Mitsuba's is a (0,2)-sequence, shifted digitally in each pixel"},
    {"paddedsobol", "sobol:scramble=owen", "pbrt pads two-dimensional sets of it, as renders here do"},
    {"zsobol", "z-sampler", "pbrt calls it so"},
    {"owen", "sobol:scramble=owen", "Owen's scrambling is a parameter of 'sobol'"},
    {"owen-sobol", "sobol:scramble=owen", "Owen's scrambling is a parameter of 'sobol'"},
    {"pmj", "pmj02", "its prefixes are multi-jittered, too"},
    {"bluenoise", "sample-elimination", "or poisson-disk, void-and-cluster, gaussian-blue-noise"},
    {"blue-noise", "sample-elimination", "or poisson-disk, void-and-cluster, gaussian-blue-noise"},
    {"poisson", "poisson-disk", "'sample-elimination' makes n points with a distance near the largest"},
    {"mitchell", "best-candidate", "Mitchell 1991"},
    {"lhs", "latin-hypercube", "another name for n-rooks"},
    {"latin", "latin-hypercube", "another name for n-rooks"},
    {"rank1", "lattice-rank1", "or korobov, fibonacci, lattice-sequence"},
    {"lattice", "lattice-rank1", "or korobov, fibonacci, lattice-sequence"},
    {"ga", "golden", "the golden ratio; 'r-sequence' has more dimensions"},
    {"r2", "r-sequence", "Roberts' R2 is its case of two dimensions"},
    {"niederreiter", "net-file", "read its matrices from a file; 'faure' and 'sobol' are nets that ship"},
    {"uniform", "random", "independent uniform points"},
    {NULL, NULL, NULL},
};

static koksma_status fail_unknown(const char *what, const char *name, const foreign *table, koksma_name_at *at,
                                  const char *where)
{
    for (; table->name; table++) {
        KOKSMA__FAIL_IF(!strcmp(name, table->name), KOKSMA_UNKNOWN, "no %s '%s'; did you mean '%s'? %s", what, name,
                        table->ours, table->there);
    }
    return koksma__fail_unknown(what, name, at, NULL, where);
}

koksma_status koksma_pattern_spec(const char *text, koksma_spec *spec)
{
    KOKSMA__REQUIRE(text, spec);
    char name[64];
    const char *rest = "";
    *spec = (koksma_spec){0};
    KOKSMA__TRY(koksma__spec_split(text, name, &rest));
    const koksma_pattern *pattern = koksma_pattern_find(name);
    if (!pattern) {
        char hint[sizeof name + 64] = "'koksma list patterns' names them";
        if (strpbrk(name, "./{")) { /* no pattern's name contains these characters */
            snprintf(hint, sizeof hint, "points in a file are a pattern, as in file:%s", name);
        }
        return fail_unknown("pattern", name, foreign_patterns, koksma_pattern_name_at, hint);
    }
    spec->pattern = pattern = pattern->alias_of ? koksma_pattern_find(pattern->alias_of) : pattern;
    koksma__all_params all;
    double values[KOKSMA_MAX_PARAMS + KOKSMA_MAX_MODIFIERS] = {0};
    koksma__all_params_init(&all, pattern->params);
    if (pattern->operand) {
        const char *end = koksma__modifiers_of_path(rest);
        const size_t length = (size_t)(end - rest);
        KOKSMA__FAIL_IF(length == 0 || length >= KOKSMA_MAX_SPEC - 80, KOKSMA_ARGUMENT,
                        "%s: the text after the colon must have 1 to %d characters, as in %s:%s", name,
                        KOKSMA_MAX_SPEC - 81, name, pattern->operand);
        memcpy(spec->path, rest, length);
        rest = end + (*end == ',');
    }
    KOKSMA__TRY(koksma__params_parse(name, all.params, rest, values));
    memcpy(spec->params, values, all.own * sizeof *values);
    memcpy(spec->modifiers, values + all.own, sizeof spec->modifiers);
    return KOKSMA_OK;
}

koksma_status koksma_measure_spec(const char *text, koksma_spec *spec)
{
    KOKSMA__REQUIRE(text, spec);
    char name[64];
    const char *rest = "";
    *spec = (koksma_spec){0};
    KOKSMA__TRY(koksma__spec_split(text, name, &rest));
    spec->measure = koksma_measure_find(name);
    if (!spec->measure) {
        return fail_unknown("measure", name, foreign_measures, koksma_measure_name_at,
                            "'koksma list measures' names them");
    }
    return koksma__params_parse(name, spec->measure->params, rest, spec->params);
}
