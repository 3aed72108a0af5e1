/* SPDX-License-Identifier: Apache-2.0 */
/* The names that curves have for the library's slopes over trials (koksma/series.h). */
#ifndef KOKSMA_CLI_SLOPE_H
#define KOKSMA_CLI_SLOPE_H

#include <koksma/series.h>

enum { CLI_MAX_SIZES = KOKSMA_MAX_SIZES };

typedef koksma_joint cli_joint;

static inline void cli_joint_add(cli_joint *joint, size_t n, const double *values)
{
    koksma_joint_add(joint, n, values);
}

static inline bool cli_slope(size_t n, const double *sizes, const double *means, const cli_joint *joint,
                             koksma_line *line)
{
    return koksma_joint_line(joint, n, sizes, means, line);
}

#endif
