/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Chooses the table of kernels once: the one for the fastest instruction set that the processor has (by cpuid), or
 * the one that the environment variable KOKSMA_KERNELS names.
 */
#include "kernels/kernels.h"

#ifdef KOKSMA_X86_KERNELS
#include <cpuid.h>
#endif
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

extern const koksma__kernel_table koksma__kernel_table_ref, koksma__kernel_table_baseline;
#ifdef KOKSMA_X86_KERNELS
extern const koksma__kernel_table koksma__kernel_table_avx2, koksma__kernel_table_avx512;
#endif

#ifdef KOKSMA_X86_KERNELS
enum { YMM = 0x6, ZMM = 0xe6 }; /* the registers of XCR0 that the system saves */

/* What __builtin_cpu_supports would tell, which needs a library of the compiler's that macOS and zig lack. */
static bool processor_has(unsigned features, unsigned registers)
{
    unsigned a, b, c, d;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & bit_OSXSAVE)) {
        return false;
    }
    __asm__ volatile("xgetbv" : "=a"(a), "=d"(d) : "c"(0));
    return (a & registers) == registers && __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b & features) == features;
}
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
    if (!strcmp(isa, "avx2") && processor_has(bit_AVX2 | bit_BMI2, YMM)) {
        return &koksma__kernel_table_avx2;
    }
    if (!strcmp(isa, "avx512") &&
        processor_has(bit_AVX512F | bit_AVX512DQ | bit_AVX512VL | bit_AVX512BW | bit_BMI2, ZMM)) {
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
