/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_ORIENTATION_H
#define KOKSMA_MEASURES_SHARED_ORIENTATION_H

/* Returns the exact sign (1, 0 or -1) of (a[0] - a[1]) (b[0] - b[1]) - (c[0] - c[1]) (d[0] - d[1]) for numbers in
   [0,1]. (Parts of products below 2^-2074 are lost, but only if one of the numbers is above 2^-300.) */
int koksma__sign_of_cross(const double a[2], const double b[2], const double c[2], const double d[2]);

#endif
