/* SPDX-License-Identifier: Apache-2.0 */
/*
 * gaussian-blue-noise in a rectangle, by gradient descent from independent points. The points and the wanted density p are
 * both smoothed by Gaussians G(x, s) = exp(-|x|^2 / s^2) / (pi s^2) of the width s, which depends on the position. With
 * x_i and s_i the position and the width of point i, the energy is the squared L2 distance
 *
 *     || sum over i of G(x - x_i, s_i)  -  integral of n p(y) G(x - y, s(y)) dy ||^2
 *
 * between the two smoothed densities. Point j repels point i with the force
 *
 *     (2 s_i^2 / v)^2  exp(-d^2 / v)  (x_i - x_j), v = s_i^2 + s_j^2, d = |x_i - x_j|,
 *
 * which is minus the gradient of the energy, times pi s_i^4. The density attracts points in the same way: it is a sum
 * over nodes (field.h), which act like points with negative masses. Where the density is constant, all widths are
 * sigma sqrt(area / n), the attraction cancels out, and the forces are those of the pattern on the torus
 * (patterns/gaussian_blue_noise.c); its parameters are also those of this method.
 *
 * The widths of the moving points are computed anew in each of the first 128 steps, which have little momentum, and
 * then every 100 steps; after step 400 they are constant. The forces are the gradient of an energy only while the
 * widths are constant: when widths were computed anew in all steps, 500 points with a momentum of 0.9 never came to
 * rest. With steps=0 the descent takes 600 steps at least and 2,000 at most; it ends when the root mean square of
 * (force / width) is below 1e-4 sigma, or has not fallen by a tenth for 200 steps.
 *
 * Source: Ahmed, Ren & Wonka 2022, whose program for densities has these forces, but one width for all pixels; Fattal
 * 2011 for widths that follow the density. The time of a step is proportional to n times the number of points and nodes
 * within reach of a point, about 200.
 */
#include "domains/field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/vector.h"

enum { BLOCK = 8, SETTLING = 128, LOCKED = 400, LEAST_STEPS = 600, MOST_STEPS = 2000, PATIENCE = 200 };

#define TOLERANCE 1e-4

typedef struct descent {
    const koksma__choice *c;
    const koksma__point_domain *domain;
    koksma__field field;
    koksma__source_tree tree;    /* its sources are the nodes of the field and the points */
    double *xs, *moves, *widths; /* of the points */
    double *squares;             /* squared force on each point, in units of its width */
    double step, momentum, least;
    bool update; /* whether this step computes the widths anew */
    int wait;    /* number of steps since `least`, the smallest sum of squares, fell by 19 % */
} descent;

/* Returns source number i: a node, with a negative mass, or a point. */
static koksma__field_node source_of(const void *context, size_t i)
{
    const descent *d = context;
    const size_t n_nodes = d->field.n_nodes;
    koksma__field_node source = {.mass = 1};
    if (i < n_nodes) {
        source = d->field.nodes[i];
        source.mass = -source.mass;
    } else {
        memcpy(source.x, d->xs + 2 * (i - n_nodes), sizeof source.x);
        source.square = d->widths[i - n_nodes] * d->widths[i - n_nodes];
    }
    return source;
}

/* Moves point number i by its force. */
static void move_point(descent *d, size_t i, const double force[2])
{
    double *x = d->xs + 2 * i, *move = d->moves + 2 * i, to[2], square = 0;
    for (int k = 0; k < 2; k++) {
        square += force[k] * force[k];
        to[k] = x[k] + d->momentum * move[k] + d->step * force[k] / d->domain->lengths[k];
    }
    d->squares[i] = square / (d->widths[i] * d->widths[i]);
    const bool settled = d->field.settle(d->field.data, to, &d->c->points[i]);
    for (int k = 0; k < 2; k++) {
        move[k] = settled ? koksma__torus_difference(x[k], to[k]) : 0;
        x[k] = settled ? to[k] : x[k];
    }
    if (d->update) {
        d->widths[i] = d->field.width(d->field.data, x);
    }
}

