/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finds the name that a misspelt word probably means: the name that the fewest edits turn the word into. An edit
 * inserts, deletes or replaces a character or swaps two neighbours (Damerau 1964). No edit is made inside a swapped
 * pair (the "optimal string alignment" distance); the dynamic programme stores three rows of its table. A word that
 * is the beginning of a name counts as one edit away, so that `jitter` means jittered; one that begins with a name, or
 * is its last part, as at most two: `ranking` means rank, `trials` max-trials. A _ is a -. Among equally close names the
 * one with the longer common beginning wins, and among these the first in the table.
 */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "core/lookup.h"

enum { MAX_WORD = 64 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

static size_t common_beginning(const char *a, const char *b)
{
    size_t i = 0;
    while (a[i] && a[i] == b[i]) {
        i++;
    }
    return i;
}

static bool equal(char a, char b)
{
    return tolower((unsigned char)(a == '_' ? '-' : a)) == tolower((unsigned char)(b == '_' ? '-' : b));
}

static size_t edits(const char *a, size_t n, const char *b, size_t m)
{
    /* rows[i % 3][j]: distance between the first i characters of a and the first j of b */
    size_t rows[3][MAX_WORD + 1] = {{0}};
    for (size_t j = 0; j <= m; j++) {
        rows[0][j] = j;
    }
    for (size_t i = 1; i <= n; i++) {
        size_t *row = rows[i % 3];
        const size_t *last = rows[(i + 2) % 3], *before = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= m; j++) {
            row[j] = least(least(last[j], row[j - 1]) + 1, last[j - 1] + !equal(a[i - 1], b[j - 1]));
            if (i > 1 && j > 1 && equal(a[i - 1], b[j - 2]) && equal(a[i - 2], b[j - 1])) {
                row[j] = least(row[j], before[j - 2] + 1);
            }
        }
    }
    return rows[n % 3][m];
}

const char *koksma_closest_name(const char *word, koksma_name_at *name, const void *table)
{
    KOKSMA__REQUIRE_OR(NULL, word, name);
    const size_t length = strlen(word);
    if (length == 0 || length > MAX_WORD) {
        return NULL;
    }
    const char *closest = NULL, *candidate;
    size_t fewest = 1 + (length + 1) / 3; /* largest number of edits between a word and a name that resembles it */
    for (size_t i = 0; (candidate = name(table, i)) != NULL; i++) {
        const size_t beginning = common_beginning(word, candidate), size = strlen(candidate);
        if (size > MAX_WORD) {
            continue;
        }
        size_t distance = length >= 3 && beginning == length ? 1 : edits(word, length, candidate, size);
        distance = size >= 4 && beginning == size ? least(distance, 2) : distance;
        if (length >= 4 && size > length && candidate[size - length - 1] == '-' &&
            !edits(word, length, candidate + size - length, length)) {
            distance = least(distance, 2); /* trials: max-trials */
        }
        if (distance < fewest || (distance == fewest && closest && beginning > common_beginning(word, closest))) {
            fewest = distance;
            closest = candidate;
        }
    }
    return closest;
}

const char *koksma__meant(const char *word, koksma_name_at *name, const void *table, char text[KOKSMA__MEANT])
{
    const char *closest = koksma_closest_name(word, name, table);
    snprintf(text, KOKSMA__MEANT, closest ? "did you mean '%s'? " : "%.0s", closest ? closest : "");
    return text;
}

