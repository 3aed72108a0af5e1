#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: PoissonSampling.Disk(seed, radius, minDist, k, callback) of JOML, OpenGL's mathematics library for Java, keeps
# minDist between its points, as implementations of Bridson's algorithm do.
# Seen: more than a fifth of the points have a neighbour closer than that, the closest at .71 to .77 of it with distances
# of .05 and below. 1 / sqrt(2) is the bound: the side of a grid's cell, of which only the neighbours are looked at, not
# those two cells away. Sets are denser by it and have a blurred edge in their pair correlation.
# Packages: org.joml:joml:1.10.8 (Maven Central)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mvn -q dependency:copy -Dartifact=org.joml:joml:1.10.8 -DoutputDirectory=.
cat >Distances.java <<'END'
import java.util.*;
import org.joml.sampling.PoissonSampling;

class Distances {
    public static void main(String[] arguments) {
        boolean seen = true;
        for (float distance : new float[] {.05f, .02f})
            for (long seed = 1; seed <= 3; seed++) {
                List<float[]> points = new ArrayList<>();
                new PoissonSampling.Disk(seed, 1, distance, 30, (x, y) -> points.add(new float[] {x, y}));
                double least = 2;
                int close = 0;
                for (float[] p : points) {
                    double nearest = 2;
                    for (float[] q : points)
                        if (p != q)
                            nearest = Math.min(nearest, Math.hypot(p[0] - q[0], p[1] - q[1]));
                    least = Math.min(least, nearest);
                    close += nearest < .999 * distance ? 1 : 0;
                }
                System.out.printf("distance %.2f, seed %d: %d points, %d with a neighbour closer, least %.3f of it%n", distance,
                                  seed, points.size(), close, least / distance);
                seen &= 5 * close > points.size() && least < .8 * distance && least > .707 * distance;
            }
        System.exit(seen ? 0 : 1);
    }
}
END
java -cp joml-1.10.8.jar Distances.java
