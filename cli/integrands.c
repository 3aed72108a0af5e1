/* SPDX-License-Identifier: Apache-2.0 */
/* The integrands that the first operand of `koksma integrate` names. */
#include <string.h>

#include "integrating.h"

/* Opens integrand i of the first operand, which is "all" or a list. *end: whether i is past the end. *out is NULL
   past the end, and for an integrand of "all" that does not exist in this dimension. Returns the exit code. */
static int open_integrand(const cli_arguments *arguments, size_t i, int dim, bool *end, koksma_integral **out)
{
    const char *list = arguments->operands[0];
    const bool every = !strcmp(list, "all");
    const koksma_integrand *member = every ? koksma_integrand_at(i) : NULL;
    char item[KOKSMA_MAX_SPEC];
    *out = NULL;
    *end = every ? !member : !cli_list_item(list, i, item, sizeof item);
    if (*end) {
        return CLI_YES;
    }
    const koksma_status status = koksma_integral_open(every ? member->name : item, dim, out);
    return status && !(every && status == KOKSMA_DIM) ? cli_fail(arguments, status) : CLI_YES;
}

int cli_integrands_each(const cli_arguments *arguments, int dim,
                        int (*f)(const koksma_integral *integral, void *context), void *context)
{
    int code = CLI_YES;
    bool end = false;
    for (size_t i = 0; !code && !end; i++) {
        koksma_integral *integral;
        code = open_integrand(arguments, i, dim, &end, &integral);
        if (!code && integral) {
            code = f(integral, context);
        }
        koksma_integral_close(integral);
    }
    return code;
}
