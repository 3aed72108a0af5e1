/* SPDX-License-Identifier: Apache-2.0 */
/* Which ranks there are. */
#include "study/run/mpi_ranks.h"

#include <stdlib.h>
#include <time.h>

#include "core/status.h"

static koksma__ranks ranks;
static const char *problem; /* why this process is alone, when mpirun started more than one */

static void finish(void)
{
    const bool others_wait = ranks.rank == 0 && ranks.size > 1 && !ranks.released; /* for what won't come */
    ranks.mpi->finish(others_wait ? koksma_status_exit_code(KOKSMA_IO) : 0);
}

/* Ranks that were started together, as the launcher's environment has it; 0: no launcher. */
static int launched(void)
{
    const char *ompi = getenv("OMPI_COMM_WORLD_SIZE"), *pmi = getenv("PMI_SIZE"), *slurm = getenv("SLURM_NTASKS");
    return ompi ? atoi(ompi) : pmi ? atoi(pmi) : getenv("PMIX_RANK") ? (slurm ? atoi(slurm) : 1) : 0;
}

/* A process that no mpirun started must not pay for MPI, nor depend on it. */
static void start(void)
{
    const int expected = launched();
    ranks.size = 1;
    if (expected) {
        ranks.mpi = koksma__transport_load(&problem);
        if (ranks.mpi && !ranks.mpi->start(&ranks.size, &ranks.rank)) {
            ranks.mpi = NULL;
            problem = "MPI can't be started";
        }
    }
    if (ranks.mpi) {
        atexit(finish);
    } else if (expected <= 1) {
        problem = NULL;
    }
}

koksma__ranks *koksma__ranks_get(void)
{
    if (ranks.size == 0) {
        start();
    }
    return &ranks;
}

int koksma__pool_size(void)
{
    return koksma__ranks_get()->size;
}

int koksma_study_rank(void)
{
    return koksma__ranks_get()->rank;
}

koksma_status koksma__pool_check(void)
{
    koksma__ranks_get()->released = false;
    return problem ? koksma__fail(KOKSMA_UNSUPPORTED, "%s", problem) : KOKSMA_OK;
}

void koksma__pool_release(void)
{
    koksma__ranks_get()->released = true;
}

void koksma__ranks_rest(double seconds)
{
    const struct timespec t = {0, (long)(1e9 * seconds)};
    nanosleep(&t, NULL);
}