/* Names that others use for a member of a family, ours, and what differs or why. */
static const struct {
    const char *what, *name, *ours, *there;
} foreign[] = {
    {"measure", "CD", "l2-centered", "scipy's CD is its square"},
    {"measure", "centred", "l2-centered", "Hickernell 1998"},
    {"measure", "WD", "l2-wraparound", "scipy's WD is its square"},
    {"measure", "MD", "l2-mixture", "scipy's MD is its square"},
    {"measure", "L2-star", "l2-star", "scipy's L2-star is the same"},
    {"measure", "discrepancy", "star", "l2-centered has scipy's default CD as its square"},
    {"measure", "centered-l2", "l2-centered", "Hickernell 1998"},
    {"measure", "mindist", "min-distance", "the smallest distance between two points"},
    {"measure", "maximin", "min-distance", "the smallest distance between two points"},
    {"measure", "phi_p", "min-distance", "the limit of phi_p for large p"},
    {"measure", "l2", "l2-star", "l2-centered has scipy's default CD as its square"},
    {"measure", "t", "t-value", "of (t,m,s)-nets"},
    {"pattern", "independent", "random", "pbrt and Mitsuba call it so"},
    {"pattern", "mt19937", "random", "its numbers are hashes of seed and index"},
    {"pattern", "stratified", "jittered", "pbrt and Mitsuba call it so"},
    {"pattern", "grid", "regular", "'jittered' has a random point in each cell"},
    {"pattern", "multijitter", "correlated-multi-jittered", "Mitsuba calls it so"},
    {"pattern", "cmj", "correlated-multi-jittered", "Kensler 2013"},
    {"pattern", "ldsampler", "sobol:scramble=digital-shift",
     "Mitsuba's is a (0,2)-sequence, shifted digitally in each pixel"},
    {"pattern", "paddedsobol", "sobol:scramble=owen", "pbrt pads two-dimensional sets of it, as renders here do"},
    {"pattern", "tabulated-sobol", "sobol:scramble=owen", "Blender's table of Owen-scrambled Sobol' points"},
    {"pattern", "zsobol", "z-sampler", "pbrt calls it so"},
    {"pattern", "owen", "sobol:scramble=owen", "Owen's scrambling is a parameter of 'sobol'"},
    {"pattern", "owen-sobol", "sobol:scramble=owen", "Owen's scrambling is a parameter of 'sobol'"},
    {"pattern", "pmj", "pmj02", "its prefixes are multi-jittered, too"},
    {"pattern", "bluenoise", "sample-elimination", "or poisson-disk, void-and-cluster, gaussian-blue-noise"},
    {"pattern", "blue-noise", "sample-elimination", "or poisson-disk, void-and-cluster, gaussian-blue-noise"},
    {"pattern", "poisson", "poisson-disk", "'sample-elimination' makes n points with a distance near the largest"},
    {"pattern", "bridson", "poisson-disk", "'sample-elimination' makes n points with a distance near the largest"},
    {"pattern", "bnot", "gaussian-blue-noise", "its nearest relative here"},
    {"pattern", "stbn", "void-and-cluster-3d", "blue noise in space and time"},
    {"pattern", "monte-carlo", "random", "independent uniform points"},
    {"pattern", "montecarlo", "random", "independent uniform points"},
    {"pattern", "mitchell", "best-candidate", "Mitchell 1991"},
    {"pattern", "lhs", "latin-hypercube", "another name for n-rooks"},
    {"pattern", "latin", "latin-hypercube", "another name for n-rooks"},
    {"pattern", "rank1", "lattice-rank1", "or korobov, fibonacci, lattice-sequence"},
    {"pattern", "lattice", "lattice-rank1", "or korobov, fibonacci, lattice-sequence"},
    {"pattern", "ga", "golden", "the golden ratio; 'r-sequence' has more dimensions"},
    {"pattern", "r2", "r-sequence", "Roberts' R2 is its case of two dimensions"},
    {"pattern", "niederreiter", "net-file", "read its matrices from a file; 'faure' and 'sobol' are nets that ship"},
    {"pattern", "uniform", "random", "independent uniform points"},
    {"pattern", "blue", "sample-elimination", "or poisson-disk, void-and-cluster, gaussian-blue-noise"},
    {"pattern", "rng", "random", "independent uniform points"},
    {"pattern", "prng", "random", "independent uniform points"},
    {"pattern", "white-noise", "random", "independent uniform points"},
    {"pattern", "lds", "sobol:scramble=owen", "or halton, r-sequence, lattice-sequence"},
    {"pattern", "low-discrepancy", "sobol:scramble=owen", "or halton, r-sequence, lattice-sequence"},
    {"pattern", "lowdiscrepancy", "sobol:scramble=owen", "or halton, r-sequence, lattice-sequence"},
    {"pattern", "qmc", "sobol:scramble=owen", "or halton, r-sequence, lattice-sequence"},
    {"pattern", "orthogonal", "orthogonal-array", "Mitsuba calls it so"},
    {"pattern", "02sequence", "sobol:scramble=digital-shift", "its first two dimensions are a (0,2)-sequence"},
    {"pattern", "zerotwosequence", "sobol:scramble=digital-shift", "its first two dimensions are a (0,2)-sequence"},
    {"pattern", "maxmindist", "pmj02bn", "a (0,2)-sequence with large distances"},
    {"pattern", "mj", "multi-jittered", "Chiu, Shirley and Wang 1994"},
    {"pattern", "lloyd", "gaussian-blue-noise", "or sample-elimination: even distances without a lattice"},
    {"metric", "mse", "rmse", "its square is the mean squared error"},
    {"metric", "l2", "rmse", "the root of the mean square"},
    {"metric", "psnr", "rmse", "it falls where PSNR rises, by the same numbers"},
    {"metric", "l1", "mae", "the mean absolute error"},
    {"metric", "flip", "ldr-flip", "or hdr-flip, over exposures"},
    {"metric", "ssim", "ldr-flip", "there is no SSIM; FLIP, too, judges as eyes do"},
    {"metric", "blur", "rmse", "rmse:blur=1 blurs both images by a Gaussian of 1 pixel"},
    {"metric", "relative", "relmse", "it divides by the square of the reference"},
    {"metric", "mape", "smape", "the symmetric one; relmse divides by the square of the reference"},
};

koksma_status koksma__fail_unknown(const char *what, const char *word, koksma_name_at *name, const void *table,
                                   const char *where)
{
    char meant[KOKSMA__MEANT];
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) {
        const char *name_there = foreign[i].name;
        KOKSMA__FAIL_IF(!strcmp(what, foreign[i].what) && !edits(word, strlen(word), name_there, strlen(name_there)),
                        KOKSMA_UNKNOWN, "no %s '%s'; did you mean '%s'? %s", what, word, foreign[i].ours,
                        foreign[i].there);
    }
    static const char *const endings[] = {"sequence", "sampler"}; /* HaltonSequence, SobolSampler of libraries */
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        const size_t length = strlen(word), ending = strlen(endings[i]), rest = length - ending;
        const char *member;
        for (size_t k = 0; length > ending && (member = name(table, k)); k++) {
            KOKSMA__FAIL_IF(strlen(member) == rest && !edits(word, rest, member, rest) &&
                                !edits(word + rest, ending, endings[i], ending),
                            KOKSMA_UNKNOWN, "no %s '%s'; did you mean '%s'? %s", what, word, member, where);
        }
    }
    return koksma__fail(KOKSMA_UNKNOWN, "no %s '%s'; %s%s", what, word, koksma__meant(word, name, table, meant),
                        strchr(word, ',') && !strchr(word, '=') ? "one name is taken here, no list" : where);
}
