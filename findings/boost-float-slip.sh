#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: uniform_01<float> or uniform_real_distribution<float> on Boost's sobol(2) gives the points of uniform_01<double>,
# rounded: at worst a coordinate is 1.
# Seen: a coordinate that rounds to 1 is refused and the next number taken in its place, as is right for random numbers. But
# the engine hands out coordinates in turn: after the first refusal, in point 16,843,008 (2^24 + 2^16 + 2^8), x is what was
# y, and y the x of the next point: integrands of unlike coordinates are sampled with the roles exchanged.
# Packages: libboost1.74-dev 1.74.0+ds1-21 (Debian bookworm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq libboost1.74-dev=1.74.0+ds1-21 2>/dev/null
dpkg-deb -x ./*.deb .
cat >slip.cpp <<'END'
#include <boost/random/sobol.hpp>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <cstdio>

template <class Distribution> bool slips(const char *name, Distribution single)
{
    boost::random::uniform_01<double> exact;
    boost::random::sobol singles(2), doubles(2);
    const auto near = [](double a, double b) { return std::fabs(a - b) < 1e-6; };
    long first = -1, exchanged = 0;
    double next = exact(doubles);
    for (long i = 0; i < 17000000; i++) {
        const double x = next, y = exact(doubles), u = single(singles), v = single(singles);
        next = exact(doubles);
        if (first < 0 && !(near(u, x) && near(v, y)))
            first = i;
        else if (first >= 0)
            exchanged += near(u, y) && near(v, next);
    }
    std::printf("%s<float>: the first other point is %ld, exchanged after it: %ld of %ld\n", name, first, exchanged,
                17000000 - first - 1);
    return first == 16843008 && exchanged == 17000000 - first - 1;
}

int main()
{
    const bool one = slips("uniform_01", boost::random::uniform_01<float>());
    const bool other = slips("uniform_real_distribution", boost::random::uniform_real_distribution<float>(0, 1));
    return one && other ? 0 : 1;
}
END
g++ -O2 -isystem usr/include -o slip slip.cpp
./slip
