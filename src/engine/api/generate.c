/* SPDX-License-Identifier: Apache-2.0 */
/* koksma_generate, koksma_generate_range and koksma_generate_whole: check the arguments on behalf of all
   patterns, call the pattern's own function, and apply the modifiers that every pattern accepts. */
#include <koksma/koksma.h>

#include <string.h>

#include "api/api.h"
#include "core/parallel.h"
#include "core/point_files.h"
#include "core/points.h"
#include "core/spec.h"
#include "core/status.h"
#include "patterns/files/files.h"
#include "patterns/patterns.h"

/* Checks the parts of a spec that do not depend on the dimension: the path and the modifiers. */
static koksma_status check_spec(const koksma_spec *spec, const koksma_pattern *p)
{
    return memchr(spec->path, '\0', sizeof spec->path)
               ? koksma__modifiers_check(p->name, spec->modifiers)
               : koksma__fail(KOKSMA_ARGUMENT, "the path in the spec is longer than %d characters",
                              KOKSMA_MAX_SPEC - 1);
}

/* Checks a pattern's spec for points of `dim` dimensions. */
static koksma_status check_for_dim(const koksma_spec *spec, const koksma_pattern *p, int dim)
{
    koksma_status status = koksma__dim_check(p->name, dim, p->min_dim, p->max_dim);
    status = status ? status : check_spec(spec, p);
    return status ? status : koksma__params_check(p->name, p->params, spec->params);
}

static const koksma_pattern *pattern_of(const koksma_spec *spec)
{
    return spec->pattern && spec->pattern->alias_of ? koksma_pattern_find(spec->pattern->alias_of) : spec->pattern;
}

/* Whether the pattern has a parameter of this name, and the spec a value other than 0 for it. */
static bool is_set(const koksma_spec *spec, const koksma_pattern *p, const char *name)
{
    bool set = false;
    for (int k = 0; p->params && p->params[k].name; k++) {
        set = set || (!strcmp(p->params[k].name, name) && spec->params[k] != 0);
    }
    return set;
}

bool koksma_has_one_set(const koksma_spec *spec)
{
    KOKSMA__REQUIRE_OR(false, spec);
    const koksma_pattern *p = pattern_of(spec);
    if (!p) {
        return false;
    }
    return !koksma__modifiers_are_random(spec->modifiers) && p->claims & KOKSMA_CLAIM_DETERMINISTIC &&
           !(koksma__reads_points(p) && koksma__file_has(spec->path, "{seed}")) && !is_set(spec, p, "scramble") &&
           !is_set(spec, p, "shuffle");
}

bool koksma_is_unbiased(const koksma_spec *spec)
{
    KOKSMA__REQUIRE_OR(false, spec);
    const koksma_pattern *p = pattern_of(spec);
    koksma_pattern claiming = p ? *p : (koksma_pattern){.claims = 0};
    koksma_spec modified = *spec;
    modified.pattern = &claiming;
    /* Darts thrown on the torus (poisson-disk) are the same wherever it is cut: each is uniform. */
    claiming.claims |= p && (is_set(spec, p, "scramble") || is_set(spec, p, "torus")) ? KOKSMA_CLAIM_UNBIASED : 0;
    return p && koksma__claims_left(&modified, 1) & KOKSMA_CLAIM_UNBIASED;
}

bool koksma_is_sequence(const koksma_spec *spec)
{
    KOKSMA__REQUIRE_OR(false, spec);
    const koksma_pattern *p = pattern_of(spec);
    return p && p->claims & KOKSMA_CLAIM_SEQUENCE &&
           !(koksma__reads_points(p) && koksma__file_has(spec->path, "{n}"));
}

/* Fails if the pattern runs external code without permission. A call whose keep_going returns false at once, because
   the caller only wants to check the arguments, needs no permission: it fails with INTERRUPTED. */
static koksma_status check_permission(const koksma_spec *spec, const koksma_pattern *p, const koksma_run *run)
{
    if (!koksma__keep_going(run, 0)) {
        return koksma__fail_interrupted();
    }
    KOKSMA__FAIL_IF(koksma__exec_seconds() <= 0, KOKSMA_FORBIDDEN,
                    "%s:%s: the pattern runs external code; --allow-exec allows that (koksma_allow_exec in C, "
                    "koksma.allow_exec in Python)",
                    p->name, spec->path);
    return KOKSMA_OK;
}

/* Generates points first .. first + out->n - 1 of a set of n points, or of a sequence, whose points do not depend
   on n. */
static koksma_status generate(const koksma_spec *spec, const koksma_pattern *p, uint64_t seed, uint64_t n,
                              uint64_t first, const koksma_run *run, koksma_points *out)
{
    koksma_args args = koksma__spec_arguments(spec, run);
    args.n = n;
    args.first = first;
    KOKSMA__TRY(check_for_dim(spec, p, out->dim));
    KOKSMA__TRY(koksma__points_fit(out->n, out->dim));
    KOKSMA__TRY(p->runs_code ? check_permission(spec, p, run) : KOKSMA_OK);
    const char kept = koksma__call_begin();
    /* sets are kept for all seeds */
    const bool of_file = koksma__names_path(p) && p->claims & KOKSMA_CLAIM_DETERMINISTIC;
    KOKSMA__TRY(koksma__call_end(kept,
                                 of_file ? koksma__file_points(p, seed, &args, out) : p->generate(seed, &args, out),
                                 "koksma_pattern.generate"));
    koksma__modify(spec->modifiers, seed, out);
    return KOKSMA_OK;
}

