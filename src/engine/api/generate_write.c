/* SPDX-License-Identifier: Apache-2.0 */
/* koksma_generate_write: writes the points of a pattern to a file. A pattern that can generate ranges is
   generated and written in pieces of 4 MiB, which fit into the cache, so that memory does not grow with the
   number of points. */
#include <koksma/koksma.h>

#include "core/points_io.h"
#include "core/status.h"

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
