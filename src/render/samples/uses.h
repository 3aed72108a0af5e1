/* SPDX-License-Identifier: Apache-2.0 */
/* Uses: the purposes for which a renderer draws sample dimensions. */
#ifndef KOKSMA_RENDER_SAMPLES_USES_H
#define KOKSMA_RENDER_SAMPLES_USES_H

#include <koksma/render.h>

/* The numbers of the uses in uses.def. The numbers are part of the keys of random numbers, so they never change. The
   lights of a vertex have the numbers LIGHT, LIGHT + 1, ...; at bounce b, b times KOKSMA__USES_A_BOUNCE is added to
   every number. */
enum {
#define USE(id, number, name, dim, help) KOKSMA__USE_##id = (number),
#include "render/samples/uses.def"
#undef USE
    KOKSMA__USES_A_BOUNCE = 1 << 12
};

/* The uses that a scene and an integrator need. Native pairing assigns these uses to dimensions, and scope `image`
   draws their samples before the image is rendered. */
typedef struct koksma__use_list {
    bool lens, time;
    int lights;        /* number of light uses per bounce */
    bool light_choice; /* whether one of several lights is chosen at random */
    bool distance;     /* whether each ray may be scattered by a medium */
    /* number of vertices of a path; if it is above 1, each vertex also has the uses lobe, lobe-choice and roulette */
    int vertices;
} koksma__use_list;

/* Which coordinates a use takes from the points of its set. */
typedef struct koksma__place_of_use {
    int group;      /* index in the options of the group of uses that this use belongs to; -1: it is in no group */
    int first, dim; /* the first coordinate of the use, and the number of dimensions of the set */
    uint32_t lead;  /* the smallest number of the uses in the group */
} koksma__place_of_use;
koksma__place_of_use koksma__place_of_use_at(const koksma_render_options *options, int u);

/* Returns whether the image needs use u of uses.def. */
bool koksma__use_is_there(const koksma__use_list *uses, int u);

/* Returns the key of the set from which a use takes its coordinates. The key of a use without a group is the use
   itself. */
uint32_t koksma__set_key(const koksma__place_of_use *place, uint32_t use);

/* Returns the pattern spec of a use: that of its group, that of the use alone, or the one common to all uses. */
const koksma_spec *koksma__use_spec(const koksma_render_options *options, uint32_t use);

/* Returns the number of dimensions of the point sets for use u, which must not be in a group. A one-dimensional
   use takes one-dimensional sets if the pattern has them. From a pattern with a minimum distance, which is defined
   in the plane, it takes the first coordinate of two-dimensional sets. */
int koksma__use_set_dim(const koksma_spec *spec, int u);

/* Returns the index in uses.def of a use at any bounce, and the number of a use at the first. */
int koksma__use_index(uint32_t use);
uint32_t koksma__use_number(int u);

/* Returns the first dimension of a use in a native pattern, or the number of dimensions if use is UINT32_MAX. */
int koksma__use_dimension(const koksma__use_list *uses, uint32_t use);

#endif
