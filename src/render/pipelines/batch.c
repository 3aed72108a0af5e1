/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Selects the compilation of the lane loops for the instruction set that koksma__kernels() has chosen (the
 * environment variable KOKSMA_KERNELS overrides the choice). All compilations give the same bits.
 */
#include "render/pipelines/batch.h"

#include <string.h>

extern const koksma__batch_table koksma__batch_table_ref, koksma__batch_table_baseline;
#ifdef KOKSMA_X86_KERNELS
extern const koksma__batch_table koksma__batch_table_avx2, koksma__batch_table_avx512;
#endif

static const koksma__batch_table *table_of(const char *isa)
{
#ifdef KOKSMA_X86_KERNELS
    if (!strcmp(isa, "avx2")) {
        return &koksma__batch_table_avx2;
    }
    if (!strcmp(isa, "avx512")) {
        return &koksma__batch_table_avx512;
    }
#endif
    return strcmp(isa, "ref") ? &koksma__batch_table_baseline : &koksma__batch_table_ref;
}

const koksma__batch_table *koksma__batch_find(const char *isa)
{
    return koksma__kernels_find(isa) ? table_of(isa) : NULL;
}

/* Without a look at the processor, which a virtual machine makes slow. */
const koksma__batch_table *koksma__batch(void)
{
    return table_of(koksma__kernels()->isa);
}
