/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sequences without a shift or scrambling: each coordinate gives the index of its point.
 *
 * For every coordinate k of the points and every coordinate j of a sequence the indices of 16 points are computed.
 * Where the points are some of the sequence's, all k give the same ones for the right j, whatever the order of points
 * and coordinates and however many are left out. So these are sorted, the one that most k share is taken,
 * all indices are computed from one coordinate, and every coordinate of every point is compared. If one coordinate
 * has no such j, it may be the equidistant one of Hammersley's points, which is linear in the index.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/parallel.h"
#include "core/status.h"
#include "identify/sample.h"

enum { PROBES = 16, LEAST_POINTS = 2, NEAR = 16, ENOUGH = 512 };

#define MOST_INDEX ((uint64_t)1 << 48)

/* What is looked for first: points in natural or Gray order, then any order of a sequence's own coordinates. */
typedef enum preference { ORDERED, SAME_COLUMNS, ANY } preference;

typedef struct hit {
    uint64_t indices[PROBES];
    int k, j;
} hit;

typedef struct plain {
    koksma__sample *s;
    const koksma__source *source;
    koksma__coordinate *coordinates;
    int n_coordinates;
    hit *hits;
    size_t n_hits, capacity;
    int *columns; /* columns[k]: coordinate of the source, or -1 */
    uint64_t *indices;
} plain;

static bool is_at(const plain *p, size_t i, int k, int j, uint64_t index)
{
    const koksma__coordinate *c = &p->coordinates[j];
    return fabs(koksma__x(p->s, i, (size_t)k) - (double)koksma__numerator(c, index) / c->whole) <= p->s->tolerance;
}

static size_t probe_at(const plain *p, int probe)
{
    const size_t n = p->s->points.n;
    return probe < 2 ? (size_t)probe : (size_t)(probe - 1) * (n - 1) / (PROBES - 2);
}

/* Adds the indices of the probes by coordinates k and j, if they are those of points. */
static koksma_status look(plain *p, int k, int j)
{
    hit h = {.k = k, .j = j};
    for (int probe = 0; probe < PROBES; probe++) {
        const size_t i = probe_at(p, probe);
        const uint64_t index = koksma__index_of(&p->coordinates[j], koksma__x(p->s, i, (size_t)k), p->s->tolerance);
        if (index >= MOST_INDEX || !is_at(p, i, k, j, index)) {
            return KOKSMA_OK;
        }
        h.indices[probe] = index;
    }
    KOKSMA__TRY(koksma__reserve(&p->hits, &p->capacity, p->n_hits + 1, sizeof *p->hits));
    p->hits[p->n_hits++] = h;
    return KOKSMA_OK;
}

static int by_indices(const void *a, const void *b)
{
    const hit *g = a, *h = b;
    for (int probe = 0; probe < PROBES; probe++) {
        if (g->indices[probe] != h->indices[probe]) {
            return g->indices[probe] < h->indices[probe] ? -1 : 1;
        }
    }
    return g->k != h->k ? g->k - h->k : g->j - h->j;
}

/* Assigns coordinates of the source by the hits [first, last), which have the same indices. Returns how many. */
static int assign(plain *p, size_t first, size_t last)
{
    int assigned = 0;
    for (int k = 0; k < p->s->points.dim; k++) {
        p->columns[k] = -1;
    }
    for (size_t h = first; h < last; h++) { /* the same coordinate where that will do, else the first */
        const int k = p->hits[h].k;
        if (p->hits[h].j != k && p->coordinates[p->hits[h].j].base >= p->s->points.n) {
            continue; /* i / base: the equidistant coordinate of Hammersley's points where their number is a prime */
        }
        assigned += p->columns[k] < 0;
        p->columns[k] = p->columns[k] < 0 || p->hits[h].j == k ? p->hits[h].j : p->columns[k];
    }
    return assigned;
}

/* Computes all indices and compares all points with them; without coordinate `except`, if that is not -1. */
static bool confirm(plain *p, int except)
{
    const int lead = except == 0;
    for (size_t i = 0; i < p->s->points.n; i++) {
        const uint64_t index =
            koksma__index_of(&p->coordinates[p->columns[lead]], koksma__x(p->s, i, (size_t)lead), p->s->tolerance);
        if (index >= MOST_INDEX) {
            return false;
        }
        p->indices[i] = index;
        for (int k = 0; k < p->s->points.dim; k++) {
            if (k != except && !is_at(p, i, k, p->columns[k], index)) {
                return false;
            }
        }
    }
    return true;
}

