/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Chooses the table of kernels once: the one for the fastest instruction set that the processor has (by cpuid), or
 * the one that the environment variable KOKSMA_KERNELS names.
 */
#include "kernels/kernels.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

extern const koksma__kernel_table koksma__kernel_table_ref, koksma__kernel_table_baseline;
#ifdef KOKSMA_X86_KERNELS
extern const koksma__kernel_table koksma__kernel_table_avx2, koksma__kernel_table_avx512;
#endif

static pthread_once_t once = PTHREAD_ONCE_INIT;
static const koksma__kernel_table *chosen;

const koksma__kernel_table *koksma__kernels_find(const char *isa)
{
    if (!strcmp(isa, "ref")) {
        return &koksma__kernel_table_ref;
    }
    if (!strcmp(isa, "baseline")) {
        return &koksma__kernel_table_baseline;
    }
#ifdef KOKSMA_X86_KERNELS
    if (!strcmp(isa, "avx2") && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2")) {
        return &koksma__kernel_table_avx2;
    }
    if (!strcmp(isa, "avx512") && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("bmi2")) {
        return &koksma__kernel_table_avx512;
    }
#endif
    return NULL;
}

static void choose(void)
{
    const char *wish = getenv("KOKSMA_KERNELS");
    static const char *const order[] = {"avx512", "avx2", "baseline"};
    chosen = wish && *wish ? koksma__kernels_find(wish) : NULL;
    for (int i = 0; !chosen; i++) {
        chosen = koksma__kernels_find(order[i]);
    }
}

const char *koksma_instruction_set(void)
{
    return koksma__kernels()->isa;
}

const koksma__kernel_table *koksma__kernels(void)
{
    pthread_once(&once, choose);
    return chosen;
}
