#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: SSJ's LatinHypercube, randomised, permutes the cells of each coordinate, as other packages do, so that its first
# half is a fair sample and coordinates of two designs may be put side by side.
# Seen: the first coordinate is not permuted, only moved within its cells: the points come in its order. A run that stops at
# half of the points has seen one half of the range, and the first coordinates of two independent designs are equal up to a
# cell: their correlation is 1 - 1 / n^2 for n points, not 0.
# Packages: ca.umontreal.iro.simul:ssj:3.3.2 (Maven Central)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mvn -q dependency:copy -Dartifact=ca.umontreal.iro.simul:ssj:3.3.2 -DoutputDirectory=.
cat >Order.java <<'END'
import umontreal.ssj.hups.LatinHypercube;
import umontreal.ssj.rng.MRG32k3a;

class Order {
    public static void main(String[] arguments) {
        int n = 64, runs = 100;
        MRG32k3a stream = new MRG32k3a();
        LatinHypercube one = new LatinHypercube(n, 3), other = new LatinHypercube(n, 3);
        double[] half = new double[3], products = new double[3];
        for (int run = 0; run < runs; run++) {
            one.randomize(stream);
            other.randomize(stream);
            for (int i = 0; i < n; i++)
                for (int j = 0; j < 3; j++) {
                    half[j] += i < n / 2 ? one.getCoordinate(i, j) / (n / 2 * runs) : 0;
                    products[j] += (one.getCoordinate(i, j) - .5) * (other.getCoordinate(i, j) - .5) / (n * runs);
                }
        }
        for (int j = 0; j < 3; j++)
            System.out.printf("coordinate %d: mean of the first half %.3f, correlation of two designs %.3f%n", j, half[j],
                              12 * products[j]);
        boolean fair = Math.abs(half[1] - .5) < .02 && Math.abs(half[2] - .5) < .02;
        System.exit(fair && Math.abs(half[0] - .25) < .01 && 12 * products[0] > .99 ? 0 : 1);
    }
}
END
java -cp ssj-3.3.2.jar Order.java