/* ---- The order of the indices ---- */

typedef struct order {
    uint64_t least, most, first, step;
    bool stepped, gray, distinct;
} order;

static int by_value(const void *a, const void *b)
{
    const uint64_t *u = a, *v = b;
    return (*u > *v) - (*u < *v);
}

static order order_of(const uint64_t *indices, size_t n, uint64_t *scratch)
{
    order o = {.least = UINT64_MAX,
               .first = indices[0],
               .step = indices[1] - indices[0],
               .stepped = true,
               .gray = true,
               .distinct = true};
    for (size_t i = 0; i < n; i++) {
        o.least = indices[i] < o.least ? indices[i] : o.least;
        o.most = indices[i] > o.most ? indices[i] : o.most;
        o.stepped = o.stepped && indices[i] == o.first + o.step * i;
        o.gray = o.gray && koksma__from_gray(indices[i]) == koksma__from_gray(indices[0]) + i;
    }
    memcpy(scratch, indices, n * sizeof *scratch);
    qsort(scratch, n, sizeof *scratch, by_value);
    for (size_t i = 1; i < n; i++) {
        o.distinct = o.distinct && scratch[i] != scratch[i - 1];
    }
    return o;
}

static koksma_status say(plain *p, const order *o, int except, const char *linear)
{
    const size_t n = p->s->points.n;
    const uint64_t span = o->most - o->least + 1;
    const bool whole = o->distinct && span == n, equal = o->stepped && o->step == 1;
    bool in_order = true;
    double difference = 0;
    for (int k = 0; k < p->s->points.dim; k++) {
        in_order = in_order && (k == except || p->columns[k] == k);
        for (size_t i = 0; i < n && k != except; i++) {
            const koksma__coordinate *c = &p->coordinates[p->columns[k]];
            difference = fmax(difference, fabs(koksma__x(p->s, i, (size_t)k) -
                                               (double)koksma__numerator(c, p->indices[i]) / c->whole));
        }
    }
    char text[200] = "";
    if (o->gray && !equal) {
        snprintf(text, sizeof text, "Gray order from number %llu; ", (unsigned long long)koksma__from_gray(o->first));
    } else if (o->stepped && !equal) {
        snprintf(text, sizeof text, "every %lldth point; ", (long long)o->step);
    } else if (!equal && whole) {
        snprintf(text, sizeof text, "another order of points %llu to %llu; ", (unsigned long long)o->least,
                 (unsigned long long)o->most);
    } else if (!equal) {
        snprintf(text, sizeof text, "%zu of points %llu to %llu%s; ", n, (unsigned long long)o->least,
                 (unsigned long long)o->most, o->distinct ? "" : ", some repeated");
    }
    char what[160];
    snprintf(what, sizeof what, "%s%s%s", except < 0 ? "" : "Hammersley: ", p->source->what,
             o->gray && !equal ? ", Gray order" : "");
    for (int k = 0; k < p->s->points.dim && (!in_order || except >= 0); k++) {
        koksma__append(what, sizeof what, k == except ? "%s i/n" : "%s %d", k ? "" : ", coordinates", p->columns[k]);
    }
    const char *relation = equal ? "equal" : whole ? "reordered" : o->gray ? "equal" : "part";
    return koksma__say(p->s, relation, what, in_order && except < 0 && (!o->gray || whole) ? p->source->spec : "",
                       o->gray && !equal && !whole ? koksma__from_gray(o->first) : o->least,
                       "%s%slargest difference %.3g in %zu points", linear, text, difference, n);
}

/* Whether coordinate k is (index + offset) / N with a whole number N of n or nearly n; describes it. */
static bool is_linear(plain *p, int k, const order *o, char text[160])
{
    const size_t n = p->s->points.n;
    size_t low = 0, high = 0;
    for (size_t i = 0; i < n; i++) {
        low = p->indices[i] < p->indices[low] ? i : low;
        high = p->indices[i] > p->indices[high] ? i : high;
    }
    const double from = koksma__x(p->s, low, (size_t)k),
                 step = (koksma__x(p->s, high, (size_t)k) - from) / (double)(o->most - o->least);
    const double whole = nearbyint(1 / step), offset = from * whole - (double)o->least;
    for (size_t i = 0; i < n; i++) {
        const double there = from + step * (double)(p->indices[i] - o->least);
        if (!(fabs(koksma__x(p->s, i, (size_t)k) - there) <= 2 * p->s->tolerance + 0x1p-50)) {
            return false;
        }
    }
    koksma__snprintf(text, 160, "coordinate %d is (i%+.6g) / %.0f, i the index; ", k, offset, whole);
    return fabs(1 / step - whole) < 1e-6 * whole && whole + 2 >= (double)n && whole <= (double)o->most + 3;
}

