/* SPDX-License-Identifier: Apache-2.0 */
/* Convex domains in the plane, and half-planes that cut them. */
#ifndef KOKSMA_MEASURES_SHARED_EDGE_DOMAIN_H
#define KOKSMA_MEASURES_SHARED_EDGE_DOMAIN_H

#include <koksma/koksma.h>

enum { KOKSMA__MAX_CHORDS = 3 };

/* The direction of a chord as two exact differences, (across[0] - across[1], up[0] - up[1]); both are 0 if there is
   no chord. */
typedef struct koksma__chord {
    double across[2], up[2];
} koksma__chord;

/* A convex domain in the plane with the uniform measure of total mass 1. */
typedef struct koksma__domain {
    /* returns the mass of the half-plane a x + b y <= a p[0] + b p[1] */
    double (*area_below_through)(double a, double b, const double p[2]);
    /* computes the chords with midpoint p. These chords lie on the lines through p for which the mass on one side is
       stationary as the line turns about p. There is at least one chord; if p is a corner of the domain, the chords
       are the two adjacent sides */
    void (*chords)(const double p[2], koksma__chord chords[KOKSMA__MAX_CHORDS]);
    double radius; /* radius of a circle that contains the domain */
} koksma__domain;

/* A half-plane: a x + b y <= c if it is closed, else a x + b y < c. */
typedef struct koksma__edge_line {
    double value, a, b, c, mass;
    size_t count;
    bool closed;
} koksma__edge_line;

#endif