/* Fails unless the spec is of a pattern, which may be the caller's own, with a name and a function. */
static koksma_status check_pattern(const char *caller, const koksma_spec *spec, const koksma_pattern *p)
{
    KOKSMA__FAIL_IF(!p, KOKSMA_ARGUMENT, "%s: it takes the spec of a pattern and initialised points", caller);
    KOKSMA__FAIL_IF(spec->measure, KOKSMA_ARGUMENT,
                    "%s: the spec has a pattern and a measure; exactly one of them is not NULL", caller);
    KOKSMA__FAIL_IF(!p->name || !p->generate, KOKSMA_ARGUMENT,
                    "%s: the pattern has no %s: koksma_pattern_find has patterns", caller,
                    p->name ? "generate" : "name");
    return KOKSMA_OK;
}

static const koksma_pattern *pattern_for(const char *caller, const koksma_spec *spec, const koksma_points *out)
{
    const koksma_pattern *p = pattern_of(spec);
    if (check_pattern(caller, spec, p)) {
        return NULL;
    }
    if (!out->xs || out->n == 0) {
        koksma__fail(KOKSMA_ARGUMENT, "%s: it takes the spec of a pattern and initialised points", caller);
        return NULL;
    }
    return p;
}

koksma_status koksma_generate(const koksma_spec *spec, uint64_t seed, const koksma_run *run, koksma_points *out)
{
    KOKSMA__REQUIRE(spec, out);
    KOKSMA__REQUIRE_RUN(run);
    const koksma_pattern *p = pattern_for(__func__, spec, out);
    return p ? generate(spec, p, seed, out->n, 0, run, out) : KOKSMA_ARGUMENT;
}

bool koksma_has_ranges(const koksma_spec *spec)
{
    KOKSMA__REQUIRE_OR(false, spec);
    const koksma_pattern *p = pattern_of(spec);
    return p && p->ranges && p->ranges(spec->params);
}

koksma_status koksma_generate_range(const koksma_spec *spec, uint64_t seed, uint64_t n, uint64_t first,
                                    const koksma_run *run, koksma_points *out)
{
    KOKSMA__REQUIRE(spec, out);
    KOKSMA__REQUIRE_RUN(run);
    const koksma_pattern *p = pattern_for(__func__, spec, out);
    if (!p) {
        return KOKSMA_ARGUMENT;
    }
    if (!koksma_has_ranges(spec)) {
        char text[KOKSMA_MAX_SPEC];
        koksma_spec_text(spec, text);
        KOKSMA__FAIL_IF(koksma_is_sequence(spec), KOKSMA_UNSUPPORTED,
                        "%s: first = %llu: the sequence has no ranges, because it generates all points together; "
                        "generate %llu points and drop the first %llu",
                        text, (unsigned long long)first, (unsigned long long)first + out->n,
                        (unsigned long long)first);
        return koksma__fail(KOKSMA_UNSUPPORTED,
                            "%s: the pattern has no ranges, because it generates all points together", text);
    }
    const uint64_t most = KOKSMA_MAX_INDEX < SIZE_MAX ? KOKSMA_MAX_INDEX + 1 : SIZE_MAX;
    const uint64_t end = p->claims & KOKSMA_CLAIM_SEQUENCE ? KOKSMA_MAX_INDEX + 1 : n;
    KOKSMA__FAIL_IF(end > KOKSMA_MAX_INDEX + 1 || (!(p->claims & KOKSMA_CLAIM_SEQUENCE) && n > most), KOKSMA_N,
                    "%s: n = %llu: the maximum is %llu points", p->name, (unsigned long long)n,
                    (unsigned long long)most);
    KOKSMA__FAIL_IF(first > end || out->n > end - first, KOKSMA_N,
                    "%s: first = %llu with %zu points ends beyond the last %s, which has number %llu", p->name,
                    (unsigned long long)first, out->n,
                    p->claims & KOKSMA_CLAIM_SEQUENCE ? "point of all sequences" : "point",
                    (unsigned long long)end - 1);
    return generate(spec, p, seed, n, first, run, out);
}

koksma_status koksma_generate_whole(const koksma_spec *spec, uint64_t seed, const koksma_run *run, int dim,
                                    koksma_points *out)
{
    KOKSMA__REQUIRE(spec, out);
    KOKSMA__REQUIRE_RUN(run);
    const koksma_pattern *p = pattern_of(spec);
    *out = (koksma_points){0};
    KOKSMA__TRY(check_pattern(__func__, spec, p));
    if (!p->whole) {
        return koksma__fail(KOKSMA_N, "%s: the number of points is missing", p->name);
    }
    koksma_status status = dim || !p->operand ? check_for_dim(spec, p, dim) : check_spec(spec, p);
    const koksma_args args = koksma__spec_arguments(spec, run);
    if (!status) {
        out->dim = dim;
        const char kept = koksma__call_begin();
        status = koksma__call_end(kept, p->whole(seed, &args, out), "koksma_pattern.whole");
    }
    if (status) {
        *out = (koksma_points){0};
    }
    if (!status) {
        koksma__modify(spec->modifiers, seed, out);
    }
    return status;
}

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