/* Looks at the hits [first, last), whose indices agree; with what is preferred. */
static koksma_status judge(plain *p, size_t first, size_t last, preference wanted, uint64_t *scratch)
{
    const int dim = p->s->points.dim, assigned = assign(p, first, last);
    int except = -1;
    if (assigned + 1 < dim || (assigned < dim && dim < 2)) {
        return KOKSMA_OK;
    }
    for (int k = 0; k < dim && assigned < dim; k++) {
        except = p->columns[k] < 0 ? k : except;
    }
    if (!confirm(p, except)) {
        return KOKSMA_OK;
    }
    const order o = order_of(p->indices, p->s->points.n, scratch);
    char text[160] = "";
    /* One coordinate has an index for all numbers: without others that agree, only an order says something. */
    const bool ordered = o.gray || (o.stepped && o.step == 1);
    if (wanted == ORDERED && !ordered) {
        return KOKSMA_OK;
    }
    for (int k = 0; k < dim && wanted == SAME_COLUMNS; k++) {
        if (k != except && p->columns[k] != k) {
            return KOKSMA_OK;
        }
    }
    /* A few points of one digital sequence may be points of some coordinates of another by chance. */
    for (int k = 0; k < dim && !ordered && !o.stepped && p->s->points.n < ENOUGH; k++) {
        if (p->columns[k] != k && except < 0) {
            return KOKSMA_OK;
        }
    }
    const bool evident = except >= 0 ? o.distinct && is_linear(p, except, &o, text)
                                     : ordered || (dim > 1 && p->s->points.n * (size_t)(dim - 1) >= 4) ||
                                           (o.distinct && o.most - o.least + 1 == p->s->points.n);
    return evident ? say(p, &o, except, text) : KOKSMA_OK;
}

static koksma_status compare_source(plain *p, preference wanted)
{
    const int dim = p->s->points.dim;
    uint64_t *scratch = malloc(p->s->points.n * sizeof *scratch);
    KOKSMA__REQUIRE_MEMORY(scratch, p->s->points.n * sizeof *scratch);
    koksma_status status = koksma__ask(p->s->run);
    p->n_hits = 0;
    for (int k = 0; k < dim && !status; k++) {
        for (int j = 0; j < p->n_coordinates && !status; j++) {
            if (dim <= 64 || abs(j - k) <= NEAR) {
                status = look(p, k, j);
            }
        }
    }
    if (p->n_hits) {
        qsort(p->hits, p->n_hits, sizeof *p->hits, by_indices);
    }
    for (size_t first = 0, last; first < p->n_hits && !status && !p->s->named; first = last) {
        for (last = first + 1;
             last < p->n_hits && !memcmp(p->hits[first].indices, p->hits[last].indices, sizeof p->hits->indices);) {
            last++;
        }
        status = judge(p, first, last, wanted, scratch);
    }
    free(scratch);
    return status;
}

static koksma_status compare_with(plain *p, const koksma__source *source, preference wanted)
{
    const int dims = koksma__source_dims(source, p->s->points.dim);
    p->source = source;
    p->n_coordinates = dims;
    koksma_status status = koksma__coordinates_init(source, p->s->points.dim, dims, &p->coordinates);
    status = status ? status : compare_source(p, wanted);
    koksma__coordinates_fini(p->coordinates, dims);
    return status;
}

koksma_status koksma__identify_plain(koksma__sample *s)
{
    const koksma__source *source;
    const int dim = s->points.dim;
    if (s->points.n < LEAST_POINTS) {
        return KOKSMA_OK;
    }
    plain p = {.s = s};
    p.columns = malloc((size_t)dim * sizeof *p.columns);
    p.indices = malloc(s->points.n * sizeof *p.indices);
    koksma_status status = p.columns && p.indices ? KOKSMA_OK : koksma__fail_memory(s->points.n * sizeof *p.indices);
    /* Some points of one sequence may be points of permuted coordinates of another: an order says more than no order. */
    for (preference wanted = ORDERED; wanted <= ANY && !status && !s->named; wanted++) {
        for (size_t i = 0; (source = koksma__source_at(i)) && !status && !s->named; i++) {
            status = dim > source->dims ? KOKSMA_OK : compare_with(&p, source, wanted);
        }
    }
    free(p.hits);
    free(p.columns);
    free(p.indices);
    return status;
}
