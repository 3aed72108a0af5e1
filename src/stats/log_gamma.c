/* SPDX-License-Identifier: Apache-2.0 */
/* lgamma leaves the sign in a variable of the whole program, which threads would write at once. */
#define _DEFAULT_SOURCE /* lgamma_r */
#include "stats/log_gamma.h"

#include <math.h>

double koksma__log_gamma(double x)
{
    int sign;
    return lgamma_r(x, &sign);
}
