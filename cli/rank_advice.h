/* SPDX-License-Identifier: Apache-2.0 */
/* The advice of `koksma rank`: explains a ranking in sentences. */
#ifndef KOKSMA_CLI_RANK_ADVICE_H
#define KOKSMA_CLI_RANK_ADVICE_H

#include <koksma/study.h>

/* Prints on stderr which pattern to use or what is undecided, and how many trials were made. */
void cli_rank_advise(const koksma_rank_options *options, const koksma_rank_row *rows, const koksma_ranking *ranking);

#endif
