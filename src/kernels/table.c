/* SPDX-License-Identifier: Apache-2.0 */
/* The table of one instruction set; compiled once for each, with KOKSMA_ISA set to its name. */
#include "kernels/kernels.h"

#define KERNEL(result, name, arguments) result KERNEL_NAME(name) arguments;
#include "kernels/kernels.def"
#undef KERNEL

#define TEXT2(x) #x
#define TEXT(x) TEXT2(x)

extern const koksma__kernel_table KOKSMA__JOIN(koksma__kernel, _table, KOKSMA_ISA);

const koksma__kernel_table KOKSMA__JOIN(koksma__kernel, _table, KOKSMA_ISA) = {
    .isa = TEXT(KOKSMA_ISA),
#define KERNEL(result, name, arguments) .name = KERNEL_NAME(name),
#include "kernels/kernels.def"
#undef KERNEL
};
