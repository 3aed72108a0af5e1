/* SPDX-License-Identifier: Apache-2.0 */
/* Defines the kernel table of one instruction set. This file is compiled once for each instruction set, with
   KOKSMA_ISA set to its name. */
#include "render/pipelines/batch.h"

#define KERNEL(result, name, arguments) result BATCH_NAME(name) arguments;
#include "render/pipelines/batch.def"
#undef KERNEL

extern const koksma__batch_table KOKSMA__JOIN(koksma__batch, _table, KOKSMA_ISA);

const koksma__batch_table KOKSMA__JOIN(koksma__batch, _table, KOKSMA_ISA) = {
#define KERNEL(result, name, arguments) .name = BATCH_NAME(name),
#include "render/pipelines/batch.def"
#undef KERNEL
};
