/* SPDX-License-Identifier: Apache-2.0 */
/*
 * net-base-2, net-base-3 and net-base-5: the quality parameter t of the first b^m points as a (t,m,s)-net in base b
 * (core/net.c), for each pair of coordinates and, in up to 8 dimensions, for all coordinates together. Prefixes for
 * which computing t would take more than about a second are left out.
 */
#include <stdio.h>
#include <string.h>

#include "core/points.h"
#include "verify/verify.h"

enum { MAX_NET_DIM = 8 };

#define WORK 4e8 /* limit of the work for one t: points times shapes of intervals */

typedef struct search {
    const koksma__net *net;
    const int *use;
    int dim;
    koksma__verification *v;
} search;

/* The number of shapes of elementary intervals of volume b^-m: C(m + dim - 1, dim - 1). */
static double shapes(int m, int dim)
{
    double count = 1;
    for (int k = 1; k < dim; k++) {
        count *= (double)(m + k) / k;
    }
    return count;
}

static koksma_status verify_net(search *s, const char *subject)
{
    koksma_finding *f = NULL;
    koksma_status status = KOKSMA_OK;
    for (int m = 1; m <= s->net->digits && !status; m++) {
        if (shapes(m, s->dim) * (double)s->net->powers[m] * (1 + m / 4.0) > WORK) {
            break;
        }
        if (!f) {
            f = koksma__finding(s->v);
            if (!f) {
                return KOKSMA_MEMORY;
            }
            snprintf(f->subject, sizeof f->subject, "%s", subject);
            snprintf(f->detail, sizeof f->detail, "t for m = 1, 2, ...:");
            f->holds = true;
        }
        int t;
        status = koksma__net_quality(s->net, m, s->use, s->dim, s->v->run, &t);
        const size_t used = strlen(f->detail);
        snprintf(f->detail + used, sizeof f->detail - used, " %d", t);
        f->value = t > f->value ? t : f->value;
        f->holds = f->holds && t == 0;
    }
    return status;
}

static koksma_status look(koksma__verification *v)
{
    const koksma_points *points = v->points;
    const int dim = points->dim < KOKSMA_VERIFY_NET_DIM ? points->dim : KOKSMA_VERIFY_NET_DIM;
    int use[MAX_NET_DIM];
    koksma__net net;
    koksma_status status = koksma__net_init(points, v->property->base, &net);
    search s = {.net = &net, .use = use, .dim = 2, .v = v};
    for (use[0] = 0; use[0] < dim && !status; use[0]++) {
        for (use[1] = use[0] + 1; use[1] < dim && !status; use[1]++) {
            char subject[48];
            snprintf(subject, sizeof subject, "%d,%d", use[0], use[1]);
            status = verify_net(&s, subject);
        }
    }
    if (!status && points->dim != 2 && points->dim <= MAX_NET_DIM) {
        for (s.dim = 0; s.dim < points->dim; s.dim++) {
            use[s.dim] = s.dim;
        }
        status = verify_net(&s, "all");
    }
    koksma__net_fini(&net);
    return status;
}

#define NET(b)                                                                                                       \
    const koksma__property koksma__property_net_base_##b = {                                                         \
        .public = {.name = "net-base-" #b,                                                                           \
                   .meaning = "prefixes of " #b "^m points are (t,m,s)-nets with t = 0; value: the largest t",       \
                   .coordinates = KOKSMA_VERIFY_NET_DIM},                                                            \
        .look = look,                                                                                                \
        .base = (b),                                                                                                 \
    }
NET(2);
NET(3);
NET(5);
