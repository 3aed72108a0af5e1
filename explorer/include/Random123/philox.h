/* SPDX-License-Identifier: Apache-2.0 */
/* Random123 stops on machines that it doesn't know, and WebAssembly is one. It wants nothing of it that its RISC-V,
   also without instructions of its own for this, doesn't give. */
#define __riscv 1
#include_next <Random123/philox.h>
#undef __riscv
