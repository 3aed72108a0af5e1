/* SPDX-License-Identifier: Apache-2.0 */
/* What a picture is said to take of the memory against what is allocated: the linker sends every call of the
   library's here (tests/CMakeLists.txt), and the largest sum of what is held at a time is the answer. */
#include <malloc.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

#include <koksma/adaptive.h>

#include "rendering.h"

#include "render/render.h"
#include "render/samples/samples.h"

void *__real_malloc(size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *at, size_t size);
void __real_free(void *at);
void *__wrap_malloc(size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *at, size_t size);
void __wrap_free(void *at);

static atomic_llong held, most;

static void *take(void *at)
{
    const long long now = at ? atomic_fetch_add(&held, (long long)malloc_usable_size(at)) : 0;
    const long long sum = now + (at ? (long long)malloc_usable_size(at) : 0);
    if (sum > atomic_load(&most)) { /* one thread */
        atomic_store(&most, sum);
    }
    return at;
}

static void give(void *at)
{
    atomic_fetch_sub(&held, at ? (long long)malloc_usable_size(at) : 0);
}

void *__wrap_malloc(size_t size)
{
    return take(__real_malloc(size));
}

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    return take(__real_aligned_alloc(alignment, size));
}

void *__wrap_calloc(size_t n, size_t size)
{
    return take(__real_calloc(n, size));
}

void *__wrap_realloc(void *at, size_t size)
{
    give(at);
    return take(__real_realloc(at, size));
}

void __wrap_free(void *at)
{
    give(at);
    __real_free(at);
}

enum { SIDE = 512, ROOM = 1 << 20 /* of one thread, and the scene's */ };

static const koksma_run alone = {.threads = 1};

static long long begin(void)
{
    const long long now = atomic_load(&held);
    atomic_store(&most, now);
    return now;
}

/* At least what is told, and not more than `share` above it. */
static void expect_size(const char *what, long long before, uint64_t told, double share)
{
    const long long taken = atomic_load(&most) - before;
    if (taken < (long long)told || (double)taken > (double)told * (1 + share) + ROOM) {
        fail_msg("%s: %llu bytes told, %lld taken", what, (unsigned long long)told, taken);
    }
}

/* Grey and coloured scenes, with layers and without, splatted and not. Splats of the rows that are at work are beside
   those of the picture, an eighth of these. */
TEST_CASE(films_take_what_is_told)
{
    static const char *const scenes[] = {"ball", "balls"};
    for (int c = 0; c < 8; c++) {
        koksma_layers layers;
        char what[64];
        const bool all = c & 1, splat = c & 2;
        koksma_scene *scene = shipped(scenes[c / 4]);
        koksma_render_options options = options_of(scene, "random", "utah", 1, SIDE);
        options.splat = splat;
        options.filter = koksma_filter_find("mitchell");
        const koksma_render_size size = koksma_render_size_of(scene, &options, all);
        const long long before = begin();
        assert_ok(all ? koksma_render_layers(scene, &options, &alone, &layers)
                      : koksma_render_only(scene, &options, &alone, &layers));
        snprintf(what, sizeof what, "%s%s%s", scenes[c / 4], all ? ", layers" : "", splat ? ", splatted" : "");
        expect_size(what, before, size.film, splat ? 0.15 : 0.01);
        assert_int_equal(size.samples, 0);
        const size_t channels = (size_t)layers.image.channels;
        assert_int_equal(size.file, 4 * SIDE * SIDE * (channels + (all ? 9 : 0)));
        koksma_layers_fini(&layers);
        koksma_scene_close(scene);
    }
}

/* A pattern over the whole image, in each pairing. */
TEST_CASE(samples_take_what_is_told)
{
    static const koksma_pairing pairings[] = {KOKSMA_PAIRING_SHUFFLED, KOKSMA_PAIRING_ALIGNED, KOKSMA_PAIRING_NATIVE};
    koksma_scene *scene = shipped("all");
    for (int p = 0; p < 3; p++) {
        koksma__sampler sampler;
        koksma_render_options options = options_of(scene, "random", "distribution", 2, SIDE / 2);
        options.scope = KOKSMA_SCOPE_IMAGE;
        options.pairing = pairings[p];
        options.depth = 1;
        const koksma__use_list uses = koksma__frame_uses(scene, &options);
        const uint64_t told = koksma_render_size_of(scene, &options, false).samples;
        const long long before = begin();
        assert_ok(koksma__image_samples(&options, &uses, &alone, &sampler));
        expect_size(koksma_pairing_name(pairings[p]), before, told, 0.01);
        sampler.release(&sampler);
    }
    koksma_scene_close(scene);
}

/* Every method, which asks for nothing after its first round: beside the pixels some keep a little more. */
TEST_CASE(methods_take_what_is_told)
{
    koksma_scene *scene = shipped("ball");
    const koksma_adaptive *method;
    for (size_t i = 0; (method = koksma_adaptive_at(i)); i++) {
        koksma_render_options options = options_of(scene, "jittered", "utah", 4, SIDE / 2);
        koksma_adaptive_options adaptive;
        koksma_layers layers;
        char text[64];
        snprintf(text, sizeof text, "%s:threshold=1e6", method->name);
        assert_ok(koksma_adaptive_parse(text, &adaptive));
        const uint64_t told =
            koksma_render_size_of(scene, &options, true).film + koksma_adaptive_size_of(&options, &adaptive);
        const long long before = begin();
        assert_ok(koksma_render_adaptive(scene, &options, &adaptive, &alone, &layers, NULL));
        expect_size(text, before, told, 0.15);
        koksma_layers_fini(&layers);
    }
    koksma_scene_close(scene);
}
