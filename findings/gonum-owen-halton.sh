#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: samplemv.Halton{Kind: Owen} is Owen's nested scrambling: a digit's permutation depends on the digits before it.
# Seen: each digit has one permutation, whatever the digits before it: in base 3 the second digits of the points in the
# three thirds are permuted alike with each of 50 seeds. It is the randomised Halton of Owen 2017, whose variance is not
# that of Owen 1995.
# Packages: gonum.org/v1/gonum v0.15.1 (Go module proxy)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >main.go <<'END'
package main

import (
	"fmt"
	"os"

	"golang.org/x/exp/rand"
	"gonum.org/v1/gonum/mat"
	"gonum.org/v1/gonum/stat/distmv"
	"gonum.org/v1/gonum/stat/samplemv"
)

func main() {
	alike := 0
	for seed := uint64(1); seed <= 50; seed++ {
		points := mat.NewDense(9, 2, nil)
		samplemv.Halton{Kind: samplemv.Owen, Q: distmv.NewUnitUniform(2, nil), Src: rand.NewSource(seed)}.Sample(points)
		var digits [3][3]int // the second digit of coordinate 1, by the digits of the index
		for i := 0; i < 9; i++ {
			digits[i%3][i/3] = int(points.At(i, 1)*9) % 3
		}
		if digits[0] == digits[1] && digits[1] == digits[2] {
			alike++
		}
	}
	fmt.Println("seeds whose second digits are permuted alike in all thirds:", alike, "of 50; nested scrambling: about 1")
	if alike != 50 {
		os.Exit(1)
	}
}
END
go mod init points 2>/dev/null
go get gonum.org/v1/gonum@v0.15.1 2>/dev/null
go mod tidy 2>/dev/null
go run .
