/* SPDX-License-Identifier: Apache-2.0 */
/* The logarithm of the gamma function by lgamma_r. lgamma stores the sign in a global variable, which several
   threads would write at the same time. */
#define _DEFAULT_SOURCE /* for lgamma_r */
#include "stats/log_gamma.h"

#include <math.h>

double koksma__log_gamma(double x)
{
    int sign;
    return lgamma_r(x, &sign);
}