/* koksma_generate_write: writes the points of a pattern to a file. A pattern that can generate ranges is
   generated and written in pieces of 4 MiB, which fit into the cache, so that memory does not grow with the
   number of points. */

enum { PIECE = 1 << 19 }; /* coordinates in a piece */

typedef struct job {
    const koksma_spec *spec;
    uint64_t seed, first, n;
    bool ranges;
} job;

/* Generates the part of the range that begins at j->first + done, or the whole set. If there are several pieces, only
   the writer reports progress. */
static koksma_status make(const job *j, uint64_t done, const koksma_run *run, koksma_points *piece)
{
    const koksma_run quiet = {.threads = run ? run->threads : 0};
    return j->ranges
               ? koksma_generate_range(j->spec, j->seed, j->n, j->first + done, piece->n < j->n ? &quiet : run, piece)
               : koksma_generate(j->spec, j->seed, run, piece);
}

static koksma_status write_pieces(const job *j, const char *path, const char *comment, const koksma_run *run,
                                  koksma_points *piece)
{
    koksma__points_writer writer;
    koksma_points last = {1, piece->dim, piece->xs};
    if (j->ranges) { /* fail before the file is opened if the last point cannot be generated */
        KOKSMA__TRY(make(j, j->n - 1, run, &last));
    }
    KOKSMA__TRY(make(j, 0, run, piece));
    KOKSMA__TRY(koksma__writer_open(path, j->n, piece->dim, comment, &writer));
    koksma_status status = koksma__writer_put(&writer, piece, run);
    while (!status && writer.done < j->n && !ferror(writer.file.stream)) {
        const uint64_t left = j->n - writer.done;
        piece->n = left < piece->n ? (size_t)left : piece->n;
        status = make(j, writer.done, run, piece);
        status = status ? status : koksma__writer_put(&writer, piece, run);
    }
    return koksma__writer_close(&writer, status);
}

koksma_status koksma_generate_write(const koksma_spec *spec, uint64_t seed, uint64_t first, uint64_t n, int dim,
                                    const char *path, const char *comment, const koksma_run *run)
{
    KOKSMA__REQUIRE(spec, path);
    KOKSMA__REQUIRE_RUN(run);
    const job j = {spec, seed, first, n, koksma_has_ranges(spec)};
    KOKSMA__FAIL_IF(dim < 1 || dim > KOKSMA_MAX_DIM, KOKSMA_DIM, "dim = %d: the number of dimensions is 1 to %d", dim,
                    KOKSMA_MAX_DIM);
    KOKSMA__FAIL_IF(!spec->pattern || n == 0, KOKSMA_ARGUMENT,
                    "%s: it takes the spec of a pattern, and n of 1 or more", __func__);
    KOKSMA__FAIL_IF(
        n > KOKSMA_MAX_INDEX + 1 || first > KOKSMA_MAX_INDEX + 1 - n, KOKSMA_N,
        "%s: n = %llu from first = %llu ends beyond the last point of all patterns, which has number %llu",
        spec->pattern->name, (unsigned long long)n, (unsigned long long)first, (unsigned long long)KOKSMA_MAX_INDEX);
    KOKSMA__FAIL_IF(
        first && !j.ranges && koksma_is_sequence(spec), KOKSMA_UNSUPPORTED,
        "%s: first = %llu: the sequence has no ranges, because it generates all points together; generate "
        "%llu points and drop the first %llu",
        spec->pattern->name, (unsigned long long)first, (unsigned long long)(first + n), (unsigned long long)first);
    KOKSMA__FAIL_IF(
        first && !(j.ranges && spec->pattern->claims & KOKSMA_CLAIM_SEQUENCE), KOKSMA_UNSUPPORTED,
        "%s: first = %llu: only sequences that have ranges accept this, such as sobol, halton and r-sequence",
        spec->pattern->name, (unsigned long long)first);
    const size_t most = (j.ranges ? (size_t)PIECE : KOKSMA_MAX_COORDINATES) / (size_t)dim;
    KOKSMA__FAIL_IF(!j.ranges && n > most, KOKSMA_N,
                    "%s: n = %llu: the pattern generates all points together, and at most %zu points of dim = %d fit "
                    "into one set; use a pattern with ranges, such as sobol or jittered",
                    spec->pattern->name, (unsigned long long)n, most, dim);
    koksma_points piece;
    koksma_status status = koksma_points_init(&piece, n < most ? (size_t)n : most, dim);
    if (!status) {
        status = write_pieces(&j, path, comment, run, &piece);
        koksma_points_fini(&piece);
    }
    return status;
}
