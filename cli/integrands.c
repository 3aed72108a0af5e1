/* SPDX-License-Identifier: Apache-2.0 */
/* The integrands that the first operand of `koksma integrate` names: of the table, or functions of shared libraries. */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include "integrating.h"

/* Opens the function NAME, or the first function, of the library "PATH.so[:NAME]". Returns the exit code. */
static int open_library(cli_integrands *all, const char *text, int dim, koksma_integral **out)
{
    char path[KOKSMA_MAX_SPEC];
    snprintf(path, sizeof path, "%s", text);
    char *name = strrchr(path, ':');
    if (name && !strchr(name, '/')) {
        *name++ = 0;
    } else {
        name = NULL;
    }
    const size_t most = sizeof all->libraries / sizeof *all->libraries;
    void *library = all->n_libraries < most ? dlopen(path, RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!library) {
        const char *reason = all->n_libraries < most ? dlerror() : "a command takes 16 libraries at most";
        const size_t length = strlen(path); /* some reasons of dlerror begin with the path */
        const bool named = !strncmp(reason, path, length) && !strncmp(reason + length, ": ", 2);
        cli_say(all->arguments->command->name, "%s: %s", path, named ? reason + length + 2 : reason);
        return koksma_status_exit_code(KOKSMA_MISSING);
    }
    all->libraries[all->n_libraries++] = library;
    const koksma_function *(*at)(size_t) = NULL;
    void *symbol = dlsym(library, "koksma_function_at");
    memcpy(&at, &symbol, sizeof at); /* ISO C has no cast from a pointer to an object to a pointer to a function */
    const koksma_function *function = NULL;
    for (size_t i = 0; at && (function = at(i)) && name && strcmp(name, function->name) != 0; i++) {
    }
    if (!function) {
        cli_say(all->arguments->command->name,
                at ? "%s: its koksma_function_at has no function%s%s"
                   : "%s: it exports no koksma_function_at (koksma/integrate.h)%s%s",
                path, at && name ? " " : "", at && name ? name : "");
        return koksma_status_exit_code(KOKSMA_MALFORMED);
    }
    const koksma_status status = koksma_integral_of_function(function, dim, out);
    return status ? cli_fail(all->arguments, status) : CLI_YES;
}

/* Opens integrand i of the first operand, which is "all" or a list. *end: whether i is past the end. *out is NULL
   past the end, and for an integrand of "all" that does not exist in this dimension. Returns the exit code. */
static int open_integrand(cli_integrands *all, size_t i, int dim, bool *end, koksma_integral **out)
{
    const char *list = all->arguments->operands[0];
    const bool every = !strcmp(list, "all");
    const koksma_integrand *member = every ? koksma_integrand_at(i) : NULL;
    char item[KOKSMA_MAX_SPEC];
    *out = NULL;
    *end = every ? !member : !cli_list_item(list, i, item, sizeof item);
    if (*end) {
        return CLI_YES;
    }
    if (!every && strchr(item, '/')) {
        return open_library(all, item, dim, out);
    }
    const koksma_status status = koksma_integral_open(every ? member->name : item, dim, out);
    return status && !(every && status == KOKSMA_DIM) ? cli_fail(all->arguments, status) : CLI_YES;
}

int cli_integrands_each(cli_integrands *all, int dim, int (*f)(const koksma_integral *integral, void *context),
                        void *context)
{
    int code = CLI_YES;
    bool end = false;
    for (size_t i = 0; !code && !end; i++) {
        koksma_integral *integral;
        code = open_integrand(all, i, dim, &end, &integral);
        if (!code && integral) {
            code = f(integral, context);
        }
        koksma_integral_close(integral);
    }
    return code;
}

void cli_integrands_close(cli_integrands *all)
{
    for (size_t i = 0; i < all->n_libraries; i++) {
        dlclose(all->libraries[i]);
    }
}
