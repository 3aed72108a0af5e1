/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Trees of <search.h>, as treaps: each node has a hash of its own address as priority, and no child has a higher one than
 * its parent, so that the depth is logarithmic whatever the order of the keys is (Seidel & Aragon 1996).
 */
#if defined(_WIN32) || defined(__APPLE__)
#include "core/platform/search_tree.h"

#include <stdint.h>
#include <stdlib.h>

typedef struct node {
    const void *key; /* the first member: a node's address is that of its key */
    uint64_t priority;
    struct node *child[2];
} node;

static uint64_t priority_of(const node *n)
{
    uint64_t x = (uint64_t)(uintptr_t)n;
    x = (x ^ x >> 31) * UINT64_C(0x7fb5d329728ea185);
    x = (x ^ x >> 27) * UINT64_C(0x81dadef4bc2dd44d);
    return x ^ x >> 33;
}

void *koksma__tfind(const void *key, void *const *root, koksma__tree_compare *compare)
{
    node *at = root ? *root : NULL;
    for (int order; at && (order = compare(key, at->key)); at = at->child[order > 0]) {
    }
    return at;
}

/* Splits a tree into the keys below and above `key`, which it does not have. */
static void split(node *tree, const void *key, koksma__tree_compare *compare, node *parts[2])
{
    node **ends[2] = {&parts[0], &parts[1]};
    while (tree) {
        const int below = compare(key, tree->key) > 0; /* the node is below the key, and so is its child 0 */
        *ends[!below] = tree;
        ends[!below] = &tree->child[below];
        tree = *ends[!below];
    }
    *ends[0] = *ends[1] = NULL;
}

void *koksma__tsearch(const void *key, void **root, koksma__tree_compare *compare)
{
    node *found = koksma__tfind(key, root, compare), *new = found || !root ? NULL : malloc(sizeof *new);
    if (!new) {
        return found;
    }
    *new = (node){.key = key, .priority = priority_of(new)};
    node *tree = *root, *above = NULL;
    int side = 0;
    while (tree && tree->priority >= new->priority) {
        above = tree;
        side = compare(key, tree->key) > 0;
        tree = tree->child[side];
    }
    split(tree, key, compare, new->child);
    if (above) {
        above->child[side] = new;
    } else {
        *root = new;
    }
    return new;
}

/* Trees are walked by rotating left children up, so that no stack is needed. */
void koksma__tdestroy(void *root, void (*release)(void *key))
{
    for (node *at = root; at;) {
        node *left = at->child[0];
        if (left) {
            at->child[0] = left->child[1];
            left->child[1] = at;
            at = left;
        } else {
            node *next = at->child[1];
            release((void *)(uintptr_t)at->key);
            free(at);
            at = next;
        }
    }
}

#endif
