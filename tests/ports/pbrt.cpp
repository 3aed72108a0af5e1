/* SPDX-License-Identifier: Apache-2.0 */
/*
 * KoksmaSampler in pbrt-v4, through pbrt's Sampler: made by its name and parameters, it gives the numbers of
 * koksma/sampler.h, whatever is asked before, from any dimension on, and after Clone; every elementary interval of 2^m
 * samples has one.
 */
#include <pbrt/paramdict.h>
#include <pbrt/samplers.h>

#include <cstdio>

/* Stands in for pbrt's parameters, whose file needs most of pbrt. */
namespace pbrt
{
PBRTOptions *Options;

int ParameterDictionary::GetOneInt(const std::string &name, int missing) const
{
    return name == "pixelsamples" ? 64 : name == "seed" ? 7 : missing;
}

void ParameterDictionary::ReportUnused() const
{
}
} // namespace pbrt

using namespace pbrt;

static int failures;

static void check(bool holds, const char *what, int a, int b, int c)
{
    if (!holds && ++failures < 10) {
        std::printf("%s: %d %d %d\n", what, a, b, c);
    }
}

/* The header's number of a pixel, a dimension and a sample. */
static Point2f expected(int seed, Point2i p, int dimension, int sample)
{
    Float u[2];
    const koksma_domain pixel = koksma_domain_of_pixel(uint32_t(seed), uint32_t(p.x), uint32_t(p.y));
#ifdef PBRT_FLOAT_AS_DOUBLE
    koksma_sobol_2d(koksma_domain_of_use(pixel, dimension), sample, u);
#else
    koksma_sobol_2f(koksma_domain_of_use(pixel, dimension), sample, u);
#endif
    return {u[0], u[1]};
}

/* Asks for a pixel's numbers as a path would: film, time, lens, and then some of each bounce. */
static void check_path(Sampler sampler, int seed, Point2i p, int sample)
{
    int dimension = 0;
    sampler.StartPixelSample(p, sample);
    check(sampler.GetPixel2D() == expected(seed, p, 0, sample), "GetPixel2D", p.x, p.y, sample);
    dimension += 2;
    for (int k = 0; k < 40; k++) {
        if (k % 3 == 0) {
            check(sampler.Get1D() == expected(seed, p, dimension, sample).x, "Get1D", p.x, dimension, sample);
            dimension += 1;
        } else {
            check(sampler.Get2D() == expected(seed, p, dimension, sample), "Get2D", p.x, dimension, sample);
            dimension += 2;
        }
    }
    sampler.StartPixelSample(p, sample, 33);
    check(sampler.Get2D() == expected(seed, p, 33, sample), "from dimension 33", p.x, p.y, sample);
}

/* One of 2^m samples in each of 2^i x 2^(m-i) intervals, for all i. */
static void check_intervals(Sampler sampler, int m, Point2i p, int dimension)
{
    for (int i = 0; i <= m; i++) {
        std::vector<bool> seen(size_t(1) << m);
        for (int s = 0; s < 1 << m; s++) {
            sampler.StartPixelSample(p, s, dimension);
            const Point2f u = sampler.Get2D();
            const size_t at = size_t(u.y * (1 << (m - i))) << i | size_t(u.x * (1 << i));
            check(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1 && !seen[at], "elementary interval", m, i, s);
            seen[at] = true;
        }
    }
}

int main()
{
    PBRTOptions options;
    Options = &options;
    const int samples[] = {0, 63, 1, 17, 1 << 20};
    Sampler made = Sampler::Create("koksma", ParameterDictionary(), {8, 8}, nullptr, {});
    check(made.Is<KoksmaSampler>() && made.SamplesPerPixel() == 64, "Create", 0, 0, made.SamplesPerPixel());
    Sampler other = new KoksmaSampler(10, -3);
    check(other.SamplesPerPixel() == 10, "SamplesPerPixel", 0, 0, other.SamplesPerPixel());
    for (int sample : samples) {
        for (Point2i p : {Point2i(0, 0), Point2i(5, 3), Point2i(3, 5), Point2i(-2, 4000)}) {
            check_path(made, 7, p, sample);
            check_path(other, -3, p, sample);
        }
    }
    made.StartPixelSample({1, 2}, 3);
    made.Get1D();
    Sampler clone = made.Clone();
    check(clone.Get2D() == made.Get2D(), "Clone", 1, 2, 3);
    for (int m = 0; m <= 10; m++) {
        check_intervals(made, m, {m, 2 * m}, 0);
        check_intervals(made, m, {m, 2 * m}, 12);
    }
    options.pixelSamples = 5;
    check(Sampler::Create("koksma", ParameterDictionary(), {8, 8}, nullptr, {}).SamplesPerPixel() == 5, "--spp", 0, 0, 5);
    std::printf("%d failures, Float has %d bytes\n", failures, int(sizeof(Float)));
    return failures != 0;
}
