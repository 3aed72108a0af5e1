/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A target of the fuzzers: one function over bytes, which must come back whatever they are. With KOKSMA_FUZZ (clang)
 * libFuzzer calls it; in every other build replay.c does, over the files of fuzz/corpus/TARGET.
 */
#ifndef KOKSMA_FUZZ_TARGET_H
#define KOKSMA_FUZZ_TARGET_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <unistd.h>

#include <koksma/koksma.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

/* Where files are made that have to be: in memory, where the system has such a place. */
static inline const char *fuzz_place(void)
{
    return access("/dev/shm", W_OK) ? "/tmp" : "/dev/shm";
}

/* What every reader owes to its caller: a failure with a text of one line. */
static inline void fuzz_check_status(koksma_status status)
{
    if (status && (!*koksma_error_text() || strchr(koksma_error_text(), '\n'))) {
        abort();
    }
}

#endif
