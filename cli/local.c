/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma measure --at X,Y..`: the local discrepancy at a corner, which is the fraction of the points in the box from
   the origin to that corner, minus the volume of the box. */
#include "local.h"

#include <stdlib.h>
#include <string.h>

#include "source.h"

enum { MAX_CORNER = 64 };

/* Reads a list of coordinates such as 0.3,0.7. Returns their number, at most MAX_CORNER, or 0 after an error. */
static int parse_corner(const cli_arguments *arguments, const char *list, double corner[MAX_CORNER])
{
    char item[64];
    int n = 0;
    while (n < MAX_CORNER && cli_list_item(list, (size_t)n, item, sizeof item)) {
        char *end;
        corner[n] = strtod(item, &end);
        if (end == item || *end || !(corner[n] >= 0 && corner[n] <= 1)) {
            cli_usage_error(arguments, "--at %s: it takes the coordinates of a corner in [0,1], such as 0.3,0.7",
                            list);
            return 0;
        }
        n++;
    }
    if (n == MAX_CORNER && cli_list_item(list, (size_t)n, item, sizeof item)) {
        cli_usage_error(arguments, "--at: at most %d coordinates", MAX_CORNER);
        return 0;
    }
    return n;
}

int measure_local(const cli_arguments *arguments)
{
    static const char *const unused[] = {"measures", "trials", "prefixes", "sizes", "warp", "paired", "time-limit"};
    double corner[MAX_CORNER], value;
    const char *list = cli_text(arguments, "at", "");
    const int dim = parse_corner(arguments, list, corner);
    uint64_t seed;
    cli_work work;
    for (size_t i = 0; i < sizeof unused / sizeof *unused; i++) {
        if (cli_text(arguments, unused[i], NULL)) {
            return cli_usage_error(arguments,
                                   "--%s has no effect with --at, which prints only the local discrepancy "
                                   "of the points as they are",
                                   unused[i]);
        }
    }
    if (!dim || !cli_whole(arguments, "seed", 0, 0, UINT64_MAX, &seed) ||
        !cli_work_begin(arguments, "measuring", &work)) {
        return CLI_USAGE;
    }
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    int code = CLI_YES;
    for (int i = 0; i < arguments->n_operands && !code; i++) {
        koksma_points points = {0};
        code = cli_source_points(arguments, arguments->operands[i], seed, &work.run, &points);
        if (!code && points.dim != dim) {
            code = cli_usage_error(arguments, "%s: the points have %d dimensions, but --at %s has %d",
                                   arguments->operands[i], points.dim, list, dim);
        }
        const koksma_status status = code ? KOKSMA_OK : koksma_local_discrepancy(&points, corner, &value);
        code = status ? cli_fail(arguments, status) : code;
        if (!code) {
            cli_row_text(rows, "source", arguments->operands[i]);
            cli_row_whole(rows, "n", points.n);
            cli_row_whole(rows, "dim", (uint64_t)points.dim);
            cli_row_text(rows, "at", list);
            cli_row_number(rows, "local_discrepancy", value);
            cli_row_end(rows);
        }
        koksma_points_fini(&points);
    }
    cli_work_end();
    const int rows_code = cli_rows_close(rows);
    return code ? code : rows_code;
}
