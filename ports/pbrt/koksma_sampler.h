/* SPDX-License-Identifier: Apache-2.0 */
/*
 * KoksmaSampler: a sampler of pbrt-v4 over koksma/sampler.h: Owen-scrambled Sobol' points. Each pixel has a domain, each
 * sample dimension that pbrt asks for a use in it, so that no dimension runs out; sample i of a use is sample i of the
 * pixel. Get1D has the first coordinate of Get2D, so that samples of a pixel which ask for other kinds of numbers in one
 * dimension, as their paths differ, are still of one sequence. Any number of samples works; powers of two are best.
 * Nothing depends on the order of pixels, on tiles or on threads.
 *
 * pbrt-v4.patch names the class where pbrt names samplers (docs/renderers.md: "pbrt-v4").
 */
#ifndef PBRT_KOKSMA_SAMPLER_H
#define PBRT_KOKSMA_SAMPLER_H

#include <pbrt/pbrt.h>

#include <pbrt/base/sampler.h>
#include <pbrt/util/print.h>
#include <pbrt/util/pstd.h>
#include <pbrt/util/vecmath.h>

#include <koksma/sampler.h>

#include <string>

namespace pbrt
{

class KoksmaSampler
{
  public:
    explicit KoksmaSampler(int samplesPerPixel, int seed = 0) : samplesPerPixel(samplesPerPixel), seed(seed)
    {
    }

    PBRT_CPU_GPU static constexpr const char *Name()
    {
        return "KoksmaSampler";
    }

    /* Parameters of scene files: "pixelsamples" and "seed". */
    static KoksmaSampler *Create(const ParameterDictionary &parameters, const FileLoc *loc, Allocator alloc);

    PBRT_CPU_GPU int SamplesPerPixel() const
    {
        return samplesPerPixel;
    }

    PBRT_CPU_GPU void StartPixelSample(Point2i p, int sampleIndex, int dim)
    {
        pixel = koksma_domain_of_pixel(uint32_t(seed), uint32_t(p.x), uint32_t(p.y));
        index = uint32_t(sampleIndex);
        dimension = uint32_t(dim);
    }

    PBRT_CPU_GPU Float Get1D()
    {
        return Next(1).x;
    }

    PBRT_CPU_GPU Point2f Get2D()
    {
        return Next(2);
    }

    PBRT_CPU_GPU Point2f GetPixel2D()
    {
        return Get2D();
    }

    Sampler Clone(Allocator alloc)
    {
        return alloc.new_object<KoksmaSampler>(*this);
    }

    std::string ToString() const
    {
        return StringPrintf("[ KoksmaSampler samplesPerPixel: %d seed: %d index: %d dimension: %d ]", samplesPerPixel,
                            seed, index, dimension);
    }

  private:
    PBRT_CPU_GPU Point2f Next(int count)
    {
        const koksma_domain domain = koksma_domain_of_use(pixel, dimension);
        Float u[2];
        dimension += count;
#ifdef PBRT_FLOAT_AS_DOUBLE
        koksma_sobol_2d(domain, index, u);
#else
        koksma_sobol_2f(domain, index, u);
#endif
        return {u[0], u[1]};
    }

    int samplesPerPixel, seed;
    koksma_domain pixel = {};
    uint32_t index = 0, dimension = 0;
};

} // namespace pbrt

#endif
