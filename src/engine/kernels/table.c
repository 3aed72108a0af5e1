/* SPDX-License-Identifier: Apache-2.0 */
/* The table of the kernels for one instruction set. This file is compiled once for each instruction set, with
   KOKSMA_ISA set to its name. */
#include "kernels/kernels.h"

#ifdef __AVX512F__
#define NAME_256(name) koksma__kernel_##name##_avx2
#else
#define NAME_256 KERNEL_NAME
#endif

#define KERNEL(result, name, arguments) result KERNEL_NAME(name) arguments;
#define KERNEL_256(result, name, arguments) result NAME_256(name) arguments;
#include "kernels/kernels.def"
#undef KERNEL

#define TEXT2(x) #x
#define TEXT(x) TEXT2(x)

extern const koksma__kernel_table KOKSMA__JOIN(koksma__kernel, _table, KOKSMA_ISA);

const koksma__kernel_table KOKSMA__JOIN(koksma__kernel, _table, KOKSMA_ISA) = {
    .isa = TEXT(KOKSMA_ISA),
#define KERNEL(result, name, arguments) .name = KERNEL_NAME(name),
#define KERNEL_256(result, name, arguments) .name = NAME_256(name),
#include "kernels/kernels.def"
#undef KERNEL
};
