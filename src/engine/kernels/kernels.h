/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_KERNELS_KERNELS_H
#define KOKSMA_KERNELS_KERNELS_H

#include <koksma/koksma.h>

#include "core/visibility.h"
#include "kernels/dart_cells.h"
#include "kernels/nested_node.h"

typedef struct koksma__kernel_table {
    const char *isa; /* "ref", "baseline", "avx2", "avx512" */
#define KERNEL(result, name, arguments) result(*name) arguments;
#include "kernels/kernels.def"
#undef KERNEL
} koksma__kernel_table;

/* Returns the table of the fastest kernels that this machine supports, or the table that the environment variable
   KOKSMA_KERNELS names (KOKSMA_KERNELS=ref: the reference kernels). The first call makes the choice. */
KOKSMA__LAB const koksma__kernel_table *koksma__kernels(void);

/* Returns the table of kernels with this name, or NULL if this build or machine does not support it. Only for tests
   and benchmarks. */
KOKSMA__LAB const koksma__kernel_table *koksma__kernels_find(const char *isa);

/* In a kernel's source file, KERNEL_NAME(uniform) is the name of that kernel's function for the instruction set being
   compiled. */
#define KOKSMA__JOIN3(a, b, c) a##b##_##c
#define KOKSMA__JOIN(a, b, c) KOKSMA__JOIN3(a, b, c)
#define KERNEL_NAME(name) KOKSMA__JOIN(koksma__kernel_, name, KOKSMA_ISA)

#endif
