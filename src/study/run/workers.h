/* SPDX-License-Identifier: Apache-2.0 */
/* Threads of this process that do the assignments of a phase. */
#ifndef KOKSMA_STUDY_RUN_WORKERS_H
#define KOKSMA_STUDY_RUN_WORKERS_H

#include "study/run/run_state.h"

/* Takes and does assignments until the phase is over or has failed. On the thread of the run's caller, asks the
   caller's keep_going between assignments. With redo, does again what nobody has brought back for long. */
void koksma__work(koksma__run_state *state, bool redo);

/* Does a phase on the threads of its run control. */
koksma_status koksma__work_threads(koksma__phase *phase);

#endif
