/* SPDX-License-Identifier: Apache-2.0 */
/* Joins and frees plans. A plan owns all its lists, texts and nested lists. Two plans are joined by moving the
   items of one plan's lists to the end of the other's, so that no text is copied or freed twice. */
#include "study/plan/plan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"

/* Moves the n_from items of *from to the end of the n items of *to. */
static koksma_status join(void **to, size_t *n, void **from, size_t *n_from, size_t item_size)
{
    if (*n_from == 0) {
        return KOKSMA_OK;
    }
    char *all = realloc(*to, (*n + *n_from) * item_size);
    KOKSMA__REQUIRE_MEMORY(all, (*n + *n_from) * item_size);
    memcpy(all + *n * item_size, *from, *n_from * item_size);
    free(*from);
    *to = all;
    *n += *n_from;
    *from = NULL;
    *n_from = 0;
    return KOKSMA_OK;
}

/* Appends `between` and `from` to *to; if *to is NULL, it becomes a copy of `from`. */
static koksma_status join_text(char **to, const char *between, const char *from)
{
    if (!*to) {
        *to = strdup(from);
        return *to ? KOKSMA_OK : koksma__fail_memory(strlen(from));
    }
    const size_t size = strlen(*to) + strlen(between) + strlen(from) + 1;
    char *text = malloc(size);
    KOKSMA__REQUIRE_MEMORY(text, size);
    snprintf(text, size, "%s%s%s", *to, between, from);
    free(*to);
    *to = text;
    return KOKSMA_OK;
}

koksma_status koksma__plan_own(koksma__plan *p)
{
    koksma__plan_part *part = calloc(1, sizeof *part);
    char *title = strdup(p->title), *about = p->about ? strdup(p->about) : NULL;
    if (!part || !title || (p->about && !about)) {
        free(part);
        free(title);
        free(about);
        return koksma__fail_memory(sizeof *part + strlen(p->title));
    }
    *part = (koksma__plan_part){.title = title,
                                .about = about,
                                .metric = p->metric,
                                .asks = p->n_tables || p->n_questions,
                                .discrepancies = {0, p->n_discrepancies},
                                .images = {0, p->n_images},
                                .figures = {0, p->n_figures}};
    p->metric = NULL;
    p->parts = part;
    p->n_parts = 1;
    return KOKSMA_OK;
}

/* Changes the indices of blocks and parts in q to those that they have after q's lists are appended to p's. */
static void shift(const koksma__plan *p, koksma__plan *q)
{
    for (size_t i = 0; i < q->n_parts; i++) {
        for (int end = 0; end < 2; end++) {
            q->parts[i].discrepancies[end] += p->n_discrepancies;
            q->parts[i].images[end] += p->n_images;
            q->parts[i].figures[end] += p->n_figures;
        }
    }
    for (size_t t = 0; t < q->n_tables; t++) {
        q->tables[t].images += p->n_images;
        q->tables[t].part += p->n_parts;
    }
    for (size_t i = 0; i < q->n_questions; i++) {
        q->questions[i].part += p->n_parts;
    }
    for (size_t i = 0; i < q->n_conclusions; i++) {
        q->conclusions[i].part += p->n_parts;
    }
}

koksma_status koksma__plan_append(koksma__plan *p, koksma__plan *q)
{
    koksma_status status = join_text(&p->name, "+", q->name);
    status = status ? status : join_text(&p->title, "; ", q->title);
    shift(p, q);
    if (!status && q->about) {
        status = join_text(&p->about, " ", q->about);
    }
#define JOIN(items)                                                                                                  \
    status = status ? status                                                                                         \
                    : join((void **)&p->items, &p->n_##items, (void **)&q->items, &q->n_##items, sizeof *p->items)
    JOIN(parts);
    JOIN(discrepancies);
    JOIN(images);
    JOIN(tables);
    JOIN(figures);
    JOIN(questions);
    JOIN(conclusions);
#undef JOIN
    koksma__plan_fini(q);
    return status;
}

static void free_left_out(koksma__left_out *of)
{
    free(of->is);
    free(of->unmeasured);
    koksma__texts_fini(&of->lines);
}

void koksma__texts_fini(koksma__texts *texts)
{
    for (size_t i = 0; i < texts->n; i++) {
        free(texts->at[i]);
    }
    free(texts->at);
    *texts = (koksma__texts){0};
}

static void free_table(koksma__table *t)
{
    for (size_t r = 0; r < t->n_rows; r++) {
        free(t->rows[r].pattern);
        free(t->rows[r].label);
    }
    for (size_t n = 0; n < t->n_notes; n++) {
        free(t->notes[n].pattern);
        free(t->notes[n].reason);
    }
    KOKSMA__FREE(t->n.at, t->rows, t->notes, t->id, t->title, t->scene, t->measure, t->also, t->symbol);
}

static void free_conclusion(koksma__conclusion *c)
{
    koksma__texts *const lists[] = {&c->tables, &c->by, &c->than, &c->figures, &c->patterns, &c->against, &c->beside};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        koksma__texts_fini(lists[i]);
    }
    KOKSMA__FREE(c->says, c->remark, c->images, c->discrepancies, c->metric);
}

