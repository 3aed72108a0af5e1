/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma/sampler.h for C++11 and later: domains as values with constexpr keys, samples returned as arrays, numbers of
 * coordinates that the compiler checks. The same bits as sampler.h; no library, no allocation.
 *
 *     enum use : uint32_t { film, lens };
 *     const koksma::domain pixel = koksma::domain::of_pixel(seed, x, y);
 *     for (uint32_t i = 0; i < spp; i++) {
 *         const std::array<float, 2> at = pixel.of_use(film).draw<2>(i);
 *         auto [u, v] = pixel.of_use(lens).draw<2, double>(i); // C++17
 *         ...
 *
 * draw() takes 1 to 4 coordinates of the Owen-scrambled Sobol' sequence, koksma_sobol_2d and its like. A domain converts to
 * koksma_domain, for the other functions of sampler.h: koksma_cmj_2d(pixel.of_use(film), i, 4, 4, xy).
 */
#ifndef KOKSMA_HPP
#define KOKSMA_HPP

#include <array>
#include <cstddef>
#include <cstdint>

#include "sampler.h"

namespace koksma {

namespace detail {

/* koksma_mix and koksma__derived as constants: C++11 allows one return in a constexpr function. */
constexpr std::uint64_t fold(std::uint64_t key)
{
    return key ^ key >> 32;
}

constexpr std::uint64_t mix(std::uint64_t key)
{
    return fold(key * UINT64_C(0xd6e8feb86659fd93));
}

constexpr std::uint64_t derived(std::uint64_t key, std::uint64_t purpose, std::uint32_t number)
{
    return mix(key ^ (purpose << 32 | 0x85a308d3u) ^ number * UINT64_C(0x9e3779b97f4a7c15));
}

inline void draw(koksma_domain d, std::uint32_t i, float (&xs)[1]) { xs[0] = koksma_sobol_1f(d, i); }
inline void draw(koksma_domain d, std::uint32_t i, float (&xs)[2]) { koksma_sobol_2f(d, i, xs); }
inline void draw(koksma_domain d, std::uint32_t i, float (&xs)[3]) { koksma_sobol_3f(d, i, xs); }
inline void draw(koksma_domain d, std::uint32_t i, float (&xs)[4]) { koksma_sobol_4f(d, i, xs); }
inline void draw(koksma_domain d, std::uint32_t i, double (&xs)[1]) { xs[0] = koksma_sobol_1d(d, i); }
inline void draw(koksma_domain d, std::uint32_t i, double (&xs)[2]) { koksma_sobol_2d(d, i, xs); }
inline void draw(koksma_domain d, std::uint32_t i, double (&xs)[3]) { koksma_sobol_3d(d, i, xs); }
inline void draw(koksma_domain d, std::uint32_t i, double (&xs)[4]) { koksma_sobol_4d(d, i, xs); }

template <std::size_t... K> struct indices {};
template <std::size_t N, std::size_t... K> struct first : first<N - 1, N - 1, K...> {};
template <std::size_t... K> struct first<0, K...> { using type = indices<K...>; };

template <class T, std::size_t N, std::size_t... K>
std::array<T, N> array_of(const T (&xs)[N], indices<K...>)
{
    return {{xs[K]...}};
}

} // namespace detail

/* A stream of samples: see koksma_domain. Equal keys give equal samples. */
class domain {
public:
    constexpr explicit domain(std::uint64_t key) : key_(key) {}

    /* The domain of a pixel of the image with this seed: koksma_domain_of_pixel. */
    static constexpr domain of_pixel(std::uint64_t seed, std::uint32_t x, std::uint32_t y)
    {
        return domain(detail::mix(detail::mix(detail::mix(seed ^ UINT64_C(0x13198a2e03707344)) ^
                                              (static_cast<std::uint64_t>(y) << 32 | x))));
    }

    /* The domain of one use of the samples, such as the lens: koksma_domain_of_use. */
    constexpr domain of_use(std::uint32_t use) const { return domain(detail::derived(key_, 0x243f6a88u, use)); }

    /* The domain of sample i, for splitting it into a variable number of subsamples: koksma_domain_of_sample. */
    constexpr domain of_sample(std::uint32_t i) const { return domain(detail::derived(key_, 0xa4093822u, i)); }

    constexpr std::uint64_t key() const { return key_; }

    operator koksma_domain() const
    {
        koksma_domain d;
        d.key = key_;
        return d;
    }

    /* Sample i in N dimensions, 1 to 4, as floats or doubles in [0,1). */
    template <std::size_t N, class T = float> std::array<T, N> draw(std::uint32_t i) const
    {
        static_assert(N >= 1 && N <= 4, "draw<N>: N, the number of coordinates, is 1 to 4");
        T xs[N];
        detail::draw(*this, i, xs);
        return detail::array_of(xs, typename detail::first<N>::type());
    }

    /* Fills a whole array, whose size says how many coordinates. */
    template <class T, std::size_t N> void draw(std::uint32_t i, T (&xs)[N]) const
    {
        static_assert(N >= 1 && N <= 4, "draw: an array of 1 to 4 coordinates");
        detail::draw(*this, i, xs);
    }

    friend constexpr bool operator==(domain a, domain b) { return a.key_ == b.key_; }
    friend constexpr bool operator!=(domain a, domain b) { return a.key_ != b.key_; }

private:
    std::uint64_t key_;
};

} // namespace koksma

#endif
