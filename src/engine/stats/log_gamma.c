/* SPDX-License-Identifier: Apache-2.0 */
/* The logarithm of the gamma function, computed by lgamma_r. lgamma is not safe with several threads, because it
   stores the sign in a global variable. */
#define _DEFAULT_SOURCE /* for lgamma_r */
#include "stats/log_gamma.h"

#include <math.h>

double koksma__log_gamma(double x)
{
    int sign;
    return lgamma_r(x, &sign);
}
