/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lets the ranks of an MPI run share a search (koksma_optimise). In an exchange, rank 0 gets the pieces of each
 * other rank in one message and sends all pieces to each rank. Messages of one rank arrive in the order in which
 * they were sent, so successive exchanges cannot be confused.
 */
#include <koksma/study.h>

#include <stdlib.h>
#include <string.h>

#include "study/run/mpi_messages.h"
#include "study/run/mpi_rank.h"

/* Copies the pieces of a rank (rank, rank + size, rank + 2 size, ...) between `all` and the contiguous array `own`;
   returns their length in bytes. */
static size_t copy(unsigned char *all, unsigned char *own, int rank, int size, size_t count, size_t bytes,
                   bool to_own)
{
    size_t length = 0;
    for (size_t i = (size_t)rank; i < count; i += (size_t)size, length += bytes) {
        memcpy(to_own ? own + length : all + i * bytes, to_own ? all + i * bytes : own + length, bytes);
    }
    return length;
}

static bool gather(const koksma__mpi *m, unsigned char *pieces, unsigned char *own, size_t count, size_t bytes)
{
    bool ok = true;
    for (int r = 1; ok && r < m->size; r++) {
        size_t got, wanted = copy(pieces, own, r, m->size, count, bytes, true);
        ok = m->mpi->receive(r, KOKSMA__TAG_PIECES, own, count * bytes, &got) && got == wanted;
        copy(pieces, own, r, m->size, count, bytes, false);
    }
    for (int r = 1; ok && r < m->size; r++) {
        ok = m->mpi->send(r, KOKSMA__TAG_PIECES, pieces, count * bytes);
    }
    return ok;
}

static koksma_status exchange(void *context, void *pieces, size_t count, size_t bytes)
{
    const koksma__mpi *m = context;
    unsigned char *own = malloc(count * bytes);
    size_t got = 0;
    KOKSMA__REQUIRE_MEMORY(own, count * bytes);
    const bool ok =
        m->rank == 0
            ? gather(m, pieces, own, count, bytes)
            : m->mpi->send(0, KOKSMA__TAG_PIECES, own, copy(pieces, own, m->rank, m->size, count, bytes, true)) &&
                  m->mpi->receive(0, KOKSMA__TAG_PIECES, pieces, count * bytes, &got) && got == count * bytes;
    free(own);
    return ok ? KOKSMA_OK
              : koksma__fail(KOKSMA_SYSTEM, "MPI rank %d: an exchange with the other ranks failed", m->rank);
}

static void done(void *context)
{
    (void)context;
    koksma__mpi_release();
}

koksma_status koksma_study_mpi_processes(koksma_processes *out)
{
    KOKSMA__REQUIRE(out);
    KOKSMA__TRY(koksma__mpi_check());
    koksma__mpi *m = koksma__mpi_get();
    *out = (koksma_processes){.size = m->size, .rank = m->rank, .exchange = exchange, .done = done, .context = m};
    return KOKSMA_OK;
}
