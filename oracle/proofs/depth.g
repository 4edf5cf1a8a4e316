# [lo, hi] of a depth contains N*/Den*, where N is the line of the depth's numerators and
# Den = |det M|. A star marks an exact number.
#
# Code: DepthFilter (depth_filter.cpp), which computes
#
#   reciprocal = fl(1/Den)        radius = fl(fl(2 band) reciprocal)         2 band is exact
#   depth      = fl(e reciprocal)              lo, hi = fl(depth -+ radius)
#
# Assumes: |e - N*| <= band and band = 8u size, where `size` is the sum of the terms' sizes
# (edge.g). Band and size have a few roundings each, and |e| <= (1 + 2^-40) size. Den is within
# 2^-51 Den* of Den* (limbs.g). Nothing underflows: e and the band are 0 or at least 2^-656 in
# magnitude (roundings.g), and Den lies between 2^-300 and 2^300.
#
# Numbers are in units of size/Den, so size and Den drop out: e = s, band = w, N* = s + w r with
# |r| <= 1, and Den/Den* = 1 + k. Shown for hi; lo follows with the signs s and r reversed.
#@ -Eprecision=200
twice = 2;
# Refused with: twice = 1.87;

s = sign * (1 + 1b-40);
w = 8 * 1b-53 * (1 + d5);
hi = (s * ((1 + d1) * (1 + d2)) + twice * w * ((1 + d1) * (1 + d3))) * (1 + d4);
exact = (s + w * r) * (1 + k);

{ d1 in [-1b-53, 1b-53] /\ d2 in [-1b-53, 1b-53] /\ d3 in [-1b-53, 1b-53] /\ d4 in [-1b-53, 1b-53] /\
  |d5| <= 1b-50 /\ |k| <= 1b-51 /\ sign in [-1, 1] /\ r in [-1, 1]
  ->
  hi - exact >= 0 }

hi - exact ->
    s * ((1 + d1) * (1 + d2) * (1 + d4) - (1 + k))
  + w * (twice * ((1 + d1) * (1 + d3) * (1 + d4)) - r * (1 + k));
