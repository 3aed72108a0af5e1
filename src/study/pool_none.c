/* SPDX-License-Identifier: Apache-2.0 */
/* A build without MPI has one rank. */
#include <stdlib.h>

#include "core/status.h"
#include "study/pool.h"

int koksma_study_rank(void)
{
    return 0;
}

int koksma__pool_size(void)
{
    return 1;
}

koksma_status koksma__pool_check(void)
{
    const char *ompi = getenv("OMPI_COMM_WORLD_SIZE"), *pmi = getenv("PMI_SIZE");
    return atoi(ompi  ? ompi
                : pmi ? pmi
                      : "1") > 1
               ? koksma__fail(KOKSMA_UNSUPPORTED, "this build has no MPI: its ranks would all do the same work")
               : KOKSMA_OK;
}

koksma_status koksma__pool_serve(koksma__pool *pool, const koksma_run *run)
{
    return koksma__pool_threads(pool, run);
}

koksma_status koksma__pool_work(koksma_study *study)
{
    (void)study;
    return koksma__fail(KOKSMA_ARGUMENT, "a study without a folder can't be run");
}
