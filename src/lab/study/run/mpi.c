/* SPDX-License-Identifier: Apache-2.0 */
/* Finds this process's rank and the number of ranks. MPI is loaded only if the environment shows that mpirun or srun
   started this process. If rank 0 exits before the others are released, it aborts them, because they would wait for
   it. */
#define _GNU_SOURCE /* on_exit */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <koksma/study.h>

#include "core/status.h"
#include "modules/module.h"
#include "study/run/mpi.h"

static koksma__mpi here;
static const char *problem; /* NULL, or the reason why MPI cannot be used although mpirun started several processes */

const char *koksma_study_mpi(void)
{
    static _Thread_local char path[4096];
    return koksma__module_path("mpi", path, sizeof path) ? path : NULL;
}

/* Loads the module that calls MPI; sets `problem` if it can't. */
static const koksma__transport *load(void)
{
    static char text[4200];
    char path[4096];
    problem = "this build has no MPI support, so that every rank would do the whole work";
    if (!koksma__module_path("mpi", path, sizeof path)) {
        return NULL;
    }
    /* RTLD_GLOBAL, because modules of Open MPI look up its symbols globally. The library is never unloaded. */
    void *module = dlopen(path, RTLD_NOW | RTLD_GLOBAL);
    const koksma__transport *transport = module ? dlsym(module, KOKSMA__TRANSPORT_SYMBOL) : NULL;
    if (!transport) {
        const char *reason = dlerror();
        snprintf(text, sizeof text, "MPI can't be loaded: %s", reason ? reason : "no reason given");
    } else if (transport->version != KOKSMA__TRANSPORT_VERSION) {
        snprintf(text, sizeof text, "%s belongs to another release of koksma", path);
        transport = NULL;
    }
    problem = transport ? NULL : text;
    return transport;
}

/* code: of this process, which mpirun then has as well. */
static void finish(int code, void *context)
{
    (void)context;
    const bool others_wait = here.rank == 0 && here.size > 1 && !here.released; /* for rank 0 */
    if (others_wait) { /* mpirun may drop what it has not yet passed on when ranks are aborted: the reason of the error */
        koksma__mpi_rest(0.5);
    }
    here.mpi->finish(!others_wait ? 0 : code ? code : koksma_status_exit_code(KOKSMA_IO));
}

#ifndef __GLIBC__
static void finish_anyhow(void) /* where exit codes are not to be had: an error of rank 0 is that of the others */
{
    finish(koksma_status_exit_code(KOKSMA_IO), NULL);
}
#endif

/* The number of ranks according to the launcher's environment variables; 0 without a launcher. */
static int launched(void)
{
    const char *ompi = getenv("OMPI_COMM_WORLD_SIZE"), *pmi = getenv("PMI_SIZE"), *slurm = getenv("SLURM_NTASKS");
    return ompi ? atoi(ompi) : pmi ? atoi(pmi) : getenv("PMIX_RANK") ? (slurm ? atoi(slurm) : 1) : 0;
}

/* Loads and starts MPI if a launcher started this process; other processes must neither spend time on MPI nor depend
   on it. */
static void start(void)
{
    const int expected = launched();
    here.size = 1;
    if (expected) {
        here.mpi = load();
        if (here.mpi && !here.mpi->start(&here.size, &here.rank)) {
            here.mpi = NULL;
            problem = "MPI can't be started";
        }
    }
    if (here.mpi) {
#ifdef __GLIBC__
        on_exit(finish, NULL);
#else
        atexit(finish_anyhow);
#endif
    } else if (expected <= 1) {
        problem = NULL;
    }
}

koksma__mpi *koksma__mpi_get(void)
{
    if (here.size == 0) {
        start();
    }
    return &here;
}

int koksma__mpi_size(void)
{
    return koksma__mpi_get()->size;
}

int koksma_study_mpi_rank(void)
{
    return koksma__mpi_get()->rank;
}

koksma_status koksma__mpi_check(void)
{
    koksma__mpi_get()->released = false;
    return problem ? koksma__fail(KOKSMA_UNSUPPORTED, "%s", problem) : KOKSMA_OK;
}

void koksma__mpi_release(void)
{
    koksma__mpi_get()->released = true;
}

void koksma__mpi_rest(double seconds)
{
    const struct timespec t = {0, (long)(1e9 * seconds)};
    nanosleep(&t, NULL);
}

/* ---- Shared searches ----------------------------------------------------------------------------------------- */

/*
 * Lets the ranks of an MPI run share a search (koksma_optimise). In an exchange, rank 0 gets the pieces of each
 * other rank in one message and sends all pieces to each rank. Messages of one rank arrive in the order in which
 * they were sent, so successive exchanges cannot be confused.
 */
