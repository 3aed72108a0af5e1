/* SPDX-License-Identifier: Apache-2.0 */
/* koksma.hpp gives the bits of sampler.h, and its keys are constants. WRONG=1 and 2 must not compile. */
#include <koksma/koksma.hpp>

constexpr koksma::domain constant = koksma::domain::of_pixel(7, 3, 5).of_use(2).of_sample(9);
static_assert(constant.key() != 0, "keys are constants");

template <std::size_t N, class T> static int differs(koksma::domain d, uint32_t i, const T (&expected)[N])
{
    const std::array<T, N> given = d.draw<N, T>(i);
    T filled[N];
    d.draw(i, filled);
    int wrong = 0;
    for (std::size_t k = 0; k < N; k++) {
        wrong += given[k] < expected[k] || given[k] > expected[k] || filled[k] < given[k] || filled[k] > given[k];
    }
    return wrong;
}

int main()
{
    int wrong = 0;
    for (uint32_t i = 0; i < 1000; i++) {
        const koksma_domain c = koksma_domain_of_sample(koksma_domain_of_use(koksma_domain_of_pixel(i << 20 | 7, i, 3 * i), i % 5), i);
        const koksma::domain d = koksma::domain::of_pixel(i << 20 | 7, i, 3 * i).of_use(i % 5).of_sample(i);
        float f1[1] = {koksma_sobol_1f(c, i)}, f2[2], f3[3], f4[4];
        double d1[1] = {koksma_sobol_1d(c, i)}, d2[2], d3[3], d4[4];
        koksma_sobol_2f(c, i, f2);
        koksma_sobol_3f(c, i, f3);
        koksma_sobol_4f(c, i, f4);
        koksma_sobol_2d(c, i, d2);
        koksma_sobol_3d(c, i, d3);
        koksma_sobol_4d(c, i, d4);
        wrong += d.key() != c.key || koksma_domain(d).key != c.key || !(d == koksma::domain(c.key)) || d != d;
        wrong += differs(d, i, f1) + differs(d, i, f2) + differs(d, i, f3) + differs(d, i, f4);
        wrong += differs(d, i, d1) + differs(d, i, d2) + differs(d, i, d3) + differs(d, i, d4);
    }
#if WRONG == 1
    wrong += constant.draw<5>(0)[0] > 0;
#elif WRONG == 2
    std::array<float, 2> two = constant.draw<3>(0);
    wrong += two[0] > 1;
#endif
    return wrong != 0;
}
