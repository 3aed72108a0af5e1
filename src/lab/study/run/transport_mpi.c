/* SPDX-License-Identifier: Apache-2.0 */
/* The module koksma-mpi.so, which implements koksma__transport of mpi.h. */
#include <mpi.h>

#include "study/run/mpi.h"

/* An MPI count is an int, so longer messages are sent in pieces; MPI keeps messages of one tag between two ranks in
   order. */
enum { PIECE = 1 << 30 };

static bool start(int *size, int *rank)
{
    int provided;
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS) {
        return false;
    }
    MPI_Comm_size(MPI_COMM_WORLD, size);
    MPI_Comm_rank(MPI_COMM_WORLD, rank);
    return MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN) == MPI_SUCCESS;
}

static bool send(int to, int tag, const void *bytes, size_t size)
{
    const char *at = bytes;
    for (; size > PIECE; at += PIECE, size -= PIECE) {
        if (MPI_Send(at, PIECE, MPI_BYTE, to, tag, MPI_COMM_WORLD) != MPI_SUCCESS) {
            return false;
        }
    }
    return MPI_Send(at, (int)size, MPI_BYTE, to, tag, MPI_COMM_WORLD) == MPI_SUCCESS;
}

static bool receive(int from, int tag, void *bytes, size_t room, size_t *size)
{
    char *at = bytes;
    size_t all = 0;
    int got;
    do {
        MPI_Status status;
        const size_t most = room - all > PIECE ? PIECE : room - all;
        if (MPI_Recv(at + all, (int)most, MPI_BYTE, from, tag, MPI_COMM_WORLD, &status) != MPI_SUCCESS) {
            return false;
        }
        MPI_Get_count(&status, MPI_BYTE, &got);
        all += (size_t)got;
    } while (got == PIECE && all < room);
    if (size) {
        *size = all;
    }
    return true;
}

static bool probe(int *from, int *tag, size_t *size)
{
    int there = 0, bytes = 0;
    MPI_Status status;
    if (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status) != MPI_SUCCESS || !there) {
        return false;
    }
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    *from = status.MPI_SOURCE;
    *tag = status.MPI_TAG;
    *size = (size_t)bytes;
    return true;
}

static void finish(int abort_code)
{
    int finalized;
    MPI_Finalized(&finalized);
    if (!finalized && abort_code) {
        MPI_Abort(MPI_COMM_WORLD, abort_code);
    }
    if (!finalized) {
        MPI_Finalize();
    }
}

extern const koksma__transport koksma__transport_mpi;
__attribute__((visibility("default"))) const koksma__transport koksma__transport_mpi = {
    KOKSMA__TRANSPORT_VERSION, start, send, receive, probe, finish,
};