/* Moves the points of one block of groups (source_tree.h). */
static koksma_status move_block(void *context, size_t block)
{
    descent *d = context;
    const koksma__source_tree *t = &d->tree;
    for (size_t group = block * BLOCK; group < (block + 1) * BLOCK && group < t->n_groups; group++) {
        double force[KOKSMA__SOURCE_GROUP][2];
        koksma__source_forces(t, group, d->field.n_nodes, force);
        for (uint32_t at = t->groups[group]; at < t->groups[group + 1]; at++) {
            if (t->order[at] >= d->field.n_nodes) {
                move_point(d, t->order[at] - d->field.n_nodes, force[at - t->groups[group]]);
            }
        }
    }
    return KOKSMA_OK;
}

/* Returns whether the descent may end. The squares of the forces are summed in the order of the points, so that the
   result does not depend on the number of threads. */
static bool converged(descent *d)
{
    const double limit = TOLERANCE * d->c->params[1];
    double sum = 0;
    for (size_t i = 0; i < d->c->n; i++) {
        sum += d->squares[i];
    }
    d->wait = sum < 0.81 * d->least ? 0 : d->wait + 1;
    d->least = d->wait ? d->least : sum;
    return sum <= limit * limit * (double)d->c->n || d->wait >= PATIENCE;
}

static koksma_status descend(descent *d)
{
    const int fixed = (int)d->c->params[0], steps = fixed ? fixed : MOST_STEPS;
    koksma__phases phases = {0};
    for (int t = 0; t < steps; t++) {
        d->momentum = t < SETTLING ? 0.5 : t < LOCKED ? 0.9 : 0.95;
        d->update = t < SETTLING || (t <= LOCKED && t % 100 == 0);
        phases.begin = (double)t / steps;
        const koksma_run run = koksma__phase_run(&phases, d->c->run, 0);
        KOKSMA__TRY(koksma__source_tree_build(&d->tree, source_of, d, &run));
        KOKSMA__TRY(koksma__parallel(&run, (d->tree.n_groups + BLOCK - 1) / BLOCK, move_block, d));
        if (!fixed && converged(d) && t >= LEAST_STEPS) {
            break;
        }
    }
    return KOKSMA_OK;
}

static koksma_status start(descent *d)
{
    const size_t n = d->c->n, sources = d->field.n_nodes + n, bytes = 6 * n * sizeof *d->xs;
    KOKSMA__FAIL_IF(sources >= UINT32_MAX, KOKSMA_N, "gaussian-blue-noise: n = %zu is too large %s", n,
                    d->domain->what);
    KOKSMA__TRY(koksma__source_tree_init(&d->tree, d->domain, sources));
    d->xs = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(d->xs, bytes);
    d->moves = d->xs + 2 * n;
    d->widths = d->moves + 2 * n;
    d->squares = d->widths + n;
    memset(d->moves, 0, 2 * n * sizeof *d->moves);
    for (size_t i = 0; i < n; i++) {
        KOKSMA__TRY(koksma__look(d->c->run, i, 0));
        d->domain->draw(d->domain->data, d->c->seed, i, &d->c->points[i]);
        d->domain->place(d->domain->data, &d->c->points[i], d->xs + 2 * i);
        d->widths[i] = d->field.width(d->field.data, d->xs + 2 * i);
    }
    return KOKSMA_OK;
}

koksma_status koksma__choose_gaussian(const koksma__choice *c)
{
    descent d = {.c = c, .domain = c->domain, .step = c->params[2], .least = INFINITY};
    koksma_status status = c->domain->open_field(c->domain, c->n, c->params[1], c->run, &d.field);
    status = status ? status : start(&d);
    status = status ? status : descend(&d);
    if (d.field.close) {
        d.field.close(d.field.data);
    }
    free(d.field.nodes);
    koksma__source_tree_fini(&d.tree);
    free(d.xs);
    return status;
}
