#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: HaltonSequenceGenerator(dim) gives the Halton sequence, as its SobolSequenceGenerator gives Sobol's.
# Seen: from base 3 on the digits are permuted, by a multiplication with a weight: point 1 is (1/2, 2/3, 3/5), not
# (1/2, 1/3, 1/5). A constructor with other arguments takes weights of 1, or none for no permutation.
# Packages: org.apache.commons:commons-math3:3.6.1 (Maven Central)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mvn -q dependency:copy -Dartifact=org.apache.commons:commons-math3:3.6.1 -DoutputDirectory=.
cat >Points.java <<'END'
import java.util.Arrays;
import org.apache.commons.math3.random.HaltonSequenceGenerator;

class Points {
    public static void main(String[] arguments) {
        double[] usual = new HaltonSequenceGenerator(3).skipTo(1);
        double[] plain = new HaltonSequenceGenerator(3, new int[] {2, 3, 5}, null).skipTo(1);
        System.out.println("point 1: " + Arrays.toString(usual) + "; without weights: " + Arrays.toString(plain));
        boolean permuted = Math.abs(usual[1] - 2. / 3) < 1e-12 && Math.abs(usual[2] - 3. / 5) < 1e-12;
        boolean known = Math.abs(plain[1] - 1. / 3) < 1e-12 && Math.abs(plain[2] - 1. / 5) < 1e-12;
        System.exit(permuted && known ? 0 : 1);
    }
}
END
java -cp commons-math3-3.6.1.jar Points.java