static void free_image_block(koksma__image_block *b)
{
    free(b->id);
    koksma__texts_fini(&b->scenes);
    koksma__texts_fini(&b->variants);
    koksma__texts_fini(&b->patterns);
    free(b->spp.at);
    free_left_out(&b->left_out);
    for (size_t r = 0; r < b->n_references; r++) {
        free(b->references[r].name);
        free(b->references[r].pattern);
    }
    free(b->references);
    koksma__texts_fini(&b->metrics);
}

void koksma__plan_fini(koksma__plan *p)
{
    for (size_t i = 0; i < p->n_discrepancies; i++) {
        free(p->discrepancies[i].id);
        koksma__texts_fini(&p->discrepancies[i].patterns);
        koksma__texts_fini(&p->discrepancies[i].measures);
        koksma__texts_fini(&p->discrepancies[i].warps);
        free(p->discrepancies[i].n.at);
        free_left_out(&p->discrepancies[i].left_out);
    }
    for (size_t i = 0; i < p->n_images; i++) {
        free_image_block(&p->images[i]);
    }
    for (size_t i = 0; i < p->n_tables; i++) {
        free_table(&p->tables[i]);
    }
    for (size_t i = 0; i < p->n_figures; i++) {
        KOKSMA__FREE(p->figures[i].id, p->figures[i].title, p->figures[i].pattern, p->figures[i].scene,
                     p->figures[i].variant, p->figures[i].adaptive, p->figures[i].warp, p->figures[i].printed);
        koksma__texts_fini(&p->figures[i].spaces);
    }
    for (size_t i = 0; i < p->n_questions; i++) {
        KOKSMA__FREE(p->questions[i].id, p->questions[i].title, p->questions[i].discrepancies, p->questions[i].images,
                     p->questions[i].metric);
        for (size_t g = 0; g < p->questions[i].n_groups; g++) {
            free(p->questions[i].groups[g].title);
            koksma__texts_fini(&p->questions[i].groups[g].scenes);
        }
        free(p->questions[i].groups);
    }
    for (size_t i = 0; i < p->n_conclusions; i++) {
        free_conclusion(&p->conclusions[i]);
    }
    for (size_t i = 0; i < p->n_parts; i++) {
        free(p->parts[i].title);
        free(p->parts[i].about);
        free(p->parts[i].metric);
    }
    koksma__texts_fini(&p->metrics);
    KOKSMA__FREE(p->parts, p->questions, p->conclusions, p->discrepancies, p->images, p->tables, p->figures, p->name,
                 p->title, p->about, p->metric);
    *p = (koksma__plan){0};
}

koksma_status koksma__texts_add(koksma__texts *texts, const char *text)
{
    char **line = koksma__add_one(&texts->at, &texts->n, sizeof *line);
    KOKSMA__TRY(line ? KOKSMA_OK : KOKSMA_MEMORY);
    *line = strdup(text);
    texts->n -= !*line;
    return *line ? KOKSMA_OK : koksma__fail_memory(strlen(text));
}

bool koksma__texts_have(const koksma__texts *texts, const char *text)
{
    for (size_t i = 0; i < texts->n; i++) {
        if (!strcmp(texts->at[i], text)) {
            return true;
        }
    }
    return false;
}

bool koksma__wholes_have(const koksma__wholes *sorted, long long value)
{
    size_t low = 0, high = sorted->n;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        *(sorted->at[middle] <= value ? &low : &high) = middle;
    }
    return sorted->n && sorted->at[low] == value;
}

bool koksma__plan_block_makes(const koksma__discrepancy_block *block, const char *measure, const char *pattern,
                              long long n, long long dim)
{
    return !block->warps.n && block->dim == dim && koksma__texts_have(&block->measures, measure) &&
           koksma__texts_have(&block->patterns, pattern) && koksma__wholes_have(&block->n, n);
}

const koksma__table *koksma__plan_table_of(const koksma__plan *p, size_t part, const char *id)
{
    for (size_t i = 0; i < p->n_tables; i++) {
        if (p->tables[i].part == part && !strcmp(p->tables[i].id, id)) {
            return &p->tables[i];
        }
    }
    return NULL;
}

const koksma__figure *koksma__plan_figure_of(const koksma__plan *p, size_t part, const char *id)
{
    const size_t all[] = {0, p->n_figures}, *range = p->n_parts ? p->parts[part].figures : all;
    for (size_t i = range[0]; i < range[1]; i++) {
        if (!strcmp(p->figures[i].id, id)) {
            return &p->figures[i];
        }
    }
    return NULL;
}

const koksma__table_row *koksma__plan_row_of(const koksma__table *t, const char *pattern)
{
    for (size_t r = 0; r < t->n_rows; r++) {
        if (!strcmp(t->rows[r].pattern, pattern)) {
            return &t->rows[r];
        }
    }
    return NULL;
}
