/* SPDX-License-Identifier: Apache-2.0 */
/* The darts of one round of koksma__disks_fill (dart_cover.h): which of them are kept. */
#include <stdlib.h>

#include "core/status.h"
#include "patterns/parts/dart_cover.h"

koksma_status koksma__darts_push(koksma__disks *s, koksma__dart new)
{
    if (s->n_darts == s->dart_room) {
        const size_t room = 2 * s->dart_room + 64;
        koksma__dart *darts = realloc(s->darts, room * sizeof *darts);
        if (!darts) {
            return koksma__fail_memory(room * sizeof *darts);
        }
        s->darts = darts;
        s->dart_room = room;
    }
    new.time = new.time << 32 | s->n_darts;
    s->darts[s->n_darts++] = new;
    return KOKSMA_OK;
}

static bool keep(koksma__disks *s, koksma__dart *d);

/* Whether one of the darts first .. end-1 was there before d, is near to it, and was kept; (u, v) is added to their
   places. */
static inline bool stopped_by(koksma__disks *s, const koksma__dart *d, size_t first, size_t end, double u, double v)
{
    const double d2 = s->d * s->d, x = d->x - u, y = d->y - v;
    for (koksma__dart *e = s->darts + first; e < s->darts + end; e++) {
        const double a = e->x - x, b = e->y - y;
        if (((a * a + b * b < d2) & (e->time < d->time)) && keep(s, e)) {
            return true;
        }
    }
    return false;
}

/* The darts of neighbouring cells of a row are neighbours in the list. */
static bool stopped(koksma__disks *s, const koksma__dart *d)
{
    const int cells = (int)s->cells, cell_x = (int)d->cell_x;
    for (int r = -2; r <= 2; r++) {
        const int y = (int)d->cell_y + r, v = y < 0 ? -1 : y >= cells;
        const uint32_t *row = s->starts + (size_t)(y - v * cells) * s->cells;
        const int low = cell_x - 2, high = cell_x + 2;
        if ((low < 0 && stopped_by(s, d, row[low + cells], row[cells], -1, v)) ||
            (high >= cells && stopped_by(s, d, row[0], row[high + 1 - cells], 1, v)) ||
            stopped_by(s, d, row[low < 0 ? 0 : low], row[high < cells ? high + 1 : cells], 0, v)) {
            return true;
        }
    }
    return false;
}

/* A dart is kept unless one that came before it, is near to it and is kept itself. The darts that this asks for come
   ever earlier, so it ends; and chains of near darts in order of time are short. */
static bool keep(koksma__disks *s, koksma__dart *d)
{
    if (!d->decided) {
        d->kept = !stopped(s, d);
        d->decided = true;
    }
    return d->kept;
}

static int earlier(const void *a, const void *b)
{
    const koksma__dart *d = a, *e = b;
    return (d->time > e->time) - (d->time < e->time);
}

void koksma__darts_sort(koksma__disks *s, size_t count)
{
    qsort(s->darts, count, sizeof *s->darts, earlier);
}

size_t koksma__darts_decide(koksma__disks *s)
{
    size_t kept = 0, cell = 0;
    for (size_t i = 0; i < s->n_darts; i++) {
        while (cell <= (size_t)s->darts[i].cell_y * s->cells + s->darts[i].cell_x) {
            s->starts[cell++] = (uint32_t)i;
        }
    }
    while (cell <= (size_t)s->cells * s->cells) {
        s->starts[cell++] = (uint32_t)s->n_darts;
    }
    for (size_t i = 0; i < s->n_darts; i++) {
        keep(s, &s->darts[i]);
    }
    for (size_t i = 0; i < s->n_darts; i++) {
        const koksma__dart d = s->darts[i];
        s->darts[kept] = d;
        kept += d.kept;
    }
    return kept;
}
